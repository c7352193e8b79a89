"""The sketch of a swing arm: lengths and angles of the record where the drawing has its lines."""

import math
from dataclasses import replace
from types import SimpleNamespace

import pytest

from abu_calc.features.swing_arm.view import SwingArmRecord, swing_arm_sketch
from abu_calc.reporting.drawings.shapes import Arc, Drawing, Length, Line, Text
from abu_calc.simulation.result import Provenance
from tests.features.swing_arm.test_verdict import judged


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
