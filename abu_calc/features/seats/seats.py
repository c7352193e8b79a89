"""Judgement of both seats of each bearing, one bearing after another: all that `abu check-fit` prints.

An error of one bearing names its table, and its key if known. Parts that few bearings need are imported on demand.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from abu_calc.features.seats.advice import Rejected, SeatAdvice, Start, admissible, advice, rule_class
from abu_calc.features.seats.bearing import SeatedBearing
from abu_calc.features.seats.changes import actions
from abu_calc.features.seats.checks import clearance_checks, life_checks, seat_checks, short_pair_checks, start_checks
from abu_calc.features.seats.creep import CreepJudgement, creep
from abu_calc.features.seats.drawing_requirements import SeatForm, SeatRequirements, seat_form, seat_requirements
from abu_calc.features.seats.interference import Interval, probable_interference, truncated_clearance_probability
from abu_calc.features.seats.joint import InterferenceLoss, Joint
from abu_calc.features.seats.joints import housing_joint, shaft_joint
from abu_calc.features.seats.lookup import from_table
from abu_calc.features.seats.notes import Item, clearance_note, ledger, seat_intensity, seat_notes
from abu_calc.features.seats.rating_life import RatingLife, rating_life
from abu_calc.foundation.checks import Action, Check
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.units import SI_PER_UNIT
from abu_calc.standards.tolerance_classes import DeviationLimits, Seat

if TYPE_CHECKING:
    from abu_calc.features.seats.clearance import ClearanceLeft
    from abu_calc.features.seats.drawing_requirements import SeatRepair
    from abu_calc.features.seats.life_in_use import LifeInUse
    from abu_calc.features.seats.notes import Group, Selection
    from abu_calc.inputs.rolling_bearing import Bearing as BearingTable


class Admissible(NamedTuple):
    """A tolerance class that neither creeps nor overstresses, its interference [m] and probability of clearance."""

    fit: str
    interference: Interval
    clearance_probability: float


class SeatFit(NamedTuple):
    """One seat: lengths and interferences [m], stress [Pa], load intensity [N/m]; null where a check or note says why.

    `required_interference` is that of a ring under a rotating load; a ring under a load fixed in direction is not held
    to it. `losses` are those included in it beside the load, `ledger` all that are known, counted or not; `groups`
    those of the `selection`; `repair` of a seat whose limits are measured; `rule_fit`: the class by the rules for the
    load alone.
    """

    name: str
    joint: Joint
    fit_given: bool
    probable_interference: Interval
    clearance_probability_truncated: float
    ledger: tuple[Item, ...]
    advice: SeatAdvice
    admissible_fits: tuple[Admissible, ...]
    load_intensity: float | None
    creep: CreepJudgement
    requirements: SeatRequirements
    form: SeatForm
    asked_interference: Interval | None
    selection: "Selection | None"
    groups: "tuple[Group, ...]"
    repair: "SeatRepair | None"
    notes: tuple[str, ...]
    checks: tuple[Check, ...]
    rule_fit: str | None

    @property
    def seat(self) -> Seat:
        """Shaft or housing."""
        return self.joint.seat

    @property
    def fit(self) -> str:
        """Tolerance class of the part, or that its limits are measured."""
        return self.joint.fit_name

    @property
    def part_limits(self) -> DeviationLimits:
        """Limits of the shaft or housing."""
        return self.joint.part

    @property
    def ring_limits(self) -> DeviationLimits:
        """Limits of the ring."""
        return self.joint.ring_limits

    @property
    def interference(self) -> Interval:
        """Theoretical interference."""
        return self.joint.interference

    @property
    def clearance_probability(self) -> float:
        """Probability that a pair is loose."""
        return self.joint.clearance_probability

    @property
    def required_interference(self) -> float | None:
        """Interference that a ring needs under a rotating load, losses included."""
        return self.joint.required.value if self.joint.required else None

    @property
    def required_by(self) -> str | None:
        """The criterion that sets it."""
        return self.joint.required.by if self.joint.required else None

    @property
    def losses(self) -> tuple[InterferenceLoss, ...]:
        """Losses the input asks for, the load aside."""
        return self.joint.losses

    @property
    def permitted_interference(self) -> float:
        """Largest interference that ring and bearing bear."""
        return self.joint.permitted.value

    @property
    def permitted_by(self) -> str:
        """The criterion that sets it."""
        return self.joint.permitted.by

    @property
    def hoop_stress(self) -> float:
        """Hoop stress of the ring at the largest interference, cold or warm."""
        return self.joint.hoop_stress

    @property
    def short_pairs_share(self) -> float | None:
        """Share of pairs with less interference than the specified rule demands."""
        return self.joint.short_pairs

    @property
    def catalogue_fit(self) -> str | None:
        """The class of the makers' catalogue for this seat; None without C or a row."""
        return self.joint.catalogue_class

    @property
    def pressure_kept(self) -> float:
        """Share of the pressure in a solid shaft or a thick housing that this part gives."""
        return self.joint.pressure_kept

    @property
    def recommended_fit(self) -> str | None:
        """The class to write."""
        return self.advice.best.tolerance_class if self.advice.best else None

    @property
    def rejected_fits(self) -> "tuple[Rejected, ...]":
        """The next looser and the next tighter class that will not do, and why."""
        return self.advice.rejected


