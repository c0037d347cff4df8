"""Runs a program on one core and says what wall and processor time it took."""

import os
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PLACE = ROOT / "target" / "peers"  # environments and results; git and the tests leave `target` out
CORE = "0"


@dataclass
class Taken:
    """Seconds of a whole process, and what it printed. `cpu` is little changed by other load."""

    wall: float
    cpu: float
    text: str


def run(command, folder=ROOT, environment=None, allowed=(0,)):
    """Runs `command` on one core; fails with its output on an exit code not in `allowed`."""
    with tempfile.TemporaryFile("w+") as output:
        began = time.perf_counter()
        child = subprocess.Popen(
            ["taskset", "-c", CORE, *map(str, command)],
            cwd=folder,
            env={**os.environ, **one_thread(), **(environment or {})},
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )
        _, status, used = os.wait4(child.pid, 0)
        wall = time.perf_counter() - began
        child.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read()
    if child.returncode not in allowed:
        raise SystemExit(f"{' '.join(map(str, command))}\n{text}\nexit code {child.returncode}")
    return Taken(wall, used.ru_utime + used.ru_stime, text)


def one_thread():
    return {"OMP_NUM_THREADS": "1", "RAYON_NUM_THREADS": "1"}


def least(times, *arguments, **named):
    """The run of `times` that took the least processor time."""
    return min((run(*arguments, **named) for _ in range(times)), key=lambda taken: taken.cpu)


def python_with(name, packages):
    """The folder of a virtual environment with `packages`, made if it is not there."""
    folder = PLACE / name
    done = folder / "installed"
    if not done.exists():
        subprocess.run(["python3", "-m", "venv", folder], check=True)
        subprocess.run([folder / "bin" / "pip", "install", "--quiet", *packages], check=True)
        done.touch()
    return folder


@dataclass
class Abrade:
    """The command, and the example that runs a scene again and again in one process."""

    command: Path
    warm: Path


def abrade():
    """Both, built."""
    place = ROOT / "target" / "release"
    for what in (["--bin", "abrade"], ["-p", "abrade-scene", "--example", "warm"]):
        subprocess.run(["cargo", "build", "--release", "--quiet", *what], cwd=ROOT, check=True)
    return Abrade(place / "abrade", place / "examples" / "warm")


def machine():
    """One line: processor, cores, load."""
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    load = "%.1f %.1f %.1f" % os.getloadavg()
    return f"{models[0] if models else 'unknown processor'}, {os.cpu_count()} cores, load {load}"


def table(head, rows):
    """A Markdown table on standard output."""
    rows = [[str(cell) for cell in row] for row in rows]
    widths = [max(len(row[i]) for row in [head, *rows]) for i in range(len(head))]
    line = lambda row: "| " + " | ".join(cell.ljust(w) for cell, w in zip(row, widths)) + " |"
    print(line(head))
    print("|" + "|".join("-" * (width + 2) for width in widths) + "|")
    for row in rows:
        print(line(row), flush=True)
    print()
