"""Judgement of both seats of each bearing, one bearing after another: all that `abu check-fit` prints.

An error of one bearing names its table, and its key if known. Parts that few bearings need are imported on demand.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, NamedTuple

from abu_calc.features.seats.advice import (
    AdmissibleFit,
    JointAdvice,
    RejectedFit,
    SeatAdvice,
    Start,
    actions,
    admissible,
    advice,
    rule_class,
    share_to_order,
)
from abu_calc.features.seats.bearing import SeatedBearing
from abu_calc.features.seats.checks import (
    clearance_checks,
    life_checks,
    no_better,
    seat_checks,
    short_pair_checks,
    start_checks,
)
from abu_calc.features.seats.clearance import Clearance, clearance_left
from abu_calc.features.seats.creep import Creep, creep
from abu_calc.features.seats.drawing_requirements import (
    DrawnForm,
    Repair,
    Requirements,
    seat_form,
    seat_repair,
    seat_requirements,
)
from abu_calc.features.seats.interference import (
    Interval,
    Pair,
    SeatRecord,
    probable_interference,
    truncated_clearance_probability,
    um,
)
from abu_calc.features.seats.joint import Joint, Loss, ThermalInterference
from abu_calc.features.seats.joints import (
    SeatMounting,
    at_work,
    clearance_at_work,
    housing_joint,
    seat_mounting,
    shaft_joint,
)
from abu_calc.features.seats.life_in_use import LifeInUse, SimulatedLife
from abu_calc.features.seats.lookup import from_table
from abu_calc.features.seats.notes import (
    Selection,
    SortingGroup,
    clearance_note,
    ledger,
    seat_intensity,
    seat_notes,
    selective_groups,
    sorting_groups,
)
from abu_calc.features.seats.rating_life import RatingLife, rating_life
from abu_calc.foundation.checks import Action, Check, Grade, worst
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.foundation.units import SI_PER_UNIT
from abu_calc.standards.tolerance_classes import Seat

if TYPE_CHECKING:
    from abu_calc.inputs.rolling_bearing import Bearing as BearingTable


@record
class SeatResult(SeatRecord):
    """One seat, judged; interference is positive, clearance negative, limits count from the nominal size."""

    left_out: ClassVar[frozenset[str]] = frozenset({"joint", "checks"})

    joint: Joint
    checks: tuple[Check, ...]
    name: Annotated[str, Quantity("bearing")]
    seat: Annotated[Seat, Quantity("seat")]
    fit: Annotated[str, Quantity("tolerance class", "", 4, "measured if limits are given in its place")]
    fit_given: Annotated[bool, Quantity("whether a tolerance class is given, else the recommended one is judged")]
    part_limits: Annotated[Pair, Quantity("limits of the part", unit="um")]
    ring_limits: Annotated[Pair, Quantity("limits of the ring", unit="um")]
    interference: Annotated[Pair, Quantity("interference", "", 4, "ei − ES … es − EI", unit="um")]
    probable_interference: Annotated[
        Pair, Quantity("probable interference", "", 4, "mean ∓ √((T₁/2)² + (T₂/2)²), outward to whole µm", unit="um")
    ]
    clearance_probability: Annotated[float, Quantity("probability of clearance", "Φ(−mean/σ)")]
    clearance_probability_truncated: Annotated[
        float, Quantity("probability of clearance, parts outside their limits sorted out")
    ]
    required_interference: Annotated[
        float | None,
        Quantity("required interference", "", 4, "of a ring under a rotating load, losses included", unit="um"),
    ]
    required_by: Annotated[str | None, Quantity("criterion of the required interference")]
    losses_: Annotated[Mapping[str, float], Quantity("losses counted beside the load", unit="um")]
    losses: tuple[Loss, ...]
    permitted_interference: Annotated[float, Quantity("permitted interference", unit="um")]
    permitted_by: Annotated[str, Quantity("criterion of the permitted interference")]
    hoop_stress: Annotated[float, Quantity("hoop stress", "", 4, "of the ring at the largest interference", unit="MPa")]
    part_stress: Annotated[float, Quantity("hoop stress of the part", "", 4, "at the largest interference", unit="MPa")]
    short_pairs_share: Annotated[
        float | None, Quantity("share of short pairs", "", 3, "less interference than the specified rule demands")
    ]
    pressure_kept: Annotated[
        float, Quantity("share of the pressure kept", "", 3, "of that in a solid shaft or a thick housing")
    ]
    interference_by_temperature: tuple[ThermalInterference, ...]
    at_work: Annotated[
        Mapping[str, Pair], Quantity("interference at work", "", 4, "cold and hot, given or assumed", unit="um")
    ]
    mounting: SeatMounting
    load_ratio: Annotated[float | None, Quantity("load ratio", "P/C", 3, "P the equivalent dynamic load")]
    static_safety: Annotated[float | None, Quantity("static safety", "C0/P0", 3)]
    basic_rating_life: Annotated[float | None, Quantity("basic rating life", "L_10h", 3, unit="h")]
    modified_rating_life: Annotated[
        float | None, Quantity("modified rating life", "", 3, "basic one times a_ISO", unit="h")
    ]
    life_modification: Annotated[float | None, Quantity("life modification factor", "a_ISO", 3)]
    limiting_speed: Annotated[float | None, Quantity("limiting speed", "", 4, "of the catalogue's bearing", unit="rpm")]
    equivalent_load: Annotated[float | None, Quantity("equivalent dynamic load", "P", 3, unit="kN")]
    static_load: Annotated[float | None, Quantity("equivalent static load", "P_0", 3, unit="kN")]
    dynamic_load_rating: Annotated[float | None, Quantity("dynamic load rating", "C", 4, unit="kN")]
    static_load_rating: Annotated[float | None, Quantity("static load rating", "C0", 4, unit="kN")]
    catalogue_bearing: Annotated[str | None, Quantity("catalogue bearing of this size")]
    simulated_life: SimulatedLife | None = None
    maker_fits: Annotated[
        tuple[str, ...], Quantity("the makers' tolerance classes", "", 4, "the first is the usual one")
    ]
    catalogue_fit: Annotated[str | None, Quantity("tolerance class by the catalogue's row")]
    rule_fit: Annotated[
        str | None,
        Quantity("tolerance class by the rules for the load", "", 4, "its loosest pair has what is required"),
    ]
    recommended_fit: Annotated[str | None, Quantity("recommended tolerance class")]
    recommended_clearance: Annotated[str | None, Quantity("clearance to order")]
    clearance_of_recommended: Annotated[
        str | None, Quantity("clearance for the recommended classes", "", 4, "given classes may need a looser group")
    ]
    rejected_fits: tuple[RejectedFit, ...]
    admissible_fits: tuple[AdmissibleFit, ...]
    load_intensity: Annotated[float | None, Quantity("load intensity", "P_R = k₁·k₂·k₃·F_r/b_s", unit="kN_per_m")]
    creep: Creep
    requirements: Requirements
    form: DrawnForm
    bearing_kind: Annotated[str | None, Quantity("type of the bearing")]
    asked_interference: Annotated[Pair | None, Quantity("interference required of every pair", unit="um")]
    selective_groups: Annotated[int | None, Quantity("groups for selective assembly", "n_g")]
    selective_interference: Annotated[Pair | None, Quantity("interference within the groups", unit="um")]
    sorting_groups: tuple[SortingGroup, ...]
    repair: Repair | None
    notes: Annotated[tuple[str, ...], Quantity("notes")]
    internal_clearance: Clearance | None
    bearing_verdict: Annotated[Grade, Quantity("verdict", "", 4, "the worst check of the bearing")] = "pass"
    diameter: Annotated[float, Quantity("diameter of the seat", "d", unit="mm")]
    ring_width: Annotated[float, Quantity("width of the ring", "B", unit="mm")]
    chamfer: Annotated[float | None, Quantity("chamfer of the ring", "r_s", unit="mm")]

    @property
    def tightest_um(self) -> float:
        """The largest interference; 0 where even that is clearance."""
        return um(max(self.interference[1], 0.0))

    @property
    def needs_no_grip(self) -> bool:
        """True if the load of the ring is fixed in direction."""
        return self.creep.ring_load == "stationary"

    @property
    def needed_um(self) -> float | None:
        """The required interference; none of a ring whose load is fixed in direction."""
        no_need = self.needs_no_grip or self.required_interference is None
        return None if no_need else um(self.required_interference or 0.0)

    @property
    def needed_by(self) -> str | None:
        """The criterion of the interference that is needed."""
        return None if self.needs_no_grip else self.required_by


class BearingSeats(NamedTuple):
    """A bearing's seats, shaft first, the clearance left in it, the group of clearance to order with the advice.

    `group_to_order` suits given classes that hold, too; `group_of_recommended` is enough for the recommended ones.
    """

    bearing: SeatedBearing
    shaft: SeatResult
    housing: SeatResult
    life: RatingLife
    clearance: Clearance | None = None
    group_to_order: str | None = None
    group_of_recommended: str | None = None
    life_in_use: LifeInUse | None = None
    actions: "Mapping[str, Action]" = {}  # noqa: RUF012 - a default that nobody changes

    @property
    def seats(self) -> tuple[SeatResult, SeatResult]:
        """Shaft, housing."""
        return self.shaft, self.housing

    @property
    def group_inside(self) -> str | None:
        """Group whose clearance is told at work: given, else recommended; None for bearings without groups."""
        return self.bearing.internal_clearance or self.group_of_recommended

    @property
    def clearance_at_work(self) -> Mapping[str, Pair]:
        """Clearance inside the bearing [m] cold, as mounted and hot, that all but few have; empty without a group."""
        group = self.group_inside
        if group is None:
            return {}
        joints = self.shaft.joint, self.housing.joint
        return clearance_at_work(self.bearing, *joints, group, share_to_order(*joints))

    @property
    def checks(self) -> tuple[Check, ...]:
        """The checks of both seats, of the bearing's life, and of the clearance."""
        left = clearance_checks(self.bearing, self.clearance, share_to_order(self.shaft.joint, self.housing.joint))
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
    for seat in plain.seats:
        if seat.fit == seat.recommended_fit:
            open_ = (check for check in seat.checks if check.status == "warn" and not check.remedy)
            proposed |= {check.code: no_better(check, seat.joint) for check in open_ if check.code not in proposed}
    shaft, housing = (replace(seat, checks=_with(proposed, seat.checks)) for seat in plain.seats)
    return _graded(plain._replace(shaft=shaft, housing=housing, actions=proposed))


