"""Verdict of a design in one word and one sentence: whether the machine suits, and what decides it."""

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Annotated, ClassVar, Final, Self

from abu_calc.foundation.checks import CHECK_CODES, RANK, Check, Grade, worst
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si, velocity_from_level
from abu_calc.reporting.blocks import number, uncapitalised
from abu_calc.reporting.parts import next_command
from abu_calc.reporting.screen import many
from abu_calc.simulation.result import Provenance

WORDS: Final[dict[Grade, str]] = {
    "pass": "suits", "warn": "suits-but", "fail": "does-not-suit", "not-done": "not-known"
}  # fmt: skip
"""The word for the worst grade of all checks."""
BEGINNINGS: Final[dict[Grade, str]] = {
    "pass": "Suits.", "warn": "Suits, but", "fail": "Does not suit:", "not-done": "Not known:"
}  # fmt: skip
"""How the sentence begins."""
MOST_REASONS: Final = 2
"""Most reasons in the sentence; the screen has a line for each."""
OF_BALANCING: Final = frozenset({"frequency_region", "carry_over", "capacity"})
"""Checks that say whether the balls help, with all that follow from another one; a seat, a strength or a cutter that
fails is no reason to leave them out.
"""
LEAST_BENEFIT: Final = 3.0
"""Reduction of the idle level [dB] below which the sentence says how little it is."""


RARE: Final = "one of 1000 takes"
"""Words of a check that the time of rare starts decides."""
LATER: Final = "Slowest at another drag rate"
"""Words of a check that a start case in hot or cold oil decides."""
STARTS_UNIT: Final = "start cases"
"""Unit of a check that counts start cases."""


@record
class Verdict(Record):
    """Whether the machine suits an autobalancer, and the command of the change that was tried, if one mends it."""

    left_out: ClassVar[frozenset[str]] = frozenset({"change", "in_vain"})

    word: Annotated[str, Quantity("verdict", "", 4, "suits, suits-but, does-not-suit or not-known")]
    sentence: Annotated[str, Quantity("in a sentence")]
    next: Annotated[str | None, Quantity("next command")]
    promise: Annotated[
        Mapping[str, str | float | None] | None, Quantity("what the next command moves: path of the result, from, to")
    ]
    leave_out: Annotated[bool, Quantity("no change of the file makes the balls help")] = False
    change: Annotated[str | None, Quantity("the change that was tried, without what it replaces")] = None
    in_vain: Annotated[bool, Quantity("no change of the file was found")] = False

    @classmethod
    def of(
        cls, checks: Sequence[Check], benefit: str, reading: Provenance, entries: Sequence[str] = (),
        promise: Mapping[str, str | float | None] | None = None, *, incurable: bool = False, change: str | None = None,
    ) -> Self:  # fmt: skip
        """Verdict of these checks: those of the worst grade decide; `benefit`: a sentence for those that suit.

        `reading`: the file, with the entries that a command replaces already, which the next one replaces, too.

        `entries`: those of the change that was tried; `promise`: what it moves; `incurable`: all were tried in vain;
        `change`: it in words.
        """
        grade = worst(checks)
        reasons = _once(map(_reason, faults(checks, grade)))
        more = len(reasons) - MOST_REASONS
        named = "; ".join(reasons[:MOST_REASONS]) + (f"; {more} more" if more > 0 else "")
        sentence = " ".join([BEGINNINGS[grade], *([f"{named}."] if named else []), *_following(checks, grade)])
        if grade in ("pass", "warn") and benefit:
            sentence += f" {benefit}"
        if grade == "pass":
            return cls(word=WORDS[grade], sentence=sentence, next=None, promise=None)
        in_vain = incurable and grade != "not-done"
        if in_vain:
            sentence += " No change of the file was found that mends it."
        step = next_command("abu size", reading, entries) if entries else None
        useless = incurable and any(
            check.status == "fail" and (check.key in OF_BALANCING or check.kind.follows) for check in checks
        )
        return cls(word=WORDS[grade], sentence=sentence, next=step, promise=promise, leave_out=useless, change=change,
                   in_vain=in_vain)  # fmt: skip


def in_capitals(word: str) -> str:
    """The word of a verdict as its sentence begins: no verdict is told by its colour alone.

    >>> in_capitals("does-not-suit"), in_capitals("suits-but")
    ('DOES NOT SUIT', 'SUITS, BUT')
    """
    return word.replace("-but", ", but").replace("-", " ").upper()


