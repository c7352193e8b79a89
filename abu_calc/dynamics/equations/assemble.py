"""Assembly of the integrated equations from a scene."""

import math
from collections.abc import Callable
from typing import Any

from abu_calc.dynamics.equations import right_hand_side
from abu_calc.dynamics.equations.build import parameters_of
from abu_calc.dynamics.motion import Array, Loads, Motion, Solved
from abu_calc.dynamics.parameters import Acting, Modes, Parameters
from abu_calc.dynamics.scene import Scene
from abu_calc.formulas.motion import HARDLY
from abu_calc.frozen import dataclass

Rhs = Callable[[Any, Any, Any, Acting], Array]


@dataclass(frozen=True, eq=False)
class Equations:
    """A system to integrate: `rhs(xp, t, y, acting)` in the order of `states`; what `effect.Laws` promises.

    first_modes: those of all effects, before they are settled.
    scales: what counts as a whole unit of each state; an error of tolerance × scale per step is allowed.
    relative: whether a state's own size may loosen that (not for angles: they grow without meaning anything).
    longest_step [s]: no step may be longer, whatever the error estimate says.
    breaks [s]: times at which the equations change, whatever the state.
    """

    scene: Scene
    states: tuple[str, ...]
    rhs: Rhs
    parameters: Parameters
    first_modes: Modes
    initial: tuple[float, ...]
    scales: tuple[float, ...]
    relative: tuple[bool, ...]
    longest_step: float
    breaks: tuple[float, ...]

    def in_mode(self, modes: Modes) -> Acting:
        """The numbers while the effects act in these modes."""
        return Acting(self.parameters, modes)

    def accelerations(self, xp: Any, t: Any, y: Any, acting: Acting) -> tuple[Motion, Loads, Solved]:
        """Kinematics, loads and all accelerations at one time."""
        return right_hand_side.accelerations(xp, t, y, acting)

    @property
    def acting(self) -> Acting:
        """The numbers in the first modes."""
        return Acting(self.parameters, self.first_modes)


def assemble(scene: Scene) -> Equations:
    """The equations of a scene. Raises InputError when the support's mass matrix is not symmetric positive definite."""
    parameters, effects = parameters_of(scene), scene.effects
    names, balls, rotor = scene.support.names, range(1, parameters.balls + 1), scene.rotor
    support_scales, rate_scale = scales_of(scene)
    own, turning = scene.ball_states, rotor.states
    return Equations(
        scene=scene,
        states=(
            *names,
            *(f"{name}'" for name in names),
            *(f"θ{k}" for k in balls),
            *(f"θ{k}'" for k in balls),
            *(f"{name}{k}" for name in own for k in balls),
            *turning,
        ),
        rhs=right_hand_side.rhs,
        parameters=parameters,
        first_modes=tuple(effect.first_mode(scene) for effect in effects),
        initial=(
            *scene.start_position,
            *scene.start_velocity,
            *scene.start_angles,
            *(value for race in scene.races for value in race.start_speeds),
            *(value for effect in effects for value in effect.start(scene)),
            *rotor.start(scene.start_speed),
        ),
        scales=(
            *support_scales,
            *(scale * scene.speed for scale in support_scales),
            *(1.0 for _ in balls),
            *(rate_scale for _ in balls),
            *(value for effect in effects for value in effect.scales(scene)),
            *(1.0, rate_scale)[: len(turning)],
        ),
        relative=(
            *(True for _ in 2 * names),
            *(False for _ in balls),
            *(True for _ in balls),
            *(True for _ in own for _ in balls),
            *(False for _ in turning),
        ),
        # An imbalance goes round once per revolution: a longer step might not see it.
        longest_step=scene.revolution,
        breaks=tuple(sorted({time for effect in effects for time in effect.breaks(scene)})),
    )


def scales_of(scene: Scene) -> tuple[list[float], float]:
    """Scales of the support's coordinates and of the balls' speeds.

    The first is the amplitude of the free, unbalanced rotor, m₀e/M, which is what amplitudes are compared with; a
    hundredth of the balls' own moment stands in where there is next to no imbalance. The second is the rate of the
    balls' slow motion, Ω√(Σm/2M), on which they find their places: measured in Ω, that would be lost in the tolerance.
    """
    balls = sum(scene.ball_masses)
    mass = scene.support.felt_mass + balls
    largest = max((race.pitch_radius for race in scene.races), default=0.0)
    reach = max(scene.imbalance, HARDLY * scene.static_moment, 1e-9 * mass * largest) / mass
    rate = scene.speed * math.sqrt(balls / (2 * mass)) if balls else scene.speed
    # A coordinate that moves the race by less than its own amount may move more; one that does not, like the race.
    return [reach / share if share > 0 else reach for share in scene.support.shares(scene.races)], rate
