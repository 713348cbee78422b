"""A machine: read from a file, asked at the commands of an array."""

from __future__ import annotations

import os
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._poses import Deviations, Errors, Floats, Poses, Solutions
from ._problems import Diagnostic, diagnostics, refuse, warn

Path = Union[str, "os.PathLike[str]"]


def text_of(value: Any) -> Optional[str]:
    """A value of an option as the command takes it.

    A text stays as it is. A number is in the unit that the option states. A mapping ``{"X": 10, "C": -90}`` becomes
    ``X=10 C=-90``, a list ``[1, 2, 3]`` becomes ``1 2 3``.

    >>> text_of({"X": 10, "C": -90.5})
    'X=10 C=-90.5'
    >>> text_of([0.3, -0.2, 0.93])
    '0.3 -0.2 0.93'
    """
    if value is None or isinstance(value, str):
        return value
    if isinstance(value, Mapping):
        return " ".join(f"{name}={text_of(entry)}" for name, entry in value.items())
    if isinstance(value, (Sequence, np.ndarray)) and not np.isscalar(value):
        return " ".join(str(text_of(entry)) for entry in value)
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    return str(value)


def path_of(path: Optional[Path]) -> Optional[str]:
    """A path as a text."""
    return None if path is None else os.fspath(path)


class Machine:
    """A checked machine tool: its chain, its axes, its errors, the tool in it, its temperatures.

    Commands are arrays of the shape (n, number of axes), columns in the order of :attr:`axes`: **mm for linear and
    degrees for rotary axes**, as the command ``trueaxis pose`` takes them. float64 arrays of any strides are read as
    they are, without a copy; other numbers are converted; a table (a DataFrame, a mapping) is read by the names of its
    columns, and axes that it does not have stand at 0.

    A machine can be pickled: its files go with it, and nothing is read from the disk where it arrives.

    >>> import trueaxis
    >>> machine = trueaxis.Machine.from_text(trueaxis.EXAMPLE)
    >>> machine.axes
    ('X', 'Y', 'Z')
    >>> machine.deviation([[0, 500, 0]])  # 10 µrad of squareness over 500 mm
    <Deviations of 1 pose>
      tip -5.000 0.000 0.000 um   axis 0.000 0.000 0.000 urad
    """

    _native: _native.Machine

    def __init__(self) -> None:
        raise TypeError("a machine comes from Machine.load(path) or Machine.from_text(text)")

    @classmethod
    def load(
        cls,
        path: Path,
        *,
        tool_length: Union[float, str, None] = None,
        tool: Optional[str] = None,
        temperature: Union[str, Mapping[str, float], None] = None,
        temperature_log: Optional[Path] = None,
        log_time: Union[float, str, None] = None,
    ) -> Machine:
        """Reads and checks a machine file with the tables that it names.

        path: the machine file (TOML).
        tool_length: length of the tool from the holder to the tip, mm, instead of the tool of the file.
        tool: a tool assembly of the machine file, by its name.
        temperature: readings of its sensors, °C: ``{"scale_x": 30.5, "workpiece": 31}`` or the text of the command.
        temperature_log: the same from a log, a file with ``time_s`` and one column for each sensor.
        log_time: the time in the log, s; without it its end.

        Raises TrueAxisError with every problem of the file, each with its line and column.
        """
        return cls._of(path, {}, False, tool_length, tool, temperature, temperature_log, log_time)

    @classmethod
    def from_text(
        cls,
        text: str,
        *,
        name: Path = "machine.toml",
        files: Optional[Mapping[str, Union[str, bytes]]] = None,
        tool_length: Union[float, str, None] = None,
        tool: Optional[str] = None,
        temperature: Union[str, Mapping[str, float], None] = None,
    ) -> Machine:
        """Checks the text of a machine file.

        name: what the file is called in messages; tables that the text names are looked for in its folder.
        files: tables that are in memory, by their paths; they stand before those of the disk.
        tool_length (mm), tool, temperature (°C): as of :meth:`load`.

        >>> Machine.from_text("[machine]\\nname = 'three axes'\\nchain = 'w b X Y Z t'").axes
        ('X', 'Y', 'Z')
        """
        if not isinstance(text, str):
            message = f"the text of a machine file is of the type {type(text).__name__}"
            raise refuse("array-type", "text", message, "give a str: bytes.decode()")
        memory = {os.fspath(name): text.encode()}
        for path, content in (files or {}).items():
            memory[os.fspath(path)] = content.encode() if isinstance(content, str) else content
        return cls._of(name, memory, False, tool_length, tool, temperature, None, None)

    @classmethod
    def _of(
        cls,
        path: Path,
        files: Mapping[str, bytes],
        alone: bool,
        tool_length: Any,
        tool: Optional[str],
        temperature: Any,
        temperature_log: Optional[Path],
        log_time: Any,
    ) -> Machine:
        options: Dict[str, Any] = {
            "machine": os.fspath(path),
            "tool_length": text_of(tool_length),
            "tool": tool,
            "temperature": text_of(temperature),
            "temperature_log": path_of(temperature_log),
            "log_time": text_of(log_time),
        }
        not_both(options, "tool", "tool_length")
        not_both(options, "temperature", "temperature_log")
        needs(options, "log_time", "temperature_log")
        machine = cls.__new__(cls)
        machine._options = options
        machine._native = _native.Machine(options, files, alone)
        machine.diagnostics = diagnostics(machine._native.diagnostics)
        if not alone:
            warn(machine.diagnostics, 3)
        return machine

    #: What was found in the files: warnings and notes.
    diagnostics: Tuple[Diagnostic, ...]
    _options: Dict[str, Any]

    def __reduce__(self) -> Tuple[Any, Tuple[Any, ...]]:
        files = {os.fspath(path): content for path, content in self._native.files.items()}
        return (_unpickled, (self._options, files))

    @property
    def name(self) -> str:
        """The name in the machine file."""
        return self._native.name

    @property
    def path(self) -> str:
        """The machine file as it was named."""
        return str(self._options["machine"])

    @property
    def chain(self) -> str:
        """The kinematic chain from the workpiece to the tool, such as ``w b X Y Z C A t``."""
        return self._native.chain

    @property
    def axes(self) -> Tuple[str, ...]:
        """The names of the axes in chain order: the order of the columns of commands."""
        return tuple(name for name, *_ in self._native.axes)

    @property
    def units(self) -> Tuple[str, ...]:
        """The unit of each axis in commands: ``mm`` or ``deg``."""
        return tuple(unit for _, unit, *_ in self._native.axes)

    @property
    def travel(self) -> Dict[str, Tuple[float, float]]:
        """The range of each axis, mm or degrees; infinite where none is stated."""
        return {name: (low, high) for name, _, low, high in self._native.axes}

    @property
    def error_names(self) -> Tuple[str, ...]:
        """The ISO 230-1 names of the errors that the machine has, in chain order."""
        return tuple(name for name, _ in self._native.error_names)

    def __repr__(self) -> str:
        return f"<Machine {self.name!r}: {self.chain}; {len(self.error_names)} errors>"

    def deviation(
        self,
        commands: npt.ArrayLike,
        *,
        approach: Union[str, Mapping[str, str], None] = None,
        threads: Optional[int] = None,
        out: Optional[Deviations] = None,
    ) -> Deviations:
        """Deviations of the tool, actual − nominal, in the workpiece frame (mm and µm, µrad).

        commands: shape (n, number of axes), mm and degrees, columns in the order of :attr:`axes`.
        approach: from where each axis comes, where backlash is stated: ``{"X": "+"}`` or ``"X=+ C=-"``; without it
            the mean of both.
        threads: how many threads compute; without it RAYON_NUM_THREADS, else one for each core. The numbers are the
            same, bit for bit.
        out: a result of as many poses, whose memory is written again.

        The interpreter lock is released during the work: the array must not be changed meanwhile. Positions outside
        the travel are computed, with a warning. Raises TrueAxisError with the row and the column of what cannot be.

        >>> import trueaxis
        >>> machine = trueaxis.Machine.from_text(trueaxis.EXAMPLE)
        >>> machine.deviation([[0, 100, 0], [0, 500, 0]]).tip_um[:, 0].round(6)
        array([-1., -5.])
        """
        block, found = self._deviations(commands, approach, threads, out, False)
        return Deviations(block, found)

    def pose(
        self,
        commands: npt.ArrayLike,
        *,
        approach: Union[str, Mapping[str, str], None] = None,
        threads: Optional[int] = None,
        out: Optional[Poses] = None,
    ) -> Poses:
        """Nominal and actual poses of the tool in the workpiece frame (mm; unit vectors), with their deviations.

        Arguments as of :meth:`deviation`; the work is the same, the result twice as large.

        >>> import trueaxis
        >>> machine = trueaxis.Machine.from_text(trueaxis.EXAMPLE)
        >>> machine.pose([[10, 500, 30]]).nominal_tip_mm
        array([[ 10., 500., -70.]])
        """
        block, found = self._deviations(commands, approach, threads, out, True)
        return Poses(block, found)

    def _deviations(
        self, commands: Any, approach: Any, threads: Optional[int], out: Optional[Deviations], nominal: bool
    ) -> Tuple[Floats, Tuple[Diagnostic, ...]]:
        array, sides = self._array(commands), self._sides(approach)
        if out is not None and not isinstance(out, Deviations):
            message = f"`out` is of the type {type(out).__name__}"
            raise refuse("array-type", "out", message, "give a result of the same function and of as many poses")
        block = None if out is None else out._block
        if block is not None and (block.shape[1] != len(array) or (nominal and len(block) < 12)):
            what = "poses" if len(block) == 12 else "deviations"
            shape = f"`out` has {block.shape[1]} {what}, the commands {len(array)}"
            raise refuse("array-shape", "out", shape, "give a result of the same function and of as many poses")
        block, entries = _native.deviations(self._native, array, sides, threads, nominal, block)
        found = diagnostics(entries)
        warn(found, 3)
        return block, found

    def errors_at(
        self,
        commands: npt.ArrayLike,
        *,
        approach: Union[str, Mapping[str, str], None] = None,
        threads: Optional[int] = None,
    ) -> Errors:
        """The value of every error at each command, by its ISO 230-1 name (µm and µrad).

        Arguments as of :meth:`deviation`.

        >>> import trueaxis
        >>> trueaxis.Machine.from_text(trueaxis.EXAMPLE).errors_at([[0, 500, 0]])
        <Errors at 1 pose>
          EC0Y 10.000 urad
        """
        array, sides = self._array(commands), self._sides(approach)
        block, entries = _native.errors_at(self._native, array, sides, threads)
        found = diagnostics(entries)
        warn(found, 2)
        return Errors(block, self._native.error_names, found)

    def solve(
        self,
        tips: npt.ArrayLike,
        axes: npt.ArrayLike,
        *,
        near: Optional[npt.ArrayLike] = None,
        path: bool = False,
        threads: Optional[int] = None,
    ) -> Solutions:
        """Axis positions (mm and degrees) that bring the tool of the nominal machine to tips and directions.

        tips: shape (n, 3), the tip in the workpiece frame, mm.
        axes: shape (n, 3), the tool axis from the tip to the spindle, of any length.
        near: where the axes stand before, mm and degrees: one row, or one for each pose; without it all at 0. Of all
            solutions the one with the shortest way of the rotary axes from there is taken; a redundant axis stays.
        path: whether the rows are one path: then the whole of it is solved with the least travel of the rotary axes,
            every step continuous, as ``trueaxis solve --path`` does.

        >>> import trueaxis
        >>> machine = trueaxis.Machine.from_text(trueaxis.EXAMPLE)
        >>> machine.solve([[10, 500, -70]], [[0, 0, 1]]).commands
        array([[ 10., 500.,  30.]])
        """
        for name, given in (("tips", tips), ("axes", axes)):
            _without_names(name, given)
        zeros = np.zeros((1, len(self.axes)))
        before = zeros if near is None else self._array(near, "near")
        if isinstance(before, np.ndarray) and before.ndim == 1 or _is_row(before):
            before = np.asarray(before)[np.newaxis, :]
        if path and np.shape(before)[:1] not in ((), (1,)):
            message = f"`near` has {len(before)} rows: a path has one place before it"
            raise refuse("array-shape", "near", message, "give the row where the axes stand before the path")
        if path:
            solved = _native.follow(self._native, tips, axes, before)
        else:
            solved = _native.solve(self._native, tips, axes, before, threads)
        commands, within, singular, entries = solved
        found = diagnostics(entries)
        warn(found, 2)
        return Solutions(commands, within, singular, self.axes, self.units, found)

    def _array(self, commands: Any, argument: str = "commands") -> Any:
        """Commands by the names of their columns become an array in the order of the axes."""
        names = getattr(commands, "columns", None)
        if isinstance(commands, Mapping):
            names = list(commands)
        elif isinstance(commands, np.ndarray) and commands.dtype.names:
            names = list(commands.dtype.names)
        if names is None:
            return commands
        axes = self.axes
        unknown = [str(name) for name in names if name not in axes]
        if unknown:
            raise refuse(
                "unknown-axis",
                argument,
                f"the machine has no axis `{unknown[0]}`",
                f"name each column by an axis of the machine, mm and degrees: {', '.join(axes)}",
            )
        if len(names) == 0:
            message = "it has no columns, so that the number of poses is not known"
            raise refuse("array-shape", argument, message, f"name each column by an axis: {', '.join(axes)}")
        masked = [name for name in names if np.ma.isMaskedArray(commands[name])]
        if masked:
            message = f"the column `{masked[0]}` is a masked array, whose mask would be lost"
            raise refuse("array-type", f"{argument}[{masked[0]!r}]", message, "write plain numbers, mm and degrees")
        columns = {str(name): np.asarray(commands[name]) for name in names}
        count = max((np.size(column) for column in columns.values()), default=0)
        texts = [name for name, column in columns.items() if column.dtype.kind not in "iuf"]
        if texts:
            message = f"the column `{texts[0]}` has the type {columns[texts[0]].dtype}"
            raise refuse("array-type", f"{argument}[{texts[0]!r}]", message, "write plain numbers, mm and degrees")
        uneven = [name for name, column in columns.items() if np.shape(column) not in ((), (count,))]
        if uneven:
            message = f"the column `{uneven[0]}` has the shape {np.shape(columns[uneven[0]])}, not ({count},)"
            raise refuse("array-shape", f"{argument}[{uneven[0]!r}]", message, "give every axis as many numbers")
        # By columns, as the library reads them.
        array = np.zeros((count, len(axes)), order="F")
        for name, column in columns.items():
            array[:, axes.index(name)] = column
        return array

    def _sides(self, approach: Any) -> List[float]:
        sides = [0.0] * len(self.axes)
        for word in (text_of(approach) or "").replace(",", " ").split():
            axis, _, side = word.partition("=")
            if axis not in self.axes or side not in ("+", "-"):
                message = f"`{word}` is not an axis of the machine with + or -"
                hint = f'+ rising, - falling: "X=+ C=-"; the axes are {", ".join(self.axes)}'
                raise refuse("bad-approach", "approach", message, hint)
            if sides[self.axes.index(axis)] != 0.0:
                message = f"the axis {axis} is given twice"
                raise refuse("duplicate-axis", "approach", message, "give each axis once")
            sides[self.axes.index(axis)] = 1.0 if side == "+" else -1.0
        return sides


