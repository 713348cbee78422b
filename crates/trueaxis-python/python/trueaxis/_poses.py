"""What a machine says of the commands of an array: deviations, poses, errors, solutions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from ._problems import Diagnostic

if TYPE_CHECKING:
    import pandas

Floats = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]

#: Rows of a result that its text shows, at either end.
_SHOWN = 4


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
        return self._block[-6:-3].T

    @property
    def tip_um(self) -> Floats:
        """Deviation of the tip, µm."""
        return self.tip_mm * 1e3

    @property
    def axis(self) -> Floats:
        """Deviation of the unit vector of the tool axis, actual − nominal, without a unit (rad for small angles)."""
        return self._block[-3:].T

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
        tip, axis = self._block[-6:-3, row] * 1e3, self._block[-3:, row] * 1e6
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
