"""Circle fits LSC, MZC, MIC, MCC: exact methods, used by nas979.py and fits.py.

LSC  geometric least squares (min sum (|p-c|-r)^2): Gauss-Newton with full Hessian from many starts, polished in mpmath.
MCC  smallest enclosing circle: brute force over all pairs and triples.
MIC  largest circle without a point inside whose centre is a local maximum of the inscribed radius
     (centre inside the triangle of its three contact points); of these the largest inside the hull.
MZC  minimum zone: Chebyshev vertex (4 contact points) found by iterated LP, final vertex solved exactly
     from the contact points; `mzc_brute` checks all 2+2 and 3+1 candidates.
"""
from itertools import combinations

import mpmath as mp
import numpy as np
from scipy.optimize import linprog


def shift(p):
    """exact shift by a rounded mean so that large coordinates cost no digits (Sterbenz-like: kept as mpf)"""
    o = np.round(np.mean(p, axis=0))
    return o, p - o


def dist(p, c):
    return np.hypot(p[..., 0] - c[..., 0], p[..., 1] - c[..., 1])


def lsc_cost(p, c):
    d = dist(p, c)
    return float(np.sum((d - d.mean()) ** 2))


def lsc(p, digits=40, starts=None):
    """returns mpf cx, cy, r ; p (n,2) float (taken as exact)"""
    p = np.asarray(p, float)
    o, q = shift(p)
    from scipy.optimize import minimize
    fun = lambda c: lsc_cost(q, c)
    # algebraic (Kasa) start + others
    A = np.c_[2 * q, np.ones(len(q))]
    s = np.linalg.lstsq(A, (q ** 2).sum(1), rcond=None)[0]
    st = [s[:2], q.mean(0)] + ([np.asarray(x) - o for x in starts] if starts is not None else [])
    best = None
    for c0 in st:
        r = minimize(fun, c0, method="Nelder-Mead", options=dict(xatol=1e-10, fatol=1e-18, maxiter=4000))
        if best is None or r.fun < best.fun * (1 - 1e-12):
            best = r
    c = best.x
    with mp.workdps(digits):
        P = [(mp.mpf(float(a)) - mp.mpf(float(o[0])), mp.mpf(float(b)) - mp.mpf(float(o[1]))) for a, b in p]
        x, y = mp.mpf(float(c[0])), mp.mpf(float(c[1]))
        n = len(P)
        for it in range(100):
            # f = sum (d_i - r)^2, r = mean d ; Newton on (x,y), 2x2
            D = [mp.hypot(a - x, b - y) for a, b in P]
            U = [((x - a) / d, (y - b) / d) for (a, b), d in zip(P, D)]
            r = sum(D) / n
            R = [d - r for d in D]
            mu = (sum(u[0] for u in U) / n, sum(u[1] for u in U) / n)
            g = [2 * sum(e * u[k] for e, u in zip(R, U)) for k in (0, 1)]
            H = [[0, 0], [0, 0]]
            for i in (0, 1):
                for j in (0, 1):
                    H[i][j] = 2 * sum((u[i] - mu[i]) * (u[j] - mu[j]) + e / d * ((1 if i == j else 0) - u[i] * u[j])
                                      for e, u, d in zip(R, U, D))
            det = H[0][0] * H[1][1] - H[0][1] * H[1][0]
            dx = (H[1][1] * g[0] - H[0][1] * g[1]) / det
            dy = (H[0][0] * g[1] - H[1][0] * g[0]) / det
            x, y = x - dx, y - dy
            if abs(dx) + abs(dy) < mp.mpf(10) ** (-digits + 10) * (1 + r):
                break
        else:
            raise RuntimeError("lsc: no convergence")
        D = [mp.hypot(a - x, b - y) for a, b in P]
        return x + mp.mpf(float(o[0])), y + mp.mpf(float(o[1])), sum(D) / n, max(D) - min(D)


def circ3(a, b, c):
    """circumcentre, vectorised; rows"""
    ax, ay = a[..., 0], a[..., 1]
    bx, by = b[..., 0] - ax, b[..., 1] - ay
    cx, cy = c[..., 0] - ax, c[..., 1] - ay
    d = 2 * (bx * cy - by * cx)
    b2, c2 = bx * bx + by * by, cx * cx + cy * cy
    with np.errstate(all="ignore"):
        ux, uy = (cy * b2 - by * c2) / d, (bx * c2 - cx * b2) / d
    return np.stack([ax + ux, ay + uy], -1)


def circ3_mp(P):
    (ax, ay), (bx, by), (cx, cy) = P
    bx, by, cx, cy = bx - ax, by - ay, cx - ax, cy - ay
    d = 2 * (bx * cy - by * cx)
    b2, c2 = bx * bx + by * by, cx * cx + cy * cy
    return ax + (cy * b2 - by * c2) / d, ay + (bx * c2 - cx * b2) / d


