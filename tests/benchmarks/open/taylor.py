"""Reference motions by Taylor series in decimal arithmetic of 34 digits, from the equations of the page.

Each step develops all coordinates to order `ORDER` about its start. Events are roots of the polynomials themselves:
impacts, ends of rolling and ends of sticking. No code, no number format and no method is shared with the other
integrator (`scipy_entry`), whose order is 8 and whose numbers have 16 digits.
"""

from collections.abc import Sequence
from decimal import Decimal, getcontext, localcontext
from typing import Any, Final, NamedTuple

DIGITS: Final = 34
ORDER: Final = 28
LEFT_OUT: Final = Decimal("1e-25")
"""Largest last term of a series, relative to the size of its coordinate."""

PARTS: Final = 12
"""Places of a step at which a watched value is looked at."""

PI: Final = Decimal("3.14159265358979323846264338327950288419716939937510582097494")
ZERO: Final = Decimal(0)
Series = list[Decimal]


class Event(NamedTuple):
    """A change of mode: time [s], kind ("impact", "stick" or "slip") and ball, of an impact the one behind."""

    time: float
    kind: str
    ball: int


def sin_cos(angle: Decimal) -> tuple[Decimal, Decimal]:
    """Sine and cosine by their series.

    >>> [round(float(value), 12) for value in sin_cos(Decimal(30))]
    [-0.988031624093, 0.154251449888]
    """
    with localcontext() as context:
        context.prec = DIGITS + 8
        rest = angle.remainder_near(2 * PI)
        sums, term = [ZERO, ZERO], Decimal(1)
        for k in range(60):
            sums[(k + 1) % 2] += -term if k % 4 > 1 else term
            term = term * rest / (k + 1)
    return +sums[0], +sums[1]


def product(a: Series, b: Series, k: int) -> Decimal:
    """Coefficient k of a product."""
    return sum((a[j] * b[k - j] for j in range(k + 1)), ZERO)


def value(series: Series, t: Decimal) -> Decimal:
    """Sum of a series."""
    total = ZERO
    for coefficient in reversed(series):
        total = total * t + coefficient
    return total


class Step(NamedTuple):
    """Series of one step: places and speeds of the axis, angles and rates of the balls, pulls and normal forces."""

    place: list[Series]
    velocity: list[Series]
    angle: list[Series]
    rate: list[Series]
    pull: list[Series]
    normal: list[Series]


