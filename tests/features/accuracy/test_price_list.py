"""The price list of a scene: what is measured, chosen, skipped and refused."""

import math
from dataclasses import replace

import pytest

from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.integrators import choice
from abu_calc.features.accuracy import study as module
from abu_calc.features.accuracy.study import MeasuredPoint, Reference, cheapest, price_list
from abu_calc.features.accuracy.view import picture
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.simulation.subject import Ledger
from tests.dynamics.scenes import dimensionless, straight_grinder, with_effects


def quiet(_: str) -> None:
    """No progress."""


TOLD: list[str] = []
"""Of the study below."""


@pytest.fixture(scope="module")
def measured():
    """Timed once, and not at the tightest: that takes implicit methods longer than all the rest."""
    scene = dimensionless(3.0, 0.01, 0.01, 0.3, 0.05, (1.5, -1.7), 20.0)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "REPEATS", 1)
        patch.setattr(module, "TOLERANCES", module.TOLERANCES[:-1])
        return price_list(scene, Ledger(scene, (), scene), "amplitude", 0.01, 3600.0, TOLD.append)


@pytest.mark.slow
def test_every_rung_and_integrator_is_measured(measured):
    assert not measured.skipped
    kinds = {(point.rung, point.integrator) for point in measured.points}
    assert {("closed-form", None), ("envelope", "scipy-lsoda")} <= kinds
    assert {("equations", f"scipy-{name}") for name in ("dop853", "rk45", "lsoda", "radau", "bdf")} <= kinds


@pytest.mark.slow
def test_errors_fall_with_the_tolerance(measured):
    """From 1e-3 to 1e-8 of every integrator by three orders or more, or to where the reference ends."""
    for name in {point.integrator for point in measured.points if point.rung == "equations"}:
        errors = {point.tolerance: point.error for point in measured.points
                  if point.integrator == name and point.rung == "equations"}  # fmt: skip
        assert errors[1e-8] <= max(1e-3 * errors[1e-3], 3 * measured.reference.disagreement, 1e-9), name


@pytest.mark.slow
def test_the_choice_is_the_quickest_that_suffices(measured):
    chosen = measured.chosen
    assert chosen.error + measured.reference.disagreement <= 0.01
    for point in measured.points:
        assert point.error is None or point.error > 0.009 or point.wall_s >= chosen.wall_s


@pytest.mark.slow
def test_a_point_the_reference_cannot_vouch_for_is_not_chosen(measured):
    vague = replace(measured.reference, disagreement=0.02)
    assert cheapest(list(measured.points), 0.01, vague) is None


@pytest.mark.slow
def test_a_point_that_tighter_tolerances_of_its_method_do_not_confirm_came_near_by_chance(measured):
    """Motions with two ends: a loose run may land at the right one."""
    points = [
        MeasuredPoint(
            rung="equations",
            integrator="compiled-rk45",
            tolerance=tolerance,
            error=error,
            evaluations=100,
            steps=10,
            wall_s=wall,
            cold_s=wall,
        )
        for tolerance, error, wall in ((1e-4, 4e-4, 0.1), (1e-5, 1.5, 0.2), (1e-6, 1e-3, 0.3), (1e-8, 1e-4, 0.5))
    ]
    sure = replace(measured.reference, disagreement=1e-3)
    assert cheapest(points, 0.01, sure) == points[2]
    assert cheapest(points[:2], 0.01, sure) is None


def test_where_scipy_takes_too_long_for_its_events_the_loop_verifies_itself(monkeypatch):
    """Both of its methods, at tighter tolerances until they agree."""
    scene = replace(straight_grinder(), duration=0.3)
    scene = with_effects(scene, GravityEffect(), DryRollingFrictionEffect(8e-6, 0.008))
    asked = []

    def integrate(name, equations, tolerance, *more):
        asked.append((name, tolerance))
        return integrate_with(name, equations, tolerance, *more)

    integrate_with = choice.integrate_with
    monkeypatch.setattr(module, "ASKED", 1.0)
    monkeypatch.setattr(choice, "integrate_with", integrate)
    apart = iter((1.0, 1e-3))
    monkeypatch.setitem(module.QUANTITIES, "amplitude", lambda *_: next(apart, 0.0))
    reference = module._reference(scene, "amplitude", 0.01, 20.0)
    assert reference.integrators == ("compiled-rk45", "compiled-dop853") and reference.disagreement == 1e-3
    assert asked[-2:] == [("compiled-rk45", 1e-8), ("compiled-dop853", 1e-9)] and reference.tolerances == (1e-8, 1e-9)


@pytest.mark.slow
def test_the_picture_stays_within_eighty_columns(measured):
    lines = picture(measured.points)
    assert max(map(len, lines)) <= 80
    assert any("D" in line for line in lines)


def test_no_time_is_told_beforehand():
    scene = dimensionless(3.0, 0.01, 0.01, 0.3, 0.05, (1.5, -1.7), 60.0)
    with pytest.raises(NotTrustworthyError, match="the reference alone takes"):
        price_list(scene, Ledger(scene, (), scene), "amplitude", 0.01, 1e-6, quiet)


@pytest.mark.slow
def test_a_reference_that_two_methods_do_not_share_is_none(monkeypatch):
    scene = dimensionless(3.0, 0.01, 0.01, 0.3, 0.05, (1.5, -1.7), 60.0)
    monkeypatch.setitem(module.QUANTITIES, "amplitude", lambda *_: math.inf)
    with pytest.raises(NotTrustworthyError, match="no reference"):
        price_list(scene, Ledger(scene, (), scene), "amplitude", 0.01, 60.0, quiet)


@pytest.mark.slow
def test_unknown_quantities_are_refused(measured):
    with pytest.raises(InputError, match="known quantities"):
        price_list(measured.reference.response, Ledger(None, (), None), "beauty", 0.01, 1.0, quiet)
    assert isinstance(measured.reference, Reference)


@pytest.mark.slow
def test_each_method_tells_how_many_are_done(measured):
    shares = [one.share for one in TOLD[1:]]
    assert TOLD[0] == "reference" and len(shares) == len(measured.points)
    assert shares[0] == 0 and shares == sorted(set(shares)) and shares[-1] == pytest.approx(1 - 1 / len(shares))
