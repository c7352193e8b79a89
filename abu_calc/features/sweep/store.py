"""Store of a sweep's samples: an SQLite file whose committed rows outlive whatever ends the process.

`members`: a row for each sample, by its number, nothing in it that depends on how it was computed. `checksums`: of each
row. `columns`: their units and meaning. `study`: the computed study. `runs`: each run of the program, with the software
of its workers; `batches`: which samples each of them computed. A store is of one study only, see `differences`.
"""

import json
import sqlite3
import time
import zlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final, Self
from urllib.parse import quote
from uuid import uuid4

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.sweep.batches import MEMBER, OUTSIDE, OVERTIME, REASON, SampleColumn
from abu_calc.features.sweep.store_faults import PLACE, damaged, fault, faults_of, refuse_foreign
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.text import shown_short

Identity = Mapping[str, Any]

FORMAT: Final = 2
BLOCK: Final = 4096
"""Members that are looked at together."""
SHOWN: Final = 6
"""Differences that are named."""
PATIENCE_S: Final = 30.0
"""Seconds to wait for another program that keeps the store locked."""
OWN: Final = "store"
"""Key of the study under which the store's own mark stands: one that is made anew in its place has another."""
TABLES: Final = {
    "columns": "name TEXT PRIMARY KEY, unit TEXT, meaning TEXT",
    "runs": (
        "run INTEGER PRIMARY KEY, file TEXT, sha256 TEXT, versions TEXT, seed INTEGER, command TEXT, workers TEXT, "
        "started TEXT, ended TEXT, members_before INTEGER, members_after INTEGER, software_of_workers TEXT"
    ),
    "batches": "run INTEGER, worker TEXT, first INTEGER, last INTEGER",
    "checksums": "member INTEGER PRIMARY KEY, checksum INTEGER",
    "study": "key TEXT PRIMARY KEY, value TEXT",
}
"""Tables beside `members`, whose columns are those of the study."""


