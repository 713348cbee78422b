"""Describe, simulate, predict: the questions about a machine that is known."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Mapping, Optional, Union

from ._answers import Answer
from ._ask import Number, Positions, Vector, ask
from ._machine import Machine, Path

if TYPE_CHECKING:
    from . import documents


def pose(
    machine: Union[Machine, Path],
    *,
    at: Optional[Positions] = None,
    at_file: Optional[Path] = None,
    approach: Optional[Union[str, Mapping[str, str]]] = None,
    bodies: bool = False,
    tool_length: Optional[Number] = None,
    tool: Optional[str] = None,
    temperature: Optional[Positions] = None,
    temperature_log: Optional[Path] = None,
    log_time: Optional[Number] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[Any]:
    """Where the tool is, nominal and actual, and what each error contributes: ``trueaxis pose``.

    at: programmed axis positions, mm and degrees; axes not named are 0. at_file: many of them, a CSV file.
    approach: the direction of approach of each axis, where backlash is stated.
    bodies: also the place of every body in the machine frame.
    tool_length: length of the tool from the holder to the tip, mm, instead of the tool of the machine file.
    tool: a tool assembly of the machine file, by its name.
    temperature, temperature_log, log_time: readings of the sensors, °C; a log of them; the time in the log, s.

    For arrays of positions take :meth:`Machine.pose`.

    >>> answer = trueaxis.pose("machines/xkas2525/machine.toml", at={"X": 3000, "Y": 1200, "Z": -700, "C": -90, "A": 15})
    >>> [round(um, 3) for um in answer.deviation.tip_um]
    [35.134, -20.773, 11.643]
    """
    return ask("pose", locals())


def solve(
    machine: Union[Machine, Path],
    *,
    tip: Optional[Vector] = None,
    axis: Optional[Vector] = None,
    from_: Optional[Positions] = None,
    path: Optional[Path] = None,
    tool_length: Optional[Number] = None,
    tool: Optional[str] = None,
    temperature: Optional[Positions] = None,
    temperature_log: Optional[Path] = None,
    log_time: Optional[Number] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[Any]:
    """Axis positions for a required position and direction of the tool, all solutions: ``trueaxis solve``.

    tip: the tip in the workpiece frame, mm. axis: the tool axis from the tip to the spindle, of any length.
    from_: the present axis positions (``--from``), mm and degrees. path: a table of poses instead; one best branch.
    tool_length: length of the tool from the holder to the tip, mm, instead of the tool of the machine file.
    tool: a tool assembly of the machine file, by its name.
    temperature, temperature_log, log_time: readings of the sensors, °C; a log of them; the time in the log, s.

    For arrays take :meth:`Machine.solve`.

    >>> answer = trueaxis.solve("machines/i5-engraver/machine.toml", tip=[10, 20, 30], axis=[0, 0, 1])
    >>> answer.schema
    'trueaxis/solve/1'
    """
    return ask("solve", locals())


def part(
    file: Path,
    *,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.PartDocument]:
    """What a part file asks for, or a draft of one from a QIF file: ``trueaxis part``.

    output: write the draft of a QIF file here.

    >>> trueaxis.part("parts/housing.toml").schema
    'trueaxis/part/1'
    """
    return ask("part", locals())


def simulate(
    machine: Union[Machine, Path],
    program: Path,
    *,
    setup: Optional[Path] = None,
    control: Optional[str] = None,
    chord: Optional[Number] = None,
    spacing: Optional[Number] = None,
    angle: Optional[Number] = None,
    by_count: bool = False,
    no_densify: bool = False,
    rounding: Optional[Number] = None,
    three_phase: Optional[Number] = None,
    smooth: bool = False,
    most_jumps: Optional[int] = None,
    without_optional: bool = False,
    log_start: Optional[Number] = None,
    path: Optional[Path] = None,
    bodies: Optional[Path] = None,
    no_collisions: bool = False,
    stock: bool = False,
    keep_going: bool = False,
    pictures: bool = True,
    tool_length: Optional[Number] = None,
    tool: Optional[str] = None,
    temperature: Optional[Positions] = None,
    temperature_log: Optional[Path] = None,
    log_time: Optional[Number] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.SimulateDocument]:
    """An NC program on the actual machine: time, travel, deviations of the tool, issues: ``trueaxis simulate``.

    program: the NC program.
    setup: work offsets, tools, stock, fixtures; without it PROGRAM.setup.toml if it is there.
    control: sinumerik, fanuc, haas, linuxcnc or heidenhain.
    chord: largest distance between path and chord, mm (0.005). spacing: longest piece of a move, mm (10).
    angle: largest rotation in a piece, deg (1). by_count: divide by spacing and angle alone. no_densify: do not divide.
    rounding: corner rounding tolerance where the program states none, mm (0.01).
    three_phase: time each block by three phases with this mean acceleration, mm/s²; smooth: its velocity is smooth.
    most_jumps: backward jumps after which the program counts as an endless loop (1000000).
    without_optional: leave out optional blocks (/), as with the switch of the control on.
    log_start: the program begins at this time of the temperature log, s, and the temperatures follow it.
    path: write every point of the path to this file (CSV; Parquet by its ending). bodies: the pose of every body.
    no_collisions: without the collision check. stock: cut the stock of the set-up.
    keep_going: list errors of the program and continue after them.
    pictures: record the curves of the report; without them ``page`` has no figures over the path.
    tool_length: length of the tool from the holder to the tip, mm, instead of the tool of the machine file.
    tool: a tool assembly of the machine file, by its name.
    temperature, temperature_log, log_time: readings of the sensors, °C; a log of them; the time in the log, s.

    >>> program = "examples/02_simulate/ring-fanuc.nc"
    >>> trueaxis.simulate("machines/i5-engraver/machine.toml", program).schema
    'trueaxis/simulate/1'
    """
    return ask("simulate", locals())


def trace(
    machine: Union[Machine, Path],
    program: Path,
    *,
    block: int,
    setup: Optional[Path] = None,
    control: Optional[str] = None,
    chord: Optional[Number] = None,
    spacing: Optional[Number] = None,
    angle: Optional[Number] = None,
    by_count: bool = False,
    no_densify: bool = False,
    rounding: Optional[Number] = None,
    three_phase: Optional[Number] = None,
    smooth: bool = False,
    most_jumps: Optional[int] = None,
    without_optional: bool = False,
    log_start: Optional[Number] = None,
    tool_length: Optional[Number] = None,
    tool: Optional[str] = None,
    temperature: Optional[Positions] = None,
    temperature_log: Optional[Path] = None,
    log_time: Optional[Number] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.TraceDocument]:
    """One block of a program through every stage of the simulation: ``trueaxis trace``.

    block: its number N; if there is none, its line.
    setup: work offsets, tools, stock, fixtures; without it PROGRAM.setup.toml if it is there.
    control: sinumerik, fanuc, haas, linuxcnc or heidenhain.
    chord: largest distance between path and chord, mm (0.005). spacing: longest piece of a move, mm (10).
    angle: largest rotation in a piece, deg (1). by_count: divide by spacing and angle alone. no_densify: do not divide.
    rounding: corner rounding tolerance where the program states none, mm (0.01).
    three_phase: time each block by three phases with this mean acceleration, mm/s²; smooth: its velocity is smooth.
    most_jumps: backward jumps after which the program counts as an endless loop (1000000).
    without_optional: leave out optional blocks (/), as with the switch of the control on.
    log_start: the program begins at this time of the temperature log, s, and the temperatures follow it.
    tool_length: length of the tool from the holder to the tip, mm, instead of the tool of the machine file.
    tool: a tool assembly of the machine file, by its name.
    temperature, temperature_log, log_time: readings of the sensors, °C; a log of them; the time in the log, s.

    >>> program = "examples/02_simulate/ring-fanuc.nc"
    >>> trueaxis.trace("machines/i5-engraver/machine.toml", program, block=20).schema
    'trueaxis/trace/1'
    """
    return ask("trace", locals())


def predict(
    study: Path,
    *,
    samples: Optional[int] = None,
    seed: Optional[int] = None,
    results: Optional[Path] = None,
    compensated: bool = False,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[Any]:
    """Will the test piece or part be within tolerance, and what does each error contribute: ``trueaxis predict``.

    samples: Monte Carlo samples instead of those of the study (0: none). seed: its random seed.
    results: of a part, write its characteristics here (.csv or .qif).
    compensated: of a part, judge it by its compensated program, too.

    >>> answer = trueaxis.predict("examples/03_predict/nas979-on-xkas2525.toml", samples=0)
    >>> answer.is_yes
    True
    """
    return ask("predict", locals())
