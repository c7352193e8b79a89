"""Both seats of a bearing, judged: what `abu check-fit` prints."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from abu_calc.checks import Check
from abu_calc.fits.advice import advised_class, load_intensity, recommended_class
from abu_calc.fits.bearing import Bearing, from_table
from abu_calc.fits.interference import Interval, probable_interference
from abu_calc.fits.joint import Joint, housing_joint, shaft_joint
from abu_calc.fits.judgement import seat_checks
from abu_calc.standards.limits import Limits, Seat
from abu_calc.units import from_si

if TYPE_CHECKING:
    from abu_calc.spec.bearing import Bearing as BearingTable


@dataclass(frozen=True)
class SeatFit:
    """One seat: lengths and interferences [m], stress [Pa], load intensity [N/m]; null where a check says why.

    `required_interference` is that of a ring under a rotating load; a ring under a load fixed in direction is not held
    to it. `losses` are those included in it, by name.
    """

    name: str
    seat: Seat
    fit: str
    part_limits: Limits
    ring_limits: Limits
    interference: Interval
    probable_interference: Interval
    clearance_probability: float
    required_interference: float | None
    required_by: str | None
    losses: tuple[tuple[str, float], ...]
    permitted_interference: float
    permitted_by: str
    hoop_stress: float
    recommended_fit: str | None
    load_intensity: float | None
    notes: tuple[str, ...]
    checks: tuple[Check, ...]


@dataclass(frozen=True)
class BearingSeats:
    """A bearing's seats, shaft first."""

    bearing: Bearing
    shaft: SeatFit
    housing: SeatFit

    @property
    def seats(self) -> tuple[SeatFit, SeatFit]:
        """Shaft, housing."""
        return self.shaft, self.housing

    @property
    def checks(self) -> tuple[Check, ...]:
        """The checks of both seats."""
        return self.shaft.checks + self.housing.checks


def seat_bearing(table: "BearingTable") -> BearingSeats:
    """Judge the seats of the bearing that a `[[bearing]]` table describes.

    InputError or RangeError: unknown designation, tolerance class or accuracy class, a size outside their tables.
    """
    return judge(from_table(table))


def judge(bearing: Bearing) -> BearingSeats:
    """Judge both seats of a bearing."""
    shaft = _seat_fit(bearing, shaft_joint(bearing))
    return BearingSeats(bearing, shaft, _seat_fit(bearing, housing_joint(bearing)))


def _seat_fit(bearing: Bearing, joint: Joint) -> SeatFit:
    required, permitted, recommended = joint.required, joint.permitted, recommended_class(joint)
    intensity = None
    if joint.radial_load is not None and joint.length is not None:
        intensity = load_intensity(joint.radial_load, joint.length)
    return SeatFit(
        name=bearing.name,
        seat=joint.seat,
        fit=joint.tolerance_class,
        part_limits=joint.part,
        ring_limits=joint.ring,
        interference=joint.interference,
        probable_interference=probable_interference(*joint.male_and_female),
        clearance_probability=joint.clearance_probability,
        required_interference=required.value if required else None,
        required_by=required.by if required else None,
        losses=joint.losses,
        permitted_interference=permitted.value,
        permitted_by=permitted.by,
        hoop_stress=joint.hoop_stress,
        recommended_fit=recommended,
        load_intensity=intensity,
        notes=_notes(bearing, joint, intensity),
        checks=seat_checks(bearing.name, joint, recommended),
    )


def _notes(bearing: Bearing, joint: Joint, intensity: float | None) -> tuple[str, ...]:
    if intensity is None:
        return ()
    advised = advised_class(joint.seat, joint.diameter, intensity)
    advice = f"handbook tables advise {advised}" if advised else "outside the handbook tables"
    needs = ", ".join(f"{from_si(one.value, 'um'):.2f} µm by {one.by}" for one in joint.criteria)
    return (
        f"A ring under a rotating load needs, losses aside: {needs}; the larger counts.",
        f"k = {joint.factor:g} of the {bearing.series} series is an unverified handbook value.",
        f"Load intensity {from_si(intensity, 'kN_per_m'):.0f} kN/m with strong shocks: {advice} (unverified advice).",
    )
