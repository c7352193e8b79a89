"""Bearing seats as results hold them: SI in, user units out; a seat is one ring on its shaft or in its housing.

Parts: losses, tolerance classes, groups, repair, creep, drawing, clearance.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, ClassVar, Final, Self, TypeAlias

from abu_calc.foundation.checks import Grade, worst
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si
from abu_calc.standards.tolerance_classes import RingLoad, Seat

if TYPE_CHECKING:
    from abu_calc.features.seats.drawing_requirements import SeatRequirements
    from abu_calc.features.seats.joint import Joint, ThermalCase
    from abu_calc.features.seats.notes import Group, Item
    from abu_calc.features.seats.seats import BearingSeats, SeatFit

Pair: TypeAlias = tuple[float, float]
"""Lower and upper, or least and most."""

MICROMETRES: Final = {"um": 6}
"""Decimals of lengths in micrometres, freed of the rounding of the conversion."""


def um(length: float) -> float:
    """Micrometres, freed of the rounding of the conversion."""
    return round(from_si(length, "um"), 6)


def um_pair(pair: Pair) -> Pair:
    """Limits or an interval in micrometres."""
    return um(pair[0]), um(pair[1])


def _in(value: float | None, unit: str) -> float | None:
    return None if value is None else round(from_si(value, unit), 9)


@record
class Loss(Record):
    """Loss of interference: the load by both rules, of which the larger counts, then the losses given."""

    name: Annotated[str, Quantity("loss")]
    amount_um: Annotated[float, Quantity("taken from the interference")]
    formula: Annotated[str, Quantity("formula")]
    counted: Annotated[bool, Quantity("counted in the required interference")]

    @classmethod
    def of(cls, item: "Item") -> Self:
        """Record of an entry in the list of losses."""
        loss = item.loss
        return cls(name=loss.name, amount_um=um(loss.value), formula=loss.formula, counted=item.counted)


@record
class AdmissibleFit(Record):
    """A tolerance class that neither creeps nor overstresses."""

    decimals: ClassVar[Mapping[str, int]] = MICROMETRES

    fit: Annotated[str, Quantity("tolerance class")]
    interference_um: Annotated[Pair, Quantity("interference", "", 4, "least and most; negative: clearance")]
    clearance_probability: Annotated[float, Quantity("probability of clearance", "", 3)]


@record
class RejectedFit(Record):
    """A neighbour of the recommended tolerance class, which fails."""

    fit: Annotated[str, Quantity("tolerance class")]
    why: Annotated[str, Quantity("why not")]


@record
class SortingGroup(Record):
    """A group of selective assembly: parts of one number are matched."""

    decimals: ClassVar[Mapping[str, int]] = MICROMETRES

    number: Annotated[int, Quantity("group")]
    part_limits_um: Annotated[Pair, Quantity("limits of the part")]
    ring_limits_um: Annotated[Pair, Quantity("limits of the ring")]
    interference_um: Annotated[Pair, Quantity("interference")]
    pairs_of_100: Annotated[float, Quantity("pairs of a hundred", "", 3)]

    @classmethod
    def of(cls, group: "Group", seat: Seat) -> Self:
        """Record of a group of a seat."""
        part, ring = (group.male, group.female) if seat == "shaft" else (group.female, group.male)
        return cls.read(
            group, part_limits_um=um_pair(part), ring_limits_um=um_pair(ring), pairs_of_100=100 * group.share
        )


@record
class Repair(Record):
    """Interference left in a seat whose limits are measured, and the limits that a repair must restore."""

    decimals: ClassVar[Mapping[str, int]] = {"um": 6, "mm": 6}

    grip_left_um: Annotated[Pair, Quantity("interference left", "", 4, "after losses")]
    restore_fit: Annotated[str, Quantity("tolerance class to restore")]
    restore_limits_um: Annotated[Pair, Quantity("limits to restore")]
    bonding_gap_um: Annotated[float, Quantity("gap that a bond must fill", "", 4, "of the loosest pair")]
    next_seat_mm: Annotated[float | None, Quantity("seat of the next size")]
    next_bearing: Annotated[str | None, Quantity("bearing of the next size")]


@record
class Creep(Record):
    """Creep of the ring on its seat under its load, and its hold when the machine starts."""

    ring_load: Annotated[RingLoad, Quantity("how the load meets the ring")]
    verdict: Annotated[str, Quantity("verdict", "", 4, "holds (smallest), may creep (mean), creeps, …")]
    why: Annotated[str, Quantity("why")]
    probability: Annotated[float | None, Quantity("share of pairs with less interference than the ring needs", "", 3)]
    friction_moment_N_m: Annotated[
        Pair | None, Quantity("slip torque", "", 3, "at the least and at the least probable interference")
    ]
    holds_at_start: Annotated[bool | None, Quantity("holds the starting torque")]

    @classmethod
    def of(cls, seat: "SeatFit") -> Self:
        """Record of a seat."""
        creep = seat.creep
        least, probable = creep.least_torque, creep.probable_torque
        return cls.read(
            creep,
            ring_load=seat.joint.ring.load,
            friction_moment_N_m=None if least is None or probable is None else (least, probable),
        )


@record
class Requirements(Record):
    """Requirements that the drawing of the seat must state."""

    decimals: ClassVar[Mapping[str, int]] = MICROMETRES

    field: Annotated[str, Quantity("tolerance class")]
    limits_um: Annotated[Pair, Quantity("limits of the tolerance class")]
    roundness_um: Annotated[float, Quantity("roundness", "", 2)]
    profile_um: Annotated[float, Quantity("longitudinal profile", "", 2)]
    roughness_Ra_um: Annotated[float, Quantity("roughness", "Ra")]
    shoulder_runout_grade: Annotated[str, Quantity("grade of the shoulder's runout")]
    shoulder_runout_um: Annotated[float | None, Quantity("shoulder runout", "", 4, "None where it is not tabulated")]
    hardness: Annotated[str, Quantity("hardness at least")]
    source: Annotated[str, Quantity("source")]

    @classmethod
    def of(cls, asked: "SeatRequirements") -> Self:
        """Record in user units."""
        return cls.read(asked, roundness_um=um(asked.form), profile_um=um(asked.form))


@record
class DrawnForm(Record):
    """Form and roughness that the drawing of a seat states, by a maker's catalogue."""

    decimals: ClassVar[Mapping[str, int]] = MICROMETRES

    cylindricity_um: Annotated[float, Quantity("cylindricity", "", 2)]
    shoulder_runout_um: Annotated[float, Quantity("total axial runout of the shoulder", "", 3)]
    roughness_Ra_um: Annotated[float, Quantity("roughness", "Ra")]
    source: Annotated[str, Quantity("source")]


