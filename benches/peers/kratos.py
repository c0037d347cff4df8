"""Wear of a plate in Kratos' DEM application: over the step and over the angle of an impact.

    python3 benches/peers/kratos.py

A ball of 3 mm strikes one triangle at 35 m/s. Kratos adds K rho R |v_n| / H per step in contact to
the field IMPACT_WEAR, without the length of the step, and K |F| s / H for a way s that slides to
NON_DIMENSIONAL_VOLUME_WEAR; both per area of the triangle. What came of it: README.md.
"""

import json
import re

import measure

SCRIPT = measure.ROOT / "benches" / "peers" / "kratos" / "one_impact.py"
AREA = 0.5 * 0.05 * 0.05


def impact(python, angle, dt):
    place = measure.PLACE / "kratos_case"
    place.mkdir(parents=True, exist_ok=True)
    taken = measure.run([python, SCRIPT, place, angle, 35.0, dt], folder=place)
    return json.loads(re.search(r"^FOUND (.*)", taken.text, re.M).group(1))


def row(first, found):
    speed = sum(part**2 for part in found["velocity"]) ** 0.5
    worn = [found[name] * AREA for name in ("impact_wear", "sliding_wear")]
    return [first, f"{worn[0]:.5g}", f"{worn[1]:.5g}", f"{speed / 35.0:.4f}"]


def main():
    folder = measure.python_with("kratos", ["KratosMultiphysics", "KratosDEMApplication"])
    python = folder / "bin" / "python"
    steps = {dt: impact(python, 30, dt) for dt in (4e-8, 2e-8, 1e-8, 5e-9)}
    angles = {angle: impact(python, angle, 2e-8) for angle in (10, 16.85, 30, 45, 60, 75, 90)}
    print(f"{measure.machine()}\n")
    names = ["impact wear x H / K", "sliding wear x H / K", "speed after / before"]
    measure.table(["dt [s], 30 degrees", *names], [row(*one) for one in steps.items()])
    measure.table(["angle, dt 2e-8 s", *names], [row(*one) for one in angles.items()])
    moved = any(found["moved"] for found in [*steps.values(), *angles.values()])
    print(f"corners of the plate moved: {'yes' if moved else 'no'}")


if __name__ == "__main__":
    main()
