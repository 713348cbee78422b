"""What a verb answers: the document, the table, the text, the page."""

from __future__ import annotations

import html
import json
from typing import TYPE_CHECKING, Any, Dict, Generic, Iterator, List, Mapping, Optional, Tuple, TypeVar

from . import _native
from ._problems import Diagnostic, diagnostics

if TYPE_CHECKING:
    import pandas

D = TypeVar("D", covariant=True)


class Record(Mapping[str, Any]):
    """An object of a document: its keys are attributes, and items too.

    >>> record = Record({"tip_um": [1.0, 2.0], "axis": {"name": "X"}})
    >>> record.axis.name, record["tip_um"], list(record)
    ('X', [1.0, 2.0], ['tip_um', 'axis'])
    """

    __slots__ = ("_entries",)

    def __init__(self, entries: Dict[str, Any]) -> None:
        self._entries = entries

    def __getattr__(self, name: str) -> Any:
        # While it is unpickled there is nothing yet.
        if name.startswith("__") or name == "_entries":
            raise AttributeError(name)
        if name not in self._entries:
            raise AttributeError(f"no entry `{name}`; there are {', '.join(self._entries)}")
        return _wrapped(self._entries[name])

    def __getitem__(self, name: str) -> Any:
        return _wrapped(self._entries[name])

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._entries]

    def __repr__(self) -> str:
        return f"Record({self._entries!r})"

    def __reduce__(self) -> Tuple[Any, Tuple[Dict[str, Any]]]:
        return (Record, (self._entries,))

    def to_dict(self) -> Dict[str, Any]:
        """The object as a dictionary."""
        return self._entries


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list):
        return [_wrapped(entry) for entry in value]
    return value


class Answer(Generic[D]):
    """The answer of a verb: what the command says, for programs and for readers.

    The entries of its document are attributes: ``answer.verdict`` is ``answer.document.verdict``. Names end in their
    unit (``_mm``, ``_um``, ``_urad``, ``_s``); ``trueaxis schema NAME`` of the command describes each.
    """

    def __init__(self, native: _native.Answer) -> None:
        self._native = native
        self._document: Optional[Dict[str, Any]] = None
        #: What was found in the input: warnings and notes.
        self.diagnostics: Tuple[Diagnostic, ...] = diagnostics(native.diagnostics)

    @property
    def is_yes(self) -> bool:
        """Whether the verdict is "yes" (in tolerance, proved, …); also where there is no verdict.

        The command ends with the status 1 where it is False.
        """
        return self._native.is_yes

    @property
    def in_spite_of_errors(self) -> Optional[str]:
        """How the work ended where it went on in spite of errors (``keep_going``), which stand in ``diagnostics``."""
        return self._native.in_spite_of_errors

    @property
    def written(self) -> List[str]:
        """The files that were written."""
        return self._native.written

    @property
    def notes(self) -> List[str]:
        """What to do with the files that were written."""
        return self._native.notes

    @property
    def text(self) -> str:
        """What the command prints."""
        return self._native.text()

    @property
    def page(self) -> str:
        """The report as one HTML page that opens offline: what the command writes with ``--report``."""
        return self._native.page()

    @property
    def pictures(self) -> List[str]:
        """The pictures of the report, SVG."""
        return self._native.pictures()

    def to_dict(self) -> Dict[str, Any]:
        """The document: what the command prints with ``--format json``."""
        if self._document is None:
            document = json.loads(self._native.json())
            self._document = document if isinstance(document, dict) else {"entries": document}
        return self._document

    @property
    def document(self) -> D:
        """The document with its entries as attributes."""
        record: Any = Record(self.to_dict())
        return record  # type: ignore[no-any-return]

    @property
    def tables(self) -> Dict[str, List[Dict[str, Any]]]:
        """The lists of objects in the document, by their place in it, such as ``verdict.indices``."""
        found: Dict[str, List[Dict[str, Any]]] = {}
        _find_tables(self.to_dict(), "", found)
        return found

    def to_pandas(self, table: Optional[str] = None) -> pandas.DataFrame:
        """A table of the document as a DataFrame, one of :attr:`tables`; without a name the first.

        A list of three numbers becomes three columns, ``tip_um`` for example ``tip_um_x``, ``tip_um_y``, ``tip_um_z``.
        Needs pandas, which is imported only here.
        """
        import pandas

        tables = self.tables
        if not tables:
            raise ValueError(f"the document {self.to_dict().get('schema')} has no table")
        name = next(iter(tables)) if table is None else table
        if name not in tables:
            raise KeyError(f"there is no table {name}; there are {', '.join(tables)}")
        return pandas.DataFrame([_flat(row) for row in tables[name]])

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(Record(self.to_dict()), name)

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self.to_dict()]

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.to_dict().get('schema', '')}: {'yes' if self.is_yes else 'no'}>"

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        # The page has its own style, which must not reach the notebook.
        page = html.escape(self.page, quote=True)
        style = "width: 100%; height: 40em; border: 0"
        return f'<iframe srcdoc="{page}" sandbox="allow-scripts" style="{style}"></iframe>'


def _find_tables(value: Any, place: str, found: Dict[str, List[Dict[str, Any]]]) -> None:
    if isinstance(value, dict):
        for name, entry in value.items():
            if name != "diagnostics":
                _find_tables(entry, f"{place}.{name}" if place else name, found)
    elif isinstance(value, list) and value and all(isinstance(entry, dict) for entry in value):
        found[place] = value


def _flat(row: Mapping[str, Any], before: str = "") -> Dict[str, Any]:
    flat: Dict[str, Any] = {}
    for name, value in row.items():
        key = before + name
        if isinstance(value, dict):
            flat.update(_flat(value, f"{key}."))
        elif isinstance(value, list) and len(value) == 3 and all(isinstance(x, (int, float)) for x in value):
            flat.update({f"{key}_{c}": x for c, x in zip("xyz", value)})
        else:
            flat[key] = value
    return flat