@record
class ThermalInterference(Record):
    """Interference of a seat at one temperature case."""

    decimals: ClassVar[Mapping[str, int]] = MICROMETRES

    case: Annotated[str, Quantity("temperature case", "", 4, "mounting, working, lowest, highest")]
    rise_K: Annotated[float | None, Quantity("rise over mounting", "", 4, "None: differences alone are given")]
    interference_um: Annotated[Pair, Quantity("interference")]

    @classmethod
    def of(cls, joint: "Joint", case: "ThermalCase") -> Self:
        """Record of a case of a joint."""
        low, high = joint.interference
        return cls(case=case.name, rise_K=case.rise, interference_um=(um(low - case.loss), um(high - case.loss)))


@record
class SimulatedLife(Record):
    """Loads of a bearing from the simulation, and its basic rating life without and with the autobalancer."""

    decimals: ClassVar[Mapping[str, int]] = {"h": 1}

    load_without_kN: Annotated[float, Quantity("equivalent load without the autobalancer", "", 3)]
    load_with_kN: Annotated[float, Quantity("equivalent load with the autobalancer", "", 3)]
    life_without_h: Annotated[float, Quantity("basic rating life without the autobalancer", "", 3)]
    life_with_h: Annotated[float, Quantity("basic rating life with the autobalancer", "", 3)]


