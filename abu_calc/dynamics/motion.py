"""Kinematics that the support, the balls and all effects share, and the loads that effects add.

Chains of balls that move together: joined gaps round each race, and sums over chains.

Sums take as many steps as there are balls. A gap is joined, 1, or open, 0. These are numbers, so one way of summing
serves all modes. The gaps of a race are never all joined, since its balls cannot fill it.
"""

import dataclasses
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass

AnyArray = NDArray[Any]


@dataclass(frozen=True, eq=False)
class Chains:
    """`rings`: the balls of each race that has gaps, in order round it; `joined`: of each gap, ring by ring.

    The gap of the same index lies ahead of a ring's ball, the last one between its last ball and its first.
    """

    rings: tuple[tuple[int, ...], ...]
    joined: AnyArray

    def sums(self, x: AnyArray) -> AnyArray:
        """Sum over the chain of each ball.

        >>> Chains(((0, 1, 2, 3),), np.array((1.0, 0.0, 0.0, 1.0))).sums(np.array((1.0, 2.0, 4.0, 8.0))).tolist()
        [11.0, 11.0, 4.0, 11.0]
        """
        return x + self._gathered(x, self._gaps) + self._gathered(x, self._turned)

    def behind(self, x: AnyArray) -> AnyArray:
        """Sum over each ball and all of its chain behind it."""
        return x + self._gathered(x, self._gaps)

    def ahead(self, x: AnyArray) -> AnyArray:
        """Sum over each ball and all of its chain ahead of it."""
        return x + self._gathered(x, self._turned)

    @cached_property
    def _gaps(self) -> list[tuple[tuple[int, ...], list[Any]]]:
        """Each ring with its gaps."""
        ring_gaps, first = [], 0
        for ring in self.rings:
            ring_gaps.append((ring, list(self.joined[first : first + len(ring)])))
            first += len(ring)
        return ring_gaps

    @property
    def _turned(self) -> list[tuple[tuple[int, ...], list[Any]]]:
        """The same, the other way round."""
        return [(ring[::-1], [*gaps[-2::-1], gaps[-1]]) for ring, gaps in self._gaps]

    def leads(self, balls: int) -> AnyArray:
        """1 for the last ball of each chain, 0 for those that have a joined gap behind them."""
        flags: list[Any] = [1.0] * balls
        for ring, gaps in self._gaps:
            for place, ball in enumerate(ring):
                flags[ball] = 1.0 - gaps[place - 1]
        return np.array(flags)

    def together(self, balls: int) -> AnyArray:
        """n × n: 1 for balls of one chain; for numbers alone."""
        unity = np.eye(balls)
        return np.array([self.sums(row) for row in unity])

    def _gathered(self, x: AnyArray, rings: list[tuple[tuple[int, ...], list[Any]]]) -> AnyArray:
        """Sum over the chain before each ball in its ring; zero if that gap is open."""
        sums: list[Any] = [0.0] * len(x)
        for ring, gaps in rings:
            for before, ball, gap in zip(ring, ring[1:], gaps, strict=False):
                sums[ball] = gap * (x[before] + sums[before])
            wrapped, share = x[ring[-1]] + sums[ring[-1]], gaps[-1]
            for ball, gap in zip(ring[:-1], gaps, strict=False):
                sums[ball] = sums[ball] + share * wrapped
                share = share * gap
        return np.array(sums)


"""Array of numbers, complex numbers or symbols."""


@dataclasses.dataclass(slots=True)
class Motion:
    """Places and speeds of everything at one time.

    Angles γ = θ + turn of the balls are inertial; e_r = (cos γ, sin γ), e_t = (−sin γ, cos γ). `support`:
    (q, q'); `turn`, `speed`: of the rotor, inertial; `own_speed`: against what carries it; `acceleration`
    as far as it is given; `swing`: γ' of each ball; `static_moments`: m R; `offset`: where the races'
    centres stand off the axis [m], x and y; `rolled`: speed of the balls' rolling across the race [m/s] if
    they have that freedom; None without.
    """

    xp: Any
    t: Any
    support: AnyArray
    theta: AnyArray
    rate: AnyArray
    turn: Any
    speed: Any
    own_speed: Any
    acceleration: Any
    sin: AnyArray
    cos: AnyArray
    swing: AnyArray
    radii: AnyArray
    static_moments: AnyArray
    offset: Any = None
    rolled: Any = None


@dataclasses.dataclass(slots=True)
class Axial:
    """Motion of balls along the spindle.

    `lever` (d × n), `carried` acceleration (n), `slope`: displacement along the spindle per displacement
    round (n).
    """

    lever: Any
    carried: Any
    slope: Any


