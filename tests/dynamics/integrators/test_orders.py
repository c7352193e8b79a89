"""Errors fall with the tolerance, and with the step, as the order of each method says: by regression."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.scene import Scene
from tests.dynamics.scenes import coupled_scene, dimensionless, scene_on, straight_grinder

SHORT = dimensionless(3.0, 0.01, 0.01, 0.3, 0.05, (1.5, -1.7), 20.0)
SMOOTH = {
    "two balls": SHORT,
    "grinder": replace(straight_grinder(), duration=0.1),
    "coupled": coupled_scene(),
    "tilting": scene_on("tilting"),
    "swing arm": scene_on("swing arm"),
}
SWITCHING = {
    "contact": replace(
        dimensionless(3.0, 0.01, 0.01, 0.3, 0.05, (1.5, 1.9, 2.5), 20.0), effects=(BallContactEffect(0.15, 0.5),)
    ),
    "friction": replace(
        dimensionless(3.0, 0.02, 0.01, 0.3, 0.01, (1.5, -1.7), 20.0), effects=(DryRollingFrictionEffect(1e-4, 0.15),)
    ),
}
INTEGRATORS = (
    "scipy-rk45",
    "scipy-dop853",
    "scipy-lsoda",
    "scipy-radau",
    "scipy-bdf",
    "compiled-dop853",
    "compiled-rk45",
)
TOLERANCES = np.logspace(-3, -9, 7)
REFERENCE = 2e-13
MOMENTS = 201
LEAST = 100 * REFERENCE
"""Errors below are those of the reference."""
COSTLY = ("scipy-radau", "scipy-bdf")
"""Those that solve for their steps: left to `-m slow` for the time they take."""
QUICK = [name for name in INTEGRATORS if name not in COSTLY]
IMPLICIT = {"two balls": SMOOTH["two balls"], "coupled": SMOOTH["coupled"], "friction": SWITCHING["friction"]}
"""Scenes for them: a small one, a large one, and one that switches."""
MANY_LOOKS = ("scipy-rk45", "scipy-lsoda")
"""Those of many short steps, at each of which switches are looked for in the way of the quicker ones."""
CASES = [(scene, name) for scene in SMOOTH for name in QUICK]


def slope(xs: np.ndarray, ys: np.ndarray) -> float:
    """Of log y over log x."""
    return float(np.polyfit(np.log(xs), np.log(ys), 1)[0])


@lru_cache
def reference(scene: Scene) -> np.ndarray:
    """All states at the moments."""
    moments = np.linspace(0, scene.duration, MOMENTS)
    return choice.integrate_with("scipy-dop853", assemble(scene), REFERENCE, moments, 10**7).y


def by_tolerance(scene, name: str) -> tuple[float, int]:
    """How errors of all states over the whole run, in their scales, fall with the tolerance; and the events."""
    equations, moments = assemble(scene), np.linspace(0, scene.duration, MOMENTS)
    if name not in choice.available(equations):
        pytest.skip(f"{name} is not installed")
    runs = [choice.integrate_with(name, equations, tolerance, moments, 10**6) for tolerance in TOLERANCES.tolist()]
    scales = np.array(equations.scales)[:, None]
    errors = np.array([float((np.abs(run.y - reference(scene)) / scales).max()) for run in runs])
    known = errors > LEAST
    assert known.sum() >= 5
    return slope(TOLERANCES[known], errors[known]), runs[-1].events


@pytest.mark.few(2)
@pytest.mark.parametrize(("scene", "name"), CASES)
@pytest.mark.slow
def test_errors_are_proportional_to_the_tolerance(scene, name):
    found, _ = by_tolerance(SMOOTH[scene], name)
    assert 0.7 < found < 1.3


@pytest.mark.parametrize("name", [pytest.param(one, marks=[pytest.mark.slow] * (one in MANY_LOOKS)) for one in QUICK])
@pytest.mark.parametrize("scene", SWITCHING)
@pytest.mark.slow
def test_switches_leave_them_so(scene, name):
    """Events located in time cost no order."""
    found, events = by_tolerance(SWITCHING[scene], name)
    assert events > 0
    assert 0.7 < found < 1.3


@pytest.mark.parametrize(
    ("scene", "name"),
    [
        pytest.param(scene, name, marks=pytest.mark.hard if scene == "coupled" or "radau" in name else pytest.mark.slow)
        for scene in IMPLICIT
        for name in COSTLY
    ],
)
def test_implicit_methods_do_so(scene, name):
    found, events = by_tolerance(IMPLICIT[scene], name)
    assert (events > 0) is (scene in SWITCHING)
    assert 0.7 < found < 1.3


@pytest.mark.few(1)
@pytest.mark.parametrize(("name", "order", "steps"), [("scipy-rk45", 5, (0.03, 0.2)), ("scipy-dop853", 8, (0.15, 0.5))])
def test_fixed_steps_show_the_order(name, order, steps):
    """A longest step that rules all but the first steps and the last: errors at the end go by its power."""
    equations, moments = assemble(SHORT), np.array([SHORT.duration])
    true = scipy_.integrate(equations, REFERENCE, moments).y[:, -1]
    lengths = np.geomspace(*steps, 8)
    # At this tolerance none of them is refused, and the longest step is not shortened.
    ends = [scipy_.integrate(replace(equations, longest_step=h), 0.1, moments, method=name) for h in lengths.tolist()]
    assert all(run.steps >= SHORT.duration / h for run, h in zip(ends, lengths, strict=True))
    errors = np.array([float((np.abs(run.y[:, -1] - true) / equations.scales).max()) for run in ends])
    assert slope(lengths, errors) == pytest.approx(order, abs=0.5)
