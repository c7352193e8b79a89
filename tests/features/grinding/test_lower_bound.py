"""Levels under load that are lower bounds: their weighted total by ISO 5349-1, and a wheel without runout."""

import math
from typing import Any

import pytest

from abu_calc.features.grinding.steady_contact import LEAST, LevelBound, lower_bound
from abu_calc.features.grinding.work import Work, at_work
from abu_calc.sizing import size
from tests.sizing.machines import machine

WEIGHT_100_HZ = 0.160
"""W_h of the third octave of 100 Hz, ISO 5349-1:2001."""


def _work(runout_mm: float, **changes: Any) -> Work:
    usual: dict[str, Any] = {
        "machine__speed_rpm": 6000,
        "machine__spindle_axis": "vertical",
        "wheel__runout_mm": runout_mm,
        "grinding": {"contact_stiffness_N_per_m": 1e5, "press_force_N": 300.0},
    }
    return at_work(size(machine(**{**usual, **changes})), 0.01)


def _bound(work: Work) -> LevelBound | None:
    """Of the usual case."""
    return lower_bound(work.levels.after, work.design.case)


@pytest.mark.few(1)
@pytest.mark.parametrize(("eccentricity_mm", "holds"), [(0.005, True), (0.01, True), (0.03, False)])
@pytest.mark.slow
def test_the_threshold_is_one_weighted_metre_per_second_squared(eccentricity_mm: float, holds: bool) -> None:
    """a_hv = √2·W_h·Ω·v with v of the level, on both sides of the threshold."""
    work = _work(0.02, autobalancer__race_eccentricity_mm=eccentricity_mm)
    bound, level = _bound(work), work.levels.after
    assert bound is not None and level is not None
    own = math.sqrt(2) * WEIGHT_100_HZ * 2 * math.pi * 100 * 5e-8 * 10 ** (level / 20)
    assert bound.total == pytest.approx(own, rel=0.01)
    assert bound.lower_bound is (own < LEAST) is holds
    assert bool(bound.sentence) is bound.lower_bound
    assert "the wheel's runout" in bound.set_by and "wheel waviness" in bound.lacks


@pytest.mark.slow
def test_a_wheel_without_runout_is_marked_however_loud_it_is() -> None:
    """Nothing but what race and friction leave drives it: the file says that the wheel of a grinder runs true."""
    bound = _bound(_work(0.0, autobalancer__race_eccentricity_mm=0.03))
    assert bound is not None and bound.lower_bound and bound.total is not None and bound.total > LEAST
    assert any("runout" in lacking for lacking in bound.lacks)
    assert not any("runout" in excitation for excitation in bound.set_by)
    assert "is a lower bound" in bound.sentence and "lacks" in bound.sentence


@pytest.mark.slow
def test_a_face_does_not_press_and_lacks_the_force_of_its_contact() -> None:
    bound = _bound(_work(0.0, grinding={"contact": "face"}))
    assert bound is not None and "the force of the contact" in bound.lacks
    assert bound.lower_bound is (bound.total is not None and bound.total < LEAST)


@pytest.mark.slow
def test_a_background_of_the_file_is_not_lacking() -> None:
    without, given = _bound(_work(0.1)), _bound(_work(0.1, machine__background_level_db=95.0))
    assert without is not None and given is not None
    assert "vibration of motor and gear" in without.lacks and "vibration of motor and gear" not in given.lacks
