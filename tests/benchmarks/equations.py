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
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import heyoka_, scipy_
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.tracing.plain import functions
from abu_calc.dynamics.tracing.traced import Numbers
from tests.benchmarks.by_hand import planar, with_floats
from tests.dynamics.scenes import straight_grinder

BALLS = (2, 4, 8, 16, 32, 64)
ROUNDS, CALLS = 100, 100
TOLERANCE = 1e-6
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


def compare_heyoka() -> None:
    """Whole runs against the same system written for heyoka by hand, and what a step takes, both unrolled."""
    hy = importlib.import_module("heyoka")
    hy.set_logger_level_error()
    print("heyoka at the same order, 217 revolutions\nballs        composed [ms]         by hand [ms]    run   step")
    for balls in (2, 4, 8):
        scene = grinder(balls)
        equations, end = assemble(scene), scene.duration
        scales, start = np.array(equations.scales), np.array(equations.initial)
        exact = heyoka_.integrate(equations, 1e-13, [end]).y[:, -1]
        heyoka_.integrate(equations, TOLERANCE, [end])
        order, *_ = next(reversed(heyoka_._systems))
        written = hy.taylor_adaptive(by_hand(hy, scene), start, tol=order, compact_mode=False)
        done: dict[str, Any] = {}

        def composed(equations: Any = equations, end: float = end, done: dict[str, Any] = done) -> None:
            done["mine"] = heyoka_.integrate(equations, TOLERANCE, [end])

        def bare(
            end: float = end, units: Any = scales * (TOLERANCE / order), start: Any = start, done: dict[str, Any] = done
        ) -> None:
            compiled = next(reversed(heyoka_._systems.values())).integrator
            compiled.time, compiled.state[:] = 0.0, start / units
            done["bare"] = compiled.propagate_until(end)[3]

        def other(end: float = end, start: Any = start, written: Any = written, done: dict[str, Any] = done) -> None:
            written.time, written.state[:] = 0.0, start
            done["steps"] = written.propagate_until(end)[3]

        mine, stepping, hand = least([composed, bare, other])
        errors = [np.abs((y - exact) / scales).max() for y in (done["mine"].y[:, -1], written.state)]
        cells = [f"{1e3 * spent:7.2f} (error {error:.0e})" for spent, error in zip((mine, hand), errors, strict=True)]
        per_step = stepping / done["bare"] / (hand / done["steps"])
        print(f"{balls:5d} {cells[0]:>22} {cells[1]:>20} {mine / hand:6.2f} {per_step:6.2f}")
    print("bounds: 1.3 for a run, 1.2 for a step\n")


READY = """
import sys, time
started = time.perf_counter()
import heyoka
imported = time.perf_counter()
heyoka.llvm_state.set_diskcache_enabled({cached})
from abu_calc.dynamics.equations.assemble import assemble
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
    compare_scipy()
    if importlib.util.find_spec("heyoka"):
        compare_heyoka()
        readiness()
        compare_integrators()
