"""Dry rolling friction: a ball stands still in its race until it is pulled harder than f times its normal force.

    |F| ≤ f |n| on a ball that sticks,    F = −f |n| θ'/|θ'| on one that rolls,    f = k_r/r

F and n are forces of race and ball per ball mass, along the race and normal to it. The race is closed on both sides: a
ball that its outer side does not press inward, n < 0, is held by the inner one, and rubs there. Stick is exact: θ' is
0, and an event ends it; the signs of θ' and n are never smoothed. Balls that move together stick or roll together, by
the sums of their forces. A ball that also rolls across its race, by v, is rubbed against its whole velocity,
−f |n| (R_p θ', v)/|…|: so transverse motion shakes dry friction out. Source: Coulomb's rolling friction with the lever
arm k_r; balls may rest where |Im(w e^{−iθ})| ≤ f R_p. The inner side is taken to be as hard as the outer one.
"""

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from abu_calc.dynamics.effects.effect import Effect, Kind, Weight
from abu_calc.dynamics.equations import accelerations, loaded
from abu_calc.dynamics.motion import Levers, Loads, Motion, Solved
from abu_calc.dynamics.parameters import Array, Parameters
from abu_calc.dynamics.receptance import reference_moment, unbalanced_amplitude, weighing_amplitude
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import NotTrustworthyError
from abu_calc.sizing.budget import friction_band
from abu_calc.validity import Range

if TYPE_CHECKING:
    from abu_calc.dynamics.modes import Moment
    from abu_calc.dynamics.trajectory import Trajectory

AT_REST = 1e-9
"""A ball slower than this, relative to the slow motion of the balls, is at rest: events are located no better."""

HOLD = 1e-7
"""A ball is let go when pulled by this much more, relatively, than friction holds, so that it leaves with certainty."""

SLOW = 1e-6
"""Where balls move across the race too, one starts with this speed, relative to R_p Ω, in the direction of the force
that overcomes friction, and may stick again at half of it: at rest it has no direction. Less where drag would stop it:
then with the speed at which drag takes what friction leaves over, at least 1e-6 of it."""

CROSSES = 1e-7
"""A ball changes sides when pulled from one with this much of m R_p Ω², so that it changes with certainty."""

LEAVES = 1e-4
"""A ball pulled inward by more of m R_p Ω² than this is told of: near standstill less means nothing."""


@dataclass(frozen=True, eq=False)
class Rolling:
    """Per ball: `direction` 0 where it sticks, ±1 the way it rolls, where it moves across the race too 1 for any.

    `side`: 1 where it is pressed to the outer side of its race, −1 to the inner one. `begun`: the speed with which it
    started where it moves across too, relative to `SLOW`.
    """

    direction: Array
    side: Array
    begun: Array

    def like(self, other: "Rolling") -> bool:
        """Whether both say the same."""
        return all(np.array_equal(getattr(self, part), getattr(other, part)) for part in ("direction", "side", "begun"))


