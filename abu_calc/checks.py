"""A check of a design and the status of several: what every step of the way may hand on beside its numbers."""

from collections.abc import Iterable
from typing import Literal

from abu_calc.frozen import dataclass

Status = Literal["pass", "fail", "not-done"]
"""Status of a whole result."""
Grade = Literal["pass", "warn", "fail", "not-done"]
"""Grade of one check; warn: the usual rule holds, a stricter one or the worst case does not."""


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
    bound: Literal["most", "least"] = "most"


def coded(
    code: str, status: Grade, message: str, value: float | None = None, limit: float | None = None,
    unit: str | None = None, remedy: str | None = None, bound: Literal["most", "least"] = "most", *, of: str = "",
) -> Check:  # fmt: skip
    """A check by its code, whose name stands in the table of codes; `of` names the one of several that it is of.

    >>> coded("ABU621", "pass", "…", of="6203").name
    'clearance left in the bearing, 6203'
    """
    from abu_calc.check_codes import CHECK_CODES  # help texts need none

    name = CHECK_CODES[code].name
    return Check(code, f"{name}, {of}" if of else name, status, message, value, limit, unit, remedy, bound)


def overall(checks: Iterable[Check]) -> Status:
    """The worst of several: fail before not-done before pass; a warning passes; no checks at all are not-done.

    >>> overall([])
    'not-done'
    """
    statuses = {check.status for check in checks}
    if "fail" in statuses:
        return "fail"
    return "pass" if statuses and statuses <= {"pass", "warn"} else "not-done"


def worst(checks: Iterable[Check]) -> Grade:
    """The worst grade of several checks, a warning above a pass; pass where there are none.

    >>> worst([])
    'pass'
    """
    statuses = {check.status for check in checks}
    order: tuple[Grade, ...] = ("fail", "not-done", "warn", "pass")
    return next((grade for grade in order if grade in statuses), "pass")


def verdict(passed: bool, safe: bool = True) -> Grade:
    """The status of a check that was done; `safe`: whether the stricter rule or the worst case passes, too.

    >>> verdict(True), verdict(True, False), verdict(False)
    ('pass', 'warn', 'fail')
    """
    if not passed:
        return "fail"
    return "pass" if safe else "warn"
