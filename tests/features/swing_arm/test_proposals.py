"""Changes of a swing arm: which are proposed, and that the next step holds when it is followed as printed."""

from collections.abc import Mapping
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.design.judgement import judge
from abu_calc.features.design.next_step import proposals
from abu_calc.foundation.progress import silent
from abu_calc.inputs.read_machine import Machine
from tests.studies.actions import followed
from tests.studies.random_machines import machine_text

HEALTHY: Mapping[str, tuple[int, dict[str, float]]] = {
    "a": (2, {}),
    "b": (17, {}),
    "c": (24, {"autobalancer.rolling_drag_per_s": 5.0}),
}
"""Random machines on an arm that suit: their seeds, and what else they need."""
BROKEN: Mapping[str, dict[str, float]] = {
    "stiff workpiece": {"contact_stiffness_N_per_m": 6e6},
    "no damper": {"joint_damping_N_s_per_m": 0.05},
    "weak damper": {"joint_damping_N_s_per_m": 2.0},
    "flat contact": {"contact_angle_deg": 8.0},
    "along the normal": {"contact_angle_deg": 0.0},
    "weak press": {"pressing_moment_N_m": 3.0},
    "no press": {"pressing_moment_N_m": 0.0},
    "stiff pivot": {"joint_stiffness_N_per_m": 2e5},
    "all": {"contact_stiffness_N_per_m": 8e6, "joint_damping_N_s_per_m": 0.1, "pressing_moment_N_m": 1.0,
            "contact_angle_deg": 8.0},
}  # fmt: skip
MENDED = {"along the normal", "flat contact", "no damper", "no press", "weak press"}
"""Those for which a change of the arm is enough."""


def broken(name: str, how: str, folder: Path) -> Machine:
    seed, needed = HEALTHY[name]
    file = folder / "machine.toml"
    file.write_text(machine_text(seed, "arm"), encoding="utf-8")
    return abu_calc.read(file).changed({**needed, **{f"swing_arm.{key}": value for key, value in BROKEN[how].items()}})


@pytest.mark.parametrize(
    ("name", "how"),
    [
        pytest.param(name, how, marks=pytest.mark.slow if name == "b" else pytest.mark.hard)
        for name in HEALTHY
        for how in BROKEN
    ],
)
def test_a_broken_arm_is_mended_by_the_next_step(name: str, how: str, tmp_path: Path) -> None:
    """All that it promises comes true, and the record of the arm names its changes; no other change is named."""
    machine = broken(name, how, tmp_path)
    result = abu_calc.size(machine, workers=1)
    arm, bad = result.swing_arm, [check for check in result.checks if check.status in ("fail", "not-done")]
    assert arm is not None
    if result.verdict.next is None:
        assert arm.changes == () and " = " not in arm.advice
        untried = any("--patience" in (check.remedy or "") for check in bad)  # the work of all trials was over
        assert untried or not (bad and how in MENDED)
        return
    assert followed(machine, result)[1] == []
    for change in arm.changes:
        assert f"--set {change.key}={change.new:.10g}" in result.verdict.next and change.text in arm.advice
    assert bool(arm.changes) is ("swing_arm." in result.verdict.next)


@pytest.mark.slow
def test_nothing_is_proposed_for_an_arm_that_passes(tmp_path: Path) -> None:
    machine = broken("b", "no damper", tmp_path).changed({"swing_arm.joint_damping_N_s_per_m": 100.0})
    assert not list(proposals(judge(machine.whole("size"), 0.01, silent, 1)))
