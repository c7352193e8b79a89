"""Both seats of a bearing, judged: what `abu check-fit` prints.

What few bearings ask for is imported when one does.
"""

from typing import TYPE_CHECKING, NamedTuple

from abu_calc.checks import Check
from abu_calc.fits.advice import admissible, advised_class, load_intensity
from abu_calc.fits.bearing import Bearing, from_table
from abu_calc.fits.creep import Creep, creep
from abu_calc.fits.drawing import Requirements, seat_requirements
from abu_calc.fits.interference import Interval, probable_interference, truncated_clearance_probability
from abu_calc.fits.joint import Joint, Loss
from abu_calc.fits.judgement import clearance_checks, seat_checks, start_checks
from abu_calc.fits.pairing import housing_joint, shaft_joint
from abu_calc.fits.requirement import catalogue_smoothing_loss
from abu_calc.standards.limits import Limits, Seat
from abu_calc.units import from_si

if TYPE_CHECKING:
    from abu_calc.fits.clearance import ClearanceLeft
    from abu_calc.fits.selective import Selection
    from abu_calc.spec.bearing import Bearing as BearingTable


class Item(NamedTuple):
    """An entry of the ledger of losses; `counted` in the required interference, or shown beside it."""

    loss: Loss
    counted: bool


class Admissible(NamedTuple):
    """A tolerance class that passes, its interference [m] and probability of clearance."""

    fit: str
    interference: Interval
    clearance_probability: float


class SeatFit(NamedTuple):
    """One seat: lengths and interferences [m], stress [Pa], load intensity [N/m]; null where a check or note says why.

    `required_interference` is that of a ring under a rotating load; a ring under a load fixed in direction is not held
    to it. `losses` are those included in it beside the load, `ledger` all that are known, counted or not.
    """

    name: str
    joint: Joint
    probable_interference: Interval
    truncated_probability: float
    ledger: tuple[Item, ...]
    admissible: tuple[Admissible, ...]
    load_intensity: float | None
    creep: Creep
    requirements: Requirements
    asked: Interval | None
    selection: "Selection | None"
    notes: tuple[str, ...]
    checks: tuple[Check, ...]

    @property
    def seat(self) -> Seat:
        """Shaft or housing."""
        return self.joint.seat

    @property
    def fit(self) -> str:
        """Tolerance class of the part."""
        return self.joint.tolerance_class

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
        """What a ring under a rotating load needs, losses included."""
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
        """Hoop stress of the ring at the largest interference."""
        return self.joint.hoop_stress

    @property
    def recommended_fit(self) -> str | None:
        """The first of the admissible classes."""
        return self.admissible[0].fit if self.admissible else None


class BearingSeats(NamedTuple):
    """A bearing's seats, shaft first, and the clearance left in it."""

    bearing: Bearing
    shaft: SeatFit
    housing: SeatFit
    clearance: "ClearanceLeft | None" = None

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
    """Judge both seats of a bearing. A band asked for is meant for the rings that must grip, else for both."""
    joints = shaft_joint(bearing), housing_joint(bearing)
    asked_of = [joint for joint in joints if joint.must_grip] or joints
    asked = None if bearing.asked_interference is None else Interval(*bearing.asked_interference)
    shaft, housing = (_seat_fit(bearing, joint, asked if joint in asked_of else None) for joint in joints)
    return BearingSeats(bearing, shaft, housing, _clearance(bearing, *joints))


def _clearance(bearing: Bearing, shaft: Joint, housing: Joint) -> "ClearanceLeft | None":
    if bearing.internal_clearance is None:
        return None
    from abu_calc.fits.clearance import clearance_left

    return clearance_left(bearing.internal_clearance, bearing, shaft, housing)


