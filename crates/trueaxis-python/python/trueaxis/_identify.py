"""Identify: what readings say of the machine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Sequence, Union

from ._answers import Answer
from ._ask import Number, ask
from ._machine import Path

if TYPE_CHECKING:
    from . import documents


def identify(
    campaign: Path,
    *,
    output: Optional[Path] = None,
    predictor: Optional[Path] = None,
    check_conventions: bool = False,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.IdentifyErrorsDocument]:
    """The errors of the machine from measurements, with their uncertainties: ``trueaxis identify``.

    output: write a machine file with the identified errors. predictor: one with the prediction by all errors.
    check_conventions: try other signs, orders and units of the readings.

    >>> trueaxis.identify("examples/05_identify/probe-ball.toml").schema
    'trueaxis/identify/1'
    """
    return ask("identify", locals())


def identify_expansion(
    files: Union[Path, Sequence[Path]],
    *,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[Any]:
    """The expansion coefficient of scales from laser runs at several temperatures: ``trueaxis identify expansion``.

    files: one file of runs for each scale. output: write the machine file with these scales into this new folder.
    """
    return ask("identify_expansion", locals())


def identify_tables(
    file: Path,
    *,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.IdentifyTablesDocument]:
    """Error tables and squareness from laser readings and ball-bar circles: ``trueaxis identify tables``.

    output: write the machine file with these tables into this new folder.
    """
    return ask("identify_tables", locals())


def identify_surface(
    file: Path,
    *,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.IdentifySurfaceDocument]:
    """The deviations of a surface from the hits of a probing program: ``trueaxis identify surface``.

    output: write the table of deviations to this file.
    """
    return ask("identify_surface", locals())


def identify_thermal(
    file: Path,
    *,
    score: Optional[Union[Path, Sequence[Path]]] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.IdentifyThermalDocument]:
    """A linear model of an error that drifts with temperatures, from logs: ``trueaxis identify thermal``.

    score: later logs that the model has not seen.
    """
    return ask("identify_thermal", locals())


def identify_rtcp(
    file: Path,
    *,
    programs: Optional[Path] = None,
    control: Optional[str] = None,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[Any]:
    """The rotary centres for RTCP from readings at turned poses: ``trueaxis identify rtcp``.

    programs: write the NC programs of the readings into this folder instead, for a control (sinumerik).
    output: write a machine file with the identified centres.
    """
    return ask("identify_rtcp", locals())


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
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[Any]:
    """The offset of a stylus ball and its pre-travel by direction: ``trueaxis identify probe``.

    correct: raw hits to be corrected, written to output. table: write the table by direction here. stylus: its stylus.
    programs, corrections: write programs of the hits, or programs that correct hits, into this folder, for a control
    (sinumerik). orientation: of the spindle, a text with its unit or a number as the command takes it.
    """
    return ask("identify_probe", locals())


def identify_tools(
    machine: Path,
    setup: Path,
    log: Path,
    *,
    tools: Optional[str] = None,
    date: Optional[str] = None,
    output: Optional[Path] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.IdentifyToolsDocument]:
    """Length, diameter and wear of tools from the log of a tool setting: ``trueaxis identify tools``.

    tools: those of the program, such as ``"1,2"``. date: when it was measured. output: write lines for the set-up.
    """
    return ask("identify_tools", locals())
