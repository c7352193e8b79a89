"""Nothing lost, nothing wrong, nothing told as a bug, no signal ignored."""

import os
import random
from pathlib import Path

import pytest

from tests.faults.trials import KINDS, Faults

pytestmark = pytest.mark.skipif(os.name == "nt", reason="trials use signals and limits that Windows does not have")

INSIDE = ("edited", "corrupted", "disk full")
"""Kinds of trials that start no process."""


def check(faults: Faults) -> None:
    tally = faults.tally
    assert tally.failures == []
    assert (tally.lost, tally.wrong, tally.bugs, tally.ignored) == (0, 0, 0, 0)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_a_dozen_faults_leave_the_members_or_are_told(tmp_path: Path) -> None:
    faults = Faults(tmp_path)
    for number in range(12):
        folder = tmp_path / str(number)
        folder.mkdir()
        name = INSIDE[number % len(INSIDE)]
        KINDS[name][0](faults, folder, random.Random(number), f"{number} {name}")
    check(faults)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", [name for name in KINDS if name not in INSIDE])
def test_a_fault_of_each_kind_that_takes_processes(name: str, tmp_path: Path) -> None:
    if name == "cluster":
        pytest.importorskip("distributed")
    faults = Faults(tmp_path)
    folder = tmp_path / "trial"
    folder.mkdir()
    KINDS[name][0](faults, folder, random.Random(1), name)
    check(faults)


@pytest.mark.hard
@pytest.mark.filterwarnings("ignore")
def test_two_hundred_faults_of_all_kinds(tmp_path: Path) -> None:
    """`python -m tests.faults` makes two thousand, these among them."""
    pytest.importorskip("distributed")
    faults = Faults(tmp_path)
    for number in range(200):
        faults.trial(number)
    assert len(faults.tally.trials) >= len(KINDS) - 1
    check(faults)
