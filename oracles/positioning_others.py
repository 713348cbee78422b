"""VDI/DGQ 3441 and the B5.54 form of the readings in examples/07_verify, in plain Python, written only
from the definitions (below), never from the Rust code.

Python 3.11 or newer, no packages. Run in the repository root: python3 oracles/positioning_others.py
Writes crates/trueaxis/tests/data/positioning-others.json.

VDI/DGQ 3441, at each position j, from n readings from each side:
    mean from each side, their mean m_j, reversal U_j = |up - down|, s_j = (s_up + s_down)/2 with
    s^2 = sum of squares/(n - 1), scatter Ps_j = 6 s_j
    P = max(m_j + (U_j + Ps_j)/2) - min(m_j - (U_j + Ps_j)/2), Pa = max m_j - min m_j
Form of ASME B5.54: ranges of the readings themselves.
"""

import csv
import json
import statistics

FOLDER = "examples/07_verify/"


def read(name):
    with open(FOLDER + name + ".csv") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        found = {}
        for row in rows:
            column = next(c for c in row if c.startswith("deviation_"))
            target = next(c for c in row if c.startswith("target_"))
            sides = found.setdefault(float(row[target]), {"up": [], "down": []})
            sides[row["direction"]].append(float(row[column]))
    return [found[t] for t in sorted(found)]


def spread(values):
    return max(values) - min(values)


def vdi(positions):
    means = [(statistics.fmean(p["up"]), statistics.fmean(p["down"])) for p in positions]
    middle = [(a + b) / 2 for a, b in means]
    reversal = [abs(a - b) for a, b in means]
    out = {"Pa": spread(middle), "U": max(reversal), "P": None, "Ps": None}
    if all(len(p[side]) > 1 for p in positions for side in p):
        scatter = [
            6 * (statistics.stdev(p["up"]) + statistics.stdev(p["down"])) / 2 for p in positions
        ]
        half = [(u + s) / 2 for u, s in zip(reversal, scatter)]
        out["P"] = max(m + h for m, h in zip(middle, half)) - min(
            m - h for m, h in zip(middle, half)
        )
        out["Ps"] = max(scatter)
    return out


def b554(positions):
    up = [v for p in positions for v in p["up"]]
    down = [v for p in positions for v in p["down"]]
    several = [p[side] for p in positions for side in p if len(p[side]) > 1]
    return {
        "accuracy": spread(up + down),
        "accuracy_up": spread(up),
        "accuracy_down": spread(down),
        "repeatability": max(map(spread, several)) if several else None,
        "reversal": max(
            abs(statistics.fmean(p["up"]) - statistics.fmean(p["down"])) for p in positions
        ),
    }


if __name__ == "__main__":
    cases = {}
    for name in ["x-axis-laser", "c-axis-polygon", "y-axis-long"]:
        positions = read(name)
        cases[name] = {"vdi3441": vdi(positions), "b5_54": b554(positions)}
    with open("crates/trueaxis/tests/data/positioning-others.json", "w") as out:
        json.dump(cases, out, indent=1)
        out.write("\n")
