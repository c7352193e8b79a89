"""The walk of a call goes down: what lies below calls back only what it was given."""

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

import pytest

from abu_calc.features.grinding.work import at_work
from abu_calc.foundation.progress import silent
from abu_calc.simulation.scene_file import read_any
from abu_calc.simulation.simulate import simulate
from abu_calc.simulation.subject import subject_of
from abu_calc.sizing import size
from tests.house.structure import PACKAGE, files
from tests.house.test_rooms import LAYERS

LAYER = {os.fspath(path): name.split(".")[1] for name, path in files().items() if name.count(".") > 1}
"""Layer of each file by its path."""

READERS = {("dynamics/integrators/run.py", "simulation/response.py")}
"""Calls that climb: an integrator hands samples to the readers that it was given."""


@contextmanager
def climbs() -> Iterator[set[tuple[str, str]]]:
    """Files whose functions call one of a higher layer inside, each with the file that it calls."""
    pairs: set[tuple[str, str]] = set()

    def watch(frame: FrameType, event: str, _: Any) -> None:
        called = frame.f_code.co_filename
        if event != "call" or called not in LAYER:
            return
        caller = frame.f_back
        while caller is not None and caller.f_code.co_filename not in LAYER:
            caller = caller.f_back
        if caller is not None:
            calling = caller.f_code.co_filename
            if LAYERS.index(LAYER[calling]) < LAYERS.index(LAYER[called]):
                pairs.add((os.path.relpath(calling, PACKAGE), os.path.relpath(called, PACKAGE)))

    sys.setprofile(watch)
    try:
        yield pairs
    finally:
        sys.setprofile(None)


def idle() -> None:
    """One run of a machine's idle scene."""
    simulate(subject_of(read_any("avtovaz-707-222", ()), None, None).scene)


def grinding() -> None:
    """A machine at its work, by closed forms and simulated."""
    at_work(size(read_any("avtovaz-707-222", ()).whole("grinding")), 0.01, silent)  # type: ignore[union-attr]


WALKS: dict[str, Callable[[], None]] = {"idle": idle, "grinding": grinding}


@pytest.mark.parametrize("walk", WALKS)
def test_no_call_climbs_to_a_higher_layer_but_those_to_readers(walk: str) -> None:
    """In a process of its own: CPython 3.11 may loop without end if it is profiled after many other tests."""
    words = [sys.executable, "-m", "tests.house.test_walks", walk]
    answer = subprocess.run(words, cwd=PACKAGE.parent, capture_output=True, text=True, timeout=300, check=True)
    assert {tuple(line.split()) for line in answer.stdout.splitlines()} == READERS


if __name__ == "__main__":
    with climbs() as climbing:
        WALKS[sys.argv[1]]()
    for pair in sorted(climbing):
        print(*(path.replace(os.sep, "/") for path in pair))
