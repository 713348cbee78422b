"""A thin bangle, its blank and its cutter locations -> examples/06_compensate/bangle-adapt.cls, bangle-measured.csv, bangle-blank.csv
and examples/04_plan/bangle-nominal.csv, bangle-true.csv

usage: python3 oracles/bangle.py
tool: Python 3.11 alone. The nominal surface is that of cutter_locations.py. The blank is that surface with an
analytic form error of at most 0.1 mm along the normal, then set 0.03 mm off and turned by 0.3 mrad. Where
the rays along the nominal normals meet it is found by Newton's method; nothing of the Rust code is used.
"""
import math
import os
import random

from cutter_locations import bangle, cross, unit

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "examples", "06_compensate")
PLAN = os.path.join(ROOT, "examples", "04_plan")
LAYER, RADIUS, LEAN = 0.15, 4.0, 25.0
HIGH, LOW, TURNS, PER_TURN = 8.3, 3.9, 11, 240
SHIFT, TURN = [0.020, 0.025, 0.008], [2e-4, -1e-4, 1.5e-4]
NOISE = 0.0015


def wave(u, v):
    return (
        0.055 * math.cos(2 * u + 0.4)
        + 0.030 * math.cos(3 * u - 1.0 + 0.25 * (v - 6))
        + 0.018 * math.cos(4 * u + 0.30 * v)
        + 0.010 * math.sin(0.5 * v) * math.cos(4 * u - 0.5)
    )


def peak():
    steps = [(2 * math.pi * i / 720, 4.4 + 3.2 * j / 40) for i in range(720) for j in range(41)]
    return max(abs(wave(u, v)) for u, v in steps)


PEAK = peak()


def form(u, v):
    """The unknown form error, mm: 0.1 mm at its worst where it is cut."""
    return -0.1 * wave(u, v) / PEAK


def nominal(u, v):
    h = 1e-5
    p = bangle(u, v)
    du = [(a - b) / (2 * h) for a, b in zip(bangle(u + h, v), bangle(u - h, v))]
    dv = [(a - b) / (2 * h) for a, b in zip(bangle(u, v + h), bangle(u, v - h))]
    return p, unit(cross(du, dv))


def turned(p):
    """Rodrigues about the part zero."""
    angle = math.sqrt(sum(x * x for x in TURN))
    k = [x / angle for x in TURN]
    c, s = math.cos(angle), math.sin(angle)
    kxp, kp = cross(k, p), sum(a * b for a, b in zip(k, p))
    return [c * p[i] + s * kxp[i] + (1 - c) * kp * k[i] for i in range(3)]


def blank(u, v):
    p, n = nominal(u, v)
    return [a + b for a, b in zip(turned([x + form(u, v) * y for x, y in zip(p, n)]), SHIFT)]


def solve3(m, b):
    """Cramer; the rows of m are the equations."""
    det = lambda a: sum(x * y for x, y in zip(a[0], cross(a[1], a[2])))
    d = det(m)
    put = lambda k: [[b[i] if j == k else m[i][j] for j in range(3)] for i in range(3)]
    return [det(put(k)) / d for k in range(3)]


def meets(u, v):
    """How far along the nominal normal at (u, v) the blank is, mm."""
    p, n = nominal(u, v)
    a, b, s, h = u, v, 0.0, 1e-5
    for _ in range(50):
        at = blank(a, b)
        gap = [at[i] - p[i] - s * n[i] for i in range(3)]
        ja = [(x - y) / (2 * h) for x, y in zip(blank(a + h, b), blank(a - h, b))]
        jb = [(x - y) / (2 * h) for x, y in zip(blank(a, b + h), blank(a, b - h))]
        step = solve3([[ja[i], jb[i], -n[i]] for i in range(3)], [-g for g in gap])
        a, b, s = a + step[0], b + step[1], s + step[2]
        if max(abs(x) for x in step) < 1e-9:
            return s
    raise ArithmeticError("no intersection")


