"""Work by counting: rates of one mass on a spring, stiffness, and how counts grow."""

import math
from dataclasses import replace

import pytest

from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators.work_estimates import counts, cycles, rates, softer, stiff
from abu_calc.dynamics.supports.planar import planar
from tests.dynamics.scenes import dimensionless, scene_on


def bare(stiffness: float, damping: float, speed: float = 2.0) -> Equations:
    """A mass of 1 kg without balls for 10 s."""
    plain = dimensionless(speed, 0.05, 0.01, 0.0, 0.0, (), 10.0)
    return assemble(replace(plain, races=(), support=planar(1.0, (stiffness,) * 2, (damping,) * 2)))


def test_rates_are_those_of_a_damped_spring() -> None:
    """s² + 2s + 101 = 0: −1 ± 10i; slower than the rotor's turning that turning counts."""
    assert rates(bare(101.0, 2.0)) == pytest.approx((1.0, 10.0))
    assert rates(bare(101.0, 2.0, 30.0)) == pytest.approx((1.0, 30.0))
    assert cycles(bare(101.0, 2.0)) == pytest.approx(10 * 10 / (2 * math.pi))


def test_what_dies_out_far_faster_than_it_turns_is_stiff() -> None:
    """s² + cs + 1 = 0 decays by about c: beyond fifty times the 2 rad/s of the rotor."""
    assert not stiff(bare(1.0, 99.0))
    assert rates(bare(1.0, 110.0))[0] == pytest.approx(110.0, rel=1e-3) and stiff(bare(1.0, 110.0))


def test_what_oscillates_ten_times_a_turn_is_told_in_hertz() -> None:
    assert softer(bare(19.9**2, 0.0)) == ""
    remedy = softer(bare((2 * math.pi * 5) ** 2, 0.0))
    assert "5 Hz" in remedy and "15.7 times in a revolution" in remedy


def test_smooth_work_grows_by_the_order_of_the_method() -> None:
    """Of order 8: a hundred million times the accuracy for ten times the work."""
    coarse, fine = (counts(bare(101.0, 2.0), tolerance) for tolerance in (1e-4, 1e-12))
    assert fine.scipy == pytest.approx(10 * coarse.scipy) and coarse.events == fine.events == 0.0


def test_gravity_makes_ten_times_the_events() -> None:
    friction = DryRollingFrictionEffect(0.02, 0.1)
    still, shaken = (
        counts(assemble(scene_on("planar", *more, friction)), 1e-6) for more in ((), (GravityEffect(0.3),))
    )
    assert shaken.events == pytest.approx(10 * still.events) and still.events > 0
