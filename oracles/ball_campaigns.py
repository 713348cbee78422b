"""Readings of two campaigns on a ball for `trueaxis identify`, from 4x4 matrices of its own.

tool     numpy 2.4.6, Python 3.11
command  python3 oracles/ball_campaigns.py    (1 s, repository root)
writes   examples/05_identify/head-head.csv, cone-path.csv

Conventions: shared/conventions.md only. Head-head: a probing cycle with the tool-centre-point control on finds the
centre of a fixed ball; what is written is the place that was commanded when the tip met the ball, found by iteration
with the exact chain. Cone path: a probe reads ball - socket in its own frame while both rotary axes of the table
turn. The truths stand below and in the comments of the campaigns; seeds 20261126 and 20261128.
"""
import os

import numpy as np

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
TITLE = "# made for this project by oracles/ball_campaigns.py (numpy 2.4.6, seed {})\n"


def turn(axis, angle):
    c, s, r = np.cos(angle), np.sin(angle), np.eye(4)
    i, j = [(1, 2), (2, 0), (0, 1)]["ABC".index(axis)]
    r[i, i], r[i, j], r[j, i], r[j, j] = c, -s, s, c
    return r


def shift(v):
    m = np.eye(4)
    m[:3, 3] = v
    return m


def six(e):
    """An error: X, Y, Z in mm, A, B, C in rad."""
    return shift(e[:3]) @ turn("C", e[5]) @ turn("B", e[4]) @ turn("A", e[3])


def location(errors, body):
    return six([errors.get(f"E{d}0{body}", 0.0) for d in "XYZABC"])


def motion(errors, body, q):
    return six([errors[f"E{d}{body}"](q) if f"E{d}{body}" in errors else 0.0 for d in "XYZABC"])


def link(m, body, q, errors):
    """One link; an error function takes the command (mm, rad)."""
    arranged = shift(m["place"].get(body, [0, 0, 0])) @ location(errors, body)
    turned = m["sense"].get(body, 1) * q
    if body in "ABC":
        return arranged @ motion(errors, body, q) @ turn(body, turned)
    return arranged @ shift(np.eye(3)["XYZ".index(body)] * turned) @ motion(errors, body, q)


def tool_in_workpiece(m, command, errors, drift=(0.0, 0.0, 0.0)):
    """The drift displaces the tool against the table along the axes of the machine."""
    work, tool = np.eye(4), shift(drift)
    for body in m["workpiece"]:
        work = work @ link(m, body, command[body], errors)
    for body in m["tool"]:
        tool = tool @ link(m, body, command[body], errors)
    work = work @ shift(m["w"]) @ location(errors, "w")
    tool = tool @ shift(m["t"]) @ location(errors, "t")
    return np.linalg.inv(work) @ tool


def tip(m, command, errors):
    return (tool_in_workpiece(m, command, errors) @ np.append(m["tip"], 1.0))[:3]


def at(m, rotary, target):
    """X, Y, Z with the tip of the nominal machine at a point of the workpiece: the tool-centre-point control."""
    command = dict(rotary, X=0.0, Y=0.0, Z=0.0)
    base = tip(m, command, {})
    jacobian = np.column_stack([tip(m, dict(command, **{x: 1.0}), {}) - base for x in "XYZ"])
    command.update(zip("XYZ", np.linalg.solve(jacobian, np.array(target) - base)))
    return command


def write(name, seed, note, heading, rows):
    with open(os.path.join(ROOT, "examples", "05_identify", name), "w") as out:
        out.write(TITLE.format(seed) + f"# {note}\n" + heading + "\n")
        for row in rows:
            out.write(",".join(row) + "\n")


HEAD_HEAD = dict(
    workpiece=[], tool=["X", "Y", "Z", "C", "B"], w=[0, 0, 0], t=[0, 0, 0], tip=[0, 0, -400],
    place=dict(B=[-0.7, -26.7, 0]), sense=dict(B=-1))
um, urad = 1e-3, 1e-6
LISTED = dict(EC0Y=90 * urad, EA0Z=-60 * urad, EB0Z=75 * urad, EA0C=-180 * urad, EB0C=140 * urad,
              EX0B=85 * um, EA0B=-220 * urad, EC0B=160 * urad)


def place(centre):
    """A position of a linear axis as a share of ±400 mm about the place of the ball."""
    return lambda q: (q - centre) / 400.0


