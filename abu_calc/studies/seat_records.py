"""Bearing seats as results hold them: SI in, user units out; a seat is one ring on its shaft or in its housing."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Self

from abu_calc.checks import Grade, worst
from abu_calc.standards.limits import Seat
from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.studies.seat_parts import (
    AdmissibleFit,
    Clearance,
    Creep,
    Loss,
    Pair,
    RejectedFit,
    Repair,
    Requirements,
    SortingGroup,
    um,
    um_or_none,
    um_pair,
)
from abu_calc.units import from_si

if TYPE_CHECKING:
    from abu_calc.fits.seats import BearingSeats, SeatFit


@record
class SeatResult(Record):
    """One seat, judged; interference is positive when tight, limits count from the nominal size."""

    name: Annotated[str, Quantity("bearing")]
    seat: Annotated[Seat, Quantity("seat")]
    fit: Annotated[str, Quantity("field", "", 4, "measured where limits are given in its place")]
    fit_given: Annotated[bool, Quantity("whether a field is given, else the recommended one is judged")]
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
    part_stress_MPa: Annotated[float, Quantity("hoop stress of the part", "", 4, "at the largest interference")]
    load_ratio: Annotated[float | None, Quantity("load ratio", "P/C", 3, "the radial load for P")]
    maker_fits: Annotated[tuple[str, ...], Quantity("the makers' fields", "", 4, "the first is the usual one")]
    recommended_fit: Annotated[str | None, Quantity("recommended field")]
    recommended_clearance: Annotated[str | None, Quantity("clearance to order")]
    rejected_fits: tuple[RejectedFit, ...]
    admissible_fits: tuple[AdmissibleFit, ...]
    load_intensity_kN_per_m: Annotated[float | None, Quantity("load intensity", "P_R = k₁·F_r/b_s")]
    creep: Creep
    requirements: Requirements
    asked_interference_um: Annotated[Pair | None, Quantity("interference asked of every pair")]
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
        """The required interference of a ring that must grip; none of another."""
        return None if self.needs_no_grip else self.required_interference_um

    @property
    def needed_by(self) -> str | None:
        """The criterion of the interference that is needed."""
        return None if self.needs_no_grip else self.required_by

    @classmethod
    def of(cls, seat: "SeatFit", bearing: "BearingSeats", clearance: Clearance | None) -> Self:
        """Record of a seat of a bearing, in user units; `clearance`: the clearance left in the bearing."""
        intensity, sorted_out, maker = seat.load_intensity, seat.selection, seat.joint.maker
        ring = seat.joint.ring
        return cls(
            name=seat.name,
            seat=seat.seat,
            fit=seat.fit,
            fit_given=seat.given,
            part_limits_um=um_pair(seat.part_limits),
            ring_limits_um=um_pair(seat.ring_limits),
            interference_um=um_pair(seat.interference),
            probable_interference_um=um_pair(seat.probable_interference),
            clearance_probability=seat.clearance_probability,
            clearance_probability_truncated=seat.truncated_probability,
            required_interference_um=um_or_none(seat.required_interference),
            required_by=seat.required_by,
            losses_um={loss.name: um(loss.value) for loss in seat.losses},
            losses=tuple(map(Loss.of, seat.ledger)),
            permitted_interference_um=um(seat.permitted_interference),
            permitted_by=seat.permitted_by,
            hoop_stress_MPa=from_si(seat.hoop_stress, "MPa"),
            part_stress_MPa=from_si(seat.joint.part_stress, "MPa"),
            load_ratio=bearing.bearing.load_ratio,
            maker_fits=(*maker.classes, *maker.special) if maker else (),
            recommended_fit=seat.recommended_fit,
            recommended_clearance=bearing.group_to_order,
            rejected_fits=tuple(map(RejectedFit.of, seat.rejected)),
            admissible_fits=tuple(map(AdmissibleFit.of, seat.admissible)),
            load_intensity_kN_per_m=None if intensity is None else from_si(intensity, "kN_per_m"),
            creep=Creep.of(seat),
            requirements=Requirements.of(seat.requirements),
            asked_interference_um=None if seat.asked is None else um_pair(seat.asked),
            selective_groups=sorted_out.groups if sorted_out else None,
            selective_interference_um=um_pair(sorted_out.interference) if sorted_out else None,
            sorting_groups=tuple(SortingGroup.of(group, seat.seat) for group in seat.groups),
            repair=Repair.of(seat.repair) if seat.repair else None,
            notes=seat.notes,
            internal_clearance=clearance,
            bearing_verdict=worst(bearing.checks),
            diameter_mm=from_si(ring.diameter, "mm"),
            ring_width_mm=from_si(ring.width, "mm"),
            chamfer_mm=None if ring.chamfer is None else from_si(ring.chamfer, "mm"),
        )


def seat_results(bearing: "BearingSeats") -> tuple[SeatResult, SeatResult]:
    """Both seats of a bearing, shaft first; the clearance left in the bearing stands in both."""
    left = None if bearing.clearance is None else Clearance.of(bearing.clearance)
    return SeatResult.of(bearing.shaft, bearing, left), SeatResult.of(bearing.housing, bearing, left)
