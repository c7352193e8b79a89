"""Compiled code on disk: whole, or done without, whatever is in its place and whoever else writes."""

import os
import subprocess
import sys
import time
import warnings
from collections.abc import Iterator
from pathlib import Path

import pytest

from abu_calc.foundation import disk_cache as cache
from abu_calc.foundation.disk_cache import Cache

KEY, OTHER = "a" * 64, "b" * 64


@pytest.fixture(autouse=True)
def silent_so_far(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "_told", set())


def test_what_is_written_is_read(tmp_path: Path) -> None:
    folder = Cache(tmp_path / "new" / "folder")
    assert folder.read(KEY) is None
    folder.write(KEY, b"code")
    folder.write(OTHER, b"")
    assert (folder.read(KEY), folder.read(OTHER)) == (b"code", b"")
    assert sorted(one.name for one in folder.folder.iterdir()) == [f"{KEY}.o", f"{OTHER}.o"]


@pytest.mark.parametrize("damage", ["cut off", "other bytes", "empty", "one bit"])
def test_what_is_damaged_is_not_used_and_written_anew(damage: str, tmp_path: Path) -> None:
    folder = Cache(tmp_path)
    folder.write(KEY, b"some code")
    whole = folder.place(KEY).read_bytes()
    damaged = {
        "cut off": whole[:-1], "other bytes": os.urandom(500), "empty": b"", "one bit": whole[:-1] + b"f",
    }  # fmt: skip
    folder.place(KEY).write_bytes(damaged[damage])
    assert folder.read(KEY) is None
    folder.write(KEY, b"some code")
    assert folder.read(KEY) == b"some code"


def done_without(folder: Cache, named: Path) -> None:
    """Nothing is read or kept, and that is told once."""
    with pytest.warns(RuntimeWarning, match="compiled code is not kept") as told:
        assert folder.read(KEY) is None
        folder.write(KEY, b"code")
        folder.write(OTHER, b"code")
    assert len(told) == 1 and str(named) in str(told[0].message)


def test_a_file_in_place_of_the_folder(tmp_path: Path) -> None:
    place = tmp_path / "file"
    place.write_text("not a folder", encoding="utf-8")
    done_without(Cache(place), place)
    assert place.read_text(encoding="utf-8") == "not a folder"


def test_a_folder_in_place_of_a_file(tmp_path: Path) -> None:
    folder = Cache(tmp_path)
    folder.place(KEY).mkdir()
    folder.place(OTHER).mkdir()
    done_without(folder, tmp_path)


def test_a_folder_that_may_not_be_written(tmp_path: Path) -> None:
    if os.name == "nt" or os.geteuid() == 0:
        tmp_path = Path("/proc/no such folder")  # root may write anywhere but here
        if os.name == "nt":
            pytest.skip("Windows has other rights")
    else:
        tmp_path.chmod(0o500)
    done_without(Cache(tmp_path), tmp_path)


def test_no_home(monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless(_: Path) -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.setattr(Path, "expanduser", homeless)
    monkeypatch.delenv(cache.FOLDER, raising=False)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    folder = Cache.own()
    done_without(folder, folder.folder)


def test_the_home_of_nobody_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(cache.FOLDER, "~nosuchuser/x")
    done_without(Cache.own(), Path("~nosuchuser/x"))


def test_the_folder_may_be_chosen(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv(cache.FOLDER, str(tmp_path))
    assert Cache.own().folder == tmp_path


def test_what_was_used_longest_ago_goes_first_and_other_files_stay(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(cache, "MOST_BYTES", 10_000)
    (tmp_path / "letter.txt").write_bytes(bytes(50_000))
    folder, keys = Cache(tmp_path), [f"{k:064x}" for k in range(5)]
    for age, key in enumerate(keys[:3]):
        folder.write(key, bytes(3000))
        os.utime(folder.place(key), (1000 + age, 1000 + age))
    assert folder.read(keys[0]) is not None  # used now
    folder.write(keys[3], bytes(3000))
    assert [folder.read(key) is not None for key in keys[:4]] == [True, False, True, True]
    assert (tmp_path / "letter.txt").exists()


WRITER = """
import sys
from pathlib import Path
from abu_calc.foundation.disk_cache import Cache
folder, content = Cache(Path(sys.argv[1])), bytes(range(256)) * 400
for turn in range(300):
    folder.write("a" * 64, content)
    assert folder.read("a" * 64) in (None, content)
"""


@pytest.fixture
def strict() -> Iterator[None]:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


@pytest.mark.slow
@pytest.mark.usefixtures("strict")
def test_two_processes_write_at_once(tmp_path: Path) -> None:
    """Nobody ever reads half of it."""
    command = sys.executable, "-W", "error", "-c", WRITER, str(tmp_path)
    runs = [subprocess.Popen(command, stderr=subprocess.PIPE, text=True) for _ in range(2)]
    folder, seen = Cache(tmp_path), set()
    while any(run.poll() is None for run in runs):
        seen.add(folder.read(KEY))
        time.sleep(0.001)
    assert [run.communicate()[1] for run in runs] == ["", ""]
    assert seen <= {None, bytes(range(256)) * 400}
    assert [one.name for one in tmp_path.iterdir()] == [f"{KEY}.o"]


def test_a_file_under_the_name_of_another_is_not_used(tmp_path: Path) -> None:
    folder = Cache(tmp_path)
    folder.write(KEY, b"code")
    folder.place(KEY).replace(folder.place(OTHER))
    assert folder.read(OTHER) is None
