"""Cells of charts about scenes: shares of starts that balance."""

import math
import shlex
from typing import Final

import abu_calc
from abu_calc.features.stability.attractors import search, searched_scene
from abu_calc.simulation.scene_file import read_any
from abu_calc.simulation.subject import subject_of
from tests.studies.atlas.charts import AtlasChart
from tests.studies.atlas.recipe import RPM, CellValue, Recipe, Result, plain


def _balance(chart: AtlasChart, speed: float, drag: float) -> tuple[str, tuple[str, ...]]:
    balls, kind = int(chart.name.split("-")[1]), chart.name.split("-")[2]
    masses = ",".join([f"{40 / balls:g}"] * balls)
    angles = ",".join(f"{360 * k / balls:g}" for k in range(balls))
    return f"{kind}.toml", (
        f"scene.race[0].ball_masses_g=[{masses}]", f"scene.race[0].start_angles_deg=[{angles}]",
        f"scene.race[0].rolling_drag_per_s={drag:g}", f"scene.speed_rpm={speed * RPM:.9g}",
    )  # fmt: skip


def _attractors(chart: AtlasChart, file: str, entries: tuple[str, ...], starts: int, seed: int) -> Result:
    """The drawn starts alone: the command follows designed ones, too, which count in no share."""
    found = search(searched_scene(subject_of(read_any(file, list(entries)))), starts, seed, designed=False)
    ends = [{"kind": group.kind, "drawn_starts": group.drawn} for group in found.groups]
    return {
        "attractors": ends,
        "attractor_search": {"drawn_starts": starts, "undecided_share": len(found.undecided) / starts},
    }


def _balanced(chart: AtlasChart, result: Result) -> CellValue:
    search = result["attractor_search"]
    met = sum(each["drawn_starts"] for each in result["attractors"] if each["kind"] == "balanced")
    lost = round(search["undecided_share"] * search["drawn_starts"])
    return CellValue.share(met, search["drawn_starts"], lost)


AFTER: Final = 300.0
"""Time of the end after full speed, times the natural frequency."""
CONSTANTS: Final = 3.0
"""Time constants of a motor that count as its run-up."""
HAND: Final = math.sqrt(1529.79 / (6.374596 + 4 * 0.0163393))
"""Natural frequency of the hand-held machine with its balls [rad/s]."""
ANYWHERE: Final = tuple(f"scene.race[0].start_angles_deg[{k}]=uniform(0,360)" for k in range(4))
AT_BOTTOM: Final = (
    "scene.imbalance_angle_deg=uniform(0,360)", "scene.effects.race_eccentricity.angle_deg=uniform(0,360)"
)  # fmt: skip
VARIED: Final = {"b-light": ANYWHERE, "b-hand": AT_BOTTOM, "h": AT_BOTTOM}
"""What differs from start to start."""


def _run_up(chart: AtlasChart, time: float, drag: float) -> tuple[str, tuple[str, ...]]:
    file, frequency = ("light.toml", 1.0) if chart.name == "b-light" else ("hand.toml", HAND)
    return file, (
        f"scene.race[0].rolling_drag_per_s={drag * frequency:.9g}",
        f"scene.effects.run_up.time_s={time / frequency:.9g}", f"scene.duration_s={(time + AFTER) / frequency:.9g}",
    )  # fmt: skip


INERTIA, NO_LOAD = 0.002, 6000 / RPM
"""Moment of inertia [kg m²] and no-load speed [rad/s] of the machine with a motor."""


def _motor(chart: AtlasChart, motor: float, drag: float) -> tuple[str, tuple[str, ...]]:
    return "motor.toml", (
        f"scene.race[0].rolling_drag_per_s={drag * HAND:.9g}",
        f"scene.effects.motor.stall_torque_N_m={motor * INERTIA * NO_LOAD * HAND:.9g}",
        f"scene.duration_s={(CONSTANTS / motor + AFTER) / HAND:.9g}",
    )  # fmt: skip


def _swept(chart: AtlasChart, file: str, entries: tuple[str, ...], starts: int, seed: int) -> Result:
    scene = read_any(file, list(entries))
    return plain(abu_calc.sweep(scene, VARIED[chart.name], runs=starts, seed=seed, workers=1))


def _sweep(chart: AtlasChart, starts: int) -> tuple[str, str]:
    varied = " ".join(f"--vary {shlex.quote(each)}" for each in VARIED[chart.name])
    return "sweep", f"{varied} --runs {starts}"


def _met(chart: AtlasChart, result: Result) -> CellValue:
    """Starts without numbers count as not balancing."""
    return CellValue.share(result["meets_limits"]["met"], result["runs"], result["failed"]["members"])


RUN_UP: Final = Recipe(_run_up, _sweep, _swept, _met, 25, True)
MOTOR: Final = Recipe(_motor, _sweep, _swept, _met, 20, True)
BALANCE: Final = Recipe(
    _balance, lambda chart, starts: ("stability", f"--attractors --starts {starts}"), _attractors, _balanced, 20, True
)
