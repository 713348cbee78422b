#!/usr/bin/env python3
"""Quantiles of the normal, χ², t and F distributions to 20 digits.

    python3 oracles/quantiles.py > crates/trueaxis-geometry/tests/data/quantiles.csv

mpmath 1.3.0: roots of its regularised incomplete gamma and beta functions (arbitrary precision), where
our quantiles are roots of the functions of statrs in double precision. SciPy 1.17.1 gives only the
value to start from. Where mpmath's hypergeometric series is too slow (both parameters large), the
incomplete beta function is integrated numerically by mpmath.
"""
import mpmath as m
from scipy import stats

m.mp.dps = 30
TAILS = ["0.9", "0.5", "0.3", "0.05", "0.025", "0.0227501319481792", "0.001", "1e-6", "1e-9"]
FREEDOMS = ["1", "1.5", "2", "2.5", "3", "5", "10", "30.7", "100", "1000", "9999", "10001", "100000", "1000000"]
PAIRS = [("1", "3"), ("2", "5"), ("3.5", "7.25"), ("4", "4"), ("12", "60"), ("60", "12"), ("5", "1000"),
         ("5", "1000000"), ("300", "20000"), ("20000", "20000")]


def gamma_above(x, n):
    return m.gammainc(n / 2, x / 2, m.inf, regularized=True)


def beta_part(a, b, z):
    if min(a, b) > 1000:
        top = (a - 1) / (a + b - 2)
        width = m.sqrt(a * b / (a + b) ** 3)
        log_top = (a - 1) * m.log(top) + (b - 1) * m.log(1 - top)
        density = lambda u: m.exp((a - 1) * m.log(u) + (b - 1) * m.log(1 - u) - log_top)
        edges = lambda lo, hi: [lo + (hi - lo) * k / 40 for k in range(41)]
        lo, hi = max(m.mpf(0), top - 25 * width), min(m.mpf(1), top + 25 * width)
        return m.quad(density, edges(lo, z)) / m.quad(density, edges(lo, hi))
    return m.betainc(a, b, 0, z, regularized=True)


def fisher_above(x, n, d):
    return beta_part(d / 2, n / 2, d / (d + n * x))


def solve(above, tail, start):
    # Secant on the logarithm of the smaller side, over the logarithm of x.
    value = (lambda y: m.log(above(m.exp(y)) / tail)) if tail <= 0.5 else \
        (lambda y: m.log((1 - above(m.exp(y))) / (1 - tail)))
    y = m.log(m.mpf(start))
    return m.exp(m.findroot(value, (y, y + m.mpf("1e-6")), tol=1e-40, maxsteps=60, verify=False))


def show(kind, tail, first, second, value):
    print(f"{kind},{tail},{first},{second},{m.nstr(value, 20)}")


print("# mpmath 1.3.0, 30 digits: oracles/quantiles.py")
print("kind,tail,degrees_of_freedom,degrees_below,value")
for tail in TAILS:
    p = m.mpf(tail)
    show("normal", tail, "", "", m.sqrt(2) * m.erfinv(1 - 2 * p))
    for freedom in FREEDOMS:
        n = m.mpf(freedom)
        show("chi_square", tail, freedom, "",
             solve(lambda x: gamma_above(x, n), p, stats.chi2.isf(float(tail), float(n))))
        if p < 0.5:
            t2 = solve(lambda x: m.betainc(n / 2, m.mpf("0.5"), 0, n / (n + x), regularized=True),
                       2 * p, stats.t.isf(float(tail), float(n)) ** 2)
            show("student", tail, freedom, "", m.sqrt(t2))
    for above, below in PAIRS:
        n, d = m.mpf(above), m.mpf(below)
        show("fisher", tail, above, below,
             solve(lambda x: fisher_above(x, n, d), p, stats.f.isf(float(tail), float(n), float(d))))
