"""The house: imports go one way between rooms, there are no circles, no room is too large."""

import re
from collections import Counter

import pytest

from tests.house.structure import PACKAGE, circles, files, imports, lines

GROUND = (
    "version",
    "frozen",
    "patience",
    "errors",
    "units",
    "checks",
    "check_codes",
    "validity",
    "formula",
    "progress",
    "parallel",
    "roots",
    "escapes",
    "interruption",
)
ROOMS = (
    *("standards", "spec", "formulas", "fits", "sizing", "dynamics", "scenes", "analysis", "studies", "report", "cli"),
)
DYNAMICS = (*("supports", "equations", "switching", "effects", "tracing", "integrators", "slow", "balanced"),)
"""The rooms inside `dynamics`, behind its own files."""


def _room(name: str) -> int:
    """The floor of a file: the place of its room in the order."""
    part = name.split(".")[1] if "." in name else ""
    return len(GROUND) + ROOMS.index(part) if part in ROOMS else -1


def _inner(name: str) -> int:
    """The floor of a file of `dynamics`; its own files are the ground."""
    parts = name.split(".")
    return DYNAMICS.index(parts[2]) if len(parts) > 2 and parts[2] in DYNAMICS else -1


def test_every_folder_has_a_floor() -> None:
    folders = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    assert folders == set(ROOMS)
    assert {path.parent.name for path in PACKAGE.glob("dynamics/*/__init__.py")} == set(DYNAMICS)


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_imports_only_rooms_before_it(room: str) -> None:
    mine = [name for name in imports() if name.startswith(f"abu_calc.{room}")]
    assert mine
    for name in mine:
        above = {other for other in imports()[name] if _room(other) > _room(name)}
        assert not above, f"{name} imports {above}"


@pytest.mark.parametrize("room", ["", *DYNAMICS])
def test_rooms_of_dynamics_have_their_order(room: str) -> None:
    for name in imports():
        if name.startswith("abu_calc.dynamics") and _inner(name) == (DYNAMICS.index(room) if room else -1):
            others = {other for other in imports()[name] if other.startswith("abu_calc.dynamics")}
            above = {other for other in others if _inner(other) > _inner(name)}
            assert not above, f"{name} imports {above}"


def test_the_ground_floor_imports_no_room() -> None:
    for name in imports():
        if name.count(".") == 1 and name.split(".")[1] in GROUND:
            assert all(_room(other) < 0 for other in imports()[name]), name


def test_files_import_each_other_in_no_circle() -> None:
    assert [circle for circle in circles() if len(circle) > 2] == []


def test_no_folder_holds_more_than_a_sixth() -> None:
    """Its own files, those of folders inside it not counted."""
    sizes = Counter[str]()
    for path in files().values():
        sizes[str(path.parent.relative_to(PACKAGE))] += lines(path)
    folder, most = sizes.most_common(1)[0]
    assert most <= sum(sizes.values()) / 6, (folder, most)


def test_kinds_of_support_are_asked_for_in_few_places() -> None:
    """A support answers for itself; scenes make them, nobody else asks which kind one is."""
    asks = re.compile(r"isinstance\([^)]*\b(SwingArm|LinearSupport)\b|\.tilts\b|arm_length is (not )?None")
    found = [
        name for name, path in files().items()
        if ".supports." not in name and asks.search(path.read_text(encoding="utf-8"))
    ]  # fmt: skip
    assert len(found) <= 3, found