class Store:
    """One file, open; `names`: the columns of its members, in their order."""

    def __init__(
        self, path: Path, database: sqlite3.Connection, names: tuple[str, ...], runs: int, time_limit: float = 0.0
    ) -> None:
        self.path, self.names, self.runs, self._database = path, names, runs, database
        self.drawn = runs
        """Members below were drawn each for itself; the others of Saltelli's design repeat their values."""
        self._again = _again(time_limit)
        marks = ", ".join("?" * len(names))
        new = ", ".join(f"{quoted(name)} = excluded.{quoted(name)}" for name in names[1:])
        self._insert = (
            f"INSERT INTO members VALUES ({marks}) ON CONFLICT (member) DO UPDATE SET {new} WHERE {self._again}"
        )
        self._run, self._software = 0, dict[str, Mapping[str, str]]()
        self._mark, self._stamps = "", tuple[tuple[int, int], ...]()

    @classmethod
    def open(
        cls, path: Path, identity: Identity, columns: Sequence[SampleColumn], texts: frozenset[str],
        *, force: bool = False, time_limit: float = 0.0,
    ) -> Self:  # fmt: skip
        """A new store, or one of the same study that goes on; `force`: in the place of whatever study is there.

        Members that took longer than a shorter `time_limit` [s] are missing. Raises InputError with the differences of
        another study, OutputError for a file that cannot be one or is in use.
        """
        names, runs = tuple(column.name for column in columns), int(identity["runs"])
        with faults_of(path):
            database = connected(path, create=True)
            try:
                if force:
                    _clear(path, database)
                _study(path, database)  # nothing of a foreign file is changed
                _into_wal(database)
                database.execute("PRAGMA synchronous=NORMAL")
                schema = _schema(columns, texts)
                database.execute("BEGIN IMMEDIATE")  # of several that begin it, one makes the tables
                there = _study(path, database)
                if there is None:
                    _create(database, identity, columns, schema)
                database.execute("COMMIT")
                if there is not None:
                    _refuse_another(path, there, identity)
                    _verify(path, database, columns, schema, runs)
                store = cls(path, database, names, runs, time_limit)
                (store._mark,) = database.execute("SELECT value FROM study WHERE key = ?", (OWN,)).fetchone()
            except BaseException:
                database.close()
                raise
        return store

    def put(
        self, rows: Sequence[Sequence[object]], worker: str = "", software: Mapping[str, str] | None = None
    ) -> None:
        """Members, all of them or none; one that is there already stays, unless it was to be tried again.

        `worker`: who computed them, with which software.
        """
        with faults_of(self.path):
            self._database.execute("BEGIN IMMEDIATE")
            try:
                mark = self._database.execute("SELECT value FROM study WHERE key = ?", (OWN,)).fetchone()
                if mark != (self._mark,):
                    raise self._taken_away()
                self._database.executemany(self._insert, rows)
                numbers = sorted(int(str(row[0])) for row in rows)
                for first, last in _stretches(numbers):
                    self._sum_up(first, last)
                    self._database.execute("INSERT INTO batches VALUES (?, ?, ?, ?)", (self._run, worker, first, last))
                if software is not None and self._software.get(worker) != software:
                    self._software[worker] = software
                    self._note("software_of_workers", json.dumps(self._software))
                self._database.execute("COMMIT")
            except BaseException:
                with suppress(sqlite3.Error):
                    self._database.execute("ROLLBACK")
                raise
            self._check_there()

    def begun(self, facts: Mapping[str, Any]) -> int:
        """Note who computes; returns the number of this run of the program."""
        with faults_of(self.path):
            given = {"started": _now(), "members_before": self.done, **facts}
            marks = ", ".join("?" * len(given))
            cursor = self._database.execute(
                f"INSERT INTO runs ({', '.join(given)}) VALUES ({marks})", tuple(given.values())
            )
            self._run, self._stamps = int(cursor.lastrowid or 0), self._stamped()
        return self._run

    def ended(self) -> None:
        """Note that the run is over."""
        with faults_of(self.path):
            self._note("ended", _now())
            self._note("members_after", self.done)
            self._check_there()

    @property
    def done(self) -> int:
        """Number of samples in the store, without those to be tried again."""
        return int(self.ask(f"SELECT COUNT(*) FROM members WHERE NOT {self._again}")[0][0])

    def missing(self) -> Iterator[int]:
        """Numbers of members that are not there or are tried again, looked for as they are asked for."""
        for first in range(0, self.runs, BLOCK):
            last = min(first + BLOCK, self.runs)
            query = f"SELECT member FROM members WHERE member >= ? AND member < ? AND NOT {self._again}"
            there = {row[0] for row in self.ask(query, (first, last))}
            yield from (member for member in range(first, last) if member not in there)

    def ask(self, query: str, values: tuple[object, ...] = ()) -> list[tuple[Any, ...]]:
        """Rows of any question."""
        with faults_of(self.path):
            return self._database.execute(query, values).fetchall()

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

    def _sum_up(self, first: int, last: int) -> None:
        rows = self._database.execute("SELECT * FROM members WHERE member >= ? AND member <= ?", (first, last))
        sums = [(row[0], checksum(row)) for row in rows]
        self._database.executemany("INSERT OR REPLACE INTO checksums VALUES (?, ?)", sums)

    def _note(self, column: str, value: object) -> None:
        self._database.execute(f"UPDATE runs SET {column} = ? WHERE run = ?", (value, self._run))

    def _stamped(self) -> tuple[tuple[int, int], ...]:
        """Device and number of the files: the database, and the log that SQLite writes first."""
        beside = Path(f"{self.path.resolve()}-wal")
        stats = [path.stat() for path in (self.path, *([beside] if beside.exists() else []))]
        return tuple((each.st_dev, each.st_ino) for each in stats)

    def _check_there(self) -> None:
        """Raise OutputError if the file of that name is another than the one that was written to."""
        try:
            same = self._stamped() == self._stamps
        except OSError:
            same = False
        if not same:
            raise self._taken_away()

    def _taken_away(self) -> Exception:
        return fault(
            self.path,
            "the store was removed or replaced during the run; members computed since are lost",
            "Put it back and go on with --resume, or begin anew.",
        )


def quoted(name: str) -> str:
    """A column's name as SQL takes it.

    >>> quoted("wheel.mass_kg")
    '"wheel.mass_kg"'
    """
    return '"' + name.replace('"', '""') + '"'


def checksum(row: Sequence[object]) -> int:
    """Checksum of a row as it is read; 5 and 5.0 are alike, since SQLite keeps them alike.

    >>> checksum((0, 5.0, None)) == checksum((0, 5, None)) != checksum((0, 5.5, None))
    True
    """
    return zlib.crc32(repr([float(each) if isinstance(each, int) else each for each in row]).encode())


