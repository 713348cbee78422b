"""Common datums A-B after ISO 5459 of made-up features -> crates/trueaxis-part/tests/data/common_datums.json

usage: python3 oracles/common_datums.py [--check]     (15 s; with --check 80 s: the second way and the moved parts)
Written with Python 3.11, numpy 2.4.6, scipy 1.17.1 (`pip install numpy scipy`).

Actual points are nominal + normal * deviation. The common datum is the nominal frame moved by the rigid motion M (full rotation
matrices) with the least max over members i and points j of outside_i(M^-1 p_ij) - m_i. outside: how far a point lies out of the
material of the nominal feature: shaft rho - R, hole R - rho, plane n.(p - at). m_i: the least max outside of member i alone over all
of its own motions, which is r_own - R of the smallest circumscribed cylinder, R - r_own of the largest inscribed one; of planes 0.
Members that are all planes facing one way: M has the least range of outside over all points instead (objective_mm: this range), and
is then shifted along the normal to lie at the largest one.
Each is a minimax problem: linear programs (HiGHS) on the exact distances in a trust region, to steps below 1e-12 mm (turns at 50 mm).
A case is kept if the optimum has as many contacts as unknowns, multipliers all > 0, and is sharp (least growth of the objective in mm
per mm of motion, largest coordinate): the common one > 0.02, each alone > 0.002. The next seed is taken if not.
Values: coaxiality: twice the largest distance of the section centres of C (geometric least squares circle in x, y; z: the mean) from the
common axis. parallelism: the range of T along the normal of the datum. distance: twice the largest distance of the section centres of
the hole H from the middle plane of A-B. datum: a point (axis: at z = 0; plane: x = y = 0 of pads, x = z = 0 of the middle plane) and
the direction of the moved axis or of the moved normal of A.
Sections lie in the points one after the other. Cylinders go from their place along +z, planes are centred on it.
--check, the second way: axes as four numbers (place at half length, slopes), planes as two slopes, SLSQP on the bound from four starts;
planes also by all pairs of edges of the convex hull (a least width has either two edges or a face in contact); circles by scipy; 20 000
random motions about each optimum may not be better; all points of a case moved by one rigid motion give the same values."""
import json
import os
import sys

import numpy as np
from scipy.optimize import least_squares, linprog, minimize
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis-part", "tests", "data", "common_datums.json")
ARM = 50.0
V = lambda *a: np.array(a, float)
X, Y, Z = np.eye(3)
SEATS = {"A": (V(10, 5, 0), 15.0, 12.0), "B": (V(10, 5, 88), 12.5, 12.0), "C": (V(10, 5, 40), 20.0, 20.0)}  # place, radius, length
# normal, centre, edge with 7 points, its size, edge with 5 points, its size
PADS = {"A": (-Z, V(-40, 0, 0), Y, 60, X, 20), "B": (-Z, V(40, 0, 0), Y, 60, X, 20), "T": (Z, V(0, 0, 20), X, 100, Y, 60)}
FLANKS = {"A": (-Y, V(0, -30, 10), X, 100, Z, 20), "B": (Y, V(0, 30, 10), X, 100, Z, 20)}
KINDS = {  # members first
    "shafts": [("shaft", k, *SEATS[k]) for k in "ABC"], "holes": [("hole", k, *SEATS[k]) for k in "ABC"],
    "mixed": [("hole" if k == "B" else "shaft", k, *SEATS[k]) for k in "ABC"],
    "pads": [("plane", k, *PADS[k]) for k in "ABT"],
    "opposite": [("plane", k, *FLANKS[k]) for k in "AB"] + [("hole", "H", V(0, 0, 0), 15.0, 20.0)]}
# round: place x, y (um), tilts (urad), radius (um); planes: tilts (urad), offset outwards (um)
ROUND = {"A": (4, -2, 40, -25, 20), "B": (-3, 5, -30, 45, -10), "C": (6, 3, -20, 35, 5), "H": (5, -7, 30, 40, 8)}
FLAT = {"A": (40, -30, 3), "B": (-35, 50, 10), "T": (30, 45, -6)}


