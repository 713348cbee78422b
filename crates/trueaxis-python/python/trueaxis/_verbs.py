"""The verbs of the command as functions: the same questions, the same options by the same names.

A path is a text or a ``pathlib.Path``. A quantity is a text with its unit (``"2 um"``) or, where the option states a
unit, a plain number in that unit. Positions and temperatures may be mappings: ``{"X": 3000, "C": -90}``. Every function
takes `report`, the file of an HTML report, and `force`, which replaces files that this program did not write.
"""

from __future__ import annotations

import os
from typing import Any, Dict, Mapping, Optional, Sequence, Tuple, Union

from . import _native, documents
from ._answers import Answer
from ._machine import Machine, Path, needs, not_both, path_of, text_of
from ._problems import refuse, warn

#: A number in the unit that the option states, or a text.
Number = Union[float, str]
#: Positions of axes: ``{"X": 10}`` or ``"X=10"``, mm and degrees.
Positions = Union[str, Mapping[str, float]]
#: Three numbers, or a text of them.
Vector = Union[str, Sequence[float]]

#: Options that may be given more than once.
_LISTS = frozenset(["diff", "files", "history", "limit", "score", "tolerance", "write_back"])


def _ask(verb: str, given: Dict[str, Any]) -> Answer[Any]:
    """Puts a question; `given` are the arguments of the function that was called, by their names."""
    report, force = given.pop("report"), given.pop("force")
    memory: Dict[str, bytes] = {}
    options: Dict[str, Any] = {name.rstrip("_"): _option(name, value) for name, value in given.items()}
    machine = given.get("machine")
    if isinstance(machine, Machine):
        memory = {os.fspath(path): content for path, content in machine._native.files.items()}
        for name, value in machine._options.items():
            if name == "machine" or options.get(name) is None:
                options[name] = value
    for one, other in _EXCLUDE:
        not_both(options, one, other)
    for one, other in _NEED:
        if one in options and other in options:
            needs(options, one, other)
    native = _native.ask(verb, options, memory, path_of(report), bool(force))
    answer: Answer[Any] = Answer(native)
    warn(answer.diagnostics, 3)
    return answer


#: Options that exclude each other, and those that have a meaning only together with another, as in the command.
_EXCLUDE = [
    ("tool", "tool_length"),
    ("temperature", "temperature_log"),
    ("log_time", "log_start"),
    ("at", "at_file"),
    ("step", "targets"),
    ("by_count", "no_densify"),
    ("programs", "corrections"),
    ("programs", "table"),
    ("programs", "correct"),
]
_NEED = [
    ("log_time", "temperature_log"),
    ("log_start", "temperature_log"),
    ("smooth", "three_phase"),
    ("step", "axis"),
    ("targets", "axis"),
    ("correct", "output"),
    ("format", "output"),
]


def _option(name: str, value: Any) -> Any:
    if value is None or isinstance(value, (bool, Machine)) or name in _COUNTS:
        return value
    if name in _LISTS:
        entries = value if isinstance(value, (list, tuple)) else [value]
        return [os.fspath(entry) if isinstance(entry, os.PathLike) else text_of(entry) for entry in entries]
    return os.fspath(value) if isinstance(value, os.PathLike) else text_of(value)


#: Options that are whole numbers.
_COUNTS = frozenset(["seed", "block", "most_jumps", "number"])



def _one_of(name: str, *given: Any) -> None:
    """Refuses a question that is not one."""
    count = sum(value is not None for value in given)
    if count != 1:
        message = f"{count} of the arguments that say what is asked are given, not one"
        raise refuse("unused-argument", name, message, "see the description of the function")


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
    return _ask("pose", locals())


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
    return _ask("solve", locals())


