"""Shared plain 4x4-matrix model of the test machines (used by the other oracle scripts).

Written only from shared/conventions.md and the data READMEs, in mpmath (50 digits).

Link (parent_from_link):
  linear : P . L . J(q) . E(q)
  rotary : P . L . E(q) . J(q)   error_frame "fixed"  (default)
           P . L . J(q) . E(q)   error_frame "moving"
  P = Trans(offset) . pre ; after everything: post
  L and E = Trans(d) . Rz(c) Ry(b) Rx(a)  (or Trans(d) . (I + [eps]x) if small_angle)
  J(q): q times sense; sense = -1 for primed (workpiece-carrying) axes, +1 else (ISO 841) unless given
workpiece_from_tip = inverse(bed_from_w) . bed_from_t . Trans(tip)
squareness="direction" (linear axes): P . Trans(d of L) . Trans(R_L . dir q) . E(q)
"""
import csv
import json
import os

import mpmath as mp
import numpy as np
from scipy.interpolate import CubicSpline

mp.mp.dps = 50
DIRS = "XYZABC"
NATURAL = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1), "A": (1, 0, 0), "B": (0, 1, 0), "C": (0, 0, 1)}


def trans(v):
    m = mp.eye(4)
    for i in range(3):
        m[i, 3] = mp.mpf(v[i])
    return m