# ---- the made-up features
def build(kind, seed):
    rng, out = np.random.default_rng([5459, list(KINDS).index(kind), seed]), {}
    for what, name, *c in KINDS[kind]:
        P, N, D = [], [], []
        if what == "plane":
            n, at, e1, s1, e2, s2 = c
            t1, t2, off = FLAT[name] + rng.uniform(-1, 1, 3) * (30, 30, 2)
            for u in np.linspace(-s1 / 2, s1 / 2, 7):
                for v in np.linspace(-s2 / 2, s2 / 2, 5):
                    P.append(at + u * e1 + v * e2)
                    N.append(n)
                    D.append(off + (t1 * u + t2 * v) * 1e-3)
        else:
            at, R, length = c
            x, y, tx, ty, r = ROUND[name] + rng.uniform(-1, 1, 5) * (3, 3, 30, 30, 3)
            lobes = [(k, rng.uniform(0.5, 2), *rng.uniform(-2, 2, 2)) for k in (2, 3, 5)]
            for s in np.linspace(0, length, 4):
                for t in np.radians(15) * np.arange(24):
                    q, h = V(np.cos(t), np.sin(t), 0), s - length / 2
                    P.append(at + R * q + s * Z)
                    N.append(q if what == "shaft" else -q)
                    grown = r + (x + tx * h * 1e-3) * q[0] + (y + ty * h * 1e-3) * q[1]
                    grown += sum(a * np.cos(k * t + ph + tw * h / length) for k, a, ph, tw in lobes)
                    D.append(grown if what == "shaft" else -grown)
        D = np.round((np.array(D) + rng.uniform(-3, 3, len(D))) * 1e-3, 7) + 0.0
        out[name] = (np.round(P, 12) + 0.0, np.round(N, 12) + 0.0, D)
    return out


def actual(parts):
    return {k: p + n * d[:, None] for k, (p, n, d) in parts.items()}


# ---- the first way: rigid motions (rotation, translation) about `ref`; twists (turn * ARM, shift)
def exp(x):
    w, v = x[:3] / ARM, x[3:]
    return Rotation.from_rotvec(w).as_matrix(), v  # a turn about ref and a shift: any motion will do for a step


def outside(feature, q):
    what, _, *c = feature
    if what == "plane":
        return (q - c[1]) @ c[0], np.tile(c[0], (len(q), 1))
    d = (q - c[0]) * (1, 1, 0)
    rho = np.linalg.norm(d, axis=1)
    side = 1 if what == "shaft" else -1
    return side * (rho - c[1]), side * d / rho[:, None]


def free(members):
    """The motions that matter: turns about and shifts along two axes across z, or turns across and the shift along a normal."""
    what, _, *c = members[0]
    if what != "plane":
        return np.eye(6)[:, [0, 1, 3, 4]]
    k = int(np.argmax(abs(c[0])))
    return np.eye(6)[:, [i for i in range(3) if i != k] + [3 + k]]


def centre(members):
    """The middle of the members' nominal places."""
    return np.mean([c[1] if what == "plane" else c[0] + c[2] / 2 * Z for what, _, *c in members], axis=0)


def residuals(members, points, sizes, both, ref, M):
    f, J, C = [], [], free(members)
    for m in members:
        q = (points[m[1]] - ref - M[1]) @ M[0]
        d, g = outside(m, q + ref)
        f.append(d - sizes[m[1]])
        J.append(-np.c_[np.cross(q, g) / ARM, g] @ C)
    f, J = np.concatenate(f), np.concatenate(J)
    return (np.r_[f, -f], np.r_[J, -J]) if both else (f, J)


def lp(c, A, b, bounds):
    s = linprog(c, A_ub=A, b_ub=b, bounds=bounds, method="highs-ds",
                options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10})
    assert s.status == 0, s.message
    return s.x


