"""Checks of a machine at its work: differences between closed form and run, decay of balls, words of the checks."""

import math
from typing import Any

import numpy as np
import pytest

from abu_calc.features.grinding.checks import AGREES, Comparison, _agrees, compared, loaded_rate
from abu_calc.features.grinding.simulation import WorkSimulation
from abu_calc.features.grinding.steady_contact import SteadyWork, fitted, runout_of
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.sizing.machines import machine


@pytest.fixture(scope="module")
def design() -> Design:
    grinding = {"contact_stiffness_N_per_m": 4.9e5, "press_force_N": 200.0}
    return size(machine(wheel__runout_mm=0.05, grinding=grinding))


def run_of(steady: SteadyWork, **changes: Any) -> WorkSimulation:
    """A run that does what the closed form says."""
    assert steady.axis is not None and steady.reaction is not None and steady.imbalance is not None
    values: dict[str, Any] = {
        "axis": steady.axis, "x": 0.0, "y": 0.0, "reaction": steady.reaction, "imbalance": steady.imbalance,
        "force": np.ones(4), "profile": (), "velocity": 0.0, "duration": 1.0, "ball_angles": (),
        "path": np.zeros((2, 2)), "parts": False, "warnings": (),
    }  # fmt: skip
    return WorkSimulation(**(values | changes))


@pytest.mark.slow
def test_a_run_that_does_what_the_closed_form_says_is_not_off(design: Design) -> None:
    steady, moment = fitted(design, runout_of(design.case)), design.autobalancer.static_moment
    assert compared(steady, run_of(steady), moment).apart == pytest.approx(0.0, abs=1e-12)


def test_differences_are_relative_to_what_is_compared(design: Design) -> None:
    steady, moment = fitted(design, runout_of(design.case)), design.autobalancer.static_moment
    assert steady.imbalance is not None and steady.axis is not None and steady.reaction is not None
    carried = abs(steady.imbalance - steady.own)
    off = compared(steady, run_of(steady, imbalance=steady.imbalance + 0.03 * carried), moment)
    assert off.imbalance == pytest.approx(0.03) and off.apart == off.imbalance
    force = carried * design.case.speed**2
    pushed = compared(
        steady, run_of(steady, reaction=steady.reaction + 0.05 * max(abs(steady.reaction), force)), moment
    )
    assert pushed.reaction == pytest.approx(0.05) and pushed.axis == pytest.approx(0.0, abs=1e-12)
    assert compared(steady, run_of(steady, force=np.empty(0)), moment).reaction is None  # a face does not press
    assert Comparison(failure="chaotic").apart is None


@pytest.mark.parametrize("stiffness", [(3000.0 + 0j, 500.0 + 0j), (40.0 + 0j, 9.0 + 0j), (2000 + 300j, 800 - 90j)])
def test_the_slowest_decay_is_the_root_of_the_quadratic(design: Design, stiffness: tuple[complex, complex]) -> None:
    """J·s² + h₀·s + k = 0 for each way in which the balls move."""
    drag, inertia = design.case.drag, design.case.inertia_factor
    slowest = min(-np.roots([inertia, drag, k]).real.max() for k in stiffness)
    assert loaded_rate(design, stiffness) == pytest.approx(slowest, rel=1e-9)


def test_a_contact_that_sends_the_balls_away_has_a_rate_below_zero(design: Design) -> None:
    assert loaded_rate(design, (-50 + 0j, 100 + 0j)) < 0


@pytest.mark.parametrize(
    ("errors", "status", "value"),
    [
        (Comparison(axis=0.5 * AGREES, imbalance=0.0), "pass", 50 * AGREES),
        (Comparison(axis=2 * AGREES, imbalance=0.0), "warn", 200 * AGREES),
        (Comparison(axis=0.0, from_idle=False), "warn", 0.0),
        (Comparison(failure="chaotic"), "not-done", None),
    ],
)
def test_a_closed_form_that_a_run_contradicts_is_a_warning(
    errors: Comparison, status: str, value: float | None
) -> None:
    (check,) = _agrees(errors)
    assert (check.code, check.status) == ("ABU425", status)
    assert check.value == value if value is None else math.isclose(check.value or 0.0, value, abs_tol=1e-12)
    assert _agrees(None) == ()
