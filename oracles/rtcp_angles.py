"""Readings for `trueaxis identify rtcp` with inclined rotary axes, from a kinematic model of its own.

tool     Python 3.11, without libraries
command  python3 oracles/rtcp_angles.py       (1 s, repository root)
writes   examples/05_identify/rtcp-angles-low.csv, -high.csv

Table-table machine `w C' A' b X Y Z t` of document 003 with ISO 841 senses, as in oracles/rtcp.py, each rotary axis
inclined by a small rotation before it turns:

    ball on the table p:   machine = a + R(eA) Rx(-A) (c + R(eC) Rz(-C) p)      RTCP on: the same with all errors 0

Truth (mm, urad): a = (0, 0.0312, -0.0245), c = (-0.0187, -0.0094, 0); EB0A 120, EC0A -85, EA0C 60, EB0C -150. Two balls,
at Z = -5 and Z = 65 mm of the workpiece frame (35 mm above the point where the axes meet), each 0.2 mm off the
place that is stated; RTCP on, the control set for no errors; noise 1 um, seed 20261124.
"""
import math
import os
import random

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
random.seed(20261124)
A0, C0 = (0.0, 0.0312, -0.0245), (-0.0187, -0.0094, 0.0)
EA, EC = (0.0, 120e-6, -85e-6), (60e-6, -150e-6, 0.0)


def about(axis, q):
    s, c = math.sin(q), math.cos(q)
    return {
        "x": lambda p: (p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]),
        "y": lambda p: (c * p[0] + s * p[2], p[1], -s * p[0] + c * p[2]),
        "z": lambda p: (c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]),
    }[axis]


def inclined(e, p):
    return about("x", e[0])(about("y", e[1])(about("z", e[2])(p)))


def add(p, q):
    return tuple(u + v for u, v in zip(p, q))


def machine(p, a, c, errors):
    p = about("z", -math.radians(c))(p)
    if errors:
        p = add(inclined(EC, p), C0)
    p = about("x", -math.radians(a))(p)
    return add(inclined(EA, p), A0) if errors else p


for name, ball, off in [
    ("low", (40.0, 0.0, -5.0), (0.11, -0.13, 0.09)),
    ("high", (-30.0, 20.0, 65.0), (-0.07, 0.12, 0.14)),
]:
    with open(os.path.join(ROOT, f"examples/05_identify/rtcp-angles-{name}.csv"), "w") as out:
        out.write("# made for this project by oracles/rtcp_angles.py (seed 20261124)\n")
        out.write("A_deg,C_deg,x_um,y_um,z_um\n")
        for a in (-90, -45, 0, 45, 90):
            for c in (0, 90, 180, 270):
                p = add(ball, (0.0, 0.0, 35.0))
                tool = machine(p, a, c, False)
                held = machine(add(p, off), a, c, True)
                read = [1e3 * (t - h) + random.gauss(0, 1.0) for t, h in zip(tool, held)]
                out.write(f"{a},{c}," + ",".join(f"{r:.4f}" for r in read) + "\n")
