"""Prediction of the NAS979 cone on XKAS2525 (document 000): a second, vectorised float64 model (numpy), checked
against model.py (mpmath, 50 digits) -> crates/trueaxis/tests/data/nas979-xkas2525.json and .csv

usage: python3 oracles/nas979.py [DATA_DIR] [--mc N]
"""
import json
import os
import sys

import mpmath as mp
import numpy as np
from scipy.interpolate import CubicSpline

import circlefit as cf
import model as mo

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
args = [a for a in sys.argv[1:]]
NMC = 20000
if "--mc" in args:
    i = args.index("--mc")
    NMC = int(args[i + 1])
    del args[i:i + 2]
DATA = args[0] if args else os.path.join(ROOT, "..", "shared", "data")
OUT = os.path.join(ROOT, "crates", "trueaxis", "tests", "data")

F = mo.FRUSTUM
AL, BE = np.radians(F["alpha"]), np.radians(F["beta"])
M = 72
PHI = np.radians(np.arange(M) * 360.0 / M)
# exact zeros where cos/sin vanish
COS, SIN = np.cos(PHI), np.sin(PHI)
COS[np.abs(COS) < 1e-15] = 0
SIN[np.abs(SIN) < 1e-15] = 0
HS = np.array([0.0, 25.0, 50.0, 60.0])
N = np.c_[-np.sin(AL) * COS, -np.sin(AL) * SIN, np.full(M, np.cos(AL))]
NF = np.c_[np.cos(AL) * COS, np.cos(AL) * SIN, np.full(M, np.sin(AL))]
RB = F["Dc"] / 2
RW = np.c_[RB * COS, RB * SIN, np.full(M, -float(F["h1"]))] + F["D"] / 2 * NF     # nominal tip, workpiece frame
RSEC = RB - HS * np.tan(AL)

BODIES = ["w", "X", "Y", "Z", "C", "A", "t"]
AX = ["X", "Y", "Z", "C", "A"]
OFF = {"w": F["rp"], "X": (0, -1500, 300), "Y": (0, 1500, -150), "Z": (0, 0, -250), "C": (0, 0, 100), "A": (0, 0, 0),
       "t": (0, 0, -200)}
TIP = np.array([0, 0, -100.0])
TOP = np.array([(F["h1"] + F["h2"]) * np.sin(BE), 0,
                F["h3"] + F["l1"] * np.sin(BE) / 2 + (F["h1"] + F["h2"]) * np.cos(BE)])
RY = np.array([[np.cos(BE), 0, np.sin(BE)], [0, 1, 0], [-np.sin(BE), 0, np.cos(BE)]])
BO = mo.xkas_bodies(DATA)
LOC = np.array([[float(v) for v in [BO[b]["location_um_urad"][d] for d in mo.DIRS]] for b in BODIES])   # 7 x 6
SPL = [[CubicSpline(BO[a]["motion_um_urad"][d]["x"], BO[a]["motion_um_urad"][d]["y"], bc_type="not-a-knot")
        for d in mo.DIRS] for a in AX]


def rx(a):
    c, s, o, l = np.cos(a), np.sin(a), np.zeros_like(a), np.ones_like(a)
    return np.stack([np.stack([l, o, o], -1), np.stack([o, c, -s], -1), np.stack([o, s, c], -1)], -2)


def rz(a):
    c, s, o, l = np.cos(a), np.sin(a), np.zeros_like(a), np.ones_like(a)
    return np.stack([np.stack([c, -s, o], -1), np.stack([s, c, o], -1), np.stack([o, o, l], -1)], -2)


def r6(e):
    """Rz(c) Ry(b) Rx(a), e (...,3) rad"""
    ca, sa, cb, sb, cc, sc = (f(e[..., i]) for i in range(3) for f in (np.cos, np.sin))
    return np.stack([np.stack([cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa], -1),
                     np.stack([sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa], -1),
                     np.stack([-sb, cb * sa, cb * ca], -1)], -2)


