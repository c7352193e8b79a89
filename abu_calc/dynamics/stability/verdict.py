"""Stability of the balanced state: balls at rest in their races, opposite the imbalance, the axis still.

Sources: Green, Champneys & Lieven 2006 and Rodrigues, Champneys, Friswell & Wilson 2008, for two balls on an isotropic
support; Kovalenko 2010, (17)–(24), for a swing arm. Printed: Kladiev 1996, (7), asks only for a speed above the natural
frequency; that does not suffice.
"""

from dataclasses import replace
from typing import Literal

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.arrangements import Arrangement, rests
from abu_calc.dynamics.stability.linearised import BalancedMotion, growth_of
from abu_calc.dynamics.stability.resting import NotKnownError, Rest, resting_state
from abu_calc.dynamics.stability.search import MARGIN, searched, worst
from abu_calc.foundation.frozen import dataclass

State = Literal["balanced", "race still", "arm alone"]


@dataclass(frozen=True)
class Stability:
    """One state at one speed; rates in 1/s, angles in rad.

    `state` judged: balanced; the races' centres still while the axis moves elsewhere ("race still"); or a swing arm
    without balls ("arm alone"). `angles` None: the balls cannot balance. `eigenvalues` on an isotropic support,
    `multipliers` of one revolution on any other. `stable` None where it is not known, `reason` says why. Directions in
    which balls move without changing what they carry (n − 2 of the n of a race) are neutral and do not count.
    `left_out`: effects of the scene that are no part of the linear motion; `arrangements`: how many were judged, of
    which the angles are those of the worst.
    """

    speed: float
    state: State | None
    angles: tuple[float, ...] | None
    eigenvalues: tuple[complex, ...] | None
    multipliers: tuple[complex, ...] | None
    growth_rate: float | None
    stable: bool | None
    reason: str | None
    left_out: tuple[str, ...]
    arrangements: int = 0


def stability(scene: Scene, half_angle: float = 0.0, arrangement: Arrangement = "worst") -> Stability:
    """Stability of the balanced state of a scene, at its speed, by the worst arrangement.

    Growth rate: the largest Re λ, or ln|μ|/T over a revolution T [1/s]; stable below −1e-9·Ω. `half_angle` [rad] of
    touching balls, 0 for balls without size; `arrangement`: see `arrangements.rests`; on an anisotropic support and on
    a swing arm the worst is searched, see `Search`. A swing arm whose balls are none, or cannot balance, is
    judged alone; with balls that cannot balance it is not called stable. Range: constant speed, small motions, no
    effects. Raises NotTrustworthyError when multipliers do not settle.
    """
    left_out = tuple(effect.name for effect in scene.effects)
    unknown = Stability(scene.speed, None, None, None, None, None, None, None, left_out)
    try:
        state, motions = judged(scene, half_angle, arrangement)
    except NotKnownError as error:
        return replace(unknown, reason=str(error))
    if not motions:
        return replace(unknown, stable=False)
    motion, search = worst(motions, scene.speed), searched(motions, half_angle)
    count = len(motions)
    if search:
        motion, count = worst((motion, search.worst(scene.speed)), scene.speed), search.trials
    eigenvalues = motion.eigenvalues(scene.speed)
    multipliers = motion.multipliers(scene.speed) if eigenvalues is None else None
    growth = growth_of(multipliers, scene.speed) if multipliers else motion.growth(scene.speed)
    carried = state != "arm alone" or not scene.ball_masses
    stable = carried and growth < -MARGIN * scene.speed
    angles = motion.angles if carried else None
    return Stability(scene.speed, state, angles, eigenvalues, multipliers, growth, stable, None, left_out, count)


def critical_damping(scene: Scene) -> float | None:
    """Damping of the support [N·s/m] that parametric resonance cannot overcome as long as nothing is balanced.

    None where there is none: see `SwingArmSupport.critical_damping`.
    """
    return scene.support.critical_damping(scene.imbalance, scene.balls)


def judged(
    scene: Scene, half_angle: float = 0.0, arrangement: Arrangement = "worst"
) -> tuple[State | None, tuple[BalancedMotion, ...]]:
    """State that is judged of a scene, and its motions at each arrangement, if there are any."""
    states = rests(scene, half_angle, arrangement) if scene.ball_masses else _without_balls(scene, half_angle)
    support = scene.support
    if states:
        state: State = "race still" if states[0].motion else "balanced"
        return state, tuple(BalancedMotion(scene, rest.angles, rest.motion) for rest in states)
    if not support.turns:
        return None, ()
    races = tuple(replace(race, ball_masses=(), start_angles=(), start_speeds=()) for race in scene.races)
    return "arm alone", (BalancedMotion(replace(scene, support=support.holding(scene.balls), races=races), ()),)


def _without_balls(scene: Scene, half_angle: float) -> tuple[Rest, ...]:
    """An arm without balls is judged alone, whether it has an imbalance or not."""
    rest = None if scene.support.turns else resting_state(scene, half_angle)
    return () if rest is None else (rest,)
