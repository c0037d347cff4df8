"""What optional parts of the core cost a scene that does not use them.

Counts the instructions of an impact without any part, line by line, inlined code with its own
lines, and sums those of the lines that are there for a part: the questions whether it is used, and
the zeros that it adds. Calls of such code from lines that have no word of it are not among them.
Needs valgrind and addr2line (Debian: apt install valgrind binutils).

    python3 crates/abrade/benches/off.py [--lines PART]
"""

import collections
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[1] / "src"
# Per part: files that are all its own, and what its lines in the others are told by.
PARTS = {
    "energy ledger": (["ledger.rs"], r"ledger|booked|\bspent\b|\bbooks\b|carriers_energy"),
    "friction": ([], r"friction|tangential|\bstretch|slip\b"),
    "lateral flow": ([], r"\blateral\b|heading"),
    "restitution": (["damping.rs", "patch/dashpots.rs"], r"is_damped|self\.damping|apply_halves"),
    "adhesion": (["adhesion.rs"], r"\bglue|attraction|adheres|drawn|given_over"),
    "Archard's law": (["archard.rs"], r"archard"),
    "hardness map": ([], r"hardness_map|slot\.factor|hardness \* factor"),
    "observer": ([], r"observe|kept_ledger"),
    "watch of sunk nodes": (["sunk.rs"], r"note_sunk"),
    "moving surface": (["carrier.rs", "ride.rs"], r"surfaces_rest|\bmoves\b|\brides?\b|mounts|answers|carrier|motion_below|give_back"),
    "led body": ([], r"is_immovable|is_guided|led_limit|\bguide\b"),
}
# Lines of other files that have such a word, and are needed without the part: signatures, structures
# that are built whole, names of constants and of arguments.
SHARED = re.compile(r"\bfn |Motion \{|Charge \{|InnerLoop \{|Round \{|::<RUBS|limits\.fold")


def count(binary, shape):
    """Instructions per (file, line) of the core below an advance of `shape`, and their sum."""
    with tempfile.NamedTemporaryFile() as out:
        subprocess.run(
            ["valgrind", "--tool=callgrind", "--dump-instr=yes", f"--callgrind-out-file={out.name}",
             "--toggle-collect=*Encounter*advance*", binary, shape, "nothing"],
            capture_output=True, check=True)
        costs = addresses(out.name)
    own = {at: cost for (file, at), cost in costs.items() if file == binary}
    lines = collections.Counter()
    for at, where in places(binary, own).items():
        lines[where] += own[at]
    return lines, sum(costs.values())


def addresses(path):
    """Instructions per (object file, address) of callgrind's output, without those of calls."""
    costs, names, file, at, is_call = collections.Counter(), {}, None, 0, False
    for line in open(path):
        if match := re.match(r"(c?ob)=\((\d+)\)(?: (.*))?", line):
            kind, key, name = match.groups()
            names.setdefault(key, name)
            file = names[key] if kind == "ob" else file
        elif line.startswith("calls="):
            is_call = True
        elif match := re.match(r"(0x|\+|-|\*)(\w*) \S+ (\d+)", line):
            sign, digits, cost = match.groups()
            step = 0 if sign == "*" else int(digits, 16 if sign == "0x" else 0)
            at = {"0x": step, "+": at + step, "-": at - step, "*": at}[sign]
            if not is_call:
                costs[file, at] += int(cost)
            is_call = False
    return costs


def places(binary, own):
    """The innermost (file, line) of the core that every address belongs to."""
    asked = "\n".join(map(hex, own))
    answer = subprocess.run(["addr2line", "-a", "-i", "-e", binary],
                            input=asked, capture_output=True, text=True, check=True).stdout
    found, at = {}, None
    for line in answer.splitlines():
        if line.startswith("0x"):
            at = int(line, 16)
        elif at not in found and (match := re.search(r"crates/abrade/src/(\S+):(\d+)", line)):
            found[at] = (match[1], int(match[2]))
    return found


def lines_of(part, lines):
    """The lines that are there for `part`, with what they cost and their text."""
    files, words = PARTS[part]
    for (file, number), cost in lines.items():
        text = (SOURCE / file).read_text().splitlines()[number - 1].strip()
        if file in files or (re.search(words, text) and not SHARED.search(text)):
            yield cost, f"{file}:{number} {text}"


def main():
    environment = os.environ | {"CARGO_PROFILE_BENCH_DEBUG": "line-tables-only"}
    command = ["cargo", "bench", "-p", "abrade", "--bench", "pay", "--no-run"]
    told = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    binary = str(pathlib.Path(re.search(r"Executable.*\((.*)\)", told.stderr)[1]).resolve())
    shapes = subprocess.run([binary], capture_output=True, text=True, check=True).stdout
    counts = {shape: count(binary, shape) for shape in re.search("shapes: (.*)", shapes)[1].split()}
    print(f"{'part':22}", *(f"{shape:>8}" for shape in counts))
    for part in PARTS:
        shares = (sum(cost for cost, _ in lines_of(part, lines)) / total
                  for lines, total in counts.values())
        print(f"{part:22}", *(f"{100 * share:6.2f} %" for share in shares))
    if sys.argv[1:2] == ["--lines"]:
        for shape, (lines, total) in counts.items():
            for cost, text in sorted(lines_of(sys.argv[2], lines), reverse=True):
                print(f"{shape} {100 * cost / total:5.2f} % {text}")


main()
