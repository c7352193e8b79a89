"""Machines side by side: what differs in files, designs and checks."""

import json
import math
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import pytest

import abu_calc
from abu_calc.cli.app import COMMANDS
from abu_calc.features.compare.study import CompareResult, Difference
from abu_calc.features.compare.view import compare_blocks, compare_screen
from abu_calc.features.design.study import SizeResult
from abu_calc.foundation.quantity import flattened
from abu_calc.inputs.reading.overrides import parse_variant
from abu_calc.reporting.text import as_text
from tests.cli.runner import abu, once

SHAFT = ("compare", "mmg-3200k-knife-shaft", "--variant", "bearing[0].shaft_fit=m6")
CHANGE = {"autobalancer.max_outer_diameter_mm": 40.0, "wheel.runout_angle_deg": 0.0}


@pytest.fixture(scope="module")
def sized() -> tuple[SizeResult, SizeResult]:
    """A machine, and one whose balls have too little room."""
    machine = abu_calc.read("msh-230")
    return abu_calc.size(machine), abu_calc.size(machine.changed(CHANGE))


@pytest.fixture(scope="module")
def compared(sized: tuple[SizeResult, SizeResult]) -> CompareResult:
    """The two side by side, sized once."""
    machine, found = abu_calc.read("msh-230"), iter(sized)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("abu_calc.features.compare.study.size", lambda *_: next(found))
        return abu_calc.compare([machine, machine.changed(CHANGE)])


def of(part: str, rows: Any) -> dict[str, list[Any]]:
    return {row["path"]: row["values"] for row in rows if row["part"] == part}


def test_what_differs_is_what_differs(compared: CompareResult, sized: tuple[SizeResult, SizeResult]) -> None:
    """Every leaf of both results, held against each other once more, here by hand."""
    rows = compared.to_dict()["differences"]
    assert of("file", rows) == {"autobalancer.max_outer_diameter_mm": [68.0, 40.0]}  # the other is the default
    first, second = (dict(flattened(one.to_dict())) for one in sized)
    expected = set()
    for path in {*first, *second}:
        a, b = first.get(path), second.get(path)
        near = isinstance(a, float) and isinstance(b, float) and math.isclose(a, b, rel_tol=1e-9)
        if a != b and not near and ".cost." not in path and not path.endswith("error_estimate"):
            expected.add(path)
    found = of("design", rows)
    assert set(found) == expected and len(expected) > 50
    assert all(values == [first.get(path), second.get(path)] for path, values in found.items())
    alike = {row.path: row.values for row in compared.alike if row.part == "design"}
    assert alike.keys().isdisjoint(expected) and alike["frequency.speed_hz"][0] == first["frequency.speed_hz"]


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


def test_one_screen_has_the_differences_and_the_whole_report_all(compared: CompareResult) -> None:
    screen, whole = as_text(compare_screen(compared)), as_text(compare_blocks(compared))
    assert len(screen.splitlines()) <= 48 and max(map(len, screen.splitlines())) <= 80
    assert screen.splitlines()[1].startswith("  FAIL") and "ABU201 capacity" in screen
    assert "autobalancer.ball_count" in screen and "suspension.model" not in screen and "more that differ" in screen
    assert "    suspension.model" in whole and "≠ autobalancer.max_outer_diameter_mm" in whole
    marked = [line for line in whole.splitlines() if line.startswith("  ≠ ")]
    assert len(marked) >= len([row for row in compared.differences if row.part != "check"])


def test_files_have_the_differences_and_with_full_every_entry(tmp_path: Path) -> None:
    short, whole = tmp_path / "short.txt", tmp_path / "whole.txt"
    assert once(*SHAFT, "--output", str(short)).status == once(*SHAFT, "--full", "--output", str(whole)).status == 0
    less, more = (one.read_text(encoding="utf-8") for one in (short, whole))
    assert "bearing[0].shaft_fit" in less and "Differences only" in less and "≠" not in less
    assert "≠ bearing[0].shaft_fit" in more and len(more.splitlines()) > 2 * len(less.splitlines())


def test_seats_from_the_command_line(tmp_path: Path) -> None:
    document = once(*SHAFT, "--json").document
    assert document["abu"]["command"] == "compare" and len(document["result"]["files"]) == 2
    assert document["result"]["files"][1]["overrides"] == {"bearing[0].shaft_fit": "m6"}
    rows = document["result"]["differences"]
    assert of("file", rows) == {"bearing[0].shaft_fit": ["k6", "m6"]}
    # ISO 286-2, 80 mm: k6 +2…+21, m6 +11…+30, against a ring of class 0 from −15 to 0.
    assert of("design", rows)["fits.0.interference_um.0"] == pytest.approx([2, 11])
    assert of("design", rows)["fits.0.interference_um.1"] == pytest.approx([36, 45])
    seen = once(*SHAFT)
    assert seen.status == 0 and seen.width <= 80 and "fits.0.fit" in seen.out
    schema = json.loads(once("schema", "result").out)
    jsonschema.Draft202012Validator(schema).validate(document)


