"""Numbers of a file of readings in SI: amplitudes, trial masses, errors; warnings about records."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

import abu_calc
from abu_calc.features.balancing.case import balancing, record_warnings, taken_runs
from abu_calc.features.balancing.tables import Errors
from abu_calc.foundation.errors import InputError
from tests.features.balancing.rig import BARE_ROTOR, RIG, ROTOR, Workshop, trial, written

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
    sigma = Errors(amplitude_percent=2.0, phase_deg=180 / math.pi, length_mm=3.0, placed_angle_deg=90.0)
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


# Conventions


def leading(run: str) -> str:
    """The same run as an instrument with leading phases shows it."""
    turned_ = re.sub(r"phase_deg = (-?[0-9.e-]+)", lambda found: f"phase_deg = {-float(found[1])!r}", run)
    return turned_ + 'phase = "lead"\n'


@pytest.mark.parametrize("quantity", ["displacement", "velocity", "acceleration"])
def test_leading_phases_give_the_same_answer(tmp_path: Path, quantity: str) -> None:
    shop = Workshop(quantity=quantity, sensor_deg=35.0)
    lag = abu_calc.balance(written(tmp_path, RIG, ROTOR, shop.run() + 'phase = "lag"\n'))
    lead = abu_calc.balance(written(tmp_path, RIG, ROTOR, leading(shop.run())))
    silent = abu_calc.balance(written(tmp_path, RIG, ROTOR, shop.run()))
    for one in (lag, lead, silent):
        assert (one.left.mass_g, one.left.angle_deg) == pytest.approx((12.0, 205.0), rel=1e-9)
        assert (one.right.mass_g, one.right.angle_deg) == pytest.approx((7.0, 320.0), rel=1e-9)
    grades = [next(c.status for c in one.checks if c.code == "ABU1009") for one in (lag, lead, silent)]
    assert grades == ["pass", "pass", "warn"]
    assert silent.status == "pass" and lead.runs[0].phase == "lead"
    assert lead.runs[0].left.phase_deg == pytest.approx(-lag.runs[0].left.phase_deg)


def test_marks_with_rotation_turn_trials_places_and_orders(tmp_path: Path) -> None:
    """The rotor of 12 g at 205° against rotation has them at 155° on marks that count with it."""
    shop = Workshop()
    trials = [(0, 10.0, 40.0), (1, 8.0, 300.0)]
    runs = [shop.run(), *(shop.put_on(k, m, a).run(trial(k, m, 360 - a)) for k, m, a in trials)]
    marks = 'angle_marks = "with"\nleft_places_deg = [0, 120, 240]\n'
    result = abu_calc.balance(written(tmp_path, BARE_ROTOR + marks, *runs))
    assert result.left.angle_deg == pytest.approx(205.0) and result.left.remove_at_deg == pytest.approx(155.0)
    assert result.left.add_at_deg == pytest.approx(335.0) and result.right.remove_at_deg == pytest.approx(40.0)
    places = np.array([s.mass_g * np.exp(1j * np.radians(s.angle_deg)) for s in result.left.corrections])
    assert sum(places) == pytest.approx(12.0 * np.exp(1j * np.radians(155.0)), rel=1e-9)
    assert result.angle_marks == "with rotation"


def test_phase_with_a_record_and_marks_of_another_kind_are_refused(tmp_path: Path) -> None:
    (tmp_path / "run1.csv").write_text("time,left,right,mark\n", encoding="utf-8")
    for text, words in (
        ('[[run]]\nquantity = "velocity"\nfile = "run1.csv"\nphase = "lag"\n', "phase goes with readings only"),
        ('[[run]]\nunit = "mm/s rms"\nfile = "run1.csv"\n', "no rms"),
        (Workshop().run() + 'phase = "ahead"\n', "lag"),
    ):
        with pytest.raises(InputError) as refused:
            abu_calc.read_readings(written(tmp_path, RIG, ROTOR, text))
        assert words in str(refused.value)
