"""Checks of a design and the status of several, with the meaning of each check code.

A code has its question, a condition for each grade, its action, its unit and its bound; `abu explain CODE` shows the
texts. They are in check_data/, one file for each hundred, read when one of its codes is first requested.
"""

import math
import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import EllipsisType
from typing import Final, Literal, NamedTuple

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import SI_PER_UNIT, SYMBOLS, from_si

_DATA: Final = Path(__file__).parent / "check_data"

HUNDREDS: Final = {
    "ABU1": "speeds",
    "ABU2": "autobalancer",
    "ABU3": "strength",
    "ABU4": "vibration",
    "ABU5": "swing_arm",
    "ABU6": "seats",
    "ABU7": "simulation",
    "ABU8": "trust",
    "ABU9": "files",
    "ABU10": "balancing",
    "ABU11": "identification",
}
"""The file of each hundred, by what stands before the last two digits of its codes."""


Bound = Literal["most", "least"]
"""Whether a limit is the most or the least that a value may be."""


@dataclass(frozen=True)
class CheckCode:
    """One kind of check: its code, its name, its question, the condition of each grade that it can get, its action.

    A condition is a sentence that goes on after "PASS if"; it is empty if the check cannot get that grade.
    """

    code: str
    name: str
    question: str
    action: str
    key: str = ""
    """The word by which a check of this kind is looked up, if it ever is."""
    unit: str | None = None
    """Unit of value and limit for readers: a suffix of units.py, or a word if they are no SI numbers; None: no unit."""
    bound: Bound = "most"
    follows: tuple[str, ...] = ()
    """Keys of the kinds with which this one fails: one fault counts once."""
    fault: str = ""
    """What is wrong where it is not passed, in a few words; empty: the name says it."""
    pass_if: str = ""
    warn_if: str = ""
    fail_if: str = ""
    not_evaluated_if: str = ""
    step: str = ""
    """The step of `abu explain` that it belongs to, if any."""
    formulas: tuple[str, ...] = ()
    """Keys of the formulas that decide it."""


CONDITIONS: Final = {"pass": "PASS", "warn": "WARN", "fail": "FAIL", "not_evaluated": "NOT EVALUATED"}
"""Keys of the conditions in check_data/, with the grades as people read them."""


@cache
def _hundred(file: str) -> dict[str, CheckCode]:
    """Codes of one file; a code `as` another takes all but its name from that."""
    codes: dict[str, CheckCode] = {}
    for code, table in tomllib.loads((_DATA / f"{file}.toml").read_text(encoding="utf-8")).items():
        if "as" in table:
            codes[code] = replace(codes[table["as"]], code=code, name=table["name"])
        else:
            conditions = {f"{grade}_if": table.pop(grade, "") for grade in CONDITIONS}
            lists = {name: tuple(table.get(name, ())) for name in ("formulas", "follows")}
            codes[code] = CheckCode(code, **table | conditions | lists)
    return codes


def number_of(code: str) -> int:
    """Number of a code, by which checks are ordered."""
    return int(code.removeprefix("ABU"))


class _Codes(Mapping[str, CheckCode]):
    """All codes; looking one up reads the file of its hundred alone."""

    def __getitem__(self, code: str) -> CheckCode:
        return _hundred(HUNDREDS[code[:-2]])[code]

    def __iter__(self) -> Iterator[str]:
        return iter(sorted((code for file in HUNDREDS.values() for code in _hundred(file)), key=number_of))

    def __len__(self) -> int:
        return sum(1 for _ in self)


CHECK_CODES: Final[Mapping[str, CheckCode]] = _Codes()
"""Check codes by their names."""


Status = Literal["pass", "fail", "not-done"]
"""Status of a whole result."""
Grade = Literal["pass", "warn", "fail", "not-done"]
"""Grade of one check; warn: the usual rule holds, a stricter one or the worst case does not."""


RANK: Final[tuple[Grade, ...]] = ("fail", "not-done", "warn", "pass")
"""Grades from the worst to the best."""

WORDS: Final[Mapping[str, str]] = {"pass": "PASS", "warn": "WARN", "fail": "FAIL", "not-done": "NOT EVALUATED"}
"""Grades as people read them."""


@dataclass(frozen=True)
class Action:
    """What a reader can do about a check: a sentence, and the entries of the file that do it, each for one `--set`."""

    text: str
    overrides: tuple[str, ...] = ()


@dataclass(frozen=True)
class Check:
    """One requirement held against one value, both in `unit` as printed (user units); null where it has none.

    `bound`: whether the limit is the most or the least that the value may be.
    """

    code: str
    name: str
    status: Grade
    message: str
    value: float | None = None
    limit: float | None = None
    unit: str | None = None
    remedy: str | None = None
    bound: Bound = "most"
    overrides: tuple[str, ...] = ()
    """Entries of the file that the action replaces, such as "machine.mass_kg=5.6"; `--set` takes each."""

    def __repr__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        numbers = [f"{self.value:.5g}{unit}"] if self.value is not None else []
        numbers += [f"limit {self.limit:.5g}{unit}"] if self.limit is not None else []
        within = f" ({', '.join(numbers)})" if numbers else ""
        return f"<Check {self.code} {WORDS[self.status]}: {self.name}{within}>"

    @property
    def kind(self) -> CheckCode:
        """The kind of its code."""
        return CHECK_CODES[self.code]

    @property
    def key(self) -> str:
        """The key of its kind."""
        return self.kind.key

    @property
    def requested(self) -> bool:
        """False of a check whose data are optional and missing: the status does not wait for it."""
        return True

    def with_action(self, action: "Action | str | None") -> "Check":
        """The check with another action."""
        text, overrides = parts_of(action)
        return replace(self, remedy=text, overrides=overrides)


