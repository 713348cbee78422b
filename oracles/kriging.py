"""Universal kriging and rigid registration of probed points -> crates/trueaxis/tests/data/kriging.json

usage: python3 oracles/kriging.py
tool: scikit-learn 1.9 (kernel Matern, nu = 2.5), scipy (solve of the bordered system; least_squares over exact
rotations). The data are examples/06_compensate/bangle-measured.csv without the chip at point 162; the
field is asked at every 20th place of bangle-blank.csv. Nothing of the Rust code is used.
"""
import json
import os

import numpy as np
import scipy
import scipy.linalg
import scipy.optimize
import sklearn
from sklearn.gaussian_process.kernels import Matern

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
EXAMPLES = os.path.join(ROOT, "examples", "06_compensate")
LENGTH, FORM, NOISE = 12.0, 0.03, 0.0015


def table(name):
    with open(os.path.join(EXAMPLES, name)) as file:
        rows = [line.split(",") for line in file if line[0] not in "#p"]
    rows = np.array(rows, dtype=float)
    rows[:, 4:7] /= np.linalg.norm(rows[:, 4:7], axis=1)[:, None]
    return rows


def features(rows):
    return np.hstack([rows[:, 1:4] / LENGTH, rows[:, 4:7]])


data = table("bangle-measured.csv")
data = data[data[:, 0] != 162]
asked = table("bangle-blank.csv")[::20]
d = data[:, 7] * 1e-3
centre = data[:, 1:4].mean(axis=0)


def basis(rows):
    arm = rows[:, 1:4] - centre
    return np.hstack([rows[:, 4:7], np.cross(arm, rows[:, 4:7])])


kernel = Matern(length_scale=1.0, nu=2.5)
n = len(d)
K = FORM**2 * kernel(features(data)) + NOISE**2 * np.eye(n)
H, p = basis(data), 6
# The bordered system of kriging: weights under the condition that the rigid part is met exactly.
A = np.block([[K, H], [H.T, np.zeros((p, p))]])
Ainv = scipy.linalg.inv(A)
beta = Ainv[n:, :n] @ d
covariance = -Ainv[n:, n:]
k = FORM**2 * kernel(features(asked), features(data))
right = np.hstack([k, basis(asked)])
weights = np.linalg.solve(A, right.T).T
mean = weights[:, :n] @ d
variance = FORM**2 - np.einsum("ij,ij->i", weights, right)
# Leaving each point out, by solving without it.
z = np.empty(n)
for i in range(0, n):
    keep = np.arange(n) != i
    B = np.block([[K[np.ix_(keep, keep)], H[keep]], [H[keep].T, np.zeros((p, p))]])
    b = np.concatenate([K[i, keep], H[i]])
    w = np.linalg.solve(B, b)
    z[i] = (d[i] - w[: n - 1] @ d[keep]) / np.sqrt(K[i, i] - w @ b)
# The plain rigid fit with exact rotations, weights equal.
from scipy.spatial.transform import Rotation


def residual(x):
    moved = Rotation.from_rotvec(x[3:]).apply(data[:, 1:4] - centre) + centre + x[:3]
    return np.einsum("ij,ij->i", moved - data[:, 1:4], data[:, 4:7]) - d


plain = scipy.optimize.least_squares(residual, np.zeros(6), xtol=1e-15, ftol=1e-15, gtol=1e-15).x
out = {
    "source": "oracles/kriging.py, scikit-learn %s, scipy %s" % (sklearn.__version__, scipy.__version__),
    "length_mm": LENGTH,
    "form_mm": FORM,
    "noise_mm": NOISE,
    "shift_mm": beta[:3].tolist(),
    "turn_rad": beta[3:].tolist(),
    "u": np.sqrt(np.diag(covariance)).tolist(),
    "asked": asked[:, 0].tolist(),
    "mean_mm": mean.tolist(),
    "u_mm": np.sqrt(variance).tolist(),
    "left_out_z": z[::10].tolist(),
    "raised": max(1.0, float(np.sqrt(np.mean(z**2)))),
    "plain_fit": plain.tolist(),
}
with open(os.path.join(ROOT, "crates", "trueaxis", "tests", "data", "kriging.json"), "w") as file:
    json.dump(out, file, indent=1)
    file.write("\n")