def with_life(judged: BearingSeats, in_use: LifeInUse) -> BearingSeats:
    """A bearing with its life under the loads of the simulation."""
    shaft, housing = (replace(seat, simulated_life=in_use.lives) for seat in judged.seats)
    return _graded(judged._replace(shaft=shaft, housing=housing, life_in_use=in_use))


def _graded(judged: BearingSeats) -> BearingSeats:
    """A bearing whose seats know its worst check."""
    grade = worst(judged.checks)
    shaft, housing = (replace(seat, bearing_verdict=grade) for seat in judged.seats)
    return judged._replace(shaft=shaft, housing=housing)


def _with(proposed: "Mapping[str, Action]", checks: Sequence[Check]) -> tuple[Check, ...]:
    """Checks with these actions."""
    return tuple(check.with_action(proposed[check.code].text) if check.code in proposed else check for check in checks)


def _judged(bearing: SeatedBearing) -> BearingSeats:
    """Both seats of a bearing; one without a fit is judged with the field advised.

    A band asked for is meant for every seat whose pairs may be tight.
    """
    given = shaft_joint(bearing), housing_joint(bearing)
    recommendation = advice(bearing, *given)
    open_seats = [part.fit is None and part.measured is None for part in (bearing.shaft, bearing.housing)]
    joints = [
        _stand_in(joint, own) if unsaid else joint
        for joint, own, unsaid in zip(given, (recommendation.shaft, recommendation.housing), open_seats, strict=True)
    ]
    asked = [_asked(bearing, joint, not unsaid) for joint, unsaid in zip(joints, open_seats, strict=True)]
    left, life, ratings = _clearance(bearing, *joints), rating_life(bearing), bearing.ratings
    alike = {
        "load_ratio": bearing.load_ratio, "static_safety": life.static_safety, "basic_rating_life": life.basic,
        "modified_rating_life": life.modified, "life_modification": life.a_iso, "limiting_speed": life.limiting_speed,
        "equivalent_load": life.dynamic_load, "static_load": life.static_load, "bearing_kind": bearing.kind,
        "dynamic_load_rating": ratings.dynamic if ratings else None,
        "static_load_rating": ratings.static or None if ratings else None,
        "catalogue_bearing": bearing.entry.designation if bearing.entry else None,
        "recommended_clearance": recommendation.group, "clearance_of_recommended": recommendation.own_group,
        "internal_clearance": left,
    }  # fmt: skip
    shaft, housing = (
        _seat(bearing, joint, own, not unsaid, band, recommendation, alike)
        for joint, own, unsaid, band in zip(
            joints, (recommendation.shaft, recommendation.housing), open_seats, asked, strict=True
        )
    )
    return BearingSeats(bearing, shaft, housing, life, left, recommendation.group, recommendation.own_group)


