"""Readings for `trueaxis identify rtcp` and the answer of another solver, from a kinematic model of its own.

tool     numpy 2.4.6, Python 3.11
command  python3 oracles/rtcp.py              (1 s, repository root)
writes   examples/05_identify/rtcp-engraver-c.csv, -c-rtcp.csv, -a.csv, -a-rtcp.csv
         crates/trueaxis/tests/data/rtcp-oracle.json

Table-table machine `w C' A' b X Y Z t` of document 003 with ISO 841 senses; machine coordinates are
those of the tip from the point where the axes meet. Only the equations of document 003 are used:

    tip on the table p, axes at A, C:   machine = a + Rx(-A) (c + Rz(-C) (p - c0))

a: place of the A axis, c: place of the C axis from it. The truth: A stands (0, 0.0312, -0.0245) mm
from where the control has it; C stands (-0.0187, -0.0094, 0) mm from where it should be on A.
Noise 1 um, seed 20261122.
"""
import json
import os

import numpy as np

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
DAY = np.random.default_rng(20261122)
A_TRUE = np.array([0.0, 0.0312, -0.0245])
C_TRUE = np.array([-0.0187, -0.0094, 0.0])
NOISE = 1e-3


def rx(q):
    c, s = np.cos(np.radians(q)), np.sin(np.radians(q))
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def rz(q):
    c, s = np.cos(np.radians(q)), np.sin(np.radians(q))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def ball(p, a, c, place_a, place_c):
    """Where a ball at p on the table (from the C axis) stands in the machine."""
    return place_a + rx(-a) @ (place_c + rz(-c) @ p)


def standing(spindle, p, poses):
    """RTCP off: tool - ball in machine directions; the spindle stands still."""
    return [(a, c, np.asarray(spindle) - ball(p, a, c, A_TRUE, C_TRUE)) for a, c in poses]


def with_rtcp(p, poses, has_a, has_c):
    """RTCP on with centres `has`: the control follows the ball where it believes it to be."""
    believed = np.round(p, 1)  # the ball was set up about there
    return [(a, c, ball(believed, a, c, has_a, has_c) - ball(p, a, c, A_TRUE, C_TRUE))
            for a, c in poses]


def write(name, head, rows):
    path = os.path.join(ROOT, "examples", "05_identify", name)
    with open(path, "w") as f:
        f.write("# made for this project by oracles/rtcp.py (numpy 2.4.6, seed 20261122)\n")
        f.write(head + "\n")
        f.writelines(",".join(f"{v:.9g}" for v in row) + "\n" for row in rows)


def main():
    turn = [0, 45, 90, 135, 180, 225, 270, 315]
    zero = np.zeros(3)
    noisy = lambda v: [1e3 * x for x in np.asarray(v) + NOISE * DAY.standard_normal(len(v))]
    # 1: a mandrel near the C axis, A at 0, the spindle at X = Y = 0, dial along X and Y.
    near = np.array([0.0113, -0.0207, 60.0])
    step1 = standing([0, 0, 60.0], near, [(0, c) for c in turn])
    # 2: with RTCP, a ball 40 mm out; step 1 is entered in the control (3 decimals).
    mean = np.mean([r[:2] for *_, r in step1], axis=0)
    has_c = np.round([-mean[0], -mean[1], 0], 3)
    out = np.array([40.013, 0.022, 30.011])
    step2 = with_rtcp(out, [(0, c) for c in turn], zero, has_c)
    # 3: A stands at +-90 and 0, a probe finds the ball: the axes are the reading.
    high = np.array([0.031, 25.017, 45.004])
    step3 = [(a, c, ball(high, a, c, A_TRUE, C_TRUE)) for a, c in [(-90, 0), (-45, 0), (0, 0), (45, 0), (90, 0)]]
    # 4: RTCP on, A from -90 to 90 and C turned; the numbers of step 2 in the control.
    step4 = with_rtcp(out, [(a, c) for a in (-90, -60, -30, 0, 30, 60, 90) for c in (0, 120, 240)],
                      zero, has_c)
    write("rtcp-engraver-c.csv", "C_deg,x_um,y_um", [[c, *noisy(r[:2])] for _, c, r in step1])
    write("rtcp-engraver-c-rtcp.csv", "C_deg,x_um,y_um,z_um", [[c, *noisy(r)] for _, c, r in step2])
    write("rtcp-engraver-a.csv", "A_deg,C_deg,X_mm,Y_mm,Z_mm",
          [[a, c, *np.round(q + NOISE * DAY.standard_normal(3), 4)] for a, c, q in step3])
    write("rtcp-engraver-a-rtcp.csv", "A_deg,C_deg,x_um,y_um,z_um",
          [[a, c, *noisy(r)] for a, c, r in step4])
    print("RTCP_OFFSET1_X, OFFSET2_Y after step 1:", has_c)
    solve(zero, has_c)


def table(name):
    path = os.path.join(ROOT, "examples", "05_identify", name)
    with open(path) as f:
        return [[float(v) for v in line.split(",")] for line in f.readlines()[2:]]


def solve(has_a, has_c):
    """Least squares over the files as they stand: centres and the four balls. Slopes by differences,
    which are exact here: everything is linear."""
    sets = [table("rtcp-engraver-" + n + ".csv") for n in ("c", "c-rtcp", "a", "a-rtcp")]
    said = [np.array(v, float) for v in ([0, 0, 60], [40, 0, 30], [0, 25, 45], [40, 0, 30])]

    def model(x):
        """Reading - model for every number, um; x: X of C, Y and Z of A, Y of C from A, balls."""
        place_a, place_c = np.array([0, x[1], x[2]]), np.array([x[0], x[3], 0])
        p = [said[k] + x[4 + 3 * k:7 + 3 * k] for k in range(4)]
        seen = lambda k, a, c: ball(p[k], a, c, place_a, place_c)
        out = []
        for c, *r in sets[0]:
            out += list(np.array(r) - 1e3 * (np.array([0, 0, 60]) - seen(0, 0, c))[:2])
        for c, *r in sets[1]:
            out += list(np.array(r) - 1e3 * (ball(said[1], 0, c, has_a, has_c) - seen(1, 0, c)))
        for a, c, *q in sets[2]:
            out += list(-1e3 * (np.array(q) - seen(2, a, c)))
        for a, c, *r in sets[3]:
            out += list(np.array(r) - 1e3 * (ball(said[3], a, c, has_a, has_c) - seen(3, a, c)))
        return np.array(out)

    at_zero = model(np.zeros(16))
    slopes = np.column_stack([model(row) - at_zero for row in np.eye(16)])
    x, _, rank, _ = np.linalg.lstsq(slopes, -at_zero, rcond=1e-9)
    # Noise 1 um; what no reading sees (heights in steps that turn C only) has no part here.
    covariance = np.linalg.pinv(slopes.T @ slopes, rcond=1e-12)
    chi = float(np.sum(model(x) ** 2))
    names = ["RTCP_OFFSET1_X", "RTCP_OFFSET1_Y", "RTCP_OFFSET1_Z", "RTCP_OFFSET2_Y"]
    found = {n: {"mm": float(x[k]), "u_mm": float(np.sqrt(covariance[k, k]))}
             for k, n in enumerate(names)}
    found.update(chi_square=chi, rank=int(rank), readings=len(at_zero))
    path = os.path.join(ROOT, "crates", "trueaxis", "tests", "data", "rtcp-oracle.json")
    with open(path, "w") as f:
        json.dump(found, f, indent=1)
        f.write("\n")
    print(found)


main()
