"""Closed form, envelope and equations agree as far as they claim; the envelope costs a tenth."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.analysis.differences import QUANTITIES
from abu_calc.analysis.response import evaluate, needed_moments
from abu_calc.analysis.rungs import averaged, closed_form
from abu_calc.dynamics.assemble import assemble
from abu_calc.dynamics.effects.ball_contact import BallContact
from abu_calc.dynamics.effects.gravity import Gravity
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricity
from abu_calc.dynamics.envelope import averages, envelope, not_averaged
from abu_calc.dynamics.integrators import scipy_
from abu_calc.dynamics.supports.tilting import tilting
from abu_calc.errors import InputError
from tests.dynamics.scenes import dimensionless, straight_grinder


def integrated(scene, tolerance=1e-6):
    return evaluate(scene, scipy_.integrate(assemble(scene), tolerance, needed_moments(scene)))


def test_envelope_follows_the_equations_of_a_grinder():
    """Leading order in the balls' rate over the speed, 58 against 607 rad/s, so a tenth for what goes on in the end.

    The suspension's own sway at the start, which it leaves out, pushes the balls as well: a fifth of the settling time.
    """
    scene = replace(straight_grinder(), effects=(RaceEccentricity(1e-5, 0.4), Gravity()))
    slow, full = averaged(scene, 1e-4), integrated(scene)
    assert QUANTITIES["amplitude"](scene, slow, full) < 0.03
    assert QUANTITIES["level"](scene, slow, full) < 0.03
    assert QUANTITIES["settling"](scene, slow, full) < 0.2


def test_envelope_costs_a_tenth():
    """Of evaluations, at a tolerance that does for one per cent, and each is cheaper."""
    scene = straight_grinder()
    run = scipy_.integrate(assemble(scene), 2e-4, needed_moments(scene))
    assert 5 * averaged(scene, 1e-2).evaluations < run.evaluations


def test_closed_form_of_two_balls():
    """cos θ* = −m₀e/(2mR_p); nothing is left; e^{−λt} with the slower root of J s² + h₀ s + κ(1 − |cos 2θ*|) = 0."""
    scene = dimensionless(3.0, 0.002, 0.001, 0.3, 0.05, (1.4, -1.4), 2000.0)
    told = closed_form(scene)
    place = math.acos(-0.25)
    assert sorted(told.ball_angles) == pytest.approx([-place, place])
    assert told.axis_amplitude == 0
    mass, k = 1 + 2 * 0.002, 1.0
    forward = (1 / complex(k - 9 * mass, 3 * 0.6)).real
    kappa = -0.002 * 81 * forward * (1 - abs(math.cos(2 * place)))
    slowest = min(-np.roots([1.0, 0.05, kappa]).real)
    start = abs(0.001 + 2 * 0.002 * math.cos(1.4))
    assert told.settling_time == pytest.approx(math.log(start / 1e-4) / slowest, rel=1e-9)


def test_offset_races_keep_the_axis_whirling():
    scene = replace(dimensionless(3.0, 0.01, 0.01, 0.3, 0.05, (2.0, -2.2), 2000.0), effects=(RaceEccentricity(0.002),))
    assert closed_form(scene).axis_amplitude == pytest.approx(0.002)
    assert averaged(scene, 1e-8).axis_amplitude == pytest.approx(0.002, rel=1e-6)
    assert integrated(scene).axis_amplitude == pytest.approx(0.002, rel=1e-2)


def test_whirl_of_the_envelope_is_the_steady_response():
    """Balls held in their places are more imbalance: the response of the support with their mass, by hand."""
    scene = dimensionless(3.0, 0.01, 0.02, 0.3, 0.05, (0.4, 1.0), 10.0)
    total = 0.02 + 0.01 * (np.exp(0.4j) + np.exp(1j))
    w = total * 9 / complex(1 - 9 * 1.02, 3 * 0.6)
    assert averages(scene).whirl(np.array((0.4, 1.0)))[0] == pytest.approx(w, rel=1e-12)


def test_balls_of_two_planes_are_averaged_apart():
    """On a support that tilts without coupling two like races share alike."""
    support = tilting(1.0, 0.1, 0.05, (0.2, -0.2), ((0.5, 0.5),) * 2, ((0.1, 0.1),) * 2)
    base = dimensionless(3.0, 0.005, 0.004, 0.1, 0.05, (1.5, -1.7), 400.0)
    races = tuple(replace(base.races[0], plane_offset=z) for z in (0.1, -0.1))
    scene = replace(base, support=support, races=races, start_position=(0.0,) * 4, start_velocity=(0.0,) * 4)
    slow = envelope(scene, 1e-8, np.linspace(0, 400, 101))
    np.testing.assert_allclose(slow.theta[:2], slow.theta[2:], atol=1e-5)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"effects": (BallContact(0.1, 0.5),)}, "ball_contact cannot be averaged"),
        ({"speed": 1.02}, "nearest natural frequency"),
    ],
)
def test_averages_say_where_they_do_not_hold(change, reason):
    scene = replace(dimensionless(3.0, 0.01, 0.02, 0.3, 0.05, (0.4, 1.0), 10.0), **change)
    assert reason in (not_averaged(scene) or "")
    for rung in (lambda: averaged(scene, 1e-4), lambda: closed_form(scene)):
        with pytest.raises(InputError):
            rung()


def test_closed_form_is_for_balls_that_balance():
    with pytest.raises(InputError, match="can balance"):
        closed_form(dimensionless(3.0, 0.01, 0.05, 0.3, 0.05, (0.4, 1.0), 10.0))
    with pytest.raises(InputError, match="does not come to rest"):
        closed_form(dimensionless(0.5, 0.0001, 0.0001, 0.3, 0.05, (0.4, 1.0), 20.0))
