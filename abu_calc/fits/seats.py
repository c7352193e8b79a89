"""Both seats of a bearing, judged: what `abu check-fit` prints.

What few bearings ask for is imported when one does.
"""

from typing import TYPE_CHECKING, NamedTuple

from abu_calc.checks import Check
from abu_calc.fits.advice import Rejected, Start, admissible
from abu_calc.fits.bearing import Bearing
from abu_calc.fits.creep import Creep, creep
from abu_calc.fits.drawing import Requirements, seat_requirements
from abu_calc.fits.intensity import load_intensity
from abu_calc.fits.interference import Interval, probable_interference, truncated_clearance_probability
from abu_calc.fits.joint import Joint, Loss
from abu_calc.fits.judgement import clearance_checks, seat_checks, start_checks
from abu_calc.fits.notes import Item, ledger, seat_notes
from abu_calc.fits.pairing import housing_joint, shaft_joint
from abu_calc.fits.reading import from_table
from abu_calc.fits.whole import SeatAdvice, advice
from abu_calc.standards.limits import Limits, Seat

if TYPE_CHECKING:
    from abu_calc.fits.clearance import ClearanceLeft
    from abu_calc.fits.repair import Repair
    from abu_calc.fits.selective import Group, Selection
    from abu_calc.spec.bearing import Bearing as BearingTable


class Admissible(NamedTuple):
    """A tolerance class that neither creeps nor overstresses, its interference [m] and probability of clearance."""

    fit: str
    interference: Interval
    clearance_probability: float


class SeatFit(NamedTuple):
    """One seat: lengths and interferences [m], stress [Pa], load intensity [N/m]; null where a check or note says why.

    `required_interference` is that of a ring under a rotating load; a ring under a load fixed in direction is not held
    to it. `losses` are those included in it beside the load, `ledger` all that are known, counted or not; `groups`
    those of the `selection`; `repair` of a seat whose limits are measured.
    """

    name: str
    joint: Joint
    given: bool
    probable_interference: Interval
    truncated_probability: float
    ledger: tuple[Item, ...]
    advice: SeatAdvice
    admissible: tuple[Admissible, ...]
    load_intensity: float | None
    creep: Creep
    requirements: Requirements
    asked: Interval | None
    selection: "Selection | None"
    groups: "tuple[Group, ...]"
    repair: "Repair | None"
    notes: tuple[str, ...]
    checks: tuple[Check, ...]

    @property
    def seat(self) -> Seat:
        """Shaft or housing."""
        return self.joint.seat

    @property
    def fit(self) -> str:
        """Tolerance class of the part, or that its limits are measured."""
        return self.joint.fit_name

    @property
    def part_limits(self) -> Limits:
        """Limits of the shaft or housing."""
        return self.joint.part

    @property
    def ring_limits(self) -> Limits:
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
    def losses(self) -> tuple[Loss, ...]:
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
    def recommended_fit(self) -> str | None:
        """The class to write."""
        return self.advice.best.tolerance_class if self.advice.best else None

    @property
    def rejected(self) -> "tuple[Rejected, ...]":
        """The next looser and the next tighter class that will not do, and why."""
        return self.advice.rejected


class BearingSeats(NamedTuple):
    """A bearing's seats, shaft first, the clearance left in it, the group of clearance to order with the advice."""

    bearing: Bearing
    shaft: SeatFit
    housing: SeatFit
    clearance: "ClearanceLeft | None" = None
    group_to_order: str | None = None

    @property
    def seats(self) -> tuple[SeatFit, SeatFit]:
        """Shaft, housing."""
        return self.shaft, self.housing

    @property
    def checks(self) -> tuple[Check, ...]:
        """The checks of both seats and of the clearance."""
        return self.shaft.checks + self.housing.checks + clearance_checks(self.bearing.name, self.clearance)


