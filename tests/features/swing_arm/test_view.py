"""A swing arm in `abu size` and `abu stability`, as their users see it.

The sketch of a swing arm: lengths and angles of the record where the drawing has its lines.

The swing arm in user units: angles, speeds and lengths by hand, and what is not known.
"""

import json
import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

from abu_calc.features.swing_arm.view import (
    ArmHarmonic,
    ArmMotion,
    SwingArmRecord,
    TongueEdge,
    swing_arm_sketch,
    tongue_lines,
)
from abu_calc.foundation.units import to_si
from abu_calc.reporting.drawings.shapes import Arc, Drawing, Length, Line, Text
from abu_calc.reporting.screen import LINES
from abu_calc.simulation.result import Provenance
from tests.cli.runner import abu, once
from tests.features.stability.test_command import IDLE_ARM
from tests.features.swing_arm.test_verdict import judged

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


def drawn(angle: float, touch: float = 5.0) -> tuple[SwingArmRecord, Drawing]:
    record = replace(SwingArmRecord.of(judged("as it is").found), contact_angle_deg=angle, touch_angle_deg=touch)
    result = SimpleNamespace(title="arm", provenance=Provenance.today("arm.toml", "abc"))
    return record, swing_arm_sketch(result, record, 30.0)  # type: ignore[arg-type]


@pytest.mark.parametrize("angle", [0.0, 30.0, 90.0, 150.0])
def test_the_contact_lies_on_the_wheel_at_its_angle_to_the_arm(angle: float) -> None:
    """The joint is at the origin, the wheel's axis at (l, 0); an angle of 0 points back to the joint."""
    record, drawing = drawn(angle)
    centre, radius = (record.arm_length_mm, 0.0), record.wheel_diameter_mm / 2
    (touch,) = [shape.end for shape in drawing.shapes
                if isinstance(shape, Line) and shape.layer == "dimension" and shape.start == centre]  # fmt: skip
    assert math.dist(touch, centre) == pytest.approx(radius)
    turn = math.radians(angle)
    assert touch == pytest.approx((centre[0] - radius * math.cos(turn), -radius * math.sin(turn)))
    assert any(isinstance(shape, Arc) and shape.centre == centre and shape.radius == radius for shape in drawing.shapes)


def test_the_arm_stands_at_its_touching_angle_as_a_hidden_line() -> None:
    record, drawing = drawn(30.0, touch=20.0)
    (hidden,) = [shape for shape in drawing.shapes if isinstance(shape, Line) and shape.layer == "hidden"]
    turn = math.radians(20.0)
    assert hidden.end == pytest.approx((record.arm_length_mm * math.cos(turn), record.arm_length_mm * math.sin(turn)))
    (length,) = [shape for shape in drawing.shapes if isinstance(shape, Length)]
    assert length.text.startswith("l = ") and math.dist(length.start, length.end) == record.arm_length_mm
    assert "SHA-256 abc" in [shape.text for shape in drawing.shapes if isinstance(shape, Text)]


def test_changes_are_those_of_the_next_step_that_are_of_the_arm() -> None:
    entries = ("autobalancer.ball_count=2", "swing_arm.contact_angle_deg=17", "swing_arm.pressing_moment_N_m=40")
    record = SwingArmRecord.of(judged("flat contact").found, entries)
    assert [(each.key, each.old, each.new) for each in record.changes] == [
        ("swing_arm.contact_angle_deg", 8.0, 17.0), ("swing_arm.pressing_moment_N_m", 20.0, 40.0),
    ]  # fmt: skip
    assert record.advice.startswith("change contact_angle_deg = 17 (from 8), pressing_moment_N_m = 40 (from 20), as")


def test_the_arm_of_the_file_comes_back_in_its_units() -> None:
    case = judged("flat contact")
    table, tables = case.machine.whole().swing_arm, case.machine.whole()
    assert table is not None
    record = SwingArmRecord.of(case.found)
    for key in ("contact_angle_deg", "touch_angle_deg", "arm_length_mm", "joint_damping_N_s_per_m",
                "contact_stiffness_N_per_m", "pressing_moment_N_m"):  # fmt: skip
        assert getattr(record, key) == pytest.approx(getattr(table, key)), key
    assert record.wheel_diameter_mm == pytest.approx(tables.wheel.diameter_mm)
    low, high = record.lifted_contact_angles_deg or (90.0, 90.0)
    assert low < 8.0 < high and record.pressed_angle_deg is None  # at 8° the arm does not stand
    assert record.changes == () and "ABU504" in record.advice
