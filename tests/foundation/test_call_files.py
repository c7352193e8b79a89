"""Files of one call: two that are one are found through links and spellings."""

import os
from pathlib import Path

import pytest

from abu_calc.foundation import call_files
from abu_calc.foundation.call_files import enter, one_call, same_file
from abu_calc.foundation.errors import OutputError

posix = pytest.mark.skipif(os.name == "nt", reason="links need rights there")


@posix
def test_links_lead_to_one_file(tmp_path: Path) -> None:
    file, hard, soft, other = (tmp_path / name for name in ("a", "hard", "soft", "other"))
    file.write_text("a", encoding="utf-8")
    hard.hardlink_to(file)
    soft.symlink_to(file)
    other.write_text("a", encoding="utf-8")
    assert same_file(hard, soft) and same_file(file, tmp_path / "." / "a")
    assert not same_file(file, other) and not same_file(file, tmp_path / "new")


@posix
def test_files_that_do_not_exist_yet_are_compared_by_their_ends(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "folder")
    (tmp_path / "dangling").symlink_to(tmp_path / "new")
    assert same_file(tmp_path / "folder" / "x", tmp_path / "link" / "x")
    assert same_file(tmp_path / "dangling", tmp_path / "new") and not same_file(tmp_path / "x", tmp_path / "y")


@pytest.mark.parametrize("ignores", [False, True])
def test_capitals_count_where_the_file_system_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ignores: bool
) -> None:
    monkeypatch.setattr(call_files, "_ignores_case", lambda folder: ignores)
    assert same_file(tmp_path / "New.json", tmp_path / "new.json") is ignores


def test_a_call_writes_no_file_twice_and_none_that_it_reads(tmp_path: Path) -> None:
    file, other = tmp_path / "a", tmp_path / "b"
    for first, second in ((True, True), (True, False), (False, True)):
        with one_call():
            enter(file, written=first)
            enter(other, written=second)
            with pytest.raises(OutputError, match="same file" if first and second else "reads the file"):
                enter(file, written=second)
    with one_call():
        enter(file, written=False)
        enter(file, written=False)
    enter(file, written=True)  # outside of a call nothing is entered
    enter(file, written=True)
