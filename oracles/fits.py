"""Circle fits of nasty point sets by exact methods -> crates/trueaxis-form/tests/data/circles.json

usage: python3 oracles/fits.py [--alglib BINARY]
LSC: Newton (full Hessian, 40 digits) from several starts; MCC, MIC: brute force over all pairs/triples, contact circle
with 40 digits; MZC: brute force over all 2+2, 3+1, 1+3 candidate centres inside the search box for n <= 40 (global), for
larger n by brute force too when near-circular and n <= 72; vertex with 40 digits.
mzc / mic are null where no such circle exists near the points (see `note`)."""
import json
import os
import random
import subprocess
import sys

import mpmath as mp
import numpy as np

import circlefit as cf
from model import versions

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis-form", "tests", "data")
ALG = sys.argv[sys.argv.index("--alglib") + 1] if "--alglib" in sys.argv else None


def ring(n, r, fun, c=(0, 0), a0=0.0, span=360.0, dig=9, jitter=0, rnd=None):
    out = []
    for i in range(n):
        t = np.radians(a0 + span * i / (n if span == 360 else n - 1) + (rnd.uniform(-jitter, jitter) if jitter else 0))
        d = r + fun(t)
        out.append((round(c[0] + d * np.cos(t), dig), round(c[1] + d * np.sin(t), dig)))
    return out


def sets():
    R = random.Random(2024)
    u = lambda s: (lambda t: R.uniform(-s, s))
    g = lambda s: (lambda t: R.gauss(0, s))
    lobe = lambda k, a, p=0.3: (lambda t: a * np.cos(k * t + p))
    yield "three_points", [(0, 10), (-9, -4), (8, -5)]
    yield "three_points_obtuse", [(0, 1), (-10, 0), (10, 0.5)]
    yield "four_points_square_bumped", [(10, 0), (0, 10.02), (-10, 0), (0, -10)]
    yield "four_points_random", [(round(10 * np.cos(t) + R.uniform(-.1, .1), 6), round(10 * np.sin(t) + R.uniform(-.1, .1), 6)) for t in (0.1, 1.9, 3.2, 5)]
    yield "five_points", ring(5, 25, u(0.05), (3, -7), 11, rnd=R)
    yield "six_points_exact_square_sym", [(10, 0), (-10, 0), (0, 10), (0, -10), (7.1, 7.1), (-7.0, -7.0)]
    yield "seven_points_noise", ring(7, 50, u(0.01), (100, 50))
    yield "eight_points_2lobe", ring(8, 50, lobe(2, 0.02), (1, 2))
    yield "twelve_3lobe", ring(12, 50, lobe(3, 0.01), (-4, 2))
    yield "24_5lobe_noise", ring(24, 31, lambda t: lobe(5, 0.004)(t) + R.gauss(0, 0.0007), (0.2, -0.1))
    yield "36_3lobe_ecc", ring(36, 15.5, lobe(3, 0.005), (0.03, -0.02), 1.7)
    yield "36_uniform_noise", ring(36, 118.3, u(0.02), (0, 0))
    yield "30_jittered_noise", ring(30, 20, u(0.003), (-2, 9), jitter=4, rnd=R)
    yield "72_gauss", ring(72, 118.3, g(0.006), (0.03, -0.02))
    yield "72_3lobe", ring(72, 118.3, lobe(3, 0.009), (0.01, 0.02))
    yield "72_5lobe_noise", ring(72, 104.9, lambda t: lobe(5, 0.008)(t) + R.uniform(-.002, .002), (0, 0))
    yield "60_spike", ring(60, 40, lambda t: R.gauss(0, 0.001) + (0.05 if abs(t - 2) < 0.05 else 0))
    yield "60_dent", ring(60, 40, lambda t: R.gauss(0, 0.001) - (0.05 if abs(t - 2) < 0.05 else 0))
    yield "40_large_coordinates", ring(40, 25, u(0.005), (51234.5, -87654.25), dig=7)
    yield "20_large_coordinates_small_circle", ring(20, 1.5, u(0.002), (3000.0, 1250.0), dig=7)
    yield "30_huge_radius_tiny_noise", ring(30, 1500, u(0.0002), (0, 0), dig=9)
    yield "40_form_much_larger", ring(40, 10, u(2.0), (1, 1))
    yield "20_ellipse", [(round(12 * np.cos(t), 9), round(10 * np.sin(t), 9)) for t in np.arange(20) * np.pi / 10 + 0.1]
    yield "36_limacon_ecc_5mm", ring(36, 50, lambda t: 5 * np.cos(t) + R.uniform(-.001, .001))
    yield "25_arc_200deg", ring(25, 30, u(0.004), (5, 5), 10, 200)
    yield "25_arc_120deg", ring(25, 30, u(0.002), (5, 5), 30, 120)
    yield "25_arc_60deg", ring(25, 30, u(0.001), (0, 0), 60, 60)
    yield "21_arc_30deg", ring(21, 100, u(0.001), (0, 0), 75, 30)
    yield "32_duplicates", ring(16, 20, u(0.01), (0, 0)) * 2
    yield "16_quantised_um", ring(16, 12, u(0.01), (0, 0), dig=3)


