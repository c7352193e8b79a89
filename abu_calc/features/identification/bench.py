"""The bench test: one ball is let go in the standing race, axis horizontal, and its decay gives drag and friction.

J θ̈ + h₀ θ̇ + f·max(g cos θ/R_p + θ̇², 0)·sgn θ̇ + (g/R_p) sin θ = 0, θ from the bottom; the ball sticks where θ̇ = 0
and |sin θ| ≤ f cos θ, f = k_r/r.
"""

import math
from typing import Final

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.features.identification.bank import Array
from abu_calc.features.identification.results import BenchRecord, IdentifiedValue
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.units import GRAVITY
from abu_calc.foundation.validity import Range
from abu_calc.inputs.recording_files import content_of
from abu_calc.inputs.recording_table import decoded, table_of

STARTS_UM: Final = (0.5, 5.0, 20.0)
"""Lever arms [µm] from which fits begin: there are local minima."""
LOST_DRAG: Final = 20.0
"""Drag rate [1/s] from which on the oil hides the friction."""
ANGLE: Final = Range("angle of the ball from the bottom", -170, 170, "deg")
STEPS: Final = 1500
FEWEST: Final = 20
LONGEST: Final = 1e4
"""Duration [s] of a film at most: a ball comes to rest within minutes."""


def read_decay(file: str) -> tuple[Array, Array]:
    """Times [s] and angles [rad] of a film; columns t_s and angle_deg."""
    table = table_of(file, decoded(*content_of(file)), [])
    names = [name.lower() for name in table.names]
    if "t_s" not in names or "angle_deg" not in names:
        raise InputError(
            "columns are missing",
            place=Place(file),
            found=", ".join(table.names),
            allowed="t_s, angle_deg",
            remedy="Give the time, and the angle of the ball from the bottom.",
        )
    times, angles = table.values[:, names.index("t_s")], table.values[:, names.index("angle_deg")]
    if len(times) < FEWEST or not np.all(np.diff(times) > 0) or times[-1] - times[0] > LONGEST:
        raise InputError(
            "too few rows, times that do not ascend, or too long a film",
            place=Place(file),
            found=f"{len(times)} rows, {np.ptp(times) if len(times) else 0:g} s",
            allowed=f"at least {FEWEST}, ascending, {LONGEST:g} s",
        )
    for angle in (float(angles.min()), float(angles.max())):
        ANGLE.check(angle)
    return times - times[0], np.deg2rad(angles)


def decay(times: Array, begin: float, drag: float, friction: float, pitch_radius: float, inertia: float) -> Array:
    """Angles [rad] of a ball let go at rest at an angle, by fourth-order steps that end where the ball stops."""
    weight, step = GRAVITY / pitch_radius, float(times[-1]) / STEPS

    def pull(angle: float, speed: float, way: float) -> float:
        held = max(weight * math.cos(angle) + speed * speed, 0.0)
        return -(drag * speed + friction * held * way + weight * math.sin(angle)) / inertia

    def stepped(angle: float, speed: float, way: float, h: float) -> tuple[float, float]:
        a1, v1 = speed, pull(angle, speed, way)
        a2, v2 = speed + h / 2 * v1, pull(angle + h / 2 * a1, speed + h / 2 * v1, way)
        a3, v3 = speed + h / 2 * v2, pull(angle + h / 2 * a2, speed + h / 2 * v2, way)
        a4, v4 = speed + h * v3, pull(angle + h * a3, speed + h * v3, way)
        return angle + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), speed + h / 6 * (v1 + 2 * v2 + 2 * v3 + v4)

    grid, angle, speed = np.full(STEPS + 1, begin), begin, 0.0
    for k in range(STEPS):
        left = step
        while left > 0:
            if speed == 0.0 and abs(math.sin(angle)) <= friction * max(math.cos(angle), 0.0):
                grid[k + 1 :] = angle
                return np.asarray(np.interp(times, np.arange(STEPS + 1) * step, grid))
            way = math.copysign(1.0, speed) if speed else -math.copysign(1.0, math.sin(angle))
            after = stepped(angle, speed, way, left)
            turns = speed != 0.0 and after[1] * way < 0
            part = left * speed / (speed - after[1]) if turns else left
            angle, speed = stepped(angle, speed, way, part) if turns else after
            speed, left = (0.0, left - part) if turns else (speed, 0.0)
        grid[k + 1] = angle
    return np.asarray(np.interp(times, np.arange(STEPS + 1) * step, grid))


def bench_values(file: str, scene: Scene) -> BenchRecord:
    """Drag rate and lever arm by least squares from several beginnings, two standard errors to both sides."""
    from scipy.optimize import least_squares

    times, angles = read_decay(file)
    race = scene.races[0]

    def off(x: Array) -> Array:
        friction = math.exp(x[1]) * 1e-6 / race.ball_radius
        return np.asarray(
            decay(times, float(x[2]), math.exp(x[0]), friction, race.pitch_radius, race.inertia_factor) - angles
        )

    fits = [
        least_squares(off, [math.log(5.0), math.log(start), angles[0]], diff_step=[1e-4] * 3) for start in STARTS_UM
    ]
    best = min(fits, key=lambda fit: float(fit.cost))
    rms = math.sqrt(2 * float(best.cost) / len(times))
    slopes = np.asarray(best.jac)
    spread = np.sqrt(np.diag(np.linalg.pinv(slopes.T @ slopes))) * rms
    values = (math.exp(best.x[0]), math.exp(best.x[1]) * 1e-3)
    drag, lever = (
        IdentifiedValue(value=value, low=value * max(0.0, 1 - 2 * error), high=value * (1 + 2 * error))
        for value, error in zip(values, map(float, spread[:2]), strict=True)
    )
    return BenchRecord(rolling_drag_per_s=drag, rolling_friction_mm=lever)


def bench_text(values: BenchRecord) -> str:
    """The result in a sentence, and what it is not."""
    drag, lever = values.rolling_drag_per_s, values.rolling_friction_mm
    lost = " The oil hides the friction from 20 1/s on." if drag.value >= LOST_DRAG else ""
    return (
        f"Bench test: lever arm {1e3 * lever.value:.2f} ± {1e3 * (lever.high - lever.value):.2f} µm, drag rate "
        f"{drag.value:.3g} ± {drag.high - drag.value:.2g} 1/s at low slip. At speed the oil lies outward, and the drag "
        f"rate is another.{lost}"
    )
