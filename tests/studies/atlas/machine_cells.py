"""Cells of charts about a machine: in closed form, by its type test, or at its work."""

import math
from functools import cache, partial
from typing import Final
from unittest.mock import patch

import abu_calc
from abu_calc.features.declare import study as declare_study
from abu_calc.features.declare import type_test_simulation as type_test
from abu_calc.features.declare.type_test_simulation import simulated_test
from abu_calc.foundation.units import GRAVITY
from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size as sized
from tests.studies.atlas.charts import AtlasChart
from tests.studies.atlas.recipe import FOLDER, RPM, CellValue, Recipe, Result, plain

MACHINE: Final = "machine.toml"
NORMAL_95: Final = 1.96


@cache
def _machine() -> tuple[float, float]:
    """Displacement without balls U/m₀ [mm], pitch radius over ball radius."""
    design = sized(read_machine(str(FOLDER / MACHINE)).whole("size"))
    balls = design.autobalancer
    return 1e3 * design.imbalance.value / design.case.body.mass, 2 * balls.pitch_radius / balls.ball_diameter


def _race(eccentricity: float, friction: float) -> tuple[str, str]:
    """Entries of race eccentricity and friction, both as displacements over U/m₀."""
    displaced, ratio = _machine()
    return (
        f"autobalancer.race_eccentricity_mm={eccentricity * displaced:.9g}",
        f"autobalancer.rolling_friction_mm={friction * displaced / ratio:.9g}",
    )


ACCELERATION: Final = 1.5
"""U·Ω²/(m₀·g) of the horizontal spindle."""


def _residual(chart: AtlasChart, eccentricity: float, friction: float) -> tuple[str, tuple[str, ...]]:
    axis = chart.name.removeprefix("c-")
    speed = math.sqrt(ACCELERATION * GRAVITY / (_machine()[0] * 1e-3))
    return MACHINE, (
        *_race(eccentricity, friction), f'machine.spindle_axis="{axis}"', f"machine.speed_rpm={speed * RPM:.9g}"
    )  # fmt: skip


def _declared(chart: AtlasChart, file: str, entries: tuple[str, ...], starts: int, seed: int) -> Result:
    """The command has a seed of its own, which stands for 0; another one takes its place."""
    drawn = partial(simulated_test, **({"seed": seed} if seed else {}))
    with patch.object(declare_study, "simulated_test", drawn), patch.object(type_test, "simulated_test", drawn):
        return plain(abu_calc.declare(read_machine(file, list(entries)), starts=starts))


def _starts(result: Result) -> int:
    """Starts that were simulated: none if no friction is left."""
    return result["plan"]["starts"] if result["friction_rms_mm"] else 0


def _ratio(chart: AtlasChart, result: Result) -> CellValue:
    """Mean vibration of the wheel plane with balls over that without."""
    with_, without = result["with"], result["without"]["a_hv_m_per_s2"]
    value, error = with_["a_hv_m_per_s2"] / without, NORMAL_95 * with_["standard_error_m_per_s2"] / without
    return CellValue(value, value - error, value + error, _starts(result))


def _break_even(chart: AtlasChart, friction: float, background: float) -> tuple[str, tuple[str, ...]]:
    return MACHINE, (*_race(0.25, friction), f"type_test.background_a_hv_m_per_s2={background * _bare():.9g}")


@cache
def _bare() -> float:
    """Vibration of the test wheel without balls and background [m/s²]."""
    return abu_calc.declare(read_machine(str(FOLDER / MACHINE)), starts=100).without.a_hv_m_per_s2


def _break_even_value(chart: AtlasChart, result: Result) -> CellValue:
    """The standard error of the declared value, over its slope near the break-even, gives the interval."""
    found = result["break_even_eccentricity_mm"]
    if found is None:
        return CellValue.exact(0.0, _starts(result))
    own = result["with"]["declared_m_per_s2"]
    points = sorted(
        ((each["race_eccentricity_mm"], each["declared_m_per_s2"]) for each in result["by_eccentricity"]),
        key=lambda point: abs(point[0] - found),
    )
    (near, level), (far, other) = points[0], max(points[1:4], key=lambda point: abs(point[0] - points[0][0]))
    slope = (other - level) / (far - near)
    relative = result["with"]["standard_error_m_per_s2"] / result["with"]["a_hv_m_per_s2"]
    error = NORMAL_95 * relative * own / slope if slope > 0 else found
    value, low, high = (length / _machine()[0] for length in (found, max(found - error, 0.0), found + error))
    return CellValue(value, low, high, _starts(result))


