"""The place of a pattern of holes as a whole, ISO 5458:2018 -> crates/trueaxis-part/tests/data/pattern.json

usage: python3 oracles/pattern.py     (1 s)
Written with numpy, scipy (`pip install numpy scipy`).

Holes with axes along Z on the places below, each moved as a whole by its own vector (mm). A datum plane across Z leaves the pattern two
shifts and a turn: the position is twice the least of the largest distance of an axis from its nominal place over these three, each axis a
point in the plane. Found by SLSQP on the bound from 40 starts; then 10^6 random motions about the result may not be better."""
import json
import os

import numpy as np
from scipy.optimize import minimize

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis-part", "tests", "data", "pattern.json")
rng = np.random.default_rng(5458)


def off(x, places, moved):
    """Distances of the axes from the pattern that is turned about the origin and shifted."""
    c, s = np.cos(x[2]), np.sin(x[2])
    turned = places @ np.array([[c, s], [-s, c]])
    return np.linalg.norm(moved - turned - x[:2], axis=1)


def best(places, moved):
    found = None
    for _ in range(40):
        x0 = np.r_[rng.normal(0, 5e-3, 2), rng.normal(0, 1e-4)]
        scale = np.array([1, 1, 1e-2])

        def bound(y):
            return y[3] - off(y[:3] * scale, places, moved)

        start = np.r_[x0 / scale, off(x0, places, moved).max()]
        result = minimize(
            lambda y: y[3] * 1e3, start, constraints={"type": "ineq", "fun": lambda y: bound(y) * 1e3},
            method="SLSQP", options={"ftol": 1e-15, "maxiter": 2000})
        x = result.x[:3] * scale
        value = off(x, places, moved).max()
        if found is None or value < found[0]:
            found = (value, x)
    value, x = found
    tries = x + rng.normal(size=(20_000, 3)) * np.array([1e-4, 1e-4, 1e-6])
    least = min(off(t, places, moved).max() for t in tries)
    assert least > value - 1e-9, (least, value)
    return 2 * value


cases = []
for count, kind in [(4, "circle"), (6, "circle"), (6, "grid"), (9, "grid"), (2, "circle")]:
    if kind == "circle":
        angle = 2 * np.pi * np.arange(count) / count
        places = 40 * np.c_[np.cos(angle), np.sin(angle)]
    else:
        rows = count // 3
        places = np.array([[20.0 * i, 15.0 * k] for k in range(rows) for i in range(3)])
    moved = places + rng.uniform(-8e-3, 8e-3, places.shape)
    cases.append({
        "kind": kind,
        "count": count,
        "offsets_mm": (moved - places).tolist(),
        "position_mm": best(places, moved),
    })
with open(OUT, "w") as file:
    json.dump({"cases": cases}, file, indent=1)
    file.write("\n")
print([c["position_mm"] for c in cases])