def alg(p, fit):
    t = "%d %d\n" % (fit, len(p)) + "\n".join("%r %r" % (float(a), float(b)) for a, b in p)
    o = subprocess.run([ALG], input=t, capture_output=True, text=True, check=True).stdout.split()
    return list(map(float, o))


def main():
    os.makedirs(OUT, exist_ok=True)
    res, worst, wl = [], {}, []
    for name, pts in sets():
        p = np.array(pts, float)
        n = len(p)
        arc = "_arc_" in name
        L = cf.lsc(p)
        c0 = np.array([float(L[0]), float(L[1])])
        rr = float(L[2])
        C = cf.mcc(p)
        tie = []
        I = cf.mic(p, ties=tie)
        note = []
        if any(a < 1e-9 * max(1, rr) for a, _ in tie):
            note.append("mic: not unique, another of equal radius %.3g away (width may differ, compare r only)" %
                        max(b for a, b in tie if a < 1e-9 * max(1, rr)))
        if I is None:
            note.append("mic: no inscribed circle with centre inside the hull of its contact points (unbounded)")
        # global MZC near the data: centre within 1.5 r of the LSC centre for full rings, 3 r of it for arcs
        if len(np.unique(p, axis=0)) <= 3:
            br, Z = None, None
            note.append("mzc: 3 points, width 0 at the circumcentre")
            x, y = cf.circ3_mp(cf.mpp(p))
            Z = (x, y, mp.mpf(0))
        else:
            box = (c0, 0.9 * rr if arc else 1.2 * rr)
            pu = np.unique(p, axis=0)
            br = cf.mzc_brute(pu, box=box)
            Z = cf.mzc(pu, br[1])
            if br[2] > 0:
                note.append("mzc: centre not unique (another of the same width %.3g away), compare width only" % br[2])
            if abs(float(Z[2]) - br[0]) > 1e-9 * max(1, rr):
                note.append("CHECK brute %r vertex %r" % (float(br[0]), float(Z[2])))
                print(name, note[-1])
            try:
                Zl = cf.mzc(pu, c0)
                if float(Zl[2]) > float(Z[2]) * (1 + 1e-9) + 1e-12:
                    note.append("mzc: descent from the LSC centre ends in a local minimum of width %r" % float(Zl[2]))
            except RuntimeError as e:
                note.append("mzc: descent from LSC failed")
            if np.hypot(float(Z[0]) - c0[0], float(Z[1]) - c0[1]) > 0.85 * box[1]:
                note.append("mzc: optimum near the search limit, distance %.3g from LSC centre" % np.hypot(float(Z[0]) - c0[0], float(Z[1]) - c0[1]))
        d = {"name": name, "points_mm": [list(map(float, a)) for a in p],
             "lsc": dict(zip(("cx", "cy", "r", "width"), map(float, L))),
             "mzc": dict(zip(("cx", "cy", "width"), map(float, Z))),
             "mic": None if I is None else dict(zip(("cx", "cy", "r", "width"), map(float, I))),
             "mcc": dict(zip(("cx", "cy", "r", "width"), map(float, C)))}
        if note:
            d["note"] = "; ".join(note)
        if ALG:
            for fit, key, mine in ((1, "mcc", C), (2, "mic", I), (3, "mzc", Z)):
                if mine is None or (key == "mzc" and n == 3):
                    continue
                a = alg(p, fit)
                x, y = a[0], a[1]
                dd = np.hypot(p[:, 0] - x, p[:, 1] - y)
                obj = {"mcc": dd.max() - float(mine[2]), "mic": float(mine[2]) - dd.min(), "mzc": dd.max() - dd.min() - float(mine[2])}[key]
                worst.setdefault(key, []).append((obj, name))
        res.append(d)
        print("%-36s n %2d lsc %.9g mzc %.9g mic %s mcc %.9g %s" % (name, n, L[3], Z[2], "-" if I is None else "%.9g" % I[3], C[3], d.get("note", "")))
    head = "oracle: oracles/fits.py; " + versions() + "; independent of the Rust code; exact methods, see the script"
    if ALG:
        for k, v in worst.items():
            v.sort()
            s = "alglib %s objective minus ours: min %.2e (%s), max %.2e (%s), n=%d, |d|<1e-6 in %d" % (
                k, v[0][0], v[0][1], v[-1][0], v[-1][1], len(v), sum(abs(x) < 1e-6 for x, _ in v))
            print(s)
            head += "; " + s
    with open(os.path.join(OUT, "circles.json"), "w") as fh:
        fh.write("[\n" + ",\n".join(json.dumps(d) for d in res) + "\n]\n")
    with open(os.path.join(OUT, "circles.header.txt"), "w") as fh:
        fh.write("\n".join("# " + l for l in head.split("; ")) + "\n# command: python3 oracles/fits.py [--alglib BINARY]\n")


main()
