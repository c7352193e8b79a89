"""Formulas and check codes are data: registered, shown, checked as they say, whatever Python does to docstrings."""

import importlib
import inspect
import os
import pkgutil
import re
import subprocess
import sys
from operator import attrgetter
from pathlib import Path
from typing import Any

import pytest

import abu_calc
from abu_calc.features.explain.steps import STEPS
from abu_calc.features.seats.joint import PERMITTED_RING_STRESS
from abu_calc.formulas.motion import SETTLED
from abu_calc.foundation.checks import CHECK_CODES
from abu_calc.foundation.formula import REGISTERED, Formula, formula_of
from abu_calc.foundation.validity import Range
from tests.cli.runner import abu
from tests.rows import for_each

PACKAGE = Path(abu_calc.__file__).parent
ROOMS = ("standards", "formulas", "features/seats", "features/balancing", "features/grinding", "sizing")
KEYS = [key for step in STEPS.values() for key in step.keys]
FORMULAS = [formula_of(key) for key in KEYS]


def _computing() -> dict[str, Any]:
    """What computes each formula that is registered anywhere, by key; those of heavy rooms are data alone."""
    for room in ROOMS:
        for path in (PACKAGE / room).glob("*.py"):
            importlib.import_module(f"abu_calc.{room.replace('/', '.')}.{path.stem}")
    found = {}
    for key in REGISTERED:
        module, _, name = key.partition(":")
        if module != "formulas.motion":
            found[key] = attrgetter(name)(importlib.import_module(f"abu_calc.{module}"))
    return found


COMPUTING = _computing()


def test_every_registered_formula_is_shown_by_a_step() -> None:
    assert len(COMPUTING) > 60
    assert COMPUTING.keys() <= set(KEYS)
    assert len(KEYS) == len(set(KEYS))


@for_each(FORMULAS)
def test_a_formula_says_what_it_gives_and_is_helped_with(one: Formula) -> None:
    assert one.gives
    assert not one.gives.endswith(".")
    assert "\n    " in one.where or not re.search(r"\s\s", one.where)
    if one.key in COMPUTING:
        assert inspect.getdoc(COMPUTING[one.key]).startswith(one.paragraphs[0])


@for_each([one for one in FORMULAS if one.key in COMPUTING])
def test_ranges_said_to_be_checked_are_checked(one: Formula) -> None:
    """The module of the formula refuses what is outside each of its ranges, by the very object that is shown."""
    module = inspect.getmodule(COMPUTING[one.key])
    for limits in one.checked:
        if isinstance(limits, Range):
            (name,) = [name for name, value in vars(module).items() if value is limits]
            assert f"{name}.check(" in inspect.getsource(module)


@pytest.mark.slow
def test_formulas_are_there_without_docstrings() -> None:
    done = subprocess.run(
        [sys.executable, "-OO", "-m", "abu_calc", "explain", "capacity"],
        cwd=PACKAGE.parent, env=os.environ | {"PYTHONIOENCODING": "utf-8"},
        capture_output=True, text=True, encoding="utf-8", check=True,
    )  # fmt: skip
    assert "√{[(1−ω_x²/Ω²)²" in done.stdout
    assert done.stdout.split() == abu("explain", "capacity").out.split()


def _used_codes() -> dict[str, set[str]]:
    """Every code in the source, with the names given beside it."""
    found: dict[str, set[str]] = {}
    for info in pkgutil.walk_packages([str(PACKAGE)], "abu_calc."):
        path = PACKAGE.parent / (info.name.replace(".", "/") + ".py")
        if path.exists() and path.parent.name != "foundation":
            text = path.read_text(encoding="utf-8")
            for code in re.findall(r'"(ABU\d+)"', text):
                found.setdefault(code, set()).update(re.findall(rf'"{code}",\s+"([a-z][^"]*)"', text))
    return found


def test_every_code_has_an_entry_and_its_name_agrees() -> None:
    used = _used_codes()
    assert used.keys() == CHECK_CODES.keys()
    for code, names in used.items():
        assert names - {"not-done", "fail", "pass", "warn"} <= {CHECK_CODES[code].name}
    assert len({one.name for one in CHECK_CODES.values()}) == len(CHECK_CODES)


def test_limits_in_the_words_of_check_codes_are_those_of_the_code() -> None:
    """Codes stand below everything, so their sentences cannot ask for the constants."""
    assert all(f"{PERMITTED_RING_STRESS / 1e6:g} MPa" in CHECK_CODES[code].fail_if for code in ("ABU602", "ABU612"))
    assert SETTLED == 0.1 and "a tenth of the imbalance" in CHECK_CODES["ABU701"].pass_if
