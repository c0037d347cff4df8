"""Wear after Finnie in LIGGGHTS: against the closed form over the angle, and over the step.

    python3 benches/peers/liggghts.py          needs `apt-get install liggghts`

A ball of 3 mm strikes one triangle at 35 m/s. LIGGGHTS adds, while the ball comes nearer,
2 k f(angle) |force| |velocity| dt per step, with the angle, force and velocity of that step.
The closed form has the angle before the impact: k m v^2 f(a), f = sin 2a - 3 sin^2 a, and
cos^2 a / 3 where tan a > 1/3. Its factor is that of a head-on approach, over which
|force| |velocity| dt adds up to m v^2 / 2. What came of it: README.md.
"""

import math
import re
import shutil

import measure

FOLDER = measure.ROOT / "benches" / "peers" / "liggghts"
MASS = 2500.0 * 4.0 / 3.0 * math.pi * 0.003**3
SPEED = 35.0
CORNERS = [(-0.02, -0.02, 0.0), (0.03, -0.02, 0.0), (-0.005, 0.03, 0.0)]
AREA = 0.5 * 0.05 * 0.05


def share(angle):
    """Finnie's f, with k = 1."""
    sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    return 2 * sine * cosine - 3 * sine**2 if 3 * sine < cosine else cosine**2 / 3


def write_plate(path):
    corners = "\n".join("vertex %g %g %g" % corner for corner in CORNERS)
    facet = f"facet normal 0 0 1\nouter loop\n{corners}\nendloop\nendfacet"
    path.write_text(f"solid plate\n{facet}\nendsolid plate\n")


def wear(angle, friction, dt):
    """Wear over k m v^2, and whether the corners of the plate moved."""
    place = measure.PLACE / "liggghts"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    write_plate(place / "plate.stl")
    told = {
        "angle": angle, "speed": SPEED, "dt": dt, "mu": friction,
        "mesh": place / "plate.stl", "out": place / "worn*.vtk",
    }
    command = ["liggghts", "-in", FOLDER / "in.wear", "-log", "none"]
    for name, value in told.items():
        command += ["-var", name, str(value)]
    measure.run(command, folder=place)
    files = sorted(place.glob("worn*.vtk"), key=lambda path: int(path.stem[4:]))
    first, last = files[0].read_text(), files[-1].read_text()
    points = [re.search(r"POINTS.*?\n(.*?)\n\n", text, re.S).group(1) for text in (first, last)]
    density = float(re.search(r"^wear 1 1 double\n(\S+)", last, re.M).group(1))
    return density * AREA / (MASS * SPEED**2), points[0] != points[1]


def main():
    if not shutil.which("liggghts"):
        raise SystemExit("liggghts is not installed: apt-get install liggghts")
    angles = [5, 10, 15, 16.85, 20, 25, 30, 35, 40, 45, 50, 60, 70, 80]
    frictions = [0.0, 0.3, 0.5]
    rows, moved = [], False
    for angle in angles:
        row = [angle, f"{share(angle):.4f}"]
        for friction in frictions:
            worn, moves = wear(angle, friction, 1e-8)
            moved |= moves
            row += [f"{worn:.4f}", f"{worn / share(angle):.2f}"]
        rows.append(row)
    print(f"{measure.machine()}\n")
    head = ["angle", "closed form"]
    for friction in frictions:
        head += [f"mu {friction}", "ratio"]
    measure.table(head, rows)
    peaks = [max(rows, key=lambda row: float(row[2 + 2 * i]))[0] for i in range(len(frictions))]
    print(f"peak of the closed form at {math.degrees(math.atan(2 / 3)) / 2:.2f} degrees;", end=" ")
    print("of LIGGGHTS, of these angles: " + ", ".join(map(str, peaks)))
    print(f"corners of the plate moved: {'yes' if moved else 'no'}\n")
    steps = [4e-8, 2e-8, 1e-8, 5e-9]
    measure.table(["dt [s], 30 degrees, mu 0.3", "wear"],
                  [[dt, f"{wear(30, 0.3, dt)[0]:.5f}"] for dt in steps])


if __name__ == "__main__":
    main()
