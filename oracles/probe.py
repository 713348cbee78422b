"""Hits of a touch probe on a ring made for this project, and its calibration by other software.

Tools: Python 3.11.7, numpy 2.4.6, scipy 1.17.1 (pip install numpy scipy). Written from docs/model.md
(136) to (140), never from the Rust code: hits are made by intersecting the line of motion with the circle
(scipy.optimize.brentq on the gap), the fit is scipy.optimize.least_squares on the pre-travel of (136),
directions are held out by fitting again without them, and the splines come from scipy.interpolate.BSpline
and CubicSpline(bc_type="periodic").

Run in the repository root: python3 oracles/probe.py
Writes examples/05_identify/ring-60.csv, ring-60-fresh.csv, ring-turned.csv,
sphere-short.csv, sphere-long.csv (no real probe; seed 20261122) and crates/trueaxis/tests/data/probe.json.
"""

import json

import numpy as np
from scipy.interpolate import BSpline, CubicSpline
from scipy.optimize import brentq, least_squares

SEED = 20261122
FOLDER = "examples/05_identify/"
EXPECTED = "crates/trueaxis/tests/data/probe.json"
RING_MM, BALL_MM = 31.0, 2.0
CENTRE = np.array([120.0, 80.0])
OFFSET = np.array([0.0035, -0.0020])
NOISE_MM = 0.001


def travel(angle):
    """Pre-travel of the virtual probe, mm: 10 µm in three lobes, and a little of 2, 6 and 9."""
    return (0.0175 + 0.010 * np.cos(3 * (angle - np.radians(20))) + 0.0012 * np.cos(2 * angle + 0.4)
            + 0.0016 * np.cos(6 * (angle - np.radians(11))) + 0.0006 * np.sin(9 * angle))


