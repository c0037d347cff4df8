"""The paper's model in stock LAMMPS and in abrade: one core, one law, one lattice, one run.

    python3 benches/peers/lammps.py            impact, indentation, scratch (3 mm at 10 kN)
    python3 benches/peers/lammps.py --full     the scratch of the paper as well (80 mm at 21 kN)
    python3 benches/peers/lammps.py impact     only that case

What is compared, and the figures of one run: README.md beside this file.
"""

import json
import re
import sys
from dataclasses import dataclass
from statistics import mean

import measure

SCRIPTS = measure.ROOT / "benches" / "peers" / "lammps"
LATTICE = (
    "surfaces.plate.geometry=HexStrip(length: \"93.5 mm\", width: \"16.8 mm\", "
    "pitch: \"0.6 mm\", rest_area: \"0.3134078 mm2\")"
)
# Landings of the ball from a node, over the cell of the lattice [mm].
LANDINGS = [(0.0, 0.0), (0.17, 0.05), (0.35, 0.1), (0.52, 0.15), (0.69, 0.2), (0.87, 0.25)]
# Over a node of the lattice, as far from the left edge as LAMMPS begins, and LAMMPS' mass.
SLIDE = [
    "bodies.indenter.position.at=(\"-41.569219 mm\", \"0 mm\")",
    "bodies.indenter.motion.mass=0.033510322",
]


# Runs in one process for the time of the loop, of what takes less than so long [s]: in the first one code
# and memory are touched for the first time.
WARM_RUNS = 50
WARM = 0.05


@dataclass
class Row:
    """One setting: seconds of the process and of the loop alone, and the value that is compared.

    Seconds and steps are means over the landings of a case, `values` has one for each.
    """

    code: str
    wall: float
    cpu: float
    loop: float
    steps: float
    values: list

    def value(self):
        return mean(self.values)


@dataclass
class Case:
    """A case: what LAMMPS is told per script and step, and what abrade is told per accuracy."""

    title: str
    unit: float  # of the value, in SI
    value: str  # in words
    script: str
    variables: dict
    theirs: list  # (wear script, variables)
    scene: str
    sets: list
    ours: list  # (label, sets)
    finest: list  # two accuracies; errors are against their limit, or LAMMPS' last two rows' if empty
    of_lammps: callable
    of_summary: callable
    times: int = 1  # that each run is repeated; the least time counts
    landings: tuple = (({}, []),)  # (variables of LAMMPS, sets of abrade)


def wear_volume(summary):
    return summary["surfaces"]["plate"]["wear_volume_m3"]


def wear_rate(summary):
    return summary["surfaces"]["plate"]["wear_rate_m2"]


def result(name):
    """Reads `name=` off LAMMPS' line RESULT."""
    return lambda text: float(re.search(rf"^RESULT .*\b{name}=(\S+)", text, re.M).group(1))


def rate_over(length):
    """Wear volume per way over the last `length` of the slide, off the rows that LAMMPS prints."""

    def rate(text):
        rows, columns = [], []
        for line in text.splitlines():
            words = line.split()
            if words[:1] == ["Step"]:
                rows, columns = [], words
            elif columns and len(words) == len(columns) and words[0].isdigit():
                rows.append([float(words[columns.index(name)]) for name in ("v_xp", "v_W")])
        end = rows[-1]
        begin = min(rows, key=lambda row: abs(row[0] - (end[0] - length)))
        return (end[1] - begin[1]) / (end[0] - begin[0])

    return rate


def accuracies(*values):
    return [(f"accuracy {value}", [f"run.accuracy={value}"]) for value in values]


def steps(script, *values):
    return [(script, {"dt": value}) for value in values]


def landing(x, y):
    return {"ox": f"{x}e-3", "oy": f"{y}e-3"}, [f'bodies.ball.position.at=("{x} mm", "{y} mm")']


def increments(*values):
    """Quasi-static slides, whose load is balanced to 1e-4: their error is that of the increment."""
    solution = "bodies.indenter.motion.solution=QuasiStatic"
    accuracy = "run.accuracy=0.1"
    return [(f"quasi-static {mm} mm", [accuracy, f'{solution}(increment: "{mm} mm")']) for mm in values]


