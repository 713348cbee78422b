"""TrueAxis: where is the tool of a machine really, and is the part good?

Machines over numpy arrays (:class:`Machine`), and the verbs of the command ``trueaxis`` as functions, with the same
words and units: mm and degrees for commands, mm, µm and µrad in answers; every name ends in its unit.

>>> import trueaxis
>>> machine = trueaxis.Machine.load("machines/xkas2525/machine.toml")
>>> machine.axes
('X', 'Y', 'Z', 'C', 'A')
>>> machine.deviation([[3000, 1200, -700, -90, 15]])
<Deviations of 1 pose>
  tip 35.134 -20.773 11.643 um   axis 357.202 101.073 166.475 urad
"""


from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional

from . import _native
from ._answers import Answer, Record
from ._compensate import (
    compensate_adapt,
    compensate_program,
    compensate_tables,
    compensate_values,
    post,
)
from ._describe import (
    part,
    pose,
    predict,
    simulate,
    solve,
    trace,
)
from ._identify import (
    identify,
    identify_expansion,
    identify_probe,
    identify_rtcp,
    identify_surface,
    identify_tables,
    identify_thermal,
    identify_tools,
)
from ._measurement import (
    evaluate,
    evaluate_form,
    measure,
    plan,
    plan_probe_surface,
    plan_tool_setting,
    verify,
)
from ._machine import Machine
from ._poses import Deviations, Errors, Poses, Solutions
from ._problems import Diagnostic, Place, TrueAxisError, TrueAxisNote, TrueAxisWarning
from ._study import Study, study

if TYPE_CHECKING:
    from . import documents

__version__: str = _native.VERSION

#: A machine file with one error, for examples: Y is not square to X by 10 µrad, and the tool is 100 mm long.
EXAMPLE = """
[machine]
name = "three axes"
chain = "w b X Y Z t"
[tool]
length = "100 mm"
[location]
EC0Y = "10 urad"
"""


def __getattr__(name: str) -> Any:
    # Types only: thousands of lines that nothing needs at run time.
    if name == "documents":
        return import_module(".documents", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def explain(code: str) -> Optional[str]:
    """What the code of a diagnostic means and what to do (Markdown), as ``trueaxis explain``; None if it is not known.

    >>> print(explain("table-too-short").splitlines()[0])
    An error table does not cover the travel of its axis.
    """
    found = _native.explain(code)
    return None if found is None else found[1]


def licenses() -> str:
    """The licences of everything in this package.

    >>> licenses().splitlines()[2]
    'TrueAxis (30 packages): MIT OR Apache-2.0'
    """
    return (Path(__file__).parent / "licenses.txt").read_text(encoding="utf-8")


__all__ = [
    "EXAMPLE",
    "Answer",
    "Deviations",
    "Diagnostic",
    "Errors",
    "Machine",
    "Place",
    "Poses",
    "Record",
    "Solutions",
    "Study",
    "TrueAxisError",
    "TrueAxisNote",
    "TrueAxisWarning",
    "compensate_adapt",
    "compensate_program",
    "compensate_tables",
    "compensate_values",
    "documents",
    "evaluate",
    "evaluate_form",
    "explain",
    "identify",
    "identify_expansion",
    "identify_probe",
    "identify_rtcp",
    "identify_surface",
    "identify_tables",
    "identify_thermal",
    "identify_tools",
    "licenses",
    "measure",
    "part",
    "plan",
    "plan_probe_surface",
    "plan_tool_setting",
    "pose",
    "post",
    "predict",
    "simulate",
    "solve",
    "study",
    "trace",
    "verify",
]
