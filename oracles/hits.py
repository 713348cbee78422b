"""Hits of a probe on the true bangle by another chain -> examples/05_identify/bangle-points.csv, bangle-hits.log,
and crates/trueaxis-cli/tests/data/bangle-hits.csv (the true deviations)

usage: python3 oracles/hits.py DATA     (DATA: the folder of shared data with machines/i5-engraver.json)
tool: Python, numpy, scipy, mpmath. The chain with its errors is that of model.py (4x4 matrices), the pre-travel that of
probe.py (stylus "long"), the points and the true blank those of bangle.py. Rotary axes are drawn at random, so that
the probe is hit from all sides. Nothing of the Rust code is used.
"""
import math
import os
import sys

import mpmath as mp
import numpy as np
from scipy.optimize import brentq

import model

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
EXAMPLE = os.path.join(ROOT, "examples", "05_identify")
DATA = os.path.join(ROOT, "crates", "trueaxis-cli", "tests", "data")
OFFSET, RADIUS, COUNT = np.array([0.0200, 0.0080, 0.0]), 1.0, 40


def travel(u):
    level, rise, around = math.hypot(u[0], u[1]), u[2], math.atan2(u[1], u[0])
    return 1.6e-3 * (15 + 4 * rise**2 + 10 * level**3 * math.cos(3 * around - math.radians(60))
                     + 2 * level * rise * math.cos(around))


def frame(machine, q, nominal):
    """Tip and the three directions of the tool in the workpiece."""
    base = np.array([float(x) for x in machine.tip])
    at = []
    for step in ([0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]):
        machine.tip = list(base + np.array(step))
        at.append(np.array([float(x) for x in machine.pose(q, nominal)[0]]))
    machine.tip = list(base)
    return at[0], np.array([a - at[0] for a in at[1:]]).T


def main():
    rng = np.random.default_rng(20261123)
    machine = model.json_machine(sys.argv[1], "i5-engraver")
    mp.mp.dps = 25
    rows = [line.strip() for line in open(os.path.join(ROOT, "examples/04_plan/bangle-true.csv"))
            if line[0].isdigit()]
    picked = sorted(rng.choice(len(rows), COUNT, replace=False))
    surface, true, log = ["point,x_mm,y_mm,z_mm,i,j,k"], ["point,deviation_um"], ["TRUEAXIS HITS MM MACHINE"]
    for number, row in enumerate(picked, 1):
        cells = [float(x) for x in rows[row].split(",")]
        p, n, d = np.array(cells[1:4]), np.array(cells[4:7]), cells[7] * 1e-3
        while True:
            q = dict(A=round(rng.uniform(-120, 120), 5), C=round(rng.uniform(-180, 180), 5), X=0, Y=0, Z=0)
            tip, tool = frame(machine, q, True)
            if 0.1 < tool[:, 2] @ n:
                break
        # The nominal chain is linear in X, Y, Z.
        jacobian = np.array([frame(machine, {**q, a: 1}, True)[0] - tip for a in "XYZ"]).T
        start = np.linalg.solve(jacobian, p + (RADIUS + 2.0) * n - tip)
        along = np.linalg.solve(jacobian, -n)
        at = lambda s: {**q, **dict(zip("XYZ", start + s * along))}

        def gap(s):
            tip, tool = frame(machine, at(s), False)
            return (tip + tool @ OFFSET - p) @ n - d - RADIUS

        s = brentq(gap, 1.0, 3.0, xtol=1e-9)
        s += travel(frame(machine, at(s), False)[1].T @ -n)
        end = at(s)
        surface.append("%d,%.6f,%.6f,%.6f,%.9f,%.9f,%.9f" % (number, *p, *n))
        true.append("%d,%.3f" % (number, d * 1e3))
        words = " ".join("%s%.4f" % (a, end[a]) for a in "XYZ")
        log.append("H%d K%d T5 %s A%.5f C%.5f" % (number, number, words, q["A"], q["C"]))
    log.append("END %d" % COUNT)
    files = ((EXAMPLE, "bangle-points.csv", surface), (EXAMPLE, "bangle-hits.log", log), (DATA, "bangle-hits.csv", true))
    for folder, name, lines in files:
        with open(os.path.join(folder, name), "w") as file:
            file.write("# made for this project by oracles/hits.py; no real probe\n" + "\n".join(lines) + "\n")


main()
