"""What composing the equations costs against one system written by hand, under NumPy and under heyoka.

    python -m tests.benchmarks.equations

Both of a pair are run in turn, so that a change of the machine's speed meets both; the least times are compared.
"""

import importlib
import importlib.util
import math
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from abu_calc.dynamics.assemble import assemble
from abu_calc.dynamics.integrators import heyoka_, scipy_
from abu_calc.dynamics.scene import Scene
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
    masses, moments = np.array(scene.ball_masses), np.array(scene.ball_moments)
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


def by_hand(hy: Any, scene: Scene) -> list[tuple[Any, Any]]:
    """The same in heyoka's own terms, its numbers constants of the compiled code."""
    support, race = scene.support, scene.races[0]
    n, speed, m, J = len(race.ball_masses), scene.speed, race.ball_masses[0], race.inertia_factor
    x, y, u, v = hy.make_vars("x", "y", "u", "v")
    angles, rates = ([hy.expression(f"{name}{k}") for k in range(n)] for name in ("theta", "rate"))
    turn = speed * hy.time
    sin, cos = ([f(angle + turn) for angle in angles] for f in (hy.sin, hy.cos))
    swung = [(rate + speed) * (rate + speed) for rate in rates]
    mR, shared, resisted = m * race.pitch_radius, m / J, m * race.pitch_radius * race.drag / J

    def total(factor: float, left: list[Any], right: list[Any]) -> Any:
        return hy.sum([factor * a * b for a, b in zip(left, right, strict=True)])

    force, phase = scene.imbalance * speed**2, turn + scene.imbalance_angle
    (kx, ky), (bx, by) = np.diag(support.stiffness), np.diag(support.damping)
    fx = hy.sum([force * hy.cos(phase), -kx * x, -bx * u, total(mR, cos, swung), -total(resisted, sin, rates)])
    fy = hy.sum([force * hy.sin(phase), -ky * y, -by * v, total(mR, sin, swung), total(resisted, cos, rates)])
    axx, axy = total(shared, sin, sin), total(shared, sin, cos)
    whole = support.mass[0][0] + n * m
    mxx, myy = whole - axx, (whole - n * shared) + axx
    determinant = mxx * myy - axy * axy
    ax, ay = (myy * fx - axy * fy) / determinant, (mxx * fy - axy * fx) / determinant
    lever, drag = 1 / (J * race.pitch_radius), race.drag / J
    balls = [lever * (ax * s - ay * c) - drag * rate for s, c, rate in zip(sin, cos, rates, strict=True)]
    return [(x, u), (y, v), (u, ax), (v, ay), *zip(angles, rates, strict=True), *zip(rates, balls, strict=True)]


def seconds(work: Callable[[], Any]) -> float:
    """Time of one go."""
    started = time.perf_counter()
    work()
    return time.perf_counter() - started


def pair(mine: Callable[[], Any], other: Callable[[], Any], rounds: int = ROUNDS) -> tuple[float, float, float]:
    """Least times of both [s], which other work on the machine disturbs least, and their ratio."""
    mine(), other()
    pairs = [(seconds(mine), seconds(other)) for _ in range(rounds)]
    one, two = (min(column) for column in zip(*pairs, strict=True))
    return one, two, one / two


def compare_numpy() -> None:
    """One evaluation, composed against fused, and how it grows."""
    print("NumPy, one evaluation [µs]\nballs  composed    fused    ratio")
    costs, ratios = [], []
    for balls in BALLS:
        scene = grinder(balls)
        equations, rhs = assemble(scene), fused(scene)
        y = np.array(equations.initial) + 0.01
        np.testing.assert_allclose(equations.rhs(np, 0.1, y, equations.parameters), rhs(0.1, y), rtol=1e-10, atol=1e-8)

        def composed(equations: Any = equations, y: np.ndarray = y) -> None:
            for _ in range(CALLS):
                equations.rhs(np, 0.1, y, equations.parameters)

        def written(rhs: Any = rhs, y: np.ndarray = y) -> None:
            for _ in range(CALLS):
                rhs(0.1, y)

        mine, other, ratio = pair(composed, written)
        costs.append(mine)
        ratios.append(ratio)
        print(f"{balls:5d} {1e6 * mine / CALLS:9.1f} {1e6 * other / CALLS:8.1f} {ratio:8.2f}")
    power = np.polyfit(np.log(BALLS), np.log(costs), 1)[0]
    print(f"worst ratio {max(ratios):.2f} (bound 1.5); cost grows as balls^{power:.2f} (bound {LINEAR:g})\n")


