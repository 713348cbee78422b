"""Plan, measure, evaluate, verify: the questions about readings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Sequence, Tuple, Union

from ._answers import Answer
from ._ask import Number, ask, one_of
from ._machine import Path

if TYPE_CHECKING:
    from . import documents


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
    heading: Optional[Path] = None,
    language: str = "en",
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
    one_of("campaign", campaign, part)
    return ask("measure", locals())


def plan(
    campaign: Path,
    *,
    control: Optional[str] = None,
    output: Optional[Path] = None,
    write_unsafe: bool = False,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.PlanDocument]:
    """Which errors a measurement determines, with what uncertainty, and its programs: ``trueaxis plan``.

    control: the control of the NC programs (sinumerik). output: write programs, poses and campaign into this folder.
    write_unsafe: programs that are NOT SAFE, too.

    >>> trueaxis.plan("examples/04_plan/probe-ball.toml").schema
    'trueaxis/plan/1'
    """
    return ask("plan", locals())


def plan_probe_surface(
    file: Path,
    *,
    control: Optional[str] = None,
    output: Optional[Path] = None,
    write_unsafe: bool = False,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.PlanProbeSurfaceDocument]:
    """A probing path over a surface without a collision: ``trueaxis plan probe-surface``.

    control: the control of the NC program (sinumerik). output: write program and points into this folder.
    write_unsafe: also where the program is NOT SAFE.
    """
    return ask("plan_probe_surface", locals())


def plan_tool_setting(
    machine: Path,
    setup: Path,
    *,
    tools: Optional[str] = None,
    control: Optional[str] = None,
    output: Optional[Path] = None,
    write_unsafe: bool = False,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.PlanToolSettingDocument]:
    """The program that measures the tools of a set-up: ``trueaxis plan tool-setting``.

    tools: only these, such as ``"1,2"``. control: the control of the NC program (sinumerik). output: its folder.
    write_unsafe: also where it is NOT SAFE.
    """
    return ask("plan_tool_setting", locals())


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
    heading: Optional[Path] = None,
    language: str = "en",
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
    return ask("evaluate", locals())


def evaluate_form(
    points: Path,
    *,
    element: str,
    reference: Optional[str] = None,
    filter: Optional[str] = None,
    tolerance: Optional[str] = None,
    u: Optional[str] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.EvaluateFormDocument]:
    """Roundness, straightness, flatness, sphericity, cylindricity of points: ``trueaxis evaluate form``.

    element: line, circle, plane, sphere, cylinder, …. reference: LSC, MZC, …. filter: ``"gauss 50 upr"``.
    tolerance: of the form deviation, ``"0.01 mm"``. u: standard uncertainty of a point, ``"1 um"``.

    >>> trueaxis.evaluate_form("examples/07_verify/cone-section.csv", element="circle").schema
    'trueaxis/evaluate-form/1'
    """
    return ask("evaluate_form", locals())


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
    heading: Optional[Path] = None,
    language: str = "en",
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
    one_of("file", file, diff, certificate, part, before_after, history)
    return ask("verify", locals())