def commands(nominal_setting=(0.0, 0.0)):
    v = N @ RY.T
    A = np.degrees(np.arctan2(np.hypot(v[:, 0], v[:, 1]), v[:, 2]))
    C = np.degrees(np.arctan2(v[:, 0], -v[:, 1]))
    for i in range(1, M):
        C[i] += 360 * np.round((C[i - 1] - C[i]) / 360)
    C0, A0 = nominal_setting
    C, A = np.r_[C, C0], np.r_[A, A0]
    tipw = np.r_[RW, np.zeros((1, 3))]
    bed = np.array(F["rp"], float) + TOP + tipw @ RY.T
    R = rz(np.radians(C)) @ rx(np.radians(A))
    arm = R @ (np.array(OFF["t"]) + TIP)
    s = sum(np.array(OFF[a], float) for a in AX)
    lin = bed - arm - s
    return np.c_[lin, C, A]           # (M+1, 5) X Y Z C A, last = setting


def motions(cmd):
    """(M+1, 5, 6) um urad"""
    e = np.stack([np.stack([s(cmd[:, i], extrapolate=False) for s in SPL[i]], -1) for i in range(5)], 1)
    assert np.isfinite(e).all(), "outside a table"
    return e


def tool(cmd, loc, mot):
    """actual tip, axis in workpiece frame. loc (...,7,6) mot (...,P,5,6); um urad"""
    si = np.array([1e-3] * 3 + [1e-6] * 3)
    loc, mot = loc * si, mot * si
    loc = loc[..., None, :, :]                       # broadcast over P
    J = [None] * 5
    p = TIP + 0.0
    # from the tool back to the bed: point p and direction z
    Rt = r6(loc[..., 6, 3:])
    p = np.array(OFF["t"], float) + loc[..., 6, :3] + Rt @ TIP
    d = Rt[..., :, 2]

    def app(R, v):
        return np.einsum("...ij,...j->...i", R, v)
    for k in (4, 3):      # A, C moving frame: P . L . J . E
        E = r6(mot[..., k, 3:])
        Jr = (rx if k == 4 else rz)(np.radians(cmd[:, k]))
        L = r6(loc[..., 1 + k, 3:])
        p = mot[..., k, :3] + app(E, p)
        d = app(E, d)
        p, d = app(L, app(Jr, p)), app(L, app(Jr, d))
        p = np.array(OFF[AX[k]], float) + loc[..., 1 + k, :3] + p
    for k in (2, 1, 0):
        E = r6(mot[..., k, 3:])
        L = r6(loc[..., 1 + k, 3:])
        p = mot[..., k, :3] + app(E, p)
        d = app(E, d)
        q = np.zeros(3)
        q[k] = 1
        p = p + cmd[:, k, None] * q
        p, d = app(L, p), app(L, d)
        p = np.array(OFF[AX[k]], float) + loc[..., 1 + k, :3] + p
    # workpiece: inverse of Trans(rp) L Trans(top) Ry
    L = r6(loc[..., 0, 3:])
    LT = np.swapaxes(L, -1, -2)
    p = app(LT, p - np.array(F["rp"], float) - loc[..., 0, :3])
    d = app(LT, d)
    p = app(RY.T, p - TOP)
    d = app(RY.T, d)
    return p, d


def errors(cmd, loc, mot):
    """E (...,4,M), Ev (...,4,M,3) mm"""
    p, d = tool(cmd, loc, mot)
    tipn = np.r_[RW, np.zeros((1, 3))]
    dev = p - tipn
    ev0 = dev[..., :M, :] - dev[..., M:, :]
    dd = d[..., :M, :] - N
    Ev = np.stack([ev0 + h / np.cos(AL) * dd for h in HS], -3)
    E = np.einsum("...mi,mi->...m", Ev, NF)
    return E, Ev


def sect_points(E):
    r = RSEC[:, None] + E / np.cos(AL)
    return np.stack([r * COS, r * SIN], -1)          # (...,4,M,2)


def lsc_vec(P):
    """geometric least squares, vectorised Gauss-Newton; P (...,M,2) -> centre (...,2), roundness"""
    c = P.mean(-2)
    for _ in range(12):
        v = P - c[..., None, :]
        d = np.hypot(v[..., 0], v[..., 1])
        u = v / d[..., None]
        um = u.mean(-2, keepdims=True)
        e = d - d.mean(-1, keepdims=True)
        w = u - um
        H = np.einsum("...mi,...mj->...ij", w, w) - np.einsum("...m,...mi,...mj->...ij", e / d, w * 0 + u, u) \
            + (e / d).sum(-1)[..., None, None] * np.eye(2)
        # Hessian of sum e^2/2:  sum w w^T + e/d (u u^T - I) with sign of second derivative of d
        H = np.einsum("...mi,...mj->...ij", w, w) + (e / d).sum(-1)[..., None, None] * np.eye(2) \
            - np.einsum("...m,...mi,...mj->...ij", e / d, u, u)
        g = -np.einsum("...m,...mi->...i", e, u)
        c = c - np.linalg.solve(H, g[..., None])[..., 0]
    v = P - c[..., None, :]
    d = np.hypot(v[..., 0], v[..., 1])
    return c, d.max(-1) - d.min(-1)


