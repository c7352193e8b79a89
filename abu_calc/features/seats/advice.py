"""Advice on tolerance classes: for one seat, then for both by the clearance left between them.

The choice depends on the makers' catalogue, the interference, the stress and the clearance left.
"""

from collections.abc import Callable, Iterable
from functools import cache, lru_cache
from typing import Final, NamedTuple

from abu_calc.features.seats.bearing import SeatedBearing
from abu_calc.features.seats.clearance import Mounting, makers_classes
from abu_calc.features.seats.creep import holds_at_start
from abu_calc.features.seats.interference import of_all
from abu_calc.features.seats.joint import Joint
from abu_calc.foundation.errors import RangeError
from abu_calc.foundation.units import from_si
from abu_calc.standards.bearing_catalogue import GROUPS, radial_clearance
from abu_calc.standards.tolerance_classes import MakerFits, Seat, tolerance_classes

LOOSE_ENOUGH: Final = 0.5
"""A ring under a load fixed in direction should be loose in at least half of all pairs: it creeps, spreads its wear
and can be moved along its seat."""

_USUAL_GRADE: Final[dict[Seat, str]] = {"shaft": "6", "housing": "7"}
_SLIDING: Final[dict[Seat, str]] = {"shaft": "h6", "housing": "H7"}

Start = tuple[float, float | None]
"""Friction coefficient of the seat, starting torque [N·m] (None: not given)."""


class Rejected(NamedTuple):
    """A neighbour of the recommended tolerance class, and why it fails."""

    fit: str
    why: str


def advised(joint: Joint, start: Start, usual: MakerFits | None) -> Joint | None:
    """The joint with the recommended tolerance class; None if no tabulated one passes.

    With C known the maker's class (the given one where the same row names it), tightened until the mean interference
    reaches what the ring needs, loosened where stress forbids. Without C the loosest class whose smallest interference
    reaches it. Without a load, or where nothing else decides, `usual`, the maker's class for normal loads.
    """
    maker = joint.maker
    if maker is None and joint.must_grip and joint.required is not None:
        return _by_smallest(joint, start) or _first(_by_mean(joint), start)
    row = maker or usual
    classes = row.classes if row else (_SLIDING[joint.seat],)
    named = joint.measured is None and joint.tolerance_class in classes
    base = joint.with_class(joint.tolerance_class if named else classes[0])
    above = [candidate for candidate in _like(base) if candidate.mean > base.mean]
    below = [candidate for candidate in reversed(_like(base)) if candidate.mean < base.mean]
    return _first((base, *above, *below), start)


def admissible(joint: Joint, start: Start, best: Joint | None) -> tuple[Joint, ...]:
    """The joint with every tabulated class whose grip and stress do not fail: the best, then the nearest of its grade,
    then those of others."""
    passing = [candidate for candidate in _by_mean(joint) if _will_do(candidate, start)]
    if best is None:
        return tuple(passing)
    grade = _grade(best.tolerance_class)

    def order(candidate: Joint) -> tuple[bool, bool, float]:
        name = candidate.tolerance_class
        return name != best.tolerance_class, _grade(name) != grade, round(abs(candidate.mean - best.mean), 12)

    return tuple(sorted(passing, key=order))


def neighbours(best: Joint, start: Start, too_tight: Callable[[Joint], str | None]) -> tuple[Rejected, ...]:
    """The next looser and the next tighter class of the grade that fail; `too_tight` judges the bearing's clearance."""
    ladder = _like(best)
    looser = [joint for joint in reversed(ladder) if joint.mean < best.mean]
    tighter = [joint for joint in ladder if joint.mean > best.mean]
    rejections = []
    for way in (looser, tighter):
        why = ((joint, _why_not(joint, start) or too_tight(joint)) for joint in way)
        # The first alone is asked for: what the others leave of the clearance is not integrated.
        first = next((Rejected(joint.tolerance_class, reason) for joint, reason in why if reason), None)
        rejections += [first] if first else []
    return tuple(rejections)


def looser_that_hold(best: Joint, start: Start) -> tuple[Joint, ...]:
    """Looser classes of the grade that hold by the mean, the tightest first."""
    return tuple(joint for joint in reversed(_like(best)) if joint.mean < best.mean and _will_do(joint, start))


def _by_smallest(joint: Joint, start: Start) -> Joint | None:
    """The loosest whose smallest interference does, of the given or usual grade first."""
    grades = (_grade(joint.tolerance_class), _USUAL_GRADE[joint.seat])
    passing = [candidate for candidate in _by_mean(joint) if candidate.grip == "pass" and _will_do(candidate, start)]

    def order(candidate: Joint) -> tuple[int, float, float]:
        grade = _grade(candidate.tolerance_class)
        by_grade = grades.index(grade) if grade in grades else len(grades)
        return by_grade, candidate.interference.smallest, candidate.interference.largest

    return min(passing, key=order, default=None)


def _first(joints: Iterable[Joint], start: Start) -> Joint | None:
    return next((joint for joint in joints if _will_do(joint, start)), None)


def _will_do(joint: Joint, start: Start) -> bool:
    return joint.holds and holds_at_start(joint, *start) is not False


