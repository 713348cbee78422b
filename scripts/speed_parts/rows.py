"""What is measured, and what it may cost on two cores with 10^6 lines."""

from dataclasses import dataclass
from typing import Callable

XKAS, I5 = "machines/xkas2525/machine.toml", "machines/i5-engraver/machine.toml"


@dataclass
class Row:
    name: str
    limit_s: float
    limit_mb: float
    # Of the root, the programs and a folder for what is written.
    command: Callable


def compensate(machine, program):
    return lambda root, files, out: (
        ["compensate", "program", root / machine, files[program], "-o", out / "compensated.nc"]
    )


def simulate(machine, program, *options):
    return lambda root, files, out: ["simulate", root / machine, files[program], *options]


def post(machine, program, control):
    return lambda root, files, out: (
        ["post", root / machine, files[program], "--control", control, "-o", out / "posted.nc"]
    )


def pose(*options):
    return lambda root, files, out: ["pose", root / XKAS, "--at-file", files["positions.csv"], *options]


def frustum(root, files, out):
    study = root / "examples/03_predict/nas979-on-xkas2525.toml"
    return ["predict", study, "--samples", "100000"]


ROWS = [
    Row("compensate program, XKAS2525, vectors", 3.0, 150, compensate(XKAS, "dome.mpf")),
    Row("compensate program, i5, FANUC", 3.0, 150, compensate(I5, "ring-fanuc.nc")),
    Row("compensate program, i5, HEIDENHAIN", 3.0, 150, compensate(I5, "ring-heidenhain.h")),
    Row("simulate without collisions, i5", 0.7, 150, simulate(I5, "ring-fanuc.nc", "--no-collisions")),
    Row("simulate with collisions, i5", 0.9, 150, simulate(I5, "ring-fanuc.nc")),
    Row("post, i5", 1.0, 150, post(I5, "ring.cls", "fanuc")),
    Row("post, XKAS2525", 1.0, 150, post(XKAS, "dome.cls", "sinumerik")),
    Row("pose of a table, text", 1.0, 150, pose()),
    Row("pose of a table, JSON", 1.0, 150, pose("--format", "json")),
    Row("predict, frustum on 10^5 machines", 2.0, 150, frustum),
]
