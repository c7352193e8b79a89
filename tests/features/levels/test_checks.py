"""Checks of levels of known motions: octaves, weighted overall level, daily exposure, static loads of hands."""

import math

import pytest

from abu_calc.features.levels.levels import Band, PlaceLevels, axis_level, held_loads, level_checks
from abu_calc.foundation.checks import Check
from abu_calc.sizing import size
from abu_calc.standards.vibration import octaves
from tests.sizing.machines import machine

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
