"""Datum systems after ISO 5459:2011 of a made-up part -> crates/trueaxis-part/tests/data/datum_systems.json

usage: python3 oracles/datum_systems.py [--check]     (2 s; with --check 3 min: the second way and the perturbations)
Written with Python 3.11.7, numpy 2.4.6, scipy 1.17.1 (`pip install numpy scipy`).

Actual points are nominal + normal * deviation. The datum frame is a rigid motion M: x -> rotation x + translation that lays the
nominal datum features onto the associated ones; a point p seen in that frame is rotation^T (p - translation). The first datum is
associated freely, each further one by the motions that leave the nominal features of all datums before it invariant (the
intersection of their Lie algebras): plane min max |d|, which is the minimum zone, then, where a shift along the normal is free,
moved outside of the material to touch it; hole max min r, shaft min max r (distance from the axis, size free).
Each is a minimax problem: linear programs (HiGHS) on the exact distances, then Newton on the contact points in double precision,
with the multipliers (all > 0), the sharpness (least growth of the objective in mm per mm of motion, turns at 50 mm) and the gap to
the next point: an optimum that isn't sharp stops the script.
Position: of `bore` twice the largest distance of the section centres (geometric least squares in x, y at the nominal z) from the
nominal axis, of `top`, `slope`, `pin`, `hole` twice the largest |distance| from the nominal feature in the frame. Angularity: least
range of distances from a plane at the nominal angle; `base`: it may turn about the normal of the base, `base|wall`: it may not.
--check, the second way, for each system its own construction: all face-vertex and edge-edge pairs of the convex hull for
the first plane, all pairs of projected points for the second, all circles through three projected points for the hole, nested golden
section or SLSQP for the rest; then a million random perturbations."""
import itertools
import json
import os
import sys

import numpy as np
from scipy.linalg import null_space
from scipy.optimize import linprog, minimize
from scipy.spatial import ConvexHull

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis-part", "tests", "data", "datum_systems.json")
SEED = 5459
ARM = 50.0
V = lambda *a: np.array(a, float)
PLANES = {  # normal, first edge (direction, size, points), second edge, centre
    "base": (V(0, 0, -1), V(1, 0, 0), 100, 9, V(0, 1, 0), 60, 7, V(0, 0, 0)),
    "wall": (V(0, -1, 0), V(1, 0, 0), 100, 9, V(0, 0, 1), 20, 4, V(0, -30, 10)),
    "end": (V(-1, 0, 0), V(0, 1, 0), 60, 7, V(0, 0, 1), 20, 4, V(-50, 0, 10)),
    "top": (V(0, 0, 1), V(1, 0, 0), 100, 9, V(0, 1, 0), 60, 7, V(0, 0, 20)),
    "slope": (V(0, 0.6, 0.8), V(1, 0, 0), 40, 8, V(0, 0.8, -0.6), 20, 4, V(0, 32, 10)),
}
ROUND = {  # side of the material (-1: hole), point of the axis at the lower end, radius, length
    "hole": (-1, V(20, 5, 0), 15.0, 20.0), "pin": (1, V(-25, 10, 20), 8.0, 20.0), "bore": (-1, V(-20, -12, 0), 6.0, 20.0)}
ORDER = ["base", "wall", "end", "hole", "pin", "bore", "top", "slope"]
SYSTEMS = [["base", "wall", "end"], ["wall", "base", "end"], ["base", "hole", "end"], ["base", "wall", "hole"],
           ["base", "hole", "pin"], ["hole", "base", "wall"], ["end", "hole", "base"]]
