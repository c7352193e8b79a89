"""The slow motion in closed form, against the eigenvalues of the whole system."""

import math

import numpy as np
import pytest

from abu_calc.formulas.slow_motion import ball_stiffness, decay_rate, optimum_drag, slow_rates, slow_stiffness
from abu_calc.foundation.errors import InputError
from tests.dynamics.equations.test_assemble import rotating_frame_eigenvalues
from tests.dynamics.scenes import dimensionless


def test_slow_rates_are_eigenvalues_of_the_whole_system():
    """Leading order in (m/M)^{1/2} = 0.3 %, over what damping leaves: 2 %. J = 7/5, so that J matters."""
    ball, speed, damping, drag, J = 1e-5, 3.0, 0.05, 0.002, 1.4
    half = math.acos(-0.4)
    scene = dimensionless(speed, ball, 0.8 * ball, damping, drag, (0.0, 1.0), 10.0, inertia_factor=J)
    values = rotating_frame_eigenvalues(scene, (half, -half))
    kappa = ball_stiffness(ball, 1 + 2 * ball, speed, (1.0, 1.0))
    for stiffness in slow_stiffness((kappa, kappa), (half, -half)):
        for rate in slow_rates(stiffness, drag, J):
            assert min(abs(values - rate)) < 0.02 * abs(rate)


def test_two_slow_stiffnesses_and_the_rest_neutral():
    """K_kj = κ_j cos(θ_k − θ_j) itself, unequal balls."""
    kappas, angles = np.array([1.0, 2.0, 0.5, 3.0]), np.array([0.1, 2.0, 3.0, 5.0])
    K = kappas * np.cos(angles[:, None] - angles[None, :])
    np.testing.assert_allclose(
        sorted(np.linalg.eigvals(K).real), [0, 0, *slow_stiffness(tuple(kappas), tuple(angles))], atol=1e-12
    )


@pytest.mark.parametrize(("speed", "balances"), [(200, False), (460, True), (620, False), (1000, True)])
def test_regions_of_an_anisotropic_support(speed, balances):
    """Natural frequencies 300 and 700: balls balance from 300 to √((300² + 700²)/2) = 538 and above 700."""
    assert (ball_stiffness(0.01, 5.0, speed, (300.0, 700.0)) > 0) is balances


def test_decay():
    """κ(1 ∓ |cos Δ|) = 0.5 and 1.5, J = 1: drag 3 leaves the slow roots (−3 ± √7)/2 and (−3 ± √3)/2."""
    rate = decay_rate((1.0, 1.0), (0.0, math.pi / 3), 3.0, 1.0)
    assert rate == pytest.approx((3 - math.sqrt(7)) / 2, rel=1e-12)
    assert decay_rate((-1.0, -1.0), (0.0, 1.0), 3.0, 1.0) < 0


def test_optimum_drag_gives_the_fastest_decay():
    best = optimum_drag(214.0, 1.4)
    rates = [-slow_rates(214.0, best * share, 1.4)[0].real for share in (0.9, 1.0, 1.1)]
    assert rates[1] > rates[0]
    assert rates[1] > rates[2]


def test_what_does_not_settle_is_refused():
    with pytest.raises(InputError, match="no drag"):
        optimum_drag(-1.0, 1.0)
    with pytest.raises(InputError, match="natural frequency"):
        ball_stiffness(0.01, 1.0, 2.0, (2.0, 1.0))
