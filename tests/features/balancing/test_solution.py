"""Corrections by metal and places, and the permitted imbalance of each plane."""

import math
from pathlib import Path

import numpy as np
import pytest

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