# planes, um of (u, v), each -1..1: offset, tilts, bows u^2 and v^2, saddle uv, waves (amplitude, ku, kv, phase)
SHAPE = {
    "base": (4, 5, -3, 5, -4, 3, (2.5, 2, 3, 0.7)), "wall": (-6, 4.5, 4, -4, 5, 3, (2, 3.5, 2.5, 0.3)),
    "end": (7, -5, -3, -2.5, 2.5, -3, (2, 2, 1.5, 1.5)), "top": (3, -5, 4, 4, 3, -3, (2.5, 2, 2, 2.4)),
    "slope": (-4, 6, -4, -3, 3, 4, (2, 3, 1, 1.1)),
    # round, um of the angle and s (-1..1 along the axis): offset, place (x, y), tilt (x, y), bow of the axis (x, y), taper,
    # barrel, then lobes (k, amplitude, phase, twist); an end that is the narrowest alone would leave the tilt open
    "hole": (3, 4, -6, -3.5, 4, -2.5, -2.5, 0, 1, (2, 2.5, 1.8, 0.3), (3, 4, 0.6, -0.4), (5, 1.5, 0.4, -0.8)),
    "pin": (-4, -5, 3, 4, 2, -2, 2, -2, 1.5, (3, 3.5, 0.6, 0), (4, 1.5, 2.0, 0.4), (2, 2, 1.0, 0)),
    "bore": (2, 6, 5, -4, 3, 2, 1, 2, -1, (2, 3, 2.7, 0.3), (3, 2, 0.5, 0), (5, 1.5, 1.0, 0)),
}


def build():
    rng, out = np.random.default_rng(SEED), {}
    for name in ORDER:
        P, N, D, c = [], [], [], SHAPE[name]
        if name in PLANES:
            n, e1, s1, n1, e2, s2, n2, p0 = PLANES[name]
            for j in range(n2):
                for i in range(n1):
                    u, v = (2 * i + 1) / n1 - 1, (2 * j + 1) / n2 - 1
                    a, ku, kv, ph = c[6]
                    P.append(p0 + e1 * (u * s1 / 2) + e2 * (v * s2 / 2))
                    N.append(n)
                    D.append(c[0] + c[1] * u + c[2] * v + c[3] * u * u + c[4] * v * v + c[5] * u * v + a * np.sin(ku * u + kv * v + ph))
        else:
            side, p0, r, h = ROUND[name]
            for j in range(5):
                for i in range(24):
                    s, t = (2 * j + 1) / 5 - 1, np.radians(15 * i)
                    q = V(np.cos(t), np.sin(t), 0)
                    P.append(p0 + q * r + V(0, 0, h * (s + 1) / 2))
                    N.append(q * side)
                    D.append(c[0] + (c[1] + c[3] * s + c[5] * s * s) * np.cos(t) + (c[2] + c[4] * s + c[6] * s * s) * np.sin(t)
                             + c[7] * s + c[8] * s * s + sum(a * np.cos(k * t + ph + tw * s) for k, a, ph, tw in c[9:]))
        D = np.array([round(float(x), 7) for x in (np.array(D) + rng.normal(0, 1, len(D))) * 1e-3])  # 0.1 nm
        assert abs(D).max() <= 0.030, (name, abs(D).max())
        out[name] = (np.array(P) + 0.0, np.array(N) + 0.0, D)
    return out


def actual(parts):
    return {k: p + n * d[:, None] for k, (p, n, d) in parts.items()}


# ---- rigid motions: twists (omega * ARM, velocity of the origin), mm
def exp(x):
    w, v = x[:3] / ARM, x[3:]
    t = np.linalg.norm(w)
    W = V([0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0])
    a, b, c = (np.sin(t) / t, 2 * np.sin(t / 2) ** 2 / t ** 2, (t - np.sin(t)) / t ** 3) if t > 1e-3 else \
        (1 - t * t / 6, 0.5 - t * t / 24, 1 / 6 - t * t / 120)
    return np.eye(3) + a * W + b * W @ W, (np.eye(3) + b * W + c * W @ W) @ v


def mul(A, B):
    return A[0] @ B[0], A[0] @ B[1] + A[1]


def seen(M, p):
    return (p - M[1]) @ M[0]


