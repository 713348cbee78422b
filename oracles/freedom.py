"""Degrees of freedom of fixed effects by Satterthwaite, for crates/trueaxis-measure/src/unknowns/mixed.rs.

    python3 oracles/freedom.py          numpy 2, scipy 1; statsmodels finds the sizes again

Two crossed groups of random effects with unequal counts and slopes. All is done with the dense covariance V of the
readings, which the program never forms:

    P = V^-1 - V^-1 X (X' V^-1 X)^-1 X' V^-1,    I_ij = tr(P V_i P V_j)/2,    nu = 2 f^2/(g' I^-1 g)

f the variance of a fixed effect, g its gradient over the variance components (by differences here, analytic there).
"""

import numpy as np
from scipy.optimize import minimize

GROUPS = [[0, 0, 0, 1, 1, 2, 2, 2, 2, 3, 4, 4, 5, 5, 5], [0, 1, 2, 0, 1, 0, 1, 2, 3, 3, 0, 1, 2, 3, 3]]
X1 = [0.1 * i - 0.6 for i in range(15)]
Y = [4.9, 0.8, 4.7, 1.1, -1.3, 3.6, 1.2, 1.0, 1.4, -1.9, 7.2, 2.4, 0.9, 0.2, 3.3]


def design():
    n = len(Y)
    x = np.column_stack([np.ones(n), X1])
    zs = [np.array([[1.0 if g[i] == j else 0.0 for j in range(max(g) + 1)] for i in range(n)]) for g in GROUPS]
    return x, zs


def covariance(theta, zs, n):
    return sum(t * z @ z.T for t, z in zip(theta[:-1], zs)) + theta[-1] * np.eye(n)


def fixed(theta, x, zs):
    v = np.linalg.inv(covariance(theta, zs, len(x)))
    return np.linalg.inv(x.T @ v @ x)


def deviance(theta, x, zs, y):
    v = covariance(theta, zs, len(x))
    vi = np.linalg.inv(v)
    a = x.T @ vi @ x
    p = vi - vi @ x @ np.linalg.inv(a) @ x.T @ vi
    return np.linalg.slogdet(v)[1] + np.linalg.slogdet(a)[1] + y @ p @ y


def freedom(theta, x, zs, noise_is_free):
    n = len(x)
    vi = np.linalg.inv(covariance(theta, zs, n))
    p = vi - vi @ x @ fixed(theta, x, zs) @ x.T @ vi
    parts = [z @ z.T for z in zs] + ([np.eye(n)] if noise_is_free else [])
    m = len(parts)
    info = np.array([[np.trace(p @ a @ p @ b) / 2 for b in parts] for a in parts])
    out = []
    for k in range(x.shape[1]):
        g = np.zeros(m)
        for i in range(m):
            h = 1e-5 * theta[i]
            up, down = np.array(theta, float), np.array(theta, float)
            up[i] += h
            down[i] -= h
            g[i] = (fixed(up, x, zs)[k, k] - fixed(down, x, zs)[k, k]) / (2 * h)
        f = fixed(theta, x, zs)[k, k]
        out.append(2 * f * f / (g @ np.linalg.solve(info, g)))
    return out


x, zs = design()
y = np.array(Y)
for theta, free in [((1.5, 0.7, 1.0), False), ((1.5, 0.7, 2.25), True), ((4.0, 0.2, 1.44), True)]:
    print(theta, free, [f"{v:.6f}" for v in freedom(list(theta), x, zs, free)])
best = minimize(lambda t: deviance(np.exp(t), x, zs, y), np.log([1.5, 0.7, 1.5]), method="Nelder-Mead",
                options={"xatol": 1e-10, "fatol": 1e-12, "maxiter": 20000})
print("REML", np.exp(best.x), [f"{v:.6f}" for v in freedom(list(np.exp(best.x)), x, zs, True)])
try:
    import statsmodels.api as sm
    import pandas as pd
    data = pd.DataFrame({"y": Y, "x": X1, "a": GROUPS[0], "b": GROUPS[1], "one": 1})
    model = sm.MixedLM.from_formula("y ~ x", groups="one", re_formula="0",
                                    vc_formula={"a": "0 + C(a)", "b": "0 + C(b)"}, data=data)
    fit = model.fit(reml=True)
    print("statsmodels", fit.vcomp, fit.scale, list(fit.bse_fe))
    print("own        ", list(np.sqrt(np.diag(fixed(list(np.exp(best.x)), x, zs)))))
except ImportError:
    pass
