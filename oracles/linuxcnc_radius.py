"""Random contours with cutter radius compensation through LinuxCNC's interpreter -> crates/trueaxis-nc/tests/data/linuxcnc-radius.txt

usage: python3 oracles/linuxcnc_radius.py [COUNT [SEED]]      (default: 500 contours, as committed)
tool: rs274 of LinuxCNC 2.9.0~pre1+git20230208.f1270d6ed7 (Debian 12, package linuxcnc-uspace)
Lines, arcs, rapids, moves along the tool axis in between, in G17 and G18, left and right, entry on a line or an arc, off
and on again. Behind
`program` stands the program, behind `calls` what LinuxCNC makes of it (R rapid, L line: X Y Z; A arc: first and second coordinate of
the end and of the centre, turns, third coordinate; mm), or `error` with its message. Of a program with an error the calls before it
are not kept.
"""
import math
import os
import random
import re
import subprocess
import sys
import tempfile

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
DATA = os.path.join(ROOT, "crates", "trueaxis-nc", "tests", "data", "linuxcnc-radius.txt")


def word(value):
    return f"{value:.6f}".rstrip("0").rstrip(".")


def contour(rng):
    """One program: a random chain of elements with its entry and exit."""
    plane = rng.choice(["G17", "G17", "G18"])
    first, second, third = ("X", "Y", "Z") if plane == "G17" else ("Z", "X", "Y")
    centre = {"X": "I", "Y": "J", "Z": "K"}
    side = rng.choice(["G41.1", "G42.1"])
    diameter = rng.choice([1, 2, 4, 6])
    lines = [f"G21 {plane} G90 G40 F500", f"G0 {first}0 {second}0 {third}5", f"{side} D{diameter}"]
    here = [0.0, 0.0]
    heading = rng.uniform(0, 2 * math.pi)

    def go(code, length):
        here[0] += length * math.cos(heading)
        here[1] += length * math.sin(heading)
        here[:] = [round(v, 6) for v in here]
        lines.append(f"{code} {first}{word(here[0])} {second}{word(here[1])}")

    def arc(radius, sweep, tangent):
        """About a centre on the left (sweep > 0) of the heading, which first turns if not tangential."""
        nonlocal heading
        if not tangent:
            heading += rng.uniform(-2.5, 2.5)
        sign = 1 if sweep > 0 else -1
        c = [here[0] - sign * radius * math.sin(heading), here[1] + sign * radius * math.cos(heading)]
        c = [round(v, 6) for v in c]
        r = math.hypot(here[0] - c[0], here[1] - c[1])
        start = math.atan2(here[1] - c[1], here[0] - c[0])
        end = [round(c[0] + r * math.cos(start + sweep), 6), round(c[1] + r * math.sin(start + sweep), 6)]
        helix = f" {third}{word(rng.uniform(-3, 3))}" if rng.random() < 0.15 else ""
        i, j = c[0] - here[0], c[1] - here[1]
        code = "G3" if sign > 0 else "G2"
        lines.append(f"{code} {first}{word(end[0])} {second}{word(end[1])} {centre[first]}{word(i)} {centre[second]}{word(j)}{helix}")
        here[:] = end
        heading += sweep

    if rng.random() < 0.15:
        arc(rng.uniform(diameter, 20), rng.choice([-1, 1]) * rng.uniform(0.5, 2.5), True)
    else:
        go(rng.choice(["G0", "G1"]), rng.uniform(diameter * 0.4, 25))
    for _ in range(rng.randint(2, 9)):
        what = rng.random()
        if what < 0.5:
            heading += rng.choice([rng.uniform(-2.8, 2.8), rng.uniform(-0.1, 0.1), math.pi / 2, -math.pi / 2])
            go(rng.choice(["G1", "G1", "G1", "G0"]), rng.uniform(2, 25))
        elif what < 0.85:
            sweep = rng.choice([-1, 1]) * rng.choice([rng.uniform(0.3, 3), math.pi / 2, rng.uniform(3, 4.5)])
            arc(rng.uniform(1.5, 15), sweep, rng.random() < 0.5)
        else:
            lines.append(f"G1 {third}{word(rng.uniform(-5, 5))}")
    if rng.random() < 0.15:
        # Off and on again, with or without a move in between.
        lines.append("G40")
        if rng.random() < 0.5:
            go(rng.choice(["G0", "G1"]), rng.uniform(3, 20))
        lines.append(f"{rng.choice(['G41.1', 'G42.1'])} D{rng.choice([1, 2, 4])}")
        heading += rng.uniform(-2, 2)
        for _ in range(rng.randint(2, 4)):
            go(rng.choice(["G0", "G1"]), rng.uniform(5, 20))
            heading += rng.uniform(-2, 2)
    if rng.random() < 0.9:
        lines.append("G40")
        heading += rng.uniform(-2, 2)
        go(rng.choice(["G0", "G1"]), rng.uniform(3, 20))
    return "\n".join(lines + ["M2"]) + "\n"


def calls(text, folder):
    path = os.path.join(folder, "p.ngc")
    with open(path, "w", encoding="ascii") as file:
        file.write(text)
    ran = subprocess.run(["rs274", "-g", path], cwd=folder, capture_output=True, text=True, check=False)
    if ran.returncode != 0:
        message = [line for line in (ran.stderr + ran.stdout).splitlines() if line.strip()]
        known = ("gouging", "entry", "not less than", "corner", "BUG", "same center", "radius")
        told = [line for line in message if any(k in line for k in known) and "N....." not in line]
        return "error\n" + (told or message)[-1].strip() + "\n"
    found = []
    for name, inside in re.findall(r"(STRAIGHT_TRAVERSE|STRAIGHT_FEED|ARC_FEED)\(([^)]*)\)", ran.stdout):
        n = [v.strip() for v in inside.split(",")]
        if name == "ARC_FEED":
            found.append(" ".join(["A", *n[:4], n[4], n[5]]))
        else:
            found.append(" ".join(["R" if name == "STRAIGHT_TRAVERSE" else "L", *n[:3]]))
    return "calls\n" + "\n".join(found) + "\n"


def main():
    count, seed = (int(sys.argv[1]) if len(sys.argv) > 1 else 500, int(sys.argv[2]) if len(sys.argv) > 2 else 17)
    rng = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder, open(DATA, "w", encoding="ascii") as out:
        for _ in range(count):
            text = contour(rng)
            out.write("program\n" + text + calls(text, folder))


if __name__ == "__main__":
    main()