def nominal(name):
    return (PLANES[name][0], PLANES[name][7]) if name in PLANES else (V(0, 0, 1), ROUND[name][1])


def rows(name):
    """What the feature senses of a twist: tilts, and the velocity along the normal / across the axis."""
    a, p = nominal(name)
    e = null_space(a[None]).T
    out = [np.r_[x / ARM, 0, 0, 0] for x in e]
    for x in ([a] if name in PLANES else e):
        out.append(np.r_[np.cross(p, x) / ARM, x])  # (omega x p + v).x
    return np.array(out)


def distance(name, q):
    """Signed distance from the nominal plane, or distance from the nominal axis, and its gradient."""
    a, p = nominal(name)
    d = q - p
    if name in PLANES:
        return d @ a, np.tile(a, (len(q), 1))
    d = d - np.outer(d @ a, a)
    r = np.linalg.norm(d, axis=1)
    return r, d / r[:, None]


def objective(name, M, p, C):
    """f (its maximum is minimised) and the gradient in the coordinates C of the twist of M exp(C x)."""
    q = seen(M, p)
    d, g = distance(name, q)
    J = -np.c_[np.cross(q, g) / ARM, g] @ C
    if name in PLANES:
        return np.r_[d, -d], np.r_[J, -J]
    return (-d, -J) if ROUND[name][0] < 0 else (d, J)


def minimax(name, M, p, C, log):
    m = C.shape[1]
    scale = 1e3  # um
    for k in range(50):
        f, J = objective(name, M, p, C)
        r = linprog(np.r_[np.zeros(m), 1], np.c_[J, -np.ones(len(f))], (f.max() - f) * scale, bounds=[(-1e3, 1e3)] * m + [(None, None)],
                    method="highs", options=dict(primal_feasibility_tolerance=1e-10, dual_feasibility_tolerance=1e-10))
        assert r.status == 0, r.message
        M = mul(M, exp(C @ r.x[:m] / scale))
        if abs(r.x[:m]).max() < 1e-6:
            break
    act = np.argsort(r.ineqlin.marginals)[:m + 1]
    for k in range(20):
        f, J = objective(name, M, p, C)
        x = np.linalg.solve(np.c_[J[act], -np.ones(m + 1)], f[act].mean() - f[act])
        M = mul(M, exp(C @ x[:m]))
        if abs(x[:m]).max() < 2e-15:
            break
    f, J = objective(name, M, p, C)
    lam = np.linalg.solve(np.c_[J[act], np.ones(m + 1)].T, np.r_[np.zeros(m), 1])
    rest = np.delete(f, act)
    sharp = np.inf  # the origin's distance from the faces of the simplex of the gradients
    for i in range(m + 1):
        F = np.delete(J[act], i, 0)
        n = null_space(F[1:] - F[0]) if m > 1 else np.ones((1, 1))
        sharp = min(sharp, abs(F[0] @ n[:, 0]))
    spread = np.ptp(f[act])
    log.append(dict(feature=name, unknowns=m, value=f[act].mean(), spread=spread, excess=rest.max() - f[act].max(), least_multiplier=lam.min(),
                    sharpness=sharp, step=abs(x[:m]).max(), contacts=sorted(int(i) % len(p) for i in act)))
    assert spread < 3e-14 and rest.max() < f[act].max() and lam.min() > 0.005 and sharp > 0.02, log[-1]
    return M


def system(datums, pts, log):
    M, free = (np.eye(3), np.zeros(3)), np.eye(6)
    for name in datums:
        S = rows(name) @ free
        u, s, vt = np.linalg.svd(S)
        k = int((s > 1e-9).sum())
        C = free @ vt[:k].T
        M = minimax(name, M, pts[name], C, log)
        if name in PLANES:
            n = nominal(name)[0]
            t = np.r_[0, 0, 0, n]
            if np.linalg.norm(t - free @ (free.T @ t)) < 1e-9:  # a shift along the normal is free
                M = mul(M, (np.eye(3), n * distance(name, seen(M, pts[name]))[0].max()))
        free = free @ vt[k:].T
    return M, free