class BearingSeats(NamedTuple):
    """A bearing's seats, shaft first, the clearance left in it, the group of clearance to order with the advice.

    `group_to_order` suits given classes that hold, too; `group_of_recommended` is enough for the recommended ones.
    """

    bearing: SeatedBearing
    shaft: SeatFit
    housing: SeatFit
    life: RatingLife
    clearance: "ClearanceLeft | None" = None
    group_to_order: str | None = None
    group_of_recommended: str | None = None
    life_in_use: "LifeInUse | None" = None
    actions: "Mapping[str, Action]" = {}  # noqa: RUF012 - a default that nobody changes

    @property
    def seats(self) -> tuple[SeatFit, SeatFit]:
        """Shaft, housing."""
        return self.shaft, self.housing

    @property
    def checks(self) -> tuple[Check, ...]:
        """The checks of both seats, of the bearing's life, and of the clearance."""
        left = clearance_checks(self.bearing, self.clearance)
        in_use = self.life_in_use.checks if self.life_in_use else ()
        checks = (*self.shaft.checks, *self.housing.checks, *life_checks(self.bearing, self.life), *in_use, *left)
        return tuple(
            check.with_action(self.actions[check.code].text) if check.code in self.actions else check
            for check in checks
        )


def seat_bearing(table: "BearingTable") -> BearingSeats:
    """Judge the seats of the bearing that a `[[bearing]]` table describes.

    InputError or RangeError: unknown designation, tolerance class or accuracy class, a size outside their tables.
    """
    return judge(from_table(table))


def judge(bearing: SeatedBearing) -> BearingSeats:
    """Judge both seats of a bearing, with actions that hold as followed."""
    plain = _judged(bearing)
    classes = {f"{seat.seat}_fit": seat.recommended_fit for seat in plain.seats}
    left = plain.clearance
    groups = () if left is None else (left.group_to_choose, plain.group_to_order, plain.group_of_recommended)
    proposed = actions(
        bearing, plain.checks, {key: value for key, value in classes.items() if value},
        [group for group in dict.fromkeys(groups) if group], lambda changed: _judged(changed).checks,
    )  # fmt: skip
    shaft, housing = (seat._replace(checks=_with(proposed, seat.checks)) for seat in plain.seats)
    return plain._replace(shaft=shaft, housing=housing, actions=proposed)


def _with(proposed: "Mapping[str, Action]", checks: Sequence[Check]) -> tuple[Check, ...]:
    """Checks with these actions."""
    return tuple(check.with_action(proposed[check.code].text) if check.code in proposed else check for check in checks)


def _judged(bearing: SeatedBearing) -> BearingSeats:
    """Both seats of a bearing; one without a fit is judged with the field advised.

    A band asked for is meant for the rings that must grip, else for both.
    """
    given = shaft_joint(bearing), housing_joint(bearing)
    recommendation = advice(bearing, *given)
    open_seats = [part.fit is None and part.measured is None for part in (bearing.shaft, bearing.housing)]
    joints = [
        _stand_in(joint, own) if unsaid else joint
        for joint, own, unsaid in zip(given, (recommendation.shaft, recommendation.housing), open_seats, strict=True)
    ]
    asked_of = [joint for joint in joints if joint.must_grip] or joints
    asked = None if bearing.asked_interference is None else Interval(*bearing.asked_interference)
    shaft, housing = (
        _seat_fit(bearing, joint, own, not unsaid, asked if joint in asked_of else None)
        for joint, own, unsaid in zip(joints, (recommendation.shaft, recommendation.housing), open_seats, strict=True)
    )
    order = clearance_note(recommendation)
    shaft, housing = (seat._replace(notes=(*seat.notes, *order)) for seat in (shaft, housing))
    left = _clearance(bearing, *joints)
    return BearingSeats(
        bearing, shaft, housing, rating_life(bearing), left, recommendation.group, recommendation.own_group
    )


def _stand_in(joint: Joint, own: SeatAdvice) -> Joint:
    """The joint that is judged if no class is given: the recommended class, else that of the catalogue."""
    if own.best is not None:
        return own.best
    return joint.with_class(joint.catalogue_class) if joint.catalogue_class else joint


def _clearance(bearing: SeatedBearing, shaft: Joint, housing: Joint) -> "ClearanceLeft | None":
    if bearing.internal_clearance is None:
        return None
    from abu_calc.features.seats.clearance import clearance_left

    return clearance_left(bearing.internal_clearance, bearing, shaft, housing)


