"""Stores in use, taken away, full, locked, damaged, of another form: one error that says how to go on."""

import json
import os
import sqlite3
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import abu_calc
from abu_calc.features.sweep import store as stores
from abu_calc.features.sweep.batches import LEVEL, MEMBER, REASON, SEED
from abu_calc.features.sweep.execution import software
from abu_calc.features.sweep.samples import Builds
from abu_calc.features.sweep.store import Store
from tests.features.sweep.conftest import Sweeps

COLUMNS = (MEMBER, SEED, LEVEL, REASON)


def rows(path: Path, query: str = "SELECT * FROM members ORDER BY member") -> list[Any]:
    database = sqlite3.connect(path)
    try:
        return database.execute(query).fetchall()
    finally:
        database.close()


def edited(path: Path, *statements: str) -> None:
    database = sqlite3.connect(path)
    for statement in statements:
        database.execute(statement)
    database.commit()
    database.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    database.close()


def opened(path: Path, runs: int = 4, **options: Any) -> Store:
    return Store.open(path, {"runs": runs}, COLUMNS, frozenset(), **options)


class Meanwhile:
    """An act on the store while a sweep computes its member of this number."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, member: int, act: Callable[[], None]) -> None:
        numbers, self.count = Builds.numbers, 0

        def watched(study: Builds, values: Any, seed: int) -> Any:
            if self.count == member:
                act()
            self.count += 1
            return numbers(study, values, seed)

        monkeypatch.setattr(Builds, "numbers", watched)


@pytest.mark.slow
def test_force_leaves_a_store_that_is_in_use(sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch) -> None:
    """By another process: it has another connection, as here."""
    refused = []

    def overwrite() -> None:
        with pytest.raises(abu_calc.OutputError, match=r"members\.sqlite: another process has it open") as error:
            opened(sweeps.store, force=True)
        refused.append(error.value.exit_status)

    Meanwhile(monkeypatch, 5, overwrite)
    sweeps.run()
    assert refused == [2] and len(rows(sweeps.store)) == 12
    before = sweeps.store.stat().st_ino
    sweeps.run(runs=5, force=True)
    assert len(rows(sweeps.store)) == 5 and sweeps.store.stat().st_ino == before


def test_force_leaves_what_is_no_store(sweeps: Sweeps) -> None:
    edited(sweeps.store, "CREATE TABLE invoices (number INTEGER)", "INSERT INTO invoices VALUES (7)")
    with pytest.raises(abu_calc.InputError, match="no store of a sweep"):
        sweeps.run(force=True)
    assert rows(sweeps.store, "SELECT * FROM invoices") == [(7,)]
    assert rows(sweeps.store, "PRAGMA journal_mode") == [("delete",)]


@pytest.mark.few(2)
@pytest.mark.parametrize("way", ["removed", "moved", "replaced", "its log removed", "made anew", "a link"])
def test_a_run_whose_store_is_taken_away_fails(
    way: str, sweeps: Sweeps, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def take() -> None:
        if way == "made anew":  # where files have no shared memory nothing else tells that the store is in use
            edited(sweeps.store, "UPDATE study SET value = '\"another\"' WHERE key = 'store'")
        elif way in ("its log removed", "a link"):
            Path(f"{sweeps.store}-wal").unlink()
        elif way == "removed":
            sweeps.store.unlink()
        else:
            sweeps.store.rename(tmp_path / "elsewhere.sqlite")
            if way == "replaced":
                sweeps.store.write_bytes((tmp_path / "elsewhere.sqlite").read_bytes())

    Meanwhile(monkeypatch, 5, take)
    link = tmp_path / "link.sqlite"
    link.symlink_to(sweeps.store)
    with pytest.raises(abu_calc.OutputError, match="removed or replaced during the run"):
        sweeps.run(*[link] * (way == "a link"))


@pytest.mark.slow
def test_members_that_another_program_takes_out_are_missed(sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch) -> None:
    Meanwhile(monkeypatch, 8, lambda: edited(sweeps.store, "DELETE FROM members WHERE member = 2"))
    with pytest.raises(abu_calc.OutputError, match="it has 11 samples and not 12"):
        sweeps.run()
    sweeps.run(resume=True)
    assert len(rows(sweeps.store)) == 12


def test_several_that_begin_one_store_go_along(tmp_path: Path) -> None:
    """They look at the same moment; each finds the tables or makes them."""
    path, together, faults = tmp_path / "members.sqlite", threading.Barrier(6), list[BaseException]()

    def begin(number: int) -> None:
        try:
            together.wait()
            store = opened(path)
            store.begun({})
            store.put([(number % 4, 0, 1.5, None)], f"process {number}")
            store.ended()
            store.close()
        except BaseException as error:
            faults.append(error)

    threads = [threading.Thread(target=begin, args=(number,)) for number in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert faults == [] and len(rows(path)) == 4
    opened(path).close()


def test_a_store_tells_who_computed_which_members(sweeps: Sweeps) -> None:
    sweeps.run()
    ((run, text),) = rows(sweeps.store, "SELECT run, software_of_workers FROM runs")
    ((worker, used),) = json.loads(text).items()
    assert worker.endswith(f":{os.getpid()}") and used.items() >= software().items()
    batches = rows(sweeps.store, "SELECT run, worker, first, last FROM batches")
    assert {(batch[0], batch[1]) for batch in batches} == {(run, worker)}
    assert [k for *_, first, last in sorted(batches) for k in range(first, last + 1)] == list(range(12))


@pytest.mark.parametrize("content", [b"Dear reader,\n" * 100, b"\xff" * 5000])
def test_a_file_that_is_no_store_is_called_so(content: bytes, sweeps: Sweeps) -> None:
    """--force does not overwrite it, so the error does not name --force."""
    sweeps.store.write_bytes(content)
    for options in ({}, {"resume": True}, {"force": True}):
        with pytest.raises(abu_calc.OutputError, match="no store of a sweep\n  Name another file"):
            sweeps.run(**options)
    assert sweeps.store.read_bytes() == content


@pytest.mark.parametrize("name", ["a b", "a?b", "a#b", "a%20b", "µ", "file:x", "'", "a&mode=memory"])
def test_whatever_files_are_called_stores_are_called(name: str, tmp_path: Path) -> None:
    opened(tmp_path / name).close()
    assert [path.name for path in tmp_path.iterdir()] == [name]
    opened(Path(f"/{tmp_path}") / name).close()
    assert [path.name for path in tmp_path.iterdir()] == [name]


def test_a_full_disk_keeps_what_was_stored(tmp_path: Path) -> None:
    """SQLite's own limit on pages stands for the disk's end."""
    path = tmp_path / "members.sqlite"
    store = opened(path, runs=100_000)
    store.begun({})
    store.put([(member, 0, 80.0, None) for member in range(100)])
    pages = store.ask("PRAGMA page_count")[0][0]
    store.ask(f"PRAGMA max_page_count = {pages}")
    with pytest.raises(abu_calc.OutputError, match=r"members\.sqlite: the disk is full\n  Make room, then go on"):
        store.put([(member, 0, 80.0, "why" * 100) for member in range(100, 10_000)])
    store.close()
    assert len(rows(path)) == 100
    opened(path, runs=100_000).close()


def test_a_store_that_stays_locked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stores, "PATIENCE_S", 0.1)
    path = tmp_path / "members.sqlite"
    opened(path).close()
    other = sqlite3.connect(path, isolation_level=None)
    other.execute("BEGIN EXCLUSIVE")
    with pytest.raises(abu_calc.OutputError, match="another program keeps it locked"):
        opened(path)
    other.close()
    opened(path).close()


DAMAGE = {
    "level": "UPDATE members SET level_db = 70.0 WHERE member = 3",
    "text for a number": "UPDATE members SET level_db = 'quiet' WHERE member = 3",
    "bytes for a number": "UPDATE members SET level_db = x'00ff' WHERE member = 3",
    "infinite": "UPDATE members SET level_db = 9e999 WHERE member = 3",
    "all null": "UPDATE members SET level_db = NULL, meets_limits = NULL WHERE member = 3",
    "reason": "UPDATE members SET reason = 'x' WHERE member = 3",
    "another number": "UPDATE members SET member = 99 WHERE member = 3",
    "one more": "INSERT INTO members (member) VALUES (12)",
    "checksum": "UPDATE checksums SET checksum = 'x' WHERE member = 3",
    "no checksums": "DROP TABLE checksums",
    "column gone": "ALTER TABLE members DROP COLUMN level_db",
    "column more": "ALTER TABLE members ADD COLUMN level_um",
    "column renamed": 'ALTER TABLE members RENAME COLUMN level_db TO "level"',
    "no runs": "DROP TABLE runs",
    "runs of another form": "ALTER TABLE runs DROP COLUMN started",
    "no study": "DELETE FROM study",
    "no format": "DELETE FROM study WHERE key = 'format'",
    "format": "UPDATE study SET value = '3' WHERE key = 'format'",
    "no JSON": "UPDATE study SET value = '{' WHERE key = 'vary'",
    "JSON null": "UPDATE study SET value = 'null' WHERE key = 'vary'",
    "no text": "UPDATE study SET value = 5 WHERE key = 'vary'",
    "null": "UPDATE study SET value = NULL WHERE key = 'vary'",
    "nested": "UPDATE study SET value = replace(hex(zeroblob(50000)), '00', '[') WHERE key = 'vary'",
    "another distribution": """UPDATE study SET value = '{"wheel.mass_kg": "norml(1)"}' WHERE key = 'vary'""",
    "order": "UPDATE study SET value = '[5]' WHERE key = 'order'",
    "seed": "UPDATE study SET value = '\"x\"' WHERE key = 'seed'",
    "runs": "UPDATE study SET value = '-1' WHERE key = 'runs'",
    "a list": "UPDATE study SET value = '[]' WHERE key = 'runs'",
    "what": "UPDATE study SET value = '{}' WHERE key = 'what'",
    "no mark": "DELETE FROM study WHERE key = 'store'",
    "units": "UPDATE columns SET unit = 'm'",
    "trigger": "CREATE TRIGGER t AFTER INSERT ON members BEGIN DELETE FROM members; END",
    "view": "DROP TABLE members; CREATE VIEW members AS SELECT 1 AS member",
}
"""Edits by name; each leaves a file that SQLite reads."""


@pytest.mark.few(1)
@pytest.mark.parametrize("explicit", [True, False], ids=["with options", "by the store"])
def test_whatever_was_edited_is_refused(explicit: bool, sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch) -> None:
    """With options the study is known, and opened alone; without them it is read from the store."""
    whole, asked = sweeps.folder / "whole.sqlite", list[Any]()
    with monkeypatch.context() as patch:
        patch.setattr(Store, "open", lambda *args, opening=Store.open, **_: asked.extend(args) or opening(*args))
        sweeps.run(whole)
    content, wrong = whole.read_bytes(), []
    for name, statements in DAMAGE.items():
        if not explicit and " study" not in statements:
            continue
        path = sweeps.folder / f"{name}.sqlite"
        path.write_bytes(content)
        edited(path, *(statements.split(";") if "VIEW" in statements else [statements]))
        try:
            if explicit:
                Store.open(path, *asked[1:]).close()
            else:
                abu_calc.sweep(sweeps.machine, store=path, resume=True)
        except abu_calc.InputError as error:
            if str(path) not in str(error) or not error.remedy:
                wrong.append((name, str(error)))
        except Exception as error:
            wrong.append((name, repr(error)))
        else:
            wrong.append((name, "taken"))
    assert wrong == []


@pytest.mark.slow
def test_views_and_indices_of_users_do_no_harm(sweeps: Sweeps) -> None:
    sweeps.run()
    edited(sweeps.store, "CREATE VIEW loud AS SELECT * FROM members", "CREATE INDEX levels ON members (level_db)")
    sweeps.run(resume=True)


def test_members_are_read_with_the_fault_of_their_store(sweeps: Sweeps) -> None:
    members = sweeps.run().members
    sweeps.store.unlink()
    with pytest.raises(abu_calc.OutputError, match="cannot be opened"):
        members["level_db"]
    assert not sweeps.store.exists()


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="Windows has no such limit")
def test_a_limit_on_the_size_of_files_is_told(tmp_path: Path) -> None:
    import resource

    store = tmp_path / "members.sqlite"
    options = "sweep avtovaz-707-222 --tolerances --workers 1 --runs 40"
    command = [sys.executable, "-m", "abu_calc", *options.split()]
    ended = subprocess.run(
        [*command, "--store", str(store)],
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000)),
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ended.returncode == 2 and "bug" not in ended.stderr and "limit on the size of files" in ended.stderr
    assert str(store) in ended.stderr
    subprocess.run([*command, "--store", str(store), "--resume", "--quiet"], check=True)
    assert len(rows(store)) == 40
