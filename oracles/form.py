"""Elements through points in space by other software -> crates/trueaxis-form/tests/data/form.json

usage: python3 oracles/form.py
Least squares: scipy.optimize.least_squares (MINPACK's lm, own parametrisation, best of several starts). Minimum zone: of a
profile all pairs of the convex hull; of planes all face-vertex and edge-edge pairs of scipy.spatial.ConvexHull (exact); of spheres
all sets of five contact points (exact); of cylinders, cones and lines in space SLSQP on the epigraph from 40 starts (the best
that was found). Circumscribed and inscribed: all sets of contact points for spheres, SLSQP for cylinders."""
import itertools
import json
import os

import numpy as np
from scipy.optimize import least_squares, minimize
from scipy.spatial import ConvexHull

from model import versions

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis-form", "tests", "data")
R = np.random.default_rng(2026)


def turn():
    q = R.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def placed(p):
    return np.round(p @ turn().T + R.uniform(-300, 300, size=3), 9)


def ring(n):
    return np.arange(n) * 2 * np.pi / n + 0.1


# --- deviations of each element, x: position, direction, sizes
def axis_dev(p, x):
    d = x[3:6] / np.linalg.norm(x[3:6])
    v = p - x[:3]
    h = v @ d
    return np.linalg.norm(v - np.outer(h, d), axis=1), h


def dev(kind, p, x):
    if kind == "sphere":
        return np.linalg.norm(p - x[:3], axis=1) - x[3]
    if kind == "plane":
        return (p - x[:3]) @ (x[3:6] / np.linalg.norm(x[3:6]))
    rho, h = axis_dev(p, x)
    if kind == "line":
        return rho
    if kind == "cylinder":
        return rho - x[6]
    return (rho - x[6]) * np.cos(x[7]) - h * np.sin(x[7])


def fit_least(kind, p, x0):
    if kind == "line":
        def f(x):
            d = x[3:6] / np.linalg.norm(x[3:6])
            v = p - x[:3]
            return (v - np.outer(v @ d, d)).ravel()
    else:
        f = lambda x: dev(kind, p, x)
    best = None
    for k in range(6):
        start = x0 + (R.normal(size=len(x0)) * 1e-3 if k else 0)
        r = least_squares(f, start, x_scale=np.maximum(np.abs(x0), 1.0), xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=20000)
        if best is None or r.cost < best.cost:
            best = r
    return best.x, float(np.sqrt(2 * best.cost))


def minimax(kind, p, x0, what, starts=40):
    """SLSQP on the epigraph, in mm about the start; the best of several starts."""
    scale = np.abs(dev(kind, p, x0)).max()
    free = [i for i in range(len(x0)) if not (kind in ("cylinder", "line") and i == 6)]
    if what in ("mcc", "mic") or kind == "line":
        free = [i for i in range(len(x0)) if i != 6]
    length = np.ptp(p, axis=0).max()
    unit = np.array([length if 3 <= i < 6 or i == 7 else 1.0 for i in free])

    def g(y):
        x = x0.copy()
        x[free] += y * scale / unit
        return dev(kind, p, x) / scale

    best = np.inf
    for k in range(starts):
        y0 = R.normal(size=len(free)) * (0.7 if k else 0)
        v = g(y0)
        if what == "mzc":
            z0 = np.concatenate([y0, [v.max(), v.min()]])
            obj = lambda z: z[-2] - z[-1]
            con = [{"type": "ineq", "fun": lambda z: z[-2] - g(z[:-2])}, {"type": "ineq", "fun": lambda z: g(z[:-2]) - z[-1]}]
        elif what == "mcc":
            z0 = np.concatenate([y0, [v.max()]])
            obj = lambda z: z[-1]
            con = [{"type": "ineq", "fun": lambda z: z[-1] - g(z[:-1])}]
        else:
            z0 = np.concatenate([y0, [v.min()]])
            obj = lambda z: -z[-1]
            con = [{"type": "ineq", "fun": lambda z: g(z[:-1]) - z[-1]}]
        r = minimize(obj, z0, constraints=con, method="SLSQP", options={"maxiter": 500, "ftol": 1e-15})
        y = r.x[: len(free)]
        w = g(y)
        value = {"mzc": np.ptp(w), "mcc": w.max(), "mic": -w.min()}[what]
        best = min(best, value)
    offset = x0[6] if kind == "cylinder" and what != "mzc" else 0.0
    value = best * scale
    return float(value + offset if what == "mcc" else (offset - value if what == "mic" else value))


