"""Duration of scenes: within bounds of work, and until the slowest transient has died out."""

import math
from pathlib import Path

import pytest

from abu_calc.dynamics.scene import Scene
from abu_calc.foundation.errors import InputError
from abu_calc.simulation.quiet import lasting
from abu_calc.simulation.scene_of_design import idle_scene
from abu_calc.simulation.scene_of_file import scene_from
from abu_calc.sizing import size
from tests.inputs.scenes import SCENE, read
from tests.sizing.machines import machine


def scene(folder: Path, text: str) -> Scene:
    return scene_from(read(folder, text).scene)


def test_durations_are_bounded_by_work_and_run_up(tmp_path: Path) -> None:
    ramped = scene(tmp_path, f"{SCENE}[scene.effects]\nrun_up = {{ time_s = 100, run_down_s = 50 }}\n")
    assert lasting(ramped, 150.0, "--duration").duration == 150.0
    for wanted in (149.0, 1e9, math.nan, -1.0):
        with pytest.raises(InputError, match="One revolution and the run-up") as caught:
            lasting(ramped, wanted, "--duration")
        assert caught.value.place.key == "--duration"
    assert lasting(ramped, None, "x") == ramped


@pytest.mark.slow
def test_duration_is_seven_decay_times_within_bounds() -> None:
    slow = size(machine(suspension__natural_frequencies_hz=[1.0, 2.5], suspension__damping_ratios=[0.4, 0.5]))
    rate = 0.4 * 2 * math.pi * slow.case.body.effective_mass() / slow.system_mass
    assert idle_scene(slow).duration == pytest.approx(7 / rate, rel=1e-9)
    longest = size(machine(suspension__natural_frequencies_hz=[0.1, 0.1]))
    assert idle_scene(longest).duration == pytest.approx(400 * 2 * math.pi / longest.case.speed)
    shortest = size(machine(suspension__damping_ratios=[3.0, 3.0], autobalancer__rolling_drag_per_s=25.0))
    assert idle_scene(shortest).duration >= 40 * idle_scene(shortest).revolution
