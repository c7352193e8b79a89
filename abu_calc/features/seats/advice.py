"""Advice on tolerance classes: for one seat, then for both by the clearance left between them.

The choice depends on the makers' catalogue, the interference, the stress and the clearance left.

Changes of tolerance classes and of the clearance group, each followed and judged before it is told.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache, lru_cache
from typing import Annotated, Final, NamedTuple

from abu_calc.features.seats.bearing import SeatedBearing
from abu_calc.features.seats.clearance import PRELOADED, fails, lighter_group, tightest_state
from abu_calc.features.seats.creep import holds_at_start
from abu_calc.features.seats.interference import Pair, SeatRecord, of_all
from abu_calc.features.seats.joint import LOOSE_ENOUGH, Joint
from abu_calc.features.seats.joints import makers_classes
from abu_calc.foundation.checks import RANK, Action, Check
from abu_calc.foundation.errors import RangeError
from abu_calc.foundation.moved import Moved
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.foundation.units import shown
from abu_calc.standards.internal_clearance import groups_of, internal_clearance, usual_group
from abu_calc.standards.tolerance_classes import MakerFits, Seat, tolerance_classes

_USUAL_GRADE: Final[dict[Seat, str]] = {"shaft": "6", "housing": "7"}
_SLIDING: Final[dict[Seat, str]] = {"shaft": "h6", "housing": "H7"}

Start = tuple[float, float | None]
"""Friction coefficient of the seat, starting torque [N·m] (None: not given)."""


@record
class RejectedFit(SeatRecord):
    """A neighbour of the recommended tolerance class, which fails."""

    fit: Annotated[str, Quantity("tolerance class")]
    why: Annotated[str, Quantity("why not")]


@record
class AdmissibleFit(SeatRecord):
    """A tolerance class that neither creeps nor overstresses."""

    fit: Annotated[str, Quantity("tolerance class")]
    interference: Annotated[Pair, Quantity("interference", "", 4, "least and most; negative: clearance", unit="um")]
    clearance_probability: Annotated[float, Quantity("probability of clearance", "", 3)]


def advised(joint: Joint, start: Start, usual: MakerFits | None) -> Joint | None:
    """The joint with the recommended tolerance class; None if no tabulated one passes.

    With C known the catalogue's class (the given one where the same row names it), tightened until few pairs are short
    of what the rule demands, loosened where stress forbids. Without C the loosest class whose smallest interference
    reaches it. Without a load, or where nothing else decides, `usual`, the maker's class for normal loads. A ring under
    a load fixed in direction gets a looser class if warmth or cold would make it tight.
    """
    maker = joint.maker
    if maker is None and joint.must_grip and joint.required is not None:
        return _by_smallest(joint, start) or _best(_by_mean(joint), start)
    row = maker or usual
    classes = row.classes if row else (_SLIDING[joint.seat],)
    first = joint.catalogue_class or classes[0]
    named = joint.measured is None and first == classes[0] and joint.tolerance_class in classes
    base = joint.with_class(joint.tolerance_class if named else first)
    above = [candidate for candidate in _like(base) if candidate.mean > base.mean]
    below = [candidate for candidate in reversed(_like(base)) if candidate.mean < base.mean]
    if not joint.must_grip and not joint.runs_on_needles and base.loose_share() >= LOOSE_ENOUGH:
        # In light alloys the class is one for warmth; what cold does to it no class of the row helps.
        looser = (fit for fit in (base, *below) if not fit.turns_tight and not joint.light_alloy)
        return _best((*looser, base), start)
    return _best((base, *above, *below), start)


def rule_class(joint: Joint, start: Start) -> str | None:
    """The loosest class whose smallest interference the rules for the load ask for; None if none is tight enough.

    The catalogue plays no part in it. A ring under a load fixed in direction has none.
    """
    if not joint.must_grip or joint.required is None:
        return None
    loosest = _by_smallest(replace(joint, maker=None), start)
    return loosest.tolerance_class if loosest else None


def admissible(joint: Joint, start: Start, best: Joint | None) -> tuple[AdmissibleFit, ...]:
    """Every tabulated class whose grip and stress do not fail: the best, then the nearest of its grade, then others."""
    passing = [candidate for candidate in _by_mean(joint) if _will_do(candidate, start)]

    def order(candidate: Joint) -> tuple[bool, bool, float]:
        assert best is not None
        name, grade = candidate.tolerance_class, _grade(best.tolerance_class)
        return name != best.tolerance_class, _grade(name) != grade, round(abs(candidate.mean - best.mean), 12)

    return tuple(
        AdmissibleFit(
            fit=candidate.tolerance_class, interference=candidate.interference,
            clearance_probability=candidate.clearance_probability,
        )
        for candidate in (passing if best is None else sorted(passing, key=order))
    )  # fmt: skip


def neighbours(best: Joint, start: Start, too_tight: Callable[[Joint], str | None]) -> tuple[RejectedFit, ...]:
    """The next looser and the next tighter class of the grade that fail; `too_tight` judges the bearing's clearance."""
    ladder = _like(best)
    looser = [joint for joint in reversed(ladder) if joint.mean < best.mean]
    tighter = [joint for joint in ladder if joint.mean > best.mean]
    rejections = []
    for way in (looser, tighter):
        why = ((joint, _why_not(joint, start) or too_tight(joint)) for joint in way)
        # The first alone is asked for: what the others leave of the clearance is not integrated.
        first = next((RejectedFit(fit=joint.tolerance_class, why=reason) for joint, reason in why if reason), None)
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


