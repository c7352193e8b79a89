"""Assembly of the integrated equations of a scene: its numbers, the right-hand side and exact derivatives.

parameters_of    Scene → Parameters: the numbers that the equations read
assemble         Scene → Equations, ready to integrate
jacobian         ∂y'/∂y, exact to rounding
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations import right_hand_side
from abu_calc.dynamics.motion import AnyArray, Loads, Motion, Solved
from abu_calc.dynamics.rotor import Acting, Frame, Modes, Parameters
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import at_samples
from abu_calc.formulas.motion import HARDLY
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass

Array = NDArray[np.float64]


def parameters_of(scene: Scene) -> Parameters:
    """The numbers of a scene. Raises InputError when the support's mass is not symmetric and positive definite."""
    balls, rotor = scene.balls, scene.rotor
    spins = (balls.factors - 1) * balls.sizes
    frame = scene.support.frame(balls)
    if rotor.rows:
        frame = _with_rotor(frame, sum(effect.rotor_inertia for effect in scene.effects))
    return Parameters(
        size=len(scene.support.names),
        balls=len(balls.masses),
        rotor=rotor,
        geometry=scene.support.geometry(scene.unbalance),
        frame=frame,
        speed=scene.speed,
        masses=balls.masses,
        radii=balls.radii,
        static_moments=balls.static_moments,
        drags=balls.radii * balls.drags,
        braking=-balls.radii * balls.drags,
        inertia_factors=balls.factors,
        mobilities=1 / balls.factors,
        reduced_masses=balls.masses / balls.factors,
        spins=spins,
        spin_inertia=_spin_inertia(frame, float((balls.masses * spins * balls.sizes).sum())),
        places=balls.places,
        imbalance=scene.imbalance,
        imbalance_angle=scene.imbalance_angle,
        effects=scene.effects,
    )


def _spin_inertia(frame: Frame, inertia: float) -> AnyArray | None:
    """Inertia of balls that their races turn, in the accelerations that turn the races."""
    turning = np.zeros(len(frame.mass))
    turning[list(frame.turning)] = 1.0
    return inertia * np.outer(turning, turning) if frame.turning else None


def _with_rotor(frame: Frame, inertia: float) -> Frame:
    """One more row: the rotor's own turning, which is counted from what carries it."""
    border = np.zeros((len(frame.mass), 1))
    border[list(frame.turning)] = inertia
    mass = np.block([[frame.mass, border], [border.T, np.array([[inertia]])]])
    if np.any(np.linalg.eigvalsh(mass) <= 0):
        raise InputError("the rotor has more inertia than the arm that carries it", found=f"{inertia:g} kg m²")

    def longer(rows: AnyArray | None) -> AnyArray | None:
        """The rows, and one of zeros."""
        return None if rows is None else np.concatenate([rows, np.zeros((1, *rows.shape[1:]))])

    return replace(
        frame,
        mass=mass,
        held=np.vstack([frame.held, np.zeros(frame.held.shape[1])]),
        turning=(*frame.turning, -1),
        whole=None,
        held_spinning=longer(frame.held_spinning),
        carry=None if frame.carry is None else np.hstack([frame.carry, np.zeros((len(frame.carry), 1))]),
        steady_force=longer(frame.steady_force),
    )


Rhs = Callable[[Any, Any, Any, Acting], AnyArray]


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
    """The equations of a scene.

    Raises InputError when an effect cannot act in it, or the support's mass matrix is not symmetric positive definite.
    """
    for effect in scene.effects:
        effect.check(scene)
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


STEP = 1e-100
"""An imaginary step cancels nothing, so it may be so small that its square is nothing."""


def jacobian(equations: Equations, t: float, y: Array, modes: tuple[Any, ...] | None = None) -> Array:
    """∂(rhs)/∂y at (t, y), in the first modes unless others are given; see `jacobians`."""
    matrix: Array = jacobians(equations, np.array([t]), np.array([y]), modes)[0]
    return matrix


def jacobians(equations: Equations, times: Array, states: Array, modes: tuple[Any, ...] | None = None) -> Array:
    """∂(rhs)/∂y, [time, row, column], at these times and the state of each, exact to rounding.

    By the complex step J[i, j] = Im rhs_i(y + i·h·e_j)/h (Squire & Trapp 1998, SIAM Review 40(1)), all times and all
    directions at once.
    """
    acting, size = equations.acting if modes is None else equations.in_mode(modes), states.shape[1]
    moved = states.T[:, :, None] + 1j * STEP * np.eye(size)[:, None, :]

    def rates(t: Any, y: Any) -> Any:
        """y' in these modes."""
        return equations.rhs(np, t, y, acting)

    every = np.repeat(times, size), moved.reshape(size, -1)
    slopes = at_samples(rates, *every, at_once=equations.parameters.traceable)
    return np.asarray(np.imag(slopes).reshape(moved.shape).transpose(1, 0, 2) / STEP, dtype=float)
