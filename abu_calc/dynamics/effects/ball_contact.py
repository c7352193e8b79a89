"""Ball contact: balls of one race cannot pass each other; they meet, press and lose contact.

    gap between neighbours ≥ 2β,    sin β = r/R_p

An impact leaves −e times the speed of approach; it acts on all balls and the support by the full mass matrix. Pairs
that touch with equal speeds press with λ ≥ 0 and move together, or part. With dry friction, which of them press and
which of them stick is one problem. An impact knows no friction. Source: Newton's impact law, pair by pair; for the rest
Glocker 2001, Set-Valued Force Laws.

Balls that touch in a row have no order of impacts of their own: rigid balls pass an impact on in no time. The rule is
that pairs meet one after the other, the fastest approach first. It passes an elastic impact to the end of a row, keeps
momentum, and never adds energy; Newton's law for all pairs at once would share the impact among the whole
row. Worth of the order: six equal balls, e = 0.5, hit at 1200°/s, leave with speeds that differ by up to 0.9 % of the
hit if the pair farthest ahead is taken first, 2° in 0.18 s; nothing for e = 0, where all move together, and e = 1.
Approaches so slow that the rebound would lift the balls by less than `LIFT` before they are pressed together
again are resolved at once: those pairs get equal speeds. Without that balls would bounce without end. The cost of a
scene is its number of impacts times that of an impact, which grows with the pairs that touch: pressed elastic balls
bounce ever faster as they come to rest.
"""

import math
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from abu_calc.dynamics.effect import BallRadius, Effect, EffectInfluence, Kind, Rule, SwitchPoint
from abu_calc.dynamics.motion import AnyArray, Chains, Levers, Loads, Motion, Solved
from abu_calc.dynamics.rotor import Parameters, Race
from abu_calc.dynamics.support import Circumstances
from abu_calc.dynamics.switching.ball_impacts import Responses, approaches, impacts, pressing, responses
from abu_calc.dynamics.switching.stick_slip import AT_REST
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.inputs.reading.table import Table, entry

TOUCHING = 1e-9
"""Gaps [rad] up to this are closed: events are located no better."""

GRAZING, LIFT = 1e-6, 1e-6
"""A rebound slower than the first, relative to the slow motion of the balls, or that would part the two by less than
the second [rad] before they are pressed together again, is none: else they would bounce without end."""

MARGIN = 1e-9
"""A pair parts when it would have to be pulled together by this much of m R_p Ω², so that it parts with certainty."""

DIP, DEEPEST = 10.0, 1e-6
"""An interpolated motion may bring balls together again that are parting: such a gap counts as closed only when it is
deeper [rad] by the first factor each time, up to the second."""


@dataclass(frozen=True, eq=False)
class Neighbours:
    """Gaps between neighbours, race by race, and which of them are closed for good.

    Gap i: θ[ahead] − θ[behind] + turns; it may not fall below `least`. `joined`: 1 where the two move together.
    `rings`: see Chains. `tied`: whether the equations know of joined gaps; False where none is.
    """

    behind: tuple[int, ...]
    ahead: tuple[int, ...]
    turns: AnyArray
    touching: AnyArray
    least: AnyArray
    joined: AnyArray
    rings: tuple[tuple[int, ...], ...]
    tied: bool = False

    @property
    def chains(self) -> Chains:
        """Balls that move together."""
        return Chains(self.rings, self.joined)

    def gaps(self, theta: AnyArray) -> AnyArray:
        """All gaps [rad]."""
        gaps: AnyArray = theta[list(self.ahead)] - theta[list(self.behind)] + self.turns
        return gaps

    def joining(self, joined: AnyArray, theta: AnyArray) -> "Neighbours":
        """The same balls with other gaps joined, at these angles."""
        gaps, rounding = self.gaps(theta), _rounding(theta)
        # One that has come to its bound again though it parts may dip deeper.
        dips = (joined == 0) & (self.joined == 0) & (gaps < self.least + rounding / 2) & (self.least < self.touching)
        deeper = np.where(dips, np.minimum(DIP * (self.touching - self.least), DEEPEST), 0.0)
        least = np.minimum(self.touching - deeper, gaps - rounding)
        return replace(self, joined=joined, least=least, tied=bool(joined.any()))


def _rounding(theta: AnyArray) -> float:
    """Tolerance [rad] by which a gap that opens may fall short of 2β."""
    return float(1e-13 + 8 * np.spacing(np.abs(theta).max()))