def _why_not(joint: Joint, start: Start) -> str | None:
    if joint.pinched:
        return "the halves of the split housing pinch the ring"
    if joint.grip == "fail" and joint.required is not None and joint.short is not None:
        needed, mean = from_si(joint.required.value, "um"), from_si(joint.mean, "um")
        short = of_all(joint.short)
        return f"the ring creeps: mean interference {mean:.3g} µm of {needed:.3g} µm required, {short} have less"
    if joint.stress == "fail":
        limit = from_si(joint.stress_limit.value, "um")
        return (
            f"largest interference {from_si(joint.tightest, 'um'):.3g} µm, {limit:.3g} µm permitted by "
            f"{joint.stress_limit.by}"
        )
    if holds_at_start(joint, *start) is False:
        return "the ring slips under the starting torque"
    if not joint.must_grip and joint.clearance_probability < LOOSE_ENOUGH:
        return f"the ring can hardly move: {of_all(joint.clearance_probability)} have clearance"
    return None


def _by_mean(joint: Joint) -> tuple[Joint, ...]:
    """Every tabulated class, from loose to tight."""
    return _classes(joint.with_class(tolerance_classes(joint.seat)[0]))


@lru_cache(maxsize=4)
def _classes(joint: Joint) -> tuple[Joint, ...]:
    """The same joints for all who ask of one seat, so that what they work out is worked out once."""
    joints = (joint.with_class(name) for name in tolerance_classes(joint.seat))
    return tuple(sorted(joints, key=lambda candidate: (candidate.mean, candidate.interference.smallest)))


def _like(joint: Joint) -> tuple[Joint, ...]:
    """Classes of the grade, from loose to tight; beyond the tightest those of the next coarser grades."""
    grade = int(_grade(joint.tolerance_class))
    every = _by_mean(joint)
    own = [fit for fit in every if int(_grade(fit.tolerance_class)) == grade]
    top = max(fit.mean for fit in own)
    return (*own, *(fit for fit in every if int(_grade(fit.tolerance_class)) > grade and fit.mean > top))


@cache
def _grade(tolerance_class: str) -> str:
    return tolerance_class.lstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ")


_USUAL_GROUP: Final = "CN"
SHARE_TO_ORDER: Final = 0.05
"""Share of bearings without clearance up to which a group is still the one to order; assumed. The makers' own js5 … j6
with CN stay below it, their k5, for which they ask for more clearance, lies above."""


class SeatAdvice(NamedTuple):
    """The joint with the recommended class (None: no tabulated one passes), and the next ones that fail."""

    best: Joint | None
    rejected: tuple[Rejected, ...]


class JointAdvice(NamedTuple):
    """Advice on both seats, and the clearance group to order with them.

    The group is None if the bearing is not a deep groove ball bearing, or if there is no group.
    """

    shaft: SeatAdvice
    housing: SeatAdvice
    group: str | None


def advice(bearing: SeatedBearing, shaft: Joint, housing: Joint) -> JointAdvice:
    """Recommended tolerance classes, with the group of clearance that stays above zero in all but few bearings.

    If the classes leave no clearance in the group given, a looser group is named in place of it. If no group keeps its
    clearance, the shaft's class is loosened as far as its mean interference allows.
    """
    start: Start = (bearing.service.seat_friction, bearing.service.starting_torque)
    inner = advised(shaft, start, makers_classes(bearing, "shaft"))
    outer = advised(housing, start, makers_classes(bearing, "housing"))
    group = None
    if _has_groups(bearing) and inner is not None and outer is not None:
        for candidate in (inner, *looser_that_hold(inner, start)):
            group = _group(bearing, candidate, outer)
            if group is not None:
                inner = candidate
                break
    return JointAdvice(
        _with_neighbours(bearing, inner, outer, start, group),
        _with_neighbours(bearing, outer, inner, start, group),
        group,
    )


def _with_neighbours(
    bearing: SeatedBearing, best: Joint | None, other: Joint | None, start: Start, group: str | None
) -> SeatAdvice:
    def too_tight(joint: Joint) -> str | None:
        if group is None or other is None:
            return None
        pair = (joint, other) if joint.seat == "shaft" else (other, joint)
        share = Mounting(bearing, *pair).share_below(group)
        text = f"no operating clearance is left in {of_all(share, 'bearings')} of group {group}"
        return text if share > SHARE_TO_ORDER else None

    return SeatAdvice(best, neighbours(best, start, too_tight) if best else ())


def _has_groups(bearing: SeatedBearing) -> bool:
    if bearing.kind != "ball":
        return False
    try:
        radial_clearance(_USUAL_GROUP, bearing.inner.diameter)
    except RangeError:
        return False
    return True


def _group(bearing: SeatedBearing, shaft: Joint, housing: Joint) -> str | None:
    """The group given or a looser one, the usual one or a looser where none is given: the first that keeps."""
    mounting = Mounting(bearing, shaft, housing)
    first = GROUPS.index(bearing.internal_clearance or _USUAL_GROUP)
    return next((group for group in GROUPS[first:] if mounting.share_below(group) <= SHARE_TO_ORDER), None)
