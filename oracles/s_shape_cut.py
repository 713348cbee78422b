"""What the flank of a mill leaves of the S-shaped wall on a machine without errors, by brute force.

Python 3.13, standard library only:  python3 oracles/s_shape_cut.py

For each point of parts/s-shape-*.csv: the least t such that point + t normal is one radius away from the axis of the tool at one of
many places of its way (golden section about the best of 4,000). The way is the smooth one; the chords of the 400 blocks of the
program change a profile by up to 0.3 um. Prints the profile, twice the largest |t|, in um: 40.40 and 40.12.
"""

import importlib.util
from math import sqrt
from pathlib import Path

ROOT = Path(__file__).parents[1]
spec = importlib.util.spec_from_file_location("s_shape", ROOT / "oracles/programs/s_shape.py")
s_shape = importlib.util.module_from_spec(spec)
spec.loader.exec_module(s_shape)


def off(p, u, face):
    tip, axis = s_shape.tool(u, face)
    arm = [a - b for a, b in zip(p, tip)]
    along = sum(a * b for a, b in zip(arm, axis))
    return sqrt(max(sum(a * a for a in arm) - along * along, 0.0)) - s_shape.RADIUS


def least(p, near, face):
    low, high = near - 0.01, near + 0.01
    for _ in range(60):
        a, b = low + 0.382 * (high - low), low + 0.618 * (high - low)
        if off(p, a, face) < off(p, b, face):
            high = b
        else:
            low = a
    return off(p, 0.5 * (low + high), face)


for face, name in ((1, "a"), (-1, "b")):
    worst = 0.0
    for row in (ROOT / f"parts/s-shape-{name}.csv").read_text().split()[1:]:
        v = [float(x) for x in row.split(",")]
        p, n = v[:3], v[3:]
        near = min((i / 4000 for i in range(4001)), key=lambda u: off(p, u, face))
        t = 0.0
        for _ in range(20):
            t += least([a + t * b for a, b in zip(p, n)], near, face)
        worst = max(worst, abs(t))
    print(f"profile of face_{name}: {2e3 * worst:.2f} um")
