"""Corrections by metal and places, and the permitted imbalance of each plane."""

import math
from pathlib import Path

import numpy as np
import pytest

import abu_calc
from tests.cli.runner import abu
from tests.features.balancing.rig import RIG, ROTOR, Workshop, written
from tests.features.balancing.test_checks import run_with


def test_too_little_metal_is_welded_opposite(tmp_path: Path) -> None:
    result = run_with(tmp_path, "max_removable_g = 10.0")["result"]
    (left,), (right,) = result["left"]["corrections"], result["right"]["corrections"]
    assert left["action"] == "add" and left["angle_deg"] == pytest.approx(25) and left["mass_g"] == pytest.approx(12)
    assert right["action"] == "remove" and right["angle_deg"] == pytest.approx(320)


def test_shares_stand_at_the_places_given(tmp_path: Path) -> None:
    """12 g at 205°: flights at 0, 120, 240; 7 g at 320°: only at 10 and 100, so that one side is put on."""
    places = "left_places_deg = [0, 120, 240]\nright_places_deg = [10, 100]"
    result = run_with(tmp_path, places)["result"]
    left = {round(share["angle_deg"]): (share["action"], share["mass_g"]) for share in result["left"]["corrections"]}
    whole = 12 / math.sin(math.radians(120))  # law of sines: 35° from 240, 85° from 120, 120° between
    assert left == {
        120: ("remove", pytest.approx(whole * math.sin(math.radians(35)))),
        240: ("remove", pytest.approx(whole * math.sin(math.radians(85)))),
    }
    right = result["right"]["corrections"]
    assert [share["action"] for share in right] == ["remove", "add"]
    signs = [1 if share["action"] == "remove" else -1 for share in right]
    places = [share["mass_g"] * np.exp(1j * math.radians(share["angle_deg"])) for share in right]
    gone = sum(sign * place for sign, place in zip(signs, places, strict=True))
    assert gone == pytest.approx(7 * np.exp(1j * math.radians(320)), rel=1e-9)


def test_the_grade_is_shared_to_the_bearings(tmp_path: Path) -> None:
    """9549·6.3·64/3000 g·mm in all, the bearing nearer to the centre of mass more."""
    shop, grade = Workshop(), '[tolerance]\nbalance_grade = "G6.3"'
    document = abu("balance", written(tmp_path, RIG, ROTOR, shop.run(), grade), "--json").document
    result, whole = document["result"], 9549.3 * 6.3 * 64 / 3000
    assert result["residual_check"]["permitted_g_mm"] == pytest.approx(whole, rel=1e-4)
    assert result["left"]["permitted_g_mm"] == pytest.approx(whole * 0.81 / 1.48, rel=1e-4)
    assert all(share["status"] == "pass" for share in document["checks"] if share["code"] == "ABU1005")
    assert any("service_speed_rpm is not given" in line for line in document["warnings"])
    fine = abu("balance", written(tmp_path, RIG, ROTOR, shop.run(), '[tolerance]\nbalance_grade = "G0.4"'), "--json")
    fails = [check for check in fine.document["checks"] if check["code"] == "ABU1005"]
    bearings = fine.document["result"]["tolerance"]
    assert [check["value"] for check in fails] == [bearings["left_rest_g_mm"], bearings["right_rest_g_mm"]]
    for check in fails:  # twice the expected imbalance is asked to be permitted
        assert check["status"] == ("fail" if check["value"] > check["limit"] else "warn")
    small = Workshop(masses=(0.5, 0.5))
    said = abu("balance", written(tmp_path, RIG, ROTOR, small.run(), grade), "--json").document["warnings"]
    assert any("no correction is needed" in line for line in said)


# Masses that are fitted already

FITTED = '[correction]\nanswer = "{answer}"\nfitted = [{{ plane = "left", mass_g = 5.0, angle_deg = 40.0 }}]'