# --- exact ones
def strip(p2):
    h = p2[ConvexHull(p2).vertices]
    best = np.inf
    for i in range(len(h)):
        d = h[(i + 1) % len(h)] - h[i]
        n = np.array([-d[1], d[0]]) / np.linalg.norm(d)
        best = min(best, np.ptp(p2 @ n))
    return float(best)


def slab(p):
    hull = ConvexHull(p)
    best = np.inf
    edges = set()
    for s in hull.simplices:
        for a, b in itertools.combinations(sorted(s), 2):
            edges.add((a, b))
        n = np.cross(p[s[1]] - p[s[0]], p[s[2]] - p[s[0]])
        best = min(best, np.ptp(p @ n) / np.linalg.norm(n))
    for e, f in itertools.combinations(edges, 2):
        n = np.cross(p[e[1]] - p[e[0]], p[f[1]] - p[f[0]])
        l = np.linalg.norm(n)
        if l > 1e-9:
            best = min(best, np.ptp(p @ n) / l)
    return float(best)


def equidistant(pairs, p):
    a = np.array([2 * (p[j] - p[i]) for i, j in pairs])
    b = np.array([p[j] @ p[j] - p[i] @ p[i] for i, j in pairs])
    try:
        return np.linalg.solve(a, b)
    except np.linalg.LinAlgError:
        return None


def sphere_exact(p, near):
    m = p.mean(axis=0)
    q = p - m
    zone = inner = -np.inf
    zone = np.inf
    outer = np.inf
    n = len(q)
    for five in itertools.combinations(range(n), 5):
        for k in (1, 2, 3, 4):
            for outs in itertools.combinations(five, k):
                ins = [i for i in five if i not in outs]
                pairs = [(outs[0], o) for o in outs[1:]] + [(ins[0], i) for i in ins[1:]]
                c = equidistant(pairs, q)
                if c is None or np.linalg.norm(c - near + m) > 2.0:
                    continue
                zone = min(zone, np.ptp(np.linalg.norm(q - c, axis=1)))
    for i, j in itertools.combinations(range(n), 2):
        outer = min(outer, np.linalg.norm(q - (q[i] + q[j]) / 2, axis=1).max())
    for t in itertools.combinations(range(n), 3):
        a, b = q[t[1]] - q[t[0]], q[t[2]] - q[t[0]]
        x = np.linalg.lstsq(np.array([2 * a, 2 * b, np.cross(a, b)]), np.array([a @ a, b @ b, 0]), rcond=None)[0]
        outer = min(outer, np.linalg.norm(q - (q[t[0]] + x), axis=1).max())
    for f in itertools.combinations(range(n), 4):
        c = equidistant([(f[0], i) for i in f[1:]], q)
        if c is None:
            continue
        d = np.linalg.norm(q - c, axis=1)
        outer = min(outer, d.max())
        # Inside: c in the tetrahedron of its contacts, and no point nearer.
        w = np.linalg.solve(np.vstack([q[list(f)].T, np.ones(4)]), np.append(c, 1))
        if (w >= -1e-12).all() and d.min() >= d[f[0]] - 1e-9:
            inner = max(inner, d[f[0]])
    return float(zone), float(outer), float(inner)


