"""Readings made for this project and their evaluation in numpy, written only from the definitions in
shared/conventions.md ("Evaluations"), never from the Rust code.

Run in the repository root: python3 oracles/iso230.py
Writes examples/07_verify/*.csv and crates/trueaxis/tests/data/iso230-2.json, iso230-4.json,
iso230-7.json.
No real machine; seed 20261121.
"""

import json

import numpy as np

SEED = 20261121
EXAMPLES = "examples/07_verify/"
EXPECTED = "crates/trueaxis/tests/data/"


def write_long(path, notes, unit, dev_unit, targets, up, down, temps):
    """up, down: arrays (target, run) of deviations."""
    with open(path, "w") as out:
        for note in notes:
            out.write(f"# {note}\n")
        out.write(f"target_{unit},run,direction,deviation_{dev_unit},temperature_degC\n")
        for run in range(up.shape[1]):
            for i, t in enumerate(targets):
                out.write(f"{t:g},{run + 1},up,{up[i, run]:.2f},{temps[run]:.2f}\n")
            for i in reversed(range(len(targets))):
                out.write(f"{targets[i]:g},{run + 1},down,{down[i, run]:.2f},{temps[run]:.2f}\n")


def iso230_2(up, down):
    """The figures, in the unit of the deviations; None where undefined."""
    up, down = np.round(up, 2), np.round(down, 2)
    mu, md = up.mean(1), down.mean(1)
    b = mu - md
    out = {
        "E": max(mu.max(), md.max()) - min(mu.min(), md.min()),
        "E_up": np.ptp(mu),
        "E_down": np.ptp(md),
        "M": np.ptp((mu + md) / 2),
        "B": np.abs(b).max(),
        "B_mean": b.mean(),
    }
    if up.shape[1] > 1:
        su, sd = up.std(1, ddof=1), down.std(1, ddof=1)
        r = np.maximum.reduce([2 * su + 2 * sd + np.abs(b), 4 * su, 4 * sd])
        high = np.concatenate([mu + 2 * su, md + 2 * sd]).max()
        low = np.concatenate([mu - 2 * su, md - 2 * sd]).min()
        out |= {
            "A": high - low,
            "A_up": (mu + 2 * su).max() - (mu - 2 * su).min(),
            "A_down": (md + 2 * sd).max() - (md - 2 * sd).min(),
            "R": r.max(),
            "R_up": 4 * su.max(),
            "R_down": 4 * sd.max(),
        }
    else:
        out |= dict.fromkeys(["A", "A_up", "A_down", "R", "R_up", "R_down"])
    return {k: None if v is None else float(v) for k, v in out.items()}


def positioning(rng):
    cases = {}
    note = "made for this project by oracles/iso230.py, seed 20261121; no real machine"
    # A table on a ball screw: slope, pitch error of the screw, lost motion that grows to one end.
    p = np.array([-300, -247.3, -201.8, -148.6, -99.1, -52.4, 3.7, 47.9, 103.2, 149.5, 198.3, 253.6, 300])
    mean = 9e-3 * p + 1.6 * np.sin(2 * np.pi * p / 210) - 1.1 * (p / 300) ** 2
    half = -0.9 - 0.6 * (p + 300) / 600
    up = mean[:, None] + half[:, None] + rng.normal(0, 0.45, (13, 5))
    down = mean[:, None] - half[:, None] + rng.normal(0, 0.55, (13, 5))
    temps = 21.6 + 0.15 * np.arange(5)
    write_long(EXAMPLES + "x-axis-laser.csv", ["X axis of a mill, laser interferometer", note], "mm", "um", p, up, down, temps)
    cases["x-axis-laser"] = iso230_2(up, down)
    # A worm table: one wave a turn, one a tooth.
    p = np.array([0, 31.7, 58.3, 92.1, 118.9, 151.2, 179.4, 211.6, 238.8, 272.5, 299.3, 330])
    a = np.radians(p)
    mean = 3.2 * np.sin(a) + 0.8 * np.cos(36 * a)
    up = mean[:, None] - 1.4 + rng.normal(0, 0.4, (12, 5))
    down = mean[:, None] + 1.4 + rng.normal(0, 0.4, (12, 5))
    write_long(EXAMPLES + "c-axis-polygon.csv", ["C axis, polygon and autocollimator", note], "deg", "arcsec", p, up, down, temps)
    cases["c-axis-polygon"] = iso230_2(up, down)
    # A long gantry: one run each way.
    p = np.linspace(0, 3500, 15) + np.concatenate([[0], rng.uniform(-40, 40, 13), [0]]).round(1)
    mean = 12e-3 * p + 4 * np.sin(p / 500)
    up = (mean - 2 + rng.normal(0, 0.8, 15))[:, None]
    down = (mean + 2 + rng.normal(0, 0.8, 15))[:, None]
    write_long(EXAMPLES + "y-axis-long.csv", ["Y axis of a gantry, 3500 mm", note], "mm", "um", p, up, down, temps)
    cases["y-axis-long"] = iso230_2(up, down)
    with open(EXPECTED + "iso230-2.json", "w") as out:
        json.dump(cases, out, indent=1)
        out.write("\n")