def connected(path: Path, *, create: bool = False) -> sqlite3.Connection:
    """A connection to a store; without `create` to one that is there."""
    name = path.absolute().as_posix()
    authority = "//" if name.startswith("//") else ""  # SQLite takes that of a Windows share for another host
    address = f"file:{authority}{quote(name)}?mode={'rwc' if create else 'rw'}"
    return sqlite3.connect(address, isolation_level=None, timeout=PATIENCE_S, uri=True)


def study_of(path: Path) -> dict[str, Any] | None:
    """The study of a store; None if there is no store, or an empty one."""
    if not path.exists():
        return None
    with faults_of(path):
        database = connected(path)
        try:
            return _study(path, database, alone=True)
        finally:
            database.close()


def _study(path: Path, database: sqlite3.Connection, *, alone: bool = False) -> dict[str, Any] | None:
    """The study in a database; `alone`: no other is known with which it will be compared, so it must be proven."""
    tables = _tables(database)
    if not tables:
        return None
    refuse_foreign(path, tables)
    pairs = dict(database.execute("SELECT key, value FROM study"))
    own = pairs.pop(OWN, "null")
    study = {key: json.loads(value) for key, value in pairs.items()}
    if study.get("format") != FORMAT:
        raise fault(
            path,
            f"its form is {study.get('format')}, this version of abu-calc writes {FORMAT}",
            "Go on with the version it was begun with, or name another store.",
        )
    if alone and json.loads(own)[1] != _sum_of(list(pairs.items())):
        raise damaged(path, "its study is not what was stored")
    return study


def _tables(database: sqlite3.Connection) -> set[str]:
    return {row[0] for row in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}


def _clear(path: Path, database: sqlite3.Connection) -> None:
    """Take out all tables, if no other process has the store open; the file stays, so none writes into a lost one."""
    if tables := _tables(database):
        refuse_foreign(path, tables)
    try:
        database.execute("PRAGMA busy_timeout = 1000")
        database.execute("PRAGMA locking_mode = EXCLUSIVE")
        database.execute("PRAGMA journal_mode = DELETE")  # which SQLite does only if it is alone
        database.execute("BEGIN EXCLUSIVE")
    except sqlite3.OperationalError as error:
        if getattr(error, "sqlite_errorname", "").startswith("SQLITE_BUSY"):
            remedy = "End that process first, or name another store."
            raise fault(path, "another process has it open, so --force does not overwrite it", remedy) from None
        raise
    kinds = "SELECT type, name FROM sqlite_master WHERE type IN ('table', 'view')"
    for kind, name in database.execute(kinds).fetchall():
        if not name.startswith("sqlite_"):
            database.execute(f"DROP {kind} IF EXISTS {quoted(name)}")
    database.execute("COMMIT")
    database.execute("PRAGMA locking_mode = NORMAL")
    database.execute("SELECT COUNT(*) FROM sqlite_master").fetchall()  # which lets go of the lock
    database.execute(f"PRAGMA busy_timeout = {round(1000 * PATIENCE_S)}")


def _into_wal(database: sqlite3.Connection) -> None:
    """Write ahead, so that readers and writers go along; the change itself SQLite refuses while others begin, too."""
    until = time.monotonic() + PATIENCE_S
    while True:
        try:
            if database.execute("PRAGMA journal_mode=WAL").fetchone()[0] != "wal":
                database.execute("PRAGMA journal_mode=DELETE")  # file systems without shared memory
        except sqlite3.OperationalError as error:
            if not getattr(error, "sqlite_errorname", "").startswith("SQLITE_BUSY") or time.monotonic() > until:
                raise
            time.sleep(0.05)
        else:
            return


def _schema(columns: Sequence[SampleColumn], texts: frozenset[str]) -> dict[str, str]:
    """The statement that makes each table, as SQLite keeps it."""
    kinds = {MEMBER.name: "INTEGER PRIMARY KEY", REASON.name: "TEXT"}
    declared = ", ".join(
        f"{quoted(column.name)} {kinds.get(column.name, 'TEXT' if column.name in texts else 'NUMERIC')}"
        for column in columns
    )
    return {name: f"CREATE TABLE {name} ({text})" for name, text in {"members": declared, **TABLES}.items()}


