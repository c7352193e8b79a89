"""Every action followed literally: with its entries replaced all that it tells comes true, and no check gets worse."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.design.next_step import NUMBERS
from abu_calc.features.design.study import SizeResult
from abu_calc.foundation.checks import RANK, Check
from abu_calc.foundation.errors import AbuError
from abu_calc.inputs.read_machine import Machine, read_machine, variant_of
from abu_calc.sizing.actions import PINS
from abu_calc.sizing.proposals import in_words
from tests.features.design.test_next_step import at
from tests.hard_machines import FILES_BY_HAND
from tests.remembered import recalled
from tests.studies.random_machines import family_of, machine_text

PRESETS = ("avtovaz-707-222", "avtovaz-707-305", "avtovaz-707-370", "msh-230", "swing-arm-grinder")
MACHINES = [each for each in FILES_BY_HAND if "[machine]" in each.values[0].read_text(encoding="utf-8")]
QUICK = {0, 2, 3}
RANDOM = [pytest.param(seed, marks=pytest.mark.slow if seed in QUICK else pytest.mark.hard) for seed in range(40)]

ACTION = re.compile(
    r"(?P<entries>[A-Z0-9].+?): "
    r"(?:[^:]+? then (?P<verb>passes|warns)"
    r"|(?P<what>[^:]+?) (?:falls|rises) from (?P<before>\S+) to (?P<after>\S+)(?: \S+)?) \(simulated\)\. "
    r"(?:Keep balls and race\. )?"
    r"(?:All checks then pass|Then (?P<left>.+) still warns?)\."
)
"""What is set, what this check then does or which number goes from what to what, and which checks still warn."""


def faults(name: str, machine: Machine, before: SizeResult) -> Iterator[str]:
    """All that does not come true of the actions of one result, and of the promise of its next command."""
    actions = {check.code: check for check in before.checks if check.overrides}
    numbers = [check.code for check in before.checks if " from " in (check.remedy or "") and not check.overrides]
    if numbers:
        yield f"{name}: {numbers} tell numbers, but no entries"
    if len(entries := {check.overrides for check in actions.values()}) > 1:
        yield f"{name}: {len(entries)} different changes"
    if bool(entries) is not bool(before.verdict.next):
        yield f"{name}: the actions set {entries}, the next command is {before.verdict.next}"
    for change in entries:
        after = abu_calc.size(variant_of(machine, ",".join(change)))
        yield from (f"{name}: {change} {fault}" for fault in (*worse(before, after), *broken(before, after)))
        for check in actions.values():
            yield from (
                f"{name} {check.code}: {check.remedy}: {fault}" for fault in untrue(check, machine, before, after)
            )


def worse(before: SizeResult, after: SizeResult) -> Iterator[str]:
    """Checks that a change makes worse, or brings and does not pass."""
    ranks = {(check.code, check.name): RANK.index(check.status) for check in before.checks}
    for check in after.checks:
        if check.requested and RANK.index(check.status) < ranks.get((check.code, check.name), RANK.index("pass")):
            yield f"makes {check.code} worse"


def broken(before: SizeResult, after: SizeResult) -> Iterator[str]:
    """The promise of the next command, if it is not kept."""
    promise = before.verdict.promise
    if promise is None:
        yield "comes without a promise"
        return
    for result, told in ((before, promise["from"]), (after, promise["to"])):
        value = at(result.to_dict(), str(promise["path"]))
        if value != (pytest.approx(told, rel=1e-9) if isinstance(told, float) else told):
            yield f"leads to {value}, promised was {promise}"


def untrue(check: Check, machine: Machine, before: SizeResult, after: SizeResult) -> Iterator[str]:
    """What an action tells that is not so in the result with its entries."""
    action = ACTION.fullmatch(check.remedy or "")
    if action is None:
        yield "is no such sentence"
        return
    made = [f"autobalancer.{key}={getattr(before.autobalancer, key):.10g}" for key in PINS]
    words = in_words(check.overrides, machine.whole("size"), made)
    if words[:1].upper() + words[1:] != action["entries"]:
        yield f"names other entries than {check.overrides}"
    left = [each.code for each in after.checks if each.requested and each.status != "pass"]
    if sorted({*left}) != sorted((action["left"] or "").split(", ") if action["left"] else []):
        yield f"leaves {left}"
    if action["verb"] and action["verb"] != ("warns" if check.code in left else "passes"):
        yield "the check does not"
    if action["what"]:
        places = {number.name: (number.path, number.per) for number in NUMBERS.get(check.key, ())}
        path, per = places.get(action["what"], ("", 1.0))
        for result, printed in ((before, action["before"]), (after, action["after"])):
            own = next(each for each in result.checks if (each.code, each.name) == (check.code, check.name))
            number = at(result.to_dict(), path) if path else own.value
            value = None if number is None else number * per
            if (value is None) is not (printed == "never") or (value is not None and not as_printed(value, printed)):
                yield f"{path} is {value}, not {printed}"


def as_printed(value: float, text: str) -> bool:
    """Whether a number is what a text shows, within the last digit that it prints."""
    digits = text.lstrip("-")
    zeros = len(digits) - len(digits.rstrip("0")) if "." not in digits else 0
    last = 10.0**zeros if "." not in digits else 10.0 ** -len(digits.partition(".")[2])
    return abs(value - float(text)) <= 0.5 * last * 1.001 + 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("name", PRESETS)
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
