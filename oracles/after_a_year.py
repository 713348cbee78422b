"""Makes examples/07_verify/xkas2525-after-a-year.toml and its table of X from machines/xkas2525.

Invented for this project: what a second calibration finds a year later. Everything was measured again,
so every error moves by its uncertainty (seeded noise); four really moved: the foundation settled
(EC0Y, EYX), the head was hit (EA0A), the spindle was taken out (EX0t).

Python 3.11, no packages:    python3 oracles/after_a_year.py
"""

import random
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
OLD = ROOT / "machines/xkas2525"
NEW = ROOT / "examples/07_verify"
MOVED = {"EC0Y": 12.0, "EA0A": 22.0, "EX0t": -9.0}
SAG_UM, LENGTH_MM = 9.0, 6200.0

draw = random.Random(2026)


def location(match):
    name, value, u, unit = match.groups()
    noise = draw.gauss(0.0, float(u)) if name[2] == "0" else 0.0
    return f'{name} = "{float(value) + MOVED.get(name, 0.0) + noise:.2f} ± {u} {unit}"'


text = (OLD / "machine.toml").read_text()
text = re.sub(r'(E[XYZABC]0\w) = "(-?[\d.]+) ± ([\d.]+) (um|urad)"', location, text)
text = re.sub(r'table = "X.csv"', 'table = "xkas2525-after-a-year-X.csv"', text)
text = re.sub(r'table = "([YZCA]).csv"', r'table = "../../machines/xkas2525/\1.csv"', text)
head = "# XKAS2525x60 a year later: invented by oracles/after_a_year.py for `verify --diff`.\n#\n"
(NEW / "xkas2525-after-a-year.toml").write_text(head + text)

lines = (OLD / "X.csv").read_text().splitlines()
heading = next(i for i, line in enumerate(lines) if not line.startswith("#"))
names = lines[heading].split(",")
column = next(i for i, name in enumerate(names) if name.startswith("EYX"))
offsets = [0.0] + [draw.gauss(0.0, 0.5 if "um" in n else 1.0) * 0.7 for n in names[1:]]
out = ["# a year later, see xkas2525-after-a-year.toml", lines[heading]]
for line in lines[heading + 1 :]:
    cells = [float(c) for c in line.split(",")]
    share = cells[0] / LENGTH_MM
    cells = [c + o for c, o in zip(cells, offsets)]
    cells[column] += SAG_UM * 4.0 * share * (1.0 - share)
    out.append(",".join(f"{c:g}" if i == 0 else f"{c:.3f}" for i, c in enumerate(cells)))
(NEW / "xkas2525-after-a-year-X.csv").write_text("\n".join(out) + "\n")
