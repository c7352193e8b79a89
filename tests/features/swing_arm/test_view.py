"""A swing arm in `abu size` and `abu stability`, as their users see it."""

import json
from pathlib import Path

import pytest

from abu_calc.features.swing_arm.view import ArmHarmonic, ArmMotion, TongueEdge, tongue_lines
from abu_calc.foundation.units import to_si
from abu_calc.reporting.screen import LINES
from tests.cli.runner import abu, once
from tests.features.stability.test_command import IDLE_ARM

PRESET = "swing-arm-grinder"
CUTTING = ("stability", PRESET, "--scene", "swing-arm-cutting", "--set", "autobalancer.ball_count=2")


def words(text: str) -> str:
    return " ".join(text.split())


@pytest.mark.slow
def test_bounds_of_the_arm_stand_in_the_whole_report() -> None:
    """The bounds stand in the whole report; an arm with which nothing is wrong has no line on the first screen."""
    assert "Arm " not in once("size", PRESET).out
    result = once("size", PRESET, "--json").document["result"]
    assert words(result["swing_arm"]["advice"]) in words(once("size", PRESET, "--full").out)


@pytest.mark.slow
def test_numbers_of_the_arm_in_json() -> None:
    """The keys others call, and what stands beside them."""
    result = once("size", PRESET, "--json").document["result"]
    arm = result["swing_arm"]
    named = {
        "contact_stiffness_limit_N_per_m", "contact_stiffness_limit_exact_N_per_m", "worst_contact_angle_deg",
        "resonance_rpm", "damping_limit_N_s_per_m", "parametric_growth_rate_per_s",
    }  # fmt: skip
    assert named <= set(arm)
    assert arm["changes"] == [] and arm["lifted_contact_angles_deg"][1] == pytest.approx(16.1, abs=0.05)
    assert arm["idle_frequency_rpm"] < arm["cutting_frequency_rpm"] <= arm["resonance_rpm"]
    assert len(result["arm_motion"]["harmonics"]) == 3
    assert "arm_motion" not in once("size", "msh-230", "--json").document["result"]


@pytest.mark.slow
def test_stability_shows_motion_and_tongue() -> None:
    """Perturbation beside simulation, forced resonances at ω₀/i, rates, the drawing: on one screen."""
    seen = once(*CUTTING)
    lines = seen.out.splitlines()
    assert lines[1].lstrip().startswith("STABLE") and lines[2].lstrip().startswith("Arm: ")
    assert len(lines) <= LINES and seen.width <= 80
    for part in ("resonance ω₀/i, rpm", "perturbation, µm", "simulation, µm", "by averaging", "about 2ω₀", "Balls may"):
        assert part in once(*CUTTING, "--full").out
    assert sum("#" in line for line in once(*CUTTING, "--full").out.splitlines()) >= 4
    motion = once(*CUTTING, "--json").document["result"]["arm_motion"]
    first, second, third = motion["harmonics"]
    assert (
        first["resonance_rpm"]
        == pytest.approx(2 * second["resonance_rpm"])
        == pytest.approx(3 * third["resonance_rpm"])
    )
    assert first["simulation_um"] == pytest.approx(first["perturbation_um"], rel=1e-4)
    assert motion["rate_per_s"] == pytest.approx(motion["simulated_rates_per_s"][0], rel=1e-4)
    full = once(*CUTTING, "--full")
    assert "these are forced resonances" in words(full.out) and full.width <= 80


@pytest.mark.slow
def test_an_arm_that_is_wrong_is_told_by_its_checks() -> None:
    """`abu stability` tries no change and names none; `abu size` does, and what it says holds when followed."""
    wrong = ("--set", "autobalancer.ball_count=2", "--set", "swing_arm.contact_angle_deg=8")
    result = abu("stability", PRESET, "--scene", "swing-arm-idle", *wrong, "--json").document["result"]
    assert result["swing_arm"]["changes"] == [] and result["arm_advice"] == result["swing_arm"]["advice"]
    assert "ABU504" in result["arm_advice"] and "abu size FILE" in result["arm_advice"]


@pytest.mark.slow
def test_of_a_scene_file(tmp_path: Path) -> None:
    file = tmp_path / "arm.toml"
    file.write_text(IDLE_ARM, encoding="utf-8")
    seen = abu("stability", str(file))
    assert "Arm: nothing to change." in words(seen.out) and len(seen.out.splitlines()) <= LINES
    light = abu("stability", str(file), "--set", "scene.swing_arm.joint_damping_N_s_per_m=0.1")
    assert "change joint_damping_N_s_per_m = " in words(light.out)
    heavy = abu("stability", str(file), "--set", "scene.imbalance_g_mm=3e5", "--full")
    assert "Arm: the balls cannot carry the imbalance" in words(heavy.out) and "o o" in heavy.out
    free = abu("stability", str(file), "--set", "scene.swing_arm.joint_stiffness_N_per_m=0.0", "--json")
    assert any("nothing holds the arm" in told for told in free.document["warnings"])
    assert "arm_motion" not in free.document["result"]
    json.dumps(free.document, allow_nan=False)


def edge(speed: float, averaged: float, floquet: float) -> TongueEdge:
    return TongueEdge(speed=to_si(speed, "rpm"), averaged=averaged, floquet=floquet)


def test_the_drawing() -> None:
    """Rows of a tenth: both edges in one cell, each alone, and the arm where it is."""
    edges = tuple(edge(1000.0 + k, (0.0, 0.5, 1.0, 0.5, 0.0)[k], (0.0, 0.1, 1.0, 0.5, 0.0)[k]) for k in range(5))
    one = ArmHarmonic(order=1, resonance=1.0, perturbation=None, simulation=None)
    motion = ArmMotion(
        speed=to_si(1003.0, "rpm"), modulation=0.1, natural_frequency=to_si(501.0, "rpm"),
        parametric_speed=to_si(1002.0, "rpm"), joint_damping=0.9, rate=-1.0, parametric_rates=(0.0, -2.0),
        simulated_rates=None,
        harmonics=(one,), tongue=edges,
    )  # fmt: skip
    rows = [line.split("|")[1] for line in tongue_lines(motion) if "|" in line]
    marks = {(row, column): mark for row, line in enumerate(rows) for column, mark in enumerate(line) if mark != " "}
    assert marks == {(0, 4): "#", (3, 2): ".", (3, 6): "#", (6, 2): "o", (1, 6): "X"}