@dataclass(frozen=True)
class DryRollingFriction(Effect):
    """`lever_arm` k_r [m], `ball_radius` r [m]. Mode: `Rolling`; None without friction."""

    lever_arm: float
    ball_radius: float

    name: ClassVar[str] = "dry_rolling_friction"
    kind: ClassVar[Kind] = "dissipative"
    switches: ClassVar[bool] = True

    def __post_init__(self) -> None:
        radius = Range("ball radius", 0, math.inf, "m", open_low=True).check(self.ball_radius)
        Range("lever arm of rolling friction", 0, radius, "m").check(self.lever_arm)

    @property
    def coefficient(self) -> float:
        """f = k_r/r."""
        return self.lever_arm / self.ball_radius

    def first_mode(self, scene: Scene) -> Any:
        """All balls stick, pressed outward; None without friction."""
        balls = len(scene.ball_masses)
        return Rolling(np.zeros(balls), np.ones(balls), np.ones(balls)) if self.lever_arm and balls else None

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """±f per normal force on balls that roll; balls that stick do not move."""
        if mode is None:
            return
        sigma, f = mode.direction, self.coefficient * mode.side
        if loads.across is None:
            loads.grip, loads.free, loads.hold = f * sigma, sigma * sigma, f + 0.0 * sigma
            return
        along = m.radii * m.rate
        # Balls that stick have no velocity, and need none.
        share = f * sigma / m.xp.sqrt(sigma * (along * along + m.rolled * m.rolled) + (1 - sigma))
        loads.grip, loads.free, loads.hold = share * along, sigma, f * (1 - sigma)
        loads.across.grip, loads.across.free = share * m.rolled, sigma

    def watch(self, m: Motion, mode: Any, own: Any, loads: Loads, solved: Solved, p: Parameters) -> list[Any]:
        """Rolling on: σ θ'/Ω, or the speed squared. Sticking: (f n)² − F². On its side: s n. Relative to f m R_p Ω².

        The first of balls that move together stands for all.
        """
        if mode is None:
            return []
        pull, aside, most = self._forces(m, mode, loads, solved, p)
        flung = p.radii * p.speed**2
        unit = self.coefficient * p.masses * flung
        holds = ((1 + HOLD) * most * most - pull * pull - aside * aside) / (unit * unit)
        lead = 1.0 if loads.leads is None else loads.leads
        rolls, sticks, goes_on = lead * loads.free, lead * (1 - loads.free), mode.direction * m.rate / p.speed
        if loads.across is not None:
            whole, least = p.radii * p.speed, SLOW / 2 * mode.begun
            along, rolled = m.radii * m.rate / whole, m.rolled / whole
            goes_on = along * along + rolled * rolled - least * least
        pressed = mode.side * solved.normal / flung + CROSSES
        return [*(rolls * goes_on + (1 - rolls)), *(sticks * holds + (1 - sticks)), *pressed]

    def _forces(self, m: Motion, mode: Rolling, loads: Loads, solved: Solved, p: Parameters) -> tuple[Any, Any, Any]:
        """What pulls balls along and across the race, and what friction can take of it, times R/R_p.

        Of balls together their sums: torques, for their angles are bound.
        """
        masses = m.moments / p.radii
        pull, most = masses * solved.left, self.coefficient * masses * (mode.side * solved.normal)
        aside = 0.0 * pull if loads.across is None else masses * solved.across_left
        if loads.mates is None:
            return pull, aside, most
        return loads.mates.dot(pull), loads.mates.dot(aside), loads.mates.dot(most)

    def settle(self, moment: "Moment") -> tuple[Any, Any]:
        """Which balls stick and which roll, and on which side; balls that come to rest get the speed 0 exactly.

        Raises NotTrustworthyError when no combination is consistent.
        """
        mode: Rolling | None = moment.mode
        if mode is None:
            return moment.y, mode
        p, first = moment.parameters, 2 * moment.parameters.size + moment.parameters.balls
        rates = moment.y[first : first + p.balls]
        motion, _, loads = loaded(np, moment.t, moment.y, p)
        if loads.across is not None:
            return self._settled_across(moment, motion, loads)
        # One ball of those that move together decides for all.
        leader = np.arange(p.balls) if loads.mates is None else loads.mates.argmax(axis=1)
        rests = (np.abs(rates) <= AT_REST * moment.equations.scales[first])[leader]
        if np.any(rates[rests] != 0):
            y = moment.y.copy()
            y[first : first + p.balls][rests] = 0.0
            moment = replace(moment, y=y)
        start = replace(mode, direction=np.where(rests, 0.0, np.sign(rates[leader])))
        found = self._decided(moment, rests, start, leader)
        return moment.y, mode if found.like(mode) else found

    def _decided(self, moment: "Moment", rests: Array, mode: Rolling, leader: Array) -> Rolling:
        """Sides of all balls and directions, of those at rest by what acts on them.

        From all sticking, every ball whose assumption fails changes it, and after some rounds only the first of them.
        The accelerations of the balls answer forces on them by a symmetric positive definite matrix, of which a small f
        takes nothing, and for such problems this ends (Júdice & Pires 1994, block principal pivoting).
        """
        balls = len(rests)
        for attempt in range(20 + 10 * balls):
            wrong, better, mode = self._failing(moment, mode)
            wrong, better = rests & wrong[leader], better[leader]
            if not wrong.any():
                return mode
            if attempt > 10 + balls:
                wrong &= leader == leader[wrong.argmax()]
            mode = replace(mode, direction=np.where(wrong, better, mode.direction))
        raise NotTrustworthyError(
            f"at t = {moment.t:.6g} s no combination of sticking and rolling balls is consistent\n"
            f"  friction of {self.coefficient:g} times the normal force is far from a rolling ball's: check it"
        )

    def _failing(self, moment: "Moment", mode: Rolling) -> tuple[Array, Array, Rolling]:
        """Which balls, were they at rest, could not go on in their directions, and what is better for them.

        And the mode with all balls on the sides to which they are pressed.
        """
        mode, (motion, loads, solved) = self._on_sides(moment, mode)
        pull, _, most = self._forces(motion, mode, loads, solved, moment.parameters)
        sigma = mode.direction
        slips, stops = np.abs(pull) > (1 + HOLD / 4) * np.maximum(most, 0.0), sigma * solved.balls < 0
        return np.where(sigma == 0, slips, stops), np.where(sigma == 0, np.sign(pull), 0.0), mode

    def _on_sides(self, moment: "Moment", mode: Rolling) -> tuple[Rolling, tuple[Motion, Loads, Solved]]:
        """The same directions with all balls pressed to their sides, and what then moves and acts.

        A side changes the normal forces by f times as much, so two rounds do but for a few balls near none.
        """
        p = moment.parameters
        for _ in range(2 + p.balls):
            found = moment.solved(mode)
            wrong = mode.side * found[2].normal < -CROSSES / 2 * p.radii * p.speed**2
            if not wrong.any():
                return mode, found
            mode = replace(mode, side=np.where(wrong, -mode.side, mode.side))
        raise NotTrustworthyError(
            f"at t = {moment.t:.6g} s no side of its race presses a ball consistently\n"
            f"  friction of {self.coefficient:g} times the normal force is far from a rolling ball's: check it"
        )

    def _settled_across(self, moment: "Moment", motion: Motion, loads: Loads) -> tuple[Any, Any]:
        """The same where balls move across the race too: what friction cannot hold starts in the force's direction.

        Balls are let go one after the other, and none is held again, so this ends.
        """
        p, y = moment.parameters, moment.y.copy()
        along, across = _rate_places(p)
        slow = SLOW * p.radii * p.speed
        mode: Rolling = moment.mode
        least = np.where(mode.direction > 0, 0.6 * mode.begun, 1e-3) * slow
        rolls = np.hypot(motion.radii * motion.rate, motion.rolled) > least
        rolls = rolls if loads.mates is None else loads.mates.dot(rolls) > 0
        held = ~rolls
        mode = replace(mode, begun=np.where(held, 1.0, mode.begun))
        y[along][held] = y[across][held] = 0.0
        for _ in range(p.balls + 1):
            start = replace(mode, direction=np.where(held, 0.0, 1.0))
            mode, (_, loads, solved) = self._on_sides(replace(moment, y=y), start)
            pull, aside, most = self._forces(motion, mode, loads, solved, p)
            starts = held & (np.hypot(pull, aside) > (1 + HOLD / 4) * np.maximum(most, 0.0))
            if not starts.any():
                break
            force = np.hypot(pull, aside)
            share = _kept_by_drag(force - most, p) / slow
            mode = replace(mode, begun=np.where(starts, np.clip(share, 1e-6, 1.0), mode.begun))
            speeds = mode.begun * slow / np.where(starts, force, 1.0)
            y[along][starts] = (speeds / motion.radii * pull)[starts]
            y[across][starts] = (speeds * aside)[starts]
            held = held & ~starts
        same = np.array_equal(y, moment.y)
        return (moment.y if same else y), moment.mode if mode.like(moment.mode) else mode

    def power(self, m: Motion, mode: Any, own: Any, solved: Solved, p: Parameters) -> Any:
        """−Σ m f |n| |(R_p θ', v)| [W]."""
        if mode is None:
            return 0.0
        along, sigma = m.radii * m.rate, mode.direction
        speed = sigma * along
        if m.rolled is not None:
            speed = sigma * m.xp.sqrt(sigma * (along * along + m.rolled * m.rolled) + (1 - sigma))
        return -self.coefficient * (p.masses * mode.side * solved.normal).dot(speed)

    def remarks(self, scene: Scene, trajectory: "Trajectory") -> tuple[str, ...]:
        """The first sample at which a ball is off the outer side of its race, counting all balls as rolling."""
        from abu_calc.dynamics.assemble import assemble

        equations = assemble(scene)
        p, first = equations.parameters, 2 * len(scene.support.names) + len(scene.ball_masses)
        index = scene.effects.index(self)
        if p.modes[index] is None:
            return ()
        for t, y in zip(trajectory.t, trajectory.y.T, strict=True):
            sigma = np.sign(y[first : first + p.balls])
            direction = sigma if scene.effect("transverse_motion") is None else np.abs(sigma)
            mode = Rolling(direction, np.ones(p.balls), np.ones(p.balls))
            modes = (*p.modes[:index], mode, *p.modes[index + 1 :])
            outward = accelerations(np, t, y, equations.in_mode(modes))[2].normal / (p.radii * p.speed**2)
            if outward.min() < -LEAVES:
                return (
                    f"dry rolling friction: ball {1 + int(outward.argmin())} is pulled off the outer side of its race "
                    f"at t = {t:.4g} s and rubs on the inner one; a higher speed or a damped support presses it "
                    "outward",
                )
        return ()

    def weight(self, scene: Scene) -> Weight:
        """The largest displacement at which two balls stick beside their places, relative to the axis amplitude."""
        why = "balls stick anywhere within a band about their places"
        if not self.lever_arm or not scene.static_moment:
            return Weight(0.0, why)
        place = math.acos(-min(scene.imbalance / scene.static_moment, 1.0))
        radius = max(race.pitch_radius for race in scene.races)
        band = friction_band(self.lever_arm, radius, self.ball_radius, (-place, place))
        # However far friction lets them stand apart from their places, the axis moves about as much as without balls.
        most = unbalanced_amplitude(scene, reference_moment(scene))
        return Weight(min(band, most) / weighing_amplitude(scene), why)


def _kept_by_drag(force: Array, p: Parameters) -> Array:
    """Speed [m/s] at which drag takes all of a force [N]; infinite without drag."""
    drags = p.masses * p.drags / p.radii
    found: Array = np.divide(force, drags, out=np.full(len(force), math.inf), where=drags > 0)
    return found


def _rate_places(p: Parameters) -> tuple[slice, slice]:
    """Where the state holds the speeds of the balls along and across the race."""
    first, place = 2 * p.size + p.balls, 2 * (p.size + p.balls)
    for effect in p.effects:
        if "across'" in effect.ball_states:
            place += effect.ball_states.index("across'") * p.balls
            break
        place += len(effect.ball_states) * p.balls
    return slice(first, first + p.balls), slice(place, place + p.balls)