@record
class Clearance(Record):
    """Clearance in the bearing, radial or axial of a pair; it belongs to both seats."""

    decimals: ClassVar[Mapping[str, int]] = MICROMETRES

    group: Annotated[str, Quantity("group")]
    initial_um: Annotated[Pair, Quantity("before mounting")]
    mounted_um: Annotated[Pair, Quantity("after mounting, extreme")]
    probable_um: Annotated[Pair, Quantity("after mounting, probable")]
    mean_um: Annotated[float, Quantity("mean after mounting", "", 3)]
    axial: Annotated[bool, Quantity("whether it is the axial clearance of a pair")]
    preload_N: Annotated[Pair | None, Quantity("preload of the pair after mounting", "", 3, "least and most")]
    below_zero_probability: Annotated[float, Quantity("share of bearings without clearance", "", 3)]
    by_temperature_um: Annotated[float, Quantity("taken by temperature", "", 3)]
    group_to_choose: Annotated[str | None, Quantity("tightest group that passes")]


@record
class SeatResult(Record):
    """One seat, judged; interference is positive, clearance negative, limits count from the nominal size."""

    decimals: ClassVar[Mapping[str, int]] = MICROMETRES

    name: Annotated[str, Quantity("bearing")]
    seat: Annotated[Seat, Quantity("seat")]
    fit: Annotated[str, Quantity("tolerance class", "", 4, "measured if limits are given in its place")]
    fit_given: Annotated[bool, Quantity("whether a tolerance class is given, else the recommended one is judged")]
    part_limits_um: Annotated[Pair, Quantity("limits of the part")]
    ring_limits_um: Annotated[Pair, Quantity("limits of the ring")]
    interference_um: Annotated[Pair, Quantity("interference", "", 4, "ei − ES … es − EI")]
    probable_interference_um: Annotated[
        Pair, Quantity("probable interference", "", 4, "mean ∓ √((T₁/2)² + (T₂/2)²), outward to whole µm")
    ]
    clearance_probability: Annotated[float, Quantity("probability of clearance", "Φ(−mean/σ)")]
    clearance_probability_truncated: Annotated[
        float, Quantity("probability of clearance, parts outside their limits sorted out")
    ]
    required_interference_um: Annotated[
        float | None, Quantity("required interference", "", 4, "of a ring under a rotating load, losses included")
    ]
    required_by: Annotated[str | None, Quantity("criterion of the required interference")]
    losses_um: Annotated[Mapping[str, float], Quantity("losses counted beside the load")]
    losses: tuple[Loss, ...]
    permitted_interference_um: Annotated[float, Quantity("permitted interference")]
    permitted_by: Annotated[str, Quantity("criterion of the permitted interference")]
    hoop_stress_MPa: Annotated[float, Quantity("hoop stress", "", 4, "of the ring at the largest interference")]
    part_stress_MPa: Annotated[float, Quantity("hoop stress of the part", "", 4, "at the largest interference")]
    short_pairs_share: Annotated[
        float | None, Quantity("share of short pairs", "", 3, "less interference than the specified rule demands")
    ]
    pressure_kept: Annotated[
        float, Quantity("share of the pressure kept", "", 3, "of that in a solid shaft or a thick housing")
    ]
    interference_by_temperature: tuple[ThermalInterference, ...]
    load_ratio: Annotated[float | None, Quantity("load ratio", "P/C", 3, "P the equivalent dynamic load")]
    static_safety: Annotated[float | None, Quantity("static safety", "C0/P0", 3)]
    basic_rating_life_h: Annotated[float | None, Quantity("basic rating life", "L_10h", 3)]
    modified_rating_life_h: Annotated[float | None, Quantity("modified rating life", "", 3, "basic one times a_ISO")]
    life_modification: Annotated[float | None, Quantity("life modification factor", "a_ISO", 3)]
    limiting_speed_rpm: Annotated[float | None, Quantity("limiting speed", "", 4, "of the catalogue's bearing")]
    equivalent_load_kN: Annotated[float | None, Quantity("equivalent dynamic load", "P", 3)]
    static_load_kN: Annotated[float | None, Quantity("equivalent static load", "P_0", 3)]
    dynamic_load_rating_kN: Annotated[float | None, Quantity("dynamic load rating", "C", 4)]
    static_load_rating_kN: Annotated[float | None, Quantity("static load rating", "C0", 4)]
    catalogue_bearing: Annotated[str | None, Quantity("catalogue bearing of this size")]
    simulated_life: SimulatedLife | None
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
    load_intensity_kN_per_m: Annotated[float | None, Quantity("load intensity", "P_R = k₁·k₂·k₃·F_r/b_s")]
    creep: Creep
    requirements: Requirements
    form: DrawnForm
    bearing_kind: Annotated[str | None, Quantity("type of the bearing")]
    asked_interference_um: Annotated[Pair | None, Quantity("interference required of every pair")]
    selective_groups: Annotated[int | None, Quantity("groups for selective assembly", "n_g")]
    selective_interference_um: Annotated[Pair | None, Quantity("interference within the groups")]
    sorting_groups: tuple[SortingGroup, ...]
    repair: Repair | None
    notes: Annotated[tuple[str, ...], Quantity("notes")]
    internal_clearance: Clearance | None
    bearing_verdict: Annotated[Grade, Quantity("verdict", "", 4, "the worst check of the bearing")]
    diameter_mm: Annotated[float, Quantity("diameter of the seat", "d")]
    ring_width_mm: Annotated[float, Quantity("width of the ring", "B")]
    chamfer_mm: Annotated[float | None, Quantity("chamfer of the ring", "r_s")]

    @property
    def tightest_um(self) -> float:
        """The largest interference; 0 where even that is clearance."""
        return max(self.interference_um[1], 0.0)

    @property
    def needs_no_grip(self) -> bool:
        """True if the load of the ring is fixed in direction."""
        return self.creep.ring_load == "stationary"

    @property
    def needed_um(self) -> float | None:
        """The required interference; none of a ring whose load is fixed in direction."""
        return None if self.needs_no_grip else self.required_interference_um

    @property
    def needed_by(self) -> str | None:
        """The criterion of the interference that is needed."""
        return None if self.needs_no_grip else self.required_by

    @classmethod
    def of(cls, seat: "SeatFit", bearing: "BearingSeats", clearance: Clearance | None) -> Self:
        """Record of a seat of a bearing, in user units; `clearance`: the clearance left in the bearing."""
        sorted_out, maker, life, ratings = seat.selection, seat.joint.maker, bearing.life, bearing.bearing.ratings
        in_use = bearing.life_in_use
        return cls.read(
            seat,
            seat.joint.ring,
            losses_um={loss.name: um(loss.value) for loss in seat.losses},
            losses=tuple(map(Loss.of, seat.ledger)),
            part_stress_MPa=from_si(seat.joint.part_stress, "MPa"),
            load_ratio=bearing.bearing.load_ratio,
            interference_by_temperature=tuple(
                ThermalInterference.of(seat.joint, case) for case in seat.joint.thermal_cases
            ),
            static_safety=life.static_safety,
            basic_rating_life_h=_in(life.basic, "h"),
            modified_rating_life_h=_in(life.modified, "h"),
            life_modification=life.a_iso,
            limiting_speed_rpm=_in(life.limiting_speed, "rpm"),
            equivalent_load_kN=_in(life.dynamic_load, "kN"),
            static_load_kN=_in(life.static_load, "kN"),
            dynamic_load_rating_kN=_in(ratings.dynamic if ratings else None, "kN"),
            static_load_rating_kN=_in(ratings.static or None if ratings else None, "kN"),
            catalogue_bearing=bearing.bearing.entry.designation if bearing.bearing.entry else None,
            simulated_life=None if in_use is None or in_use.lives is None else SimulatedLife.read(in_use.lives),
            maker_fits=(*maker.classes, *maker.special) if maker else (),
            recommended_clearance=bearing.group_to_order,
            clearance_of_recommended=bearing.group_of_recommended,
            creep=Creep.of(seat),
            form=DrawnForm.read(seat.form),
            bearing_kind=bearing.bearing.kind,
            selective_groups=sorted_out.groups if sorted_out else None,
            selective_interference_um=um_pair(sorted_out.interference) if sorted_out else None,
            sorting_groups=tuple(SortingGroup.of(group, seat.seat) for group in seat.groups),
            internal_clearance=clearance,
            bearing_verdict=worst(bearing.checks),
            ring_width_mm=from_si(seat.joint.ring.width, "mm"),
        )


def seat_results(bearing: "BearingSeats") -> tuple[SeatResult, SeatResult]:
    """Both seats of a bearing, shaft first; the clearance left in the bearing stands in both."""
    left = None if bearing.clearance is None else Clearance.read(bearing.clearance)
    return SeatResult.of(bearing.shaft, bearing, left), SeatResult.of(bearing.housing, bearing, left)
