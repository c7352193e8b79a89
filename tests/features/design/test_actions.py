"""Every action followed literally: with its entries replaced, the number that it tells comes true."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.design.start_rules import IN_ALL_OILS
from abu_calc.features.design.study import SizeResult
from abu_calc.foundation.checks import Check
from abu_calc.foundation.errors import AbuError
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.read_machine import Machine, machine_from, read_machine
from abu_calc.inputs.reading.overrides import following, parse_overrides
from tests.hard_machines import FILES_BY_HAND
from tests.remembered import recalled
from tests.studies.random_machines import family_of, machine_text

PRESETS = ("avtovaz-707-222", "avtovaz-707-305", "avtovaz-707-370", "msh-230", "swing-arm-grinder")
MACHINES = [each for each in FILES_BY_HAND if "[machine]" in each.values[0].read_text(encoding="utf-8")]
QUICK = {0, 2, 3}
RANDOM = [pytest.param(seed, marks=pytest.mark.slow if seed in QUICK else pytest.mark.hard) for seed in range(40)]

TOLD = re.compile(
    r"(?P<what>[a-z][^:;.]*?) (?:falls|rises) from (?P<before>\S+) to (?P<after>[-\d.]+)(?P<unit> \S+)? \("
)
"""Clause of an action: which number goes from what to what."""


def followed(machine: Machine, check: Check) -> Machine:
    """The machine with the entries of an action, as the options that are printed replace them."""
    return machine_from(
        machine.document, following(machine.overrides, parse_overrides(list(check.overrides)), MachineFile)
    )


def quantity(result: SizeResult, code: str, what: str) -> float | None:
    """The number that an action speaks of, in another result: over all start cases that the machine promises."""
    many, searched = result.starts.of, result.starts.searched
    given = [] if many is None else [*many[1].given]
    given += [] if searched is None else [each for each in searched.outcomes if each.member.promised]
    if what.endswith(IN_ALL_OILS) and many is not None:
        what, given = what.removesuffix(IN_ALL_OILS), [*many[1].outcomes]
    check = next((one for one in result.checks if one.code == code), None)
    vibration = result.vibration
    match what:
        case "the expected level":
            return max(speed.level_after_db for speed in vibration.by_speed or ())
        case "the loudest start case":
            return max(start.level for start in given)
        case "the slowest start case":
            return max(start.quiet_time_or_inf for start in given)
        case "the largest imbalance left by a start case":
            return max(1e6 * start.imbalance for start in given)
        case "the number of start cases with stalled balls":
            return float(sum(start.hanging for start in given))
        case _ if what.startswith(("the required", "the permitted")):
            return None if check is None else check.limit
        case _:
            return None if check is None else check.value


def faults(name: str, machine: Machine, result: SizeResult) -> Iterator[str]:
    """What does not come true of the actions of one result."""
    for check in result.checks:
        if not check.remedy:
            continue
        claims = list(TOLD.finditer(check.remedy))
        if claims and not check.overrides:
            yield f"{name} {check.code}: a number is told, but no entries: {check.remedy}"
        if not check.overrides:
            continue
        if len(claims) != 1:
            yield f"{name} {check.code}: {len(claims)} numbers are told: {check.remedy}"
            continue
        try:
            after = abu_calc.size(followed(machine, check))
        except AbuError as error:
            yield f"{name} {check.code}: {check.remedy} cannot be followed: {error}"
            continue
        (claim,) = claims
        value, text = quantity(after, check.code, claim["what"]), claim["after"]
        if "working speed" in claim["what"]:
            low, high = followed(machine, check).whole().machine.speed_range
            value = high if "highest" in claim["what"] else low
        if value is None or not as_printed(value, text):
            yield f"{name} {check.code}: {check.remedy} gives {value}"


def as_printed(value: float, text: str) -> bool:
    """Whether a number is what a text shows, within the last digit that it prints."""
    digits = text.lstrip("-")
    zeros = len(digits) - len(digits.rstrip("0")) if "." not in digits else 0
    last = 10.0**zeros if "." not in digits else 10.0 ** -len(digits.partition(".")[2])
    return abs(value - float(text)) <= 0.5 * last * 1.001 + 1e-9


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        name if name not in ("avtovaz-707-305", "swing-arm-grinder") else pytest.param(name, marks=pytest.mark.slow)
        for name in PRESETS
    ],
)
def test_every_action_of_the_presets_comes_true(name: str) -> None:
    machine = abu_calc.read(name)
    assert list(faults(name, machine, recalled("size", machine))) == []


@pytest.mark.parametrize("file", MACHINES)
def test_every_action_of_the_hard_machines_comes_true(file: Path) -> None:
    machine = abu_calc.read(str(file))
    assert list(faults(file.stem, machine, recalled("size", machine))) == []


@pytest.mark.few(0, 1)
@pytest.mark.parametrize("seed", RANDOM)
def test_every_action_of_random_machines_comes_true(seed: int, tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(machine_text(seed, family_of(seed)), encoding="utf-8")
    machine = read_machine(str(file))
    try:
        result = abu_calc.size(machine)
    except AbuError:  # no race fits
        return
    assert list(faults(f"seed {seed}", machine, result)) == []