def test_trim_is_added_to_what_is_on_and_total_takes_its_place(tmp_path: Path) -> None:
    """The rig is read with 5 g at 40° in the left plane: trim corrects what is there, total the bare roll."""
    on = Workshop().put_on(0, 5.0, 40.0)
    results = {
        answer: abu_calc.balance(written(tmp_path, RIG, ROTOR, on.run(), FITTED.format(answer=answer)))
        for answer in ("trim", "total")
    }
    trim, total = results["trim"].left, results["total"].left
    assert (total.mass_g, total.angle_deg) == pytest.approx((12.0, 205.0), rel=1e-9)
    assert (trim.mass_g, trim.angle_deg) == pytest.approx((on.masses[0], on.angles[0] % 360), rel=1e-9)
    assert results["trim"].right.mass_g == pytest.approx(results["total"].right.mass_g) == pytest.approx(7.0)
    # the vibration now is that with the fitted mass, whatever is asked
    before = [result.residual_check.verification[0].left_before for result in results.values()]
    assert before[0] == pytest.approx(before[1])
    assert "fitted masses" in {cause.cause for cause in results["total"].uncertainty_by_cause}
    assert total.rest_g_mm > 0 and results["total"].fitted == 1
    bare = abu_calc.balance(written(tmp_path, RIG, ROTOR, on.run()))
    assert (bare.left.mass_g, bare.left.angle_deg) == pytest.approx((trim.mass_g, trim.angle_deg))


def test_the_report_says_whether_fitted_masses_stay(tmp_path: Path) -> None:
    on = Workshop().put_on(0, 5.0, 40.0)
    for answer, words in (("trim", "The fitted masses stay on"), ("total", "takes the place of the fitted masses")):
        seen = abu("balance", written(tmp_path, RIG, ROTOR, on.run(), FITTED.format(answer=answer)))
        assert words in " ".join(seen.out.split())


# As they are made


def test_masses_in_stock_leave_what_the_checks_say(tmp_path: Path) -> None:
    text = "max_removable_g = 50\nleft_places_deg = [0, 45, 90, 135, 180, 225, 270, 315]\n"
    stock = "[correction]\nstock_weights_g = [2, 5, 10]"
    shop = Workshop()
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR + text, shop.run(), stock))
    put = sum(s.mass_g * np.exp(1j * np.radians(s.angle_deg)) for s in result.left.corrections)
    left = abs(12.0 * np.exp(1j * np.radians(205.0)) + put)
    assert {s.action for s in result.left.corrections} == {"add"}
    assert all(set(s.weights_g) <= {2.0, 5.0, 10.0} for s in result.left.corrections)
    assert result.left.leftover_g_mm == pytest.approx(120 * left, rel=1e-6)
    assert result.left.rest_g_mm > result.left.leftover_g_mm
    discrete = next(check for check in result.checks if check.code == "ABU1012")
    assert discrete.value == pytest.approx(100 * left / 12.0, rel=1e-6)
    # the right plane has no places: two weights at free angles take all away
    assert result.right.leftover_g_mm == 0.0


def test_limits_that_leave_too_much_fail_with_the_number(tmp_path: Path) -> None:
    limits = "[correction]\nmax_added_g = 3.0\nmax_per_place_g = 3.0"
    text = "max_removable_g = 3.0\nleft_places_deg = [0, 120, 240]\n"
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR + text, Workshop().run(), limits))
    grades = {check.code: check.status for check in result.checks}
    assert grades["ABU1012"] == "fail" and "fail" in (grades["ABU1008"], grades["ABU1011"])


def test_holes_say_their_depth(tmp_path: Path) -> None:
    """12 g by a flat hole of 10 mm in steel: 12/(7.85·π/4) = 19.46 mm; no deeper than 15 mm it takes two."""
    one = "[correction]\ndrill_diameter_mm = 10.0"
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR, Workshop().run(), one))
    (hole,) = result.left.corrections
    assert hole.action == "remove" and hole.depth_mm == pytest.approx(12 / (7.85e-3 * math.pi * 25), rel=1e-3)
    two = abu_calc.balance(written(tmp_path, RIG, ROTOR, Workshop().run(), one + "\nmax_hole_depth_mm = 15"))
    first, second = two.left.corrections
    assert first.depth_mm == pytest.approx(second.depth_mm) and 9 < first.depth_mm < 15
    apart = math.radians(second.angle_deg - first.angle_deg) * 120
    assert apart == pytest.approx(15.0) and (first.angle_deg + second.angle_deg) / 2 == pytest.approx(205.0)
    assert 2 * first.mass_g * math.cos(apart / 240) == pytest.approx(12.0)
    assert "mm deep" in abu("balance", written(tmp_path, RIG, ROTOR, Workshop().run(), one)).out
