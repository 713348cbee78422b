#!/usr/bin/env python3
"""Probing performance: the example of ISO 230-10 and its figures by scipy.

    python3 oracles/iso230_10.py

Tools: Python 3.11.7, numpy 2.4.6, scipy 1.17.1 (optimize.least_squares on the geometric distances). Written from docs/model.md
(280) to (283), never from the Rust code. Writes examples/07_verify/probe-performance.csv (no real probe; seed 20261125) and
crates/trueaxis-standards/tests/data/iso230-10.json.
"""
import csv
import json

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import norm, t

DATA = "examples/07_verify/probe-performance.csv"
EXPECTED = "crates/trueaxis-standards/tests/data/iso230-10.json"
RING, SPHERE, BALL = 50.0012, 24.9987, 6.0


def travel(d):
    """Pre-travel by the direction of motion (unit vector): three lobes, more in the plane than along Z, mm."""
    a = np.arctan2(d[1], d[0])
    flat = np.hypot(d[0], d[1])
    return (6.0 + 2.5 * flat**3 * np.cos(3 * a) + 3.0 * flat**2) * 1e-3


def make():
    rng = np.random.default_rng(20261125)
    hit = lambda: 0.25e-3 * rng.normal(size=3)
    rows = []
    for axis in range(3):
        for sign in (1, -1):
            if (axis, sign) == (2, 1):
                continue
            d = np.zeros(3)
            d[axis] = sign
            for _ in range(10):
                p = np.array([100.0, 50.0, -200.0]) + d * travel(d) + hit()
                rows.append(("point", f"{'+' if sign > 0 else '-'}{'XYZ'[axis]}", "", *p))
    for _ in range(10):
        rows.append(("tool", "", "", *(np.array([10.0, 20.0, -150.0]) + 0.4e-3 * rng.normal(size=3))))
    for turn, offset in ((0, np.array([2.1e-3, -1.3e-3, 0])), (180, np.array([-2.1e-3, 1.3e-3, 0]))):
        for k in range(36):
            d = np.array([np.cos(k * np.pi / 18), np.sin(k * np.pi / 18), 0])
            # The spindle stands where the ball touches plus the pre-travel, less the offset of the ball.
            p = np.array([300.0, 200.0, -180.0]) + d * ((RING - BALL) / 2 + travel(d)) - offset + hit()
            rows.append(("ring", "", str(turn), *p))
    heights = [(90, 1), (67.5, 4), (45, 8), (22.5, 4), (0, 8)]
    for level, (height, count) in enumerate(heights):
        for k in range(count):
            a = 2 * np.pi * (k + 0.5 * (level % 2)) / count
            h = np.radians(height)
            out = np.array([np.cos(h) * np.cos(a), np.cos(h) * np.sin(a), np.sin(h)])
            p = np.array([400.0, 250.0, -170.0]) + out * (SPHERE + BALL) / 2 - out * travel(-out) + hit()
            rows.append(("sphere", "", "0", *p))
    with open(DATA, "w") as file:
        file.write("# made for this project by oracles/iso230_10.py; no real probe\n")
        file.write("test,direction,orientation_deg,x_mm,y_mm,z_mm\n")
        for test, direction, turn, x, y, z in rows:
            file.write(f"{test},{direction or '-'},{turn or 0},{x:.5f},{y:.5f},{z:.5f}\n")


def fit(points):
    start = np.append(points.mean(0), np.linalg.norm(points - points.mean(0), axis=1).mean())
    found = least_squares(lambda q: np.linalg.norm(points - q[:-1], axis=1) - q[-1], start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
    return found.x[:-1], found.x[-1], found.fun


def main():
    make()
    rows = list(csv.DictReader(r for r in open(DATA) if not r.startswith("#")))
    at = lambda keep: np.array([[float(r[k]) for k in ("x_mm", "y_mm", "z_mm")] for r in rows if keep(r)])
    expected, squares, free = {}, 0.0, 0
    for direction in ("+X", "-X", "+Y", "-Y", "-Z"):
        v = at(lambda r: r["test"] == "point" and r["direction"] == direction)[:, "XYZ".index(direction[1])]
        expected[f"repeatability along {direction}, range of 10 hits"] = np.ptp(v) * 1e3
        squares, free = squares + v.var() * len(v), free + len(v) - 1
    for k, axis in enumerate("XYZ"):
        v = at(lambda r: r["test"] == "tool")[:, k]
        expected[f"location of the probing tool along {axis}, range of 10 changes"] = np.ptp(v) * 1e3
    centres = []
    for turn in ("0", "180"):
        c, radius, left = fit(at(lambda r: r["test"] == "ring" and r["orientation_deg"] == turn)[:, :2])
        centres.append(c)
        expected[f"P_FTU,2D of ring at {turn}°"] = np.ptp(left) * 1e3
        expected[f"effective ball diameter by ring at {turn}°"] = (RING - 2 * radius) * 1e3
    expected["offset of the ball from the spindle"] = np.linalg.norm(centres[0] - centres[1]) / 2 * 1e3
    c, radius, left = fit(at(lambda r: r["test"] == "sphere"))
    expected["P_FTU,3D of sphere at 0°"] = np.ptp(left) * 1e3
    expected["effective ball diameter by sphere at 0°"] = (2 * radius - SPHERE) * 1e3
    s, k = np.sqrt(squares / free), t.ppf(norm.cdf(2), free)
    out = {"um": {name: float(v) for name, v in expected.items()}, "s_um": float(s * 1e3),
           "u_form_um": float(k * np.hypot(np.sqrt(2) * s, 0.1e-3) * 1e3)}
    with open(EXPECTED, "w") as file:
        json.dump(out, file, indent=1, ensure_ascii=False)
        file.write("\n")
    print(out)


main()