def turn(vector, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


def hit(angle, phi=0.0):
    """Where the spindle stands at the trigger if it starts over the centre of the ring."""
    u = np.array([np.cos(angle), np.sin(angle)])
    gap = lambda s: np.linalg.norm(s * u + turn(OFFSET, phi)) - (RING_MM - BALL_MM)
    s = brentq(gap, 0, RING_MM, xtol=1e-13)
    return CENTRE + (s + travel(angle - phi)) * u


def write(name, about, rows):
    with open(FOLDER + name, "w") as file:
        file.write("# made for this project by oracles/probe.py (numpy 2.4.6, seed 20261122); no real probe\n")
        file.write(f"# {about}\n")
        file.write("angle_deg,x_mm,y_mm,orientation_deg\n")
        for angle, phi, p in rows:
            file.write(f"{np.degrees(angle):.3f},{p[0]:.6f},{p[1]:.6f},{np.degrees(phi):.1f}\n")


def make(rng, angles, phi=0.0):
    return [(a, phi, np.round(hit(a, phi) + rng.normal(0, NOISE_MM) * np.array([np.cos(a), np.sin(a)]), 6))
            for a in angles]


def sphere_hits(rng, offset, radius, scale):
    """From above onto a sphere of 25 mm at (-40, 10, -180), with the spindle at 0 and 180 deg."""
    centre, reach, rows = np.array([-40.0, 10.0, -180.0]), 12.5 + radius, []
    directions = [(az, la) for la in (0, 25, 50, 75) for az in range(0, 360, 30)] + [(0, 90)]
    for phi in (0.0, np.pi):
        for az, la in directions:
            a, l = np.radians(az), np.radians(-la)
            u = np.array([np.cos(l) * np.cos(a), np.cos(l) * np.sin(a), np.sin(l)])
            around, level, rise = a - phi, np.cos(l), np.sin(l)
            t = 1e-3 * scale * (15 + 4 * rise ** 2 + 10 * level ** 3 * np.cos(3 * around - np.radians(60))
                                + 2 * level * rise * np.cos(around))
            o = np.append(turn(offset, phi), 0.0)
            gap = lambda s: np.linalg.norm(s * u + o) - reach
            s = brentq(gap, -2 * reach, 0, xtol=1e-13)
            rows.append((centre + (s + t + rng.normal(0, 0.0005)) * u, u, phi))
    return rows


def write_sphere(name, about, rows):
    with open(FOLDER + name, "w") as file:
        file.write("# made for this project by oracles/probe.py (numpy 2.4.6, seed 20261122); no real probe\n")
        file.write(f"# {about}\nx_mm,y_mm,z_mm,i,j,k,orientation_deg\n")
        for p, u, phi in rows:
            words = [f"{v:.6f}" for v in p] + [f"{v:.9f}" for v in u] + [f"{np.degrees(phi):.1f}"]
            file.write(",".join(words) + "\n")


def basis(angles, order):
    return np.array([[1.0] + [f(k * a) for k in range(2, order + 1) for f in (np.cos, np.sin)] for a in angles])


def pretravel(rows, o, c):
    out = []
    for a, phi, p in rows:
        u = np.array([np.cos(a), np.sin(a)])
        w = p + turn(o, phi) - c
        along = w @ u
        out.append(along - np.sqrt((RING_MM - BALL_MM) ** 2 - (w @ w - along * along)))
    return np.array(out)


def fit(rows, order, known):
    """Coefficients, offset and (if it is not known) centre."""
    design = basis([a - phi for a, phi, _ in rows], order)
    n = design.shape[1]
    centre = lambda x: CENTRE if known else x[n + 2:n + 4]
    left = lambda x: (pretravel(rows, x[n:n + 2], centre(x)) - design @ x[:n]) * 1e3
    start = np.concatenate([np.zeros(n), [0, 0], [] if known else CENTRE])
    found = least_squares(left, start, method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15)
    return found.x, found.fun / 1e3, found.jac / 1e3


def case(rows, order, known):
    x, left, jac = fit(rows, order, known)
    n = basis([0.0], order).shape[1]
    freedom = len(rows) - len(x)
    s2 = left @ left / freedom
    covariance = s2 * np.linalg.inv(jac.T @ jac)
    held = np.zeros(len(rows))
    keys = [round(np.degrees(a - phi) % 360, 4) for a, phi, _ in rows]
    for key in sorted(set(keys)):
        inside = [i for i, k in enumerate(keys) if k != key]
        out = [i for i, k in enumerate(keys) if k == key]
        y, _, _ = fit([rows[i] for i in inside], order, known)
        c = CENTRE if known else y[n + 2:n + 4]
        t = pretravel([rows[i] for i in out], y[n:n + 2], c)
        design = basis([rows[i][0] - rows[i][1] for i in out], order)
        held[out] = t - design @ y[:n]
    c = CENTRE if known else x[n + 2:n + 4]
    before = pretravel(rows, np.zeros(2), c)
    um = 1e3
    return {
        "order": order,
        "range_before_um": np.ptp(before) * um,
        "range_after_um": np.ptp(left) * um,
        "range_held_out_um": np.ptp(held) * um,
        "rms_held_out_um": np.sqrt(np.mean(held ** 2)) * um,
        "offset_mm": list(x[n:n + 2]),
        "u_offset_mm": list(np.sqrt(np.diag(covariance))[n:n + 2]),
        "centre_mm": list(c),
        "coefficients_um": list(x[:n] * um),
        "u_coefficients_um": list(np.sqrt(np.diag(covariance))[:n] * um),
        "s_um": np.sqrt(s2) * um,
    }


def splines():
    """Three lobes of 10 µm in 60 directions: how far interpolation leaves them in between."""
    nodes = np.radians(np.arange(61) * 6.0)
    values = 10 * np.cos(3 * nodes)
    values[-1] = values[0]
    fine = np.radians(np.arange(0, 360, 0.05))
    cubic = CubicSpline(nodes, values, bc_type="periodic")(fine)
    linear = np.interp(fine, nodes, values)
    true = 10 * np.cos(3 * fine)
    # Least squares with 12 knots: the coefficients go around in harmonics without the first.
    knots = 12
    t = np.arange(-3, knots + 4) * 2 * np.pi / knots
    angles = np.radians(np.arange(60) * 6.0)
    def full(a):
        raw = BSpline.design_matrix(np.mod(a, 2 * np.pi), t, 3).toarray()
        out = np.zeros((len(a), knots))
        for j in range(raw.shape[1]):
            out[:, (j - 1) % knots] += raw[:, j]
        return out
    at = np.arange(knots) * 2 * np.pi / knots
    columns = [np.ones(knots)] + [f(k * at) for k in range(2, knots // 2 + 1) for f in (np.cos, np.sin)
                                  if not (f is np.sin and 2 * k == knots)]
    mixed = np.array(columns).T
    design = np.hstack([full(angles) @ mixed, -np.cos(angles)[:, None], -np.sin(angles)[:, None]])
    y = np.abs(np.sin(1.5 * angles)) * 8 + 3 * np.cos(angles)
    x = np.linalg.lstsq(design, y, rcond=None)[0]
    probe = np.radians([1.0, 47.0, 123.4, 200.0, 359.0])
    table = full(probe) @ mixed @ x[:-2] - np.cos(probe) * x[-2] - np.sin(probe) * x[-1]
    return {
        "three_lobes_linear_um": np.abs(linear - true).max(),
        "three_lobes_periodic_spline_um": np.abs(cubic - true).max(),
        "cusps": {"knots": knots, "angles_deg": list(np.degrees(probe)), "table_um": list(table),
                  "offset_um": list(x[-2:])},
    }


def main():
    rng = np.random.default_rng(SEED)
    even = np.radians(np.arange(60) * 6.0)
    ring = make(rng, even)
    fresh = make(rng, np.sort(rng.uniform(0, 2 * np.pi, 45)).round(3))
    turned = [row for phi in (0.0, np.pi) for row in make(rng, np.radians(np.arange(36) * 10.0), phi)]
    truth = ("truth: ring 62 mm about (120, 80), ball 4 mm, offset (3.5, -2.0) um, pre-travel 17.5 um + 10 um "
             "in three lobes + 1.2, 1.6, 0.6 um in 2, 6, 9; noise 1 um")
    write("ring-60.csv", truth, ring)
    write("ring-60-fresh.csv", "the same probe in 45 other directions; " + truth, fresh)
    write("ring-turned.csv", "the same probe with the spindle at 0 and 180 deg; " + truth, turned)
    for name, offset, radius, scale in (("sphere-short.csv", (0.0035, -0.0020), 2.0, 1.0),
                                        ("sphere-long.csv", (0.0200, 0.0080), 1.0, 1.6)):
        about = (f"truth: sphere 25 mm at (-40, 10, -180), ball {2 * radius} mm, offset {offset} mm, pre-travel "
                 f"{scale} * (15 + 4 sin^2 + 10 cos^3 cos(3 a - 60 deg) + 2 cos sin cos a) um; noise 0.5 um")
        write_sphere(name, about, sphere_hits(rng, np.array(offset), radius, scale))
    reread = lambda rows: [(np.radians(float(f"{np.degrees(a):.3f}")), phi, p) for a, phi, p in rows]
    document = {
        "ring_60": [case(reread(ring), order, True) for order in (3, 6, 9)],
        "turned": [case(reread(turned), order, False) for order in (3, 6)],
        "splines": splines(),
    }
    with open(EXPECTED, "w") as file:
        json.dump(document, file, indent=1)
        file.write("\n")


main()
