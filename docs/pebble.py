#!/usr/bin/env python3
"""Weighs the pebble of examples/tumble with trimesh, a program that this one does not share a line with.

    cargo run --release --example tumble 10000 target/pebble
    python3 docs/pebble.py target/pebble

Installs trimesh from PyPI into a virtual environment beside the pebble, once. Compares volume,
centre and inertia of pebble.obj with what the rigid body has, by pebble.json, and the volume lost
with what the nodes were charged with, by curve.csv. Fails where a figure is off by more than 1e-3.
"""

import csv
import json
import os
import subprocess
import sys
import venv
from pathlib import Path

FOLDER = Path(sys.argv[1] if len(sys.argv) > 1 else "target/pebble")
DENSITY = 2000.0
LIMIT = 1e-3


def enter_environment():
    """Goes on in the environment that has trimesh, which is made if it is missing."""
    home = FOLDER / "venv"
    python = home / "bin" / "python"
    if Path(sys.prefix).resolve() == home.resolve():
        return
    if not python.exists():
        venv.create(home, with_pip=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "trimesh"], check=True)
    os.execv(python, [str(python), *sys.argv])


def main():
    import numpy
    import trimesh

    mesh = trimesh.load(FOLDER / "pebble.obj", process=False)
    mesh.density = DENSITY
    body = json.loads((FOLDER / "pebble.json").read_text())
    curve = [{k: float(v) for k, v in row.items()} for row in csv.DictReader((FOLDER / "curve.csv").open())]
    first, last = curve[0], curve[-1]
    tensor = numpy.array(body["inertia_kg_m2"])
    size = mesh.volume ** (1 / 3)
    lost = first["volume_m3"] - mesh.volume
    rows = [
        ("mass", abs(body["mass_kg"] / mesh.mass - 1)),
        ("centre, over the edge of a cube of the volume", numpy.linalg.norm(numpy.array(body["centre_m"]) - mesh.center_mass) / size),
        ("inertia", numpy.linalg.norm(tensor - mesh.moment_inertia) / numpy.linalg.norm(mesh.moment_inertia)),
        ("volume", abs(last["volume_m3"] / mesh.volume - 1)),
        ("volume lost, and sum of drops", abs(lost / last["charged_m3"] - 1)),
    ]
    print(f"trimesh {trimesh.__version__}: {len(mesh.vertices)} corners, volume {1e9 * mesh.volume:.2f} mm3")
    print(f"closed: {mesh.is_watertight}, facets turned alike: {mesh.is_winding_consistent}")
    for name, off in rows:
        print(f"{name}: off by {off:.1e}")
    sound = mesh.is_watertight and mesh.is_winding_consistent and mesh.volume > 0
    return 0 if sound and all(off < LIMIT for _, off in rows) else 1


if __name__ == "__main__":
    enter_environment()
    sys.exit(main())
