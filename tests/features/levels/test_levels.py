"""Levels carried from place to place, tones added as energy, and the times that a run is sampled at.

Checks of levels of known motions: octaves, weighted overall level, daily exposure, static loads of hands.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.features.levels.levels import (
    Band,
    PlaceLevels,
    axis_level,
    axis_levels,
    carried,
    duration_for,
    halves_differ,
    held_loads,
    level_checks,
    times_for,
    with_tone,
)
from abu_calc.features.levels.octaves import AxisSignal
from abu_calc.foundation.checks import Check
from abu_calc.sizing import size
from abu_calc.standards.vibration import octaves
from tests.dynamics.scenes import dimensionless
from tests.sizing.machines import machine

BANDS = tuple(Band(octave, 3e-3 if octave.nominal == 125 else None, None) for octave in octaves())
PLACE = PlaceLevels(
    "race", (axis_level("x", 3e-3, BANDS, 3e-6, 3.0, None), axis_level("y", 1e-3, BANDS, 1e-6, 9.0, None))
)


def test_a_place_takes_the_largest_of_its_axes() -> None:
    assert PLACE.velocity == 3e-3 and PLACE.louder("acceleration") == 9.0 and PLACE.total is None
    assert not PLACE.complete and PLACE.loudest[4].velocity == 3e-3
    weighted = replace(
        PLACE,
        axes=tuple(replace(axis, weighted_acceleration=a) for axis, a in zip(PLACE.axes, (3.0, 4.0), strict=True)),
    )
    assert weighted.total == pytest.approx(5.0)


def test_a_place_that_moves_half_as_much_has_half_of_everything() -> None:
    half = carried(PLACE, "grip", 0.5)
    assert half.name == "grip" and half.velocity == 1.5e-3 and half.louder("displacement_rms") == 1.5e-6
    assert [band.velocity for band in half.axes[0].bands if band.velocity is not None] == [1.5e-3]
    assert half.axes[0].weighted_acceleration is None  # what is not known stays so


def test_a_tone_is_added_as_energy_in_its_own_octave() -> None:
    """3 and 4 make 5; 100 Hz lie in the octave of 125 Hz; a = v·ω, x = v/ω."""
    omega = 2 * math.pi * 100
    louder = with_tone(PLACE, 4e-3, 0.16, omega)
    assert louder.axes[0].velocity_rms == pytest.approx(5e-3)
    assert louder.axes[0].bands[4].velocity == pytest.approx(5e-3)
    assert louder.axes[0].acceleration == pytest.approx(math.hypot(3.0, 4e-3 * omega))
    assert louder.axes[0].displacement_rms == pytest.approx(math.hypot(3e-6, 4e-3 / omega))
    elsewhere = with_tone(PLACE, 4e-3, 0.16, 2 * math.pi * 31.5)
    assert elsewhere.axes[0].bands[4].velocity == 3e-3 and elsewhere.axes[0].velocity_rms == pytest.approx(5e-3)


def test_a_second_half_twice_as_large_is_six_decibels_louder() -> None:
    wave = np.sin(2 * math.pi * 50 * np.arange(4000) / 1000)
    signal = AxisSignal(np.where(np.arange(4000) < 2000, wave, 2 * wave), 1000.0, 0)
    assert halves_differ(signal) == pytest.approx(20 * math.log10(2), abs=1e-6)
    assert halves_differ(AxisSignal(np.zeros(100), 1000.0, 0)) is None
    late = AxisSignal(np.concatenate([100 * wave[:2000], wave[:2000]]), 1000.0, 0, start=2.0)
    assert halves_differ(late) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("derivative", [-1, 0])
def test_the_whole_velocity_of_a_sine_is_its_rms(derivative: int) -> None:
    t, omega = np.arange(8192) / 4096, 2 * math.pi * 125
    samples = -np.cos(omega * t) / omega if derivative == -1 else np.sin(omega * t)
    velocity = axis_levels("x", AxisSignal(samples, 4096.0, derivative)).velocity_rms
    assert velocity == pytest.approx(math.sqrt(0.5), rel=2e-3)


def test_a_run_is_sampled_fast_enough_and_long_enough() -> None:
    """The slowest octave is that of 8 Hz, the fastest that of 1000 Hz."""
    scene = dimensionless(600.0, 0.01, 0.01, 0.3, 0.05, (1.5, -1.7), 2.0)
    assert duration_for(scene) > scene.duration + 1 / 8
    longer = replace(scene, duration=duration_for(scene))
    times = times_for(longer)
    steps = np.diff(times)
    assert times[-1] == longer.duration and times[0] >= 0 and np.ptp(steps) < 1e-12
    assert 1 / steps[0] >= max(4096.0, 40 * 600 / math.tau) * (1 - 1e-12)


REFERENCE = 5e-8


def velocity(level: float) -> float:
    """Rms velocity [m/s] of a level [dB]."""
    return REFERENCE * 10 ** (level / 20)


def place(levels: dict[float, float], name: str = "grip", weighted: float | None = 1.0) -> PlaceLevels:
    """One axis with these octaves [Hz: dB]; the others are not known."""
    bands = tuple(
        Band(octave, velocity(levels[octave.nominal])) if octave.nominal in levels else Band(octave, None, "too short")
        for octave in octaves()
    )
    return PlaceLevels(name, (axis_level("x", None, bands, None, None, weighted, "too short"),))


QUIET = {octave.nominal: 60.0 for octave in octaves()}


def by_name(places: list[PlaceLevels], minutes: float | None = None) -> dict[str, Check]:
    return {check.name: check for check in level_checks(places, minutes)}


def test_the_loudest_place_decides_an_octave() -> None:
    """Limit of the octave of 125 Hz: 109 dB (GOST 17770-86)."""
    checks = by_name([place(QUIET | {125: 108.9}), place(QUIET | {125: 109.1}, "rear")])
    check = checks["octave level, 125 Hz"]
    assert (check.status, check.limit) == ("fail", 109) and check.value == pytest.approx(109.1)
    assert by_name([place(QUIET | {125: 108.9})])["octave level, 125 Hz"].status == "pass"


def test_a_missing_octave_leaves_the_total_open_unless_it_fails() -> None:
    """The limit of the total is 112 dB; the octave of 8 Hz counts with half its velocity, 6.02 dB less."""
    without = {nominal: level for nominal, level in QUIET.items() if nominal != 1000}
    checks = by_name([place(without)])
    assert (
        checks["octave level, 1000 Hz"].status == "not-done" and checks["weighted overall level"].status == "not-done"
    )
    assert by_name([place(without | {63: 112.1})])["weighted overall level"].status == "fail"
    low = by_name([place(QUIET | {8: 118.0})])["weighted overall level"]
    assert low.status == "pass" and low.value == pytest.approx(118.0 - 20 * math.log10(2), abs=1e-3)


@pytest.mark.parametrize(("weighted", "status"), [(1.4, "pass"), (1.5, "warn"), (4.9, "warn"), (5.1, "fail")])
def test_one_axis_stands_for_up_to_three(weighted: float, status: str) -> None:
    """Eight hours: A(8) = a_h; 1.7 a_h may be the total, which calls for measures above 2.5 m/s²."""
    check = by_name([place(QUIET, weighted=weighted)], 480)["daily exposure"]
    assert check.status == status and check.value == pytest.approx(weighted)
    if weighted > 2.5:
        assert f"Limit the use to {480 * (2.5 / weighted) ** 2:.3g} minutes a day" in (check.remedy or "")
        assert f"from {weighted:g} to 2.5 m/s² (calculated)" in (check.remedy or "")


def test_an_axis_without_its_weighted_acceleration_leaves_the_exposure_open() -> None:
    check = by_name([place(QUIET), place(QUIET, "rear", None)], 60)["daily exposure"]
    assert check.status == "not-done" and check.value is None and check.message == "too short"


RIGID = {"machine__transverse_inertia_kg_m2": 0.1, "machine__center_of_mass_to_wheel_mm": 200.0}


@pytest.mark.slow
def test_one_handle_carries_everything_and_none_or_three_leave_it_open() -> None:
    handles = [{"name": f"grip {k}", "from_center_of_mass_mm": 100.0 * k} for k in range(3)]
    design = size(machine(**RIGID, machine__handle=handles[:1]))
    ((without, fitted),) = held_loads(design).values()
    assert without == pytest.approx(design.case.body.mass * 9.80665)
    assert fitted - without == pytest.approx(design.autobalancer.mass * 9.80665)
    assert held_loads(size(machine(**RIGID))) == {}
    assert held_loads(size(machine(**RIGID, machine__handle=handles))) == {}
