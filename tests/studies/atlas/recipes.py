"""Recipes of the charts: a cell's entries, the command that makes it, and its value in the command's result."""

import json
import math
import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final

import abu_calc
from abu_calc.features.atlas.charts import AtlasChart
from abu_calc.features.stability.attractor_search import search
from abu_calc.features.stability.attractors import interval, searched_scene
from abu_calc.foundation.units import GRAVITY
from abu_calc.inputs.read_machine import read_machine
from abu_calc.inputs.scene import read_any
from abu_calc.simulation.subject import subject_of
from abu_calc.sizing import size as sized

FOLDER: Final = Path(__file__).parent
SHOWN: Final = "tests/studies/atlas"
RPM: Final = 30 / math.pi
NORMAL_95: Final = 1.96
MACHINE: Final = "machine.toml"
Result = Mapping[str, Any]


@dataclass(frozen=True)
class CellValue:
    """Value of a cell with its interval; `starts` that were simulated for it, `lost` those without a decided end."""

    value: float
    low: float
    high: float
    starts: int = 0
    lost: int = 0

    @classmethod
    def share(cls, met: int, starts: int, lost: int = 0) -> "CellValue":
        """A share of starts with its exact interval."""
        return cls(met / starts, *interval(met, starts), starts, lost)

    @classmethod
    def exact(cls, value: float, starts: int = 0) -> "CellValue":
        """A number without an interval."""
        return cls(value, value, value, starts)


@dataclass(frozen=True)
class Recipe:
    """How cells of a chart are made.

    `entries`: file and entries of a cell, by chart, across and up; `words`: the command and its options, by the number
    of starts; `run`: its result as the command gives it in JSON, by file, entries, starts and seed; `read`: the value
    in it; `starts`: as many without another number.
    """

    entries: Callable[[AtlasChart, float, float], tuple[str, tuple[str, ...]]]
    words: Callable[[int], tuple[str, str]]
    run: Callable[[str, tuple[str, ...], int, int], Result]
    read: Callable[[Result], CellValue]
    starts: int = 0
    seeded: bool = False

    def command(self, chart: AtlasChart, across: float, up: float, starts: int) -> str:
        """Command that gives the value of a cell again."""
        file, entries = self.entries(chart, across, up)
        name, options = self.words(starts)
        sets = " ".join(f"--set {shlex.quote(each)}" for each in entries)
        return f"abu {name} {SHOWN}/{file} {sets} {options}".strip()

    def computed(self, chart: AtlasChart, across: float, up: float, starts: int, seed: int = 0) -> CellValue:
        """A cell, computed in this process by the function that the command calls."""
        file, entries = self.entries(chart, across, up)
        return self.read(self.run(str(FOLDER / file), entries, starts, seed))


def _plain(result: Any) -> Result:
    """Result as JSON has it."""
    plain: Result = json.loads(json.dumps(result.to_dict(), default=str))
    return plain


# Chart a: attractor search.


def _balance(chart: AtlasChart, speed: float, drag: float) -> tuple[str, tuple[str, ...]]:
    balls, kind = int(chart.name.split("-")[1]), chart.name.split("-")[2]
    masses = ",".join([f"{40 / balls:g}"] * balls)
    angles = ",".join(f"{360 * k / balls:g}" for k in range(balls))
    return f"{kind}.toml", (
        f"scene.race[0].ball_masses_g=[{masses}]", f"scene.race[0].start_angles_deg=[{angles}]",
        f"scene.race[0].rolling_drag_per_s={drag:g}", f"scene.speed_rpm={speed * RPM:.9g}",
    )  # fmt: skip


def _attractors(file: str, entries: tuple[str, ...], starts: int, seed: int) -> Result:
    """The drawn starts alone: the command follows designed ones, too, which count in no share."""
    found = search(searched_scene(subject_of(read_any(file, list(entries)))), starts, seed, designed=False)
    ends = [{"kind": group.kind, "drawn_starts": group.drawn} for group in found.groups]
    return {
        "attractors": ends,
        "attractor_search": {"drawn_starts": starts, "undecided_share": len(found.undecided) / starts},
    }


def _balanced(result: Result) -> CellValue:
    search = result["attractor_search"]
    met = sum(each["drawn_starts"] for each in result["attractors"] if each["kind"] == "balanced")
    lost = round(search["undecided_share"] * search["drawn_starts"])
    return CellValue.share(met, search["drawn_starts"], lost)


# Charts c, e, f, g: a machine in closed form or by its type test.


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


def _declared(file: str, entries: tuple[str, ...], starts: int, seed: int) -> Result:
    return _plain(abu_calc.declare(read_machine(file, list(entries)), starts=starts))


def _displacement_left(result: Result) -> CellValue:
    """Mean vibration of the wheel plane with balls over that without."""
    with_, without = result["with"], result["without"]["a_hv_m_per_s2"]
    value, error = with_["a_hv_m_per_s2"] / without, NORMAL_95 * with_["standard_error_m_per_s2"] / without
    return CellValue(value, value - error, value + error, result["plan"]["starts"])


def _break_even(chart: AtlasChart, friction: float, background: float) -> tuple[str, tuple[str, ...]]:
    return MACHINE, (*_race(0.25, friction), f"type_test.background_a_hv_m_per_s2={background * _bare():.9g}")


@cache
def _bare() -> float:
    """Vibration of the test wheel without balls and background [m/s²]."""
    return abu_calc.declare(read_machine(str(FOLDER / MACHINE)), starts=100).without.a_hv_m_per_s2


def _break_even_value(result: Result) -> CellValue:
    found = result["break_even_eccentricity_mm"]
    return CellValue.exact(0.0 if found is None else found / _machine()[0], result["plan"]["starts"])


def _sized(file: str, entries: tuple[str, ...], starts: int, seed: int) -> Result:
    """The steps of `abu size` alone: its simulations change none of these numbers."""
    design = sized(read_machine(file, list(entries)).whole("size"))
    balls = design.autobalancer
    shown = {
        "ball_count": balls.ball_count, "ball_mass_g": 1e3 * balls.ball_mass, "pitch_radius_mm": 1e3 * balls.pitch_radius
    }  # fmt: skip
    return {
        "imbalance_g_mm": 1e6 * design.imbalance.value,
        "autobalancer": shown,
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


def _expected(result: Result) -> CellValue:
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


def _useful_value(result: Result) -> CellValue:
    balls = result["autobalancer"]
    moment = balls["ball_count"] * balls["ball_mass_g"] * balls["pitch_radius_mm"]
    return CellValue.exact(result["imbalance_g_mm"] / moment)


def _hz(ratio: float) -> str:
    return f"{5800 / 60 / ratio:.9g}"


RECIPES: Final[dict[str, Recipe]] = {
    "a": Recipe(_balance, lambda starts: ("stability", f"--attractors --starts {starts}"), _attractors, _balanced, 20,
                seeded=True),
    "c": Recipe(_residual, lambda starts: ("declare", f"--starts {starts}"), _declared, _displacement_left, 5000),
    "f": Recipe(_break_even, lambda starts: ("declare", f"--starts {starts}"), _declared, _break_even_value, 6000),
    "e": Recipe(_oval, lambda starts: ("size", ""), _sized, _expected),
    "g": Recipe(_useful, lambda starts: ("size", ""), _sized, _useful_value),
}  # fmt: skip
"""Recipe of each letter."""
