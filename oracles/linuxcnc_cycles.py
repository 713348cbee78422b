"""Random drilling cycles and polar words through LinuxCNC's interpreter -> crates/trueaxis-nc/tests/data/linuxcnc-cycles.txt

usage: python3 oracles/linuxcnc_cycles.py
tool: rs274 of LinuxCNC 2.9.0~pre1+git20230208.f1270d6ed7 (Debian 12, `linuxcnc-uspace`)
A program stands behind `program`, its end points (X Y Z, mm, without repetitions) behind `points`. Programs that LinuxCNC
refuses are left out. G85 and G89 are: this version retracts them past R at feed, later ones in two moves.
"""
import os
import random
import re
import subprocess
import tempfile

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis-nc", "tests", "data", "linuxcnc-cycles.txt")
CYCLES = ["g81", "g82 p0.5", "g83 q{}", "g73 q{}", "g86 p0.1"]


def program(r):
    lines = ["g21 g17 g90 g94 f100 s100 m3", "g0 x%d y%d z%d" % (r.randint(-5, 5), r.randint(1, 6), r.randint(3, 12))]
    for _ in range(r.randint(4, 12)):
        kind = r.random()
        if kind < 0.12:
            lines.append(r.choice(["g90", "g91", "g98", "g99", "g80"]))
        elif kind < 0.22:
            polar = ["@%d ^%d" % (r.randint(1, 9), r.randint(0, 359)), "^%d" % r.randint(0, 359)]
            lines.append("g0 " + r.choice(["x%d" % r.randint(-9, 9), "z%d" % r.randint(3, 12), *polar]))
        else:
            # Depths of peck that divide no depth: the last peck would depend on rounding.
            words = [r.choice(CYCLES).format(r.randint(5, 30) / 10 + 0.013)] if r.random() < 0.5 else []
            words += ["z-%d" % r.randint(1, 6)] if r.random() < 0.93 else []
            words += ["r%d" % r.randint(-1, 3)] if r.random() < 0.93 else []
            words.append(r.choice(["x%d" % r.randint(-3, 3)] * 3 + ["^%d" % r.randint(1, 90), "@%d" % r.randint(1, 3), "y2"]))
            words += ["l%d" % r.randint(1, 4)] if r.random() < 0.2 else []
            lines.append(" ".join(words))
    return lines + ["m2"]


def points(text):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "p.ngc")
        with open(path, "w", encoding="ascii") as file:
            file.write(text)
        ran = subprocess.run(["rs274", "-g", path], cwd=folder, capture_output=True, text=True, check=False)
    if ran.returncode:
        return None
    found = []
    for words in re.findall(r"STRAIGHT_\w+\(([^)]*)\)", ran.stdout):
        point = " ".join(word.strip() for word in words.split(",")[:3])
        if not found or found[-1] != point:
            found.append(point)
    return found


def main():
    out, kept, seed = [], 0, 20261123
    while kept < 120:
        seed += 1
        lines = program(random.Random(seed))
        ends = points("\n".join(lines) + "\n")
        if ends:
            kept += 1
            out += ["program", *lines, "points", *ends]
    os.makedirs(os.path.dirname(OUT), exist_ok=True)
    with open(OUT, "w", encoding="ascii") as file:
        file.write("\n".join(out) + "\n")


main()
