"""Theoretical and probable interference of two toleranced parts, and the probability of clearance."""

import math
from dataclasses import dataclass

from abu_calc.standards.limits import Limits
from abu_calc.units import from_si, to_si


@dataclass(frozen=True)
class Interval:
    """Smallest and largest of a quantity [m]; interference is positive when tight."""

    smallest: float
    largest: float


def theoretical_interference(male: Limits, female: Limits) -> Interval:
    """Interference [m] between the extreme sizes: ei − ES … es − EI.

    `male` is the part inside (shaft, or outer ring), `female` the part around it (inner ring, or housing).
    Range: any limits about one nominal size. Source: ISO 286-1:2010.

    >>> theoretical_interference(Limits(2e-6, 21e-6), Limits(-15e-6, 0.0))
    Interval(smallest=2e-06, largest=3.6e-05)
    """
    return Interval(_exact(male.lower - female.upper), _exact(male.upper - female.lower))


def probable_interference(male: Limits, female: Limits) -> Interval:
    """Interference [m] to expect: mean ∓ √((T₁/2)² + (T₂/2)²), rounded outward to whole micrometres.

    Range: independent parts, fields centred. Source: the bearing makers' tables of probable interference.

    >>> probable_interference(Limits(2e-6, 18e-6), Limits(-12e-6, 0.0))
    Interval(smallest=6e-06, largest=2.6e-05)
    """
    mean, half = _mean(male, female), _half_field(male, female)
    lower = math.floor(round(from_si(mean - half, "um"), 6))
    upper = math.ceil(round(from_si(mean + half, "um"), 6))
    return Interval(to_si(lower, "um"), to_si(upper, "um"))


def clearance_probability(male: Limits, female: Limits) -> float:
    """Probability that a pair is loose: Φ(−mean/σ), σ = √((T₁/2)² + (T₂/2)²)/3.

    Range: both sizes independent, normal, centred in their fields, half a field = 3σ; a clearance of zero counts as
    tight. Exact in that model, tails included. Source: normal law.

    >>> round(clearance_probability(Limits(-18e-6, 0.0), Limits(-28e-6, 12e-6)), 3)
    0.554
    """
    mean, sigma = _mean(male, female), _half_field(male, female) / 3
    if sigma == 0:
        return 1.0 if mean < 0 else 0.0
    return 0.5 * math.erfc(mean / (sigma * math.sqrt(2)))


def _mean(male: Limits, female: Limits) -> float:
    return male.middle - female.middle


def _half_field(male: Limits, female: Limits) -> float:
    return math.hypot(male.tolerance / 2, female.tolerance / 2)


def _exact(metres: float) -> float:
    # sums of tabulated half micrometres, freed of the noise of binary fractions
    return round(metres, 12)
