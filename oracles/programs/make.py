"""Writes the NC programs of examples/02_simulate.

Python 3.13, standard library only:  python3 oracles/programs/make.py

The shapes are made for this project: an impeller of five blades whose flanks are ruled surfaces,
and a bangle with a wave engraved round its outside.
"""

from math import atan2, cos, degrees, hypot, pi, radians, sin, sqrt
from pathlib import Path

FOLDER = Path(__file__).parents[2] / "examples" / "02_simulate"
BLADES = 5
HEIGHT = 60.0  # of the blades, mm
POINTS = 40  # along a blade


def unit(v):
    length = sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def hub(t):
    """Radius and height of the hub line, t from the eye (0) to the outlet (1)."""
    return 25.0 + 45.0 * t * t, HEIGHT * (1.0 - t)


def blade(t, number, side):
    """Tip on the hub and tool axis along the ruling, for one side of one blade."""
    radius, height = hub(t)
    azimuth = 2 * pi * number / BLADES + radians(55.0) * t + side * radians(9.0)
    tip = [radius * cos(azimuth), radius * sin(azimuth), height]
    # The ruling leans outwards and along the blade.
    lean, twist = radians(20.0 + 25.0 * t), azimuth + radians(25.0) * side
    return tip, unit([sin(lean) * cos(twist), sin(lean) * sin(twist), cos(lean)])


def words(names, values, digits):
    return " ".join(f"{n}={v:.{digits}f}" for n, v in zip(names, values))


class Program:
    def __init__(self):
        self.lines, self.number = [], 0

    def add(self, text):
        self.number += 10
        self.lines.append(f"N{self.number} {text}")

    def save(self, name, head=(), tail=()):
        (FOLDER / name).write_text("\n".join([*head, *self.lines, *tail]) + "\n")


def impeller():
    program = Program()
    for text in (
        "G54 G17 G710 G90 G94",
        'T="BALL_8"',
        "M6",
        "D1 S12000 M3 M8",
        "CYCLE832(0.01)",
        "G0 X0 Y0 Z150",
        "TRAORI",
        "ORIWKS ORIVECT",
    ):
        program.add(text)
    for number in range(BLADES):
        for side in (-1, 1):
            pass_number = 2 * number + (side + 1) // 2 + 1
            steps = [i / POINTS for i in range(POINTS + 1)]
            steps = steps if side < 0 else steps[::-1]
            tip, axis = blade(steps[0], number, side)
            high = [p + 70.0 * a for p, a in zip(tip, axis)]
            near = [p + 5.0 * a for p, a in zip(tip, axis)]
            program.add(f"G0 {words('XYZ', high, 4)} {words(('A3', 'B3', 'C3'), axis, 6)}".replace("X=", "X").replace("Y=", "Y").replace(" Z=", " Z"))
            program.add(f"G0 X{near[0]:.4f} Y{near[1]:.4f} Z{near[2]:.4f}")
            for i, t in enumerate(steps):
                tip, axis = blade(t, number, side)
                feed = " F600" if i == 0 else " F1800" if i == 1 else ""
                place = f"X{tip[0]:.4f} Y{tip[1]:.4f} Z{tip[2]:.4f}"
                program.add(f"G1 {place} {words(('A3', 'B3', 'C3'), axis, 6)}{feed}")
            away = [p + 70.0 * a for p, a in zip(tip, axis)]
            program.add(f"G0 X{away[0]:.4f} Y{away[1]:.4f} Z{away[2]:.4f} ; pass {pass_number} done")
    for text in ("TRAFOOF", "M5 M9", "SUPA G0 Z200 D0", "M30"):
        program.add(text)
    head = (
        "%_N_IMPELLER_MPF",
        "; Impeller, five blades, finishing of the flanks. Made for this project by oracles/programs/make.py.",
    )
    program.save("impeller-840d.mpf", head)


def ring():
    program = Program()
    radius, tilt, waves, turns = 30.0, 65.0, 6, 2
    for text in (
        "G21 G17 G40 G80 G90 G94",
        "T1 M6",
        "G54 S18000 M3",
        "G5.1 Q1",
        "G0 X0 Y0",
        "G43.4 H1 Z60. M8",
    ):
        program.add(text)

    def place(angle, lift):
        height = 14.0 + 3.0 * sin(waves * angle) + 4.0 * angle / (2 * pi)
        axis = [sin(radians(tilt)) * cos(angle), sin(radians(tilt)) * sin(angle), cos(radians(tilt))]
        tip = [radius * cos(angle), radius * sin(angle), height]
        return [p + lift * a for p, a in zip(tip, axis)]

    def turned(angle):
        return degrees(angle) + 90.0

    x, y, z = place(0.0, 30.0)
    program.add(f"G0 X{x:.3f} Y{y:.3f} Z{z:.3f} A{tilt:.3f} C{turned(0.0):.3f}")
    x, y, z = place(0.0, 2.0)
    program.add(f"G0 X{x:.3f} Y{y:.3f} Z{z:.3f}")
    steps = 120 * turns
    for i in range(steps + 1):
        angle = 2 * pi * turns * i / steps
        x, y, z = place(angle, -0.15)
        feed = " F400." if i == 0 else " F1500." if i == 1 else ""
        program.add(f"G1 X{x:.4f} Y{y:.4f} Z{z:.4f} A{tilt:.3f} C{turned(angle):.3f}{feed}")
    x, y, z = place(2 * pi * turns, 30.0)
    program.add(f"G0 X{x:.3f} Y{y:.3f} Z{z:.3f}")
    for text in ("G49", "M5", "M9", "G53 G0 Z100.", "M30"):
        program.add(text)
    head = ("%", "O2002 (BANGLE WITH A WAVE, MADE FOR THIS PROJECT BY ORACLES/PROGRAMS/MAKE.PY)")
    program.save("ring-fanuc.nc", head, ("%",))


impeller()
ring()
