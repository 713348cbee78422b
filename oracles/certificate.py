"""Makes the readings of examples/07_verify/certificate.toml and certificate-program.toml, and what their
predictions should be (crates/trueaxis-cli/tests/data/certificate.json).

A machine that exists only here: the errors of machines/xkas2525 each moved by a draw from their stated
uncertainty (one factor for a whole curve), seed below. It is "measured" before and after two compensations
that know the machine file only: the SINUMERIK tables of examples/07_verify/xkas2525-tables (made by
`trueaxis compensate tables`, read and interpolated here), and exact five-axis corrections solved here.

Chain, splines, tables and the solution are written here from shared/conventions.md, without a line of
TrueAxis: so the predictions of the certificate are held against another model.

Python 3.11, numpy, scipy:    python3 oracles/certificate.py
"""

import csv
import json
import math
import re
import tomllib
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

ROOT = Path(__file__).resolve().parents[1]
MACHINE = ROOT / "machines/xkas2525"
OUT = ROOT / "examples/07_verify"
SEED, U_MM = 16907, 0.0015
AXES = "XYZCA"
UPRIGHT = dict(X=3100.0, Y=1250.0, Z=-500.0, C=0.0, A=0.0)
# Not upright: there C would have to swing for any correction of the tool axis.
TILTED = dict(X=3100.0, Y=1250.0, Z=-500.0, C=0.0, A=30.0)


def rotation(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    return {
        "X": np.array([[1, 0, 0], [0, c, -s], [0, s, c]]),
        "Y": np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
        "Z": np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]),
    }[axis]


def pose(turn=np.eye(3), shift=(0, 0, 0)):
    m = np.eye(4)
    m[:3, :3], m[:3, 3] = turn, shift
    return m


def six(e):
    return pose(rotation("Z", e[5]) @ rotation("Y", e[4]) @ rotation("X", e[3]), e[:3])


def numbers(text):
    return [float(v) for v in text.split()[:3]]


class Model:
    def __init__(self):
        file = tomllib.loads((MACHINE / "machine.toml").read_text())
        self.place = {a: pose(shift=numbers(file["axis"][a]["placement"])) for a in AXES}
        self.workpiece = pose(shift=numbers(file["workpiece"]["placement"]))
        self.mounting = np.eye(4)
        for step in file["workpiece"]["mounting"]:
            word, *rest = step.split()
            turn = pose(rotation(rest[0], math.radians(float(rest[1])))) if word == "turn" else None
            self.mounting = self.mounting @ (turn if word == "turn" else pose(shift=numbers(" ".join(rest))))
        self.tool = pose(shift=numbers(file["tool"]["placement"]))
        self.length = float(file["tool"]["length"].split()[0])
        self.location, self.u = {b: np.zeros(6) for b in "wt" + AXES}, {}
        for name, text in file["location"].items():
            value, u = re.match(r"(-?[\d.]+) ± ([\d.]+)", text).groups()
            k, body = "XYZABC".index(name[1]), name[3]
            scale = 1e-3 if k < 3 else 1e-6
            self.location[body][k] = float(value) * scale
            self.u[body, "location", k] = float(u) * scale
        self.motion = {}
        for axis in AXES:
            lines = [l for l in (MACHINE / f"{axis}.csv").read_text().splitlines() if not l.startswith("#")]
            rows = np.array([[float(c) for c in r] for r in csv.reader(lines[1:])])
            q = np.radians(rows[:, 0]) if axis in "CA" else rows[:, 0]
            scale = np.array([1e-3] * 3 + [1e-6] * 3)
            self.motion[axis] = CubicSpline(q, rows[:, 1:] * scale, bc_type="not-a-knot")
            for k in range(6):
                self.u[axis, "motion", k] = 0.5e-3 if k < 3 else 1e-6

    def drawn(self, random):
        return {key: u * random.standard_normal() for key, u in self.u.items()}

    def ends(self, q, off, nominal=False):
        """Tip and tool axis in the workpiece frame; `off` is added to the identified errors."""

        def errors(body, kind, value):
            if nominal:
                return np.eye(4)
            return six(value + np.array([off.get((body, kind, k), 0.0) for k in range(6)]))

        bed = np.eye(4)
        for axis in AXES:
            v = q[axis]
            move = pose(rotation({"C": "Z", "A": "X"}[axis], v)) if axis in "CA" else pose(
                shift=[v if axis == a else 0.0 for a in "XYZ"])
            bed = bed @ self.place[axis] @ errors(axis, "location", self.location[axis])
            bed = bed @ move @ errors(axis, "motion", self.motion[axis](v))
        bed = bed @ self.tool @ errors("t", "location", self.location["t"])
        part = self.workpiece @ errors("w", "location", self.location["w"]) @ self.mounting
        tool = np.linalg.inv(part) @ bed
        return tool[:3, :3] @ [0, 0, -self.length] + tool[:3, 3], tool[:3, 2]

    def exact(self, q):
        """The command at which the identified machine stands where the nominal one stands at q."""
        tip, axis = self.ends(q, {}, nominal=True)
        at = dict(q)

        def miss(at):
            p, a = self.ends(at, {})
            return np.concatenate([p - tip, 1000.0 * (a - axis)])

        for _ in range(6):
            r = miss(at)
            jacobian = np.zeros((6, 5))
            for i, a in enumerate(AXES):
                h = 1e-6 if a in "CA" else 1e-2
                more, less = dict(at), dict(at)
                more[a] += h
                less[a] -= h
                jacobian[:, i] = (miss(more) - miss(less)) / (2 * h)
            step = np.linalg.lstsq(jacobian, -r, rcond=None)[0]
            for i, a in enumerate(AXES):
                at[a] += step[i]
        assert np.linalg.norm(miss(at)) < 1e-7, miss(at)
        return at


