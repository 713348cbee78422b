"""Programs of lines of 0.3 mm: a dome by tool vectors, a wavy ring by table angles, each with its set-up file."""

import math

STEP_MM = 0.3
DOME_MM, BALL_MM, SIDE_MM = 120.0, 5.0, 96.0
RING_MM, TILT_DEG = 30.0, 65.0

XKAS_SETUP = """name = "dome"
control = "sinumerik"
workpiece_at = "G54"
[work_offset.G54]
X = "3100 mm"
Y = "1250 mm"
Z = "-900 mm"
[tool.1]
name = "BALL"
length = "140 mm"
diameter = "10 mm"
corner_radius = "5 mm"
"""

I5_SETUP = """name = "ring"
control = "CONTROL"
workpiece_at = "G54"
[work_offset.G54]
X = "0 mm"
Y = "0 mm"
Z = "-55 mm"
[tool.1]
name = "engraver 3"
length = "90 mm"
diameter = "3 mm"
[start]
Z = "100 mm"
"""


def dome(lines):
    """Tips and axes of rows to and fro; the tool leans 10° along its way and swings."""
    per_row = int(SIDE_MM / STEP_MM)
    rows = max(2, lines // per_row)
    for i in range(lines):
        row, k = divmod(i, per_row)
        k = k if row % 2 == 0 else per_row - 1 - k
        along, across = (k / (per_row - 1) - 0.5) * SIDE_MM, (row / rows - 0.5) * SIDE_MM
        normal = (along / DOME_MM, across / DOME_MM, math.sqrt(DOME_MM**2 - along**2 - across**2) / DOME_MM)
        lean = (normal[0] + 0.17, normal[1] + 0.05 * math.sin(along / 10), normal[2])
        length = math.sqrt(sum(c * c for c in lean))
        axis = [c / length for c in lean]
        yield [normal[j] * (DOME_MM + BALL_MM) - axis[j] * BALL_MM for j in range(3)], axis


def ring(lines):
    """Tips and the angle C of a ring with a wave, to and fro once around; A stands at 65°."""
    per_turn = int(2 * math.pi * RING_MM / STEP_MM)
    for i in range(lines):
        turn, k = divmod(i, per_turn)
        angle = (k if turn % 2 == 0 else per_turn - k) / per_turn * 2 * math.pi
        wave = 0.5 * math.sin(24 * angle)
        radius = RING_MM + 0.4 * wave
        yield (radius * math.cos(angle), radius * math.sin(angle), 14 + wave), math.degrees(angle) + 90


def written(folder, lines):
    """The files by their names; those of another length are written again."""
    folder.mkdir(parents=True, exist_ok=True)
    makers = {
        "dome.mpf": dome_mpf,
        "dome.cls": dome_cls,
        "ring-fanuc.nc": ring_fanuc,
        "ring-heidenhain.h": ring_heidenhain,
        "ring.cls": ring_cls,
        "positions.csv": positions_csv,
    }
    files = {name: folder / name for name in makers}
    stamp = folder / "lines"
    if not stamp.exists() or stamp.read_text() != str(lines):
        for name, make in makers.items():
            with open(files[name], "w", encoding="ascii") as file:
                file.writelines(make(lines))
        (folder / "dome.setup.toml").write_text(XKAS_SETUP)
        for name, control in (("ring-fanuc", "fanuc"), ("ring-heidenhain", "heidenhain")):
            set_up = I5_SETUP.replace("CONTROL", control)
            (folder / f"{name}.setup.toml").write_text(set_up)
        stamp.write_text(str(lines))
    return files


def dome_mpf(lines):
    yield 'G54 G17 G710 G90 G94\nT="BALL"\nM6\nD1 S12000 M3\nG0 X0 Y0 Z200\nTRAORI\nORIWKS ORIVECT\n'
    for (x, y, z), (i, j, k) in dome(lines):
        yield f"G1 X{x:.5f} Y{y:.5f} Z{z:.5f} A3={i:.8f} B3={j:.8f} C3={k:.8f} F3000\n"
    yield "G0 Z200\nTRAFOOF\nM30\n"


def dome_cls(lines):
    yield "PARTNO/DOME\nUNITS/MM\nMULTAX/ON\nLOADTL/1\nSPINDL/RPM,12000,CLW\nFEDRAT/3000,MMPM\n"
    for (x, y, z), (i, j, k) in dome(lines):
        yield f"GOTO/{x:.5f},{y:.5f},{z:.5f},{i:.8f},{j:.8f},{k:.8f}\n"
    yield "FINI\n"


def ring_fanuc(lines):
    yield "%\nO1\nG21 G17 G40 G80 G90 G94\nT1 M6\nG54 S18000 M3\nG0 X0 Y0\nG43.4 H1 Z60.\nG0 X57. Y0. Z30. A65. C90.\n"
    for (x, y, z), c in ring(lines):
        yield f"G1 X{x:.4f} Y{y:.4f} Z{z:.4f} A65.000 C{c:.4f} F1500.\n"
    yield "G0 Z60.\nG49\nM30\n%\n"


def ring_heidenhain(lines):
    yield "0 BEGIN PGM RING MM\n1 TOOL CALL 1 Z S18000\n2 L Z+60 R0 FMAX M3\n3 M128\n4 L X+57 Y+0 Z+30 A+65 C+90 FMAX\n"
    number = 4
    for (x, y, z), c in ring(lines):
        number += 1
        yield f"{number} L X{x:+.4f} Y{y:+.4f} Z{z:+.4f} A+65 C{c:+.4f} F1500\n"
    yield f"{number + 1} M129\n{number + 2} L Z+60 FMAX\n{number + 3} M30\n{number + 4} END PGM RING MM\n"


def ring_cls(lines):
    yield "PARTNO/RING\nUNITS/MM\nMULTAX/ON\nLOADTL/1\nSPINDL/RPM,18000,CLW\nFEDRAT/1500,MMPM\n"
    sin, cos = math.sin(math.radians(TILT_DEG)), math.cos(math.radians(TILT_DEG))
    for (x, y, z), _ in ring(lines):
        radius = math.hypot(x, y)
        yield f"GOTO/{x:.5f},{y:.5f},{z:.5f},{sin * x / radius:.8f},{sin * y / radius:.8f},{cos:.8f}\n"
    yield "FINI\n"


def positions_csv(lines):
    yield "X,Y,Z,C,A\n"
    for (x, y, z), (i, j, k) in dome(lines):
        c, a = math.degrees(math.atan2(i, -j)), math.degrees(math.acos(k))
        yield f"{3100 + x:.4f},{1250 + y:.4f},{z - 800:.4f},{c:.4f},{a:.4f}\n"