def faults(checks: Sequence[Check], grade: Grade) -> list[Check]:
    """The checks of a grade, without those that follow from another one as bad."""
    bad = [check for check in checks if check.requested and check.status != "pass"]
    causes = {check.key for check in bad if RANK.index(check.status) <= RANK.index(grade)}
    return [check for check in bad if check.status == grade and causes.isdisjoint(check.kind.follows)]


def _following(checks: Sequence[Check], grade: Grade) -> list[str]:
    """A sentence on the checks that fail with another one; nothing if none does."""
    counted = faults(checks, grade)
    names = list(dict.fromkeys(
        check.name.partition(", race ")[0] for check in checks
        if grade == check.status == "fail" and check.requested and check not in counted
    ))  # fmt: skip
    if not names:
        return []
    failing = " and ".join(names) if len(names) <= MOST_REASONS else many(len(names), "check")
    return [f"With that, {failing} fail{'s' * (len(names) == 1)}."]


def mm_per_s(level: float) -> float:
    """Rms velocity [mm/s] of a level [dB]."""
    return from_si(velocity_from_level(level), "mm_per_s")


def benefit(place: str, before: float | None, after: float | None, limit: float, quiet: float | None) -> str:
    """What the autobalancer does to the level [dB] at a place, and after how long [s], in a sentence; none if either is
    not known.
    """
    if before is None or after is None:
        return ""
    moves = "falls" if after < before else "rises"
    little = f" by {before - after:.1f} dB only," if 0 <= before - after < LEAST_BENEFIT else ""
    low, high = (number(mm_per_s(level), 2) for level in (after, before))
    text = f"Vibration at the {place} {moves}{little} from {before:.1f} to {after:.1f} dB ({high} to {low} mm/s)"
    late = "" if quiet is None else f"; quiet after {quiet:.2f} s at the latest"
    return f"{text}, limit {limit:g}{late}."


def _once(reasons: Iterable[str]) -> list[str]:
    """Reasons without repetition; one that both races have names neither.

    >>> _once(["not round, race 1 (8 µm)", "not round, race 2 (9 µm)", "too heavy"])
    ['not round (8 µm)', 'too heavy']
    """
    merged: dict[str, str] = {}
    for reason in reasons:
        fault = reason.partition(", race ")[0]
        merged[fault] = re.sub(r", race \d", "", merged[fault]) if fault in merged else reason
    return list(merged.values())


def _reason(check: Check) -> str:
    """What is wrong with a check, with its value and limit; if the value keeps the limit, with what its message says.

    Why a check only warns stands last there, and so does what further start cases do.
    """
    value, limit, code, of_time = check.value, check.limit, CHECK_CODES.get(check.code), check.unit == "s"
    named = code is not None and code.fault and check.name.startswith(code.name)
    fault = f"{code.fault}{check.name.removeprefix(code.name)}" if code and named else check.name
    where, oil = "", re.search(r"\((hot|cold) oil", check.message)
    if check.status == "warn":
        where = " in one start of 1000" if RARE in check.message and LATER not in check.message else (
            f" in {oil[1]} oil" if oil else "")  # fmt: skip
    elif of_time and LATER not in check.message and "given drag rate" in check.message.partition(". ")[0]:
        where = " at the given drag rate"
    if value is None and limit is not None and of_time:
        return f"{fault}{where} (never, at most {limit:g} s)"
    if value is None or limit is None or keeps_limit(check):
        if creeps(check):
            return "the balls still creep at the end of some start cases"
        if where:
            return f"{fault}{where}"
        sentences = check.message.split(". ")
        last = check.status == "warn" or sentences[-1].startswith("Further start cases")
        return f"{fault} ({uncapitalised(sentences[-last].rstrip('.'))})"
    return f"{fault}{where} ({_beside(check, value, limit)})"


def creeps(check: Check) -> bool:
    """True if the balls still creep at the end of some start cases, which all are quiet in time."""
    return check.unit == "s" and keeps_limit(check) and "creep" in check.message


def keeps_limit(check: Check) -> bool:
    """True if the value of a check keeps its limit: another start case or rule decides its grade."""
    value, limit = check.value, check.limit
    return value is not None and limit is not None and (value <= limit if check.bound == "most" else value >= limit)


def _beside(check: Check, value: float, limit: float) -> str:
    """The value with its unit, and the limit, in digits that tell them apart; of start cases their number alone."""
    if check.unit == STARTS_UNIT:
        return many(round(value), "start case")
    digits = next(
        (each for each in range(4 if check.unit == "dB" else 3, 9) if number(value, each) != number(limit, each)), 8
    )
    unit = f" {check.unit}" if check.unit else ""
    return f"{number(value, digits)}{unit}, at {check.bound} {number(limit, digits)}"
