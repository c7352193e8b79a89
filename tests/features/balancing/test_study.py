"""The result of balancing: averages of runs, the verification run, the formula as published."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import abu_calc
from abu_calc.features.balancing.methods import solved
from abu_calc.features.balancing.runs import Balancing
from tests.features.balancing.rig import RIG, ROTOR, Simulated, Workshop, turned, written
from tests.features.balancing.test_errors import spoilt
from tests.features.balancing.test_methods import OMEGA, ROLL, grams, run_of


def test_a_roll_at_rest_has_nothing_to_correct(tmp_path: Path) -> None:
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR, Workshop(masses=(0.0, 0.0)).run()))
    assert (result.left.mass_g, result.right.mass_g) == (0.0, 0.0)
    assert result.status == "pass" and result.left.angle_uncertainty_deg == 180


def test_the_printed_formula_with_accelerations_points_to_the_wrong_side(tmp_path: Path) -> None:
    shop = Workshop(quantity="acceleration")
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR, shop.run()))
    for plane, at in ((result.left, 205.0), (result.right, 320.0)):
        assert plane.printed_mass_g is not None and plane.printed_angle_deg is not None
        points = plane.printed_angle_deg + (180 if plane.printed_mass_g < 0 else 0)
        assert abs(turned(points, at + 180)) < 1e-6  # metal would go on the wrong side
        assert abs(plane.printed_mass_g) == pytest.approx(OMEGA**2 * plane.mass_g, rel=1e-9)
        assert abs(turned(plane.angle_deg, at)) < 1e-6
    assert pytest.approx(98696, abs=0.5) == OMEGA**2
    (said,) = [line for line in result.warnings if "as published" in line]
    assert "wrong side" in said and "25.0° left" in said and "140.0° right" in said


@pytest.mark.slow
def test_the_verification_run_is_as_predicted(tmp_path: Path) -> None:
    """Rigs that differ from the file, readings and corrections off by their errors: rms, and twice it as a bound."""
    said = RIG + "damping_ratio = 0.0\n"
    errors = "[errors]\ndamping_ratio = 0.0\n"
    shop = Workshop()
    result = abu_calc.balance(written(tmp_path, said, ROTOR, shop.run(), errors))
    (expected,) = result.residual_check.verification
    rng, after = np.random.default_rng(7), []
    for _ in range(400):
        true = spoilt(ROLL, rng)
        rig = Simulated(**{key: getattr(true, key) for key in ["M1", "M2", "C1", "C2", "M3", "J3", "a", "b", "c", "d"]})
        real = Workshop(rig)
        run = run_of(real)
        run = replace(
            run, amplitudes=tuple(a * (1 + 0.01 * rng.standard_normal()) for a in run.amplitudes),
            phases=tuple(p + math.radians(1) * rng.standard_normal() for p in run.phases),
            speed=run.speed * (1 + 0.001 * rng.standard_normal()),
        )  # fmt: skip
        for plane, (mass, angle) in enumerate(grams(solved(Balancing(ROLL, (run,)), "rig data"))):
            put, at = mass * (1 + 0.01 * rng.standard_normal()), angle + 180 + rng.standard_normal()
            real = real.put_on(plane, put, at)
        after.append(1e3 * np.abs(real.motion()))
    rms = np.sqrt(np.mean(np.square(after), axis=0))
    assert (expected.left_expected, expected.right_expected) == pytest.approx(tuple(rms), rel=0.12)
    most = np.array([expected.left_at_most, expected.right_at_most])
    assert np.mean(np.array(after) > most, axis=0).max() < 0.07


def test_several_runs_are_averaged_as_vectors(tmp_path: Path) -> None:
    first, other = (
        Workshop(masses=(10.0, 5.0), angles=(10.0, 80.0)),
        Workshop(masses=(12.0, 5.0), angles=(350.0, 100.0)),
    )
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR, first.run(), other.run()))
    mean = (first.vectors() + other.vectors()) / 2
    assert (result.left.mass_g, result.right.mass_g) == pytest.approx(tuple(np.abs(mean)), rel=1e-9)
    assert abs(turned(result.left.angle_deg, -np.degrees(np.angle(mean[0])))) < 1e-9
    assert next(check for check in result.checks if check.code == "ABU1006").status in ("warn", "fail")
    again = abu_calc.balance(written(tmp_path, RIG, ROTOR, first.run(), first.run()))
    assert next(check for check in again.checks if check.code == "ABU1006").status == "pass"