def _seat_fit(bearing: SeatedBearing, joint: Joint, own: SeatAdvice, given: bool, asked: Interval | None) -> SeatFit:
    start: Start = (bearing.service.seat_friction, bearing.service.starting_torque)
    creep_result = creep(joint, *start)
    recommended = own.best.tolerance_class if own.best else None
    selection, groups = _sorting(joint, asked)
    rule = rule_class(joint, start)
    wanted = recommended or joint.tolerance_class
    return SeatFit(
        name=bearing.name,
        joint=joint,
        fit_given=given,
        probable_interference=probable_interference(*joint.male_and_female),
        clearance_probability_truncated=truncated_clearance_probability(*joint.male_and_female),
        ledger=ledger(joint),
        advice=own,
        admissible_fits=tuple(
            Admissible(candidate.tolerance_class, candidate.interference, candidate.clearance_probability)
            for candidate in admissible(joint, start, own.best)
        ),
        load_intensity=seat_intensity(bearing, joint),
        creep=creep_result,
        requirements=seat_requirements(joint, wanted, bearing.bearing_class),
        form=seat_form(joint, joint.tolerance_class if given and not joint.measured else wanted, bearing.bearing_class),
        asked_interference=asked,
        selection=selection,
        groups=groups,
        repair=_repair(bearing, joint, wanted),
        notes=seat_notes(bearing, joint, own, given, asked, selection, rule),
        checks=seat_checks(bearing, joint, recommended, rule)
        + start_checks(bearing.name, joint, creep_result, bearing.service.starting_torque, recommended)
        + short_pair_checks(bearing.name, joint, recommended),
        rule_fit=rule,
    )


def _sorting(joint: Joint, asked: Interval | None) -> "tuple[Selection | None, tuple[Group, ...]]":
    if asked is None:
        return None, ()
    from abu_calc.features.seats.notes import selective_groups, sorting_groups

    selection = selective_groups(*joint.male_and_female, asked)
    return selection, sorting_groups(*joint.male_and_female, selection.groups) if selection else ()


def _repair(bearing: SeatedBearing, joint: Joint, advised: str) -> "SeatRepair | None":
    """Repair to the drawing's tolerance class; to the advised one if the drawing gives none.

    None if no limits are measured.
    """
    if joint.measured is None:
        return None
    from abu_calc.features.seats.drawing_requirements import seat_repair

    part = bearing.shaft if joint.seat == "shaft" else bearing.housing
    return seat_repair(joint, part.fit or advised, bearing.designation)


def seat_bearings(tables: "Sequence[BearingTable]") -> tuple[BearingSeats, ...]:
    """Judge the seats of the tables `[[bearing]]`, in their order. Raises InputError, `bearing[0].shaft_fit`."""
    return tuple(_seated(index, table) for index, table in enumerate(tables))


def bearing_notes(judged: Sequence[BearingSeats]) -> Iterator[str]:
    """Sentences on types that were taken and on loads that cannot be, each with its bearings if it is not of all."""
    for sentence_of in (lambda each: each.bearing.taken_as, _rotating_twice):
        sentences = [sentence_of(each) for each in judged]
        for sentence in filter(None, dict.fromkeys(sentences)):
            names = [each.bearing.name for each, own in zip(judged, sentences, strict=True) if own == sentence]
            yield sentence if len(names) == len(judged) else f"{'; '.join(names)}: {sentence}"


def _rotating_twice(judged: BearingSeats) -> str | None:
    """Sentence on a load that is to rotate against both rings, with the classes for an indeterminate one."""
    bearing = judged.bearing
    if not bearing.inner.load == bearing.outer.load == "rotating":
        return None
    inner, outer = (replace(ring, load="indeterminate") for ring in (bearing.inner, bearing.outer))
    other = judge(replace(bearing, inner=inner, outer=outer))
    classes = ["/".join(seat.recommended_fit or "none" for seat in each.seats) for each in (judged, other)]
    return (
        "A load cannot rotate against both rings. If its direction changes against both, it is indeterminate. The file "
        f'is judged as it stands: {classes[0]}. With inner_ring_load and outer_ring_load = "indeterminate": '
        f"{classes[1]} (calculated)."
    )


def _seated(index: int, table: "BearingTable") -> BearingSeats:
    try:
        return seat_bearing(table)
    except InputError as error:
        key = error.place.key or _key_of(table, error.found or "")
        raise error.at(Place(key=f"bearing[{index}].{key}" if key else f"bearing[{index}]")) from None


def _key_of(table: "BearingTable", shown_value: str) -> str | None:
    """The key whose value a message shows, in the unit of the key or in SI: formulas know quantities, not keys."""
    fields = type(table).model_fields
    given = {key: getattr(table, key) for key in fields if key != "name"}
    shown = {key: _as_shown(key, value) for key, value in given.items() if value is not None}
    number = shown_value.split(" ")[0]
    return next((key for key, texts in shown.items() if shown_value in texts or number in texts), None)


def _as_shown(key: str, value: object) -> tuple[str, ...]:
    if not isinstance(value, (int, float)):
        return (str(value),)
    sizes = (SI_PER_UNIT[unit] for unit in SI_PER_UNIT if key.endswith(f"_{unit}"))
    return (f"{value:g}", *(f"{value * size:g}" for size in sizes))


def bearing_checks(tables: "Sequence[BearingTable]") -> tuple[Check, ...]:
    """Checks of all bearings of a file."""
    return tuple(check for bearing in seat_bearings(tables) for check in bearing.checks)
