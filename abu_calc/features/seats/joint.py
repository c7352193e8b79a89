"""A seat as a joint of two parts, the same for shaft and housing, and the stress in its ring by Lamé."""

import math
import re
from dataclasses import replace
from functools import cached_property
from typing import Annotated, Final, NamedTuple

from abu_calc.features.seats.bearing import SEAT_DIAMETER, TUBE_RATIO, Ring
from abu_calc.features.seats.interference import (
    Interval,
    Pair,
    SeatRecord,
    clearance_probability,
    creep_interference,
    load_loss,
    probability_below,
    theoretical_interference,
)
from abu_calc.foundation.checks import Grade
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.standards.balls import Material
from abu_calc.standards.tolerance_classes import DeviationLimits, MakerFits, Seat, part_limits, tolerance_classes

PERMITTED_RING_STRESS: Final = 400e6
"""Hoop stress [Pa] permitted in a ring of bearing steel: handbook value quoted by Afanasiev 2015, unverified."""

SECTION_SHARE: Final = 0.28
"""Share of the section height (D − d) that a ring has as a plain tube: mean diameter of the race, assumed.

It gives d/d₁ = 0.826 for the 80 × 140 mm bearing of Afanasiev 2015.
"""


class Tube(NamedTuple):
    """One part of a joint: ratio of its inner to its outer diameter (0: solid shaft, endless housing), material."""

    ratio: float
    material: Material

    @property
    def hoop_at_bore(self) -> float:
        """Hoop stress at the bore per pressure inside: (1+q²)/(1−q²)."""
        return (1 + TUBE_RATIO.check(self.ratio) ** 2) / (1 - self.ratio**2)

    @property
    def hoop_under_pressure_outside(self) -> float:
        """Magnitude of the (compressive) hoop stress at the bore per pressure outside: 2/(1−q²)."""
        return 2 / (1 - TUBE_RATIO.check(self.ratio) ** 2)


def inner_ring_diameter(bore: float, outer: float) -> float:
    """Outer diameter [m] of the inner ring as a plain tube: d₁ = d + 0.28·(D − d).

    Range: usual sections of ball and roller bearings; assumed.

    >>> round(0.080 / inner_ring_diameter(0.080, 0.140), 3)
    0.826
    """
    return bore + SECTION_SHARE * (outer - bore)


def outer_ring_diameter(bore: float, outer: float) -> float:
    """Inner diameter [m] of the outer ring as a plain tube: D₁ = D − 0.28·(D − d). Range as for the inner ring."""
    return outer - SECTION_SHARE * (outer - bore)


@formula(
    "Pressure between two press-fitted tubes",
    "p = (δ/d)/{[(1+q₂²)/(1−q₂²) + ν₂]/E₂ + [(1+q₁²)/(1−q₁²) − ν₁]/E₁}",
    "Pa",
    where="Without interference there is no pressure.",
    checked=(TUBE_RATIO, SEAT_DIAMETER),
    assumed="elastic, long tubes of equal length",
    source="Lamé; DIN 7190-1:2017",
)
def contact_pressure(interference: float, diameter: float, male: Tube, female: Tube) -> float:
    around = (female.hoop_at_bore + female.material.poisson_ratio) / female.material.youngs_modulus
    inside = (male.hoop_at_bore - male.material.poisson_ratio) / male.material.youngs_modulus
    return max(interference, 0.0) / SEAT_DIAMETER.check(diameter) / (around + inside)


@formula(
    "Largest hoop stress in an inner ring, tension at its bore",
    "p·(1+q²)/(1−q²)",
    "Pa",
    signs="E δ d",
    where="On a solid shaft of the same steel it is E·δ·(1+q²)/(2d).",
    checked=(TUBE_RATIO, SEAT_DIAMETER),
    assumed="as for the contact pressure",
    source="Lamé",
)
def inner_ring_stress(interference: float, diameter: float, shaft: Tube, ring: Tube) -> float:
    """
    >>> steel = Material("steel", 7800.0, 206e9, 0.3, 12e-6)
    >>> round(1e-6 * inner_ring_stress(45e-6, 0.080, Tube(0.0, steel), Tube(80 / 96.8, steel)), 1)
    97.5
    """
    return contact_pressure(interference, diameter, shaft, ring) * ring.hoop_at_bore


