"""Sections of pieces with known form deviations -> examples/07_verify/cone-section.csv, cylinder-points.csv, edge-profile.csv

usage: python3 oracles/cone_section.py
cone-section: the section of a 15 deg cone at height 40 mm, radius 118 mm, measured at 180 even angles; centre (0.012, -0.008) mm,
the plane of the touches is tilted by 20 urad about X; lobes 6 um cos(3 a + 0.4) + 1.5 um cos(12 a), noise 0.3 um (seed 15).
cylinder-points: bore of radius 25 mm, 5 sections of 24 points over 80 mm, axis tilted by (40, -60) urad, barrel 3 um, ovality 4 um
cos(2 a), noise 0.3 um. edge-profile: 401 points at 0.1 mm, bow of 5 um over 40 mm, waves of 1 um at 0.4 mm, noise 0.1 um."""
import os

import numpy as np

OUT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples", "07_verify")
R = np.random.default_rng(15)


def write(name, text, columns, rows):
    with open(os.path.join(OUT, name), "w") as fh:
        fh.write("".join("# %s\n" % l for l in text) + ",".join(columns) + "\n")
        for row in rows:
            fh.write(",".join("%.5f" % v for v in row) + "\n")


n = 180
a = np.arange(n) * 2 * np.pi / n
r = 118 + 0.006 * np.cos(3 * a + 0.4) + 0.0015 * np.cos(12 * a) + R.normal(0, 0.0003, n)
x, y = 0.012 + r * np.cos(a), -0.008 + r * np.sin(a)
z = 40 + 20e-6 * y + R.normal(0, 0.0003, n)
write("cone-section.csv", ["Virtual section of a cone piece: oracles/cone_section.py"], ["x_mm", "y_mm", "z_mm"], zip(x, y, z))

h = np.repeat(np.linspace(-40, 40, 5), 24)
a = np.tile(np.arange(24) * 2 * np.pi / 24, 5) + np.repeat(np.arange(5) * 0.02, 24)
r = 25 + 0.002 * np.cos(2 * a) + 0.003 * (1 - (h / 40) ** 2) + R.normal(0, 0.0003, len(a))
write("cylinder-points.csv", ["Virtual bore: oracles/cone_section.py"], ["x_mm", "y_mm", "z_mm"],
      zip(r * np.cos(a) + 40e-6 * h, r * np.sin(a) - 60e-6 * h, h))

t = np.arange(401) * 0.1
z = 0.005 * (1 - (t / 20 - 1) ** 2) + 0.001 * np.sin(2 * np.pi * t / 0.4) + R.normal(0, 0.0001, len(t))
write("edge-profile.csv", ["Virtual straightedge: oracles/cone_section.py"], ["x_mm", "z_um"], zip(t, z * 1000))
