"""Dry rolling friction: a ball stands still in its race until the pull exceeds f times its normal force.

    |F| ≤ f |n| on a ball that sticks,    F = −f |n| θ'/|θ'| on one that rolls,    f = k_r/r

F and n are forces of race and ball per ball mass, along the race and normal to it. The race is closed on both sides: a
ball that its outer side does not press inward, n < 0, is held by the inner one, and rubs there. Stick is exact: θ' is
0, and an event ends it; the signs of θ' and n are never smoothed. Balls that move together stick or roll together, by
the sums of their forces. A ball that also rolls across its race, by v, is rubbed against its whole velocity,
−f |n| (R_p θ', v)/|…|: so transverse motion shakes dry friction out. Of balls that move together one may stop across
its race while the others roll: below a millionth of R_p Ω its friction is proportional to its velocity. Source:
Coulomb's rolling friction with the lever arm k_r; balls may rest where |Im(w e^{−iθ})| ≤ f R_p. The inner side is taken
to be as hard as the outer one.
"""

import math
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effect import ACROSS_RATE, BallRadius, Effect, EffectInfluence, Kind, Laws, Rule, SwitchPoint
from abu_calc.dynamics.motion import AnyArray, Levers, Loads, Motion, Solved
from abu_calc.dynamics.rotor import Parameters
from abu_calc.dynamics.support import Circumstances, Holding
from abu_calc.dynamics.supports.steady_motion import reference_imbalance, unbalanced_amplitude, weighing_amplitude
from abu_calc.dynamics.switching.stick_slip import CROSSES, HOLD, SLOW, Rolling, decided, forces
from abu_calc.dynamics.trajectory import Samples, at_samples, merged
from abu_calc.formulas.friction_band import friction_band
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.inputs.reading.table import Table, entry

LEAVES = 1e-4
"""A ball pulled inward by more of m R_p Ω² than this is worth a warning: near standstill less means nothing."""

STOPPED = SLOW / 4
"""Speed, relative to R_p Ω, below which friction falls on a ball that a chain carries along while it stops rolling
across: an exact stop would have to be shared out between friction and the neighbours."""

ASKED = 200
"""Samples of a run that are asked whether balls leave their race, twice: evenly spread, and where balls are slow."""


class DryRollingFriction(Table):
    """Dry rolling friction: a ball sticks until it is pulled harder than its normal force times k_r/r."""

    lever_arm_mm: float = entry(ge=0, le=1, example=0.002).means(
        "Lever arm of dry rolling friction [mm]; {range}, hard ground clean race 0.0005 … 0.005."
    )
    ball_radius_mm: BallRadius


