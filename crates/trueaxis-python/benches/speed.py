"""Deviations of 10^6 poses from Python, to be compared with `cargo bench -p trueaxis-machine --bench batch`.

    python crates/trueaxis-python/benches/speed.py

The machine and the poses are those of that bench (trueaxis-machine/benches/common): a head-head machine with 50 knots in each of
30 error motions. Two times, as there: by the clock, and core time of all threads, which suffers less from neighbours.
"""

import math
import statistics
import time

import numpy as np
import trueaxis

POSES, KNOTS, ROUNDS = 1_000_000, 50, 15


def table(letter):
    unit, low, high = ("mm", -500.0, 500.0) if letter in "XYZ" else ("deg", -180.0, 180.0)
    heads = [f"{head}{letter}_{unit}" for head, unit in zip("EX EY EZ EA EB EC".split(), ["um"] * 3 + ["urad"] * 3)]
    lines = [",".join([f"position_{unit}", *heads])]
    for i in range(KNOTS):
        t = i / (KNOTS - 1)
        row = [12 * math.sin(7 * t + ord(letter) + 1.3 * k) + 3 * math.cos(31 * t) for k in range(6)]
        lines.append(",".join([repr(low + (high - low) * t), *(f"{value:.4f}" for value in row)]))
    return "\n".join(lines) + "\n"


def machine():
    text = '[machine]\nname = "bench"\nchain = "w b X Y Z C A t"\nsource = "invented"\n'
    text += '[tool]\nplacement = "0 0 -200 mm"\nlength = "100 mm"\n[location]\n'
    for i, axis in enumerate("XYZCA"):
        text += "".join(f'E{d}0{axis} = "{3 + 2 * i + k} um"\n' for k, d in enumerate("XYZ"))
        text += "".join(f'E{d}0{axis} = "{11 - 3 * i + k} urad"\n' for k, d in enumerate("ABC"))
    text += "".join(f'[motion.{axis}]\ntable = "{axis}.csv"\n' for axis in "XYZCA")
    return trueaxis.Machine.from_text(text, files={f"{axis}.csv": table(axis) for axis in "XYZCA"})


def measured(work):
    clock, core = [], []
    for _ in range(ROUNDS):
        begun, used = time.perf_counter(), time.process_time()
        work()
        clock.append(time.perf_counter() - begun)
        core.append(time.process_time() - used)
    return statistics.median(clock), statistics.median(core)


def main():
    asked = machine()
    random = np.random.default_rng(1)
    at = random.uniform([-490, -490, -490, -175, -175], [490, 490, 490, 175, 175], (POSES, 5))
    columns = np.asfortranarray(at)
    room = asked.deviation(at)
    rows = [
        ("one thread", lambda: asked.deviation(at, threads=1)),
        ("one thread, out=", lambda: asked.deviation(at, threads=1, out=room)),
        ("one thread, out=, order F", lambda: asked.deviation(columns, threads=1, out=room)),
        ("two threads", lambda: asked.deviation(at, threads=2)),
        ("two threads, out=", lambda: asked.deviation(at, threads=2, out=room)),
    ]
    print(f"{'10^6 poses, trueaxis ' + trueaxis.__version__:<32}{'clock ms':>10}{'core ms':>10}")
    for name, work in rows:
        clock, core = measured(work)
        print(f"{name:<32}{clock * 1e3:>10.1f}{core * 1e3:>10.1f}")


if __name__ == "__main__":
    main()
