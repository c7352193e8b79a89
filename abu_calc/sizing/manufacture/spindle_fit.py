"""Standard fits of bore and spindle (ISO 286), warm and at speed."""

from collections.abc import Iterator
from typing import Final

from abu_calc.foundation.errors import RangeError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.standards.tolerance_classes import DeviationLimits, part_limits

PAIRS: Final = (
    ("H8", "h7"), ("H7", "h6"), ("H6", "h5"), ("H7", "js6"), ("H6", "js5"), ("H7", "k6"), ("H6", "k5"),
    ("H7", "m6"), ("H6", "m5"), ("H7", "n6"), ("H6", "n5"), ("H7", "p6"), ("H6", "p5"), ("H7", "r6"),
)  # fmt: skip
"""Fits of a bore H and a spindle that ISO 286-1:2010 recommends, as far as both classes are tabulated here."""


@formula(
    "Eccentricity by the largest clearance of a fit",
    "(ES − ei + I_g)/2, at least 0",
    "m",
    shown="um",
    where=(
        "A transition fit may be tight or loose; its largest clearance counts. An interference fit centres. I_g is "
        "what the bore outgrows the spindle by, warm and at the highest speed."
    ),
    source="ISO 286-1:2010",
)
def fit_eccentricity(bore: DeviationLimits, spindle: DeviationLimits, growth: float = 0.0) -> float:
    """
    >>> round(1e6 * fit_eccentricity(DeviationLimits(0.0, 13e-6), DeviationLimits(-6.5e-6, 6.5e-6)), 3)
    9.75
    """
    return max(0.0, round(bore.upper - spindle.lower + growth, 12)) / 2


@dataclass(frozen=True)
class Fit:
    """A fit of bore and spindle by ISO 286: classes and limit deviations [m].

    `growth`: what the bore outgrows the spindle by in diameter, warm and at the highest speed [m].
    """

    bore_class: str
    spindle_class: str
    bore: DeviationLimits
    spindle: DeviationLimits
    growth: float = 0.0

    @property
    def eccentricity(self) -> float:
        """Half the largest clearance [m], warm and at speed."""
        return fit_eccentricity(self.bore, self.spindle, self.growth)

    @property
    def tightest(self) -> float:
        """Largest interference [m], negative if there is always clearance."""
        return round(self.spindle.upper - self.bore.lower, 12)

    @property
    def loosest(self) -> float:
        """Least interference [m], negative if there can be clearance."""
        return round(self.spindle.lower - self.bore.upper, 12)

    @property
    def named(self) -> str:
        """The fit as a drawing writes it."""
        return f"{self.bore_class}/{self.spindle_class}"


def standard_fits(bore: float, growth: float = 0.0) -> tuple[Fit, ...]:
    """Standard fits for a bore [m], the easiest to mount first; none outside the tables of ISO 286-2."""
    return tuple(sorted(_tabulated(bore, growth), key=lambda fit: (fit.tightest, -fit.eccentricity)))


def _tabulated(bore: float, growth: float) -> Iterator[Fit]:
    for hole, shaft in PAIRS:
        try:
            yield Fit(hole, shaft, part_limits("housing", hole, bore), part_limits("shaft", shaft, bore), growth)
        except RangeError:
            continue
