"""The inclined cone frustum of NAS 979 as an NC program -> examples/06_compensate/frustum.mpf

usage: python3 oracles/frustum.py
tool: Python 3.11 alone; no oracle, it makes an example. Cone and cutter are those of
testpieces/nas979-gbt33150.toml; part zero is the centre of the top face, z its axis. The flank of the
cutter lies on the cone: tip = point of the base circle + (D/2) n, tool axis along the generating line.
720 blocks, so that the chord between two is 1.2 um; every tenth is a tool position of the test piece.
"""
import math
import os

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
HALF_ANGLE, BASE_RADIUS, HEIGHT, CUTTER_RADIUS = math.radians(15.0), 125.0, 60.0, 10.0
BLOCKS, CLEARANCE = 720, 15.0


def position(turn, away=0.0):
    sin, cos = math.sin(HALF_ANGLE), math.cos(HALF_ANGLE)
    x, y = math.cos(turn), math.sin(turn)
    reach = CUTTER_RADIUS + away
    tip = (BASE_RADIUS * x + reach * cos * x, BASE_RADIUS * y + reach * cos * y, reach * sin - HEIGHT)
    return tip, (-sin * x, -sin * y, cos)


def words(tip, axis=None):
    text = "X{:.6f} Y{:.6f} Z{:.6f}".format(*(v + 0.0 for v in tip))
    return text if axis is None else text + " A3={:.9f} B3={:.9f} C3={:.9f}".format(*axis)


def main():
    lines = ["; NAS 979 frustum, 15 deg, flank milling in one turn. Made by oracles/frustum.py."]
    number = 0

    def block(text):
        nonlocal number
        number += 10
        lines.append(f"N{number} {text}")

    block("G54 G17 G710 G90 G94")
    block("T1")
    block("M6")
    block("D1 S4000 M3 M8")
    block("TRAORI")
    block("ORIWKS ORIVECT")
    tip, axis = position(0.0, CLEARANCE)
    block("G0 " + words((tip[0], tip[1], 150.0), axis) + " ; above the part")
    block("G0 " + words(tip))
    block("G1 " + words(position(0.0)[0]) + " F800 ; to the flank")
    for i in range(1, BLOCKS + 1):
        block("G1 " + words(*position(2.0 * math.pi * i / BLOCKS)))
    block("G1 " + words(tip) + " ; away from it")
    block(f"G0 Z{150.0}")
    block("TRAFOOF")
    block("M5")
    block("M9")
    block("M30")
    path = os.path.join(ROOT, "examples", "06_compensate", "frustum.mpf")
    with open(path, "w", encoding="ascii", newline="\n") as file:
        file.write("\n".join(lines) + "\n")


main()
