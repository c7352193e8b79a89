"""Numbers of a file of readings in SI: amplitudes, trial masses, errors; warnings about records."""

import math
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.balancing.case import balancing, deviations, record_warnings, taken_runs
from abu_calc.features.balancing.tables import Errors
from abu_calc.foundation.errors import InputError
from tests.features.balancing.rig import BARE_ROTOR, RIG, ROTOR, written

RUN = """\
[[run]]
speed_rpm = 600.0
quantity = "{quantity}"
left = {{ amplitude = 2.0, phase_deg = 90.0 }}
right = {{ amplitude = 0.5, phase_deg = -45.0 }}
sensor_to_mark_deg = 30.0
trial = {{ plane = "right", mass_g = 4.0, angle_deg = 60.0 }}
"""


@pytest.mark.parametrize(("quantity", "scale"), [("displacement", 1e-3), ("velocity", 1e-3), ("acceleration", 1.0)])
def test_a_run_is_in_si(tmp_path: Path, quantity: str, scale: float) -> None:
    """600 rpm are 20π rad/s; a trial without a radius sits at the correction radius of its plane, 150 mm."""
    (taken,) = taken_runs(abu_calc.read_readings(written(tmp_path, BARE_ROTOR, RUN.format(quantity=quantity))))
    run = taken.run
    assert run.speed == pytest.approx(20 * math.pi)
    assert run.amplitudes == pytest.approx((2.0 * scale, 0.5 * scale))
    assert run.phases == pytest.approx((math.pi / 2, -math.pi / 4)) and run.sensor == pytest.approx(math.pi / 6)
    (weight,) = run.weights
    assert (weight.plane, weight.mass, weight.radius) == (1, pytest.approx(4e-3), pytest.approx(0.15))
    assert weight.imbalance == pytest.approx(6e-4 * (0.5 - 1j * math.sqrt(0.75)))
    assert record_warnings(taken) == [] and taken.instrument.quantity == quantity


def test_the_roll_is_known_only_with_the_rig(tmp_path: Path) -> None:
    bare = abu_calc.read_readings(written(tmp_path, BARE_ROTOR, RUN.format(quantity="velocity")))
    assert balancing(bare.tables, taken_runs(bare)).roll is None
    whole = abu_calc.read_readings(written(tmp_path, RIG, ROTOR, RUN.format(quantity="velocity")))
    roll = balancing(whole.tables, taken_runs(whole)).roll
    assert roll is not None and (roll.a, roll.b, roll.c, roll.d) == (0.15, 0.52, 0.61, 0.20)
    assert roll.length == pytest.approx(1.48) and (roll.M3, roll.J3) == (64.0, 9.5)


def test_errors_in_percent_and_degrees_become_parts_and_radians() -> None:
    sigma = deviations(Errors(amplitude_percent=2.0, phase_deg=180 / math.pi, length_mm=3.0, placed_angle_deg=90.0))
    assert (sigma.amplitude, sigma.phase, sigma.length) == pytest.approx((0.02, 1.0, 0.003))
    assert sigma.placed_angle == pytest.approx(math.pi / 2)
    assert sigma.speed == pytest.approx(0.001) and sigma.damping_ratio == pytest.approx(0.01)


def test_a_record_that_cannot_be_read_is_refused_by_its_name(tmp_path: Path) -> None:
    (tmp_path / "run1.csv").write_text("time,left,right,mark\n0,1,2,3\n1,2,x,4\n", encoding="utf-8")
    run = '[[run]]\nquantity = "velocity"\nfile = "run1.csv"\n'
    readings = abu_calc.read_readings(written(tmp_path, RIG, ROTOR, run))
    with pytest.raises(InputError) as refused:
        taken_runs(readings)
    assert refused.value.place.line == 3 and str(refused.value.place.file).endswith("run1.csv")
