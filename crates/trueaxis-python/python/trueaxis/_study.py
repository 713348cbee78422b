"""Studies of many machines on many days."""

from __future__ import annotations

import hashlib
import os
from typing import TYPE_CHECKING, Any, Dict, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _native
from ._answers import Answer
from ._ask import ask
from ._machine import Path, path_of
from ._poses import Floats
from ._problems import Diagnostic, diagnostics, refuse, warn

if TYPE_CHECKING:
    from . import documents


def study(
    study: Path,
    *,
    machines: Optional[int] = None,
    days: Optional[int] = None,
    seed: Optional[int] = None,
    sensitivity: Optional[int] = None,
    table: Optional[Path] = None,
    report: Optional[Path] = None,
    heading: Optional[Path] = None,
    language: str = "en",
    force: bool = False,
) -> Answer[documents.StudyDocument]:
    """How many machines hold the part on how many days, and what makes the variance: ``trueaxis study``.

    machines, days, seed, sensitivity (rows; 0: none): instead of those of the study.
    table: write inputs and outputs of every sample here, a CSV file.

    For any samples of a study, and for clusters, take :class:`Study`.

    >>> answer = trueaxis.study("examples/09_study/fleet.toml", machines=20, days=2)
    >>> answer.design.samples >= 40
    True
    """
    return ask("study", locals())


class Study:
    """A study of many machines whose samples are computed in any pieces.

    A sample depends on the study and on its number alone: any piece can be computed by any computer at any time, again
    after it was lost, and gives the same bits. A study can be pickled: its files go with it.

    >>> study = Study.load("examples/09_study/fleet.toml", machines=10, days=2)
    >>> study.values(0, 5).shape == (5, len(study.outputs))
    True
    """

    _native: _native.Study
    _options: Dict[str, Any]
    #: What was found in the files: warnings and notes.
    diagnostics: Tuple[Diagnostic, ...]

    def __init__(self) -> None:
        raise TypeError("a study comes from Study.load(path)")

    @classmethod
    def load(
        cls,
        path: Path,
        *,
        machines: Optional[int] = None,
        days: Optional[int] = None,
        seed: Optional[int] = None,
        sensitivity: Optional[int] = None,
    ) -> Study:
        """Reads and checks a study file with everything that it names.

        machines, days, seed, sensitivity (rows; 0: none): instead of those of the file.

        Raises TrueAxisError with every problem of the files, each with its line and column.
        """
        options = {
            "study": path_of(path),
            "machines": machines,
            "days": days,
            "seed": seed,
            "sensitivity": sensitivity,
        }
        return cls._of(options, {}, False)

    @classmethod
    def _of(cls, options: Dict[str, Any], files: Mapping[str, bytes], alone: bool) -> Study:
        study = cls.__new__(cls)
        study._options = options
        study._native = _native.Study(options, files, alone)
        study.diagnostics = diagnostics(study._native.diagnostics)
        if not alone:
            warn(study.diagnostics, 3)
        return study

    def __reduce__(self) -> Tuple[Any, Tuple[Any, ...]]:
        files = {os.fspath(path): content for path, content in self._native.files.items()}
        return (_unpickled, (self._options, files))

    @property
    def name(self) -> str:
        """The name in the study file."""
        return self._native.name

    @property
    def samples(self) -> int:
        """How many samples it has: machines times days (times combinations), then the rows of the sensitivity analysis."""
        return self._native.samples

    @property
    def outputs(self) -> Tuple[str, ...]:
        """The keys of the outputs: the columns of :meth:`values`, mm."""
        return tuple(self._native.outputs)

    @property
    def inputs(self) -> Tuple[str, ...]:
        """The names of the inputs: the columns of :meth:`inputs_of`."""
        return tuple(name for name, _ in self._native.inputs)

    @property
    def units(self) -> Tuple[str, ...]:
        """The unit of each input: mm, rad, degC, s or 1."""
        return tuple(unit for _, unit in self._native.inputs)

    @property
    def identity(self) -> str:
        """A checksum of everything that the numbers depend on: version, files, options. The place of the files is not in it."""
        folder = os.path.dirname(os.path.abspath(str(self._options["study"])))
        files = {
            os.path.relpath(os.path.abspath(os.fspath(path)), folder).replace(os.sep, "/"): content
            for path, content in self._native.files.items()
        }
        sums = hashlib.sha256()
        for word in (_native.VERSION, *(f"{key}={self._options[key]}" for key in ("machines", "days", "seed", "sensitivity"))):
            sums.update(word.encode() + b"\0")
        for name in sorted(files):
            sums.update(name.encode() + b"\0" + hashlib.sha256(files[name]).digest())
        return sums.hexdigest()

    def values(self, start: int = 0, stop: Optional[int] = None, *, threads: Optional[int] = None) -> Floats:
        """The outputs of samples from `start` to before `stop`, mm: a row for each, columns as :attr:`outputs`.

        First machine after machine, each with its days (of a factorial design, so for each combination), then the rows of
        the sensitivity analysis: A, B, and A with each group from B.

        threads: how many; without it one for each core. The numbers do not depend on it.
        """
        return self._native.evaluate(start, self.samples if stop is None else stop, threads)

    def inputs_of(self, start: int = 0, stop: Optional[int] = None) -> Floats:
        """The inputs of samples from `start` to before `stop`, columns as :attr:`inputs`, in :attr:`units`."""
        return self._native.inputs_of(start, self.samples if stop is None else stop)

    def answer(self, values: npt.ArrayLike) -> Answer[documents.StudyDocument]:
        """The answer of all samples, from their outputs as :meth:`values` gives them, in order.

        Of a DataFrame the columns are taken by the names of the outputs.
        """
        given: Any = values
        if hasattr(given, "columns"):
            if sorted(map(str, given.columns)) != sorted(self.outputs):
                message = f"the columns are {', '.join(map(str, given.columns))}"
                raise refuse("array-shape", "values", message, f"the outputs are {', '.join(self.outputs)}")
            given = given[list(self.outputs)].to_numpy()
        if np.ma.isMaskedArray(given):
            message = "`values` is a masked array, whose mask would be lost"
            raise refuse("array-type", "values", message, "give the numbers of all samples, mm")
        rows = np.asarray(given)
        if rows.dtype.kind not in "iuf":
            message = f"`values` has the type {rows.dtype}"
            raise refuse("array-type", "values", message, "give plain numbers, mm")
        shape = (self.samples, len(self.outputs))
        if rows.shape != shape:
            message = f"`values` has the shape {rows.shape}, not {shape}"
            raise refuse("array-shape", "values", message, "one row for each sample, one column for each output")
        rows = np.ascontiguousarray(rows, dtype=np.float64)
        bad = np.argwhere(~np.isfinite(rows))
        if len(bad):
            place = f"values[{bad[0][0]}, {bad[0][1]}]"
            raise refuse("not-finite", place, f"{rows[tuple(bad[0])]} is not finite", "give the numbers of all samples, mm")
        return Answer(self._native.answer(rows.reshape(-1)))

    def __repr__(self) -> str:
        return f"<Study {self.name!r}: {self.samples} samples, {len(self.inputs)} inputs, {len(self.outputs)} outputs>"


def _unpickled(options: Dict[str, Any], files: Mapping[str, bytes]) -> Study:
    return Study._of(options, files, True)