NAMES = ["volumetric_max", "paper_roundness", "paper_angularity", "paper_coaxiality", "paper_coaxiality_diameter",
         "iso_roundness_lsc", "iso_roundness_mzc", "iso_roundness_mic", "iso_roundness_mcc", "iso_coaxiality",
         "iso_angularity_zone"]


def fast(E, Ev):
    """indices without MZ/MI/MC, all positions: dict name -> (...)"""
    r = {}
    r["volumetric_max"] = np.sqrt((Ev[..., 0, :, :] ** 2).sum(-1)).max(-1)
    c, w = lsc_vec(sect_points(E))
    for k in range(4):
        s = "@%d" % (k + 1)
        r["paper_roundness" + s] = (E[..., k, :].max(-1) - E[..., k, :].min(-1)) / 2
        r["paper_coaxiality" + s] = np.hypot(Ev[..., k, :, 0].mean(-1), Ev[..., k, :, 1].mean(-1))
        r["paper_coaxiality_diameter" + s] = 2 * r["paper_coaxiality" + s]
        r["paper_angularity" + s] = (E[..., k, :] - E[..., 0, :]).max(-1)
        r["iso_roundness_lsc" + s] = w[..., k]
        r["iso_coaxiality" + s] = 2 * np.hypot(c[..., k, 0], c[..., k, 1])
        r["volumetric_max" + s] = np.sqrt((Ev[..., k, :, :] ** 2).sum(-1)).max(-1)
    Z = E[..., :3, :]
    r["iso_angularity_zone"] = (Z.max(-2) - Z.min(-2)).max(-1)
    return r


def full(E, Ev, mz_pos=(1,)):
    """one sample, exact MZC/MIC/MCC at the given positions (0-based)"""
    r = {k: float(v) for k, v in fast(E, Ev).items()}
    P = sect_points(E)
    for k in mz_pos:
        s = "@%d" % (k + 1)
        c0 = [float(v) for v in lsc_vec(P[k])[0]]
        r["iso_roundness_mzc" + s] = float(mzc_fast(P[k], c0)[1])
        if k == 1:          # exact: the largest of all inscribed circles
            r["iso_roundness_mic" + s] = mic_exact(P[k])[1]
        else:
            r["iso_roundness_mic" + s] = mic_mcc_fast(P[k], c0, -1)[1]
        r["iso_roundness_mcc" + s] = mic_mcc_fast(P[k], c0, +1)[1]
    return main_names(r)


def main_names(r):
    for n in ("paper_roundness", "paper_coaxiality", "paper_coaxiality_diameter", "iso_roundness_lsc", "iso_roundness_mzc",
              "iso_roundness_mic", "iso_roundness_mcc", "iso_coaxiality"):
        if n + "@2" in r:
            r[n] = r[n + "@2"]
    r["paper_angularity"] = r["paper_angularity@3"]
    return r


def iterate_lp(q, c, build):
    from scipy.optimize import linprog
    for _ in range(20):
        v = q - c
        d = np.hypot(v[:, 0], v[:, 1])
        u = v / d[:, None]
        sc = np.ptp(d)
        if sc < 1e-12:
            return c
        e = (d - d.mean()) / sc
        cost, A, b = build(u, e)
        r = linprog(cost, A_ub=A, b_ub=b, bounds=[(None, None)] * len(cost), method="highs")
        step = r.x[:2] * sc
        c = c + step
        if np.hypot(*step) < 1e-13:
            break
    return c


def mzc_fast(q, c0):
    n = len(q)
    one, zero = np.ones(n), np.zeros(n)
    c = iterate_lp(q, np.array(c0), lambda u, e: ([0, 0, -1, 1], np.vstack(
        [np.c_[u, one, zero], np.c_[-u, zero, -one]]), np.r_[e, -e]))
    d = np.hypot(*(q - c).T)
    return c, d.max() - d.min()