class Motion:
    """A case, its state and its modes: `rolls` is the direction of each ball, 0 where it sticks."""

    def __init__(self, case: dict[str, Any]) -> None:
        def numbers(key: str) -> Series:
            return [Decimal(repr(float(number))) for number in case[key]]

        getcontext().prec = DIGITS
        self.mass, self.radius, self.inertia = (
            numbers(key) for key in ("ball_masses_kg", "pitch_radii_m", "ball_inertia_factors")
        )
        self.drag, self.stiffness = numbers("viscous_drag_rates_per_s"), numbers("stiffness_N_per_m")
        self.damping, self.balls = numbers("damping_N_s_per_m"), len(self.mass)
        self.speed, self.imbalance, self.phase, rotor = (
            Decimal(repr(float(case[key])))
            for key in ("speed_rad_per_s", "imbalance_kg_m", "imbalance_angle_rad", "mass_kg")
        )
        self.total, self.length = rotor + sum(self.mass), Decimal(repr(float(case["length_scale_m"])))
        self.friction = Decimal(repr(float(case.get("rolling_friction", 0.0))))
        self.gravity = Decimal(repr(float(case.get("gravity_m_per_s2", 0.0))))
        self.restitution = Decimal(repr(float(case["restitution"]))) if "restitution" in case else None
        self.closed = self._closed(case)
        self.place, self.velocity = numbers("start_place_m"), numbers("start_velocity_m_per_s")
        self.angle, self.rate = numbers("start_angles_rad"), numbers("start_rates_rad_per_s")
        self.t, self.events = ZERO, list[Event]()
        self.order = sorted(range(self.balls), key=lambda ball: self.angle[ball])
        self.rolls = [_sign(rate) for rate in self.rate]
        if self.friction:
            self._from_rest()
        else:
            self.rolls = [1] * self.balls

    def _closed(self, case: dict[str, Any]) -> Decimal:
        """Angle 2β [rad] between balls that touch, sin β = r/R, by Newton's method."""
        if self.restitution is None:
            return ZERO
        ratio, beta = Decimal(repr(float(case["ball_radius_m"]))) / self.radius[0], Decimal("0.4")
        for _ in range(60):
            sine, cosine = sin_cos(beta)
            beta -= (sine - ratio) / cosine
        return 2 * beta

    def step(self, rolls: Sequence[int], order: int = ORDER) -> Step:
        """Series about the present state, for directions of the balls."""
        n, speed, size = self.balls, self.speed, order + 1
        place, velocity = [[x] for x in self.place], [[v] for v in self.velocity]
        angle, rate = [[x] for x in self.angle], [[v] for v in self.rate]
        turned = [sin_cos(speed * self.t + theta) for theta in self.angle]
        sine, cosine = [[s] for s, _ in turned], [[c] for _, c in turned]
        swing = [[speed + v] for v in self.rate]
        force = self._imbalance(size)
        ss, sc, cc, ww, falls, rests = ([list[Decimal]() for _ in range(n)] for _ in range(6))
        A = [[list[Decimal]() for _ in range(2)] for _ in range(2)]
        a = [list[Decimal](), list[Decimal]()]
        pull, normal = ([list[Decimal]() for _ in range(n)] for _ in range(2))
        for k in range(size):
            if k:
                for i in range(n):
                    grown = product(swing[i], cosine[i], k - 1) / k
                    cosine[i].append(-product(swing[i], sine[i], k - 1) / k)
                    sine[i].append(grown)
            right = [force[axis][k] - self.damping[axis] * velocity[axis][k] - self.stiffness[axis] * place[axis][k]
                     for axis in range(2)]  # fmt: skip
            matrix = [[self.total if k == 0 else ZERO, ZERO], [ZERO, self.total if k == 0 else ZERO]]
            for i in range(n):
                s, c, m = sine[i], cosine[i], self.mass[i]
                ss[i].append(product(s, s, k))
                sc[i].append(product(s, c, k))
                cc[i].append(product(c, c, k))
                ww[i].append(product(swing[i], swing[i], k))
                falls[i].append(self.radius[i] * ww[i][k] - self.gravity * s[k])  # n without the axis
                flung = self.radius[i]
                right[0] += m * flung * product(ww[i], c, k)
                right[1] += m * flung * product(ww[i], s, k)
                rests[i].append(-self.drag[i] * self.radius[i] * rate[i][k] - self.gravity * c[k]
                                - rolls[i] * self.friction * falls[i][k])  # fmt: skip
                if not rolls[i]:
                    continue
                share, rubs = m / self.inertia[i], rolls[i] * self.friction
                matrix[0][0] -= share * (ss[i][k] + rubs * sc[i][k])
                matrix[0][1] -= share * (-sc[i][k] + rubs * ss[i][k])
                matrix[1][0] += share * (sc[i][k] + rubs * cc[i][k])
                matrix[1][1] += share * (-cc[i][k] + rubs * sc[i][k])
                right[0] += share * product(s, rests[i], k)
                right[1] -= share * product(c, rests[i], k)
            for row in range(2):
                for column in range(2):
                    A[row][column].append(matrix[row][column])
            for row in range(2):
                right[row] -= sum((A[row][o][j] * a[o][k - j] for o in range(2) for j in range(1, k + 1)), ZERO)
            determinant = A[0][0][0] * A[1][1][0] - A[0][1][0] * A[1][0][0]
            a[0].append((right[0] * A[1][1][0] - right[1] * A[0][1][0]) / determinant)
            a[1].append((right[1] * A[0][0][0] - right[0] * A[1][0][0]) / determinant)
            for i in range(n):
                along = product(a[0], sine[i], k) - product(a[1], cosine[i], k)
                normal[i].append(falls[i][k] - product(a[0], cosine[i], k) - product(a[1], sine[i], k))
                pull[i].append(along - self.gravity * cosine[i][k])
                braked = -self.drag[i] * self.radius[i] * rate[i][k] - rolls[i] * self.friction * normal[i][k]
                turning = (pull[i][k] + braked) / (self.inertia[i] * self.radius[i]) if rolls[i] else ZERO
                angle[i].append(rate[i][k] / (k + 1))
                rate[i].append(turning / (k + 1))
                swing[i].append(rate[i][k + 1])
            for axis in range(2):
                place[axis].append(velocity[axis][k] / (k + 1))
                velocity[axis].append(a[axis][k] / (k + 1))
        return Step(place, velocity, angle, rate, pull, normal)

    def _imbalance(self, size: int) -> list[Series]:
        """Force of the imbalance along x and y."""
        sine, cosine = sin_cos(self.speed * self.t + self.phase)
        turns, scale = [cosine, -sine, -cosine, sine], self.imbalance * self.speed**2
        series: list[Series] = [[], []]
        for k in range(size):
            series[0].append(scale * turns[k % 4])
            series[1].append(scale * turns[(k + 3) % 4])
            scale = scale * self.speed / (k + 1)
        return series

    def _length(self, step: Step, most: Decimal) -> Decimal:
        """Length of a step whose last terms may be left out, of all coordinates and of what is watched."""
        length = most
        flung = self.radius[0] * self.speed**2
        groups = (
            (step.place, self.length), (step.velocity, self.length * self.speed), (step.angle, Decimal(1)),
            (step.rate, self.speed), (step.pull, flung), (step.normal, flung),
        )  # fmt: skip
        for group, scale in groups:
            for series in group:
                for k in (len(series) - 1, len(series) - 2):
                    if series[k]:
                        length = min(length, (LEFT_OUT * scale / abs(series[k])) ** (Decimal(1) / k))
        return length

    def _watched(self, step: Step) -> list[tuple[Series, str, int]]:
        """Values above zero as long as the modes hold."""
        rows: list[tuple[Series, str, int]] = []
        if self.restitution is not None:
            for at, ball in enumerate(self.order):
                ahead = self.order[(at + 1) % self.balls]
                gap = [x - y for x, y in zip(step.angle[ahead], step.angle[ball], strict=True)]
                gap[0] += (2 * PI if at + 1 == self.balls else ZERO) - self.closed
                rows.append((gap, "impact", ball))
        for ball in range(self.balls if self.friction else 0):
            if self.rolls[ball]:
                rows.append(([self.rolls[ball] * x for x in step.rate[ball]], "stick", ball))
                continue
            most = [self.friction * x for x in step.normal[ball]]
            for sign in (1, -1):
                rows.append(([x - sign * y for x, y in zip(most, step.pull[ball], strict=True)], "slip", ball))
        return rows

    def run_to(self, end: Decimal) -> None:
        """Go on to a time, through all events."""
        while self.t < end:
            step = self.step(self.rolls)
            length = self._length(step, end - self.t)
            first: tuple[Decimal, str, int] | None = None
            for series, kind, ball in self._watched(step):
                moment = first_root(series, length)
                if moment is not None and (first is None or moment < first[0]):
                    first = moment, kind, ball
            length = first[0] if first else length
            self.place, self.velocity = ([value(s, length) for s in rows] for rows in (step.place, step.velocity))
            self.angle, self.rate = ([value(s, length) for s in rows] for rows in (step.angle, step.rate))
            self.t = end if not first and length == end - self.t else self.t + length
            if first:
                self._change(first[1], first[2])

    def _change(self, kind: str, ball: int) -> None:
        """Mode and state after an event."""
        if kind == "impact":
            self._impact(ball)
            self.events.append(Event(float(self.t), kind, ball))
            return
        before = list(self.rolls)
        if kind == "stick":
            self.rate[ball] = ZERO
        self._from_rest(ball)
        if self.rolls != before:
            self.events.append(Event(float(self.t), "slip" if self.rolls[ball] else "stick", ball))

    def _from_rest(self, *only: int) -> None:
        """Directions of balls at rest: a ball sticks where friction holds the pull."""
        for _ in range(2):
            for ball in only or [i for i in range(self.balls) if not self.rate[i]]:
                held = [0 if i == ball else way for i, way in enumerate(self.rolls)]
                step = self.step(held, 1)
                most = self.friction * step.normal[ball][0]
                grows = _sign(step.pull[ball][0]) * step.pull[ball][1] - self.friction * step.normal[ball][1]
                over = abs(step.pull[ball][0]) - most
                # At the very end of sticking the two are equal, and what follows decides.
                leaves = over > 0 if abs(over) > most * Decimal("1e-20") else grows > 0
                self.rolls[ball] = _sign(step.pull[ball][0]) if leaves else 0

    def _impact(self, behind: int) -> None:
        """Newton's law: the pair leaves at −e times its speed of approach, by an impulse on all of the system."""
        assert self.restitution is not None
        ahead = self.order[(self.order.index(behind) + 1) % self.balls]
        turned = [sin_cos(self.speed * self.t + theta) for theta in self.angle]
        # M u = D for one unit of impulse: the balls are eliminated as in `step`.
        signs = [(i == ahead) - (i == behind) for i in range(self.balls)]
        A = [[self.total, ZERO], [ZERO, self.total]]
        right = [ZERO, ZERO]
        for i, (s, c) in enumerate(turned):
            share, kick = self.mass[i] / self.inertia[i], signs[i] / (self.inertia[i] * self.radius[i])
            A[0][0] -= share * s * s
            A[0][1] += share * s * c
            A[1][0] += share * s * c
            A[1][1] -= share * c * c
            right[0] += s * kick
            right[1] -= c * kick
        determinant = A[0][0] * A[1][1] - A[0][1] * A[1][0]
        u = [(right[0] * A[1][1] - right[1] * A[0][1]) / determinant,
             (right[1] * A[0][0] - right[0] * A[1][0]) / determinant]  # fmt: skip
        answers = [
            (u[0] * s - u[1] * c) / (self.inertia[i] * self.radius[i])
            + signs[i] / (self.mass[i] * self.inertia[i] * self.radius[i] ** 2)
            for i, (s, c) in enumerate(turned)
        ]
        approach = self.rate[ahead] - self.rate[behind]
        impulse = -(1 + self.restitution) * approach / (answers[ahead] - answers[behind])
        self.velocity = [v + impulse * x for v, x in zip(self.velocity, u, strict=True)]
        self.rate = [v + impulse * x for v, x in zip(self.rate, answers, strict=True)]