def compare_heyoka() -> None:
    """Run time at the same order and the same error, and what it takes to be ready."""
    hy = importlib.import_module("heyoka")
    hy.set_logger_level_error()
    scene = straight_grinder()
    equations, end = assemble(scene), scene.duration
    scales, start = np.array(equations.scales), np.array(equations.initial)
    exact = heyoka_.integrate(equations, 1e-13, [end]).y[:, -1]
    written = hy.taylor_adaptive(by_hand(hy, scene), start, tol=heyoka_.COMPILED, compact_mode=True)
    done: dict[str, Any] = {}

    def composed() -> None:
        done["mine"] = heyoka_.integrate(equations, 1e-9, [end])

    def other() -> None:
        written.time, written.state[:] = 0.0, start
        done["steps"] = written.propagate_until(end, max_delta_t=equations.longest_step)[3]

    mine, hand, ratio = pair(composed, other, 100)
    per_step = ratio / done["mine"].steps * done["steps"]
    errors = [np.abs((y - exact) / scales).max() for y in (done["mine"].y[:, -1], written.state)]
    print(f"heyoka, {end / scene.revolution:.0f} revolutions, order {written.order}: composed at 1e-9 against by hand")
    print(f"composed {1e3 * mine:6.2f} ms, {done['mine'].steps} steps, error {errors[0]:.1e}")
    print(f"by hand  {1e3 * hand:6.2f} ms, {done['steps']} steps, error {errors[1]:.1e}")
    print(f"ratio {ratio:.2f} for the run (bound 1.3), {per_step:.2f} for a step\n")


READY = """
import sys, time
started = time.perf_counter()
import heyoka
imported = time.perf_counter()
heyoka.llvm_state.set_diskcache_enabled({cached})
from abu_calc.dynamics.assemble import assemble
from abu_calc.dynamics.integrators import heyoka_
from tests.benchmarks.equations import grinder
equations = assemble(grinder({balls}))
ready = time.perf_counter()
heyoka_.integrate(equations, 1e-6, [equations.scene.revolution])
print(imported - started, time.perf_counter() - ready)
"""


def readiness() -> None:
    """Import, and tracing with compilation or with loading from disk, in fresh processes."""
    print("heyoka getting ready [ms]\nballs  import  compile  reload")
    for balls in (2, 4, 16, 64):
        found = []
        for cached in (False, True, True):
            code = READY.format(cached=cached, balls=balls)
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
            found.append([1e3 * float(value) for value in done.stdout.split()])
        print(f"{balls:5d} {found[2][0]:7.0f} {found[0][1]:8.0f} {found[2][1]:7.0f}")
    print()


def compare_integrators() -> None:
    """Whole runs of both libraries, with their errors."""
    print("whole runs of 217 revolutions\nballs  tolerance      SciPy               heyoka            ratio")
    for balls in (4, 16, 64):
        scene = grinder(balls)
        equations, end = assemble(scene), [scene.duration]
        exact = heyoka_.integrate(equations, 1e-13, end).y[:, -1]
        for tolerance in (1e-6, 1e-9):
            cells, times = [], []
            for library in (scipy_, heyoka_):
                y = library.integrate(equations, tolerance, end).y[:, -1]
                error = np.abs((y - exact) / equations.scales).max()
                spent = min(seconds(partial(library.integrate, equations, tolerance, end)) for _ in range(5))
                times.append(spent)
                cells.append(f"{1e3 * spent:7.1f} ms ({error:.0e})")
            print(f"{balls:5d} {tolerance:10g} {cells[0]:>20} {cells[1]:>20} {times[0] / times[1]:7.0f}")


if __name__ == "__main__":
    scipy_.load()
    compare_numpy()
    if importlib.util.find_spec("heyoka"):
        compare_heyoka()
        readiness()
        compare_integrators()
