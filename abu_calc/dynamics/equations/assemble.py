"""From a scene to the equations that are integrated."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from abu_calc.dynamics.equations.parameters import Array, Parameters, parameters_of
from abu_calc.dynamics.equations.right_hand_side import rhs
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports import linear, swing_arm, tilting
from abu_calc.dynamics.supports.kinds import SwingArm

Rhs = Callable[[Any, Any, Any, Parameters], Array]


@dataclass(frozen=True, eq=False)
class Equations:
    """A system to integrate: `rhs(xp, t, y, parameters)` in the order of `states`.

    scales: what counts as a whole unit of each state; an error of tolerance × scale per step is allowed.
    relative: whether a state's own size may loosen that (not for angles: they grow without meaning anything).
    longest_step [s]: no step may be longer, whatever the error estimate says.
    breaks [s]: moments at which the equations change, whatever the state.
    """

    scene: Scene
    states: tuple[str, ...]
    rhs: Rhs
    parameters: Parameters
    initial: tuple[float, ...]
    scales: tuple[float, ...]
    relative: tuple[bool, ...]
    longest_step: float
    breaks: tuple[float, ...]

    def in_mode(self, modes: tuple[Any, ...]) -> Parameters:
        """The parameters while the effects act in these modes."""
        return self.parameters.in_mode(modes)


def assemble(scene: Scene) -> Equations:
    """The equations of a scene. Raises InputError when the support's mass matrix is not symmetric positive definite."""
    on_arm = isinstance(scene.support, SwingArm)
    geometry = swing_arm.levers if on_arm else tilting.levers if scene.support.tilts else linear.levers
    parameters = parameters_of(scene, geometry, swing_arm.imbalance if on_arm else linear.imbalance)
    names, balls, steady = scene.support.names, range(1, parameters.balls + 1), parameters.rotor == "steady"
    support_scales, rate_scale = scales_of(scene)
    own = [name for effect in scene.effects for name in effect.ball_states]
    speed = 0.0 if getattr(scene.effect("run_up"), "up", 0.0) else scene.speed
    return Equations(
        scene=scene,
        states=(
            *names,
            *(f"{name}'" for name in names),
            *(f"θ{k}" for k in balls),
            *(f"θ{k}'" for k in balls),
            *(f"{name}{k}" for name in own for k in balls),
            *(() if steady else ("turn", "turn'")),
        ),
        rhs=rhs,
        parameters=parameters,
        initial=(
            *scene.start_position,
            *scene.start_velocity,
            *scene.start_angles,
            *(value for race in scene.races for value in race.start_speeds),
            *(value for effect in scene.effects for value in effect.start(scene)),
            *(() if steady else (0.0, speed)),
        ),
        scales=(
            *support_scales,
            *(scale * scene.speed for scale in support_scales),
            *(1.0 for _ in balls),
            *(rate_scale for _ in balls),
            *(value for effect in scene.effects for value in effect.scales(scene)),
            *(() if steady else (1.0, rate_scale)),
        ),
        relative=(
            *(True for _ in 2 * names),
            *(False for _ in balls),
            *(True for _ in balls),
            *(True for _ in own for _ in balls),
            *(() if steady else (False, False)),
        ),
        # An imbalance goes round once per revolution: a longer step might not see it.
        longest_step=scene.revolution,
        breaks=tuple(sorted({moment for effect in scene.effects for moment in effect.breaks(scene)})),
    )


def scales_of(scene: Scene) -> tuple[list[float], float]:
    """Scales of the support's coordinates and of the balls' speeds.

    The first is the amplitude of the free, unbalanced rotor, m₀e/M, which is what amplitudes are compared with; a
    hundredth of the balls' own moment stands in where there is next to no imbalance. The second is the rate of the
    balls' slow motion, Ω√(Σm/2M), on which they find their places: measured in Ω, that would be lost in the tolerance.
    """
    support, balls = scene.support, sum(scene.ball_masses)
    if isinstance(support, SwingArm):
        own, shares = support.inertia / support.length**2, [support.length]
    else:
        P = np.array(support.race_map)
        compliance = P @ np.linalg.solve(np.array(support.mass), P.T)
        own = 2 / float(compliance[0, 0] + compliance[1, 1])
        # A coordinate that moves the race by less than its own amount may move more; one that does not, like the race.
        shares = _shares(scene, P)
    mass = own + balls
    largest = max((race.pitch_radius for race in scene.races), default=0.0)
    reach = max(scene.imbalance, 0.01 * scene.static_moment, 1e-9 * mass * largest) / mass
    rate = scene.speed * math.sqrt(balls / (2 * mass)) if balls else scene.speed
    return [reach / share if share > 0 else reach for share in shares], rate


def _shares(scene: Scene, P: Array) -> list[float]:
    """By how much a unit of each coordinate moves the races."""
    moved = [np.hypot(*P[:2])]
    if len(P) == 4:
        moved += [np.hypot(*(P[:2] + race.plane_offset * P[2:])) for race in scene.races]
        tilting_ones = np.hypot(*P[2:]) * max((race.pitch_radius for race in scene.races), default=0.0)
        moved.append(tilting_ones)
    return [float(value) for value in np.max(moved, axis=0)]
