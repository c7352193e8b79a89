"""Cases that switch, by SciPy alone: steps of DOP853, events located by steps that end on them.

The full mass matrix of axis and balls is solved at each evaluation. No code is shared with abu-calc or `taylor`.
"""

import math
from collections.abc import Callable
from functools import partial
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import DOP853
from scipy.optimize import brentq, minimize_scalar

Array = NDArray[np.float64]
Watched = tuple[str, int, Callable[[float, Array], float]]

LOOKS: Final = 10
"""Places of a step at which a watched value is looked at."""

NOISE: Final = 30.0
"""A watched value this many tolerances below zero is the error of interpolation."""

REPEATED: Final = 20
"""Events at one time from which on the motion does not get on."""


class Switching:
    """A case with its modes: `rolls` holds the direction of each ball, 0 where it sticks."""

    def __init__(self, case: dict[str, Any], rtol: float) -> None:
        self.m, self.R, self.J, self.drag = (
            np.array(case[key], dtype=float)
            for key in ("ball_masses_kg", "pitch_radii_m", "ball_inertia_factors", "viscous_drag_rates_per_s")
        )
        self.n, self.speed = len(self.m), case["speed_rad_per_s"]
        self.total = case["mass_kg"] + self.m.sum()
        self.k, self.c = np.array(case["stiffness_N_per_m"]), np.array(case["damping_N_s_per_m"])
        self.imbalance, self.phase = case["imbalance_kg_m"], case["imbalance_angle_rad"]
        self.f, self.g = case.get("rolling_friction", 0.0), case.get("gravity_m_per_s2", 0.0)
        self.e: float | None = case.get("restitution")
        self.order = np.argsort(case["start_angles_rad"]).tolist()
        self.touching = 2 * math.asin(case["ball_radius_m"] / self.R[0]) if self.e is not None else 0.0
        self.rolls = np.sign(case["start_rates_rad_per_s"]) if self.f else np.ones(self.n)
        self.rtol, n = rtol, self.n
        scale = np.concatenate([np.full(2, case["length_scale_m"]), np.ones(n)] * 2)
        scale[2 + n :] *= self.speed
        self.atol = rtol * scale
        self.events: list[list[Any]] = []

    def solved(self, t: float, y: Array, rolls: Array) -> tuple[Array, Array, Array]:
        """Accelerations of axis and balls, pull [m/s²] on each ball and its normal force per mass."""
        n = self.n
        gamma, rate = self.speed * t + y[2 : 2 + n], y[4 + n :]
        s, c, swing = np.sin(gamma), np.cos(gamma), self.R * (self.speed + rate) ** 2
        A, b = np.zeros((2 + n, 2 + n)), np.zeros(2 + n)
        A[0, 0] = A[1, 1] = self.total
        A[0, 2:], A[1, 2:] = -self.m * self.R * s, self.m * self.R * c
        turn = self.speed * t + self.phase
        b[:2] = self.imbalance * self.speed**2 * np.array((math.cos(turn), math.sin(turn)))
        b[:2] += np.array(((self.m * swing * c).sum(), (self.m * swing * s).sum()))
        b[:2] -= self.c * y[2 + n : 4 + n] + self.k * y[:2]
        # J R θ'' = x'' s − y'' c − g c − h₀ R θ' − σ f n, n = R γ'² − g s − x'' c − y'' s; 0 = θ'' of balls that stick.
        moves, rub, row = np.abs(rolls), rolls * self.f, np.arange(n) + 2
        A[row, row] = moves * self.J * self.R + 1 - moves
        A[2:, 0], A[2:, 1] = -moves * (s + rub * c), moves * (c - rub * s)
        b[2:] = moves * (-self.g * c - self.drag * self.R * rate - rub * (swing - self.g * s))
        a = np.linalg.solve(A, b)
        return a, a[0] * s - a[1] * c - self.g * c, swing - self.g * s - a[0] * c - a[1] * s

    def rhs(self, t: float, y: Array) -> Array:
        """Time derivative of the state [x, y, θ …, x', y', θ' …]."""
        return np.concatenate([y[2 + self.n :], self.solved(t, y, self.rolls)[0]])

    def watched(self) -> list[Watched]:
        """Values that stay above zero as long as the modes hold, relative to their sizes."""
        n, rows = self.n, list[Watched]()
        for at, ball in enumerate(self.order if self.e is not None else ()):
            ahead = self.order[(at + 1) % n]
            more = (2 * math.pi if at + 1 == n else 0.0) - self.touching
            rows.append(("impact", ball, lambda t, y, i=ball, j=ahead, more=more: y[2 + j] - y[2 + i] + more))
        for ball in range(n if self.f else 0):
            if self.rolls[ball]:
                rows.append(("stick", ball, lambda t, y, i=ball: self.rolls[i] * y[4 + n + i] / self.speed))
                continue
            for side in (1, -1):
                rows.append(("slip", ball, lambda t, y, i=ball, side=side: self.hold(t, y, i, side)))
        return rows

    def hold(self, t: float, y: Array, ball: int, side: int) -> float:
        """What friction holds less the pull to one side, over f R Ω²."""
        _, pull, normal = self.solved(t, y, self.rolls)
        return float(normal[ball] - side * pull[ball] / self.f) / (self.R[ball] * self.speed**2)

    def advanced(self, t: float, y: Array, end: float) -> tuple[float, Array, Watched | None]:
        """State after a step of the integrator at the most, or on the first event in it."""
        solver = DOP853(self.rhs, t, y, end, rtol=self.rtol, atol=self.atol)
        rows = self.watched()
        while True:
            solver.step()
            if solver.status == "failed":
                raise SystemExit("the step became too small")
            dense, begun = solver.dense_output(), solver.t_old
            first: tuple[float, Watched] | None = None
            for row in rows:
                moment = _crossing(partial(self.above, row, dense), begun, solver.t)
                if moment is not None and (first is None or moment < first[0]):
                    first = moment, row
            if first:
                return *self._landed(begun, dense(begun), *first), first[1]
            if solver.status == "finished":
                return solver.t, solver.y, None

    def above(self, row: Watched, dense: Callable[[float], Array], t: float) -> float:
        """A watched value within a step, clear of the error of interpolation."""
        return row[2](t, dense(t)) + NOISE * self.rtol

    def _landed(self, begun: float, y: Array, moment: float, row: Watched) -> tuple[float, Array]:
        """State on the event: the step ends there, and a secant corrects its length."""
        times, values, state = [begun], [row[2](begun, y)], y
        for _ in range(8):
            state, t = y, begun
            if moment > begun:
                last = DOP853(self.rhs, begun, y, moment, rtol=self.rtol, atol=self.atol)
                while last.status == "running":
                    last.step()
                t, state = last.t, last.y
            times.append(t)
            values.append(row[2](t, state))
            change = values[-1] - values[-2]
            if not change or not values[-1] or times[-1] == times[-2]:
                break
            correction = values[-1] * (times[-1] - times[-2]) / change
            if abs(correction) < 4e-16 * t or abs(correction) >= abs(times[-1] - times[-2]):
                break
            moment = max(t - correction, begun)
        return times[-1], state

    def change(self, t: float, y: Array, row: Watched) -> Array:
        """State and modes after an event."""
        kind, ball, _ = row
        y = y.copy()
        if kind == "impact":
            self.events.append([t, kind, ball])
            return self._after_impact(t, y, ball)
        before = self.rolls.copy()
        if kind == "stick":
            y[4 + self.n + ball] = 0.0
            self.from_rest(t, y, ball)
        else:
            self.rolls[ball] = np.sign(self.solved(t, y, self.rolls)[1][ball])
        if not np.array_equal(before, self.rolls):
            self.events.append([t, "slip" if self.rolls[ball] else "stick", ball])
        return y

    def from_rest(self, t: float, y: Array, ball: int) -> None:
        """Direction of a ball at rest: it sticks where friction holds the pull."""
        held = self.rolls.copy()
        held[ball] = 0.0
        _, pull, normal = self.solved(t, y, held)
        self.rolls[ball] = np.sign(pull[ball]) if abs(pull[ball]) > self.f * normal[ball] else 0.0

    def _after_impact(self, t: float, y: Array, ball: int) -> Array:
        """Newton's law of impact: −e times the speed of approach, by an impulse on the whole system."""
        assert self.e is not None
        n, ahead = self.n, self.order[(self.order.index(ball) + 1) % self.n]
        s, c = np.sin(self.speed * t + y[2 : 2 + n]), np.cos(self.speed * t + y[2 : 2 + n])
        M = np.diag(np.concatenate([[self.total, self.total], self.J * self.m * self.R**2]))
        M[0, 2:] = M[2:, 0] = -self.m * self.R * s
        M[1, 2:] = M[2:, 1] = self.m * self.R * c
        D = np.zeros(2 + n)
        D[2 + ahead], D[2 + ball] = 1.0, -1.0
        answer, v = np.linalg.solve(M, D), y[2 + n :]
        y[2 + n :] = v - (1 + self.e) * (D @ v) / (D @ answer) * answer
        return y

    def run(self, start: Array, times: list[float]) -> list[list[float]]:
        """States at some times."""
        t, y, states = times[0], start, [start.tolist()]
        for _ in range(2 if self.f else 0):
            for ball in np.flatnonzero(y[4 + self.n :] == 0):
                self.from_rest(t, y, int(ball))
        for end in times[1:]:
            while t < end:
                last = self.events[-REPEATED:]
                if len(last) == REPEATED and last[0][0] == t:
                    raise SystemExit(f"{REPEATED} events at t = {t:g} s")
                t, y, row = self.advanced(t, y, end)
                if row:
                    y = self.change(t, y, row)
            states.append(y.tolist())
        return states


