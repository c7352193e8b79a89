"""Theoretical and probable interference of two toleranced parts, and the probability of clearance.

`of_all` writes a probability in the words of a shop.

Interference that a ring needs so as not to creep, and its losses in service.
"""

import math
from collections.abc import Mapping
from typing import ClassVar, Final, NamedTuple, TypeAlias

from abu_calc.features.seats.bearing import RADIAL_LOAD, RING_SPEED, ROUGHNESS, SEAT_DIAMETER, SEAT_LENGTH
from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Record, record
from abu_calc.foundation.units import from_si, to_si
from abu_calc.standards.balls import Material
from abu_calc.standards.bearing_catalogue import Series
from abu_calc.standards.tolerance_classes import DeviationLimits


def of_all(probability: float, things: str = "pairs") -> str:
    """A share of pairs or bearings, as one would count them.

    >>> [of_all(p) for p in (0.0, 2e-6, 0.0031, 0.554)]
    ['no pairs', '2 of a million pairs', '3 of 1000 pairs', '55 of 100 pairs']
    >>> [of_all(p, "bearings") for p in (1e-12, 0.99996, 1.0)]
    ['under 1 of a million bearings', 'all but 40 of a million bearings', 'all bearings']
    """
    if probability in (0.0, 1.0):
        return f"{'all' if probability else 'no'} {things}"
    if probability > 0.995:
        return f"nearly all {things}" if 1 - probability < 1e-6 else f"all but {of_all(1 - probability, things)}"
    if probability < 1e-6:
        return f"under 1 of a million {things}"
    for total, name, least in ((100, "100", 5), (1000, "1000", 1), (10_000, "10000", 1)):
        if round(probability * total) >= least:
            return f"{round(probability * total)} of {name} {things}"
    return f"{round(probability * 1e6)} of a million {things}"


_INSIDE = math.erf(3 / math.sqrt(2))
"""Share of a normal law within 3σ of its mean."""

_PANELS = 200


Pair: TypeAlias = tuple[float, float]
"""Lower and upper, or least and most."""


@record
class SeatRecord(Record):
    """Part of a seat: lengths in micrometres freed of the rounding of the conversion."""

    decimals: ClassVar[Mapping[str, int]] = {"um": 6}


def um(length: float) -> float:
    """Micrometres, freed of the rounding of the conversion."""
    return round(from_si(length, "um"), 6)


def um_pair(pair: Pair) -> Pair:
    """Limits or an interval in micrometres."""
    return um(pair[0]), um(pair[1])


class Interval(NamedTuple):
    """Smallest and largest of a quantity [m]; interference is positive when tight."""

    smallest: float
    largest: float


@formula(
    "Interference between the extreme sizes",
    "ei − ES … es − EI",
    "m",
    shown="um",
    assumed="both limits refer to one nominal size",
    source="ISO 286-1:2010",
)
def theoretical_interference(male: DeviationLimits, female: DeviationLimits) -> Interval:
    """
    >>> theoretical_interference(DeviationLimits(2e-6, 21e-6), DeviationLimits(-15e-6, 0.0))
    Interval(smallest=2e-06, largest=3.6e-05)
    """
    return Interval(_exact(male.lower - female.upper), _exact(male.upper - female.lower))


@formula(
    "Probable interference",
    "mean ∓ √((T₁/2)² + (T₂/2)²), rounded outward to whole micrometres",
    "m",
    shown="um",
    assumed="independent parts, sizes centred in their tolerance zones",
    source="the bearing makers' tables of probable interference",
)
def probable_interference(male: DeviationLimits, female: DeviationLimits) -> Interval:
    """
    >>> probable_interference(DeviationLimits(2e-6, 18e-6), DeviationLimits(-12e-6, 0.0))
    Interval(smallest=6e-06, largest=2.6e-05)
    """
    mean, half = _mean(male, female), _half_field(male, female)
    lower, upper = math.floor(um(mean - half)), math.ceil(um(mean + half))
    return Interval(to_si(lower, "um"), to_si(upper, "um"))


