"""Vibration of hand-held machines: limits by octaves, weighting by frequency, exposure, hands, balance grades.

The hand is a mechanical system, as data; `formulas.suspension` says how its elements connect.

Type test of a hand-held grinder: test wheels by diameter, factor for automatic balancing, uncertainty K.

The facts are from a secondary source, those of K unverified; results say so.
"""

import math
import re
from functools import cache
from typing import Annotated, Any

from abu_calc.foundation.errors import RangeError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import shown, to_si
from abu_calc.foundation.validity import Range
from abu_calc.standards.tables import toml_table, unknown


@dataclass(frozen=True)
class Limit:
    """A limit of vibration: rms velocity [m/s] and its level [dB re 5e-8 m/s], as the standard rounds them."""

    velocity: float
    level: float


@dataclass(frozen=True)
class Octave:
    """An octave from `low` up to, not including, `high` about its `centre` [rad/s].

    `nominal`: the centre as printed [Hz]; `share`: of its velocity in the corrected total.
    """

    nominal: float
    centre: float
    low: float
    high: float
    limit: Limit
    share: float


@dataclass(frozen=True)
class ThirdOctave:
    """A third octave from `low` up to, not including, `high` about its `centre` [rad/s], and its factor W_h.

    `nominal`: the centre as printed [Hz].
    """

    nominal: float
    centre: float
    weight: float
    low: float
    high: float


@cache
def octaves() -> tuple[Octave, ...]:
    """The octaves 8 … 1000 Hz with their limits. Sources: IEC 61260-1:2014 (bands), GOST 17770-86 (limits)."""
    ratio, bands = toml_table("octave_bands")["ratio"], []
    rows = toml_table("vibration_limits")["octaves"]
    lowest = min(velocity for _, _, velocity, _ in rows)
    for nominal, k, velocity, level in rows:
        centre = to_si(1000 * ratio**k, "hz")
        edges = centre / math.sqrt(ratio), centre * math.sqrt(ratio)
        bands.append(Octave(nominal, centre, *edges, Limit(velocity, level), lowest / velocity))
    return tuple(bands)


def octave(frequency: float) -> Octave:
    """The octave that a frequency [rad/s] lies in, with the limit there.

    Range: 5.62 … 1413 Hz, else RangeError. Sources: IEC 61260-1:2014 (bands), GOST 17770-86 (limits).

    >>> found = octave(5800 * math.pi / 30)
    >>> found.nominal, round(found.low / math.tau, 1), found.limit.level
    (125, 89.1, 109)
    """
    for band in octaves():
        if band.low <= frequency < band.high:
            return band
    raise RangeError(
        "no octave of the standard holds this frequency",
        found=shown(frequency, "hz", "g"),
        allowed=shown((octaves()[0].low, octaves()[-1].high), "hz", ".4g"),
        remedy="The standard says nothing outside; judge such a frequency by other means.",
    )


def corrected_limit() -> Limit:
    """The limit of the corrected total over all octaves. Source: GOST 17770-86.

    >>> corrected_limit()
    Limit(velocity=0.02, level=112)
    """
    return Limit(**toml_table("vibration_limits")["corrected"])


@cache
def third_octaves() -> tuple[ThirdOctave, ...]:
    """The third octaves 6.3 … 1250 Hz with W_h: three to each octave.

    Sources: IEC 61260-1:2014 (centres 10^(n/10) Hz, edges a factor 10^(1/20) away), ISO 5349-1:2001, table A.2 (W_h).

    >>> band = third_octaves()[12]
    >>> band.nominal, round(band.low / math.tau, 2), round(band.high / math.tau, 2)
    (100, 89.13, 112.2)
    """
    half = toml_table("octave_bands")["ratio"] ** (1 / 6)
    bands = []
    for nominal, n, weight in toml_table("hand_arm_weighting")["bands"]:
        centre = to_si(10 ** (n / 10), "hz")
        bands.append(ThirdOctave(nominal, centre, weight, centre / half, centre * half))
    return tuple(bands)


@formula(
    "Weighting of hand-transmitted accelerations by frequency",
    "W_h = ξ²ω_b²/((ξ²+ξω_a/Q_a+ω_a²)(ξ²+ξω_b/Q_a+ω_b²)) · (ξ+ω_c)ω_c/(ξ²+ξω_c/Q_c+ω_c²)",
    "1",
    where="Table A.2 of the standard agrees within 1 %.",
    source="ISO 5349-1:2001, annex A",
)
def hand_arm_response(s: Any) -> Any:
    """Response at `s`, for numbers and arrays alike.

    >>> round(abs(hand_arm_response(5800j * math.pi / 30)), 4)
    0.1658
    """
    bend, knee = _filter()["f3"], _filter()["q2"]
    return band_limits(s) * (s + bend) * bend / (s * s + bend * s / knee + bend**2)


