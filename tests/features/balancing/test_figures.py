"""Figures of a correction: signs where the angles say, bars with the numbers of the result."""

import math
from dataclasses import replace

import pytest

import abu_calc
from abu_calc.features.balancing.figures import RADIUS, balance_extras, planes_drawing
from abu_calc.features.balancing.study import BalanceResult
from abu_calc.reporting.charts.chart import Bars
from abu_calc.reporting.drawings.shapes import Arc, Text


@pytest.fixture(scope="module")
def result() -> BalanceResult:
    return abu_calc.balance("sapropel-screw-rig")


@pytest.mark.parametrize(("turns", "sense"), [("counterclockwise", 1.0), ("clockwise", -1.0)])
def test_the_heavy_spot_is_drawn_against_the_rotation(result: BalanceResult, turns: str, sense: float) -> None:
    """The mark on top; a roll that turns counterclockwise has its degrees clockwise, to the right."""
    drawing = planes_drawing(result.left, result.right, turns)
    spots = [shape for shape in drawing.shapes if isinstance(shape, Arc) and shape.radius == 1.6]
    middles = [shape.centre[0] for shape in drawing.shapes if isinstance(shape, Arc) and shape.radius == RADIUS]
    angles = [math.radians(plane.angle_deg) for plane in (result.left, result.right)]
    for spot, middle, angle, side in zip(spots, middles, angles, (sense, -sense), strict=True):
        assert spot.centre[0] - middle == pytest.approx(side * RADIUS * math.sin(angle))
        assert spot.centre[1] == pytest.approx(RADIUS * math.cos(angle))
    assert "remove 12.00 g at 205.0°" in drawing.description
    texts = [shape.text for shape in drawing.shapes if isinstance(shape, Text)]
    assert texts.count("−") == 2 and "− 12.00 g at 205.0°" in texts


def test_a_plane_without_imbalance_is_left(result: BalanceResult) -> None:
    drawing = planes_drawing(replace(result.left, mass=0.0), result.right, "clockwise")
    assert drawing.description.startswith("left: leave it as it is")
    assert sum(isinstance(shape, Arc) and shape.radius == 1.6 for shape in drawing.shapes) == 1


def test_bars_have_the_numbers_of_the_result(result: BalanceResult) -> None:
    figures = {figure.name: figure.shown for figure in balance_extras(result).figures}
    residual = figures["residual"]
    assert isinstance(residual, Bars)
    values = [bar.value for bar in residual.rows]
    # 12 g at 120 mm and 7 g at 150 mm
    assert values[0] == pytest.approx(1440.0, rel=1e-3) and values[2] == pytest.approx(1050.0, rel=1e-3)
    assert values[1] == result.left.rest_g_mm < values[0] and values[3] == result.right.rest_g_mm
    assert residual.axis.high == max(values)
    assert "verification-1" in figures and "uncertainty" in figures