def lsc(xy):
    """Geometric least-squares circle by Newton on the centre (the radius is the mean distance)."""
    c = xy.mean(0)
    for k in range(50):
        d = xy - c
        r = np.linalg.norm(d, axis=1)
        R = r.mean()
        u = d / r[:, None]
        g = -((r - R)[:, None] * u).sum(0)
        ub = u.mean(0)
        H = sum(np.outer(a, a) + (1 - R / b) * (np.eye(2) - np.outer(a, a)) for a, b in zip(u, r)) - len(r) * np.outer(ub, ub)
        s = np.linalg.solve(H, -g)
        c = c + s
        if abs(s).max() < 1e-14:
            break
    return c


def values(datums, M, parts, pts):
    z = parts["bore"][0][:, 2].reshape(5, 24)[:, 0]
    c = np.array([np.r_[lsc(pts["bore"][24 * i:24 * i + 24, :2]), z[i]] for i in range(5)])
    out = {"position of bore": 2 * distance("bore", seen(M, c))[0].max()}
    for what, name in (("position of top", "top"), ("profile of slope", "slope"), ("profile of hole", "hole"), ("profile of pin", "pin")):
        if name not in datums:
            d = distance(name, seen(M, pts[name]))[0]
            out[what] = 2 * abs(d - (ROUND[name][2] if name in ROUND else 0)).max()
    return {k: float(v) for k, v in out.items()}


def angularity(pts, log):
    out = {}
    M, free = system(["base"], pts, log)
    free = np.c_[free, np.eye(6)[:, 5]]  # the shift along z too
    s, vt = np.linalg.svd(rows("slope") @ free)[1:]
    Ms = minimax("slope", M, pts["slope"], free @ vt[:int((s > 1e-9).sum())].T, log)
    out["base"] = float(np.ptp(distance("slope", seen(Ms, pts["slope"]))[0]))
    M, free = system(["base", "wall"], pts, log)
    out["base|wall"] = float(np.ptp(distance("slope", seen(M, pts["slope"]))[0]))
    return out


def evaluate(parts, pts):
    res, logs = [], []
    for s in SYSTEMS:
        log = []
        M, free = system(s, pts, log)
        assert free.shape[1] == 0, s
        res.append((s, values(s, M, parts, pts), M))
        logs.append(log)
    log = []
    ang = angularity(pts, log)
    return res, ang, logs, log


# ---- the second way: each frame constructed
def zone_direction(P, n0):
    """Unit direction of least width near n0: all face-vertex and edge-edge pairs of the convex hull."""
    e = null_space(n0[None])
    hull = ConvexHull(np.c_[P @ e, (P - P.mean(0)) @ n0 * 1e3])
    tri = hull.simplices
    edges = {tuple(sorted(x)) for t in tri for x in itertools.combinations(t, 2)}
    d = np.array([P[b] - P[a] for a, b in edges])
    c = np.vstack([np.cross(P[tri[:, 1]] - P[tri[:, 0]], P[tri[:, 2]] - P[tri[:, 0]])] + [np.cross(x, d) for x in d])
    c = c[np.linalg.norm(c, axis=1) > 1e-9]
    c /= np.linalg.norm(c, axis=1)[:, None]
    c *= np.sign(c @ n0)[:, None]
    c = c[c @ n0 > 1 - 1e-5]
    return c[np.ptp(P @ c.T, axis=0).argmin()]


def zone_direction_2d(P, n0, z):
    """The same among the directions across z: all pairs of points."""
    i, j = np.triu_indices(len(P), 1)
    c = np.cross(P[j] - P[i], z)
    c = c[np.linalg.norm(c, axis=1) > 1e-9]
    c /= np.linalg.norm(c, axis=1)[:, None]
    c *= np.sign(c @ n0)[:, None]
    c = c[c @ n0 > 1 - 1e-5]
    return c[np.ptp(P @ c.T, axis=0).argmin()]


