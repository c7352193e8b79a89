"""A seat as a joint of two parts, the same for shaft and housing: what every judgement of it needs."""

from dataclasses import dataclass, replace
from functools import cached_property

from abu_calc.fits.bearing import Bearing, RingLoad
from abu_calc.fits.interference import Interval, clearance_probability, theoretical_interference
from abu_calc.fits.requirement import (
    SERIES_FACTORS,
    centrifugal_loss,
    creep_interference,
    load_loss,
    smoothing_loss,
    temperature_loss,
)
from abu_calc.fits.stress import (
    PERMITTED_RING_STRESS,
    Tube,
    inner_ring_diameter,
    inner_ring_stress,
    outer_ring_diameter,
    outer_ring_stress,
)
from abu_calc.standards.balls import seat_material
from abu_calc.standards.limits import Limits, Seat, part_limits, ring_limits


@dataclass(frozen=True)
class Bound:
    """A bound on the interference [m] and the criterion that sets it."""

    value: float
    by: str


@dataclass(frozen=True)
class Joint:
    """One ring on its seat. Lengths [m]; `length` of the seat between the chamfers, None where they are not known;
    `losses` [m] by name, only those that the input asks for; `stress_rate` hoop stress of the ring per interference
    [Pa/m]."""

    seat: Seat
    tolerance_class: str
    diameter: float
    width: float
    length: float | None
    ring: Limits
    ring_load: RingLoad
    radial_load: float | None
    factor: float
    losses: tuple[tuple[str, float], ...]
    stress_rate: float

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
        return (self.part, self.ring) if self.seat == "shaft" else (self.ring, self.part)

    @property
    def interference(self) -> Interval:
        """Theoretical interference."""
        return theoretical_interference(*self.male_and_female)

    @property
    def clearance_probability(self) -> float:
        """Probability that a pair is loose."""
        return clearance_probability(*self.male_and_female)

    @property
    def must_grip(self) -> bool:
        """Whether the load turns round the ring, or may do so, and would make a loose ring creep."""
        return self.ring_load != "stationary"

    @property
    def criteria(self) -> tuple[Bound, ...]:
        """What a ring under a rotating load needs by each rule, losses aside; none without load or seat length."""
        if self.radial_load is None or self.length is None:
            return ()
        return (
            Bound(creep_interference(self.radial_load, self.length, self.factor), "13·R·k/b (Afanasiev 2015)"),
            Bound(load_loss(self.radial_load, self.diameter, self.width), "0.08·√(d·F_r/B) (bearing catalogues)"),
        )

    @property
    def required(self) -> Bound | None:
        """The larger of the criteria with the losses given; None where there is no criterion."""
        if not self.criteria:
            return None
        larger = max(self.criteria, key=lambda bound: bound.value)
        return Bound(larger.value + sum(value for _, value in self.losses), larger.by)

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
        """Whether the loosest pair holds a ring that must be held; None when that cannot be said."""
        if not self.must_grip:
            return True
        return None if self.required is None else self.interference.smallest >= self.required.value

    @property
    def bears(self) -> bool:
        """Whether the tightest pair is permitted."""
        return self.interference.largest <= self.permitted.value


def shaft_joint(bearing: Bearing) -> Joint:
    """The inner ring on the shaft."""
    steel = seat_material("steel")
    ring_diameter = inner_ring_diameter(bearing.bore, bearing.outer)
    shaft, ring = Tube(bearing.shaft_bore / bearing.bore, steel), Tube(bearing.bore / ring_diameter, steel)
    losses = []
    if bearing.shaft_roughness is not None:
        losses.append(("smoothing", smoothing_loss(bearing.shaft_roughness)))
    if bearing.temperature_difference is not None:
        difference = bearing.temperature_difference
        losses.append(("temperature", temperature_loss(steel.expansion, bearing.bore, difference)))
    if bearing.speed is not None:
        growth = centrifugal_loss(bearing.speed, bearing.bore, ring_diameter, bearing.shaft_bore, steel)
        losses.append(("centrifugal growth", growth))
    return Joint(
        seat="shaft",
        tolerance_class=bearing.shaft_fit,
        diameter=bearing.bore,
        width=bearing.inner_width,
        length=_length(bearing.inner_width, bearing.inner_chamfer),
        ring=ring_limits(bearing.type, "inner", bearing.bearing_class, bearing.bore),
        ring_load=bearing.inner_ring_load,
        radial_load=bearing.radial_load,
        factor=SERIES_FACTORS[bearing.series],
        losses=tuple(losses),
        stress_rate=inner_ring_stress(1.0, bearing.bore, shaft, ring),
    )


def housing_joint(bearing: Bearing) -> Joint:
    """The outer ring in the housing. A ring warmer than its housing sits tighter, so that is no loss here."""
    ring_ratio = outer_ring_diameter(bearing.bore, bearing.outer) / bearing.outer
    ratio = 0.0 if bearing.housing_outer is None else bearing.outer / bearing.housing_outer
    ring, housing = Tube(ring_ratio, seat_material("steel")), Tube(ratio, seat_material(bearing.housing_material))
    rough = bearing.housing_roughness
    return Joint(
        seat="housing",
        tolerance_class=bearing.housing_fit,
        diameter=bearing.outer,
        width=bearing.outer_width,
        length=_length(bearing.outer_width, bearing.outer_chamfer),
        ring=ring_limits(bearing.type, "outer", bearing.bearing_class, bearing.outer),
        ring_load=bearing.outer_ring_load,
        radial_load=bearing.radial_load,
        factor=SERIES_FACTORS[bearing.series],
        losses=() if rough is None else (("smoothing", smoothing_loss(rough)),),
        stress_rate=outer_ring_stress(1.0, bearing.outer, ring, housing),
    )


def _length(width: float, chamfer: float | None) -> float | None:
    return None if chamfer is None else width - 2 * chamfer