def test_files_keep_places_of_what_is_missing(tmp_path: Path) -> None:
    target = tmp_path / "both.toml"
    assert abu(*SHAFT[:3], "bearing[0].speed_rpm=900", "--output", str(target)).status == 0
    rows = tomllib.loads(target.read_text(encoding="utf-8"))["result"]["differences"]
    assert of("file", rows)["bearing[0].speed_rpm"] == ["null", 900.0]


def test_defaults_count_as_if_written(tmp_path: Path) -> None:
    text = '[machine]\nname = "shaft"\n[[bearing]]\nname = "b"\ndesignation = "7516"\nshaft_fit = "m6"\n'
    (tmp_path / "a.toml").write_text(text, encoding="utf-8")
    (tmp_path / "b.toml").write_text(f'# the same\n{text}inner_ring_load = "rotating"\n', encoding="utf-8")
    seen = abu("compare", str(tmp_path / "a.toml"), str(tmp_path / "b.toml"), "--json")
    assert seen.document["result"]["differences"] == []
    assert "Nothing differs." in abu("compare", str(tmp_path / "a.toml"), str(tmp_path / "b.toml")).out


def test_three_and_more_machines_fit_the_screen() -> None:
    fits = ("j6", "js6", "k5", "k6", "m5", "m6", "n6")
    variants = [part for fit in fits for part in ("--variant", f"bearing[0].shaft_fit={fit}")]
    seen = abu(*SHAFT[:2], *variants)
    assert len(seen.out.splitlines()) <= 48 and seen.width <= 80 and "\n  H  " in seen.out
    files = abu(*SHAFT[:2], *variants, "--json").document["result"]
    assert files["differences"][0]["values"] == ["k6", *fits]
    assert seen.status == max(0 if one["status"] == "pass" else 1 for one in files["files"])


def test_commas_divide_only_where_a_key_follows() -> None:
    found = {one.key: one.value for one in parse_variant('a.b=[1,{c=3}], c.d="x,y=1",e.f=one,two, bearing[0].g=z')}
    assert list(found) == ["a.b", "c.d", "e.f", "bearing[0].g"] and found["a.b"] == [1, {"c": 3}]
    assert found["c.d"] == "x,y=1" and found["e.f"] == "one,two"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("msh-230",), "2 to 26"),
        (("msh-230", "msh-230", "--variant", "wheel.mass_kg=1"), "variants are of one machine"),
        (("msh-230", "--variant", "wheel.mas_kg=1"), "--variant wheel.mas_kg: unknown key"),
        (("msh-230", "--variant", "wheel.mass_kg"), "--variant: not an override"),
        (("msh-230", "--variant", "wheel.mass_kg=0,5"), "write 0.5"),
        (("msh-230", "--variant", ""), "not an override"),
        (("msh-230", "--variant", "wheel.mass_kg=-1,machine.mass_kg=5"), "--variant wheel.mass_kg: out of range"),
        (("msh-230", "--variant", "wheel.mass_kg=[1,2"), "not a TOML value"),
        (("msh-230", "--variant", "wheel.mass_kg=1,,machine.mass_kg=5"), "--variant wheel.mass_kg"),
        (("msh-230", "sapropel-screw-rig"), "abu balance"),
        (("msh-230", "no-such-machine"), "no-such-machine"),
        (("msh-230", "avtovaz-707-222", "--accuracy", "5"), "--accuracy"),
        ((*["msh-230"] * 27,), "27 of them"),
    ],
)
def test_wrong_ones_are_refused(arguments: tuple[str, ...], told: str) -> None:
    seen = abu("compare", *arguments)
    assert seen.status == 2 and told in seen.err and "Traceback" not in seen.err and not seen.out


def test_it_is_a_command() -> None:
    assert "compare" in COMMANDS


def test_a_number_is_a_list_of_it() -> None:
    """As files may say either; otherwise values of files are alike only when they are equal."""
    for values, alike in (((2.5, [2.5, 2.5]), True), ((2.5, [2.5, 3.0]), False), ((1.0, 1), True), ((True, 1), False),
                          ((1.0, 1.0 + 1e-12), False), ((None, 0.0), False), (([1], [1, 1]), False)):  # fmt: skip
        assert Difference(part="file", path="x", unit="", values=values).alike is alike, values
        assert Difference(part="file", path="x", unit="", values=values[::-1]).alike is alike, values
    assert Difference(part="design", path="x", unit="", values=(1.0, 1.0 + 1e-12)).alike