def inscribed_2d(Q, c0):
    """Centre of the largest empty circle near c0: all triples."""
    t = np.array(list(itertools.combinations(range(len(Q)), 3)))
    A, B, C = Q[t[:, 0]] - c0, Q[t[:, 1]] - c0, Q[t[:, 2]] - c0
    b, c = B - A, C - A
    d = 2 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    ok = abs(d) > 1e-3
    A, b, c, d = A[ok], b[ok], c[ok], d[ok]
    b2, c2 = (b * b).sum(1), (c * c).sum(1)
    u = A + np.c_[c[:, 1] * b2 - b[:, 1] * c2, b[:, 0] * c2 - c[:, 0] * b2] / d[:, None]
    u = u[np.linalg.norm(u, axis=1) < 0.05] + c0
    best = (-1,)
    for k in range(0, len(u), 20000):
        r = np.sqrt(((Q[None] - u[k:k + 20000, None]) ** 2).sum(2)).min(1)
        best = max(best, (r.max(), tuple(u[k + r.argmax()])))
    return V(*best[1])


def golden(f, a, b, n=85):
    """Minimum by golden section (sharp where f has a kink at its minimum)."""
    g = (5 ** 0.5 - 1) / 2
    x, y = b - g * (b - a), a + g * (b - a)
    fx, fy = f(x), f(y)
    for k in range(n):
        if fx < fy:
            b, y, fy = y, x, fx
            x = b - g * (b - a)
            fx = f(x)
        else:
            a, x, fx = x, y, fy
            y = a + g * (b - a)
            fy = f(y)
    return (a + b) / 2


def inscribed_cylinder(P, c0):
    """Best of 40 SLSQP runs on the epigraph; axis = c0 + (a, b, 0) + s (c, d, 1), mm and mm per 10 mm."""
    def dist(x):
        w = V(x[2] * 1e-4, x[3] * 1e-4, 1)
        q = P - (c0 + V(x[0] * 1e-3, x[1] * 1e-3, 10))
        return np.linalg.norm(np.cross(q, w), axis=1) / np.linalg.norm(w)
    rng, best = np.random.default_rng(1), None
    for k in range(40):
        x0 = rng.uniform(-100, 100, 4)
        for rep in range(4):
            r = minimize(lambda x: -x[4], np.r_[x0, (dist(x0).min() - 15) * 1e3], method="SLSQP", options=dict(maxiter=500, ftol=1e-13),
                         constraints=[dict(type="ineq", fun=lambda x: (dist(x) - 15) * 1e3 - x[4])])
            x0 = r.x[:4]
        v = dist(x0).min()
        if best is None or v > best[0]:
            best = (v, x0)
    x = best[1]
    w = V(x[2] * 1e-4, x[3] * 1e-4, 1)
    return c0 + V(x[0] * 1e-3, x[1] * 1e-3, 10), w / np.linalg.norm(w)


