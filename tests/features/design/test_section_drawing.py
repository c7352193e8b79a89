"""The section in characters and lines: every part seen, arcs on their circles, limits as a drawing has them."""

import math
from dataclasses import replace

import pytest

from abu_calc.features.design.section_drawing import bore_limits, described, face_view, flattened, legend, section_lines
from abu_calc.reporting.drawings.shapes import Arc
from tests.reporting.drawings.samples import MACHINES, result


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.parametrize("rows", [4, 6, 9, 15])
def test_in_characters_every_part_is_seen(name: str, rows: int) -> None:
    design, section = result(name).autobalancer, result(name).section
    lines = section_lines(design, section, rows)
    assert 4 <= len(lines) <= rows
    assert max(map(len, lines)) <= 61
    middle = lines[0].index("|")
    assert all(line[middle] == "|" for line in lines)
    seen = set("".join(lines))
    assert {sign.split()[0] for sign in legend(section).split(", ")} - seen <= {"o"}
    # Mirrored, but for a ball that has none opposite.
    for line in lines:
        left, right = line[:middle][::-1], line[middle + 1 :].ljust(middle)
        assert left.ljust(len(right)) == (right if design.ball_count % 2 == 0 else right.replace("o", " "))


def test_too_few_lines_show_nothing() -> None:
    design = result("one-piece")
    for rows in (-40, 0, 3):
        assert section_lines(design.autobalancer, design.section, rows) == []


def test_a_half_circle_becomes_chords_on_its_circle() -> None:
    """A bulge of 1 is a half circle, to the right of the chord as it is walked; its middle lies below here."""
    points = list(flattened(((0.0, 0.0, 1.0), (2.0, 0.0, 0.0)), 10))
    assert points[0] == (0.0, 0.0) and points[-1] == (2.0, 0.0) and len(points) == 11
    assert all(math.dist(point, (1.0, 0.0)) == pytest.approx(1.0) for point in points)
    assert points[5] == pytest.approx((1.0, -1.0))


def test_limits_of_the_bore_are_in_millimetres() -> None:
    section = result("one-piece").section
    assert bore_limits(replace(section, bore_limits=(0.0, 13e-6))) == "(+0.013 / 0)"
    assert bore_limits(replace(section, bore_limits=None)) == ""


@pytest.mark.parametrize("name", ["one-piece", "two balls"])
def test_the_face_shows_every_ball_on_its_pitch_circle(name: str) -> None:
    sized = result(name)
    design = sized.autobalancer
    balls = {shape.centre for shape in face_view(sized, 1.0)
             if isinstance(shape, Arc) and shape.radius == design.ball_diameter_mm / 2}  # fmt: skip
    assert len(balls) == design.ball_count
    assert all(math.hypot(*centre) == pytest.approx(design.pitch_radius_mm) for centre in balls)
    assert f"{design.ball_count} balls of {design.ball_diameter_mm:.5g} mm" in described(sized)
