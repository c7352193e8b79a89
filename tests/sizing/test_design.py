"""One machine built to a design: what is made stays, what is given anew is computed anew."""

import pytest

from abu_calc.sizing import size
from abu_calc.sizing.design import built, with_worst
from tests.sizing.machines import PINNED, machine


def test_the_machine_of_the_design_is_built_as_designed() -> None:
    design = size(machine(**PINNED))
    same = built(design, machine(**PINNED))
    assert same.autobalancer == design.autobalancer and same.imbalance == design.imbalance
    assert same.checks == () and same.worst == () and same.speed_levels is None


def test_another_wheel_keeps_the_chosen_balls() -> None:
    design = size(machine())
    other = built(design, machine(wheel__imbalance_g_mm=100.0))
    assert other.imbalance.value == pytest.approx(100e-6)
    chosen, made = design.autobalancer, other.autobalancer
    assert (made.ball_count, made.ball_diameter, made.race_radius) == (
        chosen.ball_count, chosen.ball_diameter, chosen.race_radius,
    )  # fmt: skip
    assert chosen.requirement.required - made.requirement.required == pytest.approx(150e-6)


def test_a_race_made_otherwise_is_that_of_the_file() -> None:
    design = size(machine(**PINNED))
    larger = built(design, machine(**{**PINNED, "autobalancer__race_radius_mm": 30.4}))
    assert larger.autobalancer.race_radius == pytest.approx(30.4e-3)
    assert larger.autobalancer.capacity > design.autobalancer.capacity


def test_worst_arrangements_come_back_on_demand() -> None:
    design = size(machine(**PINNED))
    assert with_worst(built(design, machine(**PINNED))).worst == design.worst != ()
    assert design.system_mass == pytest.approx(5.6 + 0.6 + design.autobalancer.mass)