def second(datums, pts):
    b, w, e, h, p = (pts[k] for k in ("base", "wall", "end", "hole", "pin"))
    frame = lambda R, o: (R, R @ o)  # o: origin in the coordinates of the frame's directions
    key = "-".join(datums)
    if key in ("base-wall-end", "wall-base-end", "base-wall-hole"):
        if datums[0] == "base":
            ez = zone_direction(b, V(0, 0, 1))
            ey = zone_direction_2d(w, V(0, 1, 0), ez)
        else:
            ey = zone_direction(w, V(0, 1, 0))
            ez = zone_direction_2d(b, V(0, 0, 1), ey)
        R = np.c_[np.cross(ey, ez), ey, ez]
        o = V((e @ R[:, 0]).min() + 50, (w @ ey).min() + 30, (b @ ez).min())
        if key == "base-wall-hole":
            q = h @ R[:, :2]
            y = o[1] + 5
            x = golden(lambda x: -np.hypot(q[:, 0] - x, q[:, 1] - y).min(), 19.9, 20.1)
            o[0] = x - 20
        return frame(R, o)
    if key in ("base-hole-end", "base-hole-pin"):
        ez = zone_direction(b, V(0, 0, 1))
        ex = np.cross(V(0, 1, 0), ez)
        ex /= np.linalg.norm(ex)
        R = np.c_[ex, np.cross(ez, ex), ez]
        c = inscribed_2d(h @ R[:, :2], V(20, 5))
        def turned(t):
            T = R @ V([np.cos(t), -np.sin(t), 0], [np.sin(t), np.cos(t), 0], [0, 0, 1])
            cc = R[:, :2] @ c @ T[:, :2]
            return T, V(cc[0] - 20, cc[1] - 5, (b @ ez).min())
        def cost(t):
            T, o = turned(t)
            if key.endswith("end"):
                return abs(e @ T[:, 0] - o[0] + 50).max()
            return np.hypot(p @ T[:, 0] - o[0] + 25, p @ T[:, 1] - o[1] - 10).max()
        return frame(*turned(golden(cost, -2e-3, 2e-3)))
    if key == "hole-base-wall":
        c, ez = inscribed_cylinder(h, V(20, 5, 0))
        ex = np.cross(V(0, 1, 0), ez)
        ex /= np.linalg.norm(ex)
        R = np.c_[ex, np.cross(ez, ex), ez]
        def turned(t):
            T = R @ V([np.cos(t), -np.sin(t), 0], [np.sin(t), np.cos(t), 0], [0, 0, 1])
            cc = c @ T
            return T, V(cc[0] - 20, cc[1] - 5, (b @ ez).min())
        def cost(t):
            T, o = turned(t)
            return abs(w @ T[:, 1] - o[1] + 30).max()
        return frame(*turned(golden(cost, -2e-3, 2e-3)))
    assert key == "end-hole-base"
    ex = zone_direction(e, V(1, 0, 0))
    x0 = (e @ ex).min() + 50
    ey = np.cross(V(0, 0, 1), ex)
    ey /= np.linalg.norm(ey)
    R = np.c_[ex, ey, np.cross(ex, ey)]
    turned = lambda t: R @ V([1, 0, 0], [0, np.cos(t), -np.sin(t)], [0, np.sin(t), np.cos(t)])
    def inner(t):
        q = h @ turned(t)
        y = golden(lambda y: -np.hypot(q[:, 0] - x0 - 20, q[:, 1] - y).min(), 4.9, 5.1, 65)
        return -np.hypot(q[:, 0] - x0 - 20, q[:, 1] - y).min(), y
    t = golden(lambda t: inner(t)[0], -5e-3, 5e-3, 65)
    T = turned(t)
    return frame(T, V(x0, inner(t)[1] - 5, (b @ T[:, 2]).min()))


