"""Motion of an arm whose imbalance nothing balances: by perturbation and simulation, and its instability region."""

import math
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators.choice import loop
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.floquet import floquet_edge
from abu_calc.features.swing_arm.view import ArmHarmonic, ArmMotion, TongueEdge
from abu_calc.formulas.swing_arm import MODULATION, ORDERS, Arm, averaged_edge, forced_harmonics, free_rates, resonance
from abu_calc.foundation.errors import NotTrustworthyError

Array = NDArray[np.float64]
Harmonics = tuple[complex, ...]

TOLERANCE: Final = 1e-11
SAMPLES: Final = 64
NEWTON: Final = 6
CLOSED: Final = 1e-8
"""Closing error, relative to the size of the motion, below which a revolution counts as periodic."""

MOST_EVALUATIONS: Final = 20_000
"""Most evaluations of one revolution.

An arm whose pivot damps at once needs more, and has no motion worth reporting.
"""

NARROWEST: Final = 1e-7
"""Least κ whose tongue is wider than rounding."""

COLUMNS: Final = 29
BESIDE: Final = 1.4
"""Half the width that is drawn, in half widths κ/4 of the undamped tongue."""


def arm_motion(scene: Scene) -> ArmMotion | str | None:
    """Return the motion of a scene's swing arm, its balls standing in the race; None without a swing arm.

    If there is nothing to report, return the reason in words: nothing holds the arm, or κ is too large.
    """
    held = scene.support.standing_arm(scene.balls)
    if held is None:
        return None
    if held.joint_stiffness <= 0:
        return "nothing holds the arm, so that it has no natural frequency"
    kappa = held.length * scene.imbalance / held.inertia
    if not 0 < kappa <= MODULATION.high:
        return f"κ = {kappa:.3g} is outside the range of the theory, above 0 … {MODULATION.high:g}"
    natural = resonance(held, 0.0)
    decay = held.joint_damping * held.length**2 / (2 * held.inertia)
    expected = forced_harmonics(kappa, scene.speed, natural, decay)
    simulated, rates = simulated_motion(scene, held, expected) or ((math.nan,) * ORDERS, None)
    return ArmMotion(
        speed=scene.speed,
        modulation=kappa,
        natural_frequency=natural,
        parametric_speed=2 * natural,
        joint_damping=held.joint_damping,
        rate=0.0 - decay,
        parametric_rates=free_rates(kappa, natural, decay),
        simulated_rates=rates,
        harmonics=tuple(
            ArmHarmonic(
                order=order,
                resonance=natural / order,
                perturbation=held.length * abs(predicted),
                simulation=held.length * abs(other),
            )
            for order, (predicted, other) in enumerate(zip(expected, simulated, strict=True), 1)
        ),
        tongue=tuple(tongue(kappa, natural, 2 * held.inertia / held.length**2)) if kappa > NARROWEST else (),
    )


def tongue(kappa: float, natural: float, mass: float, columns: int = COLUMNS) -> list[TongueEdge]:
    """Edge of the instability region at evenly spaced ω₀/Ω about its middle, ½ − 13κ²/32.

    `mass` 2J_O/l² converts h to damping.
    """
    middle = 0.5 - 13 * kappa**2 / 32
    ratios = middle - np.linspace(-1, 1, columns) * BESIDE * kappa / 4
    unit = mass * kappa * natural
    return [
        TongueEdge(
            speed=natural / ratio,
            averaged=unit * averaged_edge(kappa, ratio),
            floquet=unit * floquet_edge(kappa, ratio),
        )
        for ratio in sorted(ratios.tolist(), reverse=True)
    ]


def simulated_motion(scene: Scene, held: Arm, expected: Harmonics) -> tuple[Harmonics, tuple[float, float]] | None:
    """The periodic motion of the equations themselves, by shooting from that of the perturbation; None: not found.

    Amplitudes M + iN [rad] of ω, 2ω, 3ω, and the growth rates [1/s] of the two free motions.
    """
    races = tuple(replace(race, ball_masses=(), start_angles=(), start_speeds=()) for race in scene.races)
    support = scene.support.holding(scene.balls).without_steady_force()
    bare = replace(
        scene, support=support, races=races, effects=(), imbalance_angle=0.0,
        start_position=(0.0,), start_velocity=(0.0,),
    )  # fmt: skip
    equations, period, speed = assemble(bare), scene.revolution, scene.speed
    known = [z if np.isfinite(z) else 0j for z in expected]
    orders = np.arange(1, ORDERS + 1)
    start = np.array((sum(z.real for z in known), sum(k * speed * z.imag for k, z in zip(orders, known, strict=True))))
    size = max(math.hypot(start[0], start[1] / speed), held.length * scene.imbalance / held.inertia)
    units = size * np.array((1.0, speed))
    steps = units * 1e-3
    try:
        for _ in range(NEWTON):
            ends = [_run(equations, start + step, [period])[:, -1] for step in (np.zeros(2), *np.diag(steps))]
            growth = np.column_stack([end - ends[0] for end in ends[1:]]) / steps
            missed = ends[0] - start
            if np.abs(missed / units).max() < CLOSED:
                break
            start = start + np.linalg.solve(np.eye(2) - growth, missed)
        else:
            return None
        times = period * np.arange(SAMPLES) / SAMPLES
        angle = _run(equations, start, times)[0]
    except (NotTrustworthyError, np.linalg.LinAlgError):
        return None
    harmonics = [complex(2 * np.mean(angle * np.exp(1j * k * speed * times))) for k in orders]
    sizes = np.sort(np.abs(np.linalg.eigvals(growth * units / units[:, None])))[::-1]
    rates = [float(math.log(max(multiplier, np.finfo(float).tiny)) / period) for multiplier in sizes]
    return tuple(harmonics), (rates[0], rates[1])


def _run(equations: Equations, start: Array, times: "list[float] | Array") -> Array:
    begun = replace(equations, initial=(float(start[0]), float(start[1])))
    # Of a revolution without balls plain code is done before compiled code is made.
    run = loop(begun, TOLERANCE, compiled=False).integrate(begun, TOLERANCE, times, MOST_EVALUATIONS)
    return np.asarray(run.y, dtype=float)