def minimax(members, points, sizes, both=False):
    """M, the objective, the sharpness (0: not a vertex)."""
    ref, C, M, trust = centre(members), free(members), (np.eye(3), np.zeros(3)), 0.05
    n = C.shape[1]
    f, J = residuals(members, points, sizes, both, ref, M)
    for _ in range(200):
        near = f > f.max() - 4 * trust * abs(J).sum(1).max()
        A, b = np.c_[J[near], -np.ones(near.sum())], -(f[near] - f.max()) / trust  # in units of the trust region
        x = trust * lp(np.r_[np.zeros(n), 1], A, b, [(-1, 1)] * n + [(None, None)])[:n]
        step, E = abs(x).max(), exp(C @ x)
        if step < 1e-12:
            break
        N = M[0] @ E[0], M[0] @ E[1] + M[1]
        fn, Jn = residuals(members, points, sizes, both, ref, N)
        if fn.max() < f.max() + 1e-14:
            trust = 4 * trust if step > 0.99 * trust else max(2 * step, 4e-12)
            M, f, J = N, fn, Jn
        else:
            trust /= 4
            if trust < 1e-12:
                break
    else:
        return M, f.max(), 0.0
    touch = f > f.max() - 1e-10
    G, sharp = J[touch], 0.0
    if touch.sum() == n + 1:
        least = np.linalg.solve(np.r_[G.T, np.ones((1, n + 1))], np.r_[np.zeros(n), 1]).min()
        if least > 1e-3:
            A = np.c_[G, -np.ones(n + 1)]
            sharp = min(lp(np.r_[np.zeros(n), 1], A, np.zeros(n + 1), [(-1, 1) if i != k else (s, s) for i in range(n)] + [(None, None)])[n]
                        for k in range(n) for s in (-1, 1))
    return M, f.max(), sharp


def circle(xy):
    c = xy.mean(0)
    r = np.linalg.norm(xy - c, axis=1).mean()
    for _ in range(50):
        d = xy - c
        rho = np.linalg.norm(d, axis=1)
        s = np.linalg.lstsq(np.c_[d / rho[:, None], np.ones(len(d))], rho - r, rcond=None)[0]
        c, r = c + s[:2], r + s[2]
        if abs(s).max() < 1e-15:
            break
    return c


def centres(p, fit=circle):
    return np.array([np.r_[fit(s[:, :2]), s[:, 2].mean()] for s in p.reshape(-1, 24, 3)])


def value(kind, p, point, direction, fit=circle):
    """The value in the datum: a point of it, its direction."""
    if kind == "pads":
        return np.ptp(p["T"] @ direction)
    c = centres(p["H" if kind == "opposite" else "C"], fit) - point
    return 2 * (abs(c @ direction).max() if kind == "opposite" else np.linalg.norm(np.cross(c, direction), axis=1).max())


def first(kind, p):
    """Sizes, objective, point and direction of the datum, value, sharpness (common, least of each alone)."""
    members, own, alone = KINDS[kind][:2], {}, 1.0
    for m in members:
        own[m[1]] = 0.0
        if m[0] != "plane":
            _, own[m[1]], s = minimax([m], p, {m[1]: 0.0})
            alone = min(alone, s)
    M, best, sharp = minimax(members, p, own, kind == "pads")
    ref = centre(members)
    move = lambda x: M[0] @ (x - ref) + M[1] + ref
    if members[0][0] == "plane":
        direction, point = M[0] @ members[0][2], move(ref)
        if kind == "pads":
            best *= 2
            point = point + direction * max(((p[m[1]] - point) @ direction).max() for m in members)
        k = int(np.argmax(abs(direction)))
        point = np.eye(3)[k] * (point @ direction) / direction[k]
    else:
        direction, point = M[0] @ Z, move(members[0][2])
        point = point - direction * point[2] / direction[2]
    return {"own": own, "best": best, "point": point, "direction": direction, "value": value(kind, p, point, direction),
            "sharp": sharp, "alone": alone, "M": M}