def scratch(title, load, way, theirs, ours, finest, value, of_lammps, of_summary, unit, over):
    motion = "bodies.indenter.motion"
    slide = {"Fz": load, "Lsc": way}
    return Case(
        title=title,
        unit=unit,
        value=value,
        script="in.indent_scratch",
        variables={**slide, "kfac": 1, "nthi": 1000},
        theirs=theirs,
        scene="scenes/paper/scratch.ron",
        sets=SLIDE + [
            f"{motion}.indent_to={load}",
            f"{motion}.load={load}",
            f"{motion}.distance={way}",
            f"{motion}.rate_over={over}",
        ],
        ours=ours,
        finest=finest,
        of_lammps=of_lammps,
        of_summary=of_summary,
    )


def every_case():
    impact = Case(
        title="Impact: 35 m/s at 45 degrees, H 6.6 GPa, mean of six landings",
        unit=1e-9,
        value="W [mm3]",
        script="in.impact",
        variables={"theta": 45, "kfac": 1, "books": 0, "nth": 100000},
        theirs=steps("wear.inc", "4e-9") + steps("wear_opt.inc", "1e-7", "2e-8", "4e-9"),
        scene="scenes/paper/oblique_impact.ron",
        sets=["bodies.ball.position.gap=1e-6"],
        ours=accuracies("1e-1", "1e-2", "1e-3", "4e-4", "3e-4", "1e-4", "3e-5", "1e-5"),
        finest=["1e-5", "1e-6"],
        of_lammps=result("W"),
        of_summary=wear_volume,
        times=4,
        landings=[landing(*place) for place in LANDINGS],
    )
    indentation = Case(
        title="Indentation to 21 kN over a node, H 1.7 GPa",
        unit=1e-9,
        value="W [mm3]",
        script="in.indent_scratch",
        variables={"scratch": 0, "kfac": 1, "nthi": 1000},
        theirs=[("wear.inc", {"dti": "1e-6"}), ("wear_opt.inc", {"dti": "1e-5"}),
                ("wear_opt.inc", {"dti": "1e-6"})],
        scene="scenes/paper/indentation.ron",
        sets=[],
        ours=[("as shipped", [])],
        finest=[],
        of_lammps=result("Wind"),
        of_summary=wear_volume,
    )
    short = scratch(
        "Scratch: 3 mm at 10 kN and 0.2 m/s",
        "10e3", "3e-3",
        [(script, {"dt": dt, "nth": 1000}) for script, dt in
         (("wear.inc", "1e-6"), ("wear_opt.inc", "1e-6"), ("wear_opt.inc", "4e-6"))],
        accuracies("0.5", "1e-2", "1e-3") + increments(0.3, 0.075, 0.02), ["1e-4", "1e-5"],
        "W [mm3]", result("W"), wear_volume, 1e-9, "1e-3",
    )
    full = scratch(
        "Scratch of the paper: 80 mm at 21 kN and 0.2 m/s",
        "21e3", "80e-3",
        [("wear.inc", {"dt": "8e-6", "dti": "1e-5", "nth": 125}),
         ("wear_opt.inc", {"dt": "1e-6", "nth": 1000}),
         ("wear_opt.inc", {"dt": "4e-6", "dti": "1e-5", "nth": 250}),
         ("wear_opt.inc", {"dt": "8e-6", "dti": "1e-5", "nth": 125})],
        accuracies("0.5", "1e-2") + increments(0.6, 0.3, 0.15, 0.09, 0.075, 0.02), ["1e-2", "1e-3"],
        "rate over the last 8 mm [mm2]", rate_over(8e-3), wear_rate, 1e-6, "8e-3",
    )
    return {"impact": impact, "indentation": indentation, "scratch": short, "full": full}


def run_lammps(folder, case, script, variables):
    told = {**case.variables, **variables, "wearinc": script}
    runs = [lammps_once(folder, case, {**told, **place}) for place, _ in case.landings]
    name = {"wear.inc": "natural", "wear_opt.inc": "flattened"}[script]
    step = " ".join(f"{key} {value}" for key, value in variables.items() if key != "nth")
    return Row(f"LAMMPS {name}, {step}", *gather(runs))


