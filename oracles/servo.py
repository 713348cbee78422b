"""A position loop with velocity feedforward in the time domain: ramp and circle.

    dm/dt = Kv (q - m) + k dq/dt        k: feedforward, 0 to 1

python3 oracles/servo.py  ->  crates/trueaxis-calibrate/tests/data/servo.csv

Ramp: following error q - m after 30 time constants. Circle: change of the radius and phase of m
against q, mean of the last turn. Integrated (DOP853), not by a formula.
"""
import numpy as np
import scipy
from scipy.integrate import solve_ivp

OUT = "crates/trueaxis-calibrate/tests/data/servo.csv"


def run(speed_of, place_of, start, kv, k, times):
    def slope(t, y):
        q, v = place_of(t), speed_of(t)
        return kv * (q - y) + k * v

    found = solve_ivp(slope, (0.0, times[-1]), start, "DOP853", times, rtol=1e-12, atol=1e-13)
    return found.y


def main():
    with open(OUT, "w", encoding="utf-8") as f:
        f.write(f"# scipy {scipy.__version__}, numpy {np.__version__}: solve_ivp DOP853; python3 oracles/servo.py\n")
        f.write("kv_per_s,feedforward,feed_mm_per_min,radius_mm,following_um,radius_change_um,phase_urad\n")
        for kv, k, feed, radius in [
            (25.0, 0.0, 30.0, 50.0), (25.0, 0.0, 150.0, 50.0), (25.0, 0.0, 1200.0, 50.0),
            (50.0, 0.0, 1200.0, 20.0), (25.0, 0.5, 150.0, 50.0), (25.0, 0.9, 1200.0, 50.0),
        ]:
            v = feed / 60.0
            end = np.array([30.0 / kv])
            m = run(lambda t: np.array([v]), lambda t: np.array([v * t]), np.zeros(1), kv, k, end)
            following = v * end[-1] - m[0, -1]
            w = v / radius
            place = lambda t: radius * np.array([np.cos(w * t), np.sin(w * t)])
            speed = lambda t: v * np.array([-np.sin(w * t), np.cos(w * t)])
            # A part of a turn is enough: after the transient the answer turns with the command.
            times = 30.0 / kv + np.linspace(0.0, 0.5, 50)
            y = run(speed, place, place(0.0), kv, k, times)
            q = radius * np.exp(1j * w * times)
            ratio = (y[0] + 1j * y[1]) / q
            change, phase = radius * (np.abs(ratio).mean() - 1), np.angle(ratio).mean()
            f.write(f"{kv},{k},{feed},{radius},{following * 1e3:.9f},{change * 1e3:.9f},{phase * 1e6:.6f}\n")


main()
