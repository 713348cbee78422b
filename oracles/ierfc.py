"""ierfc and i2erfc by mpmath with 60 digits, from the recurrence and checked by quadrature.

python3 oracles/ierfc.py  ->  crates/trueaxis-machine/tests/data/ierfc.csv
"""
import mpmath as mp

mp.mp.dps = 60
OUT = "crates/trueaxis-machine/tests/data/ierfc.csv"


def ierfc(x):
    return mp.exp(-x * x) / mp.sqrt(mp.pi) - x * mp.erfc(x)


def i2erfc(x):
    return (mp.erfc(x) - 2 * x * ierfc(x)) / 4


def main():
    points = [mp.mpf(i) / 32 for i in range(-160, 161)]
    points += [mp.mpf(i) / 8 for i in range(41, 209)]
    points += [mp.mpf(1) - mp.mpf(2) ** -30, mp.mpf(1) + mp.mpf(2) ** -30, mp.mpf(2) ** -40]
    for x in (mp.mpf(0), mp.mpf(1), mp.mpf(3)):
        quad = mp.quad(mp.erfc, [x, x + 1, x + 5, mp.inf])
        assert abs(quad - ierfc(x)) < mp.mpf(10) ** -25, x
    with open(OUT, "w", encoding="utf-8") as f:
        f.write(f"# mpmath {mp.__version__}, {mp.mp.dps} digits; python3 oracles/ierfc.py\n")
        f.write("x,ierfc,i2erfc\n")
        for x in sorted(points):
            f.write(f"{float(x)!r},{mp.nstr(ierfc(x), 20)},{mp.nstr(i2erfc(x), 20)}\n")


main()
