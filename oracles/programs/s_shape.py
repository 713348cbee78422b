"""Writes the S-shaped piece of examples/03_predict: its program and the points of its two faces.

Python 3.13, standard library only:  python3 oracles/programs/s_shape.py

A wall between two ruled faces, of the kind of test M4 of ISO 10791-7 whose control points are not public: every number here is
made for this project. The faces are finished by the flank of a flat end mill of 20 mm whose axis lies along the rulings, 10 mm along
the normal in the middle of each; as the rulings are twisted, the mill takes a little too much at their ends.
"""

from math import cos, pi, sin, sqrt
from pathlib import Path

ROOT = Path(__file__).parents[2]
LENGTH, WAVE, HEIGHT = 160.0, 24.0, 40.0  # of the S, mm
ADVANCE, LEAN = 12.0, 3.0  # of the top edge against the bottom edge, mm
HALF = 6.0  # of the thickness, mm
RADIUS = 10.0  # of the tool, mm
BELOW = 2.0  # the tip under the lower edge, mm
STEPS = 400


def edges(u, face):
    """Bottom and top point of a ruling, and their derivatives by u."""
    angle = 2 * pi * u
    bottom = (LENGTH * (u - 0.5), WAVE * sin(angle) + face * HALF, 0.0)
    d_bottom = (LENGTH, 2 * pi * WAVE * cos(angle), 0.0)
    lean, d_lean = LEAN * cos(angle), -2 * pi * LEAN * sin(angle)
    top = (bottom[0] + ADVANCE, bottom[1] + lean, HEIGHT)
    d_top = (d_bottom[0], d_bottom[1] + d_lean, 0.0)
    return bottom, top, d_bottom, d_top


def mix(a, b, v):
    return tuple(x + v * (y - x) for x, y in zip(a, b))


def unit(a):
    length = sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def surface(u, v, face):
    """Point and normal out of the material."""
    bottom, top, d_bottom, d_top = edges(u, face)
    ruling = tuple(t - b for t, b in zip(top, bottom))
    # Along u times up is towards −Y.
    normal = unit(cross(mix(d_bottom, d_top, v), ruling))
    return mix(bottom, top, v), tuple(-face * n for n in normal)


def tool(u, face):
    """Tip and axis."""
    bottom, top, _, _ = edges(u, face)
    axis = unit(tuple(t - b for t, b in zip(top, bottom)))
    _, normal = surface(u, 0.5, face)
    return tuple(b - BELOW * a + RADIUS * n for b, a, n in zip(bottom, axis, normal)), axis


def program():
    lines = [
        "; S-shaped wall, both faces by the flank of a flat end mill of 20 mm. Made for this project by oracles/programs/s_shape.py.",
        "N10 G54 G17 G710 G90 G94",
        'N20 T="FLAT_20"',
        "N30 M6",
        "N40 D1 S6000 M3",
        "N50 G0 X0 Y0 Z150",
        "N60 TRAORI",
        "N70 ORIWKS ORIVECT",
    ]

    def add(text):
        lines.append(f"N{10 * len(lines)} {text}")

    def place(p):
        return f"X{p[0]:.5f} Y{p[1]:.5f} Z{p[2]:.5f}"

    def vector(a):
        return f"A3={a[0]:.8f} B3={a[1]:.8f} C3={a[2]:.8f}"

    for face in (1, -1):
        # In and out of the cut beside the ends of the wall, so that the flank reaches both.
        steps = [-0.02 + 1.04 * i / STEPS for i in range(STEPS + 1)]
        steps = steps if face > 0 else steps[::-1]
        tip, axis = tool(steps[0], face)
        add(f"G0 {place(tuple(p + 80.0 * a for p, a in zip(tip, axis)))} {vector(axis)}")
        for i, u in enumerate(steps):
            tip, axis = tool(u, face)
            add(f"G1 {place(tip)} {vector(axis)}" + (" F1500" if i == 0 else ""))
        add(f"G0 {place(tuple(p + 80.0 * a for p, a in zip(tip, axis)))}")
    for text in ("TRAFOOF", "M5", "SUPA G0 Z0 D0", "M30"):
        add(text)
    (ROOT / "examples/03_predict/s-shape.mpf").write_text("%_N_S_SHAPE_MPF\n" + "\n".join(lines) + "\n")


def points():
    for face, name in ((1, "a"), (-1, "b")):
        rows = ["x_mm,y_mm,z_mm,nx,ny,nz"]
        for i in range(49):
            for j in range(5):
                point, normal = surface((i + 0.5) / 49, (j + 0.5) / 5, face)
                rows.append(",".join([*(f"{p:.9f}" for p in point), *(f"{n:.12f}" for n in normal)]))
        (ROOT / f"parts/s-shape-{name}.csv").write_text("\n".join(rows) + "\n")


program()
points()