def least_squares_circle(q):
    """Gauss-Newton on the distances, to the last digit."""
    c, r = q.mean(0), 0.0
    for _ in range(50):
        d = q - c
        dist = np.hypot(*d.T)
        j = np.column_stack([-d / dist[:, None], -np.ones(len(q))])
        step = np.linalg.lstsq(j, -(dist - r), rcond=None)[0]
        c, r = c + step[:2], r + step[2]
    return c, r


def circular(rng):
    radius, feed = 150.0, 1000.0 / 60
    rows, kept = [], {}
    for word, s in [("ccw", 1), ("cw", -1)]:
        # Half a degree a point, 45 degrees before and after the turn.
        n = np.arange(-90, 811)
        theta = s * np.radians(0.5 * n)
        x, y = radius * np.cos(theta), radius * np.sin(theta)
        vx, vy = np.sign(-s * np.sin(theta)), np.sign(s * np.cos(theta))
        # Lost motion, scales, squareness, a lag of X 0.04 ms behind Y, a stick-slip spike.
        dx = -0.5 * 3.0e-3 * vx + 20e-6 * x
        dy = -0.5 * 1.5e-3 * vy - 10e-6 * y + 12e-6 * x
        dx -= 4e-5 * feed * -s * np.sin(theta)
        behind = np.mod(s * theta, np.pi / 2)
        quarter = np.floor(np.mod(s * theta, 2 * np.pi) / (np.pi / 2))
        spike = 2.5e-3 * np.exp(-((np.degrees(behind) - 3) / 1.2) ** 2) * (quarter % 2 == 0)
        px = np.round(x + dx + spike * np.cos(theta) + rng.normal(0, 0.12e-3, len(n)), 5)
        py = np.round(y + dy + spike * np.sin(theta) + rng.normal(0, 0.12e-3, len(n)), 5)
        rows += [f"{a:.5f},{b:.5f},{word}" for a, b in zip(px, py)]
        q = np.column_stack([px, py])
        angle = np.unwrap(np.arctan2(py, px))
        swept = np.abs(angle - angle[0])
        over = (swept[-1] - 2 * np.pi) / 2
        kept[word] = q[(swept >= over - 1e-9) & (swept <= swept[-1] - over + 1e-9)]
    with open(EXAMPLES + "circle-xy.csv", "w") as out:
        out.write("# XY circle, R 150 mm, 1000 mm/min, grid encoder, with 45 degrees before and after each turn\n")
        out.write("# made for this project by oracles/iso230.py, seed 20261121; no real machine\n")
        out.write("x_mm,y_mm,direction\n" + "\n".join(rows) + "\n")
    out, mean = {}, []
    f_all = []
    for word, q in kept.items():
        c, r = least_squares_circle(q)
        f = np.hypot(*q.T) - radius
        f_all.append(f)
        mean.append(r - radius)
        out[f"G_{word}"] = float(np.ptp(np.hypot(*(q - c).T)) * 1e3)
        out[f"F_{word}_max"], out[f"F_{word}_min"] = float(f.max() * 1e3), float(f.min() * 1e3)
        out[f"points_{word}"] = len(q)
    q = np.concatenate(list(kept.values()))
    c, _ = least_squares_circle(q)
    out["G_b"] = float(np.ptp(np.hypot(*(q - c).T)) * 1e3)
    out["D"] = float(np.mean(mean) * 1e3)
    # What was put in: B = E_up - E_down; scales differ by 30 um/m over 300 mm; y += 12e-6 x opens the
    # angle by -12 urad; lag 4e-5 s * feed, twice its half.
    out["backlash"] = [-3.0, -1.5]
    out["scale_mismatch"] = 30e-6 * 300e3
    out["squareness_urad"] = 12.0
    out["servo_mismatch"] = 4e-5 * feed * 1e3
    with open(EXPECTED + "iso230-4.json", "w") as file:
        json.dump(out, file, indent=1)
        file.write("\n")


