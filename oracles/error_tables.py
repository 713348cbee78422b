"""Readings for examples/05_identify/error-tables.toml, by plain 4x4 matrices.

    python3 oracles/error_tables.py examples/05_identify/error-tables

The machine is machines/xkas2525 (chain w b X Y Z C A t, errors after the motion) with other errors of X and C, and
other squarenesses: the functions below. The errors of Y, Z and A and all other location errors are those of the
machine file, its tables as not-a-knot splines (scipy). Instruments read the tool against the table, with the scatter
stated at each. numpy and scipy; random seed 7.
"""

import csv
import math
import re
import sys
import tomllib
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

ROOT = Path(__file__).resolve().parent.parent / "machines" / "xkas2525"
RUNS = 3
TOOL = [0, 0, -200]  # the tool frame is 200 below the axis of A; the tip another 100


def true_x(x):
    """X: mm and rad; the table of the machine file is other."""
    u = x / 6200.0
    return {
        "EXX": 1e-3 * (18 * u + 4 * math.sin(7 * u)),
        "EYX": 1e-3 * (6 * math.sin(4 * u) - 2 * u),
        "EZX": 1e-3 * (-9 * u * (1 - u) + 3 * u),
        "EAX": 1e-6 * (8 * math.sin(5 * u)),
        "EBX": 1e-6 * (12 * u * u),
        "ECX": 1e-6 * (-10 * math.sin(3 * u)),
    }


def true_c(c):
    return {
        "EXC": 1e-3 * (3 * math.cos(2 * c) + 1.0 * math.sin(3 * c)),
        "EYC": 1e-3 * (2 * math.sin(2 * c)),
        "EZC": 1e-3 * (1.5 * math.cos(2 * c)),
        "EAC": 1e-6 * (6 * math.sin(2 * c)),
        "EBC": 1e-6 * (5 * math.cos(2 * c)),
        "ECC": 1e-6 * (20 * math.sin(c) + 4 * math.cos(3 * c)),
    }


TRUE_SQUARE = {"EC0Y": 31e-6, "EB0Z": -17e-6, "EA0Z": 12e-6}


def file_location():
    text = (ROOT / "machine.toml").read_text()
    section = tomllib.loads(text)["location"]
    found = {}
    for name, value in section.items():
        number, unit = re.match(r"(-?[\d.]+) ± [\d.]+ (\w+)", value).groups()
        found[name] = float(number) * {"um": 1e-3, "urad": 1e-6}[unit]
    return found


def file_table(letter):
    rows = [r for r in csv.reader((ROOT / f"{letter}.csv").open()) if r and not r[0].startswith("#")]
    data = np.array(rows[1:], float)
    q = np.radians(data[:, 0]) if rows[0][0].endswith("deg") else data[:, 0]
    splines = {}
    for i, heading in enumerate(rows[0][1:], 1):
        name, unit = heading.split("_")
        splines[name] = CubicSpline(q, data[:, i] * {"um": 1e-3, "urad": 1e-6}[unit], bc_type="not-a-knot")
    return lambda at: {name: float(s(at)) for name, s in splines.items()}


LOCATION = file_location() | TRUE_SQUARE
MOTION = {"X": true_x, "C": true_c} | {k: file_table(k) for k in "YZA"}


def shift(v):
    m = np.eye(4)
    m[:3, 3] = v
    return m