def _sized(chart: AtlasChart, file: str, entries: tuple[str, ...], starts: int, seed: int) -> Result:
    """The steps of `abu size` alone: its simulations change none of these numbers."""
    design = sized(read_machine(file, list(entries)).whole("size"))
    balls = design.autobalancer
    return {
        "imbalance_g_mm": 1e6 * design.imbalance.value,
        "autobalancer": {
            "ball_count": balls.ball_count,
            "ball_mass_g": 1e3 * balls.ball_mass,
            "pitch_radius_mm": 1e3 * balls.pitch_radius,
        },
        "accuracy_budget": {"residual_um": 1e6 * balls.budget.residual},
    }


THIN, THICK = 0.6, 40.0
"""Walls [mm] between which the wall of a race of wanted ovality is sought."""


def _oval(chart: AtlasChart, eccentricity: float, ovality: float) -> tuple[str, tuple[str, ...]]:
    return MACHINE, (*_race(eccentricity, 0.15), f"autobalancer.min_wall_mm={_wall(ovality):.9g}")


@cache
def _wall(ovality: float) -> float:
    """Wall [mm] with which the balls make the race so oval."""
    low, high = THIN, THICK
    for _ in range(50):
        middle = math.sqrt(low * high)
        machine = read_machine(str(FOLDER / MACHINE), [f"autobalancer.min_wall_mm={middle:.9g}"])
        lobes = sized(machine.whole("size")).autobalancer.budget.race_ovality
        low, high = (middle, high) if 1e3 * lobes / _machine()[0] > ovality else (low, middle)
    return high


def _expected(chart: AtlasChart, result: Result) -> CellValue:
    return CellValue.exact(1e-3 * result["accuracy_budget"]["residual_um"] / _machine()[0])


def _useful(chart: AtlasChart, speed: float, mass: float) -> tuple[str, tuple[str, ...]]:
    """Mass, suspension and the imbalance at which both levels are the same, by repeated substitution."""
    imbalance, machine = 256.0, 5.6
    for _ in range(8):
        entries = (
            f"machine.mass_kg={machine:.9g}", f"suspension.natural_frequencies_hz=[{_hz(speed)},{_hz(speed)}]",
            f"wheel.imbalance_g_mm={imbalance:.9g}",
            "autobalancer.race_eccentricity_mm=0.0099", "autobalancer.rolling_friction_mm=0.00198",
        )  # fmt: skip
        design = sized(read_machine(str(FOLDER / MACHINE), list(entries)).whole("size"))
        balls = design.autobalancer
        machine += mass * balls.ball_count * balls.ball_mass - balls.requirement.effective_mass
        levels = design.idle.worst
        imbalance *= 10 ** ((levels.after - levels.before) / 20)
    return MACHINE, entries


def _useful_value(chart: AtlasChart, result: Result) -> CellValue:
    balls = result["autobalancer"]
    moment = balls["ball_count"] * balls["ball_mass_g"] * balls["pitch_radius_mm"]
    return CellValue.exact(result["imbalance_g_mm"] / moment)


def _hz(ratio: float) -> str:
    return f"{5800 / 60 / ratio:.9g}"


SPEED: Final = 5800 / RPM
"""Speed of the machine that grinds [rad/s]."""


def _contact(chart: AtlasChart, stiffness: float, runout: float) -> tuple[str, tuple[str, ...]]:
    displaced = _machine()[0]
    mass = 256e-3 / displaced
    return "grinding.toml", (
        f"grinding.contact_stiffness_N_per_m={stiffness * mass * SPEED**2:.9g}",
        f"wheel.runout_mm={runout * displaced:.9g}",
    )  # fmt: skip


@cache
def _ground(file: str, entries: tuple[str, ...]) -> Result:
    return plain(abu_calc.grinding(read_machine(file, list(entries))))


PRESSED: Final = {"d-settled": "settled", "d-earlier": "at once"}


def _changed(chart: AtlasChart, result: Result) -> CellValue:
    """Level of the loudest start case minus that without balls [dB], with the levels of all cases as its interval."""
    cases = [each for each in result["starts"]["outcomes"] if each["pressed"] == PRESSED[chart.name]]
    without = result["level_before_db"]
    low, high = min(each["lowest_db"] for each in cases), max(each["highest_db"] for each in cases)
    return CellValue(high - without, low - without, high - without, sum(each["count"] for each in cases))


CONTACT: Final = Recipe(
    _contact, lambda chart, starts: ("grinding", ""), lambda chart, file, entries, starts, seed: _ground(file, entries),
    _changed,
)  # fmt: skip
RESIDUAL: Final = Recipe(
    _residual, lambda chart, starts: ("declare", f"--starts {starts}"), _declared, _ratio, 5000, True
)
OVALITY: Final = Recipe(_oval, lambda chart, starts: ("size", ""), _sized, _expected)
BREAK_EVEN: Final = Recipe(
    _break_even, lambda chart, starts: ("declare", f"--starts {starts}"), _declared, _break_even_value, 11_000, True
)
USEFUL: Final = Recipe(_useful, lambda chart, starts: ("size", ""), _sized, _useful_value)
