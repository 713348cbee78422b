#!/usr/bin/env python3
"""Geometric tests by other software, and the examples of ISO 230-1.

    python3 oracles/iso230_1.py [MOODY_FOLDER]

Tools: Python 3.11.7, numpy 2.4.6 (lstsq with dummy variables), scipy 1.17.1 (linprog, HiGHS: minimum zones). Written from
docs/model.md (273) to (278), never from the Rust code. Writes crates/trueaxis-standards/tests/data/iso230-1.json,
and the made readings straightness-x-level.csv, straightness-x-reversal.csv, squareness-xy.csv of examples/07_verify.
With MOODY_FOLDER (Moody_data of https://github.com/ballen4705/Moody-Method, commit ec65bcf) also
examples/07_verify/moody-1955.csv: the readings that J. C. Moody printed in The Tool Engineer, October 1955, with the two
misprints corrected that are named there, and the heights that the worksheets give (gnuplot.dat of that folder).
"""
import csv
import json
import sys

import numpy as np
from scipy.optimize import linprog

EXAMPLES = "examples/07_verify/"
EXPECTED = "crates/trueaxis-standards/tests/data/iso230-1.json"
STEP = 101.6  # 4 in
CORNER = {"NW": (0, 10), "NE": (16, 10), "SE": (16, 0), "SW": (0, 0), "E": (16, 5), "W": (0, 5), "N": (8, 10), "S": (8, 0)}
LINES = ["NW_SE", "NE_SW", "NE_NW", "NE_SE", "SE_SW", "NW_SW", "E_W", "N_S"]


def zone(columns, h):
    """Smallest range of h − columns·p: linear programming."""
    n, k = columns.shape
    scale = np.abs(h).max() or 1.0
    a = np.vstack([np.hstack([-columns, -np.ones((n, 1)), np.zeros((n, 1))]),
                   np.hstack([columns, np.zeros((n, 1)), np.ones((n, 1))])])
    # low ≤ h − Cp ≤ high; minimise high − low
    c = np.concatenate([np.zeros(k), [1.0, -1.0]])
    found = linprog(c, A_ub=a, b_ub=np.concatenate([-h, h]) / scale, bounds=[(None, None)] * (k + 2), method="highs",
                    options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10})
    return found.fun * scale


def least_squares(columns, h):
    full = np.hstack([columns, np.ones((len(h), 1))])
    r = h - full @ np.linalg.lstsq(full, h, rcond=None)[0]
    return r.max() - r.min(), r


def union_jack(steps, base):
    """Heights of the nodes from steps (line, from, to, angle); each line has its own zero."""
    nodes, lines = [], []
    index = lambda p: next((i for i, q in enumerate(nodes) if np.hypot(q[0] - p[0], q[1] - p[1]) < 0.01), None)
    for line, a, b, _ in steps:
        for p in (a, b):
            if index(p) is None:
                nodes.append(p)
        if line not in lines:
            lines.append(line)
    m = np.zeros((len(steps), len(nodes) + len(lines)))
    for i, (line, a, b, _) in enumerate(steps):
        m[i, index(b)] += 1 / base
        m[i, index(a)] -= 1 / base
        m[i, len(nodes) + lines.index(line)] = 1
    y = np.array([s[3] for s in steps])
    h = np.linalg.lstsq(m, y, rcond=1e-12)[0]
    left = y - m @ h
    redundant = len(steps) - np.linalg.matrix_rank(m)
    at = np.array(nodes)
    _, r = least_squares(at, h[: len(nodes)])
    s = np.sqrt(np.sum(left**2) / redundant) if redundant else None
    return at, r, s, redundant, m


def moody(folder):
    steps, published = [], {}
    for line in LINES:
        angles = [float(v) for v in open(f"{folder}/{line}.txt") if not v.startswith("#")]
        a, b = (np.array(CORNER[n], float) for n in line.split("_"))
        points = [(a + (b - a) * k / len(angles)) * STEP for k in range(len(angles) + 1)]
        for k, angle in enumerate(angles):
            steps.append((line, tuple(points[k]), tuple(points[k + 1]), angle))
    block = None
    for row in open(f"{folder}/gnuplot.dat"):
        if row.startswith("#") and row.strip().endswith(".txt"):
            block = row.split()[1][:-4]
            published[block] = []
        elif row.strip() and not row.startswith("#") and block:
            x, y, h = map(float, row.split())
            published[block].append([x * STEP, y * STEP, h * 1e-5 * 25400])
    with open(EXAMPLES + "moody-1955.csv", "w") as out:
        out.write("# J. C. Moody, How to calibrate surface plates in the plant, The Tool Engineer, October 1955\n")
        out.write("# 4 in between the feet; two misprints corrected as https://github.com/ballen4705/Moody-Method says\n")
        out.write("line,from_x_mm,from_y_mm,to_x_mm,to_y_mm,angle_arcsec\n")
        for line, a, b, angle in steps:
            out.write(f"{line},{a[0]:.2f},{a[1]:.2f},{b[0]:.2f},{b[1]:.2f},{angle:g}\n")
    return published


def read_moody():
    rows = list(csv.DictReader(r for r in open(EXAMPLES + "moody-1955.csv") if not r.startswith("#")))
    value = lambda r, k: float(r[k])
    return [(r["line"], (value(r, "from_x_mm"), value(r, "from_y_mm")), (value(r, "to_x_mm"), value(r, "to_y_mm")),
             np.radians(value(r, "angle_arcsec") / 3600)) for r in rows]