TRI = None


def mic_exact(q):
    """largest inscribed circle over all point triples (float64); returns centre, max - min, second-best deficit"""
    global TRI
    if TRI is None:
        from itertools import combinations
        TRI = np.array(list(combinations(range(len(q)), 3)))
    a, b, c = q[TRI[:, 0]], q[TRI[:, 1]], q[TRI[:, 2]]
    # centre in the triangle <=> acute
    l = [((u - v) ** 2).sum(1) for u, v in ((b, c), (c, a), (a, b))]
    m = np.maximum(np.maximum(l[0], l[1]), l[2])
    ok = 2 * m <= sum(l) + 1e-6
    a, cen = a[ok], cf.circ3(a[ok], b[ok], c[ok])
    r = cf.dist(a, cen)
    ok = cf.near_min(q, cen) >= r - 1e-10
    cen, r = cen[ok], r[ok]
    k = np.argmax(r)
    d = np.hypot(*(q - cen[k]).T)
    far = cf.dist(cen, cen[k]) > 1e-6
    return cen[k], float(d.max() - d.min()), (float(r[k] - r[far].max()) if far.any() else None)


def mic_mcc_fast(q, c0, sign):
    n = len(q)
    one = np.ones(n)
    if sign > 0:             # circle on the farthest pair as diameter, if it encloses all
        dd = ((q[:, None] - q[None]) ** 2).sum(-1)
        i, j = np.unravel_index(np.argmax(dd), dd.shape)
        c = (q[i] + q[j]) / 2
        d = np.hypot(*(q - c).T)
        if d.max() <= np.sqrt(dd[i, j]) / 2 + 1e-12:
            return c, float(d.max() - d.min())
    if sign < 0:     # max r: r <= e - u b
        c = iterate_lp(q, np.array(c0), lambda u, e: ([0, 0, -1], np.c_[u, one], e))
    else:            # min R: e - u b <= R
        c = iterate_lp(q, np.array(c0), lambda u, e: ([0, 0, 1], np.c_[-u, -one], -e))
    d = np.hypot(*(q - c).T)
    return c, float(d.max() - d.min())


def factor(i):
    """(name, loc delta 7x6, mot delta 5x6) of input i of 72, unit 1 sigma (0.5 um, 1 urad)"""
    l, m = np.zeros((7, 6)), np.zeros((5, 6))
    if i < 42:
        b, d = divmod(i, 6)
        l[b, d] = 0.5 if d < 3 else 1.0
        return "E%s0%s" % (mo.DIRS[d], BODIES[b]), l, m
    a, d = divmod(i - 42, 6)
    m[a, d] = 0.5 if d < 3 else 1.0
    return "E%s%s" % (mo.DIRS[d], AX[a]), l, m


def isolate(i, loc, mot):
    """(alone, without) for input i"""
    la, ma = np.zeros_like(loc), np.zeros_like(mot)
    lw, mw = loc.copy(), mot.copy()
    if i < 42:
        b, d = divmod(i, 6)
        la[b, d] = loc[b, d]
        lw[b, d] = 0
    else:
        a, d = divmod(i - 42, 6)
        ma[:, a, d] = mot[:, a, d]
        mw[:, a, d] = 0
    return (la, ma), (lw, mw)


def cross_check(cmd, E):
    """model.py (mpmath) against this model"""
    m = mo.xkas2525(DATA)
    worst = 0
    q0 = dict(zip(AX, cmd[M]))
    tn0, _ = m.pose(q0, True)
    ta0, _ = m.pose(q0)
    Emp = np.zeros((4, M))
    for i in range(M):
        q = dict(zip(AX, cmd[i]))
        tn, an = m.pose(q, True)
        ta, aa = m.pose(q)
        worst = max(worst, max(abs(float(tn[j]) - RW[i, j]) for j in range(3)), max(abs(float(an[j]) - N[i, j]) for j in range(3)))
        for k, h in enumerate(HS):
            ev = [(ta[j] - ta0[j]) - (tn[j] - tn0[j]) + mp.mpf(h) / mp.cos(mp.radians(F["alpha"])) * (aa[j] - an[j]) for j in range(3)]
            Emp[k, i] = float(sum(mp.mpf(float(NF[i, j])) * ev[j] for j in range(3)))
    return worst, float(np.abs(Emp - E).max()), Emp