# ---- the second way
def bound(rows, n, rng):
    """Least t with rows(x) <= t: SLSQP; x: um, and slopes at ARM in um."""
    found = None
    for _ in range(4):
        x0 = rng.uniform(-20, 20, n)
        r = minimize(lambda y: y[n], np.r_[x0, rows(x0).max()], jac=lambda y: np.eye(n + 1)[n], method="SLSQP",
                     constraints={"type": "ineq", "fun": lambda y: y[n] - rows(y[:n])}, options={"ftol": 1e-14, "maxiter": 500})
        t = rows(r.x[:n]).max()
        if found is None or t < found[0]:
            found = t, r.x[:n]
    return found[0] * 1e-3, found[1]


def radii(x, q, at):
    d = V(x[2] * 1e-3 / ARM, x[3] * 1e-3 / ARM, 1)
    return np.linalg.norm(np.cross(q - at - V(x[0], x[1], 0) * 1e-3, d), axis=1) / np.linalg.norm(d)


def circle2(xy):
    c = xy.mean(0)
    r = least_squares(lambda x: np.linalg.norm(xy - x[:2], axis=1) - x[2], np.r_[c, np.linalg.norm(xy - c, axis=1).mean()],
                      xtol=1e-15, ftol=1e-15, gtol=1e-15)
    return r.x[:2]


def second(kind, p, rng):
    members = KINDS[kind][:2]
    if members[0][0] != "plane":
        at, own = (SEATS["A"][0] + SEATS["B"][0] + V(0, 0, 12)) / 2, {}
        side = lambda m: 1 if m[0] == "shaft" else -1
        r_own = {}
        for m in members:
            t, _ = bound(lambda x: side(m) * (radii(x, p[m[1]], m[2] + m[4] / 2 * Z) - m[3]) * 1e3, 4, rng)
            own[m[1]], r_own[m[1]] = t, m[3] + side(m) * t
        best, x = bound(lambda x: 1e3 * np.concatenate(
            [side(m) * (radii(x, p[m[1]], at) - r_own[m[1]]) for m in members]), 4, rng)
        d = V(x[2] * 1e-3 / ARM, x[3] * 1e-3 / ARM, 1)
        d /= np.linalg.norm(d)
        return own, best, value(kind, p, at + V(x[0], x[1], 0) * 1e-3, d, circle2)
    n, q = members[0][2], np.concatenate([p[m[1]] for m in members])
    k = int(np.argmax(abs(n)))
    i, j = [a for a in range(3) if a != k]

    def normal(x):
        d = n.copy()
        d[i], d[j] = x[0] * 1e-3 / ARM, x[1] * 1e-3 / ARM
        return d / np.linalg.norm(d)

    def rows(x):  # half of the width: the planes n.q = x[2] +- t (opposite ones 60 mm apart: t - 30 is the objective)
        s = (q @ normal(x)) * 1e3 - x[2] - (0 if kind == "pads" else 30e3 * np.sign(q @ n))
        return np.r_[s, -s] if kind == "pads" else s * np.sign(q @ n)
    best, x = bound(rows, 3, rng)
    best *= 2 if kind == "pads" else 1
    # all pairs of edges of the hull, which is stretched along the normal (this leaves its edges as they are)
    stretch = np.ones(3)
    stretch[k] = 1e4
    hull = ConvexHull(q * stretch, qhull_options="Qt")
    edges = np.array(sorted({tuple(sorted((int(s[a]), int(s[b])))) for s in hull.simplices for a, b in ((0, 1), (1, 2), (0, 2))}))
    e = q[edges[:, 1]] - q[edges[:, 0]]
    d = np.cross(e[:, None], e[None]).reshape(-1, 3)
    d = d[np.linalg.norm(d, axis=1) > 1e-3]
    d /= np.linalg.norm(d, axis=1)[:, None]
    d = d[abs(d @ n) > 1 - 1e-6]  # within 1.4 mrad
    d *= np.sign(d @ n)[:, None]
    s = d @ q.T
    w = s.max(1) - s.min(1)
    b = int(np.argmin(w))
    width = w[b] if kind == "pads" else (w[b] - 60) / 2
    direction = d[b]
    assert abs(width - best) < 1e-8, (kind, width, best)
    if kind == "pads":
        slsqp = value(kind, p, None, normal(x))
        point = n * 0
    else:
        point = direction * (s[b].max() + s[b].min()) / 2
        slsqp = value(kind, p, normal(x) * x[2] * 1e-3, normal(x), circle2)
    v = value(kind, p, point, direction, circle2)
    assert abs(slsqp - v) < 1e-6, (kind, slsqp, v)
    return {m[1]: 0.0 for m in members}, width, v


