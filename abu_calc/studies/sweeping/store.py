"""The members of a sweep in a file of SQLite, as they come: what is committed outlives whatever ends the process.

`members`: a row for each, by its number, nothing in it that depends on how it was computed. `columns`: their units and
meaning. `runs`: who computed when, with what; `study`: what is computed. Of one study only, see `differences`.
"""

import json
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.errors import InputError, OutputError, Place
from abu_calc.studies.sweeping.columns import MEMBER, REASON, Column

Identity = Mapping[str, Any]

FORMAT: Final = 1
BLOCK: Final = 4096
"""Members that are looked at together."""
SHOWN: Final = 6
"""Differences that are named."""
RUN_COLUMNS: Final = (
    "run INTEGER PRIMARY KEY, file TEXT, sha256 TEXT, versions TEXT, seed INTEGER, command TEXT, workers TEXT, "
    "started TEXT, ended TEXT, members_before INTEGER, members_after INTEGER"
)


class Store:
    """One file, open; `names`: the columns of its members, in their order."""

    def __init__(self, path: Path, database: sqlite3.Connection, names: tuple[str, ...], runs: int) -> None:
        self.path, self.names, self.runs, self._database = path, names, runs, database
        self.drawn = runs
        """Members below were drawn each for itself; the others of Saltelli's design repeat their values."""
        marks = ", ".join("?" * len(names))
        self._insert = f"INSERT OR IGNORE INTO members VALUES ({marks})"

    @classmethod
    def open(cls, path: Path, identity: Identity, columns: Sequence[Column], texts: frozenset[str], runs: int) -> Self:
        """A new store, or one of the same study that goes on. Raises InputError with the differences of another."""
        names = tuple(column.name for column in columns)
        try:
            database = sqlite3.connect(path, isolation_level=None, timeout=30)
            if database.execute("PRAGMA journal_mode=WAL").fetchone()[0] not in ("wal", "memory"):
                database.execute("PRAGMA journal_mode=DELETE")  # file systems without shared memory
            database.execute("PRAGMA synchronous=NORMAL")
            if found := _study(database):
                _refuse_another(path, found, identity)
            else:
                _create(database, identity, columns, texts)
        except sqlite3.Error as error:
            raise OutputError(f"{path} cannot be used as a store: {error}", remedy="Name another file.") from None
        return cls(path, database, names, runs)

    def put(self, rows: Sequence[Sequence[object]]) -> None:
        """Members, all of them or none; one that is there already stays."""
        self._begin()
        self._database.executemany(self._insert, rows)
        self._database.execute("COMMIT")

    def begun(self, facts: Mapping[str, Any]) -> int:
        """Notes who computes; returns the number of this run of the program."""
        given = {"started": _now(), "members_before": self.done, **facts}
        marks = ", ".join("?" * len(given))
        cursor = self._database.execute(
            f"INSERT INTO runs ({', '.join(given)}) VALUES ({marks})", tuple(given.values())
        )
        return int(cursor.lastrowid or 0)

    def ended(self, run: int) -> None:
        """Notes that it is over."""
        self._database.execute("UPDATE runs SET ended = ?, members_after = ? WHERE run = ?", (_now(), self.done, run))

    @property
    def done(self) -> int:
        """How many members are there."""
        return int(self._database.execute("SELECT COUNT(*) FROM members").fetchone()[0])

    def missing(self) -> Iterator[int]:
        """Numbers of members that are not there, looked for as they are asked for."""
        for first in range(0, self.runs, BLOCK):
            last = min(first + BLOCK, self.runs)
            rows = self._database.execute("SELECT member FROM members WHERE member >= ? AND member < ?", (first, last))
            there = {row[0] for row in rows}
            yield from (member for member in range(first, last) if member not in there)

    def ask(self, query: str, values: tuple[object, ...] = ()) -> Iterator[tuple[Any, ...]]:
        """Rows of any question."""
        return self._database.execute(query, values)

    def column(self, name: str) -> NDArray[Any]:
        """One column of all members, in their order; NaN where a number is missing."""
        values = [row[0] for row in self.ask(f"SELECT {quoted(name)} FROM members ORDER BY member")]
        if any(isinstance(value, str) for value in values):
            return np.array(values, dtype=object)
        return np.array([np.nan if value is None else value for value in values], dtype=float)

    def close(self) -> None:
        """The file stays; beside it nothing."""
        with suppress(sqlite3.Error):
            self._database.close()

    def _begin(self) -> None:
        self._database.execute("BEGIN IMMEDIATE")