def _crossing(watched: Callable[[float], float], begun: float, end: float) -> float | None:
    """First time in a step at which a value has fallen below zero, dips between two looks included."""
    times = np.linspace(begun, end, LOOKS + 1).tolist()
    values = [watched(time) for time in times]
    for k in range(LOOKS):
        low, high = times[k], times[k + 1]
        # A parabola through three looks tells where a dip may be.
        before, after = values[max(k - 1, 0)], values[min(k + 2, LOOKS)]
        ends = [high]
        if values[k] > 0 < values[k + 1] and before > values[k] and after > values[k + 1]:
            ends.insert(
                0, float(minimize_scalar(watched, bounds=(low, high), options={"xatol": 1e-3 * (high - low)}).x)
            )
        for place in ends:
            if watched(place) < 0:
                return float(brentq(watched, low, place, xtol=1e-15)) if values[k] > 0 else low
    return None


def solved(case: dict[str, Any], rtol: float) -> tuple[list[list[float]], list[list[Any]]]:
    """States at the case's times, and all events [time, kind, ball]."""
    switching = Switching(case, rtol)
    start = np.array([*case["start_place_m"], *case["start_angles_rad"], *case["start_velocity_m_per_s"],
                      *case["start_rates_rad_per_s"]])  # fmt: skip
    return switching.run(start, case["times_s"]), switching.events
