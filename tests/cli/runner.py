"""Runs `abu` inside the test's process and tells what a user would see."""

import contextlib
import io
import json
from dataclasses import dataclass
from typing import Any

from abu_calc.cli.app import run


@dataclass(frozen=True)
class Seen:
    """Exit status and both streams."""

    status: int
    out: str
    err: str

    @property
    def document(self) -> dict[str, Any]:
        """The one JSON document on standard output."""
        return json.loads(self.out, parse_constant=_refuse)

    @property
    def width(self) -> int:
        """Length of the longest line but those of one word: names of files are not broken."""
        return max(len(line) for line in self.out.splitlines() if len(line.split()) > 1)


def abu(*arguments: str) -> Seen:
    """What `abu arguments…` does."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = run(list(arguments))
    return Seen(status, out.getvalue(), err.getvalue())


def _refuse(name: str) -> None:
    raise AssertionError(f"{name} is no JSON")
