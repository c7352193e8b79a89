"""One scene simulated: times, sampled motion, the check of accuracy, arguments that are refused."""

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import abu_calc
from abu_calc.features.simulate.study import MOST_NUMBERS, SimulateResult, _reached, equally_spaced
from abu_calc.foundation.errors import InputError
from tests.dynamics.scenes import dimensionless
from tests.inputs.scenes import SCENE


@pytest.fixture(scope="module")
def scene_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("scene") / "scene.toml"
    file.write_text(SCENE, encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def result(scene_file: Path) -> SimulateResult:
    return abu_calc.simulate(abu_calc.read_scene(scene_file), duration_s=20.0, samples=41)


def test_times_are_equally_spaced_with_both_ends() -> None:
    scene = dimensionless(3.0, 0.01, 0.01, 0.3, 0.05, (1.5, -1.7), 20.0)
    assert equally_spaced(scene, 5).tolist() == [0.0, 5.0, 10.0, 15.0, 20.0] and len(equally_spaced(scene, None)) == 0
    with pytest.raises(InputError) as refused:
        equally_spaced(scene, 1)
    assert refused.value.place.key == "samples"
    with pytest.raises(InputError):
        equally_spaced(scene, MOST_NUMBERS // scene.state_count + 1000)


def test_the_motion_begins_where_the_scene_places_it(result: SimulateResult) -> None:
    """At rest at its place, balls at ±90°; the last sample is the end that the result tells."""
    motion = result.motion
    assert motion is not None and list(motion.columns) == ["t_s", "x_mm", "y_mm", "ball1_deg", "ball2_deg"]
    assert (motion.x_mm[0], motion.y_mm[0]) == (0.0, 0.0) and motion.ball_angles_deg[:, 0] == pytest.approx([90, -90])
    assert motion.t_s[-1] == result.final.t_s == 20.0
    assert (motion.x_mm[-1], motion.y_mm[-1]) == pytest.approx((result.final.x_mm, result.final.y_mm), rel=1e-9)
    ends = [math.remainder(angle, 360) for angle in motion.ball_angles_deg[:, -1]]
    assert ends == pytest.approx(list(result.final.ball_angles_deg), abs=1e-6)
    assert np.isfinite(np.vstack(list(motion.columns.values()))).all()


def test_a_scene_outright_has_no_handles_and_no_limits(result: SimulateResult) -> None:
    assert result.handles is None and result.measured_after is None and result.level_at == "axis"
    assert [check.code for check in result.checks] == ["ABU801"] and result.status == "pass"


@pytest.mark.parametrize(
    ("error", "spared", "status", "value"),
    [(0.004, 0.005, "pass", 0.009), (0.006, 0.005, "fail", 0.011), (math.inf, 0.0, "fail", None)],
)
def test_what_the_effects_left_out_may_change_counts_as_error(
    error: float, spared: float, status: str, value: float | None
) -> None:
    run: Any = SimpleNamespace(rung="equations", error_estimate=error)
    check = _reached(run, spared, 0.01)
    assert (check.status, check.limit) == (status, 0.01)
    assert check.value == (None if value is None else pytest.approx(value))


@pytest.mark.parametrize(
    ("options", "key"),
    [
        ({"accuracy": 0.0}, "accuracy"), ({"integrator": "euler"}, "integrator"), ({"samples": 0}, "samples"),
        ({"most_evaluations": 0}, "most_evaluations"), ({"with_effects": ["magic"]}, "with_effects"),
        ({"duration_s": -1.0}, "duration_s"),
    ],
)  # fmt: skip
def test_wrong_arguments_are_refused_by_name(scene_file: Path, options: dict[str, Any], key: str) -> None:
    with pytest.raises(InputError) as refused:
        abu_calc.simulate(abu_calc.read_scene(scene_file), **options)
    assert refused.value.place.key == key
