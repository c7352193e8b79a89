"""Levels carried from place to place, tones added as energy, and the times that a run is sampled at."""

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
    times_for,
    with_tone,
)
from abu_calc.features.levels.octaves import AxisSignal
from abu_calc.standards.vibration import octaves
from tests.dynamics.scenes import dimensionless

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
