"""Logs of the programs of `identify probe --programs` as a control would write them: a virtual probe in a ring.

Tools: Python alone (3.11 or newer). The probe is that of probe.py (pre-travel, offset, ring, centre), written again
from docs/model.md (136) and (143); the touch is found by bisection on the gap. No oracle of the fit: it makes an example,
and its truth is what the example is judged by.

Run in the repository root: python3 oracles/ring_log.py
Writes examples/05_identify/ring-programs.log, ring-programs-four.log, ring-programs-z.log (no real probe; seed 20261124).
"""

import math
import random

SEED = 20261124
FOLDER = "examples/05_identify/"
RING_MM, BALL_MM = 31.0, 2.0
CENTRE = (120.0, 80.0)
OFFSET = (0.0035, -0.0020)
NOISE_MM = 0.001
TOP_MM, LENGTH_MM = -210.0, 90.0123
TOOL, Z_MM = 5, -127.0


def travel(a):
    """Pre-travel of the virtual probe, mm."""
    return (0.0175 + 0.010 * math.cos(3 * (a - math.radians(20))) + 0.0012 * math.cos(2 * a + 0.4)
            + 0.0016 * math.cos(6 * (a - math.radians(11))) + 0.0006 * math.sin(9 * a))


def hit(a):
    """Where the spindle stands at the trigger if it starts over the centre of the ring."""
    u = (math.cos(a), math.sin(a))
    low, high = 0.0, RING_MM
    for _ in range(80):
        s = (low + high) / 2
        if math.hypot(s * u[0] + OFFSET[0], s * u[1] + OFFSET[1]) < RING_MM - BALL_MM:
            low = s
        else:
            high = s
    s = low + travel(a) + random.gauss(0, NOISE_MM)
    return CENTRE[0] + s * u[0], CENTRE[1] + s * u[1]


def write(name, heading, lines):
    with open(FOLDER + name, "w") as file:
        file.write("# virtual: made for this project by oracles/ring_log.py (seed 20261124); no real probe\n")
        file.write("# truth: ring 62 mm about (120, 80), ball 4 mm, offset (3.5, -2.0) um, pre-travel 17.5 um + 10 um in "
                   "three lobes + 1.2, 1.6, 0.6 um in 2, 6, 9; noise 1 um; length at the trigger 90.0123 mm\n")
        file.write(f"{heading}\n")
        for i, line in enumerate(lines, 1):
            file.write(f"H{i} T{TOOL} {line}\n")
        file.write(f"END {len(lines)}\n")


def ring(angles):
    rows = []
    for degrees in angles:
        x, y = hit(math.radians(degrees))
        rows.append(f"D{degrees:.5f} S0.00000 X{x:.4f} Y{y:.4f} Z{Z_MM:.4f}")
    return rows


random.seed(SEED)
write("ring-programs.log", "TRUEAXIS RING MM MACHINE", ring([6.0 * i for i in range(60)]))
write("ring-programs-four.log", "TRUEAXIS RING MM MACHINE", ring([0.0, 180.0, 90.0, 270.0]))
write("ring-programs-z.log", "TRUEAXIS PLANE MM MACHINE",
      [f"Z{TOP_MM + LENGTH_MM + random.gauss(0, NOISE_MM):.4f}" for _ in range(3)])