def diagonals(rng):
    """Edges 500 400 300 mm; squareness put in: XY 12, XZ -8, YZ 5 urad closer than 90 degrees; scale of
    X 6 um/m too long."""
    edges = np.array([500.0, 400.0, 300.0])
    whole = np.sqrt((edges**2).sum())
    u = edges / whole
    with open(EXAMPLES + "body-diagonals.csv", "w") as out:
        out.write("# Four body diagonals of 500 x 400 x 300 mm, laser interferometer\n")
        out.write("# made for this project by oracles/iso230.py, seed 20261121; no real machine\n")
        out.write("diagonal,target_mm,run,direction,deviation_um\n")
        for name, s in [("+++", (1, 1, 1)), ("++-", (1, 1, -1)), ("+-+", (1, -1, 1)), ("+--", (1, -1, -1))]:
            e = 6 * u[0] ** 2 + 12 * s[0] * s[1] * u[0] * u[1] - 8 * s[0] * s[2] * u[0] * u[2] + 5 * s[1] * s[2] * u[1] * u[2]
            targets = np.array([0, 131.2, 268.7, 401.3, 559.4, round(whole, 1)])
            for run in range(5):
                for word, half, order in [("up", -0.8, targets), ("down", 0.8, targets[::-1])]:
                    for t in order:
                        v = e * t / 1000 + half + 0.4 * np.sin(t / 90) + rng.normal(0, 0.3)
                        out.write(f"{name},{t:g},{run + 1},{word},{v:.2f}\n")


def drift(rng):
    t = np.arange(0, 241)
    air = 21.5 + 0.8 * np.sin(2 * np.pi * t / 180)
    spindle = 21.5 + 9 * (1 - np.exp(-t / 70))
    with open(EXAMPLES + "spindle-drift.csv", "w") as out:
        out.write("# Spindle at 6000 rpm against the table, five probes, four hours\n")
        out.write("# made for this project by oracles/iso230.py, seed 20261121; no real machine\n")
        out.write("time_min,x_um,y_um,z_um,a_urad,b_urad,air_degC,spindle_degC\n")
        for i, m in enumerate(t):
            w = spindle[i] - 21.5
            v = [0.5 * w, -1.1 * w, 3.1 * w + 1.5 * (air[i] - 21.5), 2.0 * w, 0.6 * w]
            v = [a + rng.normal(0, 0.15) for a in v]
            out.write(f"{m}," + ",".join(f"{a:.2f}" for a in v) + f",{air[i]:.2f},{spindle[i]:.2f}\n")


def spindle(rng):
    n, turns = 120, 24
    a = 2 * np.pi * np.arange(n * turns + 1) / n
    x = 6 * np.cos(a + 0.4) + 0.9 * np.cos(2 * a) + 0.3 * np.sin(3 * a) + rng.normal(0, 0.12, len(a))
    y = 6 * np.sin(a + 0.4) + 0.5 * np.sin(2 * a) + rng.normal(0, 0.12, len(a))
    z = 0.4 * np.cos(a) + 0.1 * np.cos(4 * a) + rng.normal(0, 0.05, len(a))
    with open(EXAMPLES + "spindle-motion.csv", "w") as out:
        out.write("# Spindle with a ball, three capacitive probes, 24 revolutions\n")
        out.write("# made for this project by oracles/iso230.py, seed 20261121; no real machine\n")
        out.write("angle_deg,x_um,y_um,axial_um\n")
        for i in range(len(a)):
            out.write(f"{3 * i},{x[i]:.3f},{y[i]:.3f},{z[i]:.3f}\n")
    # The same by another way: a Fourier transform of the whole record takes mean and fundamental out.
    expected = {}
    b = a[:-1]
    for name, v in [("radial fixed x", x), ("radial fixed y", y), ("radial rotating", x * np.cos(a) + y * np.sin(a)), ("axial", z)]:
        v = np.round(v, 3) if name != "radial rotating" else np.round(x, 3) * np.cos(a) + np.round(y, 3) * np.sin(a)
        f = np.fft.rfft(v[:-1])
        amplitude = 2 * abs(f[turns]) / len(b)
        f[0] = 0
        if name != "axial":
            f[turns] = 0
        rest = np.fft.irfft(f, len(b)).reshape(turns, n)
        expected[name] = {
            "total_um": float(np.ptp(rest)),
            "synchronous_um": float(np.ptp(rest.mean(0))),
            "asynchronous_um": float(np.ptp(rest, axis=0).max()),
            "fundamental_um": float(amplitude),
        }
    with open(EXPECTED + "iso230-7.json", "w") as out:
        json.dump(expected, out, indent=1)
        out.write("\n")


if __name__ == "__main__":
    generator = np.random.default_rng(SEED)
    positioning(generator)
    circular(generator)
    diagonals(generator)
    drift(generator)
    spindle(generator)
