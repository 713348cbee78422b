"""Durations of single moves from rest to rest with limited velocity, acceleration and jerk, by
ruckig (https://pypi.org/project/ruckig). Writes crates/trueaxis/tests/data/ruckig-moves.csv.

Run in the repository root: pip install ruckig==0.19.4; python3 oracles/ruckig_moves.py
"""

import importlib.metadata
import math
import random

from ruckig import InputParameter, Result, Ruckig, Trajectory

random.seed(2)
lines = [f"# ruckig {importlib.metadata.version('ruckig')}, python3 oracles/ruckig_moves.py",
         "length_mm,velocity_mm_s,acceleration_mm_s2,jerk_mm_s3,duration_s"]
for _ in range(300):
    length = 10 ** random.uniform(-3, 3)
    v, a, j = (10 ** random.uniform(*r) for r in [(0, 3), (1, 4), (2, 6)])
    wanted = InputParameter(1)
    wanted.current_position, wanted.target_position = [0.0], [length]
    wanted.max_velocity, wanted.max_acceleration, wanted.max_jerk = [v], [a], [j]
    found = Trajectory(1)
    assert Ruckig(1).calculate(wanted, found) in (Result.Working, Result.Finished)
    assert math.isfinite(found.duration)
    lines.append(f"{length!r},{v!r},{a!r},{j!r},{found.duration!r}")
with open("crates/trueaxis/tests/data/ruckig-moves.csv", "w") as file:
    file.write("\n".join(lines) + "\n")