def band_limits(s: Any) -> Any:
    """The first factor of W_h: what an instrument lets through without weighting, s = iω [rad/s], arrays too.

    Source: ISO 5349-1:2001, annex A.
    """
    high, band = _filter()["f2"], _filter()["q1"]
    return high_pass(s) * high**2 / (s * s + high * s / band + high**2)


def high_pass(s: Any) -> Any:
    """The lower of the band limits alone, likewise."""
    low, band = _filter()["f1"], _filter()["q1"]
    return s * s / (s * s + low * s / band + low**2)


@cache
def _filter() -> dict[str, float]:
    """Frequencies [rad/s] and qualities of the filter."""
    given = toml_table("hand_arm_weighting")["filter"]
    return {name: to_si(value, "hz") if name.startswith("f") else value for name, value in given.items()}


def hand_arm_weight(frequency: float) -> float:
    """The factor |W_h| by which an rms acceleration at a frequency [rad/s] counts.

    Range: 5.62 … 1413 Hz, the third octaves of the table, else RangeError. Source: ISO 5349-1:2001, annex A.

    >>> round(hand_arm_weight(16 * math.tau), 2)
    0.89
    """
    bands, half = third_octaves(), 10**0.05
    low, high = bands[0].centre / half, bands[-1].centre * half
    if not low <= frequency <= high:
        raise RangeError(
            "W_h is not defined at this frequency",
            found=shown(frequency, "hz", "g"),
            allowed=shown((low, high), "hz", ".4g"),
            remedy="Give the acceleration without weighting.",
        )
    return float(abs(hand_arm_response(1j * frequency)))


def exposure_action_value() -> float:
    """Daily exposure A(8) [m/s²] that calls for measures. Source: Directive 2002/44/EC."""
    return float(toml_table("hand_arm_weighting")["exposure"]["action"])


def exposure_limit_value() -> float:
    """Daily exposure A(8) [m/s²] not to be exceeded. Source: Directive 2002/44/EC."""
    return float(toml_table("hand_arm_weighting")["exposure"]["limit"])


def largest_total_of_one_axis() -> float:
    """The vector total of three axes is at most so many times one axis, the largest. Source: ISO 5349-1:2001, 4.5."""
    return float(toml_table("hand_arm_weighting")["largest_total_of_one_axis"])


WORKING_DAY = 8 * 3600.0
"""T₀ [s] of ISO 5349-1:2001."""


@formula(
    "Daily exposure to hand-transmitted vibration",
    "A(8) = a_hv·√(t_d/t₀)",
    "m/s²",
    source="ISO 5349-1:2001, equation (2)",
)
def daily_exposure(total: float, seconds: float) -> float:
    """
    >>> daily_exposure(5.0, 2 * 3600)
    2.5
    """
    return total * math.sqrt(seconds / WORKING_DAY)


_MASS = Range("rotor mass", 0.0, 1e6, "kg", open_low=True)
_SPEED = Range("rotor speed", 0.0, 1e5, "rad/s", open_low=True)


def grade_named(written: str) -> str:
    """Name of a grade that people write so.

    >>> grade_named("g 6.3")
    'G6.3'
    """
    return re.sub(r"^g\s*", "G", written, flags=re.I)


def balance_grades() -> dict[str, float]:
    """The grades by name, coarsest first, with e·Ω [m/s]. Source: ISO 21940-11:2016.

    >>> balance_grades()["G6.3"]
    0.0063
    """
    return {f"G{grade:g}": grade / 1000 for grade in toml_table("balance_grades")["grades"]}


@formula(
    "Permissible residual imbalance of a rotor",
    "U_per = G_e·m_R/Ω",
    "kg m",
    where="In other units: U_per = 9549·G_e·m_R/Ω in g·mm, with G_e in mm/s, m_R in kg and Ω in rpm.",
    checked=(_MASS, _SPEED, "a balance grade of ISO 21940-11"),
    assumed="rotors with rigid behaviour",
    source="ISO 21940-11:2016",
)
def permissible_imbalance(grade: str, mass: float, speed: float) -> float:
    """
    >>> round(1e6 * permissible_imbalance("G6.3", 2.0, 10000 * math.pi / 30), 2)
    12.03
    """
    grades, name = balance_grades(), grade_named(grade)
    if name not in grades:
        raise unknown("balance grade", grade, grades)
    return grades[name] * _MASS.check(mass) / _SPEED.check(speed)


_Four = tuple[float, float, float, float]


@dataclass(frozen=True)
class Hand:
    """One hand along one axis: m1 … m4 [kg], k1 … k4 [N/m], c1 … c4 [N·s/m]."""

    masses: _Four
    stiffness: _Four
    damping: _Four


def hand(axis: str) -> Hand:
    """One hand along x, y or z of the hand. Source: ISO 10068:2012, Annex C, model 2, table C.1.

    >>> hand("z").stiffness
    (1000.0, 12000.0, 43635.0, 174542.0)
    """
    table = toml_table("hands")
    if axis not in ("x", "y", "z"):
        raise unknown("axis of the hand", axis, ("x", "y", "z"))
    return Hand(**{key: tuple(values) for key, values in table[axis].items()})


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
