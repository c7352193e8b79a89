"""Bearing seats as results hold them: SI in, user units out; a seat is one ring on its shaft or in its housing."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Self, TypeAlias

from abu_calc.spec.bearing import RingLoad
from abu_calc.standards.limits import Seat
from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.units import from_si

if TYPE_CHECKING:
    from abu_calc.fits.clearance import ClearanceLeft
    from abu_calc.fits.drawing import Requirements as SeatRequirements
    from abu_calc.fits.seats import Admissible, BearingSeats, Item, SeatFit

Pair: TypeAlias = tuple[float, float]
"""Lower and upper, or least and most."""


def um(length: float) -> float:
    """Micrometres, freed of the rounding of the conversion."""
    return round(from_si(length, "um"), 6)


def um_pair(pair: Pair) -> Pair:
    """Limits or an interval in micrometres."""
    return um(pair[0]), um(pair[1])


def _um(length: float | None) -> float | None:
    return None if length is None else um(length)


@record
class Loss(Record):
    """What takes from the interference: the load by both rules, of which the larger counts, then the losses given."""

    name: Annotated[str, Quantity("by")]
    amount_um: Annotated[float, Quantity("taken from the interference")]
    formula: Annotated[str, Quantity("formula")]
    counted: Annotated[bool, Quantity("counted in the required interference")]

    @classmethod
    def of(cls, item: "Item") -> Self:
        """Of an entry of the ledger."""
        loss = item.loss
        return cls(name=loss.name, amount_um=um(loss.value), formula=loss.formula, counted=item.counted)


@record
class AdmissibleFit(Record):
    """A tolerance class that passes all checks."""

    fit: Annotated[str, Quantity("field")]
    interference_um: Annotated[Pair, Quantity("interference", "", 4, "least and most, positive when tight")]
    clearance_probability: Annotated[float, Quantity("probability of clearance", "", 3)]

    @classmethod
    def of(cls, one: "Admissible") -> Self:
        """Of a class that passes."""
        return cls(
            fit=one.fit, interference_um=um_pair(one.interference), clearance_probability=one.clearance_probability
        )


@record
class Creep(Record):
    """Whether the ring creeps on its seat under its load, and whether it holds when the machine starts."""

    ring_load: Annotated[RingLoad, Quantity("how the load meets the ring")]
    verdict: Annotated[str, Quantity("verdict", "", 4, "holds, may creep, creeps, needs no grip or not known")]
    why: Annotated[str, Quantity("why")]
    probability: Annotated[float | None, Quantity("share of pairs with less interference than the ring needs", "", 3)]
    friction_moment_N_m: Annotated[
        Pair | None, Quantity("friction moment", "", 3, "of the least and of the least probable interference")
    ]
    holds_at_start: Annotated[bool | None, Quantity("holds the starting torque")]

    @classmethod
    def of(cls, seat: "SeatFit") -> Self:
        """Of a seat."""
        found = seat.creep
        least, probable = found.least_torque, found.probable_torque
        return cls(
            ring_load=seat.joint.ring.load,
            verdict=found.verdict,
            why=found.why,
            probability=found.probability,
            friction_moment_N_m=None if least is None or probable is None else (least, probable),
            holds_at_start=found.holds_at_start,
        )


@record
class Requirements(Record):
    """What the drawing of the seat must ask for."""

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
        """In user units."""
        return cls(
            field=asked.field,
            limits_um=um_pair(asked.limits),
            roundness_um=um(asked.form),
            profile_um=um(asked.form),
            roughness_Ra_um=um(asked.roughness),
            shoulder_runout_grade=asked.shoulder_grade,
            shoulder_runout_um=_um(asked.shoulder_runout),
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
    by_temperature_um: Annotated[float, Quantity("taken by temperature", "", 3)]
    group_to_choose: Annotated[str | None, Quantity("tightest group that will do")]

    @classmethod
    def of(cls, left: "ClearanceLeft") -> Self:
        """In user units."""
        return cls(
            group=left.group,
            initial_um=um_pair(left.initial),
            mounted_um=um_pair(left.mounted),
            probable_um=um_pair(left.probable),
            by_temperature_um=um(left.warmth),
            group_to_choose=left.group_to_choose,
        )


@record
class SeatResult(Record):
    """One seat, judged; interference is positive when tight, limits count from the nominal size."""

    name: Annotated[str, Quantity("bearing")]
    seat: Annotated[Seat, Quantity("seat")]
    fit: Annotated[str, Quantity("field")]
    part_limits_um: Annotated[Pair, Quantity("limits of the part")]
    ring_limits_um: Annotated[Pair, Quantity("limits of the ring")]
    interference_um: Annotated[Pair, Quantity("interference", "", 4, "ei − ES … es − EI")]
    probable_interference_um: Annotated[
        Pair, Quantity("probable interference", "", 4, "mean ∓ √((T₁/2)² + (T₂/2)²), outward to whole µm")
    ]
    clearance_probability: Annotated[float, Quantity("probability of clearance", "Φ(−mean/σ)")]
    clearance_probability_truncated: Annotated[
        float, Quantity("probability of clearance, parts outside their fields sorted out")
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
    recommended_fit: Annotated[str | None, Quantity("recommended field")]
    admissible_fits: tuple[AdmissibleFit, ...]
    load_intensity_kN_per_m: Annotated[float | None, Quantity("load intensity", "P_R = k₁·R/b")]
    creep: Creep
    requirements: Requirements
    asked_interference_um: Annotated[Pair | None, Quantity("interference asked of every pair")]
    selective_groups: Annotated[int | None, Quantity("groups for selective assembly", "n")]
    selective_interference_um: Annotated[Pair | None, Quantity("interference within the groups")]
    notes: Annotated[tuple[str, ...], Quantity("notes")]
    internal_clearance: Clearance | None
    diameter_mm: Annotated[float, Quantity("diameter of the seat", "d")]
    ring_width_mm: Annotated[float, Quantity("width of the ring", "B")]
    chamfer_mm: Annotated[float | None, Quantity("chamfer of the ring", "r")]

    @property
    def tightest_um(self) -> float:
        """The largest interference; 0 where even that is clearance."""
        return max(self.interference_um[1], 0.0)

    @classmethod
    def of(cls, seat: "SeatFit", clearance: Clearance | None) -> Self:
        """In user units; `clearance`: what is left in the seat's bearing."""
        intensity, sorted_out, ring = seat.load_intensity, seat.selection, seat.joint.ring
        return cls(
            name=seat.name,
            seat=seat.seat,
            fit=seat.fit,
            part_limits_um=um_pair(seat.part_limits),
            ring_limits_um=um_pair(seat.ring_limits),
            interference_um=um_pair(seat.interference),
            probable_interference_um=um_pair(seat.probable_interference),
            clearance_probability=seat.clearance_probability,
            clearance_probability_truncated=seat.truncated_probability,
            required_interference_um=_um(seat.required_interference),
            required_by=seat.required_by,
            losses_um={loss.name: um(loss.value) for loss in seat.losses},
            losses=tuple(map(Loss.of, seat.ledger)),
            permitted_interference_um=um(seat.permitted_interference),
            permitted_by=seat.permitted_by,
            hoop_stress_MPa=from_si(seat.hoop_stress, "MPa"),
            recommended_fit=seat.recommended_fit,
            admissible_fits=tuple(map(AdmissibleFit.of, seat.admissible)),
            load_intensity_kN_per_m=None if intensity is None else from_si(intensity, "kN_per_m"),
            creep=Creep.of(seat),
            requirements=Requirements.of(seat.requirements),
            asked_interference_um=None if seat.asked is None else um_pair(seat.asked),
            selective_groups=sorted_out.groups if sorted_out else None,
            selective_interference_um=um_pair(sorted_out.interference) if sorted_out else None,
            notes=seat.notes,
            internal_clearance=clearance,
            diameter_mm=from_si(ring.diameter, "mm"),
            ring_width_mm=from_si(ring.width, "mm"),
            chamfer_mm=None if ring.chamfer is None else from_si(ring.chamfer, "mm"),
        )


def seat_results(bearing: "BearingSeats") -> tuple[SeatResult, SeatResult]:
    """Both seats of a bearing, shaft first; the clearance left in the bearing stands in both."""
    left = None if bearing.clearance is None else Clearance.of(bearing.clearance)
    return SeatResult.of(bearing.shaft, left), SeatResult.of(bearing.housing, left)
