#!/usr/bin/env python3
"""The numbers of docs/claims.md.

    python3 docs/claims.py target/release/abrade [SECTION ..]

Runs the scenes one by one and prints a table per claim, each with its command. Needs Python 3 and
nothing else. Sections: normal oblique indentation threshold hardness bearing rate ripple energy;
all of them when none is named.
"""

import csv
import json
import math
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

SCENES = Path(__file__).resolve().parent.parent / "scenes"
PITCH = 0.6015750e-3  # 5012 nodes on 93.5 mm x 16.8 mm
AREA = 93.5e-3 * 16.8e-3 / 5012
INDENTER = 10e-3
NODE = 0.25e-3
ABRADE = ""
OUT = Path()


def shown(scene, sets):
    parts = "".join(f" --set '{path}={value}'" for path, value in sets.items())
    return f"abrade run scenes/{scene}.ron{parts}"


def run(scene, sets, outputs="[]"):
    """Summary of one run."""
    command = [ABRADE, "run", str(SCENES / f"{scene}.ron"), "--json", "--out", str(OUT)]
    for path, value in {**sets, "outputs": outputs}.items():
        command += ["--set", f"{path}={value}"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{shown(scene, sets)}\n{done.stderr}")
    return json.loads(done.stdout)


def plate(summary):
    return summary["surfaces"]["plate"]


def wear(summary):
    return plate(summary)["wear_volume_m3"] * 1e9


def title(text, scene, sets):
    print(f"\n## {text}\n\n`{shown(scene, sets)}`\n")


def table(head, rows):
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |", flush=True)


def landings(n, pitch=PITCH):
    """n x n landings, evenly over the unit cell of the lattice."""
    steps = [(i + 0.5) / n for i in range(n)]
    return [(u * pitch * math.sqrt(3) / 2, (v + u / 2) * pitch) for u in steps for v in steps]


def at(body, x, y):
    return {f"bodies.{body}.position.at": f'("{x * 1e3:.6f} mm", "{y * 1e3:.6f} mm")'}


PLACES = (
    ("over a node", (0, 0)),
    ("in a hollow", (0.173662e-3, 0.300792e-3)),
    ("between two nodes", (0, PITCH / 2)),
)


# Normal impact: Fig. 4, Eq. 16


def normal():
    mass = 4 / 3 * math.pi * INDENTER**3 * 8000
    cases = [(h, 45) for h in (1, 1.7, 2.5, 5, 7)] + [(1.7, v) for v in (10, 20, 30, 60)]
    scenes = ("paper/normal_impact", "foundation/normal_impact")
    title(
        "Fig. 4: W over m V^2 / 2H",
        scenes[0],
        {"materials.plate.hardness": '"1.7 GPa"', "bodies.ball.motion.speed": '"45 m/s"'},
    )
    rows = []
    for hardness, speed in cases:
        row = [f"{hardness} GPa", f"{speed} m/s"]
        eq16 = mass * speed**2 / (2 * hardness * 1e9) * 1e9
        row.append(f"{eq16:.4g}")
        sets = {
            "materials.plate.hardness": f'"{hardness} GPa"',
            "bodies.ball.motion.speed": f'"{speed} m/s"',
        }
        for scene in scenes:
            places = landings(3) if scene.startswith("paper") else [(0, 0)]
            results = [run(scene, {**sets, **at("ball", x, y)}) for x, y in places]
            w = statistics.mean(map(wear, results))
            cor = statistics.mean(r["bodies"]["ball"]["restitution"] for r in results)
            row += [f"{w:.4g}", f"{w / eq16:.3f}", f"{cor:.3f}"]
        rows.append(row)
    law = "HertzNodes, 9 landings"
    table(
        ["H", "V", "Eq. 16 mm3", f"W mm3 ({law})", "W/Eq. 16", "COR"]
        + ["W mm3 (Foundation)", "W/Eq. 16", "COR"],
        rows,
    )


# Oblique impact: Figs. 5 to 7

ANGLES = (10, 15, 20, 25, 30, 35, 40, 45, 50, 60, 70, 75, 80, 90)


def over_angles(scene, sets, places, angles=ANGLES):
    """Per angle: W, its share of lateral flow, COR, deviation; means over the landings."""
    found = {}
    for angle in angles:
        results = [
            run(scene, {**sets, "bodies.ball.motion.angle": f'"{angle} deg"', **at("ball", x, y)})
            for x, y in places
        ]
        w = statistics.mean(map(wear, results))
        lateral = statistics.mean(plate(r)["wear_volume_lateral_m3"] * 1e9 for r in results)
        balls = [r["bodies"]["ball"] for r in results]
        found[angle] = (
            w,
            lateral / w if w else math.nan,
            statistics.mean(b["restitution"] for b in balls),
            statistics.mean(b["rebound_angle_deg"] - angle for b in balls),
        )
    return found


def oblique():
    cell = landings(6)
    flow = "surfaces.plate.flow.lateral"
    paper, converged = "paper/oblique_impact", "foundation/oblique_impact"
    series = []
    for law in ("Eq5", "Projected"):
        for speed in (30, 35, 40):
            sets = {flow: law, "bodies.ball.motion.speed": f'"{speed} m/s"'}
            series.append((f"{law}, {speed} m/s", paper, sets, cell))
        for ratio in (0.15, 0.1):
            sets = {flow: law, "materials.plate.shear_ratio": ratio}
            series.append((f"{law}, mu_a {ratio}", paper, sets, cell))
    for ratio in (0.25, 0.15, 0.1):
        sets = {"materials.plate.shear_ratio": ratio}
        series.append((f"Foundation, mu_a {ratio}", converged, sets, [(0, 0)]))
    sets = {"materials.plate.shear_ratio": 10}
    series.append(("Eq5, no lateral flow (mu_a 10)", paper, {flow: "Eq5", **sets}, cell))
    found = [(name, over_angles(*rest)) for name, *rest in series]

    first = {flow: "Eq5", "bodies.ball.motion.angle": '"45 deg"'}
    title("Figs. 5, 6: W over the angle, 1e-6 mm3", paper, first)
    print("HertzNodes: mean over 36 landings, evenly over the unit cell.")
    print("mu_a 0.25, 35 m/s if not named.\n")
    head = ["law"] + [f"{a}" for a in ANGLES]

    def print_column(index, form, last, pick):
        rows = []
        for name, row in found:
            cells = [form.format(v[index]) if v[index] == v[index] else "-" for v in row.values()]
            extreme = [f"{pick(row, key=lambda a: row[a][index])} deg"] if pick else []
            rows.append([name] + cells + extreme)
        table(head + ([last] if last else []), rows)

    found = [(n, {a: (v[0] * 1e6, *v[1:]) for a, v in row.items()}) for n, row in found]
    print_column(0, "{:.0f}", "peak at", max)
    print("\n### Share of lateral flow in W (Fig. 5b)\n")
    print_column(1, "{:.2f}", None, None)
    print("\n### Restitution (Fig. 7a)\n")
    print_column(2, "{:.3f}", "least at", min)
    print("\n### Deviation, deg (Fig. 7b)\n")
    print_column(3, "{:.1f}", "most at", max)

    steep = {"bodies.ball.motion.angle": '"90 deg"'}
    rows = []
    cases = [(f"paper lattice, {name}", paper, at("ball", *place)) for name, place in PLACES[:2]]
    for name, scene, where in [*cases, ("Foundation", converged, {})]:
        summary = run(scene, {**steep, **where})
        restitution = summary["bodies"]["ball"]["restitution"]
        rows.append([name, f"{restitution:.4f}", f"{wear(summary) * 1e6:.0f}"])
    title("90 degrees", paper, steep)
    table(["case", "COR", "W 1e-6 mm3"], rows)

    some = (25, 35, 45, 60, 75, 90)
    rows = []
    for pitch in (0.6, 0.3, 0.15, 0.1):
        strip = f'HexStrip(length: "8 mm", width: "6 mm", pitch: "{pitch} mm")'
        sets = {flow: "Eq5", "surfaces.plate.geometry": strip}
        row = over_angles(paper, sets, landings(4, pitch * 1e-3), some)
        rows.append([f"{pitch} mm"] + [f"{v[0] * 1e6:.0f}" for v in row.values()])
    title("The peak belongs to the pitch: W over the angle, 1e-6 mm3, 16 landings", paper, sets)
    table(["pitch"] + [f"{a}" for a in some], rows)


# Indentation: Fig. 8, Eq. 19

def sunk(summary):
    """Depth of the indenter below the place where it touches, um."""
    return (NODE + INDENTER - summary["bodies"]["indenter"]["position_m"][2]) * 1e6


def bisect(worn, low, high, tolerance):
    while high - low > tolerance:
        middle = (low + high) / 2
        low, high = (low, middle) if worn(middle) else (middle, high)
    return high


def indentation():
    paper = "paper/indentation"
    load = "bodies.indenter.motion.indent_to"
    rows = []
    for name, place in PLACES:
        where = at("indenter", *place)
        onset = bisect(lambda f: wear(run(paper, {load: f"{f:.3f}", **where})) > 0, 100, 6000, 1)
        at3 = run(paper, {load: '"3 kN"', **where})
        full = run(paper, {load: '"21 kN"', **where})
        rows.append(
            [
                name,
                f"{onset / 1e3:.2f}",
                f"{plate(at3)['max_depth_m'] * 1e6:.1f}",
                f"{plate(full)['indented_area_m2'] * 1e6:.2f}",
                f"{wear(full):.3f}",
                f"{sunk(full):.0f}",
            ]
        )
    title("Fig. 8: indentation", paper, {load: '"1.8 kN"'})
    full_load = ["area at 21 kN mm2", "W at 21 kN mm3", "sunk at 21 kN um"]
    table(["start", "first wear kN", "deepest at 3 kN um", *full_load], rows)


# Scratching: Figs. 3, 9 to 11

SCRATCH = "paper/scratch"
DRIVE = "bodies.indenter.motion."


def loaded(load, distance, over, quasi_static=True, **more):
    sets = {
        DRIVE + "indent_to": f'"{load:g} N"',
        DRIVE + "load": f'"{load:g} N"',
        DRIVE + "distance": f'"{distance:g} mm"',
        DRIVE + "rate_over": f'"{over:g} mm"',
    }
    if quasi_static:
        sets[DRIVE + "solution"] = "QuasiStatic()"
    return {**sets, **more}


def threshold():
    rows = []
    for name, solution in (("QuasiStatic", True), ("Dynamic", False)):
        for law in ("Projected", "Eq5"):
            more = {"surfaces.plate.flow.lateral": law}
            go = lambda f: run(SCRATCH, loaded(f, 12, 6, solution, **more))
            first = bisect(lambda f: wear(go(f)) > 0, 100, 2000, 5)
            one = go(1000)
            rows.append(
                [
                    name,
                    law,
                    f"{first / 1e3:.2f}",
                    f"{plate(one)['wear_rate_m2'] * 1e6:.4f}",
                    f"{plate(one)['max_depth_m'] * 1e6:.1f}",
                ]
            )
    title("Fig. 3a: where a scratch begins (12 mm)", SCRATCH, loaded(1000, 12, 6))
    table(["solution", "law", "first wear kN", "rate at 1 kN mm2", "deepest at 1 kN um"], rows)


def arrays(path, names):
    """Named arrays of a .vtp file: appended raw blocks, zlib-compressed."""
    raw = path.read_bytes()
    start = raw.index(b"_", raw.index(b"<AppendedData")) + 1
    found = {}
    for name in names:
        tag = raw[raw.index(b'Name="' + name.encode() + b'"') :]
        offset = int(tag[tag.index(b'offset="') + 8 :].split(b'"', 1)[0])
        base = start + offset
        blocks = struct.unpack_from("<Q", raw, base)[0]
        sizes = struct.unpack_from(f"<{blocks}Q", raw, base + 24)
        place, data = base + 24 + 8 * blocks, b""
        for size in sizes:
            data += zlib.decompress(raw[place : place + size])
            place += size
        found[name] = struct.unpack(f"<{len(data) // 8}d", data)
    return found


def contact(summary):
    """Area of contact A_z: nodes in contact times a_s, from the surface and the body's place."""
    points = arrays(OUT / "surface_0000.vtp", ["Points"])["Points"]
    centre = summary["bodies"]["indenter"]["position_m"]
    nodes = zip(points[0::3], points[1::3], points[2::3])
    return AREA * sum(math.dist(p, centre) < NODE + INDENTER for p in nodes)


def hardness():
    # Two columns of nodes pass in one length of pitch * sqrt 3.
    period = PITCH * math.sqrt(3) * 1e3
    loads = (1000, 2000, 3000, 4000, 5000, 10000, 21000)
    slopes, rows = [], []
    for law in ("Projected", "Eq5"):
        for name, end in (("first 1.04 mm", period), ("last 1.04 of 80 mm", 80)):
            points = []
            for load in loads:
                areas = []
                for k in range(4):
                    distance = end - period * k / 4
                    sets = loaded(load, distance, period, **{"surfaces.plate.flow.lateral": law})
                    sets[DRIVE + "rate_over"] = f'"{min(period, distance):g} mm"'
                    summary = run(SCRATCH, sets, "[Surface(at: End)]")
                    areas.append(contact(summary) * 1e6)
                    if k == 0:
                        force = -summary["bodies"]["indenter"]["mean_force_N"][0]
                points.append((statistics.mean(areas), force))
            rows.append([law, name] + [f"{f:.0f} / {a:.2f}" for a, f in points])
            for some, part in (("1 to 5 kN", points[:5]), ("5 to 21 kN", points[4:])):
                slope = statistics.linear_regression(*zip(*part)).slope
                slopes.append([law, name, some, f"{slope / 1e3:.2f}"])
    title("Fig. 3b: F_x over A_z", SCRATCH, loaded(5000, period, period))
    print("F_x is `mean_force_N`. A_z is the nodes in contact times a_s, mean of four places.\n")
    table(["law", "over"] + [f"{f / 1e3:g} kN, N / mm2" for f in loads], rows)
    print()
    table(["law", "over", "loads", "slope H_l GPa"], slopes)


def bearing():
    before = plate(run(SCRATCH, loaded(21000, 0.001, 0.001, False)))
    rows = []
    for distance in (0.02, 0.05, 0.1, 0.5, 1, 3, 12):
        summary = run(SCRATCH, loaded(21000, distance, distance, False))
        by = [
            (plate(summary)[key] - before[key]) * 1e9
            for key in ("wear_volume_normal_m3", "wear_volume_lateral_m3")
        ]
        force = -summary["bodies"]["indenter"]["mean_force_N"][0] / 1e3
        cells = [f"{w:.3f}" for w in by]
        rows.append([f"{distance}", *cells, f"{sunk(summary):.0f}", f"{force:.2f}"])
    first = loaded(21000, 0.02, 0.02, False)
    title("Fig. 9: from indentation to scratching at 21 kN", SCRATCH, first)
    print("W is counted from 1 um of sliding on.\n")
    head = ["W by normal flow mm3", "W by lateral flow mm3", "sunk um", "mean F_x kN"]
    table(["slid mm", *head], rows)

    rows = []
    for law in ("Projected", "Eq5"):
        for ratio in (0.25, 0.4):
            sets = {"surfaces.plate.flow.lateral": law, "materials.plate.shear_ratio": ratio}
            summary = run(SCRATCH, sets)
            rows.append(
                [
                    law,
                    f"{ratio}",
                    f"{sunk(summary):.0f}",
                    f"{plate(summary)['wear_rate_m2'] * 1e6:.3f}",
                ]
            )
    print("\n### After 80 mm (Fig. 9a)\n")
    table(["law", "mu_a", "sunk um", "rate over the last 8 mm, mm2"], rows)


LOADS = (1000, 2000, 5000, 10000, 21000)


def rate():
    strip = 'HexStrip(length: "93.5 mm", width: "12 mm", pitch: "0.2 mm")'
    plain = {"surfaces.plate.geometry": strip}
    plain["bodies.indenter.position.at"] = '("-41.5 mm", "0 mm")'
    eq5 = {"surfaces.plate.flow.lateral": "Eq5"}
    cases = (
        ("HertzNodes, Projected", SCRATCH, (12, 6), True, {}),
        ("HertzNodes, Projected, Dynamic", SCRATCH, (12, 6), False, {}),
        ("HertzNodes, Eq5", SCRATCH, (12, 6), True, eq5),
        ("Foundation, pitch 0.2 mm", "foundation/scratch", (12, 6), True, plain),
        ("HertzNodes, Projected", SCRATCH, (80, 8), True, {}),
        ("HertzNodes, Eq5", SCRATCH, (80, 8), True, eq5),
        ("Foundation, pitch 0.2 mm", "foundation/scratch", (80, 8), True, plain),
    )
    rows = []
    for name, scene, path, quasi_static, more in cases:
        rates = []
        for load in LOADS:
            summary = run(scene, loaded(load, *path, quasi_static, **more))
            rates.append(plate(summary)["wear_rate_m2"] * 1e6)
        slopes = [
            math.log(b / a) / math.log(n / m)
            for a, b, m, n in zip(rates, rates[1:], LOADS, LOADS[1:])
        ]
        over = f"{path[0] - path[1]} to {path[0]} mm"
        rows.append([name, over] + [f"{r:.4f}" for r in rates] + [f"{s:.2f}" for s in slopes])
    title("Fig. 10: wear rate over the load, mm2", SCRATCH, loaded(5000, 12, 6))
    print("QuasiStatic where nothing else is named.\n")
    table(
        ["law", "over"]
        + [f"{f / 1e3:g} kN" for f in LOADS]
        + [f"slope {m / 1e3:g}-{n / 1e3:g}" for m, n in zip(LOADS, LOADS[1:])],
        rows,
    )


def ripple():
    rows = []
    for law in ("Projected", "Eq5"):
        for load in (1000, 5000, 21000):
            sets = {
                "surfaces.plate.flow.lateral": law,
                DRIVE + "indent_to": f'"{load} N"',
                DRIVE + "load": f'"{load} N"',
            }
            run(SCRATCH, sets, '[History(every: "0.1 ms")]')
            with open(OUT / "history.csv", newline="") as file:
                lines = list(csv.DictReader(file))
            path = [(float(r["indenter_x_m"]), float(r["indenter_z_m"])) for r in lines]
            end = path[-1][0]
            path = [(x, z) for x, z in path if x > end - 8e-3]
            line = statistics.linear_regression(*zip(*path))
            rest = [z - line.slope * x - line.intercept for x, z in path]
            half = (max(rest) - min(rest)) / 2 * 1e6
            rows.append([law, f"{load / 1e3:g}", f"{half:.2f}", f"{line.slope * 1e3:.2f}"])
    title("Ripple of the height over the last 8 of 80 mm, less its straight line", SCRATCH, sets)
    table(["law", "load kN", "half peak to peak um", "drift um/mm"], rows)


# Energy: Figs. 12, 13


def energy():
    cases = [
        (
            "paper/energy_impact",
            {"bodies.ball.motion.angle": f'"{a} deg"', **at("ball", *place)},
            f"impact, {a} deg, {name}",
        )
        for a in (29, 45, 90)
        for name, place in PLACES[:2]
    ]
    cases.append(("paper/energy_scratch", {}, "scratch, 12 mm at 21 kN"))
    cases.append(("foundation/oblique_impact", {}, "Foundation, 45 deg"))
    rows = []
    for scene, sets, name in cases:
        book = run(scene, sets, "[Energy]")["energy"]
        given = book["initial_J"] + book["external_work_J"]
        parts = ("kinetic_J", "elastic_J", "friction_J", "wear_J", "history_J")
        row = [f"{book[k] / given:.4f}" for k in parts] + [f"{book['numerical_J'] / given:.1e}"]
        if "impact" in scene:
            fine = run(scene, {**sets, "run.accuracy": "1e-6"}, "[Energy]")["energy"]
            row.append(f"{fine['numerical_J'] / given:.1e}")
        else:
            row.append("")
        rows.append([name, f"{given:.4g}"] + row)
    title("Figs. 12, 13: energies over what was put in", "paper/energy_impact", cases[0][1])
    head = ["kinetic", "elastic", "friction", "wear", "history", "numerical"]
    table(["case", "put in J", *head, "numerical at accuracy 1e-6"], rows)


SECTIONS = (normal, oblique, indentation, threshold, hardness, bearing, rate, ripple, energy)


def main():
    global ABRADE, OUT
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    ABRADE = str(Path(sys.argv[1]).resolve())
    wanted = sys.argv[2:] or [s.__name__ for s in SECTIONS]
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        OUT = Path(folder)
        for section in SECTIONS:
            if section.__name__ in wanted:
                section()
    print(f"\n{time.monotonic() - start:.0f} s in all")


main()
