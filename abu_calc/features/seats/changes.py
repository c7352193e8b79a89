"""Changes of tolerance classes and of the clearance group, each followed and judged before it is told."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Final

from abu_calc.features.seats.bearing import SeatedBearing
from abu_calc.foundation.checks import RANK, Action, Check
from abu_calc.foundation.moved import Moved

GROUP: Final = "internal_clearance"
SEATS: Final = {"60": "shaft_fit", "61": "housing_fit"}
"""Key of the tolerance class that checks are of, by the first digits of their codes."""
TRACE: Final = 0.01
"""Share of short pairs [%] below which no digits are shown."""

Entries = Mapping[str, str]
Judged = Callable[[SeatedBearing], Sequence[Check]]


def with_entries(bearing: SeatedBearing, entries: Entries) -> SeatedBearing:
    """The bearing with other tolerance classes or another clearance group."""
    shaft, housing = (
        replace(part, fit=entries[key], measured=None) if key in entries else part
        for key, part in zip(SEATS.values(), (bearing.shaft, bearing.housing), strict=True)
    )
    return replace(
        bearing, shaft=shaft, housing=housing, internal_clearance=entries.get(GROUP, bearing.internal_clearance)
    )


def actions(
    bearing: SeatedBearing, checks: Sequence[Check], classes: Entries, groups: Sequence[str], judged: Judged
) -> dict[str, Action]:
    """The action of each check, by code, that a change of seats or group mends without making another check worse.

    `classes`: those to specify in place of the given ones; `groups`: the clearance groups that may suit.
    """
    known, best = dict[str, Sequence[Check]](), dict[str, tuple[int, Action]]()
    for check in checks:
        changeable = _seat(check) or check.key == "clearance_left"
        if not check.requested or check.status not in ("warn", "fail") or not changeable:
            continue
        for entries in _proposed(check, classes, groups):
            words = _words(entries)
            if words not in known:
                known[words] = judged(with_entries(bearing, entries))
            worth, action = _action(check, entries, checks, known[words])
            if worth > best.get(check.code, (0, action))[0]:
                best[check.code] = worth, action
            if worth == MENDS:
                break
    return {code: action for code, (_, action) in best.items()}


def _seat(check: Check) -> str | None:
    """Key of the tolerance class that a check is of."""
    return SEATS.get(check.code[3:5])


def _proposed(check: Check, classes: Entries, groups: Sequence[str]) -> Iterator[Entries]:
    """The class of the check's own seat, the group alone, both classes; each also with a group."""
    own = {key: value for key, value in classes.items() if key == _seat(check)}
    for seats in (own, classes):
        for group in ({}, *({GROUP: group} for group in groups)):
            if entries := {**seats, **group}:
                yield entries


def _words(entries: Entries) -> str:
    """Entries as a sentence lists them."""
    *first, last = [f"group {value}" if key == GROUP else value for key, value in entries.items()]
    return f"{', '.join(first)} and {last}" if first else last


MENDS, NEARER, NO_CHANGE = 3, 2, 1
"""Worth of an action: a better grade; the same grade, but more clearance; a remark, since another check gets worse."""


def _action(check: Check, entries: Entries, before: Sequence[Check], after: Sequence[Check]) -> tuple[int, Action]:
    """The change with what it does to a check, and its worth; 0 if the check gets no better."""
    ranks, now = {each.code: RANK.index(each.status) for each in before}, {each.code: each for each in after}
    own, good = now.get(check.code, check), len(RANK) - 1
    better = RANK.index(own.status) > ranks[check.code]
    side = 1 if check.bound == "least" else -1
    nearer = check.unit == own.unit and side * ((own.value or 0.0) - (check.value or 0.0)) > 0
    if not better and (check.status == "fail" or not nearer or _seat(check)):
        return 0, Action("")
    worse = [code for code, each in now.items() if each.requested and RANK.index(each.status) < ranks.get(code, good)]
    words, moved = _words(entries), _moved(check, own)
    if worse:
        but = f"With {words} {moved} (calculated), but {' and '.join(worse)} would be worse: no class suits all checks."
        return NO_CHANGE * (better and check.status == "fail"), Action(but)
    then = "passes" if own.status == "pass" else f"still {own.status}s"
    text = f"Specify {words}: {moved} (calculated). Then {check.code} {then}."
    return MENDS if better else NEARER, Action(text, tuple(f"{key}={value}" for key, value in entries.items()))


def _moved(check: Check, now: Check) -> str:
    """The number of a check before and after a change, in words."""
    before, after, unit = check.value or 0.0, now.value or 0.0, now.unit or ""
    if check.unit == "%" and after < TRACE:
        return f"the share falls from {before:.3g} to under {TRACE:g} %"
    name = f"the {'share' if unit == '%' else now.message.partition(' of ')[0]}"
    if check.unit != unit:
        return f"{name} is {after:.3g} {unit}"
    return Moved(name, before, after, unit, now.limit).text