@formula(
    "Probability that a pair has clearance",
    "Φ(−mean/σ), σ = √((T₁/2)² + (T₂/2)²)/3",
    "1",
    where="A clearance of zero counts as interference. The result is exact in this model, tails included.",
    assumed="both sizes independent, normal, centred in their tolerance zones; half a zone = 3σ",
    source="normal law",
)
def clearance_probability(male: DeviationLimits, female: DeviationLimits) -> float:
    """
    >>> round(clearance_probability(DeviationLimits(-18e-6, 0.0), DeviationLimits(-28e-6, 12e-6)), 3)
    0.554
    """
    return probability_below(0.0, male, female)


def probability_below(interference: float, male: DeviationLimits, female: DeviationLimits) -> float:
    """Probability that a pair has less than an interference [m]; model and source as for `clearance_probability`."""
    mean, sigma = _mean(male, female) - interference, _half_field(male, female) / 3
    if sigma == 0:
        return 1.0 if mean < 0 else 0.0
    return 0.5 * math.erfc(mean / (sigma * math.sqrt(2)))


@formula(
    "Probability that a pair has clearance if every part outside its tolerance zone is rejected",
    "∫ p_m(x_s)·P_f(x_s) dx_s",
    "1",
    where=(
        "Both sizes follow normal laws, cut at the limits and scaled to 1. If the zones do not overlap, the result is "
        "exactly 0 or 1. If they overlap, Simpson's rule over the common part gives it to 1e-8."
    ),
    assumed="both sizes independent",
    source="truncated normal law",
)
def truncated_clearance_probability(male: DeviationLimits, female: DeviationLimits) -> float:
    """
    >>> round(truncated_clearance_probability(DeviationLimits(-18e-6, 0.0), DeviationLimits(-28e-6, 12e-6)), 4)
    0.5546
    """
    # A male below the female's field is loose for certain, above it tight for certain.
    loose, low, high = _share_below(female.lower, male), max(male.lower, female.lower), min(male.upper, female.upper)
    if not male.tolerance:
        return 1 - _share_below(male.lower, female) if female.tolerance else clearance_probability(male, female)
    if low >= high or not female.tolerance:
        return loose
    step = (high - low) / _PANELS
    values = [_density(low + i * step, male) * (1 - _share_below(low + i * step, female)) for i in range(_PANELS + 1)]
    return loose + step / 3 * (values[0] + values[-1] + 4 * sum(values[1:-1:2]) + 2 * sum(values[2:-1:2]))


def _share_below(size: float, field: DeviationLimits) -> float:
    """Share of parts below a size, of those inside their field."""
    if size <= field.lower:
        return 0.0
    if size >= field.upper:
        return 1.0
    return 0.5 + 0.5 * math.erf((size - field.middle) / (field.tolerance / 6) / math.sqrt(2)) / _INSIDE


def _density(size: float, field: DeviationLimits) -> float:
    sigma = field.tolerance / 6
    return math.exp(-(((size - field.middle) / sigma) ** 2) / 2) / (sigma * math.sqrt(2 * math.pi)) / _INSIDE


def _mean(male: DeviationLimits, female: DeviationLimits) -> float:
    return male.middle - female.middle


def _half_field(male: DeviationLimits, female: DeviationLimits) -> float:
    return math.hypot(male.tolerance / 2, female.tolerance / 2)


def _exact(metres: float) -> float:
    # sums of tabulated half micrometres, freed of the noise of binary fractions
    return round(metres, 12)


SERIES_FACTORS: Final[dict[Series, float]] = {"light": 2.8, "medium": 2.3, "heavy": 2.0}
"""k of `creep_interference` by series: handbook values quoted by Afanasiev 2015, unverified."""


@formula(
    "Least interference that keeps a ring under a rotating load from creeping",
    "δ_min = 13·(F_r/1000)·k_B/b_s",
    "µm",
    where="δ_min is in µm, F_r in N, b_s in mm. The program computes in SI.",
    checked=(RADIAL_LOAD, SEAT_LENGTH),
    source="Afanasiev 2015",
    published="13·F_r·k_B/(10⁶·b_s) with F_r in kN and b_s in m, which gives millimetres, labelled µm",
    own_units=True,
)
def creep_interference(load: float, seat_length: float, factor: float) -> float:
    """
    >>> round(1e6 * creep_interference(3000.0, 29e-3, 2.8), 4)
    3.7655
    """
    return 13e-12 * RADIAL_LOAD.check(load) * factor / SEAT_LENGTH.check(seat_length)