def mpp(p):
    return [(mp.mpf(float(a)), mp.mpf(float(b))) for a, b in p]


def result_mp(p, x, y):
    D = [mp.hypot(a - x, b - y) for a, b in mpp(p)]
    return D


def far_max(q, cen, chunk=4000):
    return np.concatenate([dist(q[None], cen[i:i + chunk, None]).max(1) for i in range(0, len(cen), chunk)])


def near_min(q, cen, chunk=4000):
    return np.concatenate([dist(q[None], cen[i:i + chunk, None]).min(1) for i in range(0, len(cen), chunk)])


def mcc(p):
    p = np.asarray(p, float)
    o, q = shift(p)
    n = len(q)
    i2 = np.array(list(combinations(range(n), 2)))
    c2 = (q[i2[:, 0]] + q[i2[:, 1]]) / 2
    r2 = dist(q[i2[:, 0]], c2)
    i3 = np.array(list(combinations(range(n), 3)))
    c3 = circ3(q[i3[:, 0]], q[i3[:, 1]], q[i3[:, 2]])
    ok = np.isfinite(c3).all(1)
    i3, c3 = i3[ok], c3[ok]
    r3 = dist(q[i3[:, 0]], c3)
    best = None
    for idx, c, r in ((i2, c2, r2), (i3, c3, r3)):
        if len(c) == 0:
            continue
        scale = max(1, np.abs(q).max())
        m = far_max(q, c) <= r + 1e-9 * scale
        if m.any():
            k = np.where(m)[0][np.argmin(r[m])]
            if best is None or r[k] < best[0] - 1e-12 * scale:
                best = (r[k], idx[k])
    with mp.workdps(40):
        P = mpp(p[best[1]])
        if len(P) == 2:
            x, y = (P[0][0] + P[1][0]) / 2, (P[0][1] + P[1][1]) / 2
        else:
            x, y = circ3_mp(P)
        D = result_mp(p, x, y)
        return x, y, max(D), max(D) - min(D)


def mic(p, near=None, ties=None):
    """all local maxima of min distance that lie at a Delaunay-triangle interior; largest (or nearest to `near`)"""
    p = np.asarray(p, float)
    o, q = shift(p)
    i3 = np.array(list(combinations(range(len(q)), 3)))
    a, b, c = q[i3[:, 0]], q[i3[:, 1]], q[i3[:, 2]]
    cen = circ3(a, b, c)
    scale = max(1, np.abs(q).max())

    def side(u, v, w):
        return (v[:, 0] - u[:, 0]) * (w[:, 1] - u[:, 1]) - (v[:, 1] - u[:, 1]) * (w[:, 0] - u[:, 0])

    s = np.sign(side(a, b, c))
    eps = 1e-9 * scale * scale
    with np.errstate(all="ignore"):
        ok = (s * side(a, b, cen) >= -eps) & (s * side(b, c, cen) >= -eps) & (s * side(c, a, cen) >= -eps)
        ok &= np.isfinite(cen).all(1)
    i3, cen, a = i3[ok], cen[ok], a[ok]
    if len(cen) == 0:
        return None
    r = dist(a, cen)
    m = near_min(q, cen) >= r - 1e-9 * scale
    if not m.any():
        return None
    i3, cen, r = i3[m], cen[m], r[m]
    if near is None:
        k = np.argmax(r)
        if ties is not None:       # (radius deficit, distance of centres) of the other local maxima
            ties += [(float(r[k] - r[j]), float(dist(cen[k], cen[j]))) for j in range(len(r))
                     if dist(cen[k], cen[j]) > 1e-7 * scale]
    else:
        k = np.argmin(dist(cen, np.asarray(near) - o))
    with mp.workdps(40):
        x, y = circ3_mp(mpp(p[i3[k]]))
        D = result_mp(p, x, y)
        return x, y, min(D), max(D) - min(D)


def vertex_mp(p, outer, inner, c0):
    """solve |p_o - c| = R for outer, |p_i - c| = r for inner (4 contact points in all), Newton in mpmath"""
    with mp.workdps(40):
        pts = [(a, b, 1) for a, b in mpp(p[outer])] + [(a, b, 0) for a, b in mpp(p[inner])]
        x, y = mp.mpf(float(c0[0])), mp.mpf(float(c0[1]))
        R = max(mp.hypot(a - x, b - y) for a, b, k in pts)
        r = min(mp.hypot(a - x, b - y) for a, b, k in pts)
        for _ in range(60):
            J, F = mp.matrix(4, 4), mp.matrix(4, 1)
            for i, (a, b, k) in enumerate(pts):
                d = mp.hypot(a - x, b - y)
                J[i, 0], J[i, 1] = (x - a) / d, (y - b) / d
                J[i, 2], J[i, 3] = (-1, 0) if k else (0, -1)
                F[i] = d - (R if k else r)
            s = mp.lu_solve(J, -F)
            x, y, R, r = x + s[0], y + s[1], R + s[2], r + s[3]
            if max(abs(v) for v in s) < mp.mpf(10) ** -30:
                return x, y, R, r
        raise RuntimeError("vertex")