def quoted(name: str) -> str:
    """A column's name as SQL takes it.

    >>> quoted("wheel.mass_kg")
    '"wheel.mass_kg"'
    """
    return '"' + name.replace('"', '""') + '"'


def study_of(path: Path) -> dict[str, Any] | None:
    """What a store computes; None where there is no store, or an empty one."""
    if not path.exists():
        return None
    try:
        database = sqlite3.connect(path, timeout=30)
        try:
            return _study(database)
        finally:
            database.close()
    except sqlite3.Error as error:
        raise InputError(f"{path} is no store of a sweep: {error}", place=Place(key="store")) from None


def _study(database: sqlite3.Connection) -> dict[str, Any] | None:
    tables = {row[0] for row in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
    if not tables:
        return None
    if not {"members", "runs", "study"} <= tables:
        raise sqlite3.DatabaseError("it holds other tables")
    found = dict(database.execute("SELECT key, value FROM study"))
    return {key: json.loads(value) for key, value in found.items()}


def _create(database: sqlite3.Connection, identity: Identity, columns: Sequence[Column], texts: frozenset[str]) -> None:
    """All tables at once: a process that ends meanwhile leaves an empty file."""
    kinds = {MEMBER.name: "INTEGER PRIMARY KEY", REASON.name: "TEXT"}
    declared = ", ".join(
        f"{quoted(one.name)} {kinds.get(one.name, 'TEXT' if one.name in texts else 'NUMERIC')}" for one in columns
    )
    database.execute("BEGIN IMMEDIATE")
    database.execute(f"CREATE TABLE members ({declared})")
    database.execute("CREATE TABLE columns (name TEXT PRIMARY KEY, unit TEXT, meaning TEXT)")
    database.execute(f"CREATE TABLE runs ({RUN_COLUMNS})")
    database.execute("CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT)")
    database.executemany("INSERT INTO columns VALUES (?, ?, ?)", [(one.name, one.unit, one.meaning) for one in columns])
    stored = {"format": FORMAT, **identity}
    pairs = [(key, json.dumps(value, sort_keys=True)) for key, value in stored.items()]
    database.executemany("INSERT INTO study VALUES (?, ?)", pairs)
    database.execute("COMMIT")


def _refuse_another(path: Path, found: Mapping[str, Any], wanted: Identity) -> None:
    differing = differences(found, json.loads(json.dumps({"format": FORMAT, **wanted})))
    if differing:
        more = f", and {len(differing) - SHOWN} more" if len(differing) > SHOWN else ""
        raise InputError(
            f"{path} holds another study: {'; '.join(differing[:SHOWN])}{more}",
            place=Place(key="store"),
            remedy="Go on with the file, version and options it was begun with, or name another store.",
        )


def differences(found: object, wanted: object, path: str = "") -> list[str]:
    """Where two studies differ, in words.

    >>> differences({"machine": {"mass_kg": 5.6}}, {"machine": {"mass_kg": 5.7}})
    ['machine.mass_kg is 5.6 there and 5.7 here']
    """
    if isinstance(found, Mapping) and isinstance(wanted, Mapping):
        return [
            text
            for key in dict.fromkeys((*found, *wanted))
            for text in differences(found.get(key), wanted.get(key), f"{path}.{key}" if path else str(key))
        ]
    return [] if found == wanted else [f"{path} is {_short(found)} there and {_short(wanted)} here"]


def _short(value: object) -> str:
    text = "none" if value is None else str(value)
    return text if len(text) <= 60 else text[:59] + "…"


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")