def _is_row(given: Any) -> bool:
    """Whether it is a list of plain numbers."""
    return isinstance(given, (list, tuple)) and bool(given) and all(np.isscalar(entry) for entry in given)


def _without_names(name: str, given: Any) -> None:
    """Refuses a table: its columns would be read in the order in which they stand, whatever their names are."""
    has_names = hasattr(given, "columns") or isinstance(given, Mapping)
    if has_names or isinstance(given, np.ndarray) and given.dtype.names:
        message = f"`{name}` is a table: its columns have names, and x, y, z are read in their order"
        raise refuse("array-type", name, message, "give an array of the shape (n, 3): table[[…]].to_numpy()")


def _unpickled(options: Dict[str, Any], files: Dict[str, bytes]) -> Machine:
    names = ("machine", "tool_length", "tool", "temperature", "temperature_log", "log_time")
    path, *others = (options[name] for name in names)
    return Machine._of(path, files, True, *others)


def not_both(options: Mapping[str, Any], one: str, other: str) -> None:
    """Refuses two options that exclude each other, as the command does."""
    if options.get(one) and options.get(other):
        message = f"`{one}` and `{other}` exclude each other"
        raise refuse("unused-argument", one, message, "leave out one of them")


def needs(options: Mapping[str, Any], one: str, other: str) -> None:
    """Refuses an option that has a meaning only together with another."""
    if options.get(one) and not options.get(other):
        message = f"`{one}` has a meaning only together with `{other}`"
        raise refuse("unused-argument", one, message, f"give `{other}`, too, or leave out `{one}`")