def part(
    file: Path,
    *,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.PartDocument]:
    """What a part file asks for, or a draft of one from a QIF file: ``trueaxis part``.

    output: write the draft of a QIF file here.

    >>> trueaxis.part("parts/housing.toml").schema
    'trueaxis/part/1'
    """
    return _ask("part", locals())


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
    return _ask("simulate", locals())


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
    log_start: Optional[Number] = None,
    tool_length: Optional[Number] = None,
    tool: Optional[str] = None,
    temperature: Optional[Positions] = None,
    temperature_log: Optional[Path] = None,
    log_time: Optional[Number] = None,
    report: Optional[Path] = None,
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
    log_start: the program begins at this time of the temperature log, s, and the temperatures follow it.
    tool_length: length of the tool from the holder to the tip, mm, instead of the tool of the machine file.
    tool: a tool assembly of the machine file, by its name.
    temperature, temperature_log, log_time: readings of the sensors, °C; a log of them; the time in the log, s.

    >>> program = "examples/02_simulate/ring-fanuc.nc"
    >>> trueaxis.trace("machines/i5-engraver/machine.toml", program, block=20).schema
    'trueaxis/trace/1'
    """
    return _ask("trace", locals())


def predict(
    study: Path,
    *,
    samples: Optional[int] = None,
    seed: Optional[int] = None,
    results: Optional[Path] = None,
    compensated: bool = False,
    report: Optional[Path] = None,
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
    return _ask("predict", locals())


def measure(
    campaign: Optional[Path] = None,
    *,
    part: Optional[Path] = None,
    point_u: Optional[Number] = None,
    draw: bool = False,
    output: Optional[Path] = None,
    truth: Optional[Path] = None,
    seed: Optional[int] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[Any]:
    """Readings of the instruments of a campaign on a virtual machine: ``trueaxis measure``.

    part: the test piece of this study instead, on a coordinate measuring machine; point_u: standard uncertainty of a
    point along the normal, a text with its unit; draw: draw the errors of the machine within their uncertainties.
    output: write one table of readings for each instrument into this folder (with part: the points into this file).
    truth: write the true values into this file. seed: the random seed.

    >>> trueaxis.measure("examples/04_plan/probe-ball.toml").schema
    'trueaxis/measure/1'
    """
    _one_of("campaign", campaign, part)
    return _ask("measure", locals())


def plan(
    campaign: Path,
    *,
    control: Optional[str] = None,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.PlanDocument]:
    """Which errors a measurement determines, with what uncertainty, and its programs: ``trueaxis plan``.

    control: the control of the NC programs (sinumerik). output: write programs, poses and campaign into this folder.

    >>> trueaxis.plan("examples/04_plan/probe-ball.toml").schema
    'trueaxis/plan/1'
    """
    return _ask("plan", locals())


def plan_probe_surface(
    file: Path,
    *,
    control: Optional[str] = None,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.PlanProbeSurfaceDocument]:
    """A probing path over a surface without a collision: ``trueaxis plan probe-surface``.

    control: the control of the NC program (sinumerik). output: write program and points into this folder.
    """
    return _ask("plan_probe_surface", locals())


def plan_tool_setting(
    machine: Path,
    setup: Path,
    *,
    tools: Optional[str] = None,
    control: Optional[str] = None,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.PlanToolSettingDocument]:
    """The program that measures the tools of a set-up: ``trueaxis plan tool-setting``.

    tools: only these, such as ``"1,2"``. control: the control of the NC program (sinumerik). output: its folder.
    """
    return _ask("plan_tool_setting", locals())


def identify(
    campaign: Path,
    *,
    output: Optional[Path] = None,
    predictor: Optional[Path] = None,
    check_conventions: bool = False,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.IdentifyErrorsDocument]:
    """The errors of the machine from measurements, with their uncertainties: ``trueaxis identify``.

    output: write a machine file with the identified errors. predictor: one with the prediction by all errors.
    check_conventions: try other signs, orders and units of the readings.

    >>> trueaxis.identify("examples/05_identify/probe-ball.toml").schema
    'trueaxis/identify/1'
    """
    return _ask("identify", locals())


def identify_expansion(
    files: Union[Path, Sequence[Path]],
    *,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[Any]:
    """The expansion coefficient of scales from laser runs at several temperatures: ``trueaxis identify expansion``.

    files: one file of runs for each scale. output: write the machine file with these scales into this new folder.
    """
    return _ask("identify_expansion", locals())


def identify_tables(
    file: Path,
    *,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.IdentifyTablesDocument]:
    """Error tables and squareness from laser readings and ball-bar circles: ``trueaxis identify tables``.

    output: write the machine file with these tables into this new folder.
    """
    return _ask("identify_tables", locals())


def identify_surface(
    file: Path,
    *,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.IdentifySurfaceDocument]:
    """The deviations of a surface from the hits of a probing program: ``trueaxis identify surface``.

    output: write the table of deviations to this file.
    """
    return _ask("identify_surface", locals())


def identify_thermal(
    file: Path,
    *,
    score: Optional[Union[Path, Sequence[Path]]] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.IdentifyThermalDocument]:
    """A linear model of an error that drifts with temperatures, from logs: ``trueaxis identify thermal``.

    score: later logs that the model has not seen.
    """
    return _ask("identify_thermal", locals())


def identify_rtcp(
    file: Path,
    *,
    programs: Optional[Path] = None,
    control: Optional[str] = None,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[Any]:
    """The rotary centres for RTCP from readings at turned poses: ``trueaxis identify rtcp``.

    programs: write the NC programs of the readings into this folder instead, for a control (sinumerik).
    output: write a machine file with the identified centres.
    """
    return _ask("identify_rtcp", locals())


def identify_probe(
    file: Path,
    *,
    correct: Optional[Path] = None,
    output: Optional[Path] = None,
    table: Optional[Path] = None,
    stylus: Optional[str] = None,
    programs: Optional[Path] = None,
    corrections: Optional[Path] = None,
    control: Optional[str] = None,
    orientation: Optional[Number] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[Any]:
    """The offset of a stylus ball and its pre-travel by direction: ``trueaxis identify probe``.

    correct: raw hits to be corrected, written to output. table: write the table by direction here. stylus: its stylus.
    programs, corrections: write programs of the hits, or programs that correct hits, into this folder, for a control
    (sinumerik). orientation: of the spindle, a text with its unit or a number as the command takes it.
    """
    return _ask("identify_probe", locals())


def identify_tools(
    machine: Path,
    setup: Path,
    log: Path,
    *,
    tools: Optional[str] = None,
    date: Optional[str] = None,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.IdentifyToolsDocument]:
    """Length, diameter and wear of tools from the log of a tool setting: ``trueaxis identify tools``.

    tools: those of the program, such as ``"1,2"``. date: when it was measured. output: write lines for the set-up.
    """
    return _ask("identify_tools", locals())


def compensate_values(
    machine: Union[Machine, Path],
    *,
    axis: Optional[str] = None,
    at: Optional[Positions] = None,
    step: Optional[Number] = None,
    targets: Optional[Vector] = None,
    increment: Optional[str] = None,
    of: Optional[str] = None,
    format: Optional[str] = None,
    output: Optional[Path] = None,
    machine_only: bool = False,
    tool_length: Optional[Number] = None,
    tool: Optional[str] = None,
    temperature: Optional[Positions] = None,
    temperature_log: Optional[Path] = None,
    log_time: Optional[Number] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.CompensateDocument]:
    """The values that the control must add, per axis and position: ``trueaxis compensate values``.

    axis: the axis of a table over the travel; at: the other axes, or one position of all, mm and degrees.
    step: distance of the positions (mm, degrees); targets: these positions instead.
    increment: the least increment, ``"1 um"``. of: ``comprehensive`` or ``machine``.
    output: write to this file, in a format (text, json, csv). machine_only: without a part.
    tool_length: length of the tool from the holder to the tip, mm, instead of the tool of the machine file.
    tool: a tool assembly of the machine file, by its name.
    temperature, temperature_log, log_time: readings of the sensors, °C; a log of them; the time in the log, s.

    >>> trueaxis.compensate_values("machines/three-axis-mill/machine.toml", axis="X", step=50).schema
    'trueaxis/compensate/1'
    """
    _one_of("axis", axis, at)
    return _ask("compensate_values", locals())


def compensate_program(
    machine: Union[Machine, Path],
    program: Path,
    *,
    output: Path,
    setup: Optional[Path] = None,
    control: Optional[str] = None,
    flat: bool = False,
    position_only: bool = False,
    residual: Optional[str] = None,
    residual_axis: Optional[str] = None,
    keep_unproved: bool = False,
    increment: Optional[str] = None,
    increment_deg: Optional[str] = None,
    no_rounding: bool = False,
    limit: Optional[str] = None,
    limit_axis: Optional[str] = None,
    machine_only: bool = False,
    tool_length: Optional[Number] = None,
    tool: Optional[str] = None,
    temperature: Optional[Positions] = None,
    temperature_log: Optional[Path] = None,
    log_time: Optional[Number] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.CompensateProgramDocument]:
    """An NC program rewritten so that the actual tool follows the programmed path: ``trueaxis compensate program``.

    output: the compensated program. setup, control: as of :func:`simulate`.
    flat: unroll the program first. position_only: correct the tip only, with the linear axes.
    residual, residual_axis: largest residual error (``"1 um"``, ``"10 urad"``). keep_unproved: write it all the same.
    increment, increment_deg: least increments (``"1 um"``, ``"0.0001 deg"``); no_rounding: full precision instead.
    limit, limit_axis: a larger correction is refused (``"1 mm"``, ``"1 mrad"``). machine_only: without a part.
    tool_length: length of the tool from the holder to the tip, mm, instead of the tool of the machine file.
    tool: a tool assembly of the machine file, by its name.
    temperature, temperature_log, log_time: readings of the sensors, °C; a log of them; the time in the log, s.

    ``is_yes`` is whether the written program is proved.
    """
    return _ask("compensate_program", locals())


def compensate_tables(
    machine: Union[Machine, Path],
    *,
    target: str,
    output: Path,
    at: Optional[Positions] = None,
    bound: Optional[str] = None,
    bound_angle: Optional[str] = None,
    limit: Optional[str] = None,
    limit_angle: Optional[str] = None,
    no_kinematics: bool = False,
    comp_file_type: Optional[int] = None,
    piece: Optional[Path] = None,
    machine_only: bool = False,
    tool_length: Optional[Number] = None,
    tool: Optional[str] = None,
    temperature: Optional[Positions] = None,
    temperature_log: Optional[Path] = None,
    log_time: Optional[Number] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.CompensateTablesDocument]:
    """The tables of a control, read back, with the residual errors: ``trueaxis compensate tables``.

    target: csv, linuxcnc, sinumerik, fanuc, heidenhain or isg. output: the folder of the files, new or empty.
    at: the position of the other axes, mm and degrees. bound, bound_angle: largest error of interpolation and rounding
    (``"1 um"``, ``"5 urad"``). limit, limit_angle: a larger correction is refused (``"1 mm"``, ``"1000 urad"``).
    no_kinematics: leave rotary centres to the tables. comp_file_type: of linuxcnc, 0 or 1.
    piece: a study whose part is cut with the tables, too. machine_only: without a part.
    tool_length: length of the tool from the holder to the tip, mm, instead of the tool of the machine file.
    tool: a tool assembly of the machine file, by its name.
    temperature, temperature_log, log_time: readings of the sensors, °C; a log of them; the time in the log, s.
    """
    if comp_file_type is not None and target != "linuxcnc":
        hint = "use it with linuxcnc, or leave it out"
        raise refuse("unused-argument", "comp_file_type", "only LinuxCNC has a COMP_FILE_TYPE", hint)
    return _ask("compensate_tables", locals())


def compensate_adapt(
    file: Path,
    *,
    output: Optional[Path] = None,
    control: Optional[str] = None,
    tcp: Optional[str] = None,
    tolerance: Optional[Number] = None,
    cl: Optional[Path] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.CompensateAdaptDocument]:
    """A path moved onto the blank that was measured, and the wall that remains: ``trueaxis compensate adapt``.

    output, control: write the program of the adapted path for this control. tcp: ``on`` or ``off``.
    tolerance: largest distance between path and program, mm (0.001). cl: write the adapted cutter locations here.

    >>> trueaxis.compensate_adapt("examples/06_compensate/bangle-adapt.toml").schema
    'trueaxis/compensate-adapt/1'
    """
    return _ask("compensate_adapt", locals())


def post(
    machine: Union[Machine, Path],
    file: Path,
    *,
    control: str,
    output: Path,
    tcp: Optional[str] = None,
    orientation: Optional[str] = None,
    lines_only: bool = False,
    tolerance: Optional[Number] = None,
    axis_tolerance: Optional[Number] = None,
    pole_tolerance: Optional[Number] = None,
    feed_mode: Optional[str] = None,
    feed: Optional[Number] = None,
    retract: Optional[Number] = None,
    units: Optional[str] = None,
    decimals: Optional[str] = None,
    template: Optional[Path] = None,
    number: Optional[int] = None,
    verify: bool = False,
    set_up: Optional[Path] = None,
    tool_length: Optional[Number] = None,
    tool: Optional[str] = None,
    temperature: Optional[Positions] = None,
    temperature_log: Optional[Path] = None,
    log_time: Optional[Number] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.PostDocument]:
    """Cutter locations to the NC program of one control: ``trueaxis post``.

    file: APT of a CAM system, a table x y z i j k, or a test piece. control, output: of the program.
    tcp: on, length or off. orientation: angles or vectors. lines_only: no arcs and cycles.
    tolerance: of the path, mm (0.01). axis_tolerance: of the tool axis, deg (0.05). pole_tolerance: deg (0).
    feed_mode: tip, inverse-time or axis-limit. feed: where the file has none, mm/min. retract: mm (50).
    units: mm or inch, instead of the unit of the file. decimals: of mm and degrees (``"4,5"``).
    template: start and end of the program. number: of the program. set_up: folder for the programs of the set-up.
    verify: read the program back and simulate it.
    tool_length: length of the tool from the holder to the tip, mm, instead of the tool of the machine file.
    tool: a tool assembly of the machine file, by its name.
    temperature, temperature_log, log_time: readings of the sensors, °C; a log of them; the time in the log, s.
    """
    return _ask("post", locals())


def evaluate(
    standard: str,
    data: Path,
    *,
    import_: Optional[str] = None,
    feature: Optional[str] = None,
    map: Optional[Path] = None,
    conditions: Optional[Path] = None,
    radius: Optional[Number] = None,
    window: Optional[str] = None,
    write_back: Optional[Tuple[Path, str]] = None,
    machine: Optional[Path] = None,
    output: Optional[Path] = None,
    tolerance: Optional[Union[str, Sequence[str]]] = None,
    tolerances: Optional[Path] = None,
    rule: Optional[str] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[Any]:
    """Readings by ISO 230 and related standards: ``trueaxis evaluate``.

    standard: iso230-1, iso230-2, iso230-3, iso230-4, iso230-6, iso230-7, iso230-10, …, as the command names them.
    data: the readings. import_: their format (``--import``). feature: of a QIF file. map: which column is what.
    conditions: instrument, temperature, nominal circle. radius: of the nominal circle, mm.
    window: length of the windows of iso230-3 (``"60 min"``).
    write_back: machine file and axis into whose folder the error motion is written (iso230-2).
    machine, output: the machine whose errors the circle states (iso230-4), and its file with them.
    tolerance: of figures, ``["A=10 um"]``. tolerances: in a file. rule: iso14253-1 or simple.

    >>> answer = trueaxis.evaluate("iso230-2", "examples/07_verify/x-axis-laser.csv")
    >>> answer.is_yes
    True
    """
    return _ask("evaluate", locals())


def evaluate_form(
    points: Path,
    *,
    element: str,
    reference: Optional[str] = None,
    filter: Optional[str] = None,
    tolerance: Optional[str] = None,
    u: Optional[str] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[documents.EvaluateFormDocument]:
    """Roundness, straightness, flatness, sphericity, cylindricity of points: ``trueaxis evaluate form``.

    element: line, circle, plane, sphere, cylinder, …. reference: LSC, MZC, …. filter: ``"gauss 50 upr"``.
    tolerance: of the form deviation, ``"0.01 mm"``. u: standard uncertainty of a point, ``"1 um"``.

    >>> trueaxis.evaluate_form("examples/07_verify/cone-section.csv", element="circle").schema
    'trueaxis/evaluate-form/1'
    """
    return _ask("evaluate_form", locals())


def verify(
    file: Optional[Path] = None,
    *,
    diff: Optional[Tuple[Path, Path]] = None,
    certificate: Optional[Path] = None,
    part: Optional[Path] = None,
    before_after: Optional[Path] = None,
    history: Optional[Union[Path, Sequence[Path]]] = None,
    limit: Optional[Union[str, Sequence[str]]] = None,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    force: bool = False,
) -> Answer[Any]:
    """Readings against a prediction, calibrations, certificates, measured parts: ``trueaxis verify``.

    file: the readings, what they are compared with, and the decision rule. Or one of these instead:
    diff: two calibrations of one machine. certificate: a study of residual errors after compensation.
    part: measured test pieces. before_after: a campaign of virtual lasers; output: the folder of its readings.
    history: calibrations of one machine, files or folders; limit: of its figures, ``["EC0Y=30 urad"]``.

    >>> trueaxis.verify("examples/07_verify/probe-ball.toml").schema
    'trueaxis/verify/1'
    """
    _one_of("file", file, diff, certificate, part, before_after, history)
    return _ask("verify", locals())
