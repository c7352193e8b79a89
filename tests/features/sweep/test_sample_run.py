"""Work that takes too long is given up in any thread; one run of a scene."""

import contextlib
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from types import SimpleNamespace

import pytest

from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.features.sweep.sample_run import Overtime, _allowed, limited, scene_once
from tests.dynamics.scenes import dimensionless


def test_work_without_end_is_given_up() -> None:
    begun = time.perf_counter()
    with pytest.raises(Overtime), limited(0.1):
        while True:
            pass
    assert time.perf_counter() - begun < 60
    with limited(0.05):
        pass
    time.sleep(0.1)  # nothing arrives afterwards


def test_the_end_of_the_time_is_told_again_if_something_swallows_it() -> None:
    """As callbacks of the garbage collector do."""
    begun = time.perf_counter()
    with pytest.raises(Overtime), limited(0.05):
        with contextlib.suppress(BaseException):
            while time.perf_counter() - begun < 60:
                pass
        while time.perf_counter() - begun < 60:
            pass


def test_time_is_limited_in_other_threads_too() -> None:
    def endless() -> str:
        try:
            with limited(0.1):
                while True:
                    pass
        except Overtime:
            return "given up"

    with ThreadPoolExecutor(1) as pool:
        assert pool.submit(endless).result(timeout=60) == "given up"


def test_a_scene_above_its_resonance_balances_and_one_below_does_not() -> None:
    """Two balls of 0.02 each balance 0.02 above the natural frequency of 1; below it they join it.

    All three side by side make 0.06; drag holds the balls a little behind.
    """
    above = scene_once(dimensionless(3.0, 0.02, 0.02, 0.1, 0.2, (1.5, -1.7), 200.0), 1e-6)
    below = scene_once(dimensionless(0.5, 0.02, 0.02, 0.1, 0.2, (1.5, -1.7), 200.0), 1e-6)
    assert above.balanced and above.slip < 0.01 and above.response.residual_imbalance < 1e-4
    assert not below.balanced and 0.055 < below.response.residual_imbalance <= 0.06


def test_dry_friction_and_eccentricity_widen_what_is_allowed() -> None:
    """A tenth of the imbalance, and M·Δ of a race that is off by Δ."""
    scene = dimensionless(3.0, 0.1, 0.1, 0.3, 0.05, (1.5, -1.7), 3.0)
    response = SimpleNamespace(ball_angles=(2.0, -2.0))
    plain = _allowed(scene, response)  # type: ignore[arg-type]
    off = replace(scene, effects=(RaceEccentricityEffect(1e-3, 0.0),))
    assert _allowed(off, response) - plain == pytest.approx(scene.support.felt_mass * 1e-3)  # type: ignore[arg-type]
