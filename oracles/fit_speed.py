"""The peer of `cargo bench -p trueaxis --bench identify`: scipy.optimize.least_squares, numerical
Jacobian, on the same model and the same number of unknowns and readings, in the same run.

Tool: scipy 1.17.1, numpy 2.4.6, Python 3.11
Command: python3 oracles/fit_speed.py          (runs cargo bench too; prints both and their ratio)

Model: ZX'Y'A'C' mill of document 004 (machines/lei-hsu-mill without its stated errors), probe-ball.
A vectorised chain in numpy, written from shared/conventions.md. Unknowns: the errors that the bench
names, 43 with the ball.
"""
import re
import subprocess
import time

import numpy as np
from scipy.optimize import least_squares

POSES = 33_334
TIP = np.array([0.0, 0.0, -330.0])
# chain from the workpiece: body, place, axis direction, kind, sense
BODIES = [("w", (60, 40, 120), None), ("C", (0, 0, 0), "rz"), ("A", (250, 200, -350), "rx"),
          ("X", (0, 0, 0), "tx"), ("Y", (0, 0, 0), "ty"), ("Z", (0, 0, 0), "tz"), ("t", (0, 0, 180), None)]
SENSE = {"C": 1, "A": 1, "X": -1, "Y": -1, "Z": 1}
REACH = {"C": 3.0, "A": 1.5, "X": 200.0, "Y": 200.0, "Z": 200.0}
# the eleven of the minimal set
LOCATION = ["EY0C", "EB0C", "EA0A", "EB0A", "EC0A", "EY0A", "EZ0A", "EC0X", "EA0Y", "EB0Y"]
FOURIER = ["ECC", "ECA", "EXC"]
POLY = ["EXX", "EYX", "EXY", "EYY", "EXZ"]
BALL = 3


def rotation(axis, angle):
    n = len(np.atleast_1d(angle))
    c, s = np.cos(angle), np.sin(angle)
    r = np.zeros((n, 3, 3))
    i, j, k = {"x": (0, 1, 2), "y": (1, 2, 0), "z": (2, 0, 1)}[axis]
    r[:, i, i] = 1
    r[:, j, j] = c
    r[:, k, k] = c
    r[:, j, k] = -s
    r[:, k, j] = s
    return r


class Model:
    def __init__(self, rng):
        self.q = {a: r * rng.uniform(-1, 1, POSES) for a, r in REACH.items()}
        names = list(LOCATION)
        self.phi = [np.ones(POSES)] * len(names)
        for e in FOURIER:
            q = self.q[e[2]]
            for k in (1, 2):
                names += [e, e]
                self.phi += [np.cos(k * q), np.sin(k * q)]
        for e in POLY:
            x = self.q[e[2]] / 500.0
            names += [e, e, e]
            self.phi += [(3 * x**2 - 1) / 2, (5 * x**3 - 3 * x) / 2, (35 * x**4 - 30 * x**2 + 3) / 8]
        self.names = names
        self.n = len(names) + BALL

    def errors(self, x):
        e = {}
        for name, phi, c in zip(self.names, self.phi, x):
            kind = "L" if len(name) == 4 else "E"
            key = (name[-1], kind)
            six = e.setdefault(key, np.zeros((6, POSES)))
            six["XYZABC".index(name[1])] += c * phi
        return e

    def small(self, six):
        r = rotation("z", six[5]) @ rotation("y", six[4]) @ rotation("x", six[3])
        return r, six[:3].T

    def read(self, x):
        e = self.errors(x)
        out = {}
        for side in (BODIES[4::-1], BODIES[5:]):
            r = np.broadcast_to(np.eye(3), (POSES, 3, 3))
            t = np.zeros((POSES, 3))

            def then(dr, dt):
                nonlocal r, t
                t = t + np.einsum("nij,nj->ni", r, np.broadcast_to(dt, (POSES, 3)))
                r = r if dr is None else r @ dr

            for name, place, axis in side:
                then(None, np.array(place, float))
                if (name, "L") in e:
                    then(*self.small(e[(name, "L")]))
                if axis and axis[0] == "r":
                    if (name, "E") in e:
                        then(*self.small(e[(name, "E")]))
                    then(rotation(axis[1], SENSE[name] * self.q[name]), np.zeros(3))
                elif axis:
                    step = np.zeros((POSES, 3))
                    step[:, "xyz".index(axis[1])] = SENSE[name] * self.q[name]
                    then(None, step)
                    if (name, "E") in e:
                        then(*self.small(e[(name, "E")]))
            out[side[-1][0]] = (r, t)
        rw, tw = out["w"]
        rt, tt = out["t"]
        ball = tw + np.einsum("nij,j->ni", rw, np.append(x[len(self.names):], [])[:3])
        socket = tt + rt @ TIP
        return np.einsum("nji,nj->ni", rt, ball - socket).ravel()


def main():
    rng = np.random.default_rng(1)
    model = Model(rng)
    truth = np.array([rng.uniform(-1, 1) * (5e-5 if n[1] in "ABC" else 0.02) for n in model.names] +
                     [rng.uniform(-0.02, 0.02) for _ in range(BALL)])
    y = model.read(truth) + 1e-3 * rng.standard_normal(3 * POSES)
    scale = np.array([1e-5 if n[1] in "ABC" else 1e-2 for n in model.names] + [1e-2] * BALL)
    start = time.perf_counter()
    found = least_squares(lambda x: (model.read(x) - y) / 1e-3, np.zeros(model.n), x_scale=scale)
    seconds = time.perf_counter() - start
    peer = 3 * POSES / seconds
    print(f"scipy: {model.n} unknowns, {3 * POSES} numbers, {found.nfev} evaluations and {found.njev} "
          f"Jacobians, {seconds:.2f} s, {peer / 1e3:.1f} k numbers/s, rms {np.sqrt(np.mean(found.fun**2)):.3f} noise")
    text = subprocess.run(["cargo", "bench", "-p", "trueaxis", "--bench", "identify", "--", "33334"],
                          capture_output=True, text=True).stdout
    print(text)
    line = [l for l in text.splitlines() if "item/s" in l][0]
    rates = re.findall(r"([\d.]+) ([KM])item/s", line)
    ours = [float(v) * {"K": 1e3, "M": 1e6}[u] for v, u in rates][2]
    print(f"trueaxis (median): {ours / 1e3:.0f} k numbers/s; ratio {ours / peer:.1f}")


if __name__ == "__main__":
    main()
