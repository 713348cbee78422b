"""Random splines through LinuxCNC's own functions -> crates/trueaxis-nc/tests/data/linuxcnc-splines.txt

usage: python3 oracles/linuxcnc_splines.py FOLDER
FOLDER: the source of LinuxCNC 2.9.9 (its `src`). `nurbs_additional_functions.cc` and, of `emccanon.cc`, the functions
from "Spline and NURBS additional functions" to NURBS_FEED are compiled with a main program that prints what they draw.
A program stands behind `program`; `arc` lines have end X Y, centre X Y and 1 for counter-clockwise, `line` lines the
end. Programs that `rs274` (LinuxCNC 2.9) refuses are left out.
"""
import os
import random
import subprocess
import sys
import tempfile

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis-nc", "tests", "data", "linuxcnc-splines.txt")

BEFORE = r"""
#include <cstdio>
#include <cmath>
#include <vector>
#include <algorithm>
struct CONTROL_POINT { double X, Y, W; };
struct PLANE_POINT { double X, Y; };
struct CANON_POSITION { double z, a, b, c, u, v, w; };
static struct { CANON_POSITION endPoint; } canon;
static CANON_POSITION unoffset_and_unrotate_pos(CANON_POSITION p) { return p; }
static void to_prog(CANON_POSITION&) {}
static void flush_segments() {}
static void ARC_FEED(int, double x, double y, double cx, double cy, int turn, double, double, double, double, double, double, double)
{ printf("arc %.9f %.9f %.9f %.9f %d\n", x, y, cx, cy, turn > 0); }
static void STRAIGHT_FEED(int, double x, double y, double, double, double, double, double, double, double)
{ printf("line %.9f %.9f\n", x, y); }
"""
AFTER = r"""
int main() {
    unsigned n, k;
    if (scanf("%u %u", &n, &k) != 2) return 1;
    std::vector<CONTROL_POINT> points(n);
    for (auto &p : points) if (scanf("%lf %lf %lf", &p.X, &p.Y, &p.W) != 3) return 1;
    NURBS_FEED(0, points, k);
}
"""


def compiled(source, folder):
    read = lambda *path: open(os.path.join(source, *path)).read()
    canon = read("emc", "task", "emccanon.cc")
    begin = canon.index("/* Spline and NURBS additional functions")
    end = canon.index("\n}\n", canon.index("void NURBS_FEED")) + 3
    nurbs = read("emc", "rs274ngc", "nurbs_additional_functions.cc").replace('#include "canon.hh"', "")
    text = os.path.join(folder, "splines.cc")
    with open(text, "w") as out:
        out.write(BEFORE + nurbs + canon[begin:end] + AFTER)
    program = os.path.join(folder, "splines")
    subprocess.run(["g++", "-O1", "-o", program, text], check=True)
    return program


def value(r):
    return round(r.uniform(-9, 9), 3)


def spline(r):
    """The blocks and the control points with their weights, by kind."""
    x, y = value(r), value(r)
    head = ["g21 g17 g90 g94 f100", f"g0 x{x} y{y}"]
    kind = r.choice(["g5", "g5.1", "g5.2", "g5.2"])
    u, v, w = (value(r), value(r)), (value(r), value(r)), (value(r), value(r))
    if kind == "g5":
        blocks = [f"g5 x{w[0]} y{w[1]} i{u[0]} j{u[1]} p{v[0]} q{v[1]}"]
        inner = [(x + u[0], y + u[1]), (w[0] + v[0], w[1] + v[1])]
        return head, [(blocks, 4, [(x, y, 1)] + [(a, b, 1) for a, b in inner] + [(*w, 1)])]
    if kind == "g5.1":
        blocks = [f"g5.1 x{w[0]} y{w[1]} i{u[0]} j{u[1]}"]
        return head, [(blocks, 3, [(x, y, 1), (x + u[0], y + u[1], 1), (*w, 1)])]
    order = r.choice([3, 3, 4, 5])
    weight = lambda: round(r.uniform(0.3, 3), 2)
    points = [(x, y, weight())] + [(value(r), value(r), weight()) for _ in range(order + r.randint(0, 6))]
    blocks = [f"g5.2 p{points[0][2]} l{order}"] + [f"x{a} y{b} p{c}" for a, b, c in points[1:]] + ["g5.3"]
    return head, [(blocks, order, points)]


def main():
    r = random.Random(17)
    lines = []
    with tempfile.TemporaryDirectory() as folder:
        program = compiled(sys.argv[1], folder)
        text = os.path.join(folder, "p.ngc")
        for _ in range(40):
            head, parts = spline(r)
            (blocks, order, points), = parts
            with open(text, "w") as out:
                out.write("\n".join(head + blocks + ["m2"]) + "\n")
            seen = subprocess.run(["rs274", "-g", text], capture_output=True, text=True, errors="replace", timeout=20).stdout
            if f"NURBS_FEED({len(points)}, " not in seen:
                continue
            given = f"{len(points)} {order}\n" + "\n".join("%r %r %r" % p for p in points)
            drawn = subprocess.run([program], input=given, capture_output=True, text=True, check=True).stdout
            lines += ["program", *head, *blocks, "drawn", *drawn.split("\n")[:-1]]
    with open(OUT, "w") as out:
        out.write("\n".join(lines) + "\n")
    print(lines.count("program"), "splines")


main()
