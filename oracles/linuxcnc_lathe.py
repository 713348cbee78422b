"""Random profiles through LinuxCNC's turning cycles G70 to G72.2 -> crates/trueaxis-nc/tests/data/linuxcnc-lathe.txt

usage: python3 oracles/linuxcnc_lathe.py
tool: rs274 of LinuxCNC 2.9.0~pre1+git20230208.f1270d6ed7 (Debian 12, `linuxcnc-uspace`)
A program comes after `program`, its moves after `moves`: R and F (rapid, feed) with X Z, A (arc) with X Z, the centre
X Z and 1 for counter-clockwise as X is seen to the right of Z, -1 otherwise; in mm, without those that lead nowhere.
`refused`: the control ends with an error. Programs on which it crashes or does not end are counted at the end and left out.
"""
import concurrent.futures
import os
import random
import re
import subprocess
import tempfile

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis-nc", "tests", "data", "linuxcnc-lathe.txt")
KINDS = ["shaft", "bore", "pockets", "face", "finish", "steps", "written"]
WANTED = 40


def num(value):
    return ("%.4f" % value).rstrip("0").rstrip(".")


class Profile:
    """Elements along u, out v; `word` writes them in the axes of the machine."""

    def __init__(self, r, facing, along, out):
        self.r, self.facing, self.along, self.out = r, facing, along, out
        self.u, self.v = 0.0, round(r.uniform(4, 8), 2)
        self.base = round(r.uniform(-3, 3), 2)
        self.first = (self.u, self.v)
        self.lines = []
        self.highest = self.v

    def place(self, u, v):
        a, b = self.along * u + self.base, self.out * v + (30 if self.out < 0 else 0)
        return (a, b) if self.facing else (b, a)  # X, Z

    def put(self, code, u, v, more=""):
        (x, z), (x0, z0) = self.place(u, v), self.place(self.u, self.v)
        words = []
        if abs(x - x0) > 1e-9 or self.r.random() < 0.5:
            words.append("x" + num(x))
        if abs(z - z0) > 1e-9 or not words:
            words.append("z" + num(z))
        self.r.shuffle(words)
        self.lines.append(" ".join([code, *words]) + more)
        self.u, self.v = u, v
        self.highest = max(self.highest, v)

    def element(self, lowest, rise, arcs):
        r = self.r
        u = round(self.u + r.choice([0, r.uniform(0.2, 6), r.uniform(2, 9)]), 2)
        v = round(max(lowest, self.v + r.choice([0, r.uniform(*rise), r.uniform(*rise)])), 2)
        if (u, v) == (self.u, self.v):
            return
        chord = ((u - self.u) ** 2 + (v - self.v) ** 2) ** 0.5
        if arcs and r.random() < 0.35 and chord > 0.5:
            self.put(r.choice(["g2", "g3"]), u, v, " r" + num(chord * r.uniform(0.51, 3) + 0.01))
        else:
            self.put("g1", u, v)


def program(r, kind):
    facing = kind == "face" or kind == "finish" and r.random() < 0.4
    along, out = r.choice([(-1, 1)] * 3 + [(1, 1), (-1, -1), (1, -1)])
    if facing:
        along, out = r.choice([(1, 1), (1, -1), (-1, 1), (-1, -1)])
    if kind == "bore":
        out = -1
    p = Profile(r, facing, along, out)
    p.put("g0", p.u, p.v)
    lowest = 1.0
    rise = (0.1, 4) if kind in ("shaft", "bore", "steps") else (-4, 4.5)
    for _ in range(r.randint(2, 9)):
        p.element(lowest, rise, kind not in ("steps", "written"))
    if p.v < p.first[1] or r.random() < 0.4:
        p.put("g1", round(p.u + r.uniform(0, 3), 2), round(p.first[1] + r.uniform(0, 5), 2))
    if kind == "written":
        p.lines[1:-1] = [line + r.choice(["", "", " a%s" % num(r.uniform(0.05, 0.8)), " c%s" % num(r.uniform(0.05, 0.8))])
                         for line in p.lines[1:-1]]
    start = p.place(-r.uniform(0.5, 4), p.highest + r.uniform(-1 if r.random() < 0.15 else 0.5, 5))
    leave = r.choice([0, 0.2, 0.5, r.uniform(0.1, 1), r.uniform(-0.6, -0.2)])
    if kind == "finish":
        call = "g70 q%d d%s e%s p%d" % (1, num(leave), num(r.choice([0, leave / 2])), r.randint(1, 3))
    else:
        which = r.choice([".1", ".2", "", ""])
        call = "g7%d%s q1 i%s" % (2 if facing else 1, which, num(r.uniform(0.4, 3)))
        call += " d" + num(leave) if leave else ""
        call += " r" + num(r.uniform(0.1, 1.5)) if r.random() < 0.8 else ""
    at = " x%s z%s" % (num(start[0]), num(start[1]))
    head = "g21 g18 g90 g8 g40 f100"
    before = "g0 x%s z%s" % (num(start[0] + 3 * out * (not facing)), num(start[1] + 1))
    if r.random() < 0.3:
        before, at = before + "\ng0" + at, ""
    return [head, *before.split("\n"), "o1 sub", *p.lines, "o1 endsub", call + at, "x50 z50", "m2"]


def moves(text):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "p.ngc")
        with open(path, "w", encoding="ascii") as file:
            file.write(text)
        try:
            ran = subprocess.run(["rs274", "-g", path], cwd=folder, capture_output=True, text=True, check=False, timeout=3)
        except subprocess.TimeoutExpired:
            return "endless"
    if ran.returncode:
        return "refused" if ran.returncode == 1 else "crashed"
    found, last = [], None
    for name, words in re.findall(r"(STRAIGHT_\w+|ARC_FEED)\(([^)]*)\)", ran.stdout):
        v = [word.strip() for word in words.split(",")]
        if name == "ARC_FEED":
            line, end = "A %s %s %s %s %s" % (v[1], v[0], v[3], v[2], v[4]), (v[1], v[0])
        else:
            line, end = "%s %s %s" % ("R" if "TRAVERSE" in name else "F", v[0], v[2]), (v[0], v[2])
        if end != last:
            found.append(line)
        last = end
    return found


def one(seed):
    kind = KINDS[seed % len(KINDS)]
    lines = program(random.Random(seed), kind)
    text = "\n".join(lines) + "\n"
    found = moves(text)
    # A busy machine lets a good program fail now and then.
    return kind, lines, moves(text) if found in ("crashed", "endless") else found


def main():
    out, kept, left = [], dict.fromkeys(KINDS, 0), {"crashed": 0, "endless": 0}
    refused = 0
    seeds = range(20261123, 20261123 + WANTED * len(KINDS) * 4)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for kind, lines, found in pool.map(one, seeds):
            if isinstance(found, str) and found in left:
                left[found] += 1
            elif found == "refused":
                refused += 1
                if refused <= WANTED:
                    out += ["program", *lines, "refused"]
            elif kept[kind] < WANTED and found:
                kept[kind] += 1
                out += ["program", *lines, "moves", *found]
    os.makedirs(os.path.dirname(OUT), exist_ok=True)
    with open(OUT, "w", encoding="ascii") as file:
        file.write("\n".join(out) + "\n")
    print(kept, "refused", refused, left)


main()
