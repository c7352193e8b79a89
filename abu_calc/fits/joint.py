"""A seat as a joint of two parts, the same for shaft and housing: what every judgement of it needs."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

from abu_calc.fits.bearing import Ring
from abu_calc.fits.interference import Interval, clearance_probability, theoretical_interference
from abu_calc.fits.requirement import creep_interference, load_loss
from abu_calc.fits.stress import PERMITTED_RING_STRESS
from abu_calc.standards.limits import Limits, Seat, part_limits


class Bound(NamedTuple):
    """A bound on the interference [m] and the criterion that sets it."""

    value: float
    by: str


class Loss(NamedTuple):
    """What service takes from the interference [m], by which formula."""

    name: str
    value: float
    formula: str


@dataclass(frozen=True)
class Joint:
    """One ring on its seat, with the limits of the ring; `losses` [m] only those that the input asks for.

    Per interference: `pressure_rate` [Pa/m], `stress_rate` hoop stress of the ring [Pa/m], `raceway_rate` change of the
    raceway's diameter [1].
    """

    seat: Seat
    tolerance_class: str
    ring: Ring
    ring_limits: Limits
    radial_load: float | None
    factor: float
    losses: tuple[Loss, ...]
    pressure_rate: float
    stress_rate: float
    raceway_rate: float

    @property
    def diameter(self) -> float:
        """Nominal diameter of the seat [m]."""
        return self.ring.diameter

    @property
    def length(self) -> float | None:
        """Length of the seat between the chamfers [m]; None where they are not known."""
        return self.ring.seat_length

    def with_class(self, tolerance_class: str) -> "Joint":
        """The same joint with its part to another tolerance class."""
        return replace(self, tolerance_class=tolerance_class)

    @cached_property
    def part(self) -> Limits:
        """Limits of the shaft or housing."""
        return part_limits(self.seat, self.tolerance_class, self.diameter)

    @property
    def male_and_female(self) -> tuple[Limits, Limits]:
        """Limits of the part inside and of the part around it."""
        return (self.part, self.ring_limits) if self.seat == "shaft" else (self.ring_limits, self.part)

    @cached_property
    def interference(self) -> Interval:
        """Theoretical interference."""
        return theoretical_interference(*self.male_and_female)

    @cached_property
    def clearance_probability(self) -> float:
        """Probability that a pair is loose."""
        return clearance_probability(*self.male_and_female)

    @property
    def must_grip(self) -> bool:
        """Whether the load turns round the ring, or may do so, and would make a loose ring creep."""
        return self.ring.load != "stationary"

    @property
    def criteria(self) -> tuple[Bound, ...]:
        """What a ring under a rotating load needs by each rule, losses aside; none without load or seat length."""
        if self.radial_load is None or self.length is None:
            return ()
        return (
            Bound(creep_interference(self.radial_load, self.length, self.factor), "13·R·k/b (Afanasiev 2015)"),
            Bound(load_loss(self.radial_load, self.diameter, self.ring.width), "0.08·√(d·F_r/B) (bearing catalogues)"),
        )

    @cached_property
    def required(self) -> Bound | None:
        """The larger of the criteria with the losses given; None where there is no criterion."""
        if not self.criteria:
            return None
        larger = max(self.criteria, key=lambda bound: bound.value)
        return Bound(larger.value + sum(loss.value for loss in self.losses), larger.by)

    @property
    def permitted(self) -> Bound:
        """Largest interference that ring and bearing bear."""
        lame = Bound(PERMITTED_RING_STRESS / self.stress_rate, "hoop stress 400 MPa (Lamé)")
        catalogue = Bound(self.diameter / 1000, "d/1000 (bearing catalogues)")
        return min(lame, catalogue, key=lambda bound: bound.value)

    @property
    def hoop_stress(self) -> float:
        """Hoop stress [Pa] of the ring at the largest theoretical interference."""
        return self.stress_rate * max(self.interference.largest, 0.0)

    @property
    def grips(self) -> bool | None:
        """Whether the loosest pair holds a ring that must be held; None when what it needs is not known."""
        if not self.must_grip:
            return True
        return None if self.required is None else self.interference.smallest >= self.required.value

    @property
    def bears(self) -> bool:
        """Whether the tightest pair is permitted."""
        return self.interference.largest <= self.permitted.value

    @property
    def lasting_losses(self) -> float:
        """Losses [m] that are there when the shaft starts to turn: all but the growth by speed."""
        return sum(loss.value for loss in self.losses if loss.name != CENTRIFUGAL)


CENTRIFUGAL = "centrifugal growth"