def lammps_once(folder, case, variables):
    command = [folder / "bin" / "lmp", "-in", case.script, "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    library = {"LD_LIBRARY_PATH": str(folder / "lib")}
    taken = measure.least(case.times, command, folder=SCRIPTS, environment=library)
    loops = re.findall(r"^Loop time of (\S+) on .* for (\d+) steps", taken.text, re.M)
    used = re.findall(r"^(\S+)% CPU use", taken.text, re.M)
    loop = sum(float(wall) * float(part) / 100 for (wall, _), part in zip(loops, used))
    count = sum(int(steps) for _, steps in loops)
    return taken.wall, taken.cpu, loop, count, case.of_lammps(taken.text)


def gather(runs):
    """Means of all but the last column."""
    *columns, values = zip(*runs)
    return [mean(column) for column in columns] + [list(values)]


def run_abrade(program, case, label, sets, times, outputs="outputs=[]"):
    law = "surfaces.plate.flow.lateral=Eq5"
    told = [LATTICE, law, *case.sets, *sets] + ([outputs] if outputs else [])
    runs = [abrade_once(program, case, told + place, times) for _, place in case.landings]
    return Row(f"abrade, {label}", *gather(runs))


def abrade_once(program, case, sets, times):
    out = measure.PLACE / "abrade"
    command = [program.command, "run", measure.ROOT / case.scene, "--json", "--out", out]
    for one in sets:
        command += ["--set", one]
    every = [measure.run(command) for _ in range(times)]
    # Notes stand around it.
    text = every[0].text
    summary, _ = json.JSONDecoder().raw_decode(text[text.index("{") :])
    wall, cpu = min(taken.wall for taken in every), min(taken.cpu for taken in every)
    again = [program.warm, out, times if cpu > WARM else WARM_RUNS, measure.ROOT / case.scene]
    # A loop in wall time includes what other programs took meanwhile; it is part of the process.
    loop = min(cpu, float(measure.run([*again, *sets]).text))
    return wall, cpu, loop, summary["steps"], case.of_summary(summary)


def limits(one, other, order):
    """Values at a step of zero, of two rows whose errors are as a power of their steps' length."""
    coarse, fine = sorted((one, other), key=lambda row: row.steps)
    part = 1 / ((fine.steps / coarse.steps) ** order - 1)
    return [far + (far - near) * part for near, far in zip(coarse.values, fine.values)]


def error(row, exact):
    """Root mean square over the landings, over the mean of the exact values."""
    square = mean((value - true) ** 2 for value, true in zip(row.values, exact))
    return square**0.5 / mean(exact)


def ratios(row, ours, exact):
    """What abrade is quicker by, process and loop: of its rows whose errors are no larger."""
    equal = [mine for mine in ours if error(mine, exact) <= error(row, exact)]
    if not equal:
        return ["none as close", "", ""]
    process = min(equal, key=lambda mine: mine.cpu)
    loop = min(equal, key=lambda mine: mine.loop)
    return [f"{row.cpu / process.cpu:.0f}", f"{row.loop / loop.loop:.0f}", loop.code]


def seconds(value):
    return f"{value:.2f}" if value >= 1 else f"{value:.5f}" if value < 0.01 else f"{value:.3f}"


def compare(folder, program, case):
    """Prints one table."""
    quick = 7 if case.times > 1 else 3
    ours = [run_abrade(program, case, label, sets, quick) for label, sets in case.ours]
    shipped = run_abrade(program, case, "with the files of the scene", case.ours[-1][1], 1, None)
    theirs = [run_lammps(folder, case, *one) for one in case.theirs]
    if case.finest:
        finest = [run_abrade(program, case, *one, 1) for one in accuracies(*case.finest)]
        exact = limits(*finest, order=2)
    else:
        exact = limits(*theirs[-2:], order=1)
    rows = []
    for row in theirs + ours + [shipped]:
        times = [seconds(value) for value in (row.wall, row.cpu, row.loop)]
        ratio = ratios(row, ours, exact) if row in theirs else ["", "", ""]
        value, off = f"{row.value() / case.unit:.6g}", f"{error(row, exact):.1e}"
        rows.append([row.code, *times, f"{row.steps:.0f}", value, off, *ratio])
    print(f"### {case.title}\n")
    limit = f"{mean(exact) / case.unit:.6g} of {'abrade' if case.finest else 'LAMMPS'}"
    nearest = max(theirs, key=lambda row: row.steps)
    print(f"{case.value} at a step of zero: {limit};", end=" ")
    print(f"{nearest.value() / case.unit:.6g} of {nearest.code}\n")
    measure.table(
        ["code", "wall s", "CPU s", "loop s", "steps", case.value.split(" [")[0], "error",
         "process", "loop", "against"],
        rows,
    )


def main(words):
    cases = every_case()
    picked = [word for word in words if word in cases]
    names = picked or [name for name in cases if name != "full" or "--full" in words]
    folder = measure.python_with("lammps", ["lammps", "mpich"])
    program = measure.abrade()
    print(f"{measure.machine()}\n")
    for name in names:
        compare(folder, program, cases[name])


if __name__ == "__main__":
    main(sys.argv[1:])