def mzc(p, c0=None):
    """local minimum-zone optimum reached from c0 (default LSC), exact vertex; returns mp cx, cy, width"""
    p = np.asarray(p, float)
    if c0 is None:
        c0 = [float(v) for v in lsc(p)[:2]]
    o = np.round(np.asarray(c0, float))
    q = p - o
    c = np.asarray(c0, float) - o
    for it in range(60):
        d = dist(q, c)
        u = (q - c) / d[:, None]
        # min w : lo <= d - u.b <= lo + w    vars b (2), lo, w ; shifted by mean
        m = d.mean()
        n = len(q)
        sc = max(np.ptp(d), 1e-12)
        e = (d - m) / sc
        A = np.vstack([np.c_[u, np.ones(n), np.zeros(n)], np.c_[-u, -np.ones(n), -np.ones(n)]])
        bb = np.r_[e, -e]
        r = linprog([0, 0, 0, 1], A_ub=A, b_ub=bb, bounds=[(None, None)] * 3 + [(0, None)], method="highs")
        if r.status != 0:
            raise RuntimeError("lp " + r.message)
        step = r.x[:2] * sc
        # damp to keep descending
        t, w0 = 1.0, np.ptp(d)
        while np.ptp(dist(q, c + t * step)) > w0 + 1e-13 * max(1, d.max()) and t > 1e-8:
            t /= 2
        c = c + t * step
        if np.hypot(*step) * t < 1e-13 * max(1, d.max()):
            break
    d = dist(q, c)
    tol = 1e-9 * max(1.0, d.max()) + 1e-7 * np.ptp(d)
    out = np.where(d > d.max() - tol)[0]
    inn = np.where(d < d.min() + tol)[0]
    # choose 4 contact points with KKT: outer/inner alternate; try all when more
    best = None
    for k in (2, 1, 3):
        for a in combinations(out, k):
            for b in combinations(inn, 4 - k):
                try:
                    x, y, R, rr = vertex_mp(p, list(a), list(b), c + o)
                except Exception:
                    continue
                D = result_mp(p, x, y)
                w = max(D) - min(D)
                if best is None or w < best[2]:
                    best = (x, y, w)
    if best is None:
        raise RuntimeError("mzc vertex: %d outer %d inner" % (len(out), len(inn)))
    return best


def mzc_brute(p, box=None):
    """global minimum zone over all candidates 2+2, 3+1, 1+3 with centre inside `box` (around mean; default: hull box)"""
    p = np.asarray(p, float)
    o, q = shift(p)
    n = len(q)
    lo, hi = q.min(0), q.max(0)
    best = [np.inf, None]
    cand = []

    def test(cen):
        ok = np.isfinite(cen).all(1)
        if box is None:
            ok &= (cen >= lo - (hi - lo)).all(1) & (cen <= hi + (hi - lo)).all(1)
        else:
            ok &= np.hypot(*(cen - (np.asarray(box[0]) - o)).T) < box[1]
        cen = cen[ok]
        for i in range(0, len(cen), 4000):
            d = dist(q[None], cen[i:i + 4000, None])
            w = d.max(1) - d.min(1)
            if len(w):
                k = np.argmin(w)
                for j in np.argsort(w)[:50]:
                    cand.append((w[j], cen[i + j] + o))
                if w[k] < best[0]:
                    best[0], best[1] = w[k], cen[i + k] + o

    i3 = np.array(list(combinations(range(n), 3)))
    test(circ3(q[i3[:, 0]], q[i3[:, 1]], q[i3[:, 2]]))
    pr = list(combinations(range(n), 2))
    A = np.array(pr)
    mid = (q[A[:, 0]] + q[A[:, 1]]) / 2
    dv = q[A[:, 1]] - q[A[:, 0]]
    k = (mid * dv).sum(1)
    for i in range(len(pr)):
        det = dv[i, 0] * dv[i + 1:, 1] - dv[i, 1] * dv[i + 1:, 0]
        with np.errstate(all="ignore"):
            x = (k[i] * dv[i + 1:, 1] - dv[i, 1] * k[i + 1:]) / det
            y = (dv[i, 0] * k[i + 1:] - k[i] * dv[i + 1:, 0]) / det
        test(np.stack([x, y], -1))
    wmax = best[0] + 1e-7 * max(best[0], 1e-3)
    ties = [float(np.hypot(*(c - best[1]))) for w, c in cand if w <= wmax and np.hypot(*(c - best[1])) > 1e-6]
    best.append(max(ties) if ties else 0.0)
    return best
