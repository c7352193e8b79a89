"""The parts of a bearing seat's result: losses, fields, groups, repair, creep, drawing, clearance; in user units."""

from typing import TYPE_CHECKING, Annotated, Self, TypeAlias

from abu_calc.standards.limits import Seat
from abu_calc.standards.maker_fits import RingLoad
from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.units import from_si

if TYPE_CHECKING:
    from abu_calc.fits.advice import Rejected
    from abu_calc.fits.clearance import ClearanceLeft
    from abu_calc.fits.drawing import Requirements as SeatRequirements
    from abu_calc.fits.notes import Item
    from abu_calc.fits.repair import Repair as SeatRepair
    from abu_calc.fits.seats import Admissible, SeatFit
    from abu_calc.fits.selective import Group

Pair: TypeAlias = tuple[float, float]
"""Lower and upper, or least and most."""


def um(length: float) -> float:
    """Micrometres, freed of the rounding of the conversion."""
    return round(from_si(length, "um"), 6)


def um_pair(pair: Pair) -> Pair:
    """Limits or an interval in micrometres."""
    return um(pair[0]), um(pair[1])


def um_or_none(length: float | None) -> float | None:
    """Micrometres of what may not be known."""
    return None if length is None else um(length)


@record
class Loss(Record):
    """Loss of interference: the load by both rules, of which the larger counts, then the losses given."""

    name: Annotated[str, Quantity("by")]
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

    fit: Annotated[str, Quantity("field")]
    interference_um: Annotated[Pair, Quantity("interference", "", 4, "least and most, positive when tight")]
    clearance_probability: Annotated[float, Quantity("probability of clearance", "", 3)]

    @classmethod
    def of(cls, fit: "Admissible") -> Self:
        """Record of a tolerance class that passes."""
        return cls(
            fit=fit.fit, interference_um=um_pair(fit.interference), clearance_probability=fit.clearance_probability
        )


@record
class RejectedFit(Record):
    """A neighbour of the recommended field that will not do."""

    fit: Annotated[str, Quantity("field")]
    why: Annotated[str, Quantity("why not")]

    @classmethod
    def of(cls, fit: "Rejected") -> Self:
        """Record of a tolerance class that fails."""
        return cls(fit=fit.fit, why=fit.why)


@record
class SortingGroup(Record):
    """A group of selective assembly: parts of one number are matched."""

    number: Annotated[int, Quantity("group")]
    part_limits_um: Annotated[Pair, Quantity("limits of the part")]
    ring_limits_um: Annotated[Pair, Quantity("limits of the ring")]
    interference_um: Annotated[Pair, Quantity("interference")]
    pairs_of_100: Annotated[float, Quantity("pairs of a hundred", "", 3)]

    @classmethod
    def of(cls, group: "Group", seat: Seat) -> Self:
        """Record of a group of a seat."""
        part, ring = (group.male, group.female) if seat == "shaft" else (group.female, group.male)
        return cls(
            number=group.number,
            part_limits_um=um_pair(part),
            ring_limits_um=um_pair(ring),
            interference_um=um_pair(group.interference),
            pairs_of_100=100 * group.share,
        )


@record
class Repair(Record):
    """Interference left in a seat whose limits are measured, and the limits that a repair must restore."""

    grip_left_um: Annotated[Pair, Quantity("grip left", "", 4, "losses taken off")]
    restore_fit: Annotated[str, Quantity("field to restore")]
    restore_limits_um: Annotated[Pair, Quantity("limits to restore")]
    bonding_gap_um: Annotated[float, Quantity("gap that a bond must fill", "", 4, "of the loosest pair")]
    next_seat_mm: Annotated[float | None, Quantity("seat of the next size")]
    next_bearing: Annotated[str | None, Quantity("bearing of the next size")]

    @classmethod
    def of(cls, repair: "SeatRepair") -> Self:
        """Record in user units."""
        return cls(
            grip_left_um=um_pair(repair.grip_left),
            restore_fit=repair.restore,
            restore_limits_um=um_pair(repair.limits),
            bonding_gap_um=um(repair.gap),
            next_seat_mm=None if repair.next_seat is None else round(from_si(repair.next_seat, "mm"), 6),
            next_bearing=repair.next_bearing,
        )


@record
class Creep(Record):
    """Creep of the ring on its seat under its load, and its hold when the machine starts."""

    ring_load: Annotated[RingLoad, Quantity("how the load meets the ring")]
    verdict: Annotated[str, Quantity("verdict", "", 4, "holds (smallest), may creep (mean), creeps, …")]
    why: Annotated[str, Quantity("why")]
    probability: Annotated[float | None, Quantity("share of pairs with less interference than the ring needs", "", 3)]
    friction_moment_N_m: Annotated[
        Pair | None, Quantity("friction moment", "", 3, "of the least and of the least probable interference")
    ]
    holds_at_start: Annotated[bool | None, Quantity("holds the starting torque")]

    @classmethod
    def of(cls, seat: "SeatFit") -> Self:
        """Record of a seat."""
        creep = seat.creep
        least, probable = creep.least_torque, creep.probable_torque
        return cls(
            ring_load=seat.joint.ring.load,
            verdict=creep.verdict,
            why=creep.why,
            probability=creep.probability,
            friction_moment_N_m=None if least is None or probable is None else (least, probable),
            holds_at_start=creep.holds_at_start,
        )


@record
class Requirements(Record):
    """Requirements that the drawing of the seat must state."""

    field: Annotated[str, Quantity("field")]
    limits_um: Annotated[Pair, Quantity("limits of the field")]
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
        return cls(
            field=asked.field,
            limits_um=um_pair(asked.limits),
            roundness_um=um(asked.form),
            profile_um=um(asked.form),
            roughness_Ra_um=um(asked.roughness),
            shoulder_runout_grade=asked.shoulder_grade,
            shoulder_runout_um=um_or_none(asked.shoulder_runout),
            hardness=asked.hardness,
            source=asked.source,
        )


@record
class Clearance(Record):
    """Radial clearance in the bearing; it belongs to both seats."""

    group: Annotated[str, Quantity("group")]
    initial_um: Annotated[Pair, Quantity("before mounting")]
    mounted_um: Annotated[Pair, Quantity("after mounting, extreme")]
    probable_um: Annotated[Pair, Quantity("after mounting, probable")]
    mean_um: Annotated[float, Quantity("mean after mounting", "", 3)]
    below_zero_probability: Annotated[float, Quantity("share of bearings without clearance", "", 3)]
    by_temperature_um: Annotated[float, Quantity("taken by temperature", "", 3)]
    group_to_choose: Annotated[str | None, Quantity("tightest group that will do")]

    @classmethod
    def of(cls, left: "ClearanceLeft") -> Self:
        """Record in user units."""
        return cls(
            group=left.group,
            initial_um=um_pair(left.initial),
            mounted_um=um_pair(left.mounted),
            probable_um=um_pair(left.probable),
            mean_um=um(left.mean),
            below_zero_probability=left.below_zero,
            by_temperature_um=um(left.warmth),
            group_to_choose=left.group_to_choose,
        )