def _seat_fit(bearing: Bearing, joint: Joint, asked: Interval | None) -> SeatFit:
    friction, torque = bearing.service.seat_friction, bearing.service.starting_torque
    verdict = creep(joint, friction, torque)
    passing = tuple(
        Admissible(one.tolerance_class, one.interference, one.clearance_probability)
        for one in admissible(joint)
        if torque is None or creep(one, friction, torque).holds_at_start is not False
    )
    recommended = passing[0].fit if passing else None
    intensity = None
    if joint.radial_load is not None and joint.length is not None:
        intensity = load_intensity(joint.radial_load, joint.length)
    selection = _selection(joint, asked)
    return SeatFit(
        name=bearing.name,
        joint=joint,
        probable_interference=probable_interference(*joint.male_and_female),
        truncated_probability=truncated_clearance_probability(*joint.male_and_female),
        ledger=_ledger(joint),
        admissible=passing,
        load_intensity=intensity,
        creep=verdict,
        requirements=seat_requirements(joint, recommended or joint.tolerance_class, bearing.bearing_class),
        asked=asked,
        selection=selection,
        notes=_notes(bearing, joint, intensity) + _sorting_note(joint, asked, selection),
        checks=seat_checks(bearing.name, joint, recommended)
        + start_checks(bearing.name, joint, verdict, torque, recommended),
    )


def _selection(joint: Joint, asked: Interval | None) -> "Selection | None":
    if asked is None:
        return None
    from abu_calc.fits.selective import selective_groups

    return selective_groups(*joint.male_and_female, asked)


def _ledger(joint: Joint) -> tuple[Item, ...]:
    """The load by both rules, of which the larger counts, then the losses given, each by its formula."""
    needs = joint.required.by if joint.required else None
    items = [Item(Loss("load", bound.value, bound.by), bound.by == needs) for bound in joint.criteria]
    for loss in joint.losses:
        items.append(Item(loss, True))
        if loss.name == "smoothing":
            value = catalogue_smoothing_loss(joint.interference.smallest, joint.diameter)
            items.append(Item(Loss("smoothing", value, "δ·2/(d + 2) (bearing catalogues, unverified)"), False))
    return tuple(items)


def _notes(bearing: Bearing, joint: Joint, intensity: float | None) -> tuple[str, ...]:
    lent = (f"No chamfer is given: that of {bearing.chamfer_from}, which has the same sizes, is taken.",)
    notes = lent if bearing.chamfer_from else ()
    if intensity is None:
        return notes
    advised = advised_class(joint.seat, joint.diameter, intensity)
    advice = f"handbook tables advise {advised}" if advised else "outside the handbook tables"
    needs = ", ".join(f"{from_si(one.value, 'um'):.2f} µm by {one.by}" for one in joint.criteria)
    return (
        f"A ring under a rotating load needs, losses aside: {needs}; the larger counts.",
        f"k = {joint.factor:g} of the {bearing.series} series is an unverified handbook value.",
        f"Load intensity {from_si(intensity, 'kN_per_m'):.0f} kN/m with strong shocks: {advice} (unverified advice).",
        *notes,
    )


def _sorting_note(joint: Joint, asked: Interval | None, selection: "Selection | None") -> tuple[str, ...]:
    if asked is None:
        return ()
    band = f"{from_si(asked.smallest, 'um'):g} … {from_si(asked.largest, 'um'):g} µm"
    if selection is None:
        male, female = joint.male_and_female
        ends = sorted((male.lower - female.lower, male.upper - female.upper))
        reach = " … ".join(f"{from_si(end, 'um'):g}" for end in ends)
        return (
            f"Sorting cannot keep {joint.tolerance_class} within {band}: however fine the groups, they spread over "
            f"{reach} µm, the band must reach beyond both.",
        )
    if selection.groups == 1:
        return (f"{joint.tolerance_class} keeps within {band} without sorting.",)
    reached = (
        f"{from_si(selection.interference.smallest, 'um'):.3g} … {from_si(selection.interference.largest, 'um'):.3g}"
    )
    return (
        f"Selective assembly: sorted into {selection.groups} equal groups and matched by number, "
        f"{joint.tolerance_class} keeps within {reached} µm (asked {band}).",
    )
