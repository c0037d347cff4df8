"""Sets the errors that runs tell of themselves beside their errors in studies.

Run from the top of the repository, with the seconds that each study may take (default 20):

    python3 benches/study/estimates.py 20

Every case is a shipped scene with some of its values changed. Each is studied over accuracy and
over pitch, from six landings. The ratio of error and estimate at every setting goes to
docs/estimates.csv; docs/errors.md shows the table that is printed. `show` in the place of the
seconds prints the table of the file that is there. Takes the standard library alone.
"""

import collections
import csv
import pathlib
import subprocess
import sys

FOLDER = pathlib.Path("target/study")
RATIOS = pathlib.Path("docs/estimates.csv")
BALLS, FACES = "balls", "cubes and tetrahedra"
SCENES, SCRATCH = "scenes as they are", "scratch of 4 mm"
ANGLE = "bodies.ball.motion.angle"
SPEED = "bodies.ball.motion.speed"
RIGID = "surfaces.plate.elastic=Rigid"
CUBE = "bodies.ball.shape=Cuboid(size: (3e-3, 3e-3, 3e-3))"
TETRAHEDRON = 'bodies.ball.shape=Polyhedron(kind: Tetrahedron, edge: "4 mm")'
FACTOR = 3.0


def ball(*sets):
    return "one_ball.ron", list(sets)


def cases():
    """Group, name, scene and changes of each case."""
    for angle in (15, 30, 60, 90):
        yield BALLS, f"ball at {angle} deg", *ball(f"{ANGLE}={angle} deg")
        yield BALLS, f"without friction, {angle} deg", *ball(
            f"{ANGLE}={angle} deg", "materials.steel.friction=0.0"
        )
    for hardness, angle in (("0.3 GPa", 30), ("6 GPa", 30), ("6 GPa", 80)):
        yield BALLS, f"hardness {hardness}, {angle} deg", *ball(
            f"{ANGLE}={angle} deg", f"materials.steel.hardness={hardness}"
        )
    for speed, angle in ((8, 45), (8, 85), (120, 45)):
        name = f"{speed} m/s, {angle} deg"
        yield BALLS, name, *ball(f"{SPEED}={speed} m/s", f"{ANGLE}={angle} deg")
    yield BALLS, "NormalPressure", *ball("surfaces.plate.flow=NormalPressure()")
    yield BALLS, "Rigid", *ball(RIGID)
    yield BALLS, "restitution 0.5", *ball("surfaces.plate.restitution=0.5")
    for seed in (1, 2, 3):
        turned = f"bodies.ball.rotation=Random(seed: {seed})"
        yield FACES, f"cube {seed}", *ball(CUBE, turned)
        yield FACES, f"tetrahedron {seed}, Rigid", *ball(TETRAHEDRON, turned, RIGID)
    for scene in (
        "foundation/normal_impact.ron",
        "foundation/oblique_impact.ron",
        "theory/sphere_oblique.ron",
        "theory/polyhedron_generic.ron",
        "clump_impact.ron",
    ):
        yield SCENES, scene, scene, []
    short = ["bodies.indenter.motion.distance=4 mm", "bodies.indenter.motion.rate_over=2 mm"]
    yield SCRATCH, "scratch of 4 mm", "foundation/scratch.ron", short


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


def measure(seconds):
    """Writes the ratios of every case."""
    subprocess.run(["cargo", "build", "--release", "--bin", "abrade"], check=True)
    with open(RATIOS, "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["group", "case", "estimate", "error_over_estimate"])
        for group, name, scene, sets in cases():
            rows = study(name, scene, sets, seconds)
            for varied, estimate in (("accuracy", "time"), ("pitch", "pitch")):
                for ratio in ratios(rows, varied, f"estimate_{estimate}"):
                    table.writerow([group, name, estimate, f"{ratio:.2g}"])
            file.flush()


def show():
    """Prints, for every group, how many ratios are near one, and the least and the largest."""
    with open(RATIOS, newline="") as file:
        rows = list(csv.DictReader(file))
    print("| estimate | cases | settings | within a factor of 3 | at most 3 | least | largest |")
    print("|---|---|---|---|---|---|---|")
    for estimate in ("time", "pitch"):
        groups = collections.defaultdict(list)
        all_of_it = [row for row in rows if row["estimate"] == estimate]
        for row in all_of_it:
            groups[row["group"]].append(row)
        for group, these in [*groups.items(), ("all", all_of_it)]:
            print(f"| {estimate} | {group} | {told(these)} |")


def told(rows):
    """The cells of a line: counts, and the two ends with their cases where there are several."""
    ratio = {id(row): float(row["error_over_estimate"]) for row in rows}
    within = sum(1.0 / FACTOR <= value <= FACTOR for value in ratio.values())
    at_most = sum(value <= FACTOR for value in ratio.values())
    ends = [end(rows, key=lambda row: ratio[id(row)]) for end in (min, max)]
    named = len({row["case"] for row in rows}) > 1
    ends = [f"{ratio[id(row)]:.2g}" + f" ({row['case']})" * named for row in ends]
    return " | ".join([str(len(rows)), str(within), str(at_most), *ends])


def main():
    what = sys.argv[1] if len(sys.argv) > 1 else "20"
    if what != "show":
        measure(float(what))
    show()


if __name__ == "__main__":
    main()
