"""Compensate: values, programs and tables, and programs from cutter locations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Optional, Union

from ._answers import Answer
from ._ask import Number, Positions, Vector, ask, one_of
from ._machine import Machine, Path
from ._problems import refuse

if TYPE_CHECKING:
    from . import documents


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
    heading: Optional[Path] = None,
    language: str = "en",
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
    one_of("axis", axis, at)
    return ask("compensate_values", locals())


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
    heading: Optional[Path] = None,
    language: str = "en",
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
    return ask("compensate_program", locals())


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
    heading: Optional[Path] = None,
    language: str = "en",
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
    return ask("compensate_tables", locals())


def compensate_adapt(
    file: Path,
    *,
    output: Optional[Path] = None,
    control: Optional[str] = None,
    tcp: Optional[str] = None,
    tolerance: Optional[Number] = None,
    cl: Optional[Path] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.CompensateAdaptDocument]:
    """A path moved onto the blank that was measured, and the wall that remains: ``trueaxis compensate adapt``.

    output, control: write the program of the adapted path for this control. tcp: ``on`` or ``off``.
    tolerance: largest distance between path and program, mm (0.001). cl: write the adapted cutter locations here.

    >>> trueaxis.compensate_adapt("examples/06_compensate/bangle-adapt.toml").schema
    'trueaxis/compensate-adapt/1'
    """
    return ask("compensate_adapt", locals())


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
    heading: Optional[Path] = None,
    language: str = "en",
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
    return ask("post", locals())
