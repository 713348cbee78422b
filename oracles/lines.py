"""Line profiles, each line where it fits best, ISO 1101 -> crates/trueaxis-part/tests/data/lines.json

usage: python3 oracles/lines.py     (25 s)
Written with numpy, scipy (`pip install numpy scipy`).

A hole and a cone along Z with 4 sections of 12 points, whose datum (a plane across Z) leaves shifts in X and Y; a plane with 5 rows of 9
points along X at z = 20 mm, whose datum (a hole along Y through x = 20, z = -30 mm) leaves a turn about its axis. Deviations along the normals
(mm) at random. Each line moves by itself to where its largest distance from the nominal line, in its plane, is least; twice the largest of all
lines is the value. Found by Nelder-Mead with restarts, for the plane by bounded search; no random motion near it may be better."""
import json
import os

import numpy as np
from scipy.optimize import minimize, minimize_scalar

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis-part", "tests", "data", "lines.json")
rng = np.random.default_rng(1101)
EDGE = 0.25


def section(radius, radial):
    """The least of the largest distance of a section from its circle over both shifts."""
    angle = 2 * np.pi * np.arange(len(radial)) / len(radial)
    places = (radius + radial)[:, None] * np.c_[np.cos(angle), np.sin(angle)]

    def off(c):
        return np.abs(np.hypot(*(places - c).T) - radius).max()

    x, value = np.zeros(2), off(np.zeros(2))
    for _ in range(60):
        result = minimize(off, x + rng.normal(0, value / 10, 2), method="Nelder-Mead", options={"xatol": 1e-13, "fatol": 1e-14, "maxiter": 4000, "initial_simplex": x + value / 3 * np.array([[0, 0], [1, 0], [0, 1]])})
        if result.fun < value:
            x, value = result.x, result.fun
    least = min(off(x + d) for d in rng.normal(0, value / 30, (20_000, 2)))
    assert least > value - 1e-10, (least, value)
    return value


def row(x, off):
    """The same of a row at z = 20 over the turn about Y through x = 20, z = -30."""
    def largest(t):
        c, s = np.cos(t), np.sin(t)
        # Seen from the datum: turned back about the axis.
        dx, dz = x - 20, 20 + off + 30
        return np.abs(-s * dx + c * dz - 30 - 20).max()

    result = minimize_scalar(largest, bounds=(-1e-3, 1e-3), method="bounded", options={"xatol": 1e-15, "maxiter": 2000})
    fine = min(largest(t) for t in result.x + np.linspace(-1e-7, 1e-7, 20_001))
    assert fine > result.fun - 1e-9
    return min(fine, result.fun)


def numbers(rows, points):
    return rng.uniform(-5e-3, 5e-3, (rows, points))


cases = []
for _ in range(4):
    hole = numbers(4, 12)
    # Material of a hole points to its axis.
    cases.append({"of": "hole", "datum": "base", "deviation_mm": hole.ravel().tolist(), "value_mm": 2 * max(section(10.0, -r) for r in hole)})
    cone = numbers(4, 12)
    # Radii 30 to 10 mm on 20 mm of height, the normal at 45 degrees.
    slant = np.hypot(20.0, 20.0)
    radii = [30 - 20 * s for s in np.linspace(EDGE / 20, 1 - EDGE / 20, 4)]
    cases.append({"of": "cone", "datum": "base", "deviation_mm": cone.ravel().tolist(), "value_mm": 2 * max(section(r, d * slant / 20) for r, d in zip(radii, cone))})
    top = numbers(5, 9)
    x = np.linspace(-50 + EDGE, 50 - EDGE, 9)
    cases.append({"of": "top", "datum": "pin", "deviation_mm": top.ravel().tolist(), "value_mm": 2 * max(row(x, d) for d in top)})
with open(OUT, "w") as file:
    json.dump({"cases": cases}, file, indent=1)
    file.write("\n")
print([c["value_mm"] for c in cases])