def check(parts, pts, res, ang):
    for s, v, M in res:
        M2 = second(s, pts)
        v2 = values(s, M2, parts, pts)
        print("second way %-18s frame within %.1e mm at 50 mm, values within %.1e mm" % (
            ",".join(s), max(abs(M[0] - M2[0]).max() * ARM, abs(M[1] - M2[1]).max()), max(abs(v[k] - v2[k]) for k in v)))
    ez = zone_direction(pts["base"], V(0, 0, 1))
    ey = zone_direction_2d(pts["wall"], V(0, 1, 0), ez)
    n = lambda y: 0.6 * y + 0.8 * ez
    ex = np.cross(ey, ez)
    width = lambda t: np.ptp(pts["slope"] @ n(ey * np.cos(t) + ex * np.sin(t)))
    t = golden(width, -5e-3, 5e-3)
    print("second way angularity within %.1e, %.1e mm" % (abs(width(t) - ang["base"]), abs(width(0) - ang["base|wall"])))
    rng, tried = np.random.default_rng(2), 0
    for s in SYSTEMS:  # each datum of each system: random motions that keep the datums before it never do better
        M, free = (np.eye(3), np.zeros(3)), np.eye(6)
        for k, name in enumerate(s):
            log = []
            Mk = system(s[:k], pts, log)[0] if k else (np.eye(3), np.zeros(3))
            u, sv, vt = np.linalg.svd(rows(name) @ free)
            r = int((sv > 1e-9).sum())
            C = free @ vt[:r].T
            Mk = minimax(name, Mk, pts[name], C, log)
            best = objective(name, Mk, pts[name], C)[0].max()
            least = np.inf
            for i in range(48000):
                x = rng.normal(size=free.shape[1])
                x *= 10 ** rng.uniform(-9, -0.5) / np.linalg.norm(x)
                q = seen(mul(Mk, exp(free @ x)), pts[name])
                d = distance(name, q)[0]
                f = abs(d).max() if name in PLANES else (-d.min() if ROUND[name][0] < 0 else d.max())
                seenpart = np.linalg.norm(vt[:r] @ x)
                if f - best < -2e-14:
                    print("BETTER", s, name, f - best, x)
                least = min(least, (f - best + 2e-14) / seenpart)
                tried += 1
            print("perturbed %-16s %-5s least growth %.3f mm per mm (sharpness %.3f)" % (",".join(s), name, least, log[-1]["sharpness"]))
            free = free @ vt[r:].T
    print("%d perturbations, none better" % tried)
    worst = dict()  # how errors of 1e-12 mm of the points come through
    for k in range(20):
        noisy = {a: x + rng.uniform(-1e-12, 1e-12, x.shape) for a, x in pts.items()}
        r2, a2, _, _ = evaluate(parts, noisy)
        for (s, v, M), (_, v2, M2) in zip(res, r2):
            kk = ",".join(s)
            worst[kk] = max(worst.get(kk, 0), max(abs(v[a] - v2[a]) for a in v))
        worst["angularity"] = max(worst.get("angularity", 0), max(abs(ang[a] - a2[a]) for a in ang))
    print("errors of 1e-12 mm of the points change the values by at most", {k: float("%.1e" % v) for k, v in worst.items()})


def main():
    parts = build()
    pts = actual(parts)
    res, ang, logs, alog = evaluate(parts, pts)
    for (s, v, M), log in zip(res, logs):
        print(",".join(s), {k: round(x, 12) for k, x in v.items()})
        print("  t", M[1].tolist(), "turn", [M[0][2, 1], M[0][0, 2], M[0][1, 0]])
        for x in log:
            print("  ", {k: (float("%.3g" % y) if isinstance(y, float) and k != "value" else y) for k, y in x.items()})
    print("angularity", ang)
    for x in alog:
        print("  ", {k: (float("%.3g" % y) if isinstance(y, float) and k != "value" else y) for k, y in x.items()})
    print("largest |deviation|", {k: float(abs(d).max()) for k, (_, _, d) in parts.items()})
    if "--check" in sys.argv:
        check(parts, pts, res, ang)
    os.makedirs(os.path.dirname(OUT), exist_ok=True)
    dump = lambda x: json.dumps(x, separators=(",", ":"))
    with open(OUT, "w") as fh:
        fh.write('{"features":{\n')
        fh.write(",\n".join('"%s":%s' % (k, dump(dict(points=p.tolist(), normals=n.tolist(), deviations_mm=d.tolist())))
                            for k, (p, n, d) in parts.items()))
        fh.write('\n},"systems":[\n')
        fh.write(",\n".join(dump(dict(datums=s, values=v, rotation=M[0].tolist(), translation_mm=M[1].tolist())) for s, v, M in res))
        fh.write('\n],"angularity":%s}\n' % dump(ang))


if __name__ == "__main__":
    main()
