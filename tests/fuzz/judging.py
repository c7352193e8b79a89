"""What every command must keep to, whatever it is given."""

import io
import json
import os
import re
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from unittest import mock

from tests.cli.runner import Seen, abu
from tests.fuzz.inputs import Input
from tests.fuzz.kinds import FILE, NAME, RECORDED, RECORDING_NAME

MOST_SECONDS = 5.0
"""Of the processor; what takes longer is tried again, and the pace of the processor is counted in."""
LOOPS, QUIET = 100_000, 0.008
"""Of a sum, and the time [s] that they take where nothing else runs."""
STATUSES = {0, 1, 2, 3}
ACTING = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\u2028\u2029]")
NAMED = re.compile(
    rf"{re.escape(NAME)}|{re.escape(RECORDING_NAME)}|--?\w|Try `abu|found |allowed|x\.toml|exists|folder|file|preset|"
    "-: |x{200}"
)
"""A place, or what was found."""
COLORS = re.compile("\x1b\\[[0-9;]*m")
NAMES = {FILE: NAME, RECORDED: RECORDING_NAME}


def broken(given: Input, folder: Path) -> list[str]:
    """What a command does wrong with an input, in an empty folder."""
    found, took = _done(given, folder / "once")
    if took > MOST_SECONDS:
        took = min(took, _done(given, folder / "again")[1])
    return [*found, *([f"took {took:.1f} s"] if took > MOST_SECONDS else [])]


def _done(given: Input, folder: Path) -> tuple[list[str], float]:
    """What goes wrong, and the seconds it takes on a quiet processor."""
    folder.mkdir()
    arguments = tuple(NAMES.get(word, word) for word in given.arguments)
    kept = next((NAMES[word] for word in given.arguments if word in NAMES), NAME)
    (folder / kept).write_bytes(given.content)
    started = time.process_time()
    with _surroundings(given, folder):
        try:
            seen = abu(*arguments)
        except BaseException as error:
            return [f"raised {error!r}"], 0.0
    took = time.process_time() - started
    took = took / max(_pace(), 1.0) if took > MOST_SECONDS else took
    return [*_wrong(arguments, given, seen), *_files(given, folder, kept, seen)], took


def _pace() -> float:
    """How much slower than a quiet one the processor is."""
    started = time.process_time()
    sum(number * number for number in range(LOOPS))
    return (time.process_time() - started) / QUIET


def _files(given: Input, folder: Path, kept: str, seen: Seen) -> Iterator[str]:
    """Files are whole, and there are none where nothing was computed; what was there stays."""
    if (folder / kept).read_bytes() != given.content and "--force" not in given.arguments:
        yield "changed the file"
    written = [one for one in folder.iterdir() if one.name != kept]
    if written and seen.status in (2, 3):
        yield f"left {sorted(one.name for one in written)} behind"
    for one in written:
        if one.is_file() and not one.stat().st_size:
            yield f"left {one.name!r} empty"
        if one.suffix == ".json" and one.is_file():
            try:
                json.loads(one.read_text(encoding="utf-8"))
            except ValueError:
                yield "wrote no JSON"


def _wrong(arguments: tuple[str, ...], given: Input, seen: Seen) -> Iterator[str]:
    told = seen.out + seen.err
    shown = COLORS.sub("", told) if "FORCE_COLOR" in given.environment else told
    if seen.status not in STATUSES:
        yield f"status {seen.status}"
    if "Traceback" in told or "this is a bug" in told:
        yield "told as a bug"
    if acting := ACTING.search(shown):
        yield f"prints {acting[0]!r}"
    if seen.status == 2:
        yield from _message(arguments, seen.err)
    if "--json" in arguments and seen.out and "--help" not in arguments:
        try:
            document = seen.document
        except (ValueError, AssertionError):
            yield "no JSON"
        else:
            if (seen.status == 2) != (document.get("error", {}).get("kind") in ("input", "range", "output")):
                yield "status and error differ"


def _message(arguments: tuple[str, ...], told: str) -> Iterator[str]:
    """One that says where the fault is: a file, an option, a key, or what was found."""
    if not told.startswith("abu"):
        yield "no message"
    elif not NAMED.search(told):
        yield f"names nothing: {told[:200]!r}"
    if max(map(len, told.splitlines()), default=0) > 2000:
        yield "a line without end"


@contextmanager
def _surroundings(given: Input, folder: Path) -> Iterator[None]:
    """In the folder, with the environment, the content on standard input too."""
    before = Path.cwd()
    os.chdir(folder)
    stream = io.TextIOWrapper(io.BytesIO(given.content))
    try:
        with mock.patch.dict(os.environ, given.environment), mock.patch("sys.stdin", stream):
            yield
    finally:
        os.chdir(before)


def described(given: Input) -> str:
    """An input as a seed keeps it."""
    return json.dumps({"arguments": given.arguments, "content": given.content.decode("latin-1"),
                       "environment": given.environment})  # fmt: skip


def seed(text: str) -> Input:
    """The input of a seed."""
    kept = json.loads(text)
    return Input(tuple(kept["arguments"]), kept["content"].encode("latin-1"), kept["environment"])
