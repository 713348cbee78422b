"""All inverse-kinematic solutions by brute force: multi-start Gauss-Newton on the two rotary angles over a grid of
starts, polished in mpmath, then a linear solve for X Y Z -> crates/trueaxis-machine/tests/data/solve/<machine>.csv
Travel is ignored; angles in (-180, 180]."""
import os
import random
import sys

import mpmath as mp
import numpy as np

from model import header, load, rot

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
DATA = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "..", "shared", "data")
OUT = os.path.join(ROOT, "crates", "trueaxis-machine", "tests", "data", "solve")


def rotmat(m, angles):
    """numpy: product of rotations of workpiece-inverse and tool side, third column"""
    def R(n, a, sense):
        d = np.array(m.body[n].dir, float)
        d /= np.linalg.norm(d)
        t = np.radians(a * sense)
        K = np.array([[0, -d[2], d[1]], [d[2], 0, -d[0]], [-d[1], d[0], 0]])
        return np.eye(3) + np.sin(t) * K + (1 - np.cos(t)) * K @ K
    return R


def axis_fun(m, q):
    """nominal tool axis (float) from the mp machine, fast path"""
    M = np.eye(3)
    R = rotmat(m, None)

    def fixed(T):
        return np.array([[float(T[i, j]) for j in range(3)] for i in range(3)])
    for n in m.work:
        b = m.body[n]
        M = M @ m._pre[n] @ (R(n, q[n], b.sense) if b.rotary else np.eye(3)) @ m._post[n]
    W = M
    M = np.eye(3)
    for n in m.tool:
        b = m.body[n]
        M = M @ m._pre[n] @ (R(n, q[n], b.sense) if b.rotary else np.eye(3)) @ m._post[n]
    return (W.T @ M)[:, 2]


def prepare(m):
    g = lambda T: np.array([[float(T[i, j]) for j in range(3)] for i in range(3)])
    m._pre = {n: g(m.body[n].pre) for n in m.body}
    m._post = {n: g(m.body[n].post) for n in m.body}
    m.rot = [a for a in m.axes if a in "ABC"]
    # order of the columns: chain order of the rotary axes
    m.lin = ["X", "Y", "Z"]


def wrap(a):
    a = a - 360 * mp.ceil((a - 180) / 360)
    return a


def solve_angles(m, target):
    r = m.rot
    t = np.array([float(x) for x in target])
    found = []
    f = lambda a: axis_fun(m, dict(zip(r, a))) - t
    for a0 in range(-180, 180, 36):
        for b0 in range(-180, 180, 36):
            a = np.array([a0 + 3.1, b0 + 1.7])
            lam, e = 1e-3, f(a)
            for _ in range(80):
                J = np.stack([(f(a + h) - f(a - h)) / 2e-4 for h in (np.array([1e-4, 0]), np.array([0, 1e-4]))], 1)
                s = np.linalg.solve(J.T @ J + lam * 1e-4 * np.eye(2), -J.T @ e)
                e2 = f(a + s)
                if e2 @ e2 <= e @ e:
                    a, e, lam = a + s, e2, lam / 10
                else:
                    lam *= 10
                if np.abs(s).max() < 1e-9 or lam > 1e12:
                    break
            if e @ e < 1e-14 and not any(max(abs((a - b + 180) % 360 - 180)) < 1e-4 for b in found):
                found.append(a)
    out = []
    for a in found:      # polish
        x = mp.matrix([mp.mpf(float(v)) for v in a])
        for _ in range(12):
            def F(u):
                return mp.matrix(m.pose(dict(zip(r, u)), True)[1]) - mp.matrix(target)
            h = mp.mpf(10) ** -20
            e = F(x)
            J = mp.matrix(3, 2)
            for k in (0, 1):
                y = x.copy(); y[k] += h
                z = x.copy(); z[k] -= h
                d = (F(y) - F(z)) / (2 * h)
                for i in range(3):
                    J[i, k] = d[i]
            s = mp.lu_solve(J.T * J, -(J.T * e))
            x = x + s
            if max(abs(v) for v in s) < mp.mpf(10) ** -22:
                break
        assert mp.norm(F(x)) < mp.mpf(10) ** -20, mp.norm(F(x))
        w = [wrap(v) for v in x]
        # snap -180+tiny to 180
        w = [mp.mpf(180) if abs(abs(v) - 180) < mp.mpf(10) ** -18 else v for v in w]
        w = [mp.mpf(0) if abs(v) < mp.mpf(10) ** -18 else v for v in w]
        out.append(w)
    return sorted(out)