class BallContact(Table):
    """Balls have a size: neighbours meet, press and part. Without it they pass through each other."""

    ball_radius_mm: BallRadius
    restitution: float = entry(0.5, ge=0, le=1).means(
        "Speed after an impact over the speed before it; {range}. Default: {default}, assumed."
    )


@dataclass(frozen=True)
class BallContactEffect(Effect):
    """`ball_radius` r [m], `restitution` e, 0 … 1. Mode: `Neighbours`; None where no race has two balls."""

    ball_radius: float
    restitution: float

    name: ClassVar[str] = "ball_contact"
    keys = BallContact
    kind: ClassVar[Kind] = "dissipative"
    stage = "impacts"
    about: ClassVar[str] = "Ball contact: balls of one race cannot pass each other; they collide, press and separate"
    detail: ClassVar[str] = (
        "Rule of impacts: touching pairs collide one after the other, the fastest approach first. Each pair leaves at "
        "-restitution times its speed of approach. For balls that touch in a row, physics gives no order of impacts. "
        "This order passes an elastic impact to the end of a row, keeps momentum and never adds energy. Another order "
        "changes speeds by up to 0.9 % of the impact speed (six equal balls, restitution 0.5). That is 2° in 0.18 s "
        "after an impact at 1200°/s, and nothing for restitution 0 or 1. Rebounds that would separate pressed balls by "
        "less than 1e-6 rad (up to 1e-4 rad at a loose tolerance) are left out. Such pairs move together at once. The "
        "cost is the number of impacts, which grows fast for many pressed balls with a restitution near 1."
    )
    switches: ClassVar[bool] = True
    balls_meet: ClassVar[bool] = True

    def __post_init__(self) -> None:
        Range("ball radius", 0, math.inf, "m", open_low=True).check(self.ball_radius)
        Range("restitution", 0, 1).check(self.restitution)

    def first_mode(self, scene: Circumstances) -> Any:
        """The neighbours at the start, none joined. Raises InputError where balls overlap or fill their race."""
        behind: list[int] = []
        ahead: list[int] = []
        turns: list[float] = []
        spans: list[float] = []
        rings: list[tuple[int, ...]] = []
        for race, own in scene.by_race(range(len(scene.ball_masses))):
            ring = tuple(own[k] for k in _order(race))
            if len(ring) > 1:
                behind += ring
                ahead += (*ring[1:], ring[0])
                turns += _turns(race)
                spans += [self._span(race)] * len(ring)
                rings.append(ring)
        if not behind:
            return None
        least, theta = np.array(spans), np.array(scene.start_angles)
        none = np.zeros(len(least))
        neighbours = Neighbours(tuple(behind), tuple(ahead), np.array(turns), least, least, none, tuple(rings))
        _check_apart(neighbours, theta)
        return neighbours.joining(none, theta)

    def _span(self, race: Race) -> float:
        """2β [rad]. Raises InputError where the balls do not fit."""
        balls = len(race.ball_masses)
        half = math.asin(self.ball_radius / race.pitch_radius) if self.ball_radius < race.pitch_radius else math.pi
        if 2 * half * balls > 2 * math.pi - 1e-6:
            raise InputError(
                "the balls fill their race and cannot move against each other",
                found=f"{balls} balls of {self.ball_radius:g} m on a pitch radius of {race.pitch_radius:g} m",
                allowed=f"at most {int((math.pi - 1e-6) / half)} balls",
                remedy="fewer or smaller balls; or leave ball_contact out",
            )
        return 2 * half

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """Joined balls move together."""
        if mode is not None and mode.tied:
            loads.own(mates=mode.chains, leads=mode.chains.leads(p.balls))

    def watch(self, m: Motion, mode: Any, own: Any, loads: Loads, solved: Solved, p: Parameters) -> list[Any]:
        """Watched values of each gap: gap − 2β while open, two torques while joined.

        The torques are the push of the chain behind and the resistance of the chain ahead. Balls that move
        press by what their own inertia leaves over. If they stick, friction takes up to f n of each; every
        distribution of forces in which no ball pulls another then holds.
        """
        if mode is None:
            return []
        gaps, joined = mode.gaps(m.theta) - mode.least, mode.joined
        if not mode.tied:
            return [*gaps]
        left, unit = m.static_moments * solved.left, self._margin(p)
        held = 0.0 * left if loads.hold is None else loads.hold * m.static_moments * solved.normal * (1 - loads.free)
        push = mode.chains.behind(left + held)[list(mode.behind)] / unit + 1
        resist = mode.chains.ahead(held - left)[list(mode.ahead)] / unit + 1
        return [*((1 - joined) * gaps + joined), *(joined * push + (1 - joined)), *(joined * resist + (1 - joined))]

    def _margin(self, p: Parameters) -> Any:
        """Torque between two balls that counts as none [N m]."""
        return MARGIN * (p.static_moments * p.radii).mean() * p.speed**2

    def rule(self, mode: Any) -> Rule | None:
        """Touching pairs stay together or part."""
        return None if mode is None else Rule("ball contact", self.restitution)

    def settle(self, at: SwitchPoint) -> tuple[Any, Any]:
        """Impacts of what meets; then which of the touching pairs press and stay together."""
        mode: Neighbours | None = at.mode
        if mode is None:
            return at.y, mode
        p, first = at.parameters, 2 * at.parameters.size
        theta, rates = at.y[first : first + p.balls], slice(first + p.balls, first + 2 * p.balls)
        touching = np.flatnonzero((mode.joined > 0) | (mode.gaps(theta) - mode.touching <= TOUCHING))
        joined = np.zeros(len(mode.joined))
        if len(touching):
            answer = responses(at, [mode.behind[i] for i in touching], [mode.ahead[i] for i in touching])
            slow = at.equations.scales[rates.start]
            y = self._after_impacts(answer, at.y, rates, slow, self._margin(p) / 2)
            at = replace(at, y=y)
            joined[touching] = self._pressing(answer, y[rates], slow, self._margin(p) / 2, mode.joined[touching])
        # A gap that has just been found to open must be clearly above its bound, or rounding would close it at once.
        least = mode.least + _rounding(theta) / 2
        if np.array_equal(joined, mode.joined) and np.all((mode.gaps(theta) >= least) | (joined > 0)):
            return at.y, mode
        return at.y, mode.joining(joined, theta)

    def _after_impacts(self, answer: Responses, y: AnyArray, rates: slice, slow: float, margin: float) -> AnyArray:
        """The state after all impacts; the very same where there are none."""
        rest = AT_REST * slow / 10
        if not np.any(answer.pairs.dot(y[rates]) < -rest):
            return y
        _, torques = pressing(answer, np.sign(y[rates]), np.ones(len(answer.pairs)), margin)
        lifts = np.sqrt(2 * LIFT * approaches(answer, torques))
        return impacts(answer, y, rates, self.restitution, GRAZING * slow + lifts, rest)

    def _pressing(self, answer: Responses, rates: AnyArray, slow: float, margin: float, joined: AnyArray) -> AnyArray:
        """1 for each touching pair that stays together."""
        rest = AT_REST * slow
        together = np.abs(answer.pairs.dot(rates)) <= rest
        pressed = np.zeros(len(together))
        directions = np.where(np.abs(rates) <= rest, 0.0, np.sign(rates))
        pressed[together], _ = pressing(answer.among(together), directions, joined[together], margin)
        return pressed

    def weight(self, scene: Circumstances) -> EffectInfluence:
        """Influence without an estimate: without this effect balls pass through each other."""
        return EffectInfluence(None, "balls that meet stop each other; without it they would pass")


def _order(race: Race) -> list[int]:
    """The balls of a race as they stand round it."""
    return sorted(range(len(race.ball_masses)), key=lambda k: race.start_angles[k] % (2 * math.pi))


def _turns(race: Race) -> list[float]:
    """Full turns [rad] that make each gap the angle from a ball to the next."""
    angles, order = race.start_angles, _order(race)
    whole = [angles[k] - angles[k] % (2 * math.pi) for k in order]
    following = [*whole[1:], whole[0] - 2 * math.pi] if whole else []
    return [here - after for here, after in zip(whole, following, strict=True)]


def _check_apart(neighbours: Neighbours, theta: AnyArray) -> None:
    """Refuse balls that overlap at the start."""
    short = neighbours.touching - neighbours.gaps(theta)
    if np.any(short > TOUCHING):
        worst = int(short.argmax())
        ball, other = sorted((neighbours.behind[worst] + 1, neighbours.ahead[worst] + 1))
        raise InputError(
            f"balls {ball} and {other} overlap at the start",
            found=f"{math.degrees(neighbours.gaps(theta)[worst]):g}° apart",
            allowed=f"at least {math.degrees(neighbours.touching[worst]):g}°",
            remedy="part them, or leave ball_contact out",
        )