X, Y, Z = place(800.0), place(500.0), place(200.0)
UNLISTED = dict(
    EXX=lambda q: 56 * um * X(q) ** 2, EYX=lambda q: -36 * um * X(q) ** 2, ECX=lambda q: 48 * urad * X(q) ** 2,
    EYY=lambda q: 44 * um * Y(q) ** 3, EXY=lambda q: 32 * um * Y(q) ** 2, EAY=lambda q: -36 * urad * Y(q) ** 2,
    EZZ=lambda q: -40 * um * Z(q) ** 2, EXZ=lambda q: 24 * um * Z(q) ** 3)


def head_head():
    seed = 20261126
    rng = np.random.default_rng(seed)
    stated = np.array([800.0, 500.0, -200.0])
    ball = stated + [0.042, -0.063, 0.027]
    poses = [(0, c) for c in range(0, 360, 45)] + [(0, 0)]
    for b in (10, 20, 30, 45, 60, 90):
        for side in (b, -b):
            poses += [(side, c) for c in range(0, 360, 60)] + [(side, 0)]
        poses += [(0, 0)]
    rows = []
    for b, c in poses:
        rotary = dict(B=np.radians(b), C=np.radians(c))
        seen = stated
        for _ in range(6):  # the tip meets the ball
            seen = seen + ball - tip(HEAD_HEAD, at(HEAD_HEAD, rotary, seen), {**LISTED, **UNLISTED})
        rows.append([str(b), str(c)] + [f"{v:.4f}" for v in seen + rng.normal(0, 6 * um, 3)])
    write("head-head.csv", seed, "where a probing cycle found the ball; back to B = 0 after every two tilts",
          "B,C,x_mm,y_mm,z_mm", rows)


LEI_HSU = dict(
    workpiece=["Y", "X", "A", "C"], tool=["Z"], w=[60, 40, 120], t=[0, 0, 180], tip=[0, 0, -330],
    place=dict(A=[250, 200, -350]), sense=dict(X=-1, Y=-1))
STATED = dict(EX0w=6 * um, EY0w=-4 * um, EZ0w=8 * um, EX0C=9 * um, EY0C=-15 * um, EB0C=71 * urad,
              EY0A=12 * um, EZ0A=-18 * um, EA0A=40 * urad, EB0A=65 * urad, EC0A=-52 * urad, EC0X=31 * urad,
              EA0Z=-26 * urad, EB0Z=17 * urad)


def cone(pole, half_angle, count):
    """A and C with the tool axis on a cone about a pole of the workpiece: (sin a sin c, sin a cos c, cos a)."""
    pole = np.array(pole) / np.linalg.norm(pole)
    u = np.cross(pole, [1.0, 0.0, 0.0])
    u /= np.linalg.norm(u)
    v = np.cross(pole, u)
    poses, last = [], 0.0
    for angle in np.radians(np.linspace(0, 360, count)):
        d = np.cos(half_angle) * pole + np.sin(half_angle) * (np.cos(angle) * u + np.sin(angle) * v)
        c = np.arctan2(d[0], d[1])
        last = c + 2 * np.pi * round((last - c) / (2 * np.pi))
        poses.append((np.arccos(d[2]), last))
    return poses


def cone_path():
    seed = 20261128
    rng = np.random.default_rng(seed)
    ball = np.array([15 * um, -8 * um, 11 * um])
    wide, narrow = cone([0, 1, 1.2], np.radians(30), 37), cone([0.2, -0.1, 1], np.radians(35), 37)
    rows = []
    for k, (a, c) in enumerate(wide + wide[::-1] + narrow + narrow[::-1]):
        command = at(LEI_HSU, dict(A=a, C=c), [0, 0, 0])
        shown = [round(np.degrees(command[x]) if x in "AC" else command[x], 4) + 0.0 for x in "CAXYZ"]
        # Rounded as they are written, so that the readings belong to what is read.
        command = {x: np.radians(v) if x in "AC" else v for x, v in zip("CAXYZ", shown)}
        time_s = 12.0 * k
        drift = np.array([4 * um, 0.0, 14 * um]) * (1 - np.exp(-time_s / 1200.0))
        pose = tool_in_workpiece(LEI_HSU, command, STATED, drift)
        socket = (pose @ np.append(LEI_HSU["tip"], 1.0))[:3]
        nominal = tool_in_workpiece(LEI_HSU, command, {})
        there = (nominal @ np.append(LEI_HSU["tip"], 1.0))[:3]
        r = pose[:3, :3].T @ (ball - socket) - nominal[:3, :3].T @ (-there)
        r += rng.normal(0, 1 * um, 3)
        rows.append([f"{v:.4f}" for v in shown] + [f"{v * 1e3:.4f}" for v in r] + [f"{time_s:.0f}"])
    write("cone-path.csv", seed, "ball - socket in the frame of the probe; two cones, there and back",
          "C,A,X,Y,Z,x_um,y_um,z_um,time_s", rows)


head_head()
cone_path()
