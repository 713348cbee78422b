"""A machine, and where its tool is at the commands of an array."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._problems import Diagnostic, diagnostics, refuse, warn

if TYPE_CHECKING:
    import pandas

Path = Union[str, "os.PathLike[str]"]
Floats = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]

#: Rows of a result that its text shows, at either end.
_SHOWN = 4


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


class _Rows:
    """A result with one row for each pose."""

    #: What was found in the input: warnings and notes.
    diagnostics: Tuple[Diagnostic, ...]

    def __len__(self) -> int:
        raise NotImplementedError

    def _columns(self) -> Dict[str, npt.NDArray[Any]]:
        raise NotImplementedError

    def to_pandas(self) -> pandas.DataFrame:
        """The result as a table with one row for each pose; the names of its columns end in their units.

        Needs pandas, which is imported only here.
        """
        import pandas

        return pandas.DataFrame(self._columns())

    def to_dict(self) -> Dict[str, List[Any]]:
        """The columns of :meth:`to_pandas` as lists."""
        return {name: column.tolist() for name, column in self._columns().items()}

    def _repr_html_(self) -> str:
        columns = self._columns()
        head = "".join(f"<th>{name}</th>" for name in columns)
        rows = []
        for row in _shown_rows(len(self)):
            cells = "".join(f"<td>{'…' if row is None else _cell(c[row])}</td>" for c in columns.values())
            rows.append(f"<tr><td>{'…' if row is None else row}</td>{cells}</tr>")
        return f"<table><thead><tr><th></th>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


def _cell(value: Any) -> str:
    return str(value) if isinstance(value, (bool, np.bool_)) else f"{value:.6g}"


def _shown_rows(count: int) -> List[Optional[int]]:
    if count <= 2 * _SHOWN + 1:
        return list(range(count))
    return [*range(_SHOWN), None, *range(count - _SHOWN, count)]


def _lines(count: int, line: Any) -> str:
    rows = _shown_rows(count)
    return "\n".join("  …" if row is None else f"  {line(row)}" for row in rows)


def _numbers(row: Iterable[Any], digits: int) -> str:
    # No minus before a zero, as the command writes it.
    return " ".join(f"{round(float(x), digits) + 0.0:.{digits}f}" for x in row)


class Deviations(_Rows):
    """Deviations of the tool, actual − nominal, in the workpiece frame.

    The same as ``trueaxis pose`` prints; with temperatures the comprehensive one, machine − workpiece. Every array has
    the shape (n, 3), columns x, y, z.

    ``tip_mm`` and ``axis`` are views of what the library has written; ``tip_um`` and ``axis_urad`` are computed from
    them at every access.
    """

    def __init__(self, block: Floats, found: Tuple[Diagnostic, ...]) -> None:
        self._block = block
        self.diagnostics = found

    def __len__(self) -> int:
        return int(self._block.shape[1])

    @property
    def tip_mm(self) -> Floats:
        """Deviation of the tip, mm."""
        return self._block[6:9].T

    @property
    def tip_um(self) -> Floats:
        """Deviation of the tip, µm."""
        return self.tip_mm * 1e3

    @property
    def axis(self) -> Floats:
        """Deviation of the unit vector of the tool axis, actual − nominal, without a unit (rad for small angles)."""
        return self._block[9:12].T

    @property
    def axis_urad(self) -> Floats:
        """The same, µrad."""
        return self.axis * 1e6

    def _columns(self) -> Dict[str, npt.NDArray[Any]]:
        um, urad = self.tip_um, self.axis_urad
        return {
            **{f"dev_{c}_um": um[:, i] for i, c in enumerate("xyz")},
            **{f"dev_{c}_urad": urad[:, i] for i, c in enumerate("ijk")},
        }

    def _line(self, row: int) -> str:
        tip, axis = self._block[6:9, row] * 1e3, self._block[9:12, row] * 1e6
        return f"tip {_numbers(tip, 3)} um   axis {_numbers(axis, 3)} urad"

    def __repr__(self) -> str:
        count = len(self)
        return f"<Deviations of {count} {'pose' if count == 1 else 'poses'}>\n{_lines(count, self._line)}"


class Poses(Deviations):
    """Nominal and actual poses of the tool in the workpiece frame.

    Every array has the shape (n, 3). The nominal ones are views of what the library has written; the actual ones are
    computed from nominal + deviation at every access.
    """

    @property
    def nominal_tip_mm(self) -> Floats:
        """The tip as the control commands it, mm."""
        return self._block[0:3].T

    @property
    def nominal_axis(self) -> Floats:
        """The tool axis as the control commands it, from the tip to the spindle, a unit vector."""
        return self._block[3:6].T

    @property
    def actual_tip_mm(self) -> Floats:
        """The tip as the machine with its errors moves it, mm."""
        return self.nominal_tip_mm + self.tip_mm

    @property
    def actual_axis(self) -> Floats:
        """The tool axis as the machine with its errors turns it, a unit vector."""
        return self.nominal_axis + self.axis

    def _columns(self) -> Dict[str, npt.NDArray[Any]]:
        tip, axis = self.nominal_tip_mm, self.nominal_axis
        return {
            **{f"tip_{c}_mm": tip[:, i] for i, c in enumerate("xyz")},
            **{f"axis_{c}": axis[:, i] for i, c in enumerate("ijk")},
            **super()._columns(),
        }

    def _line(self, row: int) -> str:
        return f"tip {_numbers(self._block[0:3, row], 4)} mm   deviation {super()._line(row)}"

    def __repr__(self) -> str:
        count = len(self)
        return f"<Poses: {count}, nominal tip and deviation>\n{_lines(count, self._line)}"


class Errors(_Rows):
    """The value of every error of the machine at each pose, by its ISO 230-1 name.

    Shifts are in µm, angles in µrad: ``units`` has the unit of each name.

    >>> import trueaxis
    >>> machine = trueaxis.Machine.from_text(trueaxis.EXAMPLE)
    >>> found = machine.errors_at([[0, 500, 0]])
    >>> found.names, found.units, found["EC0Y"]
    (('EC0Y',), ('urad',), array([10.]))
    """

    def __init__(
        self, block: Floats, names: Sequence[Tuple[str, str]], found: Tuple[Diagnostic, ...]
    ) -> None:
        self._block = block
        #: The names of the errors in chain order, such as ``EXX``.
        self.names: Tuple[str, ...] = tuple(name for name, _ in names)
        #: The unit of each, ``um`` or ``urad``.
        self.units: Tuple[str, ...] = tuple(unit for _, unit in names)
        self.diagnostics = found

    def __len__(self) -> int:
        return int(self._block.shape[1])

    @property
    def values(self) -> Floats:
        """All errors, of the shape (n, number of errors), µm and µrad; a view of what the library has written."""
        return self._block[:-3].T

    @property
    def workpiece_um(self) -> Floats:
        """How far the material under the nominal tip has moved with the temperature of the workpiece, (n, 3), µm.

        The deviation has the opposite sign: the tool misses by minus that.
        """
        return self._block[-3:].T

    def __getitem__(self, name: str) -> Floats:
        """The values of one error, of the shape (n,), µm or µrad."""
        if name not in self.names:
            raise KeyError(f"the machine has no error {name}; it has {', '.join(self.names)}")
        row: Floats = self._block[self.names.index(name)]
        return row

    def _columns(self) -> Dict[str, npt.NDArray[Any]]:
        columns = {f"{name}_{unit}": self[name] for name, unit in zip(self.names, self.units)}
        if self._block[-3:].any():
            columns.update({f"workpiece_{c}_um": self._block[i - 3] for i, c in enumerate("xyz")})
        return columns

    def __repr__(self) -> str:
        count = len(self)
        named = list(zip(self.names, self.units))[:_SHOWN]
        more = f" … {len(self.names)} errors" if len(self.names) > _SHOWN else ""

        def line(row: int) -> str:
            return " ".join(f"{n} {_numbers([self[n][row]], 3)} {u}" for n, u in named) + more

        return f"<Errors at {count} {'pose' if count == 1 else 'poses'}>\n{_lines(count, line)}"


class Solutions(_Rows):
    """Axis positions that bring the tool of the nominal machine to the tips and axes that were asked for."""

    def __init__(
        self,
        commands: Floats,
        within_limits: Bools,
        singular: Bools,
        axes: Tuple[str, ...],
        units: Tuple[str, ...],
        found: Tuple[Diagnostic, ...],
    ) -> None:
        #: The axis positions, of the shape (n, number of axes), mm and degrees; as :meth:`Machine.deviation` takes them.
        self.commands = commands
        #: Whether all axes stay within their travel, of the shape (n,).
        self.within_limits = within_limits
        #: Whether a rotary axis has no effect there and has kept its angle, of the shape (n,).
        self.singular = singular
        #: The names of the axes.
        self.axes = axes
        self._units = units
        self.diagnostics = found

    def __len__(self) -> int:
        return len(self.commands)

    def _columns(self) -> Dict[str, npt.NDArray[Any]]:
        named = zip(self.axes, self._units)
        columns: Dict[str, npt.NDArray[Any]] = {
            f"{axis}_{unit}": self.commands[:, i] for i, (axis, unit) in enumerate(named)
        }
        return {**columns, "within_limits": self.within_limits, "singular": self.singular}

    def __repr__(self) -> str:
        def line(row: int) -> str:
            values = zip(self.axes, self.commands[row], self._units)
            return " ".join(f"{axis} {_numbers([value], 4)} {unit}" for axis, value, unit in values)

        return f"<Solutions: {len(self)}>\n{_lines(len(self), line)}"


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
        block, found = self._deviations(commands, approach, threads, out)
        return Deviations(block, found)

    def pose(
        self,
        commands: npt.ArrayLike,
        *,
        approach: Union[str, Mapping[str, str], None] = None,
        threads: Optional[int] = None,
        out: Optional[Deviations] = None,
    ) -> Poses:
        """Nominal and actual poses of the tool in the workpiece frame (mm; unit vectors), with their deviations.

        Arguments as of :meth:`deviation`; the work is the same.

        >>> import trueaxis
        >>> machine = trueaxis.Machine.from_text(trueaxis.EXAMPLE)
        >>> machine.pose([[10, 500, 30]]).nominal_tip_mm
        array([[ 10., 500., -70.]])
        """
        block, found = self._deviations(commands, approach, threads, out)
        return Poses(block, found)

    def _deviations(
        self, commands: Any, approach: Any, threads: Optional[int], out: Optional[Deviations]
    ) -> Tuple[Floats, Tuple[Diagnostic, ...]]:
        array, sides = self._array(commands), self._sides(approach)
        block = None if out is None else out._block
        if block is not None and block.shape[1] != len(array):
            shape = f"`out` has {block.shape[1]} poses, the commands {len(array)}"
            raise refuse("array-shape", "out", shape, "give a result of as many poses, or none")
        block, entries = _native.deviations(self._native, array, sides, threads, block)
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
        zeros = np.zeros((1, len(self.axes)))
        before = zeros if near is None else self._array(near)
        if isinstance(before, (list, tuple, np.ndarray)) and np.ndim(before) == 1:
            before = np.asarray(before)[np.newaxis, :]
        if path:
            solved = _native.follow(self._native, tips, axes, before)
        else:
            solved = _native.solve(self._native, tips, axes, before, threads)
        commands, within, singular, entries = solved
        found = diagnostics(entries)
        warn(found, 2)
        return Solutions(commands, within, singular, self.axes, self.units, found)

    def _array(self, commands: Any) -> Any:
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
                "commands",
                f"the machine has no axis `{unknown[0]}`",
                f"name each column by an axis of the machine, mm and degrees: {', '.join(axes)}",
            )
        columns = {str(name): np.asarray(commands[name]) for name in names}
        count = max((np.size(column) for column in columns.values()), default=0)
        texts = [name for name, column in columns.items() if column.dtype.kind not in "iuf"]
        if texts:
            message = f"the column `{texts[0]}` has the type {columns[texts[0]].dtype}"
            raise refuse("array-type", f"commands[{texts[0]!r}]", message, "write plain numbers, mm and degrees")
        uneven = [name for name, column in columns.items() if np.shape(column) not in ((), (count,))]
        if uneven:
            message = f"the column `{uneven[0]}` has the shape {np.shape(columns[uneven[0]])}, not ({count},)"
            raise refuse("array-shape", f"commands[{uneven[0]!r}]", message, "give every axis as many numbers")
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
            sides[self.axes.index(axis)] = 1.0 if side == "+" else -1.0
        return sides


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