@dataclasses.dataclass(slots=True)
class Leaning:
    """A race that leans: where its balls stand along the spindle, and how fast [m, m/s]."""

    height: AnyArray
    rise: AnyArray


@dataclasses.dataclass(slots=True)
class Levers:
    """Levers from the frame, whose accelerations are A (d), to the balls.

    `along`, `outward` (d × n): acceleration of a ball's place in the race along e_t and e_r per unit A.
    `mass` (d × d): inertia of the frame with balls at rest in their races, None if it is to be summed up.
    `carried_along`, `carried_outward` (n): acceleration of that place without any A, besides going round;
    None for nothing. `axial`, `leaning`: set if balls move along the spindle, and if they do so because
    their race tilts.
    """

    along: AnyArray
    outward: AnyArray
    mass: AnyArray | None
    carried_along: Any = None
    carried_outward: Any = None
    axial: Axial | None = None
    leaning: Leaning | None = None
    sunk: Any = None
    """Decrease of R_p², seen along the spindle, by the lean of the race [m²]; with `axial`."""
    sinking: Any = None
    """γ' times its rate."""

    def carry(self, along: Any, outward: Any) -> None:
        """Add to the acceleration with which the races are carried along."""
        self.carried_along = along if self.carried_along is None else self.carried_along + along
        self.carried_outward = outward if self.carried_outward is None else self.carried_outward + outward


@dataclasses.dataclass(slots=True)
class Across:
    """One more direction in which each ball can move: its lever (d × n), inertia per ball mass, what drives it (n).

    `outward` (n): way along e_r per way in this direction, with which `press` acts on it too; `grip`, `free`: as in
    `Loads`, set by the same effect as there.
    """

    along: AnyArray
    inertia: Any
    drive: AnyArray
    outward: AnyArray
    grip: Any = None
    free: Any = None

    @property
    def give(self) -> Any:
        """Acceleration by force per ball mass."""
        return (1.0 if self.free is None else self.free) / self.inertia


@dataclasses.dataclass(slots=True)
class Constraint:
    """A constraint row · A = value; its reaction acts on the frame along `force`.

    `holds`: 1, or 0 while it does not; `beside`: one more, which has none beside it.
    """

    row: AnyArray
    value: Any
    force: AnyArray
    holds: Any = 1.0
    beside: "Constraint | None" = None


@dataclasses.dataclass(slots=True)
class Loads:
    """Loads that effects add; None: nothing, at no cost.

    Slots that ADD, by `add`: `pull`, `press` (n), forces on the balls per ball mass along e_t and e_r;
    `frame` (d), forces on the frame.

    Set by ONE effect, by `own`: `grip` (n), dry friction along −e_t per normal force, signed; `free` (n),
    1, or 0 for a ball that sticks; `hold` (n), largest friction that holds balls in place, per normal
    force, negative like it on the inner side of a race; `mates`, which balls move together; `leads` (n), 1
    for the last of each of these; `across`, one more direction of motion; `bound`, a constraint of the
    frame.
    """

    pull: Any = None
    press: Any = None
    frame: Any = None
    grip: Any = None
    free: Any = None
    mates: Chains | None = None
    leads: Any = None
    hold: Any = None
    across: Across | None = None
    bound: Constraint | None = None

    def add(self, **more: Any) -> None:
        """Add to `pull`, `press` or `frame`."""
        for name, value in more.items():
            before = getattr(self, name)
            setattr(self, name, value if before is None else before + value)

    def own(self, **slots: Any) -> None:
        """Set slots that nobody else has set. Raises InputError where two effects want the same one."""
        for name, value in slots.items():
            if getattr(self, name) is not None:
                raise InputError(f"two effects of the scene both want to say what is `{name}` of its loads")
            setattr(self, name, value)


@dataclasses.dataclass(slots=True)
class Solved:
    """Accelerations at one time: of the frame A (d), of the balls along the race R_p θ'' (n), of the support q'' (N).

    `normal` (n): normal force of ball and race per ball mass, None where no effect asks for it; `across` (n): of the
    second direction; `rotor`: of the rotor, inertial less the support's; `reaction` of a constraint and `beside` of the
    one beside it [N]; `left` (n): force along the race per ball mass that neighbours or the race take from balls that
    move together or stick; `across_left` (n): all force in the second direction.
    """

    frame: AnyArray
    balls: AnyArray
    support: AnyArray
    normal: Any
    across: Any
    rotor: Any
    reaction: Any
    beside: Any = None
    left: Any = None
    across_left: Any = None
