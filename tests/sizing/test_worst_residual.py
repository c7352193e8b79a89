"""Friction that holds balls off their places: gravity on a horizontal spindle shakes it out."""

import math
from dataclasses import replace

import pytest

from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from abu_calc.sizing.vibration import friction_left, worst_residuals


def design(axis: str) -> Design:
    """The straight grinder of the factory, with its spindle horizontal or vertical."""
    return size(read_machine("avtovaz-707-222").changed({"machine.spindle_axis": axis}).whole("size"))


@pytest.mark.parametrize(("pulls", "left"), [(0.5, 0.0), (1.0, 0.0), (1.25, 0.2), (4.0, 0.75)])
def test_a_ball_rests_where_friction_holds_gravity_too(pulls: float, left: float) -> None:
    """By hand: of k_r R_p Ω²/r = Λ g the share (Λ g − g)/(Λ g) is left; on a vertical spindle all of it."""
    sized = design("horizontal")
    candidate = sized.autobalancer
    speed = math.sqrt(
        pulls * 9.80665 * candidate.ball_diameter / 2 / (sized.case.friction_arm * candidate.pitch_radius)
    )
    assert friction_left(sized.case, candidate, speed) == pytest.approx(left, abs=1e-9)
    assert friction_left(design("vertical").case, candidate, speed) == 1.0
    assert friction_left(replace(sized.case, friction_arm=0.0), candidate, speed) == 0.0


def test_the_worst_arrangement_is_that_of_a_vertical_spindle() -> None:
    """Of 26 random starts of the horizontal machine, by equations outside the product, none ends above 98.8 dB."""
    residuals = {}
    for axis in ("horizontal", "vertical"):
        sized = design(axis)
        (residuals[axis],) = worst_residuals(sized.case, sized.imbalance.value, sized.autobalancer)
    assert residuals["horizontal"].residual < 0.5 * residuals["vertical"].residual
    assert residuals["horizontal"].rolling_friction == residuals["vertical"].rolling_friction