def _best(joints: Iterable[Joint], start: Start) -> Joint | None:
    """The first that holds with few short pairs, else the first that holds."""
    holding = [joint for joint in joints if _will_do(joint, start)]
    return next((joint for joint in holding if joint.short_grade != "warn"), holding[0] if holding else None)


def _will_do(joint: Joint, start: Start) -> bool:
    return joint.holds and holds_at_start(joint, *start) is not False


def _why_not(joint: Joint, start: Start) -> str | None:
    if joint.pinched:
        return "the halves of the split housing pinch the ring"
    if joint.grip == "fail" and joint.required is not None and joint.short is not None:
        mean, needed = shown(joint.mean, "um"), shown(joint.required.value, "um")
        return f"the ring creeps: mean interference {mean} of {needed} required, {of_all(joint.short)} have less"
    if joint.short_grade == "fail" and joint.short_pairs is not None and joint.demand is not None:
        return f"{of_all(joint.short_pairs)} have less than the {shown(joint.demand.value, 'um')} demanded"
    if joint.stress == "fail":
        limit = shown(joint.stress_limit.value, "um")
        return f"largest interference {shown(joint.tightest, 'um')}, {limit} permitted by {joint.stress_limit.by}"
    if holds_at_start(joint, *start) is False:
        return "the ring slips under the starting torque"
    if joint.runs_on_needles:
        tight = shown(-joint.interference.largest, "um")
        least = f"the needles may run without clearance: {tight} at the tightest"
        return None if joint.interference.largest <= 0 else least
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


PAIRED: Final = frozenset({"tapered", "angular-contact"})
"""Kinds whose clearance is that of a pair."""
SHARE_TO_ORDER: Final = 0.01
"""Share of bearings without clearance up to which a group is still the one to order; assumed."""
SHARE_OF_MAKERS: Final = 0.05
"""The same for a catalogue's own class on the shaft with a loose ring in the housing; assumed. The makers' js5 … j6
with CN stay below it but for two bearings. Their k5, for which they ask for more clearance, lies above."""


class SeatAdvice(NamedTuple):
    """The joint with the recommended class (None: no tabulated one passes), and the next ones that fail."""

    best: Joint | None
    rejected: tuple[RejectedFit, ...]


class JointAdvice(NamedTuple):
    """Advice on both seats, and the clearance group to order with them.

    The group is None if the bearing is not a deep groove ball bearing, or if there is no group. `own_group` suffices
    for the recommended classes; `group` suits given ones that hold, too.
    """

    shaft: SeatAdvice
    housing: SeatAdvice
    group: str | None
    own_group: str | None


def advice(bearing: SeatedBearing, shaft: Joint, housing: Joint) -> JointAdvice:
    """Recommended tolerance classes, with the group of clearance that stays above zero in all but few bearings.

    No seat helps a bearing whose static load is above C0: the ring under a rotating load gets no class then.

    If the classes leave no clearance in the group given, a looser group is named in place of it. If no group keeps its
    clearance, the classes are loosened as far as their mean interference allows. If that does not help, and the group
    given fails, no class is advised.
    """
    start: Start = (bearing.service.seat_friction, bearing.service.starting_torque)
    inner, outer = (
        None if _hopeless(bearing, joint) else advised(joint, start, makers_classes(bearing, joint.seat))
        for joint in (shaft, housing)
    )
    group = own = None
    if inner is not None and outer is not None and (_has_groups(bearing) or bearing.internal_clearance is not None):
        (inner, outer), own = _with_clearance(bearing, inner, outer, start)
        group = _group_for_given(bearing, shaft, housing, (inner, outer), own) if _has_groups(bearing) else own
        if own is None and _without_clearance(bearing, inner, outer):
            inner = outer = None
    return JointAdvice(
        _with_neighbours(bearing, inner, outer, start, group),
        _with_neighbours(bearing, outer, inner, start, group),
        group,
        own,
    )


