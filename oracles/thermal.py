"""Logs of a lathe made for this project, and thermal models of them by other software.

Tools: Python 3.11.7, numpy 2.4.6, scipy 1.17.1, scikit-learn 1.9.1, statsmodels 0.15.0
(pip install numpy scikit-learn statsmodels). Written from docs/model.md (89) to (95), never from the
Rust code: zeros are dummy variables (not centred columns), lags come from scipy.signal.lsim, splits
from LeaveOneGroupOut, single rows from statsmodels' PRESS residuals, the covariance from the closed
form of CV3 with the hat matrix (not from refits), and statsmodels' sandwich (CR1) beside it.

Run in the repository root: python3 oracles/thermal.py [DATA] (30 s); DATA (default ../shared/data) holds
the open lathe runs, of which only the figures are written.
Writes examples/05_identify/lathe-thermal/cycle-*.csv and lathe-new-day.csv (no real machine; seeds 20261121 and
20261122), crates/trueaxis/tests/data/thermal.json and crates/trueaxis-thermal/tests/data/later.json: the new
day scored with the model of the cycles by (271) and (272), with dummy variables and dense matrices.
"""

import glob
import itertools
import json
import sys

import numpy as np
import statsmodels.api as sm
from scipy.signal import lsim
from sklearn.linear_model import LinearRegression
from sklearn.model_selection import LeaveOneGroupOut

SEED = 20261121
EXAMPLE = "examples/05_identify/lathe-thermal/"
NEW_DAY = "examples/05_identify/lathe-new-day.csv"
LATER = "crates/trueaxis-thermal/tests/data/later.json"
EXPECTED = "crates/trueaxis/tests/data/thermal.json"
SENSORS = ["spindle_front", "spindle_rear", "headstock", "bed", "coolant", "ambient"]
TRUE_UM_PER_K = {"spindle_front": 2.1, "bed": -3.4}
LAG_S = 900.0
STEP_S, ROWS, CYCLES = 120.0, 91, 8
COLLINEAR = 30.0


def heat(power, ambient, start, dt):
    """Spindle front and rear, headstock, bed, coolant as lumped bodies; power per step in 0 … 1."""
    front, rear, head, bed, coolant = start
    rows = []
    for p, air in zip(power, ambient):
        rows.append((front, rear, head, bed, coolant, air))
        front += dt * (0.0125 * p - (front - head) / 900 - (front - air) / 3600)
        rear += dt * (0.0085 * p - (rear - head) / 1300 - (rear - air) / 3000)
        head += dt * ((front - head) / 5200 + (rear - head) / 6500 - (head - air) / 9000)
        coolant += dt * (0.0016 * p - (coolant - air) / 2600)
        bed += dt * ((head - bed) / 12000 + (coolant - bed) / 5200 - (bed - air) / 20000)
    return np.array(rows)


def make_cycles():
    rng = np.random.default_rng(SEED)
    cycles = []
    for c in range(CYCLES):
        dt = 10.0
        count = int((ROWS - 1) * STEP_S / dt) + 1
        t = np.arange(count) * dt
        power = np.zeros(count)
        begin = 0.0
        while begin < t[-1]:
            length = rng.uniform(1200, 4200)
            power[(t >= begin) & (t < begin + length)] = rng.choice([0.0, 0.3, 0.6, 1.0])
            begin += length
        power[t < 2400] = max(power[0], 0.5)
        air0 = rng.uniform(18, 24)
        ambient = air0 + rng.uniform(-1, 2.5) * np.sin(np.pi * t / t[-1] * rng.uniform(0.4, 1.3))
        start = air0 + rng.uniform([0, 0, -0.5, -1.0, -0.5], [1, 1, 0.5, 0.5, 0.5])
        rows = heat(power, ambient, start, dt)[:: int(STEP_S / dt)]
        drift = sum(k * rows[:, SENSORS.index(s)] for s, k in TRUE_UM_PER_K.items())
        slow = np.zeros(len(rows))
        for i in range(1, len(rows)):
            slow[i] = 0.9 * slow[i - 1] + 0.2 * rng.normal()
        zero = rng.uniform(-30, 30)
        d = drift - drift[0] + zero + slow + 0.4 * rng.normal(size=len(rows))
        said = np.round(rows + 0.03 * rng.normal(size=rows.shape), 2)
        cycles.append((np.arange(len(rows)) * STEP_S, np.round(d, 2), said))
    return cycles


