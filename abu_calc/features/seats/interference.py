"""Theoretical and probable interference of two toleranced parts, and the probability of clearance.

`of_all` writes a probability in the words of a shop.
"""

import math
from collections.abc import Mapping
from typing import ClassVar, NamedTuple, TypeAlias

from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Record, record
from abu_calc.foundation.units import from_si, to_si
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