@formula(
    "Interference lost under a radial load",
    "0.08·√(d·F_r/B)",
    "µm",
    where="The loss is in µm, with F_r in N, d and B in one unit. The program computes in SI.",
    checked=(RADIAL_LOAD, SEAT_DIAMETER, SEAT_LENGTH),
    assumed=(
        "F_r up to a quarter of the static load rating (beyond it catalogues use 0.02·F_r/B); inner rings on solid "
        "shafts; applied to outer rings, too"
    ),
    source="bearing makers' catalogues",
    own_units=True,
)
def load_loss(load: float, diameter: float, width: float) -> float:
    """
    >>> round(1e6 * load_loss(3000.0, 0.080, 0.033), 2)
    6.82
    """
    return 8e-8 * math.sqrt(SEAT_DIAMETER.check(diameter) * RADIAL_LOAD.check(load) / SEAT_LENGTH.check(width))


@formula(
    "Interference lost as one surface becomes smooth",
    "0.4·Rz",
    "m",
    shown="um",
    checked=(ROUGHNESS,),
    assumed="turned or ground steel",
    source="DIN 7190-1:2017",
)
def smoothing_loss(roughness: float) -> float:
    """
    >>> round(1e6 * smoothing_loss(4e-6), 3)
    1.6
    """
    return 0.4 * ROUGHNESS.check(roughness)


@formula(
    "Interference lost by smoothing, according to catalogues",
    "δ·2/(d + 2), d in mm",
    "m",
    shown="um",
    where=(
        "Catalogues leave d/(d + 2) of the apparent interference of a ground shaft, and d/(d + 3) of a turned one. A "
        "clearance loses nothing. This loss is unverified, shown beside the smoothing loss, and counts nowhere."
    ),
    checked=(SEAT_DIAMETER,),
    source="bearing makers' catalogues",
    own_units=True,
)
def catalogue_smoothing_loss(interference: float, diameter: float) -> float:
    """
    >>> round(1e6 * catalogue_smoothing_loss(41e-6, 0.080), 6)
    1.0
    """
    return max(interference, 0.0) * 2e-3 / (SEAT_DIAMETER.check(diameter) + 2e-3)


@formula(
    "Interference lost by thermal expansion",
    "d·(α₂·ΔT₂ − α₁·ΔT₁)",
    "m",
    shown="um",
    where=(
        "If both coefficients are α, the loss is α·d times the difference of the temperature rises. It is negative if "
        "the seat becomes tighter. If only the rise of the bearing over its surroundings is known, catalogues take "
        "an eighth of it as the rise of the inner ring over its shaft (their 0.0015·d·ΔT µm, d in mm)."
    ),
    checked=(SEAT_DIAMETER,),
    assumed="uniform temperature of each part",
    source="linear expansion",
)
def temperature_loss(diameter: float, around: tuple[float, float], inside: tuple[float, float]) -> float:
    """
    >>> round(1e6 * temperature_loss(0.080, (12e-6, 10.0), (12e-6, 0.0)), 2)
    9.6
    """
    (expansion, rise), (expansion_inside, rise_inside) = around, inside
    return SEAT_DIAMETER.check(diameter) * (expansion * rise - expansion_inside * rise_inside)


@formula(
    "Interference lost because the spinning ring grows more than its shaft",
    "(3+ν)·ρ·Ω²·d·(d₁² − d₀²)/(16·E)",
    "m",
    shown="um",
    where=(
        "Ring and shaft have the same ρ, E and ν. The loss is the difference between the free growths of two annular "
        "discs at their common diameter. The terms (1−ν) of both cancel."
    ),
    checked=(RING_SPEED,),
    assumed="plane stress, elastic; the load of rollers or balls left out",
    source="rotating disc (Timoshenko)",
)
def centrifugal_loss(
    speed: float, diameter: float, ring_diameter: float, shaft_bore: float, material: Material
) -> float:
    """
    >>> steel = Material("steel", 7800.0, 206e9, 0.3, 12e-6)
    >>> round(1e6 * centrifugal_loss(2094.4, 0.017, 0.0234, 0.0, steel), 3)
    0.319
    """
    growth = (
        (3 + material.poisson_ratio) * material.density * RING_SPEED.check(speed) ** 2 / (16 * material.youngs_modulus)
    )
    return growth * diameter * (ring_diameter**2 - shaft_bore**2)
