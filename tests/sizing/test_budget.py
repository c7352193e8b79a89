"""Accuracy budget of a race: what each part leaves, and the displacement that the limit permits."""

import cmath
import math

import pytest

from abu_calc.sizing import size
from abu_calc.sizing.budget import displacement_level, fan, permitted_displacement
from abu_calc.sizing.case import read_case
from tests.sizing.machines import PINNED, machine

OMEGA = 5800 * math.pi / 30


def test_levels_of_the_budget() -> None:
    assert displacement_level(math.hypot(10e-6, 7e-6), OMEGA) == pytest.approx(100.4, abs=0.1)
    assert displacement_level(17e-6, OMEGA) == pytest.approx(103.3, abs=0.1)
    assert 1e6 * permitted_displacement(read_case(machine()), 0.2, OMEGA) == pytest.approx(32.81, abs=0.01)


@pytest.mark.parametrize(("count", "resultant"), [(2, 0.5), (3, 1.2), (4, 0.665), (5, 0.0), (6, 2.0)])
def test_fan_adds_up_to_its_resultant(count: int, resultant: float) -> None:
    angles = fan(count, resultant, math.radians(8))
    # Its spacing is one of 512 steps, so the sum is right to a few hundredths.
    assert abs(sum(cmath.exp(1j * a) for a in angles)) == pytest.approx(resultant, abs=0.03)


def test_an_oval_race_counts_in_the_budget() -> None:
    """Two lobes of amplitude a leave 2a, as the square of a part of its own."""
    one = size(machine(**PINNED, wheel__imbalance_g_mm=100.0)).autobalancer
    parts = one.budget.race_eccentricity, one.budget.rolling_friction, 2 * one.roundness.lobes
    assert one.budget.residual == pytest.approx(math.hypot(*parts))
    assert one.budget.race_ovality == pytest.approx(2 * one.roundness.lobes) and one.roundness.lobes > 0


def test_what_the_balls_cannot_carry_stays_in_the_level() -> None:
    """Two 5 mm balls against 250 g·mm: the rest shakes the machine, beside the budget."""
    design = size(machine(autobalancer__ball_diameter_mm=5.0, autobalancer__ball_count=2))
    one = design.autobalancer
    left = (250e-6 - one.capacity) / (6.2 + one.mass)
    resonance = 1 / (1 - (2.5 * 60 / 5800) ** 2)  # damping changes it by 3e-4
    rest = left * resonance + math.hypot(one.budget.race_eccentricity, one.budget.rolling_friction)
    assert one.budget.residual == pytest.approx(rest, rel=1e-3)
    assert design.idle.worst.after == pytest.approx(displacement_level(rest, 5800 * math.pi / 30), abs=0.01)


def test_a_background_as_loud_as_the_limit_permits_nothing() -> None:
    loud = read_case(machine(machine__background_level_db=109.0, limits={"vibration_level_db": 109.0}))
    assert permitted_displacement(loud, 0.2, OMEGA) == 0.0
    # 3.0103 dB below the limit the background has half of the power, and √½ of the displacement is left.
    half = read_case(machine(machine__background_level_db=109.0 - 10 * math.log10(2)))
    quiet = read_case(machine())
    assert permitted_displacement(half, 0.2, OMEGA) == pytest.approx(
        permitted_displacement(quiet, 0.2, OMEGA) / math.sqrt(2)
    )


def test_a_displacement_at_rest_has_the_level_of_the_background() -> None:
    assert displacement_level(0.0, OMEGA, 90.0) == pytest.approx(90.0)
    assert displacement_level(0.0, OMEGA) == 0.0
    assert displacement_level(20e-6, OMEGA) - displacement_level(10e-6, OMEGA) == pytest.approx(20 * math.log10(2))