@formula(
    "Change of the diameter of a ring's raceway under the pressure of its seat",
    "2·p·q·d/[(1−q²)·E]",
    "m",
    shown="um",
    signs="δ",
    where=(
        "By this formula an inner ring's raceway grows and an outer ring's shrinks. On a solid shaft of the ring's "
        "steel the change is q·δ."
    ),
    checked=(TUBE_RATIO,),
    assumed="as for the contact pressure",
    source="Lamé",
)
def raceway_change(pressure: float, diameter: float, ring: Tube) -> float:
    """
    >>> steel = Material("steel", 7800.0, 206e9, 0.3, 12e-6)
    >>> ring = Tube(0.8, steel)
    >>> round(1e6 * raceway_change(contact_pressure(10e-6, 0.080, Tube(0.0, steel), ring), 0.080, ring), 6)
    8.0
    """
    return pressure * ring.hoop_under_pressure_outside * ring.ratio * diameter / ring.material.youngs_modulus


@formula(
    "Magnitude of the largest hoop stress in an outer ring, compression at its bore",
    "2p/(1−q²)",
    "Pa",
    checked=(TUBE_RATIO, SEAT_DIAMETER),
    assumed="as for the contact pressure",
    source="Lamé",
)
def outer_ring_stress(interference: float, diameter: float, ring: Tube, housing: Tube) -> float:
    return contact_pressure(interference, diameter, ring, housing) * ring.hoop_under_pressure_outside


CENTRIFUGAL: Final = "centrifugal growth"
TEMPERATURE: Final = "temperature"
ARTICLE: Final = {"rotating": "a rotating", "indeterminate": "an indeterminate", "stationary": "a stationary"}
"""Loads of rings with their article."""
MEASURED: Final = "measured"
"""Name in place of a tolerance class if the limits are as measured."""
_FOR_HALVES: Final = frozenset("FGHJ")


BEYOND_ROWS: Final = {
    "shaft": "No tabulated class makes up for the hollow shaft",
    "housing": "The housing is thinner than the catalogue's row supposes",
}
"""Reasons why a catalogue's row gives no class for a seat."""


class InterferenceBound(NamedTuple):
    """A bound on the interference [m] and the criterion that sets it."""

    value: float
    by: str


@record
class Loss(SeatRecord):
    """Loss of interference: the load by both rules, of which the larger counts, then the losses given."""

    name: Annotated[str, Quantity("loss")]
    amount: Annotated[float, Quantity("taken from the interference", unit="um")]
    formula: Annotated[str, Quantity("formula")]
    counted: Annotated[bool, Quantity("counted in the required interference")] = True


class ThermalCase(NamedTuple):
    """Temperature case of a seat: name, rise of all parts over mounting [K] (None: not given), loss [m]."""

    name: str
    rise: float | None
    loss: float


LOOSE_ENOUGH: Final = 0.5
"""A ring under a load fixed in direction should be loose in at least half of all pairs: it creeps, spreads its wear
and can be moved along its seat."""
_SURE: Final = 3.0
"""Standard deviations below the mean: the smallest probable interference, which 999 of 1000 pairs exceed.

Small losses, as of a ground seat or an ordinary speed, then do not push the catalogue's own class aside.
"""
_SOLID: Final = 0.9
"""Share of the pressure from which on makers leave the class of a hollow shaft as it is: bore up to half of d."""
_NEAR: Final = 0.85
"""Share of the wanted mean interference that the nearest class must have: half the step from p6 to r6; assumed."""
THINNEST: Final = 0.2
"""Share of the pressure below which no row for thin-walled housings is meant; assumed. Aluminium 58/52 mm keeps 0.22.
"""
_GRADES: Final = re.compile(r"[a-zA-Z]+")


@record
class ThermalInterference(SeatRecord):
    """Interference of a seat at one temperature case."""

    case: Annotated[str, Quantity("temperature case", "", 4, "mounting, working, lowest, highest")]
    rise: Annotated[float | None, Quantity("rise over mounting", "", 4, "None: differences alone are given", unit="K")]
    interference: Annotated[Pair, Quantity("interference", unit="um")]


