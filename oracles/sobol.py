"""Points of the sequence of Sobol', exact intervals of shares, and sensitivity indices of Ishigami's function.

    pip install scipy SALib
    python oracles/sobol.py
"""

import numpy as np
from SALib.analyze import sobol
from scipy.stats import binomtest, qmc

points = qmc.Sobol(512, scramble=False, bits=52).random(1024)
for index in (5, 1000):
    print("point", index, [repr(float(points[index, d])) for d in (0, 1, 2, 100, 511)])

for good, of in ((9, 10), (950, 1000)):
    ends = binomtest(good, of).proportion_ci(method="exact")
    print(good, "of", of, repr(float(ends.low)), repr(float(ends.high)))

# The rows in SALib's order: A, A with each input from B, B.
problem = {"num_vars": 3, "names": ["x1", "x2", "x3"], "bounds": [[-np.pi, np.pi]] * 3}
rows = 4096
both = (2 * qmc.Sobol(6, scramble=True, seed=1).random(rows) - 1) * np.pi
a, b = both[:, :3], both[:, 3:]
x = np.empty((rows * 5, 3))
x[0::5], x[4::5] = a, b
for i in range(3):
    mixed = a.copy()
    mixed[:, i] = b[:, i]
    x[1 + i :: 5] = mixed
y = np.sin(x[:, 0]) + 7 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])
found = sobol.analyze(problem, y, calc_second_order=False, num_resamples=2000, seed=1)
for i in range(3):
    print(problem["names"][i], *(f"{found[k][i]:.4f}" for k in ("S1", "S1_conf", "ST", "ST_conf")))