def solve(m, tip, axis):
    """tip mm, axis (normalised here): list of dict"""
    l = mp.sqrt(sum(mp.mpf(x) ** 2 for x in axis))
    target = [mp.mpf(x) / l for x in axis]
    sols = []
    for w in solve_angles(m, target):
        q = dict(zip(m.rot, w))
        p0, _ = m.pose(q, True)
        A = mp.matrix(3, 3)
        for k, n in enumerate(m.lin):
            p, _ = m.pose({**q, n: 1}, True)
            for i in range(3):
                A[i, k] = p[i] - p0[i]
        x = mp.lu_solve(A, mp.matrix([mp.mpf(t) for t in tip]) - mp.matrix(p0))
        s = {**dict(zip(m.lin, x)), **q}
        p, a = m.pose(s, True)
        assert mp.norm(mp.matrix(p) - mp.matrix([mp.mpf(t) for t in tip])) < mp.mpf(10) ** -18
        sols.append(s)
    return sols


CASES = {"i5-engraver": [((10, 20, 30), (0.3, -0.2, 0.93)), ((0, 0, 0), (1, 0, 0)), ((5, -5, 1), (0, -1, 1)),
                         ((5, -5, 1), (0, 1, 1))],
         "nutating-head": [((10, 20, 30), (0.3, -0.2, 0.93)), ((10, 20, 30), (1, 1, 1))],
         "xkas2525": [((0, 0, -60), (-0.25881904510252074, 0, 0.9659258262890683)), ((10, 20, 30), (0.3, -0.2, 0.93))],
         "lei-hsu-mill": [((10, 20, 30), (0.3, -0.2, 0.93))], "head-table": [((10, 20, 30), (0.3, -0.2, 0.93))],
         "wyxzcat-gantry": [((10, 20, 30), (0.3, -0.2, 0.93))]}


def main():
    os.makedirs(OUT, exist_ok=True)
    for name, extra in CASES.items():
        m = load(DATA, name)
        prepare(m)
        rnd = random.Random("solve " + name)
        cases = list(extra)
        while len(cases) < 30:
            q = dict(zip(m.rot, (rnd.uniform(-178, 178), rnd.uniform(-178, 178))))
            _, a = m.pose(q, True)
            a = [round(float(x), 6) for x in a]
            if abs(a[2]) > 0.9999 or (name == "nutating-head" and a[2] < 0.01):
                continue
            cases.append((tuple(round(rnd.uniform(-120, 120), 3) for _ in range(3)), tuple(a)))
        counts = {}
        with open(os.path.join(OUT, name + ".csv"), "w") as fh:
            header(fh, "solve.py", "machine %s, nominal; axis vector as given to the solver (to be normalised); one row per solution, all "
                   "solutions with both angles in (-180, 180], travel ignored, sorted by the angles in chain order" % name)
            fh.write("case,tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k," + ",".join(m.lin + m.rot) + "\n")
            for i, (tip, ax) in enumerate(cases):
                sols = solve(m, tip, ax)
                counts[len(sols)] = counts.get(len(sols), 0) + 1
                for s in sols:
                    fh.write(",".join([str(i)] + [repr(float(v)) for v in (*tip, *ax)] + [repr(float(s[k])) for k in m.lin + m.rot]) + "\n")
        print(name, "cases by number of solutions", counts)


main()
