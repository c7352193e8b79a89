"""Balancing without phase on simulated fans, and layouts that leave two solutions."""

from pathlib import Path

import numpy as np
import pytest

import abu_calc
from abu_calc.foundation.errors import InputError
from tests.cli.runner import abu
from tests.features.balancing.field import Fan, any_fan
from tests.features.balancing.rig import turned, written


def four(fan: Fan, mass: float, first: float, rpm: float = 1500.0) -> list[str]:
    trials = [(mass, (first + 120 * k) % 360) for k in range(3)]
    return [fan.run(rpm, phases=False), *(fan.run(rpm, one, phases=False) for one in trials)]


def quiet(**values: object) -> Fan:
    return Fan(reading_error=0.0, placing_error=0.0, **values)  # type: ignore[arg-type]


@pytest.mark.few(1)
@pytest.mark.parametrize("angle", [0.0, 77.0, 180.0, 301.0])
@pytest.mark.parametrize("mass", [3.0, 100.0])
def test_four_runs_give_mass_and_angle(tmp_path: Path, mass: float, angle: float) -> None:
    """Light and heavy trial masses, the one as large as the imbalance among them."""
    fan = quiet(imbalance=(mass, angle), sensors_deg=(20.0,))
    for trial_mass in (0.4 * mass, mass, 2.5 * mass):
        result = abu_calc.balance(written(tmp_path, fan.plane, *four(fan, trial_mass, 33.0)))
        plane = result.single_plane
        assert result.method == "runs without phase" and result.left is None
        assert plane.mass_g == pytest.approx(mass, rel=1e-6) and abs(turned(plane.angle_deg, angle)) < 1e-4


@pytest.mark.parametrize(
    "count", [12, pytest.param(40, marks=pytest.mark.slow), pytest.param(100, marks=pytest.mark.hard)]
)
@pytest.mark.slow
def test_the_answer_is_within_its_uncertainty(tmp_path: Path, count: int) -> None:
    """Fans of all sizes; trial masses off by a percent, readings too: at least 95 corrections leave what was told."""
    inside = 0
    for seed in range(count):
        fan = any_fan(seed)
        text = four(fan, fan.imbalance[0] * fan.rng.uniform(0.4, 1.5), fan.rng.uniform(0, 360))
        plane = abu_calc.balance(written(tmp_path, fan.plane, *text)).single_plane
        inside += fan.left_by(plane.mass_g, plane.add_at_deg) <= plane.rest_at_most_g_mm
    assert inside >= 0.95 * count


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(1, 4))])
def test_more_sensors_speeds_and_runs_are_all_used(tmp_path: Path, seed: int) -> None:
    """Two sensors, two speeds, five states: the answer is surer than that of four runs, and as good as told."""
    fan = any_fan(seed, sensors=2)
    mass, first = fan.imbalance[0], 10.0
    text = [run for rpm in (1300.0, 1700.0) for run in four(fan, mass, first, rpm)]
    many = abu_calc.balance(
        written(tmp_path, fan.plane, *text, fan.run(1700.0, (mass, 77.0), phases=False))
    ).single_plane
    few = abu_calc.balance(written(tmp_path, fan.plane, *text[:4])).single_plane
    assert many.mass_uncertainty_g < few.mass_uncertainty_g
    assert fan.left_by(many.mass_g, many.add_at_deg) <= 1.5 * many.rest_at_most_g_mm


LAYOUTS = {
    "too few runs": [(10.0, 0.0), (10.0, 120.0)],
    "one line": [(10.0, 0.0), (10.0, 180.0), (20.0, 0.0)],
    "one line or on one circle": [(10.0, 0.0), (10.0 * np.sqrt(2), 45.0), (10.0, 90.0)],  # with zero a square
}


@pytest.mark.parametrize("why", LAYOUTS)
def test_layouts_with_two_solutions_are_refused(tmp_path: Path, why: str) -> None:
    fan = quiet()
    runs = [fan.run(1500.0, phases=False), *(fan.run(1500.0, one, phases=False) for one in LAYOUTS[why])]
    with pytest.raises(InputError) as refused:
        abu_calc.balance(written(tmp_path, fan.plane, *runs))
    assert why in str(refused.value)


def test_phases_for_some_runs_or_two_planes_without_phase_are_refused(tmp_path: Path) -> None:
    fan = quiet()
    with pytest.raises(InputError, match="some have none"):
        abu_calc.balance(written(tmp_path, fan.plane, fan.run(1500.0), *four(fan, 10.0, 0.0)))
    radii = "[rotor]\nleft_correction_radius_mm = 100.0\nright_correction_radius_mm = 100.0"
    with pytest.raises(InputError, match="one plane can be balanced"):
        abu_calc.balance(written(tmp_path, radii, fan.run(1500.0, phases=False)))


TRIALS = ((7.0, 0), (12.0, 120), (18.0, 240))


def test_readings_that_contradict_each_other_are_told(tmp_path: Path) -> None:
    """Amplitudes of 10, 7, 12 and 18: no imbalance makes them with one gain, four readings tell of it."""
    runs = [
        f'[[run]]\nspeed_rpm = 1000\nunit = "mil peak-peak"\nreadings = {{ amplitude = {amplitude} }}\n{extra}\n'
        for amplitude, extra in (
            (10.0, ""), *((a, f"trial = {{ mass_g = 50.0, angle_deg = {at} }}") for a, at in TRIALS),
        )
    ]  # fmt: skip
    errors = "[errors]\namplitude_percent = 0.5"
    result = abu_calc.balance(written(tmp_path, "[single_plane]\ncorrection_radius_mm = 100", *runs, errors))
    agree = next(check for check in result.checks if check.code == "ABU1006")
    assert agree.status in ("warn", "fail") and agree.value > 3


@pytest.mark.slow
def test_a_rotor_that_is_nearly_balanced_is_left_as_it_is(tmp_path: Path) -> None:
    """The imbalance is below what the runs tell: NOT EVALUATED without a grade, PASS within one."""
    with_trial = ((5.2, 0), (5.1, 120), (5.15, 240))
    runs = [
        f'[[run]]\nspeed_rpm = 3000.0\nunit = "mm/s rms"\nleft = {{ amplitude = {amplitude} }}\n{trial}'
        for amplitude, trial in (
            (0.1, ""), *((a, f"trial = {{ mass_g = 5.0, angle_deg = {at} }}\n") for a, at in with_trial)
        )
    ]  # fmt: skip
    rotor = "[rotor]\nmass_kg = 30.0\n[single_plane]\ncorrection_radius_mm = 100.0\n"
    seen = abu("balance", written(tmp_path, rotor, *runs), "--json")
    assert seen.status == 1 and seen.document["result"]["single_plane"]["corrections"] == []
    assert {check["code"]: check["status"] for check in seen.document["checks"]}["ABU1004"] == "not-done"
    assert "remove 0" not in abu("balance", written(tmp_path, rotor, *runs)).out
    graded = abu("balance", written(tmp_path, rotor, *runs, '[tolerance]\nbalance_grade = "G6.3"'), "--json")
    plane = graded.document["result"]["single_plane"]
    assert graded.status == 0 and plane["rest_g_mm"] >= plane["imbalance_g_mm"]
    strict = abu(
        "balance",
        written(tmp_path, rotor, *runs, '[tolerance]\nbalance_grade = "G0.4"\nservice_speed_rpm = 30000'),
        "--json",
    )
    assert strict.status == 1