def sinumerik():
    """(input, output, positions, values) of every table; a positive value moves the axis back."""
    tables = []
    for file in ["AX_EEC.INI", "NC_CEC.INI"]:
        text = (OUT / "xkas2525-tables" / file).read_text()
        names = dict(re.findall(r"(AX\d) = (\w)", text))
        for t, axis in sorted(set(re.findall(r"\$AA_ENC_COMP_STEP\[(\d+),(AX\d)\]", text))):
            get = lambda what: float(re.search(rf"\$AA_ENC_COMP_{what}\[{t},{axis}\]=(\S+)", text)[1])
            values = [float(v) for v in re.findall(rf"\$AA_ENC_COMP\[{t},\d+,{axis}\]=(\S+)", text)]
            tables.append((names[axis], names[axis], get("MIN"), get("STEP"), values))
        for t in sorted(set(re.findall(r"\$AN_CEC_STEP\[(\d+)\]", text)), key=int):
            get = lambda what: re.search(rf"\$AN_CEC_{what}\[{t}\]=(\S+)", text)[1]
            values = [float(v) for v in re.findall(rf"\$AN_CEC\[{t},\d+\]=(\S+)", text)]
            ends = [names[get(w).strip("()")] for w in ("INPUT_AXIS", "OUTPUT_AXIS")]
            tables.append((*ends, float(get("MIN")), float(get("STEP")), values))
    return tables


def with_tables(tables, q):
    at = dict(q)
    for source, moved, start, step, values in tables:
        turns = source in "CA"
        places = start + step * np.arange(len(values))
        value = np.interp(math.degrees(q[source]) if turns else q[source], places, values)
        at[moved] -= math.radians(value) if moved in "CA" else value
    return at


def poses(count, tilt):
    """Within the travel, no axis at a place where its table was measured."""
    g = 1.0
    for _ in range(60):
        g = (1.0 + g) ** (1.0 / 6.0)
    ends = dict(X=(300, 5900), Y=(200, 2300), Z=(-900, -100), C=(-170, 170), A=(12, 75))
    found = []
    for k in range(1, count + 1):
        share = {a: (0.5 + k * g ** -(i + 1)) % 1.0 for i, a in enumerate(AXES)}
        q = {a: round(lo + (hi - lo) * share[a], 1) for a, (lo, hi) in ends.items()}
        q["A"] = q["A"] * (-1) ** k if tilt else 0.0
        q["C"] = q["C"] if tilt else 0.0
        found.append(q)
    return found


def write(name, what, list_of_poses, deviations):
    lines = [f"# {what}: virtual, oracles/certificate.py, seed {SEED}", "X,Y,Z,C,A,x_um,y_um,z_um"]
    for q, d in zip(list_of_poses, deviations):
        lines.append(",".join([f"{q[a]:g}" for a in AXES] + [f"{v * 1e3:.2f}" for v in d]))
    (OUT / name).write_text("\n".join(lines) + "\n")


def main():
    model, tables = Model(), sinumerik()
    random = np.random.default_rng(SEED)
    true = model.drawn(random)

    def inner(q):
        return {a: math.radians(v) if a in "CA" else v for a, v in q.items()}

    def deviation(q, go):
        q = inner(q)
        return model.ends(go(q), true)[0] - model.ends(q, {}, nominal=True)[0]

    def measured(list_of_poses, go, at):
        zero = deviation(at, go)
        noise = lambda: U_MM * random.standard_normal(3)
        return [deviation(q, go) - zero + noise() for q in list_of_poses]

    def predicted(list_of_poses, go, zero):
        """What is expected of the identified machine, and its standard uncertainty by central differences."""

        def off(q, errors):
            q = inner(q)
            return model.ends(go(q), errors)[0] - model.ends(q, {}, nominal=True)[0]

        def told(q, errors):
            return off(q, errors) - off(zero, errors)

        found = []
        for q in list_of_poses:
            slopes = [(told(q, {key: u}) - told(q, {key: -u})) / 2 for key, u in model.u.items()]
            u = np.sqrt(sum(s * s for s in slopes))
            found.append({"after_um": list(1e3 * told(q, {})), "u_um": list(1e3 * u)})
        return found

    plain, by_tables = (lambda q: q), (lambda q: with_tables(tables, q))
    upright, tilted = poses(24, False), poses(32, True)
    write("certificate-before.csv", "head upright, not compensated", upright, measured(upright, plain, UPRIGHT))
    write("certificate-after.csv", "head upright, with the tables", upright, measured(upright, by_tables, UPRIGHT))
    write("certificate-program-before.csv", "five axes, not compensated", tilted, measured(tilted, plain, TILTED))
    write("certificate-program-after.csv", "five axes, compensated program", tilted, measured(tilted, model.exact, TILTED))
    expected = {
        "tables": predicted(upright[:6], by_tables, UPRIGHT),
        "program": predicted(tilted[:6], model.exact, TILTED),
    }
    (ROOT / "crates/trueaxis-cli/tests/data").mkdir(exist_ok=True)
    text = json.dumps(expected, indent=1) + "\n"
    (ROOT / "crates/trueaxis-cli/tests/data/certificate.json").write_text(text)


main()
