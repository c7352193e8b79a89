"""Scenes a machine file calls for, and what becomes of those without a trustworthy answer."""

import pytest

from abu_calc.dynamics.integrators.run import TooMuchWorkError
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.simulation import design_scenes
from abu_calc.simulation.design_scenes import WORK, SceneFailure, not_simulated, scenes_of, simulated
from abu_calc.sizing import size
from tests.sizing.machines import PINNED, machine

GRINDING = {"contact": "compliant", "contact_stiffness_N_per_m": 2e5}


def test_tables_of_the_file_call_for_scenes() -> None:
    assert scenes_of(size(machine(**PINNED))) == ("idle",)
    both = size(machine(**PINNED, grinding=GRINDING, swing_arm={"contact_angle_deg": 90.0}))
    assert scenes_of(both) == ("idle", "grinding", "swing-arm-idle", "swing-arm-cutting")


def test_an_arm_that_does_not_stand_is_a_failure_with_its_reason() -> None:
    runs, failures = simulated(
        size(machine(**PINNED, swing_arm={"contact_angle_deg": 8.0})), 0.01, names=["swing-arm-cutting"]
    )
    assert runs == ()
    (failure,) = failures
    assert failure.scene == "swing-arm-cutting" and "does not stand" in failure.reason and "\n" not in failure.reason


def test_too_much_work_is_tried_once_more_with_ten_times_as_much(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []

    def simulate(*_: object, most_evaluations: int, **__: object) -> None:
        asked.append(most_evaluations)
        raise TooMuchWorkError("too much") if len(asked) == 1 else NotTrustworthyError("never agreed\nmore")

    monkeypatch.setattr(design_scenes, "simulate_chosen", simulate)
    assert simulated(size(machine(**PINNED)), 0.01) == ((), (SceneFailure("idle", "never agreed"),))
    assert asked == [WORK, 10 * WORK]


def test_a_scene_that_was_not_simulated_passes_nothing() -> None:
    assert not_simulated("grinding", "chaotic").status == "not-done"
    assert not_simulated("grinding", "chaotic", answered=True).status == "not-done"
    assert not_simulated("idle", "chaotic", answered=True).status == "warn"
    assert not_simulated("swing-arm-idle", "chaotic", answered=True).status == "warn"
    assert not_simulated("swing-arm-cutting", "chaotic", answered=True).status == "not-done"
    check = not_simulated("grinding", "chaotic", mean="104 dB on average")
    assert (check.status, check.message) == ("warn", "104 dB on average") and check.name.endswith("grinding")