def _sign(number: Decimal) -> int:
    return (number > 0) - (number < 0)


def slope(series: Series) -> Series:
    """Derivative of a series."""
    return [k * coefficient for k, coefficient in enumerate(series)][1:]


def falling(series: Series, low: Decimal, high: Decimal) -> Decimal:
    """Place between `low` and `high` at which the series changes its sign, still on the side of `low`."""
    above = value(series, low) > 0
    while high - low > Decimal("1e-32") * high:
        middle = low + (high - low) / 2
        if middle in (low, high):
            break
        low, high = (middle, high) if (value(series, middle) > 0) == above else (low, middle)
    return low


def first_root(series: Series, length: Decimal) -> Decimal | None:
    """First time in a step at which a series falls below zero; it is at or above zero at the start.

    Dips between two looks are found by the minimum between them.

    >>> first_root([Decimal(2), ZERO, Decimal(-1)], Decimal(3)).quantize(Decimal("1e-20"))
    Decimal('1.41421356237309504880')
    >>> first_root([Decimal("1.2099"), Decimal("-2.2"), Decimal(1)], Decimal(12)).quantize(Decimal("1e-9"))
    Decimal('1.090000000')
    """
    noise, derivative = Decimal("1e-22"), slope(series)
    low = ZERO
    for part in range(1, PARTS + 1):
        high = length * part / PARTS
        bottom = high
        if value(derivative, low) < 0 < value(derivative, high):
            bottom = falling(derivative, low, high)
        for end in (bottom, high):
            if value(series, end) < -noise:
                return falling(series, low, end) if value(series, low) > 0 else low
        low = high
    return None


def solved(case: dict[str, Any]) -> tuple[list[list[float]], list[Event]]:
    """States [x, y, θ₁ …, x', y', θ₁' …] at the case's times, and all events."""
    motion, states = Motion(case), list[list[float]]()
    for time in case["times_s"]:
        motion.run_to(Decimal(repr(float(time))))
        states.append([float(x) for x in (*motion.place, *motion.angle, *motion.velocity, *motion.rate)])
    return states, motion.events
