"""The study of a balanced state: the check, warnings, outcomes in words, speeds that are refused."""

import math
from pathlib import Path
from typing import Any

import pytest

import abu_calc
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.verdict import Stability
from abu_calc.features.stability.disturbed import end_of_run
from abu_calc.features.stability.study import Hanging, _check, stability_warnings
from abu_calc.foundation.errors import InputError
from tests.dynamics.scenes import dimensionless
from tests.inputs.scenes import SCENE

TWO = dimensionless(3.0, 0.01, 0.05, 0.3, 0.05, (1.5, -1.7), 20.0)


def judgement(**values: Any) -> Stability:
    usual: dict[str, Any] = {
        "speed": 3.0, "state": "balanced", "angles": (2.0, -2.0), "eigenvalues": (-0.1 + 1j,), "multipliers": None,
        "growth_rate": -0.1, "stable": True, "reason": None, "left_out": (), "arrangements": 1,
    }  # fmt: skip
    return Stability(**(usual | values))


@pytest.mark.parametrize(
    ("values", "status", "value"),
    [
        ({}, "pass", -0.1),
        ({"stable": False, "growth_rate": 0.2}, "fail", 0.2),
        ({"angles": None, "stable": False, "growth_rate": None}, "fail", None),
        ({"reason": "not known", "stable": None, "growth_rate": None}, "not-done", None),
    ],
)
def test_the_check_is_that_of_the_judgement(values: dict[str, Any], status: str, value: float | None) -> None:
    check = _check(judgement(**values), "worst", pressed=False)
    assert (check.code, check.status, check.value) == ("ABU802", status, value)
    assert (check.remedy is None) is (status == "pass")


def warned(scene: Scene = TWO, **values: Any) -> str:
    return " ".join(stability_warnings(judgement(**values), scene, "worst"))


def test_warnings_name_what_was_judged_and_what_was_left_out() -> None:
    assert warned() == ""
    assert "Floquet multipliers" in warned(eigenvalues=None, multipliers=(0.5 + 0j,))
    assert warned(left_out=("gravity",)) == "" and "run_up" in warned(left_out=("gravity", "run_up"))
    assert "there is no balanced state" in warned(state=None, angles=None)
    assert "the balls cannot carry the imbalance" in warned(state="arm alone")
    three = dimensionless(3.0, 0.01, 0.05, 0.3, 0.05, (1.5, -1.7, 3.0), 20.0)
    assert "the least stable of 7" in warned(three, arrangements=7)


@pytest.mark.parametrize(("kind", "part"), [("drift", "drift to a stable"), ("growth", "leave the balanced")])
def test_the_end_of_a_run_is_told_in_words_and_degrees(kind: Any, part: str) -> None:
    end = end_of_run(kind, 12.0, 0.01, (1.0, 4.0 - math.tau), -0.25)
    assert part in end.text and "for 12 s" in end.text and "growth rate -0.25 1/s" in end.text
    assert end.resting_angles_deg == pytest.approx((57.29578, 229.1831 - 360), abs=1e-4)
    nothing = end_of_run("undecided", 0.0)
    assert nothing.text.startswith("No simulation tells") and nothing.resting_angles is None


def test_bounds_on_the_drag_have_their_margin() -> None:
    stall = Hanging.of(TWO, 0.0)
    assert stall is not None and stall.drag_per_s == TWO.races[0].drag
    for bound in stall.bounds:
        assert bound.drag_per_s is None or bound.margin == pytest.approx(stall.drag_per_s / bound.drag_per_s)
    assert Hanging.of(dimensionless(3.0, 0.01, 0.05, 0.3, 0.05, (), 20.0), 0.0) is None


@pytest.mark.parametrize("speeds", [(5.0, 5.0), (0.0, 5.0), (5.0, 2e6), (9.0, 5.0)])
def test_a_range_of_speeds_must_ascend_from_above_zero(tmp_path: Path, speeds: tuple[float, float]) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(SCENE, encoding="utf-8")
    with pytest.raises(InputError) as refused:
        abu_calc.stability(abu_calc.read_scene(file), speeds_rpm=speeds)
    assert refused.value.place.key == "speeds_rpm" and "ascending" in str(refused.value)
