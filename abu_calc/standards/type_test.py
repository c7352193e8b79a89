"""Type test of a hand-held grinder: test wheels by diameter, factor for automatic balancing, uncertainty K.

The facts are from a secondary source, those of K unverified; results say so.
"""

from functools import cache

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import to_si
from abu_calc.foundation.validity import Range
from abu_calc.standards.tables import toml_table


@dataclass(frozen=True)
class TestWheel:
    """A test wheel of aluminium [SI]: diameter, imbalance [kg m], feed force [N] if it is known, source."""

    __test__ = False  # not a test of pytest

    diameter: float
    imbalance: float
    feed_force: float | None
    source: str
    status: str


@cache
def test_wheels() -> tuple[TestWheel, ...]:
    """The test wheels by diameter, smallest first: rows of ISO 28927-4:2010 (secondary), and wheels by a rule.

    The rule is U = 2.88e-3·D² g·mm, D in mm. It holds the rows from 80 to 200 mm within 3 %.

    >>> [round(1e6 * wheel.imbalance, 1) for wheel in test_wheels()]
    [3.6, 14.5, 18.0, 29.0, 38.1, 45.0, 65.0, 93.3, 115.0, 152.4]
    """
    table = toml_table("test_wheels")
    rule, origin = table["rule"], (table["source"], table["status"])

    def wheel(diameter: float, imbalance: float, force: float | None, source: str, status: str) -> TestWheel:
        return TestWheel(to_si(diameter, "mm"), to_si(imbalance, "g_mm"), force, source, status)

    wheels = [wheel(diameter, imbalance, float(force), *origin) for diameter, imbalance, force in table["rows"]]
    wheels += [wheel(d, rule["factor"] * d**2, None, rule["source"], rule["status"]) for d in rule["diameters"]]
    return tuple(sorted(wheels, key=lambda each: each.diameter))


def test_wheel(diameter: float) -> TestWheel | None:
    """The test wheel of a diameter [m]; None for a diameter that neither table nor rule has.

    >>> test_wheel(0.150).feed_force, test_wheel(0.178)
    (30.0, None)
    """
    return next((wheel for wheel in test_wheels() if abs(wheel.diameter - diameter) < 1e-6), None)


test_wheel.__test__ = test_wheels.__test__ = False  # type: ignore[attr-defined]


def uncertainty_source() -> tuple[str, str]:
    """The source of K, and its status."""
    table = toml_table("test_wheels")["uncertainty"]
    return table["source"], table["status"]


def usual_orientations() -> int:
    """Number of orientations of the test wheel on the spindle, evenly spaced. Source: ISO 28927-4:2010, secondary."""
    return int(toml_table("test_wheels")["orientations"])


def balancing_factor() -> float:
    """The declared value of a machine that balances itself over the measured one. Source: ISO 28927-4:2010, secondary.

    >>> balancing_factor()
    1.3
    """
    return float(toml_table("test_wheels")["balancing_factor"])


@dataclass(frozen=True)
class SeriesRules:
    """Runs in a series, operators, and the spread up to which a series counts (deviation in m/s²)."""

    runs: int
    operators: int
    variation: float
    deviation: float


@cache
def series_rules() -> SeriesRules:
    """Rules of a whole type test. Source: ISO 28927 series, unverified."""
    table = toml_table("test_wheels")["series"]
    return SeriesRules(table["runs"], table["operators"], table["variation"], table["deviation"])


_DECLARED = Range("declared value", 0.0, 1e4, "m/s²")
_DEVIATION = Range("standard deviation", 0.0, 1e4, "m/s²")


@formula(
    "Standard deviation of reproducibility of a declared vibration value",
    "s_R = max(s_m, 0.06·a_hd + 0.3)",
    "m/s²",
    checked=(_DECLARED, _DEVIATION),
    where="s_m is 0 if nothing was measured.",
    source="EN 12096:1997, unverified",
)
def reproducibility(declared: float, measured: float = 0.0) -> float:
    """
    >>> round(reproducibility(1.45775), 4), reproducibility(1.0, 0.5)
    (0.3875, 0.5)
    """
    rule = toml_table("test_wheels")["uncertainty"]
    return max(_DEVIATION.check(measured), float(rule["slope"]) * _DECLARED.check(declared) + float(rule["constant"]))


@formula(
    "Uncertainty of a declared vibration value",
    "K_d = 1.65·s_R",
    "m/s²",
    where="Two declared values that differ by less than K cannot be told apart.",
    source="EN 12096:1997, unverified",
)
def declared_uncertainty(reproducibility: float) -> float:
    """
    >>> round(declared_uncertainty(reproducibility(1.45775)), 3)
    0.639
    """
    return float(toml_table("test_wheels")["uncertainty"]["coverage"]) * reproducibility
