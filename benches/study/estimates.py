"""Sets the errors that runs tell of themselves beside their errors in studies.

Run from the top of the repository, with the seconds that each study may take (default 20):

    python3 benches/study/estimates.py 20

Every case is a shipped scene with some of its values changed. Each is studied over accuracy and
over pitch, from six landings; docs/errors.md shows what is printed. Takes the standard library
alone.
"""

import collections
import csv
import pathlib
import subprocess
import sys

FOLDER = pathlib.Path("target/study")
ANGLE = "bodies.ball.motion.angle"
SPEED = "bodies.ball.motion.speed"
RIGID = "surfaces.plate.elastic=Rigid"
CUBE = "bodies.ball.shape=Cuboid(size: (3e-3, 3e-3, 3e-3))"
TETRAHEDRON = 'bodies.ball.shape=Polyhedron(kind: Tetrahedron, edge: "4 mm")'
FACTOR = 3.0


def ball(*sets):
    return "one_ball.ron", list(sets)


def cases():
    """Name, scene and changes of each case."""
    for angle in (15, 30, 60, 90):
        yield f"ball at {angle} deg", *ball(f"{ANGLE}={angle} deg")
        yield f"without friction, {angle} deg", *ball(
            f"{ANGLE}={angle} deg", "materials.steel.friction=0.0"
        )
    for hardness, angle in (("0.3 GPa", 30), ("6 GPa", 30), ("6 GPa", 80)):
        yield f"hardness {hardness}, {angle} deg", *ball(
            f"{ANGLE}={angle} deg", f"materials.steel.hardness={hardness}"
        )
    for speed, angle in ((8, 45), (8, 85), (120, 45)):
        yield f"{speed} m/s, {angle} deg", *ball(f"{SPEED}={speed} m/s", f"{ANGLE}={angle} deg")
    yield "NormalPressure", *ball("surfaces.plate.flow=NormalPressure()")
    yield "Rigid", *ball(RIGID)
    yield "restitution 0.5", *ball("surfaces.plate.restitution=0.5")
    for seed in (1, 2, 3):
        turned = f"bodies.ball.rotation=Random(seed: {seed})"
        yield f"cube {seed}", *ball(CUBE, turned)
        yield f"tetrahedron {seed}, Rigid", *ball(TETRAHEDRON, turned, RIGID)
    for scene in (
        "foundation/normal_impact.ron",
        "foundation/oblique_impact.ron",
        "theory/sphere_oblique.ron",
        "theory/polyhedron_generic.ron",
        "clump_impact.ron",
    ):
        yield scene, scene, []
    short = ["bodies.indenter.motion.distance=4 mm", "bodies.indenter.motion.rate_over=2 mm"]
    yield "scratch of 4 mm", "foundation/scratch.ron", short


def study(name, scene, sets, seconds):
    """The rows of a study that tell of the order, as dictionaries."""
    folder = FOLDER / name.replace("/", "_").replace(" ", "_")
    command = ["target/release/abrade", "study", "convergence", f"scenes/{scene}"]
    command += ["--out", str(folder), "--vary", "accuracy", "--vary", "pitch"]
    command += ["--landings", "6", "--budget", str(seconds)]
    command += [word for change in sets for word in ("--set", change)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    with open(folder / "study.csv", newline="") as table:
        return [row for row in csv.DictReader(table) if row["fitted"] == "true"]


def ratios(rows, varied, estimate):
    """Errors over their estimates, where both are known and more than rounding."""
    for row in rows:
        if row["varied"] == varied and row[estimate] and row["error_wear"]:
            error = float(row["error_wear"])
            if error > 1e-12 and float(row[estimate]) > 0.0:
                yield error / float(row[estimate])


def main():
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 20.0
    subprocess.run(["cargo", "build", "--release", "--bin", "abrade"], check=True)
    found = collections.defaultdict(list)
    print("| case | error by time over its estimate | error by pitch over its estimate |")
    print("|---|---|---|")
    for name, scene, sets in cases():
        rows = study(name, scene, sets, seconds)
        cells = []
        for varied, estimate in (("accuracy", "estimate_time"), ("pitch", "estimate_pitch")):
            these = list(ratios(rows, varied, estimate))
            found[varied] += these
            cells.append(", ".join(f"{ratio:.2g}" for ratio in these))
        print(f"| {name} | {cells[0]} | {cells[1]} |", flush=True)
    for varied, all_of_it in found.items():
        within = sum(1.0 / FACTOR <= ratio <= FACTOR for ratio in all_of_it)
        below = sum(ratio <= FACTOR for ratio in all_of_it)
        count = len(all_of_it)
        print(f"{varied}: {count} settings, {within} within a factor of 3, {below} at most 3")


if __name__ == "__main__":
    main()
