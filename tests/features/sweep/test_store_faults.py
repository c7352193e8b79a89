"""Names that are no stores, and faults of stores in words."""

import os
import sqlite3
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.sweep.store_faults import checked_path, faults_of, refuse_foreign
from tests.features.sweep.conftest import ECCENTRICITY, Sweeps

NO_NAMES = {
    ":memory:": "outlives",
    "": "outlives",
    "a\0b": "not the name",
    "a\udc80b": "not the name",
    "a\nb": "not the name",
    "x" * 300: "File name too long",
}


@pytest.mark.parametrize(("name", "part"), NO_NAMES.items(), ids=ascii)
def test_what_is_no_name_of_a_store_is_refused(name: str, part: str, sweeps: Sweeps) -> None:
    with pytest.raises(abu_calc.InputError, match=part) as refused:
        abu_calc.sweep(sweeps.machine, {ECCENTRICITY: "uniform(0, 0.01)"}, 2, store=name)
    assert refused.value.place.key == "store" and refused.value.exit_status == 2


@pytest.mark.skipif(os.name == "nt", reason="Windows has neither")
@pytest.mark.parametrize("resume", [False, True])
def test_loops_folders_and_pipes_are_no_stores(resume: bool, sweeps: Sweeps) -> None:
    loop, pipe = sweeps.folder / "loop", sweeps.folder / "pipe"
    loop.symlink_to(loop)
    os.mkfifo(pipe)
    for path, part in ((loop, "symbolic links"), (pipe, "no regular file"), (sweeps.folder, "this is a folder")):
        with pytest.raises(abu_calc.OutputError, match=part) as refused:
            sweeps.run(path, resume=resume)
        assert str(path) in str(refused.value)


@pytest.mark.parametrize(
    ("raised", "part"),
    [
        (sqlite3.DatabaseError("malformed"), "it is damaged: malformed"),
        (OSError(28, "No space left on device"), "the system refuses it: No space left on device"),
        (RecursionError(), "nested without end"),
        (KeyError("runs"), "it is damaged: KeyError"),
    ],
)
def test_every_fault_names_its_store_and_what_to_do(raised: Exception, part: str) -> None:
    with pytest.raises(abu_calc.OutputError, match=part) as refused, faults_of(Path("some.sqlite")):
        raise raised
    assert str(refused.value).startswith("store: some.sqlite: ") and refused.value.remedy
    assert refused.value.place.key == "store"


def test_a_path_has_a_folder(tmp_path: Path) -> None:
    assert checked_path(tmp_path / "new.sqlite") == tmp_path / "new.sqlite"
    with pytest.raises(abu_calc.OutputError, match="does not exist"):
        checked_path(tmp_path / "nowhere" / "new.sqlite")


def test_tables_of_another_program_are_foreign() -> None:
    refuse_foreign(Path("mine.sqlite"), {"members", "runs", "study", "notes"})
    with pytest.raises(abu_calc.InputError, match="invoices"):
        refuse_foreign(Path("mine.sqlite"), {"members", "invoices"})