def surface(steps):
    at, r, s, redundant, m = union_jack(steps, STEP)
    corners = [np.argmin(np.hypot(at[:, 0] - x, at[:, 1] - y)) for x, y in
               [(at[:, 0].min(), at[:, 1].min()), (at[:, 0].max(), at[:, 1].min()), (at[:, 0].min(), at[:, 1].max())]]
    plane = np.linalg.solve(np.hstack([at[corners], np.ones((3, 1))]), r[corners])
    three = r - np.hstack([at, np.ones((len(r), 1))]) @ plane
    return {
        "nodes": [[*map(float, p), float(v * 1e3)] for p, v in zip(at, r)],
        "least_squares_um": float((r.max() - r.min()) * 1e3),
        "minimum_zone_um": float(zone(at, r) * 1e3),
        "three_points_um": float((three.max() - three.min()) * 1e3),
        "s_urad": None if s is None else float(s * 1e6),
        "redundant": int(redundant),
    }


def made():
    rng = np.random.default_rng(20261124)
    x = np.arange(0, 1001, 100.0)
    true = lambda x: 6e-3 * np.sin(x / 1000 * np.pi) + 1.5e-3 * np.sin(x / 1000 * 4 * np.pi)
    with open(EXAMPLES + "straightness-x-level.csv", "w") as out:
        out.write("# made for this project by oracles/iso230_1.py: a level with a base of 100 mm; two runs; EZX of 6 um\n")
        out.write("position_mm,run,angle_urad\n")
        for run in (1, 2):
            for a, b in zip(x[:-1], x[1:]):
                angle = (true(b) - true(a)) / 100 * 1e6 + 35 + 1.0 * rng.normal()
                out.write(f"{a:g},{run},{angle:.1f}\n")
    edge = lambda x: 5e-3 * np.sin(x / 1000 * 2 * np.pi) - 3e-3 * x / 1000
    with open(EXAMPLES + "straightness-x-reversal.csv", "w") as out:
        out.write("# made for this project by oracles/iso230_1.py: EYX of 6 um against a straightedge that is 10 um out\n")
        out.write("position_mm,setup,deviation_um\n")
        for setup, sign in (("normal", 1), ("reversed", -1)):
            for p in x:
                d = (true(p) + sign * edge(p)) * 1e3 + 12 * p / 1000 + 0.3 * rng.normal()
                out.write(f"{p:g},{setup},{d:.2f}\n")
    with open(EXAMPLES + "squareness-xy.csv", "w") as out:
        out.write("# made for this project by oracles/iso230_1.py: EC0Y = 30 urad; a square that is 12 urad out of square\n")
        out.write("axis,position_mm,setup,deviation_um\n")
        for setup, square in (("normal", 12e-6), ("reversed", -12e-6)):
            tilt = rng.normal() * 40e-6
            for p in np.arange(0, 301, 50.0):
                out.write(f"X,{p:g},{setup},{tilt * p * 1e3 + 0.3 * rng.normal():.2f}\n")
            for p in np.arange(0, 301, 50.0):
                # Y turned by +EC0Y moves to −X.
                d = -(30e-6 + square + tilt) * p * 1e3
                out.write(f"Y,{p:g},{setup},{d + 0.3 * rng.normal():.2f}\n")


def random_lines():
    rng = np.random.default_rng(7)
    cases = []
    for n in (3, 4, 7, 20, 60):
        x = np.sort(rng.uniform(0, 900, n)).round(3)
        h = (rng.normal(size=n) * 3e-3 + x * 2e-5).round(6)
        least, _ = least_squares(x[:, None], h)
        cases.append({"x_mm": x.tolist(), "h_um": (h * 1e3).tolist(), "minimum_zone_um": zone(x[:, None] / 900, h) * 1e3,
                      "least_squares_um": least * 1e3})
    planes = []
    for n in (4, 5, 9, 30, 120):
        at = rng.uniform(0, 800, (n, 2)).round(3) if n != 9 else np.array([[x, y] for x in (0, 1, 2) for y in (0, 1, 2)]) * 100.0
        h = (rng.normal(size=n) * 4e-3 + at @ [1e-5, -3e-5]).round(6)
        least, _ = least_squares(at, h)
        planes.append({"at_mm": at.tolist(), "h_um": (h * 1e3).tolist(), "minimum_zone_um": zone(at / 800, h) * 1e3,
                       "least_squares_um": least * 1e3})
    return {"lines": cases, "planes": planes}


def main():
    made()
    expected = random_lines()
    if len(sys.argv) > 1:
        published = moody(sys.argv[1])
        # The two centre lines are shifted in the worksheets; the six others close exactly.
        expected["moody_published_um"] = [p for line in LINES[:6] for p in published[line]]
    else:
        expected["moody_published_um"] = json.load(open(EXPECTED))["moody_published_um"]
    steps = read_moody()
    expected["moody_eight_lines"] = surface(steps)
    expected["moody_six_lines"] = surface([s for s in steps if s[0] not in ("E_W", "N_S")])
    with open(EXPECTED, "w") as out:
        json.dump(expected, out, indent=1)
        out.write("\n")
    for name in ("moody_eight_lines", "moody_six_lines"):
        print(name, {k: v for k, v in expected[name].items() if k != "nodes"})


main()
