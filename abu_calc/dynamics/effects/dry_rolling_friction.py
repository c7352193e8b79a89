"""Dry rolling friction: a ball stands still in its race until it is pulled harder than f times its normal force.

    |F| ≤ f n on a ball that sticks,    F = −f n θ'/|θ'| on one that rolls,    f = k_r/r

F and n are forces of race and ball per ball mass, along the race and normal to it. Stick is exact: θ' is 0, and an
event ends it; the sign of θ' is never smoothed. Balls that move together stick or roll together, by the sums of their
forces. A ball that also rolls across its race, by v, is rubbed against its whole velocity, −f n (R_p θ', v)/|…|: so
transverse motion shakes dry friction out. Source: Coulomb's rolling friction with the lever arm k_r; balls may rest
where |Im(w e^{−iθ})| ≤ f R_p.
"""

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from abu_calc.dynamics.effects.effect import Effect, Kind, Weight
from abu_calc.dynamics.motion import Levers, Loads, Motion, Solved
from abu_calc.dynamics.parameters import Array, Parameters
from abu_calc.dynamics.receptance import reference_moment, unbalanced_amplitude, weighing_amplitude
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import NotTrustworthyError
from abu_calc.sizing.budget import friction_band
from abu_calc.validity import Range

if TYPE_CHECKING:
    from abu_calc.dynamics.modes import Moment

AT_REST = 1e-9
"""A ball slower than this, relative to the slow motion of the balls, is at rest: events are located no better."""

HOLD = 1e-7
"""A ball is let go when pulled by this much more, relatively, than friction holds, so that it leaves with certainty."""

SLOW = 1e-6
"""Where balls move across the race too, one starts with this speed, relative to R_p Ω, in the direction of the force
that overcomes friction, and may stick again at half of it: at rest it has no direction."""

LEAVES = 1e-4
"""A normal force below −1e-4 m R_p Ω² is a ball that has left its race; near standstill it means nothing."""


