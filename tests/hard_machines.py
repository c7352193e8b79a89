"""The files of `machines`, each of them hard in a way of its own, as parameters of tests."""

from pathlib import Path

import pytest

FILES = sorted((Path(__file__).parent / "machines").glob("*.toml"))
LONG = {
    "angle-grinder-hands", "arm-pulls-on-work", "friction-elsewhere", "hands-called-chaotic", "hanging-balls",
    "late-run-up-hands", "late-settling", "motor-no-load-speed", "not-evaluated-for-work", "speed-range",
    "washing-machine",
}  # fmt: skip
"""Sizing one of these takes some seconds, and so does all that a report of it advises."""
FILES_BY_HAND = [
    pytest.param(file, marks=pytest.mark.hard if file.stem in LONG else pytest.mark.slow, id=file.stem)
    for file in FILES
]
"""All of them, the long ones by hand only."""
