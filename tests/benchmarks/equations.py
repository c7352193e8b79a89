"""What composing the equations costs against one system written by hand, as SciPy's methods call it.

    python -m tests.benchmarks.equations

Both of a pair are run in turn, so that a change of the machine's speed meets both; the least times are compared.
"""

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from abu_calc.dynamics.codegen.tracer import Numbers, functions
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.scene import Scene
from tests.benchmarks.by_hand import planar, with_floats
from tests.dynamics.scenes import straight_grinder

BALLS = (2, 4, 8, 16, 32, 64)
ROUNDS, CALLS = 100, 100
LINEAR = 1.0
"""Cost may grow with the balls by no higher power than this."""


def grinder(balls: int) -> Scene:
    """The straight grinder with so many lighter balls, all round its race."""
    scene = straight_grinder()
    angles = tuple(0.1 + 5.5 * k / balls for k in range(balls))
    race = replace(
        scene.races[0], ball_masses=(0.067 / balls,) * balls, start_angles=angles, start_speeds=(0.0,) * balls
    )
    return replace(scene, races=(race,))


def fused(scene: Scene) -> Callable[[float, np.ndarray], np.ndarray]:
    """Every term in its place, for any planar support of two coordinates and balls of any masses in any races."""
    support, n, speed = scene.support, len(scene.ball_masses), scene.speed
    held, ((mass_x, mass_xy), (_, mass_y)) = -np.hstack([support.stiffness, support.damping]), support.mass
    each = [(race, m) for race in scene.races for m in race.ball_masses]
    masses, moments = np.array(scene.ball_masses), np.array(scene.static_moments)
    shared = masses / [race.inertia_factor for race, _ in each]
    levers = np.array([1 / (race.inertia_factor * race.pitch_radius) for race, _ in each])
    drags = np.array([race.drag / race.inertia_factor for race, _ in each])
    resisted, force, phase = moments * drags, scene.imbalance * speed**2, scene.imbalance_angle
    whole_x, whole_y = mass_x + masses.sum(), mass_y + masses.sum() - shared.sum()

    def rhs(t: float, y: np.ndarray) -> np.ndarray:
        rate, turn = y[4 + n :], speed * t
        gamma = y[4 : 4 + n] + turn
        sin, cos, swing = np.sin(gamma), np.cos(gamma), rate + speed
        # Sums over the balls by one product; as a list, because plain numbers are faster from here on.
        per_ball = np.array((moments * swing * swing, resisted * rate, shared * sin))
        (spun_y, drag_x, axx), (spun_x, drag_y, axy) = np.array((sin, cos)).dot(per_ball.T).tolist()
        held_x, held_y = held.dot(y[:4]).tolist()
        fx = force * math.cos(turn + phase) + spun_x - drag_x + held_x
        fy = force * math.sin(turn + phase) + spun_y + drag_y + held_y
        mxx, mxy, myy = whole_x - axx, mass_xy + axy, whole_y + axx
        determinant = mxx * myy - mxy * mxy
        ax, ay = (myy * fx - mxy * fy) / determinant, (mxx * fy - mxy * fx) / determinant
        out = np.empty_like(y)
        out[:2], out[2:4] = y[2:4], (ax, ay)
        out[4 : 4 + n] = rate
        out[4 + n :] = levers * (ax * sin - ay * cos) - drags * rate
        return out

    return rhs


def seconds(work: Callable[[], Any]) -> float:
    """Time of one go."""
    started = time.perf_counter()
    work()
    return time.perf_counter() - started


def least(works: Sequence[Callable[[], Any]], rounds: int = ROUNDS) -> list[float]:
    """Least times of all [s], taken in turns: other work on the machine disturbs these least."""
    for work in works:
        work()
    return [min(column) for column in zip(*([seconds(work) for work in works] for _ in range(rounds)), strict=True)]


def compare_scipy() -> None:
    """One evaluation as SciPy gets it, against the same by hand, with arrays and ball by ball; and how it grows."""
    print("one evaluation under SciPy [µs]\nballs  composed   by hand: arrays   floats    ratio to the quicker")
    costs, ratios = [], []
    for balls in BALLS:
        scene = grinder(balls)
        equations = assemble(scene)
        composed, _ = functions(equations, Numbers(equations), equations.first_modes)
        hands = fused(scene), with_floats(planar(scene))
        y = np.array(equations.initial) + 0.01
        for rhs in hands:
            np.testing.assert_allclose(composed(0.1, y), rhs(0.1, y), rtol=1e-10, atol=1e-8)
        mine, *others = least([partial(repeat, rhs, y) for rhs in (composed, *hands)])
        costs.append(mine)
        ratios.append(mine / min(others))
        one, arrays, floats = (1e6 * value / CALLS for value in (mine, *others))
        print(f"{balls:5d} {one:9.1f} {arrays:17.1f} {floats:8.1f} {ratios[-1]:12.2f}")
    power = np.polyfit(np.log(BALLS), np.log(costs), 1)[0]
    print(f"worst ratio {max(ratios):.2f} (bound 1.5); cost grows as balls^{power:.2f} (bound {LINEAR:g})\n")


def repeat(rhs: Callable[[float, np.ndarray], Any], y: np.ndarray) -> None:
    """Many evaluations."""
    for _ in range(CALLS):
        rhs(0.1, y)


if __name__ == "__main__":
    compare_scipy()
