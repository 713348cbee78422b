"""Readings and null spaces for `trueaxis identify`, from a kinematic model of its own (30 lines).

tool     numpy 2.4.6, Python 3.11
command  python3 oracles/identify.py          (2 s, repository root)
writes   examples/05_identify/probe-ball.csv, ball-bar.csv, r-test.csv, laser-x.csv
         crates/trueaxis/tests/data/identify-null-space.json

Conventions: shared/conventions.md only. The truth of the readings: the location errors that
machines/lei-hsu-mill/machine.toml states; for ball-bar.csv, r-test.csv and laser-x.csv also
EXX = 6 um P1(x) - 3 um P2(x), x = X/500 mm. Noise 1 um, seed 20261121; the ball was set up
(15, -8, 11) um off.
"""
import json
import os

import numpy as np

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
TITLE = "# made for this project by oracles/identify.py (numpy 2.4.6, seed 20261121)\n"

# body: placement, side (+1 tool, -1 workpiece), order from the bed, motion, sense
LEI_HSU = dict(
    workpiece=["Y", "X", "A", "C"], tool=["Z"], w=[60, 40, 120], t=[0, 0, 180], tip=[0, 0, -330],
    place=dict(C=[0, 0, 0], A=[250, 200, -350], X=[0, 0, 0], Y=[0, 0, 0], Z=[0, 0, 0]),
    sense=dict(C=1, A=1, X=-1, Y=-1, Z=1))
I5 = dict(
    workpiece=["A", "C"], tool=["X", "Y", "Z"], w=[0, 0, 35], t=[0, 0, -90], tip=[0, 0, -90],
    place=dict(C=[0, 0, 0], A=[0, 0, 0], X=[0, 0, 250], Y=[0, -80, 40], Z=[0, 80, -110]),
    sense=dict(C=-1, A=-1, X=1, Y=1, Z=1))
STATED = dict(EX0w=6e-3, EY0w=-4e-3, EZ0w=8e-3, EX0C=9e-3, EY0C=-15e-3, EB0C=71e-6, EY0A=12e-3,
              EZ0A=-18e-3, EA0A=40e-6, EB0A=65e-6, EC0A=-52e-6, EC0X=31e-6, EA0Z=-26e-6, EB0Z=17e-6)


def turn(axis, angle):
    c, s, r = np.cos(angle), np.sin(angle), np.eye(4)
    i, j = [(1, 2), (2, 0), (0, 1)]["ABC".index(axis)]
    r[i, i], r[i, j], r[j, i], r[j, j] = c, -s, s, c
    return r


def shift(v):
    m = np.eye(4)
    m[:3, 3] = v
    return m


def error(errors, body):
    six = [errors.get(f"E{d}0{body}", 0.0) for d in "XYZABC"]
    return shift(six[:3]) @ turn("C", six[5]) @ turn("B", six[4]) @ turn("A", six[3])


def link(m, body, q, errors):
    q = m["sense"][body] * q
    if body in "ABC":
        motion = turn(body, q)
    else:
        motion = shift(np.eye(3)["XYZ".index(body)] * q)
        if body == "X":  # EXX of a body: actual - nominal of the body, in X
            motion = shift([errors.get("EXX", lambda q: 0.0)(m["sense"]["X"] * q), 0, 0]) @ motion
    return shift(m["place"][body]) @ error(errors, body) @ motion


def tool_in_workpiece(m, command, errors):
    work, tool = np.eye(4), np.eye(4)
    for body in m["workpiece"]:
        work = work @ link(m, body, command[body], errors)
    for body in m["tool"]:
        tool = tool @ link(m, body, command[body], errors)
    work = work @ shift(m["w"]) @ error(errors, "w")
    tool = tool @ shift(m["t"]) @ error(errors, "t")
    return np.linalg.inv(work) @ tool


def tip(m, command, errors):
    return (tool_in_workpiece(m, command, errors) @ np.append(m["tip"], 1.0))[:3]


def at(m, a, c, target):
    """X, Y, Z with the tip of the nominal machine at a point of the workpiece."""
    command = dict(A=a, C=c, X=0.0, Y=0.0, Z=0.0)
    base = tip(m, command, {})
    jacobian = np.column_stack([tip(m, dict(command, **{x: 1.0}), {}) - base for x in "XYZ"])
    command.update(zip("XYZ", np.linalg.solve(jacobian, np.array(target) - base)))
    return command


def probe_ball(m, command, errors, ball):
    pose = tool_in_workpiece(m, command, errors)
    p = (pose @ np.append(m["tip"], 1.0))[:3]
    return pose[:3, :3].T @ (ball - p)


def angles():
    """Like document 004: A alone, C alone, F (rises while it turns), S (tilted circle)."""
    d = np.radians
    poses = [(d(a), d(90)) for a in np.linspace(90, 0, 19)]
    poses += [(d(90), d(c)) for c in np.linspace(0, 350, 36)]
    poses += [(d(90 - 90 * i / 36), d(10 * i)) for i in range(37)]
    poses += [(d(90) - d(35) * (1 - np.cos(d(10 * i))), d(10 * i)) for i in range(37)]
    return poses


def write(name, heading, rows, note):
    with open(os.path.join(ROOT, "examples", "05_identify", name), "w") as out:
        out.write(TITLE + f"# {note}\n" + heading + "\n")
        for row in rows:
            out.write(",".join(f"{v:.4f}" if isinstance(v, float) else str(v) for v in row) + "\n")


