"""The verbs of the command as functions: the same questions, the same options by the same names.

A path is a text or a ``pathlib.Path``. A quantity is a text with its unit (``"2 um"``) or, where the option states a
unit, a plain number in that unit. Positions and temperatures may be mappings: ``{"X": 3000, "C": -90}``. Every function
takes `report`, the file of a report (``.html``, ``.pdf`` where this build has it), `heading`, a TOML file with what stands
above a report that is filed and signed (number, date, customer, operator), `language` (``en``, ``de``, ``zh``) of the report and
of the text of the answer, and `force`, which replaces files that this program did not write.
"""

from __future__ import annotations

import operator
import os
from typing import Any, Dict, Mapping, Sequence, Union

from . import _native
from ._answers import Answer
from ._machine import Machine, needs, not_both, path_of, text_of
from ._problems import refuse, warn

#: A number in the unit that the option states, or a text.
Number = Union[float, str]
#: Positions of axes: ``{"X": 10}`` or ``"X=10"``, mm and degrees.
Positions = Union[str, Mapping[str, float]]
#: Three numbers, or a text of them.
Vector = Union[str, Sequence[float]]

#: Options that may be given more than once; elsewhere the same name may be that of a single value.
_LISTS = {
    "evaluate": frozenset(["tolerance", "write_back"]),
    "identify_expansion": frozenset(["files"]),
    "identify_thermal": frozenset(["score"]),
    "verify": frozenset(["diff", "history", "limit"]),
}


def ask(verb: str, given: Dict[str, Any]) -> Answer[Any]:
    """Puts a question; `given` are the arguments of the function that was called, by their names."""
    report, heading, force = given.pop("report"), given.pop("heading"), given.pop("force")
    language = given.pop("language")
    memory: Dict[str, bytes] = {}
    options: Dict[str, Any] = {
        name.rstrip("_"): _option(name, value, name in _LISTS.get(verb, ())) for name, value in given.items()
    }
    machine = given.get("machine")
    if isinstance(machine, Machine):
        memory = {os.fspath(path): content for path, content in machine._native.files.items()}
        for name, value in machine._options.items():
            if name != "machine" and value is not None and name not in given:
                message = f"`{verb}` does not use the `{name}` of the machine"
                raise refuse("unused-argument", "machine", message, "give the path of its file, or a machine without it")
            if name == "machine" or options.get(name) is None:
                options[name] = value
    for one, other in _EXCLUDE + _EXCLUDE_OF.get(verb, []):
        not_both(options, one, other)
    for one, other in _NEED + _NEED_OF.get(verb, []):
        if one in options and other in options:
            needs(options, one, other)
    for name, count in _PAIRS.items():
        if options.get(name) and len(options[name]) != 2:
            message = f"`{name}` has {len(options[name])} entries, not 2"
            raise refuse("unused-argument", name, message, f"give {count}")
    native = _native.ask(verb, options, memory, (path_of(report), path_of(heading), language), bool(force))
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


#: The same of single verbs.
_EXCLUDE_OF = {
    "compensate_program": [("no_rounding", "increment"), ("no_rounding", "increment_deg")],
    "identify_rtcp": [("programs", "output")],
    "measure": [("part", "truth")],
    "solve": [("path", "tip"), ("path", "axis")],
}
_NEED_OF = {
    "compensate_adapt": [("control", "output"), ("output", "control")],
    "evaluate": [("output", "machine")],
    "identify_probe": [("output", "correct")],
    "identify_rtcp": [("control", "programs")],
    "measure": [("draw", "part"), ("point_u", "part")],
    "verify": [("limit", "history"), ("output", "before_after")],
}
#: Options of two entries, and what these are.
_PAIRS = {"diff": "the older calibration and the newer one", "write_back": "a machine file and the name of an axis"}


def _option(name: str, value: Any, is_list: bool) -> Any:
    if value is None or isinstance(value, (bool, Machine)):
        return value
    if name in _COUNTS:
        return _count(name, value)
    if is_list:
        entries = value if isinstance(value, (list, tuple)) else [value]
        return [os.fspath(entry) if isinstance(entry, os.PathLike) else text_of(entry) for entry in entries]
    return os.fspath(value) if isinstance(value, os.PathLike) else text_of(value)


#: Options that are whole numbers, and the largest of them.
_COUNTS = {
    "seed": 2**64 - 1,
    "block": 2**32 - 1,
    "most_jumps": 2**64 - 1,
    "number": 2**32 - 1,
    "machines": 2**32 - 1,
    "days": 2**32 - 1,
    "sensitivity": 2**32 - 1,
}


def _count(name: str, value: Any) -> int:
    """A whole number that the option can be."""
    try:
        number = operator.index(value)
    except TypeError:
        raise refuse("unused-argument", name, f"`{value!r}` is not a whole number", f"{name}=1") from None
    if not 0 <= number <= _COUNTS[name]:
        message = f"{number} is not in 0..={_COUNTS[name]}"
        raise refuse("unused-argument", name, message, f"{name}=1")
    return number



def one_of(name: str, *given: Any) -> None:
    """Refuses a question that is not one."""
    count = sum(value is not None for value in given)
    if count != 1:
        message = f"{count} of the arguments that say what is asked are given, not one"
        raise refuse("unused-argument", name, message, "see the description of the function")