def rot(axis, ang):
    """rotation about an arbitrary axis, Rodrigues, 4x4"""
    n = [mp.mpf(x) for x in axis]
    l = mp.sqrt(sum(x * x for x in n))
    n = [x / l for x in n]
    c, s = mp.cos(ang), mp.sin(ang)
    k = mp.matrix([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    r = mp.eye(3) + s * k + (1 - c) * (k * k)
    m = mp.eye(4)
    for i in range(3):
        for j in range(3):
            m[i, j] = r[i, j]
    return m


def six(e, small=False):
    """e = six values mm, rad -> 4x4"""
    if small:
        a, b, c = e[3:]
        r = mp.matrix([[1, -c, b, 0], [c, 1, -a, 0], [-b, a, 1, 0], [0, 0, 0, 1]])
    else:
        r = rot((0, 0, 1), e[5]) * rot((0, 1, 0), e[4]) * rot((1, 0, 0), e[3])
    return trans(e[:3]) * r


def ops(lst):
    m = mp.eye(4)
    for op, val in lst or []:
        if op == "t":
            m = m * trans(val)
        else:
            ax = {"rx": (1, 0, 0), "ry": (0, 1, 0), "rz": (0, 0, 1)}[op]
            m = m * rot(ax, mp.radians(mp.mpf(val)))
    return m


class Table:
    def __init__(self, x, y):
        self.s = CubicSpline(np.asarray(x, float), np.asarray(y, float), bc_type="not-a-knot")

    def __call__(self, q):
        return mp.mpf(float(self.s(float(q), extrapolate=False)))


def curve(d, rotary):
    t = d["type"]
    if t == "const":
        v = mp.mpf(d.get("value", d.get("c", 0)))
        return lambda q: v
    if t == "poly":
        co, x0, s = d["coef"], mp.mpf(d.get("x0", 0)), mp.mpf(d.get("s", 1))
        return lambda q: sum(mp.mpf(c) * ((q - x0) / s) ** k for k, c in enumerate(co))
    if t == "fourier":
        a0, te = mp.mpf(d.get("a0", 0)), d["terms"]
        return lambda q: a0 + sum(mp.mpf(a) * mp.cos(k * mp.radians(q)) + mp.mpf(b) * mp.sin(k * mp.radians(q))
                                  for k, a, b in te)
    if t == "table":
        return Table(d["x"], d["y"])
    raise ValueError(t)


class Body:
    pass


class Machine:
    def __init__(self, chain, bodies, error_frame="fixed", small_angle=False, squareness="carry"):
        self.small, self.frame, self.squareness = small_angle, error_frame, squareness
        toks = chain.split()
        ib = toks.index("b")
        self.work = [t.rstrip("'") for t in toks[:ib]][::-1]      # from bed to w
        self.tool = toks[ib + 1:]                                  # from bed to t
        self.axes = [t.rstrip("'") for t in toks if t not in ("w", "b", "t")]
        self.body = {}
        for name in self.work + self.tool:
            j = bodies.get(name, {})
            b = Body()
            b.name = name
            b.pre = trans(j.get("offset", (0, 0, 0))) * ops(j.get("pre"))
            b.post = ops(j.get("post"))
            b.rotary = name in "ABC"
            b.linear = name in "XYZ"
            b.dir = j.get("dir", NATURAL.get(name))
            b.sense = j.get("sense", -1 if name in self.work else 1)
            loc = j.get("location_um_urad", {})
            b.loc = [mp.mpf(loc.get(d, 0)) for d in DIRS]          # um, urad
            mo = j.get("motion_um_urad", {})
            b.mot = {d: curve(mo[d], b.rotary) for d in DIRS if d in mo}
            b.frame = j.get("error_frame", error_frame)
            self.body[name] = b
        self.tip = bodies["t"].get("tip", (0, 0, 0))

    def motion(self, b, q):
        q = mp.mpf(q) * b.sense
        if b.rotary:
            return rot(b.dir, mp.radians(q))
        n = mp.sqrt(sum(mp.mpf(x) ** 2 for x in b.dir))
        return trans([mp.mpf(x) / n * q for x in b.dir])

    @staticmethod
    def si(e):
        return [e[i] / (1000 if i < 3 else 1000000) for i in range(6)]

    def link(self, b, q, nominal):
        if not (b.rotary or b.linear):
            if nominal:
                return b.pre * b.post
            return b.pre * six(self.si(b.loc), self.small) * b.post
        J = self.motion(b, q)
        if nominal:
            return b.pre * J * b.post
        e = [b.mot[d](mp.mpf(q)) if d in b.mot else mp.mpf(0) for d in DIRS]
        E = six(self.si(e), self.small)
        L = six(self.si(b.loc), self.small)
        if b.linear:
            if self.squareness == "direction":
                R = L.copy()
                for i in range(3):
                    R[i, 3] = 0
                v = R * mp.matrix([J[0, 3], J[1, 3], J[2, 3], 0])
                return b.pre * trans([L[i, 3] for i in range(3)]) * trans([v[i] for i in range(3)]) * E * b.post
            return b.pre * L * J * E * b.post
        if b.frame == "fixed":
            return b.pre * L * E * J * b.post
        return b.pre * L * J * E * b.post

    def pose(self, q, nominal=False):
        """q: dict letter -> mm/deg.  returns tip (3), unit axis (3) in the workpiece frame, mpmath"""
        W, T = mp.eye(4), mp.eye(4)
        for n in self.work:
            W = W * self.link(self.body[n], q.get(n, 0), nominal)
        for n in self.tool:
            T = T * self.link(self.body[n], q.get(n, 0), nominal)
        M = mp.lu_solve_mat(W, T) if hasattr(mp, "lu_solve_mat") else (W ** -1) * T
        tip = M * mp.matrix([mp.mpf(x) for x in self.tip] + [1])
        ax = [M[i, 2] for i in range(3)]
        l = mp.sqrt(sum(x * x for x in ax))
        return [tip[i] for i in range(3)], [x / l for x in ax]


FRUSTUM = dict(h1=60, h2=25, h3=25, l1=310, Dc=250, alpha=15, beta=10, gamma=0, rp=(3100, 1250, -1200), D=20)


def xkas_bodies(data, motions=True):
    d = os.path.join(data, "xkas2525")
    f = FRUSTUM
    be = mp.radians(f["beta"])
    top = ((f["h1"] + f["h2"]) * mp.sin(be), mp.mpf(0),
           f["h3"] + f["l1"] * mp.sin(be) / 2 + (f["h1"] + f["h2"]) * mp.cos(be))
    bodies = {
        "X": {"offset": (0, -1500, 300)}, "Y": {"offset": (0, 1500, -150)}, "Z": {"offset": (0, 0, -250)},
        "C": {"offset": (0, 0, 100)}, "A": {"offset": (0, 0, 0)},
        "t": {"offset": (0, 0, -200), "tip": (0, 0, -100)},
        "w": {"offset": f["rp"], "post": [["rz", f["gamma"]], ["t", top], ["ry", f["beta"]]]},
    }
    with open(os.path.join(d, "location.csv")) as fh:
        for r in csv.DictReader(fh):
            bodies[r["body"]]["location_um_urad"] = {k: mp.mpf(r[k + ("_um" if k in "XYZ" else "_urad")]) for k in DIRS}
    for ax in "XYZCA":
        with open(os.path.join(d, ax + ".csv")) as fh:
            rows = list(csv.DictReader(fh))
        pos = [float(next(v for k, v in r.items() if k.startswith("position"))) for r in rows]
        bodies[ax]["motion_um_urad"] = {
            k: {"type": "table", "x": pos,
                "y": [float(r["E%s%s%s" % (k, ax, "_um" if k in "XYZ" else "_urad")]) for r in rows]} for k in DIRS}
    return bodies


def xkas2525(data, **kw):
    kw.setdefault("error_frame", "moving")
    return Machine("w b X Y Z C A t", xkas_bodies(data), **kw)


def json_machine(data, name, **kw):
    with open(os.path.join(data, "machines", name + ".json")) as fh:
        j = json.load(fh)
    return Machine(j["chain"], j["bodies"], **kw)


def load(data, name, **kw):
    return xkas2525(data, **kw) if name == "xkas2525" else json_machine(data, name, **kw)


def versions():
    import platform
    import scipy
    return "Python %s, numpy %s, scipy %s, mpmath %s" % (platform.python_version(), np.__version__, scipy.__version__,
                                                        mp.__version__)


def header(fh, script, note):
    fh.write("# oracle: oracles/%s  (independent of the Rust code)\n" % script)
    fh.write("# versions: %s\n" % versions())
    fh.write("# command: python3 oracles/%s [DATA_DIR=../shared/data]   (run in the repository root)\n" % script)
    for l in note.strip().splitlines():
        fh.write("# %s\n" % l.strip())