def _create(
    database: sqlite3.Connection, identity: Identity, columns: Sequence[SampleColumn], schema: Mapping[str, str]
) -> None:
    """All tables at once: a process that ends meanwhile leaves an empty file."""
    for statement in schema.values():
        database.execute(statement)
    database.executemany("INSERT INTO columns VALUES (?, ?, ?)", _described(columns))
    stored = {"format": FORMAT, **identity}
    pairs = [(key, json.dumps(value, sort_keys=True)) for key, value in stored.items()]
    database.executemany("INSERT INTO study VALUES (?, ?)", [*pairs, (OWN, json.dumps([uuid4().hex, _sum_of(pairs)]))])


def _sum_of(pairs: Sequence[tuple[str, str]]) -> int:
    """Checksum of a study as it is stored: from an edited one other members would follow."""
    return zlib.crc32(repr(sorted(pairs)).encode())


def _described(columns: Sequence[SampleColumn]) -> list[tuple[str, str, str]]:
    return [(column.name, column.unit, column.meaning) for column in columns]


def _verify(
    path: Path, database: sqlite3.Connection, columns: Sequence[SampleColumn], schema: Mapping[str, str], runs: int
) -> None:
    """Refuse a store in which anything is not as it was written: members come out of it unseen."""
    (state,) = next(database.execute("PRAGMA integrity_check(1)"))
    if state != "ok":
        raise damaged(path, state)
    there = dict(database.execute("SELECT name, sql FROM sqlite_master WHERE type IN ('table', 'trigger')"))
    for name in (*schema, *(there.keys() - schema.keys())):
        if name in schema and there.get(name) != schema[name]:
            raise damaged(path, f"the table {name} is another than abu-calc makes")
        if there.get(name, "").startswith("CREATE TRIGGER"):
            raise damaged(path, f"a trigger {name} changes what is written")
    if sorted(database.execute("SELECT * FROM columns")) != sorted(_described(columns)):
        raise damaged(path, "the table columns was changed")
    query = "SELECT members.*, checksum FROM members LEFT JOIN checksums USING (member)"
    for *row, kept in database.execute(query):
        if kept != checksum(row) or not 0 <= row[0] < runs:
            raise damaged(path, f"member {row[0]} is not what was stored")


def _again(time_limit: float) -> str:
    """SQL for members that are tried again: the reason lies in the computer, or they were given less time."""
    overtime = f"members.reason LIKE '{OVERTIME}%' AND CAST(substr(members.reason, {len(OVERTIME) + 1}) AS REAL)"
    return f"COALESCE(members.reason LIKE '{OUTSIDE}%' OR ({overtime} < {time_limit!r}), 0)"


def _stretches(numbers: Sequence[int]) -> Iterator[tuple[int, int]]:
    """First and last of numbers without a gap, which ascend.

    >>> list(_stretches([1, 2, 3, 7, 9]))
    [(1, 3), (7, 7), (9, 9)]
    """
    for place, number in enumerate(numbers):
        if place == 0 or number > numbers[place - 1] + 1:
            first = number
        if place + 1 == len(numbers) or numbers[place + 1] > number + 1:
            yield first, number


def _refuse_another(path: Path, there: Mapping[str, Any], wanted: Identity) -> None:
    differing = differences(there, json.loads(json.dumps({"format": FORMAT, **wanted})))
    if differing:
        more = f", and {len(differing) - SHOWN} more" if len(differing) > SHOWN else ""
        raise InputError(
            f"{path} holds another study: {'; '.join(differing[:SHOWN])}{more}",
            place=PLACE,
            remedy="Go on with the file, version and options it was begun with, or name another store.",
        )


def differences(there: object, wanted: object, path: str = "") -> list[str]:
    """Differences between two studies, in words.

    >>> differences({"machine": {"mass_kg": 5.6}}, {"machine": {"mass_kg": 5.7}})
    ['machine.mass_kg is 5.6 there and 5.7 here']
    >>> differences({"variants": [{"machine": 1}, {"machine": 2}]}, {"variants": [{"machine": 3}]})
    ['variants.0.machine is 1 there and 3 here', 'variants.1 is a table there and none here']
    """
    if isinstance(there, list) and isinstance(wanted, list):
        there, wanted = (dict(enumerate(each)) for each in (there, wanted))
    if isinstance(there, Mapping) and isinstance(wanted, Mapping):
        return [
            text
            for key in dict.fromkeys((*there, *wanted))
            for text in differences(there.get(key), wanted.get(key), f"{path}.{key}" if path else str(key))
        ]
    return [] if there == wanted else [f"{path} is {_short(there)} there and {_short(wanted)} here"]


def _short(value: object) -> str:
    return "none" if value is None else shown_short(value)


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")