def new_day():
    """The same machine when coolant goes through the tool holder for the first time: a heater of its own
    warms the coolant, and 1.4 um/K of it act on the holder, which no usual day shows."""
    rng = np.random.default_rng(SEED + 1)
    dt = 10.0
    t = np.arange(int((ROWS - 1) * STEP_S / dt) + 1) * dt
    power = np.where(t < 3600, 0.6, np.where(t < 7200, 0.0, 0.3))
    air = 21.0 + 0.8 * np.sin(np.pi * t / t[-1])
    front, rear, head, bed, coolant = 21.2, 21.1, 21.0, 20.8, 20.9
    rows = []
    for p, a, seconds in zip(power, air, t):
        rows.append((front, rear, head, bed, coolant, a))
        (front, rear, head, bed, _, _) = heat([p, p], [a, a], (front, rear, head, bed, coolant), dt)[1]
        coolant += dt * (0.0016 * p + (0.0040 if seconds >= 2400 else 0.0) - (coolant - a) / 2600)
    rows = np.array(rows)[:: int(STEP_S / dt)]
    drift = sum(k * rows[:, SENSORS.index(s)] for s, k in TRUE_UM_PER_K.items())
    through = 1.4 * (rows[:, SENSORS.index("coolant")] - rows[:, SENSORS.index("ambient")])
    slow = np.zeros(len(rows))
    for i in range(1, len(rows)):
        slow[i] = 0.9 * slow[i - 1] + 0.2 * rng.normal()
    d = drift - drift[0] + through - through[0] + slow + 0.4 * rng.normal(size=len(rows)) + 11.0
    said = np.round(rows + 0.03 * rng.normal(size=rows.shape), 2)
    return np.arange(len(rows)) * STEP_S, np.round(d, 2), said


