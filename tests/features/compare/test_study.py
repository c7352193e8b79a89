"""Machines side by side: what differs in files, designs and checks."""

import math
from pathlib import Path
from typing import Any

import pytest

import abu_calc
from abu_calc.features.compare.screen import compare_screen
from abu_calc.features.compare.study import CompareResult, Difference
from abu_calc.features.compare.view import compare_blocks
from abu_calc.features.design.study import SizeResult
from abu_calc.foundation.quantity import flattened
from abu_calc.inputs.reading.overrides import parse_variant
from abu_calc.reporting.screen import as_text
from tests.cli.runner import abu
from tests.remembered import recalled

CHANGE = {"autobalancer.max_outer_diameter_mm": 40.0, "wheel.runout_angle_deg": 0.0}


@pytest.fixture(scope="module")
def sized() -> tuple[SizeResult, SizeResult]:
    """A machine, and one whose balls have too little room."""
    machine = abu_calc.read("msh-230")
    return recalled("size", machine), recalled("size", machine.changed(CHANGE))


@pytest.fixture(scope="module")
def compared(sized: tuple[SizeResult, SizeResult]) -> CompareResult:
    """The two side by side, sized once."""
    machine, found = abu_calc.read("msh-230"), iter(sized)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("abu_calc.features.compare.study.size", lambda *_: next(found))
        return abu_calc.compare([machine, machine.changed(CHANGE)])


def of(part: str, rows: Any) -> dict[str, list[Any]]:
    return {row["path"]: row["values"] for row in rows if row["part"] == part}


@pytest.mark.slow
def test_what_differs_is_what_differs(compared: CompareResult, sized: tuple[SizeResult, SizeResult]) -> None:
    """Every leaf of both results, held against each other once more, here by hand."""
    rows = compared.to_dict()["differences"]
    assert of("file", rows) == {"autobalancer.max_outer_diameter_mm": [68.0, 40.0]}  # the other is the default
    first, second = (dict(flattened(one.to_dict())) for one in sized)
    expected = set()
    for path in {*first, *second}:
        a, b = first.get(path), second.get(path)
        near = isinstance(a, float) and isinstance(b, float) and math.isclose(a, b, rel_tol=1e-9)
        told = ".cost." not in path and ".outline_mm." not in path and not path.endswith("error_estimate")
        if a != b and not near and told:
            expected.add(path)
    found = of("design", rows)
    assert set(found) == expected and len(expected) > 50
    assert all(values == [first.get(path), second.get(path)] for path, values in found.items())
    alike = {row.path: row.values for row in compared.alike if row.part == "design"}
    assert alike.keys().isdisjoint(expected) and alike["frequency.speed_hz"][0] == first["frequency.speed_hz"]


@pytest.mark.slow
def test_checks_stand_side_by_side_and_the_worst_is_the_status(
    compared: CompareResult, sized: tuple[SizeResult, SizeResult]
) -> None:
    by_code = [{check.code: check for check in one.checks} for one in sized]
    rows = of("check", compared.to_dict()["differences"])
    assert rows["checks.ABU201.status"] == ["pass", "fail"] == [one["ABU201"].status for one in by_code]
    assert rows["checks.ABU201.value"] == [one["ABU201"].value for one in by_code]
    assert [one.status for one in compared.files] == ["pass", "fail"] and compared.status == "fail"
    assert len(compared.checks) == sum(len(one.checks) for one in sized)
    assert {check.name.rpartition(", ")[2] for check in compared.checks} == {"A", "B"}


@pytest.mark.slow
def test_one_screen_has_the_differences_and_the_whole_report_all(compared: CompareResult) -> None:
    screen, whole = as_text(compare_screen(compared)), as_text(compare_blocks(compared))
    assert len(screen.splitlines()) <= 40 and max(map(len, screen.splitlines())) <= 80
    assert screen.splitlines()[1].startswith("  DOES NOT SUIT") and "ABU201 capacity" in whole
    assert "Number of balls" in screen and "autobalancer.ball_count" not in screen and "more that differ" in screen
    assert "Suspension" not in screen and "Left out because equal: " in screen
    assert "    suspension.model" in whole and "≠ autobalancer.max_outer_diameter_mm" in whole
    marked = [line for line in whole.splitlines() if line.startswith("  ≠ ")]
    assert len(marked) >= len([row for row in compared.differences if row.part != "check"])


def test_defaults_count_as_if_written(tmp_path: Path) -> None:
    text = '[machine]\nname = "shaft"\n[[bearing]]\nname = "b"\ndesignation = "7516"\nshaft_fit = "m6"\n'
    (tmp_path / "a.toml").write_text(text, encoding="utf-8")
    (tmp_path / "b.toml").write_text(f'# the same\n{text}inner_ring_load = "rotating"\n', encoding="utf-8")
    seen = abu("compare", str(tmp_path / "a.toml"), str(tmp_path / "b.toml"), "--json")
    assert seen.document["result"]["differences"] == []
    assert "Nothing differs." in abu("compare", str(tmp_path / "a.toml"), str(tmp_path / "b.toml")).out


def test_commas_divide_only_where_a_key_follows() -> None:
    found = {one.key: one.value for one in parse_variant('a.b=[1,{c=3}], c.d="x,y=1",e.f=one,two, bearing[0].g=z')}
    assert list(found) == ["a.b", "c.d", "e.f", "bearing[0].g"] and found["a.b"] == [1, {"c": 3}]
    assert found["c.d"] == "x,y=1" and found["e.f"] == "one,two"


def test_a_number_is_a_list_of_it() -> None:
    """As files may say either; otherwise values of files are alike only when they are equal."""
    for values, alike in (((2.5, [2.5, 2.5]), True), ((2.5, [2.5, 3.0]), False), ((1.0, 1), True), ((True, 1), False),
                          ((1.0, 1.0 + 1e-12), False), ((None, 0.0), False), (([1], [1, 1]), False)):  # fmt: skip
        assert Difference(part="file", path="x", unit="", values=values).alike is alike, values
        assert Difference(part="file", path="x", unit="", values=values[::-1]).alike is alike, values
    assert Difference(part="design", path="x", unit="", values=(1.0, 1.0 + 1e-12)).alike
