"""Cutter locations for the examples, made for this project -> examples/06_compensate/bangle.cls and blade.cls

usage: python3 oracles/cutter_locations.py
tool: Python 3.11 alone. Points on two free-form surfaces, tool axes by central differences.
"""
import math
import os

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "examples", "06_compensate")


def unit(v):
    n = math.sqrt(sum(x * x for x in v))
    return [x / n for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def surface(shape, u, v, lean):
    """Point and tool axis: the outward normal, raised towards +z by `lean` degrees."""
    h = 1e-6
    p = shape(u, v)
    du = [(a - b) / (2 * h) for a, b in zip(shape(u + h, v), shape(u - h, v))]
    dv = [(a - b) / (2 * h) for a, b in zip(shape(u, v + h), shape(u, v - h))]
    n = unit(cross(du, dv))
    s, c = math.sin(math.radians(lean)), math.cos(math.radians(lean))
    return p, unit([c * n[0], c * n[1], c * n[2] + s])


def bangle(u, v):
    """An oval, waved ring about z, 31 mm by 28 mm, 12 mm high; v in mm."""
    wave = 0.5 * math.sin(6 * u + 0.35 * v) + 0.25 * math.cos(9 * u - 0.5 * v)
    bulge = 0.9 * math.cos(math.pi * (v - 6) / 14)
    r = 31.0 / math.hypot(math.cos(u), 31.0 / 28.0 * math.sin(u)) + wave + bulge
    return [r * math.cos(u), r * math.sin(u), v]


def blade(u, v):
    """A twisted, tapering aerofoil along z, 70 mm by 14 mm at the root, 110 mm high."""
    taper = 1.0 - 0.35 * v / 110.0
    x = 35.0 * taper * math.cos(u)
    y = 7.0 * taper * math.sin(u) + 4.0 * math.cos(u) ** 2
    twist = math.radians(28.0) * v / 110.0
    c, s = math.cos(twist), math.sin(twist)
    return [c * x - s * y, s * x + c * y, v]


def points(shape, turns, per_turn, low, high, lean):
    count = turns * per_turn
    for k in range(count + 1):
        u = 2 * math.pi * k / per_turn
        yield surface(shape, u, high + (low - high) * k / count, lean)


def write_bangle():
    lines = [
        "PARTNO BANGLE, FREE FORM, MADE FOR THIS PROJECT",
        "REMARK oracles/cutter_locations.py",
        "UNITS / MM",
        "LOADTL / 3",
        "CUTTER / 1.000000, 0.500000",
        "MULTAX / ON",
        "SPINDL / RPM, 30000.000000,  CLW",
        "COOLNT / MIST",
        "RAPID",
    ]
    all_points = list(points(bangle, 5, 240, 1.0, 11.0, 18.0))
    for k, (p, a) in enumerate(all_points):
        if k == 0:
            above = [x + 5.0 * y for x, y in zip(p, a)]
            lines += go_creo(above, a)
            lines.append("FEDRAT / 300.000000,  MMPM")
        if k == 1:
            lines.append("FEDRAT / 1500.000000,  MMPM")
        lines += go_creo(p, a)
    p, a = all_points[-1]
    lines.append("RAPID")
    lines += go_creo([x + 5.0 * y for x, y in zip(p, a)], a)
    lines += ["COOLNT / OFF", "SPINDL / OFF", "FINI"]
    save("bangle.cls", lines)


def go_creo(p, a):
    return [
        "GOTO / %.7f, %.7f, %.7f,  $" % tuple(p),
        "%.10f, %.10f, %.10f" % tuple(a),
    ]


def write_blade():
    lines = [
        "$$ oracles/cutter_locations.py",
        "PARTNO BLADE, MADE FOR THIS PROJECT",
        "UNITS/MM",
        "TPRINT/T1 BALL 10",
        "LOADTL/1,1",
        "MULTAX/ON",
        "SPINDL/12000,RPM,CLW",
        "COOLNT/ON",
        "RAPID",
    ]
    all_points = list(points(blade, 4, 96, 15.0, 105.0, 50.0))
    for k, (p, a) in enumerate(all_points):
        if k == 1:
            lines.append("FEDRAT/2500.,MMPM")
        lines.append("GOTO  /%.6f,%.6f,%.6f,%.9f,%.9f,%.9f" % (*p, *a))
    lines += ["SPINDL/OFF", "COOLNT/OFF", "FINI"]
    save("blade.cls", lines)


def save(name, lines):
    with open(os.path.join(OUT, name), "w") as file:
        file.write("\n".join(lines) + "\n")


write_bangle()
write_blade()