def seat_bearing(table: "BearingTable") -> BearingSeats:
    """Judge the seats of the bearing that a `[[bearing]]` table describes.

    InputError or RangeError: unknown designation, tolerance class or accuracy class, a size outside their tables.
    """
    return judge(from_table(table))


def judge(bearing: Bearing) -> BearingSeats:
    """Judge both seats of a bearing; one without a fit is judged with the field advised.

    A band asked for is meant for the rings that must grip, else for both.
    """
    given = shaft_joint(bearing), housing_joint(bearing)
    recommendation = advice(bearing, *given)
    open_seats = [part.fit is None and part.measured is None for part in (bearing.shaft, bearing.housing)]
    joints = [
        own.best if unsaid and own.best else joint
        for joint, own, unsaid in zip(given, (recommendation.shaft, recommendation.housing), open_seats, strict=True)
    ]
    asked_of = [joint for joint in joints if joint.must_grip] or joints
    asked = None if bearing.asked_interference is None else Interval(*bearing.asked_interference)
    shaft, housing = (
        _seat_fit(bearing, joint, own, not unsaid, asked if joint in asked_of else None)
        for joint, own, unsaid in zip(joints, (recommendation.shaft, recommendation.housing), open_seats, strict=True)
    )
    return BearingSeats(bearing, shaft, housing, _clearance(bearing, *joints), recommendation.group)


def _clearance(bearing: Bearing, shaft: Joint, housing: Joint) -> "ClearanceLeft | None":
    if bearing.internal_clearance is None:
        return None
    from abu_calc.fits.clearance import clearance_left

    return clearance_left(bearing.internal_clearance, bearing, shaft, housing)


def _seat_fit(bearing: Bearing, joint: Joint, own: SeatAdvice, given: bool, asked: Interval | None) -> SeatFit:
    start: Start = (bearing.service.seat_friction, bearing.service.starting_torque)
    creep_result = creep(joint, *start)
    recommended = own.best.tolerance_class if own.best else None
    intensity = None
    if joint.radial_load is not None and joint.length is not None:
        intensity = load_intensity(joint.radial_load, joint.length)
    selection, groups = _sorting(joint, asked)
    wanted = recommended or joint.tolerance_class
    return SeatFit(
        name=bearing.name,
        joint=joint,
        given=given,
        probable_interference=probable_interference(*joint.male_and_female),
        truncated_probability=truncated_clearance_probability(*joint.male_and_female),
        ledger=ledger(joint),
        advice=own,
        admissible=tuple(
            Admissible(candidate.tolerance_class, candidate.interference, candidate.clearance_probability)
            for candidate in admissible(joint, start, own.best)
        ),
        load_intensity=intensity,
        creep=creep_result,
        requirements=seat_requirements(joint, wanted, bearing.bearing_class),
        asked=asked,
        selection=selection,
        groups=groups,
        repair=_repair(bearing, joint, wanted),
        notes=seat_notes(bearing, joint, own, given, intensity, asked, selection),
        checks=seat_checks(bearing, joint, recommended)
        + start_checks(bearing.name, joint, creep_result, bearing.service.starting_torque, recommended),
    )


def _sorting(joint: Joint, asked: Interval | None) -> "tuple[Selection | None, tuple[Group, ...]]":
    if asked is None:
        return None, ()
    from abu_calc.fits.selective import selective_groups, sorting_groups

    selection = selective_groups(*joint.male_and_female, asked)
    return selection, sorting_groups(*joint.male_and_female, selection.groups) if selection else ()


def _repair(bearing: Bearing, joint: Joint, advised: str) -> "Repair | None":
    """Repair to the drawing's tolerance class; to the advised one if the drawing gives none.

    None if no limits are measured.
    """
    if joint.measured is None:
        return None
    from abu_calc.fits.repair import seat_repair

    part = bearing.shaft if joint.seat == "shaft" else bearing.housing
    return seat_repair(joint, part.fit or advised, bearing.designation)
