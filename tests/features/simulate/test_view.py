"""The report of a run, its figures, and the motion as CSV in pieces."""

import csv
import io
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import abu_calc
from abu_calc.features.simulate.study import SampledMotion, SimulateResult
from abu_calc.features.simulate.view import (
    BLOCK,
    MOST_BALLS,
    TrajectoryCsv,
    simulate_blocks,
    simulate_extras,
    simulate_screen,
)
from abu_calc.reporting.screen import as_text
from tests.inputs.scenes import SCENE


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> SimulateResult:
    file = Path(tmp_path_factory.mktemp("scene")) / "scene.toml"
    file.write_text(SCENE, encoding="utf-8")
    return abu_calc.simulate(abu_calc.read_scene(file), duration_s=20.0)


def motion(rows: int) -> SampledMotion:
    t = np.arange(rows) / 3
    return SampledMotion(t, t**2, -t, np.vstack([10 * t, 20 * t]), {"arm_angle_mrad": t + 1})


@pytest.mark.parametrize("rows", [1, BLOCK, BLOCK + 1])
def test_a_motion_is_written_whole_in_pieces(rows: int) -> None:
    """A header and a piece for each ten thousand rows; numbers come back to twelve digits."""
    written = TrajectoryCsv(motion(rows))
    pieces = list(written)
    assert len(pieces) == len(written) == 1 + (1 if rows <= BLOCK else 2)
    table = list(csv.DictReader(io.StringIO("".join(pieces))))
    assert list(table[0]) == ["t_s", "x_mm", "y_mm", "ball1_deg", "ball2_deg", "arm_angle_mrad"] and len(table) == rows
    last = (rows - 1) / 3
    assert float(table[-1]["x_mm"]) == pytest.approx(last**2, rel=1e-11)
    assert float(table[-1]["ball2_deg"]) == pytest.approx(20 * last, rel=1e-11)
    assert float(table[-1]["arm_angle_mrad"]) == pytest.approx(last + 1, rel=1e-11)


def test_many_balls_are_named_as_far_as_there_is_room(result: SimulateResult) -> None:
    many = tuple(float(k) for k in range(MOST_BALLS + 3))
    final = replace(result.final, ball_angles=tuple(map(math.radians, many)), ball_speeds=many)
    text = " ".join(as_text(simulate_screen(replace(result, final=final)), 80).split())
    assert f"{MOST_BALLS - 1:.1f}°, … from the rotor's zero mark" in text and f"{MOST_BALLS:.1f}°" not in text
    full = as_text(simulate_blocks(replace(result, final=final)), 80)
    assert f"{MOST_BALLS + 2:.3f}°" in full


def test_a_run_that_is_never_quiet_or_creeps_says_so(result: SimulateResult) -> None:
    def shown(**changes: object) -> str:
        return " ".join(as_text(simulate_screen(replace(result, **changes)), 80).split())  # type: ignore[arg-type]

    text = shown(quiet_time=None, rest_time=None, creeping=False)
    assert "not quiet by the end." in text and "quiet time never" in text and "rest time not yet" in text
    text = shown(quiet_time=1.5, rest_time=None, creeping=True)
    assert "quiet after 1.5" in text and ", the balls still creep." in text and "rest time still creeping" in text
    text = shown(quiet_time=2.5, rest_time=4.5, creeping=False, full_speed=3.0)
    assert "quiet after 2.5" in text and "at full speed, which is reached at 3" in text
    assert "quiet time, from full speed 2.5" in text and "rest time, from full speed 4.5" in text
    assert "creep" not in text


def test_a_scene_without_limits_is_no_verdict_on_limits(result: SimulateResult) -> None:
    text = " ".join(as_text(simulate_screen(result), 80).split())
    assert "NO LIMITS for this scene" in text


def test_figures_need_the_way_and_balls(result: SimulateResult) -> None:
    names = [figure.name for figure in simulate_extras(result).figures]
    assert names == ["motion", "settling", "level"]  # no run-up at constant speed
    assert simulate_extras(replace(result, view=None)).figures == ()
    assert result.view is not None
    bare = replace(result, view=replace(result.view, pitch_radii_mm=()))
    assert [figure.name for figure in simulate_extras(bare).figures] == ["level"]