def cases():
    for n, form in ((12, 0.01), (40, 0.5)):
        t = np.linspace(0, 100, n)
        local = np.column_stack([t, np.zeros(n), form * np.sin(t / 13) + R.normal(0, form / 5, n)])
        p = np.round(local, 9)
        x0 = np.array([50, 0, 0, 1, 0, 0, 0], float)
        _, s = fit_least("line", p, x0)
        yield dict(name=f"profile_{n}", element="line", normal=[0, 1, 0], points=p.tolist(), lsc_norm=s, mzc=strip(p[:, [0, 2]]))
    for n, form in ((20, 0.02), (40, 1.0)):
        p = placed(np.column_stack([R.normal(0, form, n), R.normal(0, form, n), np.linspace(-80, 80, n)]))
        x0 = np.concatenate([p.mean(axis=0), p[-1] - p[0], [0]])
        x, s = fit_least("line", p, x0)
        yield dict(name=f"space_line_{n}", element="line", points=p.tolist(), lsc_norm=s, mzc=2 * minimax("line", p, x, "mcc"))
    for n, form in ((9, 0.01), (30, 0.005), (25, 5.0)):
        xy = R.uniform(-50, 50, size=(n, 2))
        p = placed(np.column_stack([xy, R.normal(0, form, n)]))
        q = p - p.mean(axis=0)
        s = float(np.linalg.svd(q)[1][-1])
        yield dict(name=f"plane_{n}", element="plane", points=p.tolist(), lsc_norm=s, mzc=slab(q))
    for n, form in ((10, 0.01), (13, 0.3)):
        v = R.normal(size=(n, 3))
        v /= np.linalg.norm(v, axis=1)[:, None]
        p = placed(v * (25 + R.uniform(-form, form, n))[:, None])
        x, s = fit_least("sphere", p, np.append(p.mean(axis=0), 25))
        zone, outer, inner = sphere_exact(p, x[:3])
        yield dict(name=f"sphere_{n}", element="sphere", points=p.tolist(), lsc_norm=s, centre=x[:3].tolist(), radius=float(x[3]), mzc=zone, mcc=outer, mic=inner)
    for n, rings, r, l, form in ((8, 3, 30, 100, 0.01), (24, 5, 5, 60, 0.002), (12, 4, 60, 20, 0.05)):
        a = np.tile(ring(n), rings)
        h = np.repeat(np.linspace(-l / 2, l / 2, rings), n)
        rr = r + form * np.cos(3 * a + h / 20) + R.uniform(-form, form, len(a)) / 3
        p = np.column_stack([rr * np.cos(a), rr * np.sin(a), h])
        m, shift = turn(), R.uniform(-300, 300, size=3)
        p = np.round(p @ m.T + shift, 9)
        x, s = fit_least("cylinder", p, np.concatenate([shift, m[:, 2], [r]]))
        yield dict(name=f"cylinder_{n}x{rings}", element="cylinder", points=p.tolist(), lsc_norm=s, radius=float(x[6]),
                   direction=(x[3:6] / np.linalg.norm(x[3:6])).tolist(), mzc=minimax("cylinder", p, x, "mzc"),
                   mcc=minimax("cylinder", p, x, "mcc"), mic=minimax("cylinder", p, x, "mic"))
    for n, rings, r, l, psi, form in ((12, 4, 40, 60, 0.26, 0.01), (16, 3, 20, 15, 0.9, 0.004)):
        a = np.tile(ring(n), rings)
        h = np.repeat(np.linspace(-l / 2, l / 2, rings), n)
        rr = r + h * np.tan(psi) + form * np.cos(2 * a) + R.uniform(-form, form, len(a)) / 3
        p = np.column_stack([rr * np.cos(a), rr * np.sin(a), h])
        m, shift = turn(), R.uniform(-300, 300, size=3)
        p = np.round(p @ m.T + shift, 9)
        x, s = fit_least("cone", p, np.concatenate([shift, m[:, 2], [r, psi]]))
        yield dict(name=f"cone_{n}x{rings}", element="cone", points=p.tolist(), lsc_norm=s, half_angle=float(x[7]),
                   direction=(x[3:6] / np.linalg.norm(x[3:6])).tolist(), mzc=minimax("cone", p, x, "mzc"))


if __name__ == "__main__":
    with open(os.path.join(OUT, "form.json"), "w") as fh:
        rows = [json.dumps(c) for c in cases()]
        fh.write("[\n" + ",\n".join(rows) + "\n]\n")
    with open(os.path.join(OUT, "form.header.txt"), "w") as fh:
        fh.write("# oracle: oracles/form.py, independent of the Rust code\n# %s\n# command: python3 oracles/form.py (3 min)\n" % versions())
