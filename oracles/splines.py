"""CubicSpline reference values (scipy) -> crates/trueaxis-machine/tests/data/splines.csv
Long format: kind "knot" rows list the table, kind "value" rows the value and the first derivative.
A second, own solution of the spline equations in mpmath checks scipy (difference printed)."""
import os
import random
import sys

import mpmath as mp
import numpy as np
from scipy.interpolate import CubicSpline

from model import header

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
DATA = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "..", "shared", "data")
OUT = os.path.join(ROOT, "crates", "trueaxis-machine", "tests", "data")


def mp_spline(x, y, periodic):
    """piecewise cubic coefficients by one dense linear system; returns f(t)->(value, derivative)"""
    n = len(x) - 1
    x, y = [mp.mpf(float(v)) for v in x], [mp.mpf(float(v)) for v in y]
    if n == 2 and not periodic:      # parabola through three points (scipy's not-a-knot rule for 3 knots)
        a = ((y[2] - y[0]) / (x[2] - x[0]) - (y[1] - y[0]) / (x[1] - x[0])) / (x[2] - x[1])
        b = (y[1] - y[0]) / (x[1] - x[0]) - a * (x[1] - x[0])
        return lambda t: (y[0] + b * (t - x[0]) + a * (t - x[0]) ** 2, b + 2 * a * (t - x[0]))
    A, r, row = mp.matrix(4 * n, 4 * n), mp.matrix(4 * n, 1), 0

    def put(i, d, t, sgn):
        for k in range(d, 4):
            f = 1
            for j in range(d):
                f *= k - j
            A[row, 4 * i + k] += sgn * f * t ** (k - d)
    for i in range(n):
        h = x[i + 1] - x[i]
        put(i, 0, mp.mpf(0), 1); r[row] = y[i]; row += 1
        put(i, 0, h, 1); r[row] = y[i + 1]; row += 1
    for i in range(n - 1):
        h = x[i + 1] - x[i]
        for d in (1, 2):
            put(i, d, h, 1); put(i + 1, d, mp.mpf(0), -1); row += 1
    if periodic:
        h = x[n] - x[n - 1]
        for d in (1, 2):
            put(n - 1, d, h, 1); put(0, d, mp.mpf(0), -1); row += 1
    else:
        for i in (0, n - 2):
            A[row, 4 * i + 3] += 1; A[row, 4 * (i + 1) + 3] -= 1; row += 1
    c = mp.lu_solve(A, r)

    def f(t):
        i = max(j for j in range(n) if x[j] <= t)
        u = t - x[i]
        a = c[4 * i:4 * i + 4]
        return a[0] + a[1] * u + a[2] * u ** 2 + a[3] * u ** 3, a[1] + 2 * a[2] * u + 3 * a[3] * u ** 2
    return f


def tables():
    rnd = random.Random(5)
    yield "nak3", [0, 1, 3], [1, -2, 5], False
    yield "nak4", [-10, -3, 0, 12], [0.5, -1.25, 0, 7], False
    yield "nak5_even", [0, 90, 180, 270, 360], [0, 4, -3, 1.5, 2], False
    yield "nak5_uneven", [0, 0.5, 7, 7.25, 40], [3, -1, 0, 2, 2], False
    x = list(np.round(np.cumsum([rnd.uniform(3, 60) for _ in range(20)]), 3))
    yield "nak20_uneven", x, [round(rnd.uniform(-8, 8), 2) for _ in x], False
    x = [i * 310.0 for i in range(20)]
    yield "nak20_even", x, [round(rnd.uniform(-8, 8), 1) for _ in x], False
    yield "per3", [0, 100, 360], [1, -2, 1], True
    yield "per4", [0, 120, 240, 360], [0, 5, -4, 0], True
    yield "per5_uneven", [-180, -100, 10, 30, 180], [2, 1, -1, 6, 2], True
    x = [0.0] + sorted(round(rnd.uniform(5, 355), 1) for _ in range(18)) + [360.0]
    y = [round(rnd.uniform(-8, 8), 1) for _ in x]
    y[-1] = y[0]
    yield "per20_uneven", x, y, True


def main():
    os.makedirs(OUT, exist_ok=True)
    worst = 0
    with open(os.path.join(OUT, "splines.csv"), "w") as fh:
        header(fh, "splines.py", "kind=knot: table x,y; kind=value: x, spline y, first derivative dydx (CubicSpline; values from the "
               "50-digit solution, scipy agrees to the printed difference)\nboundary: not-a-knot or periodic; 3 knots not-a-knot = parabola")
        fh.write("table,boundary,kind,x,y,dydx\n")
        rnd = random.Random(6)
        for name, x, y, per in tables():
            bc = "periodic" if per else "not-a-knot"
            s = CubicSpline(np.array(x, float), np.array(y, float), bc_type=bc)
            m = mp_spline(x, y, per)
            for a, b in zip(x, y):
                fh.write("%s,%s,knot,%r,%r,\n" % (name, bc, float(a), float(b)))
            ts = list(map(float, x)) + [float(round(rnd.uniform(x[i], x[i + 1]), 4)) for i in range(len(x) - 1) for _ in range(2)]
            for t in sorted(set(ts)):
                v, d = m(mp.mpf(t))
                sc = max(abs(np.array(y))) 
                worst = max(worst, abs(float(v) - float(s(t))) / sc, abs(float(d) - float(s(t, 1))) / (1 + abs(float(d))))
                fh.write("%s,%s,value,%r,%r,%r\n" % (name, bc, t, float(v), float(d)))
    print("worst relative difference scipy - mpmath", worst)


main()