def _asked(bearing: SeatedBearing, joint: Joint, given: bool) -> Interval | None:
    """Band of interference for selective assembly: asked for, else from what a ring needs to what it bears.

    None of a ring that needs none, and of one whose every pair has what it needs.
    """
    if bearing.asked_interference is not None:
        meant = joint.must_grip or (given and joint.interference.largest > 0)
        return Interval(*bearing.asked_interference) if meant else None
    needed = joint.required
    if not joint.must_grip or needed is None or joint.load_assumed or joint.interference.smallest >= needed.value:
        return None
    return Interval(needed.value, joint.permitted.value) if needed.value < joint.permitted.value else None


def _stand_in(joint: Joint, own: SeatAdvice) -> Joint:
    """The joint that is judged if no class is given: the recommended class, else that of the catalogue."""
    if own.best is not None:
        return own.best
    return joint.with_class(joint.catalogue_class) if joint.catalogue_class else joint


def _clearance(bearing: SeatedBearing, shaft: Joint, housing: Joint) -> Clearance | None:
    if bearing.internal_clearance is None:
        return None
    return clearance_left(bearing.internal_clearance, bearing, shaft, housing)


def _seat(
    bearing: SeatedBearing, joint: Joint, own: SeatAdvice, given: bool, asked: Interval | None, both: JointAdvice,
    alike: Mapping[str, Any],
) -> SeatResult:  # fmt: skip
    """One seat; `alike`: fields of the bearing itself."""
    start: Start = (bearing.service.seat_friction, bearing.service.starting_torque)
    creep_result = creep(joint, *start)
    recommended = own.best.tolerance_class if own.best else None
    selection, groups = _sorting(joint, asked)
    if bearing.asked_interference is None and selection is None:
        asked = None  # nobody asked for what no sorting reaches
    rule = rule_class(joint, start)
    wanted = recommended or joint.tolerance_class
    maker, male_and_female = joint.maker, joint.male_and_female
    return SeatResult(
        joint=joint,
        name=bearing.name,
        seat=joint.seat,
        fit=joint.fit_name,
        fit_given=given,
        part_limits=joint.part,
        ring_limits=joint.ring_limits,
        interference=joint.interference,
        probable_interference=probable_interference(*male_and_female),
        clearance_probability=joint.clearance_probability,
        clearance_probability_truncated=truncated_clearance_probability(*male_and_female),
        required_interference=joint.required.value if joint.required else None,
        required_by=joint.required.by if joint.required else None,
        losses_={loss.name: loss.amount for loss in joint.losses},
        losses=ledger(joint),
        permitted_interference=joint.permitted.value,
        permitted_by=joint.permitted.by,
        hoop_stress=joint.hoop_stress,
        part_stress=joint.part_stress,
        short_pairs_share=joint.short_pairs,
        pressure_kept=joint.pressure_kept,
        interference_by_temperature=joint.interference_by_temperature,
        at_work=at_work(joint),
        mounting=seat_mounting(bearing, joint),
        maker_fits=(*maker.classes, *maker.special) if maker else (),
        catalogue_fit=joint.catalogue_class,
        rule_fit=rule,
        recommended_fit=recommended,
        rejected_fits=own.rejected,
        admissible_fits=admissible(joint, start, own.best),
        load_intensity=seat_intensity(bearing, joint),
        creep=creep_result,
        requirements=seat_requirements(joint, wanted, bearing.bearing_class),
        form=seat_form(joint, joint.tolerance_class if given and not joint.measured else wanted, bearing.bearing_class),
        asked_interference=asked,
        selective_groups=selection.groups if selection else None,
        selective_interference=selection.interference if selection else None,
        sorting_groups=groups,
        repair=_repair(bearing, joint, wanted),
        notes=(*seat_notes(bearing, joint, own, given, asked, selection, rule), *clearance_note(both)),
        diameter=joint.diameter,
        ring_width=joint.ring.width,
        chamfer=joint.ring.chamfer,
        checks=seat_checks(bearing, joint, recommended, rule)
        + start_checks(bearing.name, joint, creep_result, bearing.service.starting_torque, recommended)
        + short_pair_checks(bearing.name, joint, recommended),
        **alike,
    )


def _sorting(joint: Joint, asked: Interval | None) -> tuple[Selection | None, tuple[SortingGroup, ...]]:
    if asked is None:
        return None, ()
    selection = selective_groups(*joint.male_and_female, asked)
    return selection, (sorting_groups(joint.part, joint.ring_limits, joint.seat, selection.groups) if selection else ())


def _repair(bearing: SeatedBearing, joint: Joint, advised: str) -> Repair | None:
    """Repair to the drawing's tolerance class; to the advised one if the drawing gives none.

    None if no limits are measured.
    """
    if joint.measured is None:
        return None
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
