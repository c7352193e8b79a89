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
from tests.fuzz.kinds import FILE

NAME = "machine.toml"
MOST_SECONDS = 5.0
"""Of the processor."""
STATUSES = {0, 1, 2, 3}
ACTING = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\u2028\u2029]")


def broken(given: Input, folder: Path) -> list[str]:
    """What a command does wrong with an input, in an empty folder."""
    (folder / NAME).write_bytes(given.content)
    arguments = tuple(NAME if word == FILE else word for word in given.arguments)
    started = time.process_time()
    with _surroundings(given, folder):
        try:
            seen = abu(*arguments)
        except BaseException as error:
            return [f"raised {error!r}"]
    took = time.process_time() - started
    return [*_wrong(arguments, seen), *([f"took {took:.1f} s"] if took > MOST_SECONDS else [])]


def _wrong(arguments: tuple[str, ...], seen: Seen) -> Iterator[str]:
    told = seen.out + seen.err
    if seen.status not in STATUSES:
        yield f"status {seen.status}"
    if "Traceback" in told or "this is a bug" in told:
        yield "told as a bug"
    if acting := ACTING.search(told):
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
    elif not re.search(rf"{re.escape(NAME)}|--?\w|Try `abu|found |allowed|x\.toml|exists|folder|file|preset|-: ", told):
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
