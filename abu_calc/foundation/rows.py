"""Tables of results: rows to go through, and columns for pandas, Polars and everything else that reads Arrow.

    for check in result.checks: …                 rows, as they are
    result.checks.to_pandas()                     a pandas.DataFrame; likewise pandas.DataFrame(result.checks.rows)
    polars.DataFrame(result.members)              by the Arrow PyCapsule interface, as pandas.DataFrame.from_arrow does
    result.checks.to_dict("list")                 columns as lists, by name

No library of tables is imported unless `to_pandas` asks for it.
"""

import importlib
import math
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, is_dataclass
from html import escape
from itertools import islice
from typing import TYPE_CHECKING, Any, Final, Generic, Literal, TypeVar, overload

from abu_calc.foundation.errors import InputError, OutputError, Place

if TYPE_CHECKING:
    from pandas import DataFrame

Row = TypeVar("Row", covariant=True)

SHOWN: Final = 20
"""Rows of a table that a notebook shows."""
ARROW_LIBRARIES: Final = {"pyarrow": "table", "polars": "DataFrame"}
"""Libraries that make an Arrow stream of columns; one of them is there when somebody wants a stream."""
ORIENTATIONS: Final = ("list", "records")


class Columns:
    """A table by its columns: whoever derives from it gives `columns`."""

    __slots__ = ()

    @property
    def columns(self) -> Mapping[str, Any]:
        """Values of each column by its name, which ends in the unit."""
        raise NotImplementedError

    @property
    def rows(self) -> list[dict[str, Any]]:
        """Each row as a dictionary by column."""
        columns = {name: _listed(values) for name, values in self.columns.items()}
        return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]

    def to_dict(self, orientation: Literal["list", "records"] = "list") -> Any:
        """Columns as lists by name, or with "records" a dictionary for each row. Raises InputError for other words."""
        if orientation not in ORIENTATIONS:
            raise InputError(
                "not a form of a table", place=Place(key="orientation"), found=str(orientation),
                allowed=", ".join(ORIENTATIONS),
            )  # fmt: skip
        if orientation == "records":
            return self.rows
        return {name: _listed(values) for name, values in self.columns.items()}

    def to_pandas(self) -> "DataFrame":
        """A pandas.DataFrame. Raises OutputError if pandas is not installed."""
        try:
            from pandas import DataFrame
        except ImportError:
            raise OutputError(
                "a DataFrame needs the package pandas, which is not installed", remedy="Install it: pip install pandas"
            ) from None
        return DataFrame(self.to_dict("list"))

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The columns as an Arrow stream, made by the library that asks for it. Raises OutputError without one."""
        columns = {name: _arrow_values(_listed(values)) for name, values in self.columns.items()}
        for library, kind in sorted(ARROW_LIBRARIES.items(), key=lambda pair: pair[0] not in sys.modules):
            try:
                table = getattr(importlib.import_module(library), kind)(columns)
            except ImportError:
                continue
            return table.__arrow_c_stream__(requested_schema)
        raise OutputError(
            "an Arrow stream needs pyarrow or polars, which are not installed", remedy="Install one: pip install polars"
        )

    def _repr_html_(self) -> str:
        columns = self.columns
        head = "".join(f"<th>{escape(name)}</th>" for name in columns)
        body = [
            f"<tr>{''.join(f'<td>{escape(_cell(value))}</td>' for value in row)}</tr>"
            for row in islice(zip(*columns.values(), strict=True), SHOWN)
        ]
        left = max((len(values) for values in columns.values()), default=0) - len(body)
        more = f"<p>and {left} more</p>" if left else ""
        return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(body)}</tbody></table>{more}"


class Rows(Columns, Generic[Row]):
    """Records of a result in their order: a sequence that cannot be changed, and a table.

    Columns are the entries of the records; those of a record within have both names, with a point between. It is no
    tuple, since readers of Arrow take sequences apart; it equals a tuple of the same records.
    """

    __slots__ = ("_records",)

    def __init__(self, records: Iterable[Row] = ()) -> None:
        self._records = tuple(records)

    @overload
    def __getitem__(self, index: int) -> Row: ...

    @overload
    def __getitem__(self, index: slice) -> "Rows[Row]": ...

    def __getitem__(self, index: int | slice) -> "Row | Rows[Row]":
        return Rows(self._records[index]) if isinstance(index, slice) else self._records[index]

    def __len__(self) -> int:
        return len(self._records)

    def __iter__(self) -> Iterator[Row]:
        return iter(self._records)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Rows):
            return bool(self._records == other._records)
        return self._records == other if isinstance(other, tuple) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._records)

    def index(self, record: object) -> int:
        """The place of a record. Raises ValueError if it is not there."""
        return self._records.index(record)

    def count(self, record: object) -> int:
        """Times that a record is there."""
        return self._records.count(record)

    def __add__(self, other: Iterable[Any]) -> tuple[Any, ...]:
        return (*self._records, *other)

    def __mul__(self, times: int) -> "Rows[Row]":
        return Rows(self._records * times)

    def __radd__(self, other: Iterable[Any]) -> tuple[Any, ...]:
        return (*other, *self._records)

    @property
    def columns(self) -> dict[str, list[Any]]:
        """Values of each column by its name; None where a row has no such entry."""
        rows = [dict(_flat(_entries(row))) for row in self]
        names = dict.fromkeys(name for row in rows for name in row)
        return {name: [row.get(name) for row in rows] for name in names}

    def __repr__(self) -> str:
        kind = type(self[0]).__name__ if self else "row"
        return f"<{len(self)} × {kind}>"


def as_rows(value: Any) -> Any:
    """A tuple of records as a table; anything else as it is."""
    if type(value) is tuple and value and is_dataclass(value[0]):
        return Rows(value)
    return value


def _entries(row: Any) -> Mapping[str, Any]:
    """Entries of a record as its JSON has them."""
    if isinstance(row, Mapping):
        return row
    entries: Mapping[str, Any] = row.to_dict() if hasattr(row, "to_dict") else asdict(row)
    return entries


def _flat(entries: Mapping[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in entries.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{before}{name}.")
        else:
            yield f"{before}{name}", list(value) if isinstance(value, tuple) else value


def _listed(values: Any) -> list[Any]:
    """A column as a list of Python's own numbers; arrays of NumPy have a way for that."""
    listed: list[Any] = values.tolist() if hasattr(values, "tolist") else list(values)
    return listed


def _arrow_values(values: list[Any]) -> list[Any]:
    """A column of one type: numbers and truth values as they are, NaN as missing, what is mixed as JSON text."""
    values = [None if isinstance(value, float) and math.isnan(value) else value for value in values]
    kinds = {type(value) for value in values if value is not None}
    if kinds <= {int, float}:
        return [float(value) if value is not None and float in kinds else value for value in values]
    if len(kinds) == 1 and kinds <= {bool, str}:
        return values
    return [value if value is None or isinstance(value, str) else _json(value) for value in values]


def _json(value: object) -> str:
    import json

    return json.dumps(value, ensure_ascii=False, default=str)


def _cell(value: object) -> str:
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)
