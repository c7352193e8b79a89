"""The race: groove, carry-over speed, and the checks of its hardness."""

import math

import pytest

from abu_calc.sizing import size
from abu_calc.sizing.track import carry_over_speed
from tests.sizing.machines import PINNED, check_of, machine, ranged


@pytest.mark.slow
def test_stress_and_roundness_are_judged_at_the_top_and_carry_over_at_the_bottom() -> None:
    design = ranged(120.0)
    for code in ("ABU301", "ABU303", "ABU304"):
        assert "12000 rpm" in check_of(design, code).message
    assert check_of(design, "ABU102").value == pytest.approx(2500)
    force = design.autobalancer.ball_mass * design.autobalancer.pitch_radius * (12000 * math.pi / 30) ** 2
    assert design.autobalancer.strength.ball_force == pytest.approx(force)


@pytest.mark.parametrize(("hardness", "status"), [(57.9, "fail"), (58.0, "pass")])
def test_a_race_softer_than_58_hrc_fails(hardness: float, status: str) -> None:
    check = check_of(size(machine(**PINNED, autobalancer__race_hardness_HRC=hardness)), "ABU302")
    assert (check.status, check.value, check.limit) == (status, hardness, 58.0)


def test_balls_are_carried_over_where_the_centrifugal_acceleration_is_gravity() -> None:
    speed = carry_over_speed(0.023)
    assert speed**2 * 0.023 == pytest.approx(9.80665)
    assert carry_over_speed(4 * 0.023) == pytest.approx(speed / 2)


def test_a_vertical_spindle_has_no_carry_over_check_and_rollers_no_groove() -> None:
    design = size(machine(**PINNED, machine__spindle_axis="vertical", autobalancer__corrector="roller"))
    assert "ABU102" not in {check.code for check in design.checks}
    assert design.track.groove_radius is None


def test_slow_rates_are_those_of_the_drag_a_third_and_three_times() -> None:
    rates = size(machine(**PINNED, autobalancer__rolling_drag_per_s=12.0)).track.decay_rates
    assert [drag for drag, _ in rates] == pytest.approx([12.0, 4.0, 36.0])
    assert all(rate > 0 for _, rate in rates)
