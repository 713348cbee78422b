"""Poses and deviations of the test machines -> crates/trueaxis-machine/tests/data/poses/*.csv"""
import os
import random
import sys

import mpmath as mp
from model import header, load

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
DATA = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "..", "shared", "data")
OUT = os.path.join(ROOT, "crates", "trueaxis-machine", "tests", "data", "poses")

TRAVEL = {
    "xkas2525": dict(X=(0, 6200), Y=(0, 2500), Z=(-1000, 0), C=(-360, 360), A=(-105, 105)),
    "i5-engraver": dict(X=(-180, 180), Y=(-110, 110), Z=(-105, 105), A=(-135, 135), C=(-180, 180)),
    "lei-hsu-mill": dict(X=(-300, 300), Y=(-300, 300), Z=(-300, 300), A=(-100, 100), C=(-180, 180)),
    "head-table": dict(X=(-300, 300), Y=(-300, 300), Z=(-300, 300), B=(-100, 100), C=(-180, 180)),
    "nutating-head": dict(X=(-300, 300), Y=(-300, 300), Z=(-300, 300), B=(-180, 180), C=(-180, 180)),
    "wyxzcat-gantry": dict(X=(-1250, 1250), Y=(-2000, 2000), Z=(-500, 500), C=(-360, 360), A=(-110, 110)),
}
SPECIAL = {
    "xkas2525": [dict(X=3000, Y=1200, Z=-700, C=-90, A=15), dict(X=0, Y=0, Z=0, C=0, A=0),
                 dict(X=6200, Y=2500, Z=-1000, C=360, A=-105)],
    "i5-engraver": [dict(X=0, Y=0, Z=0, A=0, C=0), dict(X=10, Y=20, Z=-5, A=30, C=45)],
}


def f(x):
    return repr(float(x))


def write(name, fname, poses, axes, note, **kw):
    m = load(DATA, name, **kw)
    with open(os.path.join(OUT, fname), "w") as fh:
        header(fh, "machine_poses.py", note)
        fh.write(",".join(axes) + ",tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k,"
                 "dev_x_um,dev_y_um,dev_z_um,dev_i_urad,dev_j_urad,dev_k_urad\n")
        for q in poses:
            qq = {k: mp.mpf(v) for k, v in q.items()}
            tn, an = m.pose(qq, True)
            ta, aa = m.pose(qq, False)
            row = [repr(q[k]) for k in axes] + [f(x) for x in tn + an]
            row += [f((a - b) * 1000) for a, b in zip(ta, tn)] + [f((a - b) * 1000000) for a, b in zip(aa, an)]
            fh.write(",".join(row) + "\n")


def main():
    os.makedirs(OUT, exist_ok=True)
    common = ("machine %s: tip and tool axis nominal, in the workpiece frame of the mounting; dev = actual - nominal\n"
              "chain evaluated with 50 digits; axis columns mm / deg; ")
    for name, tr in TRAVEL.items():
        rnd = random.Random("trueaxis " + name)
        poses = [{k: float(v) for k, v in p.items()} for p in SPECIAL.get(name, [{}])]
        poses = [{k: p.get(k, 0.0) for k in tr} for p in poses]
        while len(poses) < 40:
            poses.append({k: round(rnd.uniform(*r), 3) for k, r in tr.items()})
        axes = list(tr)
        ef = "moving" if name == "xkas2525" else "fixed"
        write(name, name + ".csv", poses, axes,
              common % name + "exact rotations, error_frame=%s, squareness carries all" % ef)
        if name == "xkas2525":
            write(name, "xkas2525.small-angle.csv", poses, axes, common % name +
                  "rotation=small-angle (I+[eps]x in Lambda and E, true inverse of the workpiece side, axis normalised),"
                  " error_frame=moving", small_angle=True)
            write(name, "xkas2525.error-frame-fixed.csv", poses, axes, common % name +
                  "exact rotations, error_frame=fixed (P.L.E.J)", error_frame="fixed")
            write(name, "xkas2525.squareness-direction.csv", poses, axes, common % name +
                  "exact rotations, error_frame=moving, squareness=direction: linear axes "
                  "P.Trans(dL).Trans(R_L dir q).E(q); rotary, w, t unchanged", squareness="direction")


main()