@dataclass(frozen=True)
class DryRollingFriction(Effect):
    """`lever_arm` k_r [m], `ball_radius` r [m].

    Mode: per ball 0 where it sticks, ±1 the direction it rolls in; where balls move across the race too 1 for any.
    """

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
        """All balls stick; None without friction."""
        return np.zeros(len(scene.ball_masses)) if self.lever_arm and scene.ball_masses else None

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """±f per normal force on balls that roll; balls that stick do not move."""
        if mode is None:
            return
        f = self.coefficient
        if loads.across is None:
            loads.grip, loads.free, loads.hold = f * mode, mode * mode, f + 0.0 * mode
            return
        along = m.radii * m.rate
        # Balls that stick have no velocity, and need none.
        share = f * mode / m.xp.sqrt(mode * (along * along + m.rolled * m.rolled) + (1 - mode))
        loads.grip, loads.free, loads.hold = share * along, mode, f * (1 - mode)
        loads.across.grip, loads.across.free = share * m.rolled, mode

    def watch(self, m: Motion, mode: Any, own: Any, loads: Loads, solved: Solved, p: Parameters) -> list[Any]:
        """Rolling on: σ θ'/Ω, or the speed squared. Sticking: (f n)² − F². In the race: n. Relative to f m R_p Ω²."""
        if mode is None:
            return []
        pull, aside, most = self._forces(loads, solved, p)
        flung = p.radii * p.speed**2
        unit = self.coefficient * p.masses * flung
        holds = ((1 + HOLD) * most * most - pull * pull - aside * aside) / (unit * unit)
        rolls, goes_on = loads.free, mode * m.rate / p.speed
        if loads.across is not None:
            whole, along, rolled = p.radii * p.speed, m.radii * m.rate / (p.radii * p.speed), m.rolled
            goes_on = along * along + (rolled / whole) * (rolled / whole) - (SLOW / 2) ** 2
        pressed = solved.normal / flung + LEAVES
        return [*(rolls * goes_on + (1 - rolls)), *((1 - rolls) * holds + rolls), *pressed]

    def _forces(self, loads: Loads, solved: Solved, p: Parameters) -> tuple[Any, Any, Any]:
        """What pulls balls along and across the race, and what friction can take of it; of balls together their sum."""
        pull, most = p.masses * solved.left, self.coefficient * p.masses * solved.normal
        aside = 0.0 * pull if loads.across is None else p.masses * solved.across_left
        if loads.mates is None:
            return pull, aside, most
        return loads.mates.dot(pull), loads.mates.dot(aside), loads.mates.dot(most)

    def settle(self, moment: "Moment") -> tuple[Any, Any]:
        """Which balls stick and which roll; balls that come to rest get the speed 0 exactly.

        Raises NotTrustworthyError when a ball leaves its race, or when no combination is consistent.
        """
        if moment.mode is None:
            return moment.y, moment.mode
        p, first = moment.parameters, 2 * moment.parameters.size + moment.parameters.balls
        rates = moment.y[first : first + p.balls]
        motion, loads, _ = moment.solved(moment.mode)
        if loads.across is not None:
            return self._settled_across(moment, motion, loads)
        # One ball of those that move together decides for all.
        leader = np.arange(p.balls) if loads.mates is None else loads.mates.argmax(axis=1)
        rests = (np.abs(rates) <= AT_REST * moment.equations.scales[first])[leader]
        if np.any(rates[rests] != 0):
            y = moment.y.copy()
            y[first : first + p.balls][rests] = 0.0
            moment = replace(moment, y=y)
        sigma = self._decided(moment, rests, np.where(rests, 0.0, np.sign(rates[leader])), leader)
        return moment.y, moment.mode if np.array_equal(sigma, moment.mode) else sigma

    def _decided(self, moment: "Moment", rests: Array, sigma: Array, leader: Array) -> Array:
        """Directions of all balls, those at rest by what acts on them.

        From all sticking, every ball whose assumption fails changes it, and after some rounds only the first of them.
        The accelerations of the balls answer forces on them by a symmetric positive definite matrix, of which a small f
        takes nothing, and for such problems this ends (Júdice & Pires 1994, block principal pivoting).
        """
        balls = len(rests)
        for attempt in range(20 + 10 * balls):
            wrong, better = self._failing(moment, sigma)
            wrong, better = rests & wrong[leader], better[leader]
            if not wrong.any():
                return sigma
            if attempt > 10 + balls:
                wrong &= leader == leader[wrong.argmax()]
            sigma = np.where(wrong, better, sigma)
        raise NotTrustworthyError(
            f"at t = {moment.t:.6g} s no combination of sticking and rolling balls is consistent\n"
            f"  friction of {self.coefficient:g} times the normal force is far from a rolling ball's: check it"
        )

    def _failing(self, moment: "Moment", sigma: Array) -> tuple[Array, Array]:
        """Which balls, were they at rest, could not go on in their directions, and what is better for them."""
        _, loads, solved = moment.solved(sigma)
        p = moment.parameters
        self._check_pressed(moment, solved.normal / (p.radii * p.speed**2))
        pull, _, most = self._forces(loads, solved, p)
        slips, stops = np.abs(pull) > (1 + HOLD / 4) * np.maximum(most, 0.0), sigma * solved.balls < 0
        return np.where(sigma == 0, slips, stops), np.where(sigma == 0, np.sign(pull), 0.0)

    def _settled_across(self, moment: "Moment", motion: Motion, loads: Loads) -> tuple[Any, Any]:
        """The same where balls move across the race too: what friction cannot hold starts in the force's direction.

        Balls are let go one after the other, and none is held again, so this ends.
        """
        p, y = moment.parameters, moment.y.copy()
        along, across = _rate_places(p)
        slow = SLOW * p.radii * p.speed
        rolls = np.hypot(motion.radii * motion.rate, motion.rolled) > np.where(moment.mode > 0, 0.6, 1e-3) * slow
        rolls = rolls if loads.mates is None else loads.mates.dot(rolls) > 0
        held = ~rolls
        y[along][held] = y[across][held] = 0.0
        for _ in range(p.balls + 1):
            mode = np.where(held, 0.0, 1.0)
            _, loads, solved = replace(moment, y=y).solved(mode)
            self._check_pressed(moment, solved.normal / (p.radii * p.speed**2))
            pull, aside, most = self._forces(loads, solved, p)
            starts = held & (np.hypot(pull, aside) > (1 + HOLD / 4) * np.maximum(most, 0.0))
            if not starts.any():
                break
            force = np.hypot(pull, aside)[starts]
            y[along][starts] = (slow / motion.radii)[starts] * pull[starts] / force
            y[across][starts] = slow[starts] * aside[starts] / force
            held = held & ~starts
        same = np.array_equal(y, moment.y)
        return (moment.y if same else y), moment.mode if np.array_equal(mode, moment.mode) else mode

    def _check_pressed(self, moment: "Moment", normal: Array) -> None:
        """Refuse balls that are off their race."""
        if np.any(normal < -LEAVES / 2):
            ball = int(normal.argmin()) + 1
            raise NotTrustworthyError(
                f"ball {ball} leaves its race at t = {moment.t:.6g} s, where dry rolling friction means nothing\n"
                "  raise the speed, damp the support, or leave dry_rolling_friction out"
            )

    def power(self, m: Motion, mode: Any, own: Any, solved: Solved, p: Parameters) -> Any:
        """−Σ m f n |(R_p θ', v)| [W]."""
        if mode is None:
            return 0.0
        speed = mode * m.radii * m.rate
        if m.rolled is not None:
            along = m.radii * m.rate
            speed = mode * m.xp.sqrt(mode * (along * along + m.rolled * m.rolled) + (1 - mode))
        return -self.coefficient * (p.masses * solved.normal).dot(speed)

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


def _rate_places(p: Parameters) -> tuple[slice, slice]:
    """Where the state holds the speeds of the balls along and across the race."""
    first, place = 2 * p.size + p.balls, 2 * (p.size + p.balls)
    for effect in p.effects:
        if "across'" in effect.ball_states:
            place += effect.ball_states.index("across'") * p.balls
            break
        place += len(effect.ball_states) * p.balls
    return slice(first, first + p.balls), slice(place, place + p.balls)
