"""What is wrong with an input: the exception, the warnings, and the diagnostics that both carry."""

from __future__ import annotations

import re
import warnings
from typing import Iterable, NamedTuple, Optional, Sequence, Tuple

_Entry = Tuple[str, str, str, str, str, int, int]


class Place(NamedTuple):
    """Where something was found.

    ``file`` is the file as it was named, an option such as ``--at``, or an entry of an array as numpy writes it, such
    as ``commands[7, 3]``. ``line`` and ``column`` (in characters) count from 1; they are 0 for a file as a whole, an
    option or an array.

    >>> Place("machine.toml", 12, 5)
    Place(file='machine.toml', line=12, column=5)
    >>> Place("commands[7, 3]", 0, 0).entry
    (7, 3)
    """

    file: str
    line: int
    column: int

    @property
    def entry(self) -> Optional[Tuple[int, ...]]:
        """Row, or row and column, of an entry of an array, from 0 as numpy counts; None elsewhere."""
        found = re.fullmatch(r"\w+\[([\d, ]+)\]", self.file)
        return tuple(int(n) for n in found.group(1).split(",")) if found else None

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}" if self.line else self.file


class Diagnostic(NamedTuple):
    """One problem at one place, with what to do.

    ``severity`` is ``error`` (the input cannot be used), ``warning`` (it should be checked) or ``note``. ``code`` is
    stable; :func:`trueaxis.explain` has its meaning.
    """

    severity: str
    code: str
    message: str
    hint: str
    place: Place

    def __str__(self) -> str:
        hint = f"\n  hint: {self.hint}" if self.hint else ""
        return f"{self.severity}[{self.code}]: {self.message}\n  --> {self.place}{hint}"


class TrueAxisWarning(UserWarning):
    """A warning about the input: the result can be used, but the input should be checked.

    ``warnings.simplefilter("error", trueaxis.TrueAxisWarning)`` turns it into an exception.
    """


class TrueAxisNote(TrueAxisWarning):
    """A note about the input: information, nothing to do."""


#: More are of no use to a reader.
_MOST_SHOWN = 100


class TrueAxisError(ValueError):
    """The input cannot be used.

    ``code``, ``message``, ``hint`` and ``place`` are those of the first error; ``diagnostics`` are all that were
    found, warnings and notes included.

    >>> import trueaxis
    >>> try:
    ...     trueaxis.Machine.from_text("[machine]\\nname = 'a'\\nchain = 'w b Q t'")
    ... except trueaxis.TrueAxisError as error:
    ...     print(error.place.line, error.diagnostics[0].severity)
    3 error
    """

    code: str
    message: str
    hint: str
    place: Place
    diagnostics: Tuple[Diagnostic, ...]

    def __init__(self, diagnostics: Sequence[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        errors = [d for d in self.diagnostics if d.severity == "error"] or list(self.diagnostics)
        first = errors[0]
        self.code, self.message, self.hint, self.place = first.code, first.message, first.hint, first.place
        shown = [str(d) for d in errors[:_MOST_SHOWN]]
        if len(errors) > len(shown):
            shown.append(f"… and {len(errors) - len(shown)} more")
        super().__init__("\n\n".join(shown))

    def __reduce__(self) -> Tuple[type, Tuple[Tuple[Diagnostic, ...]]]:
        return (type(self), (self.diagnostics,))

    @classmethod
    def _of(cls, entries: Iterable[_Entry]) -> TrueAxisError:
        return cls(diagnostics(entries))


def diagnostics(entries: Iterable[_Entry]) -> Tuple[Diagnostic, ...]:
    """Diagnostics as the library lists them."""
    return tuple(
        Diagnostic(severity, code, message, hint, Place(file, line, column))
        for severity, code, message, hint, file, line, column in entries
    )


def warn(found: Sequence[Diagnostic], stacklevel: int) -> None:
    """Issues everything that is no exception as a Python warning at the caller of the package."""
    for diagnostic in found[:_MOST_SHOWN]:
        category = TrueAxisNote if diagnostic.severity == "note" else TrueAxisWarning
        warnings.warn(str(diagnostic), category, stacklevel + 1)


def refuse(code: str, place: str, message: str, hint: str) -> TrueAxisError:
    """The exception with one error."""
    return TrueAxisError([Diagnostic("error", code, message, hint, Place(place, 0, 0))])
