"""Advice on the arm of a scene file, and the check of a disk that bounces."""

import pytest

import abu_calc
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.verdict import critical_damping, stability
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.features.swing_arm.scenes import advise_scene, on_work
from abu_calc.features.swing_arm.verdict import CUTTING
from abu_calc.foundation.checks import Check
from abu_calc.foundation.progress import silent
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.design_scenes import simulated
from abu_calc.sizing import size as size_design
from tests.dynamics.stability.test_verdict import race


def scene(ratio: float, damping: float) -> Scene:
    length, inertia, omega = 0.3, 0.45, 300.0
    support = SwingArmSupport(length, inertia, inertia * (ratio * omega) ** 2 / length**2, damping)
    return Scene("arm", support, omega, 4e-4, 0.0, (race(drag=10.0, mass=0.01),), 1.0, (0.0,), (0.0,))


@pytest.mark.parametrize(
    ("ratio", "damping"),
    [
        (0.5, 150.0),
        pytest.param(1.3, 150.0, marks=pytest.mark.slow),
        (0.5, 0.05),
        pytest.param(0.95, 3.0, marks=pytest.mark.slow),
    ],
)
def test_advice_for_a_scene_file(ratio: float, damping: float) -> None:
    given = scene(ratio, damping)
    advice = advise_scene(given)
    assert advice is not None
    holds = stability(given).stable and damping > (critical_damping(given) or 0.0)
    assert advice.startswith("nothing to change.") is bool(holds)
    if not holds:
        words = dict(part.split(" (")[0].split(" = ") for part in advice.split(". Calculated")[0][7:].split(", "))
        support = SwingArmSupport(
            0.3, float(words.get("moment_of_inertia_kg_m2", 0.45)), given.support.stiffness,
            float(words.get("joint_damping_N_s_per_m", damping)),
        )  # fmt: skip
        changed = Scene("arm", support, 300.0, 4e-4, 0.0, given.races, 1.0, (0.0,), (0.0,))
        assert stability(changed).stable and support.damping > (critical_damping(changed) or 0.0)


def test_a_scene_whose_arm_nothing_holds() -> None:
    assert "joint stiffness" in str(advise_scene(scene(0.0, 10.0)))


def arm_check(machine: Machine) -> Check:
    """ABU506 of the scene on the workpiece."""
    design = size_design(machine.whole("size"))
    runs, _ = simulated(design, 0.01, silent, (CUTTING,))
    check = on_work(design, runs)
    assert check is not None and check.code == "ABU506"
    return check


@pytest.mark.few(1)
@pytest.mark.parametrize(("moment", "status"), [(20.0, "pass"), (9.0, "fail")])
@pytest.mark.slow
def test_a_disk_that_bounces_is_judged_by_the_simulated_arm(moment: float, status: str) -> None:
    """ABU506."""
    machine = abu_calc.read("swing-arm-grinder").changed({"swing_arm.pressing_moment_N_m": moment})
    check = arm_check(machine)
    assert check.status == status
    if status == "pass":
        assert check.value == 0.0 and "leaves its workpiece until" in check.message
        return
    assert check.value is not None and check.value > 10
