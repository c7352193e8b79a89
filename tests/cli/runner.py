"""Runs `abu` inside the test's process and tells what a user would see."""

import contextlib
import importlib.util
import io
import json
from dataclasses import dataclass
from functools import cache
from typing import Any

import pytest

from abu_calc.cli.app import run
from tests.remembered import remembered


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


def again(*arguments: str) -> Seen:
    """What `abu arguments…` does, with studies that were made before; for tests that patch nothing of them."""
    with remembered():
        return abu(*arguments)


@cache
def once(*arguments: str) -> Seen:
    """What `abu arguments…` does, run once for all tests that ask: for commands that write no file."""
    return again(*arguments)


EXTRAS = ("llvmlite",)


def without_extras(monkeypatch: pytest.MonkeyPatch) -> None:
    """As where it is not installed, on one processor; what is patched holds in this process alone.

    It compiles for each number of balls, and processes start, for longer than short runs take.
    """
    found = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name in EXTRAS else found(name))
    monkeypatch.setattr("os.cpu_count", lambda: 1)


def _refuse(name: str) -> None:
    raise AssertionError(f"{name} is no JSON")