def _with_clearance(
    bearing: SeatedBearing, inner: Joint, outer: Joint, start: Start
) -> tuple[tuple[Joint, Joint], str | None]:
    """Both seats with the group that keeps its clearance: as advised, the shaft looser, the housing looser, or both.

    The seats as advised and no group if none keeps it.
    """
    order = _group if _has_groups(bearing) else _group_of_pair
    shafts, housings = [inner, *looser_that_hold(inner, start)], [outer]
    for housing in housings:
        for shaft in shafts:
            if (group := order(bearing, shaft, housing)) is not None:
                return (shaft, housing), group
        if housing is outer and outer.must_grip:
            housings += looser_that_hold(outer, start)
    return (inner, outer), None


def _without_clearance(bearing: SeatedBearing, inner: Joint, outer: Joint) -> bool:
    """True if the group given fails with these seats: most bearings have no clearance, or the pair is overloaded."""
    given = bearing.internal_clearance
    return given is not None and fails(tightest_state(bearing, inner, outer), given)


def _with_neighbours(
    bearing: SeatedBearing, best: Joint | None, other: Joint | None, start: Start, group: str | None
) -> SeatAdvice:
    def too_tight(joint: Joint) -> str | None:
        if group is None or other is None or group in PRELOADED:
            return None
        pair = (joint, other) if joint.seat == "shaft" else (other, joint)
        share = tightest_state(bearing, *pair).share_below(group)
        things = "pairs" if bearing.kind in PAIRED else "bearings"
        text = f"no operating clearance is left in {of_all(share, things)} of group {group}"
        return text if share > share_to_order(*pair) else None

    if best is None or (bearing.drawn_cup and best.seat == "housing"):  # a drawn cup need not move
        return SeatAdvice(best, ())
    return SeatAdvice(best, neighbours(best, start, too_tight))


def _hopeless(bearing: SeatedBearing, joint: Joint) -> bool:
    """True if no class helps: the load is above C0, or a split housing should hold a drawn cup."""
    if joint.seat == "housing" and bearing.drawn_cup and bearing.housing.split:
        return True
    return overloaded(bearing) and joint.must_grip


def overloaded(bearing: SeatedBearing) -> bool:
    """True if the equivalent static load is above C0."""
    loads, ratings = bearing.equivalent_loads, bearing.ratings
    return loads is not None and ratings is not None and 0 < ratings.static < loads[1]


def _has_groups(bearing: SeatedBearing) -> bool:
    """True if the bearing is ordered with a clearance group.

    The clearance of tapered and angular contact bearings is set by their pair.
    """
    kind = bearing.kind
    if kind is None or bearing.no_inner_ring or kind in PAIRED:
        return False
    try:
        internal_clearance(kind, usual_group(kind), bearing.inner.diameter)
    except RangeError:
        return False
    return True


def _group_of_pair(bearing: SeatedBearing, shaft: Joint, housing: Joint) -> str | None:
    """The group given of a pair, or the next looser (preloaded: lighter) one that its seats allow."""
    given = bearing.internal_clearance
    if given in PRELOADED:
        return lighter_group(tightest_state(bearing, shaft, housing), given)
    return _group(bearing, shaft, housing)


def _group(bearing: SeatedBearing, shaft: Joint, housing: Joint) -> str | None:
    """The group given or a looser one, the usual one or a looser where none is given: the first that keeps."""
    if bearing.kind is None:
        return None
    mounting, groups = tightest_state(bearing, shaft, housing), groups_of(bearing.kind)
    first, most = groups.index(bearing.internal_clearance or usual_group(bearing.kind)), share_to_order(shaft, housing)
    return next((group for group in groups[first:] if mounting.share_below(group) <= most), None)


def share_to_order(shaft: Joint, housing: Joint) -> float:
    """Share of bearings without clearance up to which a group is the one to order with two seats."""
    own = shaft.maker is not None and shaft.tolerance_class in shaft.maker.classes
    loose = not housing.must_grip and housing.clearance_probability >= LOOSE_ENOUGH
    return SHARE_OF_MAKERS if own and loose else SHARE_TO_ORDER


def _group_for_given(
    bearing: SeatedBearing, shaft: Joint, housing: Joint, advised_pair: tuple[Joint, Joint], group: str | None
) -> str | None:
    """The group that also suits the classes given, where they hold and one does: they may stay as they are."""
    if group is None or bearing.kind is None:
        return group
    parts, joints = (bearing.shaft, bearing.housing), (shaft, housing)
    pair = [
        joint if (part.fit or part.measured) and joint.holds and not joint.turns_tight else best
        for part, joint, best in zip(parts, joints, advised_pair, strict=True)
    ]
    given, groups = _group(bearing, pair[0], pair[1]), groups_of(bearing.kind)
    return group if given is None else max(group, given, key=groups.index)


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