@dataclass(frozen=True)
class DryRollingFrictionEffect(Effect):
    """`lever_arm` k_r [m], `ball_radius` r [m]. Mode: `Rolling`; None without friction."""

    lever_arm: float
    ball_radius: float

    name: ClassVar[str] = "dry_rolling_friction"
    keys = DryRollingFriction
    kind: ClassVar[Kind] = "dissipative"
    stage = "friction"
    about: ClassVar[str] = (
        "Dry rolling friction: a ball rests in its race until the pull on it exceeds f times its normal force"
    )
    switches: ClassVar[bool] = True

    def __post_init__(self) -> None:
        radius = Range("ball radius", 0, math.inf, "m", open_low=True).check(self.ball_radius)
        Range("lever arm of rolling friction", 0, radius, "m").check(self.lever_arm)

    @property
    def coefficient(self) -> float:
        """f = k_r/r."""
        return self.lever_arm / self.ball_radius

    def first_mode(self, scene: Circumstances) -> Any:
        """All balls stick, pressed outward; None without friction."""
        balls = len(scene.ball_masses)
        return Rolling(np.zeros(balls), np.ones(balls), np.ones(balls)) if self.lever_arm and balls else None

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """±f per normal force on balls that roll; balls that stick do not move."""
        if mode is None:
            return
        sigma, f = mode.direction, self.coefficient * mode.side
        if loads.across is None:
            loads.own(grip=f * sigma, free=sigma * sigma, hold=f + 0.0 * sigma)
            return
        along = m.radii * m.rate
        # Balls that stick have no velocity, and need none. One of a chain may stop alone, and has a direction still.
        slow = 0.0
        if loads.mates is not None:
            slow = (loads.mates.sums(np.ones(p.balls)) - 1) * (STOPPED * p.radii * p.speed) ** 2
        share = f * sigma / m.xp.sqrt(sigma * (along * along + m.rolled * m.rolled + slow) + (1 - sigma))
        loads.own(grip=share * along, free=sigma, hold=f * (1 - sigma))
        loads.across.grip, loads.across.free = share * m.rolled, sigma

    def watch(self, m: Motion, mode: Any, own: Any, loads: Loads, solved: Solved, p: Parameters) -> list[Any]:
        """Rolling on: σ θ'/Ω, or the speed squared. Sticking: (f n)² − F². On its side: s n. Relative to f m R_p Ω².

        The first of balls that move together stands for all.
        """
        if mode is None:
            return []
        pull, aside, most = forces(self.coefficient, m, mode, loads, solved, p)
        flung = p.radii * p.speed**2
        unit = self.coefficient * p.masses * flung
        holds = ((1 + HOLD) * most * most - pull * pull - aside * aside) / (unit * unit)
        lead = 1.0 if loads.leads is None else loads.leads
        rolls, sticks, goes_on = lead * loads.free, lead * (1 - loads.free), mode.direction * m.rate / p.speed
        if loads.across is not None:
            whole, least = p.radii * p.speed, SLOW / 2 * mode.begun
            along, rolled = m.radii * m.rate / whole, m.rolled / whole
            squares = along * along + rolled * rolled
            goes_on = (squares if loads.mates is None else loads.mates.sums(squares)) - least * least
        pressed = mode.side * solved.normal / flung + CROSSES
        return [*(rolls * goes_on + (1 - rolls)), *(sticks * holds + (1 - sticks)), *pressed]

    def rule(self, mode: Any) -> Rule | None:
        """Balls stick or roll, on one side of their race."""
        return None if mode is None else Rule("dry friction")

    def criteria(self, m: Motion, mode: Any, own: Any, loads: Loads, solved: Solved, p: Parameters) -> list[Any]:
        """Pull on each ball along its race, and the most that friction can take of it, relative to f m R_p Ω²."""
        if mode is None:
            return []
        pull, _, most = forces(self.coefficient, m, mode, loads, solved, p)
        unit = self.coefficient * p.masses * p.radii * p.speed**2
        return [*(pull / unit), *(most / unit)]

    def settle(self, at: SwitchPoint) -> tuple[Any, Any]:
        """Decide which balls stick and which roll, and on which side."""
        return (at.y, None) if at.mode is None else decided(at, self.coefficient)

    def power(self, m: Motion, mode: Any, own: Any, solved: Solved, p: Parameters) -> Any:
        """−Σ m f |n| |(R_p θ', v)| [W]."""
        if mode is None:
            return 0.0
        along, sigma = m.radii * m.rate, mode.direction
        speed = sigma * along
        if m.rolled is not None:
            speed = sigma * m.xp.sqrt(sigma * (along * along + m.rolled * m.rolled) + (1 - sigma))
        return -self.coefficient * (p.masses * mode.side * solved.normal).dot(speed)

    def remarks(self, equations: Laws, samples: Samples) -> tuple[str, ...]:
        """The first sample at which a ball is off the outer side of its race, counting all balls as rolling.

        Of many samples some are asked: every so many, and where balls turn slowest, which is where they leave the race
        first.
        """
        p = equations.parameters
        if equations.first_modes[p.effects.index(self)] is None:
            return ()
        asked = self._asked(equations, samples)
        leaving = self._outward(equations, samples, asked).min(axis=0) < -LEAVES
        if not leaving.any():
            return ()
        before = np.arange(asked[leaving.argmax()] + 1)
        outward = self._outward(equations, samples, before)
        first = int((outward.min(axis=0) < -LEAVES).argmax())
        ball = 1 + int(outward[:, first].argmin())
        return (
            f"dry rolling friction: ball {ball} is pulled off the outer side of its race at t = {samples.t[first]:.4g} "
            "s and rubs on the inner one; a higher speed or a damped support presses it outward",
        )

    def _outward(self, equations: Laws, samples: Samples, asked: NDArray[np.intp]) -> AnyArray:
        """Normal force on each ball at some samples [ball, sample], of m R_p Ω²."""
        p, first = equations.parameters, 2 * equations.parameters.size + equations.parameters.balls
        index, modes = p.effects.index(self), equations.first_modes
        t, y = samples.t[asked], samples.y[:, asked]
        sigma = np.sign(y[first : first + p.balls])

        def outward(t: Any, y: Any, direction: Any) -> Any:
            """Normal force on each ball over m R_p Ω²; negative where the race does not hold it."""
            mode = Rolling(direction, np.ones(p.balls), np.ones(p.balls))
            acting = equations.in_mode((*modes[:index], mode, *modes[index + 1 :]))
            _, _, solved = equations.accelerations(np, t, y, acting)
            return solved.normal / (p.radii * p.speed**2)

        direction = np.abs(sigma) if ACROSS_RATE in equations.scene.ball_states else sigma
        return at_samples(outward, t, y, direction, at_once=p.traceable)

    def _asked(self, equations: Laws, samples: Samples) -> NDArray[np.intp]:
        """Indices of the samples that are examined first, in their order."""
        p, count = equations.parameters, len(samples.t)
        if count <= 2 * ASKED:
            return np.arange(count)
        first = 2 * p.size + p.balls
        _, speed = equations.scene.rotor.turning(samples.t, samples.y, p.speed)
        slowest = np.abs(samples.y[first : first + p.balls] + speed).min(axis=0)
        return merged(np.argpartition(slowest, ASKED)[:ASKED], np.linspace(0, count - 1, ASKED).astype(np.intp))

    def holding(self, scene: Circumstances) -> Holding | None:
        """Holding of balls by f of their normal force; without friction by none of it."""
        return Holding(self.coefficient, self.weight(scene).value)

    def weight(self, scene: Circumstances) -> EffectInfluence:
        """The largest displacement at which two balls stick beside their places, relative to the axis amplitude."""
        why = "balls stick anywhere within a band about their places"
        if not self.lever_arm or not scene.static_moment:
            return EffectInfluence(0.0, why)
        place = math.acos(-min(scene.imbalance / scene.static_moment, 1.0))
        radius = max(race.pitch_radius for race in scene.races)
        band = friction_band(self.lever_arm, radius, self.ball_radius, (-place, place))
        # However far friction lets them stand apart from their places, the axis moves about as much as without balls.
        most = unbalanced_amplitude(scene, reference_imbalance(scene))
        return EffectInfluence(min(band, most) / weighing_amplitude(scene), why)