def table(name, lines, cells, noise):
    random.seed(20261122)
    for k, (u, v, chip) in enumerate(cells):
        p, n = nominal(u, v)
        d = meets(u, v) + (random.gauss(0.0, noise) if noise else 0.0) + chip
        lines.append("%d,%.5f,%.5f,%.5f,%.7f,%.7f,%.7f,%.2f" % (k + 1, *p, *n, d * 1e3))
    with open(os.path.join(OUT, name), "w") as file:
        file.write("\n".join(lines) + "\n")


HEAD = "point,x_mm,y_mm,z_mm,i,j,k,deviation_um"


def write_measured():
    cells = []
    for row in range(7):
        for column in range(48):
            u = 2 * math.pi * (column + 0.5 * (row % 2)) / 48
            # One chip of swarf under the stylus.
            cells.append((u, 3.0 + row, 0.07 if (row, column) == (3, 17) else 0.0))
    lines = ["# oracles/bangle.py: the blank as probed, noise 1.5 um, a chip at point 162", HEAD]
    table("bangle-measured.csv", lines, cells, NOISE)


def write_blank():
    cells = [(2 * math.pi * (c + 0.5) / 72, 4.4 + 0.32 * r, 0.0) for r in range(11) for c in range(72)]
    lines = ["# oracles/bangle.py: the true blank, which is not known in practice, for the virtual cut", HEAD]
    table("bangle-blank.csv", lines, cells, 0.0)


def write_to_probe():
    """Points to be probed with the normals of the formula, and the true blank along them."""
    head = "# oracles/bangle.py: "
    nominals = [head + "points of the nominal bangle with their outward normals", "point,x_mm,y_mm,z_mm,i,j,k"]
    trues = [head + "the true blank along these normals, which is not known in practice: for virtual probing", HEAD]
    for row in range(15):
        for column in range(96):
            u, v = 2 * math.pi * (column + 0.5 * (row % 2)) / 96, 2.5 + 0.5 * row
            p, n = nominal(u, v)
            cells = "%d,%.6f,%.6f,%.6f,%.9f,%.9f,%.9f" % (row * 96 + column + 1, *p, *n)
            nominals.append(cells)
            trues.append(cells + ",%.3f" % (meets(u, v) * 1e3))
    for name, lines in (("bangle-nominal.csv", nominals), ("bangle-true.csv", trues)):
        with open(os.path.join(PLAN, name), "w") as file:
            file.write("\n".join(lines) + "\n")


def write_path():
    lines = [
        "PARTNO THIN BANGLE, MADE FOR THIS PROJECT",
        "REMARK oracles/bangle.py: 0.15 mm below the nominal blank",
        "UNITS/MM",
        "LOADTL/4",
        "CUTTER/8.,4.",
        "MULTAX/ON",
        "SPINDL/RPM,24000.,CLW",
        "COOLNT/MIST",
        "RAPID",
    ]
    s, c = math.sin(math.radians(LEAN)), math.cos(math.radians(LEAN))
    count, goto = TURNS * PER_TURN, lambda p, a: "GOTO/%.6f,%.6f,%.6f,%.7f,%.7f,%.7f" % (*p, *a)
    for k in range(count + 1):
        p, n = nominal(2 * math.pi * k / PER_TURN, HIGH + (LOW - HIGH) * k / count)
        a = unit([c * n[0], c * n[1], c * n[2] + s])
        tip = [x + (RADIUS - LAYER) * y - RADIUS * z for x, y, z in zip(p, n, a)]
        if k == 0:
            lines += [goto([x + 5.0 * y for x, y in zip(tip, a)], a), "FEDRAT/200.,MMPM"]
        if k == 1:
            lines.append("FEDRAT/1200.,MMPM")
        lines.append(goto(tip, a))
    lines += ["RAPID", goto([x + 5.0 * y for x, y in zip(tip, a)], a), "COOLNT/OFF", "SPINDL/OFF", "FINI"]
    with open(os.path.join(OUT, "bangle-adapt.cls"), "w") as file:
        file.write("\n".join(lines) + "\n")


write_measured()
write_blank()
write_to_probe()
write_path()
