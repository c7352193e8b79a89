"""Dimensions of parts: every size of a profile is determined once, and no chain of lengths closes."""

import math
import re

import pytest

from abu_calc.features.design.sheets.dimension_plan import DimensionPlan, dimension_plan
from abu_calc.features.design.sheets.manufacture import demanded
from abu_calc.sizing.parts.housing_parts import TurnedPart
from tests.reporting.drawings.samples import MACHINES, result

PARTS = [(name, index) for name in MACHINES for index in range(3)]


def planned(name: str, index: int) -> tuple[TurnedPart, DimensionPlan]:
    parts = result(name).parts.turned
    if index >= len(parts):
        pytest.skip("this design has no further part")
    part = demanded(parts[index])
    return part, dimension_plan(part)


def near(values: list[float], wanted: float) -> int:
    return sum(abs(value - wanted) < 1e-6 for value in values)


@pytest.mark.few(2)
@pytest.mark.parametrize(("name", "index"), PARTS)
def test_lengths_are_a_tree_over_all_places(name: str, index: int) -> None:
    """As many lengths as places less one, and all places hang together: so none is missing and no chain closes."""
    part, plan = planned(name, index)
    origin = min(segment.start.z for segment in part.profile)
    places = {round(1e3 * (segment.start.z - origin), 6) for segment in part.profile}
    places |= {round(1e3 * (each.centre.z - origin), 6) for each in part.profile if not each.straight}
    groups = {place: {place} for place in places}
    for length in plan.lengths:
        first, second = groups[round(length.start, 6)], groups[round(length.end, 6)]
        assert first is not second, f"a chain closes with {length}"
        joined = first | second
        groups.update(dict.fromkeys(joined, joined))
    assert len(plan.lengths) == len(places) - 1 and {len(group) for group in groups.values()} == {len(places)}


@pytest.mark.parametrize(("name", "index"), PARTS)
@pytest.mark.slow
def test_each_diameter_stands_once(name: str, index: int) -> None:
    """Cylinders once each, the groove at its bottom, the groove's ends in brackets, for they follow."""
    part, plan = planned(name, index)
    asked = {(round(2e3 * each.start.r, 6), _size_demands(part, each.surface)) for each in part.profile
             if each.straight and abs(each.start.r - each.end.r) < 1e-12}  # fmt: skip
    # A stretch that nothing is asked of needs no dimension where another of its diameter has one.
    cylinders = [size for size, demand in asked if any(demand) or [other for other, _ in asked].count(size) == 1]
    arcs = [each for each in part.profile if not each.straight]
    own = [each.value for each in plan.diameters if not each.reference and not any(
        each.surface == arc.surface for arc in arcs)]  # fmt: skip
    assert sorted(own) == pytest.approx(sorted(cylinders))
    for arc in arcs:
        bottom = 2e3 * (arc.centre.r + arc.radius)
        assert near([each.value for each in plan.diameters if each.surface == arc.surface], bottom) == 1
        sphere = abs(arc.centre.r) < 1e-9  # whose diameter says its radius
        assert [radius for radius, _, _ in plan.radii] == pytest.approx([] if sphere else [1e3 * arc.radius])
        assert any(each.text.startswith("race SØ") for each in plan.diameters) == sphere
    for each in plan.diameters:
        assert each.reference == each.text.startswith("(")
        if each.reference:
            # Bottom, radius and width of the groove give it: the race's half chord.
            arc = next(arc for arc in arcs if near([2e3 * arc.start.r, 2e3 * arc.end.r], each.value))
            half = 1e3 * abs(arc.end.z - arc.start.z) / 2
            follows = 2 * (1e3 * arc.centre.r + math.sqrt((1e3 * arc.radius) ** 2 - half**2))
            assert follows == pytest.approx(each.value, abs=1e-6)


def _size_demands(part: TurnedPart, name: str) -> tuple[object, ...]:
    surface = part.surface(name)
    if surface is None:
        return ()
    return surface.thread, surface.tolerance_class, surface.limits, surface.plus_minus


@pytest.mark.parametrize(("name", "index"), PARTS)
@pytest.mark.slow
def test_three_decimals_stand_with_a_tolerance_only(name: str, index: int) -> None:
    _, plan = planned(name, index)
    texts = [*((each.text, each.below) for each in plan.diameters), *((each.text, "") for each in plan.lengths),
             *((text, "") for _, text, _ in plan.radii)]  # fmt: skip
    for text, below in texts:
        value = re.search(r"\d+\.(\d+)", text)
        if value and len(value[1]) > 2:
            assert "±" in text or below or re.search(r" [a-zA-Z]+\d", text), text


@pytest.mark.few(3)
@pytest.mark.parametrize(("name", "index"), PARTS)
def test_written_sizes_are_the_profile_s(name: str, index: int) -> None:
    _, plan = planned(name, index)
    for value, text in [*((each.value, each.text) for each in plan.diameters),
                        *((abs(each.end - each.start), each.text) for each in plan.lengths),
                        *((radius, text) for radius, text, _ in plan.radii)]:  # fmt: skip
        shown = re.search(r"\d+(?:\.(\d+))?", text)
        tolerance = re.search(r"±(\d+(?:\.\d+)?)", text)
        coarse = not re.search(r"\d [a-zA-Z]+\d", text)
        most = float(tolerance[1]) / 20 if tolerance else 0.005 if coarse else 0.0005
        assert shown is not None
        assert abs(float(shown[0]) - value) <= min(most, 0.005) + 1e-9, text