def check(kind, seed, p, r, worst):
    rng = np.random.default_rng([1, seed])
    own, best, v = second(kind, p, rng)
    worst["objective"] = max(worst["objective"], abs(best - r["best"]), *(abs(own[k] - r["own"][k]) for k in own))
    worst["value"] = max(worst["value"], abs(v - r["value"]))
    members, both = KINDS[kind][:2], kind == "pads"
    C, ref = free(members), centre(members)
    base = residuals(members, p, r["own"], both, ref, r["M"])[0].max()
    for size in np.repeat(10.0 ** np.arange(-6, -2), 5000):
        E = exp(C @ (rng.uniform(-size, size, C.shape[1])))
        N = r["M"][0] @ E[0], r["M"][0] @ E[1] + r["M"][1]
        worst["gain"] = max(worst["gain"], base - residuals(members, p, r["own"], both, ref, N)[0].max())
    for _ in range(3):
        R, t = Rotation.from_rotvec(rng.uniform(-30e-6, 30e-6, 3)).as_matrix(), rng.uniform(-0.02, 0.02, 3)
        s = first(kind, {k: q @ R.T + t for k, q in p.items()})
        worst["moved"] = max(worst["moved"], abs(s["best"] - r["best"]), abs(s["value"] - r["value"]),
                             *(abs(s["own"][k] - r["own"][k]) for k in own))


def number(x):
    return np.round(np.asarray(x, float), 12).tolist()


def main():
    cases, worst = [], {"objective": 0.0, "value": 0.0, "gain": -1.0, "moved": 0.0}
    for kind in KINDS:
        seed = kept = 0
        while kept < 3:
            seed += 1
            assert seed < 100, kind
            parts = build(kind, seed)
            p = actual(parts)
            r = first(kind, p)
            if r["sharp"] < 0.02 or r["alone"] < 0.002:
                print(f"{kind} {seed}: not sharp ({r['sharp']:.4f}, {r['alone']:.4f})")
                continue
            kept += 1
            if "--check" in sys.argv:
                check(kind, seed, p, r, worst)
            name = {"pads": "parallelism", "opposite": "distance"}.get(kind, "coaxiality")
            cases.append({
                "kind": kind, "seed": seed,
                "features": {k: {"points": number(a), "normals": number(n), "deviations_mm": number(d),
                                 "sections": None if len(a) == 35 else [24] * 4} for k, (a, n, d) in parts.items()},
                "own_mm": {k: number(x) for k, x in r["own"].items()}, "objective_mm": number(r["best"]),
                "values": {name: number(r["value"])},
                "datum": {"point": number(r["point"] + 0.0), "direction": number(r["direction"] + 0.0)}})
            print(f"{kind} {seed}: {name} {r['value']:.12f} objective {r['best']:.12f} "
                  f"own {[round(float(x), 9) for x in r['own'].values()]} sharp {r['sharp']:.3f} alone {r['alone']:.4f}")
    if "--check" in sys.argv:
        print("largest differences, mm:", {k: f"{x:.1e}" for k, x in worst.items()})
        assert worst["objective"] < 1e-8 and worst["value"] < 1e-6 and worst["gain"] < 1e-12 and worst["moved"] < 1e-9, worst
    with open(OUT, "w") as file:
        file.write('{"cases":[\n' + ",\n".join(json.dumps(c, separators=(",", ":")) for c in cases) + "\n]}\n")


main()
