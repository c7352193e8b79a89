"""What figures are made of, against numbers and places computed anew."""

import math
from dataclasses import replace

import pytest

from abu_calc.dynamics.stability.boundaries import boundaries, growth_over
from abu_calc.dynamics.stability.verdict import stability
from abu_calc.inputs.read_machine import read_machine
from abu_calc.reporting.charts.chart import FIELD, Axis, Plot, alike
from abu_calc.reporting.page.chart_svg import plot
from tests.dynamics.scenes import dimensionless
from tests.reporting.page.reader import read


def test_decades_are_even_along_a_logarithmic_axis() -> None:
    axis = Axis.decades("time [s]", [0.003, 40.0])
    assert (axis.low, axis.high) == pytest.approx((1e-3, 1e2))
    assert axis.ticks == pytest.approx([1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0])
    shares = [axis.share(tick) for tick in axis.ticks]
    assert shares == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.8, 1.0])
    assert axis.share(math.sqrt(axis.low * axis.high)) == pytest.approx(0.5)
    many = Axis.decades("error", [3e-16, 0.5]).ticks
    assert len(many) <= 8
    page = read(plot("a", Plot("A", "told", axis, Axis.decades("error", [1e-12, 1.0]))))
    words = [words for tag, words in page.texts if tag == "text"]
    assert {"1e-12", "1", "0.001", "100"} <= set(words)
    assert "0" not in words


def test_axes_alike_have_one_scale() -> None:
    across, up = alike("x", "y", [(3.0, 0.0), (0.0, -2.0)])
    assert (across.high - across.low) / (up.high - up.low) == pytest.approx(FIELD)
    assert across.low <= -3.0 < 3.0 <= across.high
    assert up.low <= -2.0


def test_growth_over_speeds_is_that_of_each_speed() -> None:
    scene = dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5), 100.0)
    speeds = [0.5, 0.9, 1.7, 2.6, 3.0]
    found = growth_over(scene, speeds)
    assert [speed for speed, _ in found] == speeds
    for speed, rate in found:
        alone = stability(replace(scene, speed=speed)).growth_rate
        assert rate == pytest.approx(alone, abs=1e-9)
    edges = boundaries(scene, 0.5, 3.0)
    at_edges = growth_over(scene, [one.speed for one in edges])
    assert edges
    assert [rate for _, rate in at_edges] == pytest.approx([0.0] * len(edges), abs=1e-6)


@pytest.mark.hard
def test_orbits_reach_as_far_as_the_amplitudes_say() -> None:
    from abu_calc.features.grinding.study import grinding

    result = grinding(read_machine("avtovaz-707-222"))
    amplitudes = {"without": result.axis_without, "balls fixed": result.axis_fixed, "with": result.axis}
    for one in result.orbits:
        x, y = (max(map(abs, each)) / 1e3 for each in zip(*one.points_um, strict=True))
        told = result.simulation if one.simulated else amplitudes[one.name]
        assert told is not None
        assert (x, y) == pytest.approx((told.x_amplitude_mm, told.y_amplitude_mm), rel=0.05 if one.simulated else 2e-3)