def run(setting, mc, blame):
    cmd = commands(setting)
    mot = motions(cmd)
    E, Ev = errors(cmd, LOC, mot)
    nomdiff, ediff, Emp = cross_check(cmd, E)
    print("nominal check %.2e mm, E float64 vs mpmath %.2e mm" % (nomdiff, ediff))
    base = full(E, Ev, range(4))
    P = sect_points(E)
    out = {"setting_pose_deg": {"C": setting[0], "A": setting[1]},
           "setting_command": dict(zip(AX, map(float, cmd[M]))),
           "check_nominal_mm": nomdiff, "check_E_float64_vs_mpmath_mm": ediff}
    # exact circles
    sec = []
    for k in range(4):
        c0 = [float(v) for v in lsc_vec(P[k])[0]]
        L = cf.lsc(P[k])
        Z = cf.mzc(P[k], c0)
        I, C = cf.mic(P[k]), cf.mcc(P[k])
        br = cf.mzc_brute(P[k][::1], box=((0, 0), 0.5)) if k == 1 and blame else None
        s = {"position": k + 1, "z_mm": float(HS[k] - F["h1"]), "nominal_radius_mm": float(RSEC[k]),
             "lsc": {"cx": float(L[0]), "cy": float(L[1]), "r": float(L[2]), "width": float(L[3])},
             "mzc": {"cx": float(Z[0]), "cy": float(Z[1]), "width": float(Z[2])},
             "mic": {"cx": float(I[0]), "cy": float(I[1]), "r": float(I[2]), "width": float(I[3])},
             "mcc": {"cx": float(C[0]), "cy": float(C[1]), "r": float(C[2]), "width": float(C[3])}}
        if br:
            s["mzc_brute_force_width"] = float(br[0])
            print("mzc brute", br[0], "vertex", float(Z[2]))
        sec.append(s)
        for n, v in (("lsc", L[3]), ("mzc", Z[2]), ("mic", I[3]), ("mcc", C[3])):
            d = abs(float(v) - base["iso_roundness_%s@%d" % (n, k + 1)])
            if d > 1e-11:
                print("  fit difference", n, k + 1, d)
    out["sections"] = sec
    # uncertainty
    lin = {k: 0.0 for k in base}
    lin1 = {k: 0.0 for k in base}
    sens = {}
    for i in range(72):
        nme, l, m = factor(i)
        sens[nme] = {}
        for h, acc in ((1.0, lin1), (0.01, lin)):
            if h == 1.0 or True:
                fp = full(*errors(cmd, LOC + h * l, mot + h * m), range(4))
                fm = full(*errors(cmd, LOC - h * l, mot - h * m), range(4))
                for k in base:
                    g = (fp[k] - fm[k]) / (2 * h)
                    acc[k] += g * g
                    if h == 0.01 and k in NAMES:
                        sens[nme][k] = g
    lin = {k: float(np.sqrt(v)) for k, v in lin.items()}
    lin1 = {k: float(np.sqrt(v)) for k, v in lin1.items()}
    mcs = {}
    if mc:
        rng = np.random.default_rng(20240979)
        acc = {}
        D = [factor(i) for i in range(72)]
        DL, DM = np.array([d[1] for d in D]), np.array([d[2] for d in D])
        done = 0
        while done < mc:
            s = min(400, mc - done)
            z = rng.standard_normal((s, 72))
            e, ev = errors(cmd, LOC + np.tensordot(z, DL, 1), mot + np.tensordot(z, DM, 1)[:, None])
            r = {k: v for k, v in fast(e, ev).items()}
            p = sect_points(e)[:, 1]
            c, _ = lsc_vec(p)
            w = {n: [] for n in ("mzc", "mic", "mcc")}
            if done < MCZ:
                for j in range(s):
                    w["mzc"].append(mzc_fast(p[j], c[j])[1])
                    w["mic"].append(mic_mcc_fast(p[j], c[j], -1)[1])
                    w["mcc"].append(mic_mcc_fast(p[j], c[j], 1)[1])
                for n in w:
                    r["iso_roundness_%s@2" % n] = np.array(w[n])
            r = main_names(r)
            for k, v in r.items():
                acc.setdefault(k, []).append(v)
            done += s
        for k, v in acc.items():
            v = np.concatenate(v)
            mcs[k] = {"mean": float(v.mean()), "u": float(v.std(ddof=1)), "n": int(len(v)),
                      "p2.5": float(np.quantile(v, .025)), "p97.5": float(np.quantile(v, .975))}
    ind = {}
    for k in sorted(base):
        ind[k] = {"value": base[k], "u_linear_step_0.01": lin[k], "u_linear_step_1": lin1[k]}
        if k in mcs:
            ind[k]["monte_carlo"] = mcs[k]
    out["indices_mm"] = {k: ind[k] for k in NAMES}
    out["indices_all_positions_mm"] = {k: v for k, v in ind.items() if "@" in k}
    out["sensitivity_mm_per_sigma"] = sens if blame else None
    if blame:
        bl, amb = {}, []
        for i in range(72):
            nme = factor(i)[0]
            (la, ma), (lw, mw) = isolate(i, LOC, mot)
            a, w = full(*errors(cmd, la, ma)), full(*errors(cmd, lw, mw))
            bl[nme] = {k: {"alone_mm": a[k], "without_mm": w[k]} for k in NAMES}
            for kind, x in (("alone", (la, ma)), ("without", (lw, mw))):
                e, _ = errors(cmd, *x)
                if np.ptp(e[1]) > 1e-9:
                    g = mic_exact(sect_points(e)[1])[2]
                    if g is not None and g < 1e-7:
                        amb.append("%s %s" % (nme, kind))
        out["blame"] = bl
        out["mic_ambiguous"] = amb
    else:
        del out["sensitivity_mm_per_sigma"]
    return cmd, E, Ev, out