@dataclass(frozen=True)
class OptionalCheck(Check):
    """A check that was not done since its optional data are missing."""

    __repr__ = Check.__repr__

    @property
    def requested(self) -> bool:
        """The status does not wait for it."""
        return False


def parts_of(action: Action | str | None) -> tuple[str | None, tuple[str, ...]]:
    """Sentence and entries of an action; none of an action that no entry of a file makes."""
    return (action.text, action.overrides) if isinstance(action, Action) else (action, ())


class Finding(NamedTuple):
    """What is found of a requirement, in SI, before the check with its code is made of it."""

    status: Grade
    message: str
    value: float | None = None
    limit: float | None = None
    action: Action | str | None = None


def coded(
    code: str, status: Grade, message: str, value: float | EllipsisType | None = ..., limit: float | None = None,
    remedy: Action | str | None = None, *, of: str = "", unit: str | None = None, bound: Bound | None = None,
    requested: bool = True,
) -> Check:  # fmt: skip
    """A check by its code, with value and limit in SI; name, unit and bound are those of its kind in check_data/.

    `value`: None if it is not known; without one the check has no number at all. `of`: the one of several things that
    it is of. `unit` and `bound`: for the few kinds with several.

    >>> coded("ABU621", "pass", "…", of="6203").name
    'clearance left in the bearing, 6203'
    >>> check = coded("ABU202", "pass", "…", 15.4e-6, 20e-6)
    >>> f"{check.value:g} {check.unit}, at {check.bound} {check.limit:g}"
    '15.4 µm, at most 20'
    """
    kind = CHECK_CODES[code]
    text, overrides = parts_of(remedy)
    unit = None if value is ... else unit or kind.unit
    made = Check if requested else OptionalCheck
    return made(
        code, f"{kind.name}, {of}" if of else kind.name, status, message if requested else f"{message} (optional)",
        _for_readers(value, unit), _for_readers(limit, unit), unit and SYMBOLS.get(unit, unit), text,
        bound or kind.bound, overrides,
    )  # fmt: skip


def _for_readers(value: float | EllipsisType | None, unit: str | None) -> float | None:
    """An SI number in a unit, a round one freed of the noise of the conversion; unchanged if the unit is no SI one."""
    if value is None or isinstance(value, EllipsisType):
        return None
    if unit not in SI_PER_UNIT:
        return value
    shown = from_si(value, unit)
    short = float(f"{shown:.10g}")
    return short if math.isclose(shown, short, rel_tol=1e-15) else shown


def first_of(checks: Iterable[Check], key: str) -> Check | None:
    """The first check of the kind with this key."""
    return next((check for check in checks if check.key == key), None)


def overall(checks: Iterable[Check]) -> Status:
    """The worst of several: fail before not-done before pass; a warning passes; no checks at all are not-done.

    A check that was not requested does not count.

    >>> overall([])
    'not-done'
    """
    statuses = {check.status for check in checks if check.requested}
    if "fail" in statuses:
        return "fail"
    return "pass" if statuses and statuses <= {"pass", "warn"} else "not-done"


def worst(checks: Iterable[Check]) -> Grade:
    """The worst grade of several checks, a warning above a pass; pass where there are none.

    >>> worst([])
    'pass'
    """
    statuses = {check.status for check in checks if check.requested}
    return next((grade for grade in RANK if grade in statuses), "pass")


def verdict_words(status: Status, checks: Sequence[Check]) -> str:
    """The verdict with the counts of checks by grade.

    >>> verdict_words("pass", [coded("ABU201", "pass", "…"), coded("ABU401", "warn", "…")])
    'PASS WITH WARNINGS: 1 of 2 checks passes, 1 warns, 0 fail'
    """
    count = Counter(check.status for check in checks if check.requested)
    total, word = sum(count.values()), WORDS[status]
    if not total:
        return f"{word}: there are no checks"
    verb = "passes" if count["pass"] == 1 else "pass"
    clauses = [f"{count['pass']} of {total} check{'' if total == 1 else 's'} {verb}"]
    if count["pass"] < total:
        clauses += [
            f"{count['warn']} {'warns' if count['warn'] == 1 else 'warn'}",
            f"{count['fail']} {'fails' if count['fail'] == 1 else 'fail'}",
        ]
    if count["not-done"]:
        clauses.append(f"{count['not-done']} not evaluated")
    return f"{verdict_word(status, checks)}: {', '.join(clauses)}"


def verdict_word(status: Status, checks: Sequence[Check]) -> str:
    """The verdict in words: a pass with warnings is called so."""
    warned = status == "pass" and any(check.status == "warn" and check.requested for check in checks)
    return f"{WORDS[status]} WITH WARNINGS" if warned else WORDS[status]


def verdict_codes(status: Status, checks: Sequence[Check]) -> str:
    """The verdict with the codes of the checks that decide it.

    >>> verdict_codes("pass", [coded("ABU201", "pass", "…"), coded("ABU401", "warn", "…")])
    'PASS WITH WARNINGS: ABU401'
    """
    grade = "warn" if status == "pass" else status
    codes = dict.fromkeys(check.code for check in checks if check.status == grade and check.requested)
    return f"{verdict_word(status, checks)}{': ' if codes else ''}{' '.join(codes)}"


def verdict(passed: bool, safe: bool = True) -> Grade:
    """The status of a check that was done; `safe`: whether the stricter rule or the worst case passes, too.

    >>> verdict(True), verdict(True, False), verdict(False)
    ('pass', 'warn', 'fail')
    """
    if not passed:
        return "fail"
    return "pass" if safe else "warn"