def words(command, axes="CAXYZ"):
    # Rounded as they are written, so that the readings belong to what is read.
    unit = lambda x: np.degrees(command[x]) if x in "AC" else command[x]
    shown = [float(round(unit(x), 4)) + 0.0 for x in axes]
    exact = {x: np.radians(v) if x in "AC" else v for x, v in zip(axes, shown)}
    return shown, exact


def readings():
    rng = np.random.default_rng(20261121)
    m, ball = LEI_HSU, np.array([15e-3, -8e-3, 11e-3])
    rows = []
    for run in range(2):
        for k, (a, c) in enumerate(angles()):
            shown, command = words(at(m, a, c, [0, 0, 0]))
            r = probe_ball(m, command, STATED, ball) - probe_ball(m, command, {}, np.zeros(3))
            rows.append(shown + [float(v) for v in (r + rng.normal(0, 1e-3, 3)) * 1e3] + [k])
    write("probe-ball.csv", "C,A,X,Y,Z,x_um,y_um,z_um,group", rows,
          "ball - socket in the frame of the probe; every path twice")
    exx = lambda q: 6e-3 * (q / 500) - 3e-3 * 0.5 * (3 * (q / 500) ** 2 - 1)
    errors = dict(STATED, EXX=exx)
    rows = []
    for k, (a, c) in enumerate(angles()[:92]):
        shown, command = words(at(m, a, c, [0, 0, 0]))
        r = probe_ball(m, command, errors, ball) - probe_ball(m, command, {}, np.zeros(3))
        rows.append(shown + [float(v) for v in (r + rng.normal(0, 1e-3, 3)) * 1e3] + [k])
    write("r-test.csv", "C,A,X,Y,Z,x_um,y_um,z_um,group", rows, "R-test, paths A, C, F")
    rows, bar_ball = [], np.array([12e-3, 5e-3, -7e-3])
    circles = [((1, 0, 0), (0, 1, 0), 360), ((1, 0, 0), (0, 0, 1), 180), ((0, 1, 0), (0, 0, 1), 180)]
    for u, v, arc in circles:
        for angle in np.radians(np.arange(0, arc + 1, 10)):
            place = 150 * (np.cos(angle) * np.array(u) + np.sin(angle) * np.array(v))
            shown, command = words(at(m, 0.0, 0.0, place + [0, 0, 100]))
            length = np.linalg.norm(tip(m, command, errors) - np.array([0, 0, 100]) - bar_ball)
            rows.append(shown + [f"{length + 8e-3 + rng.normal(0, 1e-3):.6f}", len(rows)])
    write("ball-bar.csv", "C,A,X,Y,Z,length_mm,group", rows,
          "bar of 150 mm, 8 um longer than said, in three planes about (0 0 100) mm")
    rows = []
    for run in range(2):
        for x in range(-400, 401, 50):
            shown, command = words(at(m, 0.0, 0.0, [x, 0.0, 100.0]))
            r = tip(m, command, errors)[0] - tip(m, command, {})[0]
            rows.append(shown + [float((r + 5e-3 + rng.normal(0, 0.5e-3)) * 1e3), len(rows) % 17])
    write("laser-x.csv", "C,A,X,Y,Z,deviation_um,group", rows, "laser along X, two runs")


def null_space(m, commands):
    names = [f"E{d}0{b}" for b in m["workpiece"][::-1] + m["tool"] for d in "XYZABC"]
    columns = []
    for name in names + ["x", "y", "z"]:
        h = 1e-2 if name in "xyz" or name[1] in "XYZ" else 1e-4
        column = []
        for command in commands:
            def read(s):
                ball = np.array([s * h * (name == k) for k in "xyz"])
                return probe_ball(m, command, {} if name in "xyz" else {name: s * h}, ball)
            column.extend((read(1) - read(-1)) / (2 * h))
        columns.append(column)
    j = np.array(columns).T
    scale = np.linalg.norm(j, axis=0)
    scale[scale < 1e-9 * scale.max()] = 1.0
    _, s, vt = np.linalg.svd(j / scale)
    rank = int((s > 1e-6 * s[0]).sum())
    return names, rank, vt[rank:] / scale


def null_spaces():
    out = {}
    rng = np.random.default_rng(5)
    for name, m in [("lei-hsu-mill", LEI_HSU), ("i5-engraver", I5)]:
        poses = [(rng.uniform(-1.4, 1.4), rng.uniform(-3, 3)) for _ in range(30)]
        commands = [at(m, a, c, [0, 0, 0]) for a, c in poses]
        names, rank, basis = null_space(m, commands)
        out[name] = dict(
            axes="CAXYZ", commands=[[float(c[x]) for x in "CAXYZ"] for c in commands],
            unknowns=names + ["ball_x", "ball_y", "ball_z"], rank=rank,
            null_space=[[float(v) for v in row] for row in basis])
    path = os.path.join(ROOT, "crates", "trueaxis", "tests", "data", "identify-null-space.json")
    with open(path, "w") as file:
        json.dump(out, file, indent=0)
        file.write("\n")
    print({k: (len(v["unknowns"]), v["rank"]) for k, v in out.items()})


readings()
null_spaces()