MCZ = 4000


def main():
    os.makedirs(OUT, exist_ok=True)
    cmd, E, Ev, res = run((0.0, 0.0), NMC, True)
    cmd2, E2, Ev2, res2 = run((90.0, 10.0), 0, False)
    doc = {"header": {"oracle": "oracles/nas979.py (independent of the Rust code)", "versions": mo.versions(),
                      "command": "python3 oracles/nas979.py [DATA_DIR=../shared/data] [--mc %d]" % NMC,
                      "units": "mm, deg; u = standard uncertainty (0.5 um / 1 urad per constant and per curve)",
                      "names": "index@k = the same index at position k (z -60, -35, -10, 0); without @: roundness and "
                               "coaxiality at 2, paper_angularity = max over azimuth of E(50)-E(0) (= @3)",
                      "mic_ambiguous": "blame entries in which a second inscribed circle with another centre has a radius "
                                       "within 1e-7 mm: the MIC roundness there depends on which is taken (here the larger)",
                      "monte_carlo": "numpy default_rng(20240979); MZC/MIC/MCC from the first %d samples" % min(MCZ, NMC)},
           "heights_mm": list(HS), "m": M, "tool_diameter_mm": F["D"]}
    doc.update(res)
    doc["setting_variant_C90_A10"] = res2
    with open(os.path.join(OUT, "nas979-xkas2525.json"), "w") as fh:
        json.dump(doc, fh, indent=1)
        fh.write("\n")
    for fn, c, e, ev in (("nas979-xkas2525.csv", cmd, E, Ev), ("nas979-xkas2525.setting-C90-A10.csv", cmd2, E2, Ev2)):
        with open(os.path.join(OUT, fn), "w") as fh:
            mo.header(fh, "nas979.py", "commands (mm, deg) of the 72 tool positions and E_H at H = 0, 25, 50, 60 mm, E_v at H = 0 (workpiece frame)\n"
                      "setting command X,Y,Z,C,A = " + " ".join(repr(float(x)) for x in c[M]))
            fh.write("azimuth_deg,X,Y,Z,C,A,E0_mm,E25_mm,E50_mm,E60_mm,Ev_x_mm,Ev_y_mm,Ev_z_mm\n")
            for i in range(M):
                fh.write(",".join(repr(float(x)) for x in [i * 360 / M, *c[i], *e[:, i], *ev[0, i]]) + "\n")
    for k, v in doc["indices_mm"].items():
        print("%-28s %.12f u_lin %.6e step1 %.6e mc %s | C90A10 %.9f" % (
            k, v["value"], v["u_linear_step_0.01"], v["u_linear_step_1"],
            "%.6e mean %.6f" % (v["monte_carlo"]["u"], v["monte_carlo"]["mean"]) if "monte_carlo" in v else "-",
            res2["indices_mm"][k]["value"]))


main()