@dataclass(frozen=True)
class Joint:
    """One ring on its seat, with the limits of the ring; `losses` [m] only those that the input asks for.

    Per interference: `pressure_rate` [Pa/m], `stress_rate` and `part_rate` hoop stress of the ring and of the part
    [Pa/m], `raceway_rate` change of the raceway's diameter [1]; `part_strength` [Pa]. `maker`: the catalogue's classes
    for this seat and load, None where it has none or C is not known; `split` of a housing in halves. `pressure_kept`:
    share of the pressure that a solid shaft or a thick housing would give; `thermal_cases` at which the seat is judged;
    `short_shares` of pairs above which it warns, and fails; `runs_on_needles`: a shaft without inner ring;
    `cup_classes`: the makers' for the housing of a drawn cup; `usual_growth`: the centrifugal growth [m] that the
    catalogue's experience includes, up to the limiting speed of the bearing; `light_alloy` of a housing;
    `warmth_assumed`: no temperature is given; `load_assumed`: the radial load is a normal one, since none is given.
    """

    seat: Seat
    tolerance_class: str
    ring: Ring
    ring_limits: DeviationLimits
    radial_load: float | None
    factor: float
    losses: tuple[Loss, ...]
    pressure_rate: float
    stress_rate: float
    raceway_rate: float
    part_rate: float
    part_strength: float
    measured: DeviationLimits | None = None
    maker: MakerFits | None = None
    split: bool = False
    pressure_kept: float = 1.0
    thermal_cases: tuple[ThermalCase, ...] = (ThermalCase("mounting", 0.0, 0.0),)
    short_shares: tuple[float, float] = (0.01, 0.05)
    runs_on_needles: bool = False
    cup_classes: tuple[str, ...] = ()
    usual_growth: float = 0.0
    light_alloy: bool = False
    warmth_assumed: bool = False
    load_assumed: bool = False

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
        return replace(self, tolerance_class=tolerance_class, measured=None)

    @property
    def fit_name(self) -> str:
        """The tolerance class, or that the limits are measured."""
        return MEASURED if self.measured else self.tolerance_class

    @property
    def class_text(self) -> str:
        """The tolerance class in a sentence."""
        return f"the measured {self.seat}" if self.measured else self.tolerance_class

    @cached_property
    def part(self) -> DeviationLimits:
        """Limits of the shaft or housing."""
        return self.measured or part_limits(self.seat, self.tolerance_class, self.diameter)

    @cached_property
    def male_and_female(self) -> tuple[DeviationLimits, DeviationLimits]:
        """Limits of the part inside and of the part around it."""
        return (self.part, self.ring_limits) if self.seat == "shaft" else (self.ring_limits, self.part)

    @cached_property
    def interference(self) -> Interval:
        """Theoretical interference."""
        return theoretical_interference(*self.male_and_female)

    @cached_property
    def mean(self) -> float:
        """Interference [m] of the middles of both fields."""
        male, female = self.male_and_female
        return round(male.middle - female.middle, 12)

    @cached_property
    def clearance_probability(self) -> float:
        """Probability that a pair is loose."""
        return clearance_probability(*self.male_and_female)

    @property
    def must_grip(self) -> bool:
        """True if the load turns round the ring, or may do so, and would make a loose ring creep."""
        return self.ring.load != "stationary"

    @property
    def criteria(self) -> tuple[InterferenceBound, ...]:
        """Interference that a ring under a rotating load needs by each rule, without losses.

        Empty without load or seat length.
        """
        if self.radial_load is None or self.length is None:
            return ()
        return (
            InterferenceBound(
                creep_interference(self.radial_load, self.length, self.factor), "13·F_r·k_B/b_s (Afanasiev 2015)"
            ),
            InterferenceBound(
                load_loss(self.radial_load, self.diameter, self.ring.width), "0.08·√(d·F_r/B) (bearing catalogues)"
            ),
        )

    @cached_property
    def required(self) -> InterferenceBound | None:
        """The larger of the criteria over the share of the pressure that is kept, with the losses given.

        None where there is no criterion. A gain by temperature is not counted: the machine starts cold.
        """
        if not self.criteria:
            return None
        larger = max(self.criteria, key=lambda bound: bound.value)
        return InterferenceBound(larger.value / self.pressure_kept + self.counted_losses, larger.by)

    @property
    def counted_losses(self) -> float:
        """Losses [m] that the interference must cover: those given, the thermal one of the loosest case."""
        return self.loss_by_warmth + sum(loss.amount for loss in self.losses if loss.name != TEMPERATURE)

    @property
    def loss_by_warmth(self) -> float:
        """Loss [m] in the loosest case of the temperatures given; a catalogue's row includes the usual ones."""
        return 0.0 if self._row_is_for_warmth else max(0.0, *(case.loss for case in self.thermal_cases))

    @property
    def is_lost_to_warmth(self) -> bool:
        """True if only warmth keeps the catalogue's class from holding the ring: it would in steel.

        A part of steel presses harder: grip is judged as it is here, stress as in the stiffest part.
        """
        if self.loss_by_warmth == 0 or self.maker is None:
            return False
        steel = replace(
            self, thermal_cases=(ThermalCase("mounting", 0.0, 0.0),), stress_rate=self.stress_rate / self.pressure_kept
        )
        return steel.with_class(self.maker.classes[0]).holds

    @property
    def _row_is_for_warmth(self) -> bool:
        """True if the catalogue's class stands for the usual warmth, and no temperature is given."""
        return self.warmth_assumed and self.maker is not None

    @property
    def loosens_hot(self) -> bool:
        """True if a class for usual warmth leaves the mean interference below what is required when hot."""
        if not (self._row_is_for_warmth and self.must_grip) or self.required is None:
            return False
        return self.mean - max(case.loss for case in self.thermal_cases) < self.required.value <= self.mean

    @cached_property
    def catalogue_class(self) -> str | None:
        """The catalogue's class for this seat: of its row; on a hollow shaft the one whose mean interference is nearest
        to that of the row's class over the share of the pressure that is kept.

        None where no row is known, where a housing keeps too little of the pressure for any row, and where no class
        makes up for the hollow shaft. Source of the rule for hollow shafts: SKF General Catalogue, 2006.
        """
        if self.maker is None:
            return None
        own = self.maker.classes[0]
        if self.seat == "housing" and self.must_grip and self.pressure_kept < THINNEST:
            return None
        if self.seat == "housing" or not self.must_grip or self.pressure_kept >= _SOLID:
            return own
        grade = int(_GRADES.sub("", own))
        wanted = self.with_class(own).mean / self.pressure_kept
        near = [name for name in tolerance_classes(self.seat) if int(_GRADES.sub("", name)) in (grade, grade + 1)]
        nearest = min(near, key=lambda name: (abs(self.with_class(name).mean - wanted), int(_GRADES.sub("", name))))
        return nearest if self.with_class(nearest).mean >= _NEAR * wanted else None

    @cached_property
    def demand(self) -> InterferenceBound | None:
        """Interference that the specified rule demands of every pair; None where no rule is known.

        That is the required interference. Where a catalogue's row is known, its experience limits it: no more than 999
        of 1000 pairs of its class have, with the losses given. The growth by an ordinary speed is none of these.
        """
        if self.required is None or self.catalogue_class is None:
            return self.required
        listed = self.with_class(self.catalogue_class)
        male, female = listed.male_and_female
        sigma = math.hypot(male.tolerance, female.tolerance) / 6
        sure = listed.mean - _SURE * sigma + self.counted_losses - self.usual_growth
        if sure >= self.required.value:
            return self.required
        return InterferenceBound(
            sure, f"the catalogue's class {self.catalogue_class}, of which 999 of 1000 pairs have it"
        )

    @cached_property
    def short_pairs(self) -> float | None:
        """Share of pairs with less interference than the specified rule demands; None where that is not known."""
        if not self.must_grip or self.demand is None:
            return None
        return probability_below(self.demand.value, *self.male_and_female)

    @property
    def short_grade(self) -> Grade:
        """Grade of the share of short pairs."""
        if not self.must_grip:
            return "pass"
        if self.short_pairs is None:
            return "not-done"
        warn, fail = self.short_shares
        if self.short_pairs <= warn:
            return "pass"
        return "fail" if self.short_pairs > fail and not self.load_assumed else "warn"

    @property
    def coldest(self) -> ThermalCase:
        """The case with the lowest temperature; that of mounting unless one is lower."""
        return min(self.thermal_cases, key=lambda case: case.rise or 0.0)

    @property
    def hottest(self) -> ThermalCase:
        """The case with the highest temperature; one that gives differences alone is at work."""
        return max(self.thermal_cases, key=lambda case: math.inf if case.rise is None else case.rise)

    def at(self, case: ThermalCase) -> "Joint":
        """The joint with the loss of a case in place of that at work."""
        others = tuple(loss for loss in self.losses if loss.name != TEMPERATURE)
        return replace(self, losses=(*others, Loss(name=TEMPERATURE, amount=case.loss, formula="")))

    @property
    def coldest_or_hottest(self) -> ThermalCase:
        """The case in which the seat is tightest."""
        return min(self.thermal_cases, key=lambda case: case.loss)

    @property
    def interference_by_temperature(self) -> tuple[ThermalInterference, ...]:
        """Interference in each temperature case."""
        low, high = self.interference
        return tuple(
            ThermalInterference(case=case.name, rise=case.rise, interference=(low - case.loss, high - case.loss))
            for case in self.thermal_cases
        )

    @property
    def turns_tight(self) -> bool:
        """True if a ring that needs no interference is loose at mounting, and tight in some temperature case."""
        if self.must_grip or self.runs_on_needles:
            return False
        return self.loose_share() >= LOOSE_ENOUGH > self.loose_share(self.coldest_or_hottest.loss)

    def loose_share(self, loss: float = 0.0) -> float:
        """Share of pairs that are loose when the interference has lost some [m]."""
        return probability_below(loss, *self.male_and_female)

    @cached_property
    def stress_limit(self) -> InterferenceBound:
        """Largest interference that the ring and the part bear, by their hoop stresses."""
        ring = InterferenceBound(PERMITTED_RING_STRESS / self.stress_rate, "hoop stress 400 MPa of the ring (Lamé)")
        strength = f"{self.part_strength / 1e6:.0f} MPa"
        part = InterferenceBound(
            self.part_strength / self.part_rate, f"hoop stress {strength} of the {self.seat} (Lamé)"
        )
        lower = min(ring, part, key=lambda bound: bound.value)
        return lower if self._of_cup is None else max(lower, self._of_cup, key=lambda bound: bound.value)

    @cached_property
    def _of_cup(self) -> InterferenceBound | None:
        """Largest interference of the makers' classes for a drawn cup, whose thin shell they press by intent."""
        if not self.cup_classes:
            return None
        most = max(self.with_class(name).interference.largest for name in self.cup_classes)
        return InterferenceBound(most, f"the makers' {' and '.join(self.cup_classes)} for drawn cups")

    @property
    def permitted(self) -> InterferenceBound:
        """The stress limit, or the d/1000 of the catalogues where that is less."""
        catalogue = InterferenceBound(self.diameter / 1000, "d/1000 (bearing catalogues)")
        return self._of_cup or min(self.stress_limit, catalogue, key=lambda bound: bound.value)

    @property
    def tightest(self) -> float:
        """The largest interference [m] of cold and of warm parts."""
        return self.interference.largest - min(0.0, self.coldest_or_hottest.loss)

    @property
    def hoop_stress(self) -> float:
        """Hoop stress [Pa] of the ring at the largest theoretical interference."""
        return self.stress_rate * max(self.tightest, 0.0)

    @property
    def part_stress(self) -> float:
        """Hoop stress [Pa] of the shaft or housing at the largest theoretical interference."""
        return self.part_rate * max(self.tightest, 0.0)

    @cached_property
    def short(self) -> float | None:
        """Share of pairs with less interference than the ring needs; None where that is not known."""
        return None if self.required is None else probability_below(self.required.value, *self.male_and_female)

    @cached_property
    def grip(self) -> Grade:
        """Grade of the interference: pass by the loosest pair, warn by the mean, else fail; not-done without a load.

        The catalogue's own class passes as long as few pairs are short of what it gives: the maker specifies it so. A
        ring that turns against its load and is loose in most pairs at a temperature given holds no load at all.
        """
        if not self.must_grip:
            return "pass"
        if self.ring.load == "rotating" and self.mean < self.loss_by_warmth:
            return "fail"
        if self.required is None:
            return "not-done"
        if self.loosens_hot:
            return "warn"
        if self.interference.smallest >= self.required.value:
            return "pass"
        if self._as_the_catalogue_has_it:
            return "pass" if self.short_grade == "pass" else "warn"
        return "warn" if self.mean >= self.required.value or self.load_assumed else "fail"

    @property
    def _as_the_catalogue_has_it(self) -> bool:
        if self.catalogue_class is None or self.short_grade == "fail":
            return False
        return self.mean >= self.with_class(self.catalogue_class).mean

    @property
    def stress(self) -> Grade:
        """Grade of the tightest pair: fail by stress, warn above d/1000 and above the catalogue's own class."""
        if self.tightest > self.stress_limit.value:
            return "fail"
        listed = self.catalogue_class or (self.maker.classes[0] if self.maker else None)
        own = listed is not None and self.tightest <= self.with_class(listed).tightest
        return "pass" if own or self.tightest <= self.permitted.value else "warn"

    @property
    def pinched(self) -> bool:
        """True if the halves of a split housing pinch the ring: a fit tighter than J."""
        name = MEASURED if self.measured else self.tolerance_class
        return self.split and self.interference.largest > 0 and name[0] not in _FOR_HALVES

    @property
    def holds(self) -> bool:
        """True if neither interference, short pairs nor stress fail, and no split housing pinches the ring."""
        return "fail" not in (self.grip, self.short_grade, self.stress) and not self.pinched

    @property
    def lasting_losses(self) -> float:
        """Losses [m] that are there when the shaft starts to turn: all but the growth by speed and gains by warmth."""
        return sum(max(loss.amount, 0.0) for loss in self.losses if loss.name != CENTRIFUGAL)

    @property
    def mounted_losses(self) -> float:
        """Interference [m] that smoothing and thermal effects take, or give, before the shaft turns."""
        return sum(loss.amount for loss in self.losses if loss.name != CENTRIFUGAL)
