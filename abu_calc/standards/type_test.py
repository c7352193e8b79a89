"""Type test of a hand-held grinder: test wheels by diameter, factor for automatic balancing, uncertainty K.

The facts are from a secondary source, those of K unverified; results say so.
"""

from functools import cache
from typing import Annotated

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import to_si
from abu_calc.foundation.validity import Range
from abu_calc.standards.tables import toml_table


@record
class TestWheel(Record):
    """The test wheel; no diameter and no feed force if the file gives an imbalance alone."""

    __test__ = False  # not a test of pytest
    schema_title = "TestWheelRecord"

    diameter: Annotated[float | None, Quantity("diameter", unit="mm")]
    imbalance: Annotated[float, Quantity("imbalance", "U", unit="g_mm")]
    feed_force: Annotated[float | None, Quantity("feed force of the standard", "", 3, unit="N")]
    source: Annotated[str, Quantity("source")]
    status: Annotated[str, Quantity("status of the source", "", 4, "secondary, or given")]


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
        return TestWheel(
            diameter=to_si(diameter, "mm"), imbalance=to_si(imbalance, "g_mm"), feed_force=force, source=source,
            status=status,
        )  # fmt: skip

    wheels = [wheel(diameter, imbalance, float(force), *origin) for diameter, imbalance, force in table["rows"]]
    wheels += [wheel(d, rule["factor"] * d**2, None, rule["source"], rule["status"]) for d in rule["diameters"]]
    return tuple(sorted(wheels, key=lambda each: each.diameter or 0.0))


def test_wheel(diameter: float) -> TestWheel | None:
    """The test wheel of a diameter [m]; None for a diameter that neither table nor rule has.

    >>> test_wheel(0.150).feed_force, test_wheel(0.178)
    (30.0, None)
    """
    return next((wheel for wheel in test_wheels() if abs((wheel.diameter or 0.0) - diameter) < 1e-6), None)


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