def turn(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    m = np.eye(4)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    m[i, i] = m[j, j] = c
    m[i, j], m[j, i] = -s, s
    return m


def six(values, names):
    x, y, z, a, b, c = (values.get(n, 0.0) for n in names)
    return shift([x, y, z]) @ turn(2, c) @ turn(1, b) @ turn(0, a)


PLACES = {"X": [0, -1500, 300], "Y": [0, 1500, -150], "Z": [0, 0, -250], "C": [0, 0, 100], "A": [0, 0, 0]}


def tool_on_bed(q, with_errors=True):
    m = np.eye(4)
    for letter, place in PLACES.items():
        m = m @ shift(place)
        if with_errors:
            m = m @ six(LOCATION, [f"E{c}0{letter}" for c in "XYZABC"])
        i = "XYZ".find(letter)
        m = m @ (turn(2, q["C"]) if letter == "C" else turn(0, q["A"]) if letter == "A" else shift(np.eye(3)[i] * q[letter]))
        if with_errors:
            m = m @ six(MOTION[letter](q[letter]), [f"E{c}{letter}" for c in "XYZABC"])
    m = m @ shift(TOOL)
    if with_errors:
        m = m @ six(LOCATION, [f"E{c}0t" for c in "XYZABC"])
    return m


def seen(q, point):
    """Displacement of a point of the tool and turn of the tool, in machine directions."""
    actual, nominal = tool_on_bed(q), tool_on_bed(q, False)
    tool = np.append(np.array(point), 1.0)
    r = actual[:3, :3] @ nominal[:3, :3].T
    w = 0.5 * np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    return np.append((actual @ tool - nominal @ tool)[:3], w)


random = np.random.default_rng(7)


def sheet(folder, name, axis, targets, at, point, noise, hidden):
    """`hidden(q)`: what the set-up of the instrument adds."""
    is_rotary, component = axis in "ABC", "XYZABC".index(name[1])
    is_angle = component > 2
    unit, scale = ("urad", 1e6) if is_angle else ("um", 1e3)
    lines = [f"# made by oracles/error_tables.py: {name}, scatter {noise} {unit}; no real machine"]
    lines.append(f"target_{'deg' if is_rotary else 'mm'},run,direction,deviation_{unit}")
    for run in range(1, RUNS + 1):
        for direction, order in (("up", targets), ("down", targets[::-1])):
            for t in order:
                q = dict(at)
                q[axis] = math.radians(t) if is_rotary else t
                value = seen(q, point)[component] * scale + hidden(q[axis])
                lines.append(f"{t:g},{run},{direction},{value + random.normal(0, noise):.3f}")
    (folder / f"{name}.csv").write_text("\n".join(lines) + "\n")


def circle(folder, plane, centre, radius, at, noise):
    a, b = plane
    lines = [f"# made by oracles/error_tables.py: circle {a}{b}, R {radius} mm, scatter {noise} um; no real machine"]
    lines.append(f"{a.lower()}_mm,{b.lower()}_mm,direction")
    ia, ib = "XYZ".index(a), "XYZ".index(b)
    for word, sign in (("ccw", 1), ("cw", -1)):
        for k in range(360):
            angle = sign * (k + 0.5) * math.tau / 360
            q = dict(at)
            q[a], q[b] = centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)
            d = seen(q, [0, 0, -100])
            radial = random.normal(0, noise * 1e-3)
            # The ball-bar is set to zero at its centre: where that lies is fitted.
            lines.append(
                f"{q[a] + d[ia] + radial * math.cos(angle):.6f},{q[b] + d[ib] + radial * math.sin(angle):.6f},{word}"
            )
    (folder / f"circle-{a}{b}.csv").write_text("\n".join(lines) + "\n")


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    at = {"X": 0.0, "Y": 1250.0, "Z": -500.0, "C": 0.0, "A": 0.0}
    targets = [310.0 * i for i in range(21)]
    optics = [40.0, -60.0, -150.0]
    for name, hidden in {
        "EAX": lambda q: 33.0,
        "EBX": lambda q: -120.0,
        "ECX": lambda q: 15.0,
        "EXX": lambda q: 4.0,
        "EYX": lambda q: 21.0 + 0.03 * q,
        "EZX": lambda q: -7.0 - 0.012 * q,
    }.items():
        sheet(folder, name, "X", targets, at, optics, 0.5 if name[1] in "ABC" else 0.4, hidden)
    at["X"] = 3100.0
    turns = [15.0 * i for i in range(-24, 25)]
    for name, hidden in {
        "EAC": lambda q: 40 * math.cos(q + 0.4),
        "EBC": lambda q: 40 * math.sin(q + 0.4),
        "ECC": lambda q: 9.0,
        "EXC": lambda q: 12 * math.cos(q + 1.1),
        "EYC": lambda q: 12 * math.sin(q + 1.1),
        "EZC": lambda q: -3.0,
    }.items():
        # On the axis, 150 mm below the gauge line.
        sheet(folder, name, "C", turns, at, [0.0, 0.0, -150.0], 0.5 if name[1] in "ABC" else 0.3, hidden)
    circle(folder, "XY", (3100.0, 1250.0), 300.0, at, 0.5)
    circle(folder, "YZ", (1250.0, -500.0), 300.0, at, 0.5)
    circle(folder, "XZ", (3100.0, -500.0), 300.0, at, 0.5)


main()