def score(cycles, later, lags, case):
    """(271) and (272) of a later log, zero "cycle"; case: the model of the cycles."""
    from scipy import stats

    terms = case["scores"][case["chosen"]]["columns"]
    extra = [j for j in terms if j >= len(SENSORS)]
    used = list(range(len(SENSORS))) + extra
    x, y, group = columns(cycles, lags)
    xl, yl, _ = columns([later], lags)
    names, big = np.unique(group), len(cycles)

    def centred(values, of):
        out = values.astype(float).copy()
        for g in np.unique(of):
            out[of == g] -= out[of == g].mean(0)
        return out

    xc, yc = centred(x, group), centred(y, group)
    tau2 = []
    for j in used:
        second = [np.diff(c[2][:, j % len(SENSORS)], 2) for c in cycles]
        tau2.append(max(np.mean([np.mean(s**2) / 6 for s in second]), 0.05**2))
    inverse = lambda rows: np.linalg.inv(xc[rows][:, used].T @ xc[rows][:, used] / rows.sum() + np.diag(tau2))
    distance = lambda v, b: np.einsum("ij,jk,ik->i", v, b, v)
    k, _ = slopes(x[:, terms], y, group, "cycle")
    v = np.array(case["correlation"]) * np.outer(case["u_um_per_k"], case["u_um_per_k"])
    rests, total, left_out = [], [], []
    levels = np.array([c[2].mean() for c in cycles])
    scatter = lambda l: max(l.std(ddof=1), 0.5)
    for i, g in enumerate(names):
        own = group == g
        d = distance(xc[own][:, used], inverse(~own)).mean()
        left_out.append(d)
        # The cycle by the others, with the terms that they choose.
        chosen = list(best_subsets(x[~own], y[~own], group[~own], "cycle", 3)[case["chosen"]])
        s = held_out(x, y, np.where(~own)[0], np.where(own)[0], group, "cycle", chosen)
        slope = distance(xc[own][:, terms], big * v).mean()
        rest = np.delete(levels, i)
        d = d + ((levels[i] - rest.mean()) / scatter(rest)) ** 2
        rests.append((s - slope) / (1 + d / (big - 1)))
        total.append(s / (1 + d / (big - 1)))
    rest = max(np.mean(rests), 0.25 * np.mean(total))
    t = stats.t.ppf(0.5 + 0.5 * (2 * stats.norm.cdf(2) - 1), big - 1)
    b = inverse(np.full(len(group), True))
    mine = xl - xl.mean(0)
    d2 = distance(mine[:, used], b)
    level = ((later[2].mean() - levels.mean()) / scatter(levels)) ** 2
    u = t * np.sqrt(distance(mine[:, terms], big * v) + rest * (1 + (d2 + level) / big))
    left = yl - yl.mean() - mine[:, terms] @ k
    gram = np.linalg.inv(b) - np.diag(tau2)
    effective = np.trace(gram @ b)
    logs = np.log(left_out)
    spread = np.sqrt(logs.var(ddof=1) * (1 + 1 / big))
    return {
        "left_um": float(np.sqrt(np.mean(left**2))),
        "promised_u_um": float(t * case["scores"][case["chosen"]]["held_out_um"]),
        "u_um": float(np.sqrt(np.mean(u**2))),
        "mean_distance": float(d2.mean()),
        "row_limit": float(max(1, np.sort(left_out)[big // 2] / effective) * stats.chi2.isf(0.01, effective)),
        "log_limit": float(np.exp(logs.mean() + stats.t.isf(0.01, big - 1) * spread)),
        "distances": d2.tolist(),
        "row_u_um": u.tolist(),
    }


def write_example(cycles, later):
    files = [(f"{EXAMPLE}cycle-{i + 1}.csv", c) for i, c in enumerate(cycles)]
    for name, (t, d, said) in files + [(NEW_DAY, later)]:
        with open(name, "w") as out:
            out.write("# made for this project by oracles/thermal.py; no real lathe\n")
            out.write("time_min,drift_um," + ",".join(f"{s}_degC" for s in SENSORS) + "\n")
            for k in range(len(t)):
                temps = ",".join(f"{v:.2f}" for v in said[k])
                out.write(f"{t[k] / 60:g},{d[k]:.2f},{temps}\n")


def columns(cycles, lags):
    """All terms, rows of all cycles below each other; the cycle of each row."""
    blocks = []
    for t, _, said in cycles:
        parts = [said]
        for lag in lags:
            # L' = (T − L)/lag, straight between the rows; started in equilibrium.
            system = ([[-1.0 / lag]], [[1.0 / lag]], [[1.0]], [[0.0]])
            slow = [lsim(system, said[:, j], t, X0=[said[0, j]], interp=True)[1] for j in range(said.shape[1])]
            parts.append(np.array(slow).T)
        blocks.append(np.hstack(parts))
    y = np.concatenate([d for _, d, _ in cycles])
    group = np.concatenate([np.full(len(d), i) for i, (_, d, _) in enumerate(cycles)])
    return np.vstack(blocks), y, group


def zeros(group, zero):
    """The columns of what is free."""
    return {"cycle": np.equal.outer(group, np.unique(group)).astype(float), "common": np.ones((len(group), 1))}[zero]


def condition(x, z):
    left = x - z @ np.linalg.lstsq(z, x, rcond=None)[0]
    return np.linalg.cond(left / np.linalg.norm(left, axis=0)) if x.shape[1] else 1.0


def best_subsets(x, y, group, zero, most):
    z = zeros(group, zero)
    z = z[:, z.any(0)]
    found = [()]
    for size in range(1, most + 1):
        tried = []
        for s in itertools.combinations(range(x.shape[1]), size):
            xs = np.hstack([x[:, s], z])
            rss = np.sum((y - xs @ np.linalg.lstsq(xs, y, rcond=None)[0]) ** 2)
            tried.append((rss, s))
        tried.sort()
        found.append(next(s for _, s in tried if condition(x[:, s], z) <= COLLINEAR))
    return found


def slopes(x, y, group, zero):
    """Coefficients (and the common intercept) by scikit-learn."""
    if zero == "cycle":
        dummies = zeros(group, zero)
        both = LinearRegression(fit_intercept=False).fit(np.hstack([x, dummies[:, dummies.any(0)]]), y)
        return both.coef_[: x.shape[1]], 0.0
    if x.shape[1] == 0:
        return np.zeros(0), y.mean()
    fit = LinearRegression().fit(x, y)
    return fit.coef_, fit.intercept_


def held_out(x, y, train, test, group, zero, subset):
    k, c = slopes(x[train][:, subset], y[train], group[train], zero)
    left = y[test] - x[test][:, subset] @ k - c
    if zero == "cycle":
        left = left - left.mean()
    return np.mean(left**2)


def evaluate(cycles, lags, zero, most):
    x, y, group = columns(cycles, lags)
    names = np.unique(group)
    everything = best_subsets(x, y, group, zero, most)
    splits = list(LeaveOneGroupOut().split(x, y, group))
    scores = []
    without = [best_subsets(x[a], y[a], group[a], zero, most) for a, _ in splits]
    for size, subset in enumerate(everything):
        out = [held_out(x, y, a, b, group, zero, list(w[size])) for (a, b), w in zip(splits, without)]
        ols = sm.OLS(y, np.hstack([x[:, subset], zeros(group, zero)])).fit()
        press = ols.get_influence().resid_press
        mean = lambda r: np.mean([np.mean(r[group == g] ** 2) for g in names])
        scores.append(
            {
                "columns": list(map(int, subset)),
                "in_sample_um": float(np.sqrt(mean(ols.resid))),
                "row_wise_um": float(np.sqrt(mean(press))),
                "held_out_um": float(np.sqrt(np.mean(out))),
                "u_held_out_um2": float(np.std(out, ddof=1) / np.sqrt(len(out))),
                "chosen_again": sum(w[size] == subset for w in without),
                "condition": float(condition(x[:, subset], zeros(group, zero))),
            }
        )
    squares = [s["held_out_um"] ** 2 for s in scores]
    best = int(np.argmin(squares))
    limit = squares[best] + scores[best]["u_held_out_um2"]
    chosen = next(i for i, s in enumerate(squares) if s <= limit)
    return {"scores": scores, "chosen": chosen} | covariance(x[:, everything[chosen]], y, group, zero)


def covariance(x, y, group, zero):
    """CV3 in closed form: (G−1)/G (X'X)⁻¹ Σ X_g' ü_g ü_g' X_g (X'X)⁻¹, ü_g = (I − H_gg)⁺ u_g."""
    z = zeros(group, zero)
    left = x - z @ np.linalg.lstsq(z, x, rcond=None)[0]
    both = np.hstack([x, z])
    ols = sm.OLS(y, both).fit()
    inverse = np.linalg.inv(left.T @ left)
    hat = both @ np.linalg.pinv(both)
    names = np.unique(group)
    meat = np.zeros((x.shape[1], x.shape[1]))
    for g in names:
        rows = group == g
        own = np.linalg.pinv(np.eye(rows.sum()) - hat[np.ix_(rows, rows)], rcond=1e-9)
        score = left[rows].T @ (own @ ols.resid[rows])
        meat += np.outer(score, score)
    v = (len(names) - 1) / len(names) * inverse @ meat @ inverse
    sandwich = sm.OLS(y, both).fit(cov_type="cluster", cov_kwds={"groups": group})
    return {
        "um_per_k": [float(k) for k in ols.params[: x.shape[1]]],
        "u_um_per_k": [float(u) for u in np.sqrt(np.diag(v))],
        "correlation": (v / np.sqrt(np.outer(np.diag(v), np.diag(v)))).tolist(),
        "sandwich_um_per_k": [float(u) for u in sandwich.bse[: x.shape[1]]],
    }


def outside():
    """Rows of the 12 open runs: no time, six temperatures, displacement last."""
    data = sys.argv[1] if len(sys.argv) > 1 else "../shared/data"
    files = sorted(glob.glob(f"{data}/outside/measure/srivathsan902__Thermal_Compensation_Webpage/ACE_*.csv"))
    runs = [np.loadtxt(f, delimiter=",", skiprows=1) for f in files]
    return [(np.arange(len(r)), r[:, -1], r[:, :-1]) for r in runs]


def main():
    cycles = make_cycles()
    later = new_day()
    write_example(cycles, later)
    cases = {
        "cycle": evaluate(cycles, [LAG_S], "cycle", 3),
        "common": evaluate(cycles, [], "common", 3),
        "four": evaluate(cycles[:4], [LAG_S], "cycle", 2),
    }
    if runs := outside():
        cases["outside"] = evaluate(runs, [], "cycle", 4)
    with open(LATER, "w") as out:
        json.dump(score(cycles, later, [LAG_S], cases["cycle"]), out, indent=1)
        out.write("\n")
    for name, case in cases.items():
        print(name, case["chosen"], case["um_per_k"], case["u_um_per_k"], case["sandwich_um_per_k"])
        for s in case["scores"]:
            print("   ", s)
    with open(EXPECTED, "w") as out:
        json.dump({"true_um_per_k": TRUE_UM_PER_K, "lag_s": LAG_S, "cases": cases}, out, indent=1)
        out.write("\n")


main()
