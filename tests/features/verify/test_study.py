"""Expected values against entries of a result: paths, tolerances, what counts as a difference.

The report of `abu verify`: differing values in a table, files as expected in one line.
"""

import pytest

import abu_calc
from abu_calc.features.verify.study import (
    VerifiedFile,
    VerifyResult,
    _check,
    compare,
    current,
    expectations,
    recompute,
    value_at,
    verify,
    verify_blocks,
    verify_screen,
)
from abu_calc.foundation.errors import InputError
from abu_calc.reporting.blocks import Grid
from abu_calc.reporting.screen import as_text
from abu_calc.simulation.result import Provenance
from tests.inputs.scenes import SCENE

ENTRIES = {
    "status": "pass",
    "autobalancer": {"ball_count": 4, "mass_g": 100.0},
    "fits": ({"fit": "k6", "interference_um": (2.0, 15.0)},),
    "simulation": ({"quiet_time_s": 1.0, "rest_time_s": 2.0},),
}


@pytest.mark.parametrize(
    ("path", "value"),
    [("status", "pass"), ("autobalancer.mass_g", 100.0), ("fits.0.fit", "k6"), ("fits.0.interference_um.1", 15.0),
     ("fits.1.fit", None), ("autobalancer.mass_g.x", None), ("nothing", None), ("fits.-1.fit", None)],
)  # fmt: skip
def test_a_path_leads_to_its_value_or_to_nothing(path: str, value: object) -> None:
    assert value_at(ENTRIES, path) == value


@pytest.mark.parametrize(
    ("path", "expected", "tolerance", "passed"),
    [
        ("autobalancer.mass_g", 100.09, None, True),  # a thousandth by default
        ("autobalancer.mass_g", 100.2, None, False),
        ("autobalancer.mass_g", 100.2, 0.01, True),
        ("simulation.0.quiet_time_s", 1.019, None, True),  # two hundredths of what is simulated
        ("simulation.0.quiet_time_s", 1.03, None, False),
        ("simulation.0.rest_time_s", 2.03, None, True),
        ("status", "pass", None, True),
        ("status", "fail", 1.0, False),
        ("fits.0.interference_um", [2.0, 15.01], None, True),
        ("fits.0.interference_um", [2.0, 15.1], None, False),
        ("fits.0.interference_um", [2.0], 1.0, False),
        ("autobalancer.ball_count", True, 10.0, False),
        ("nothing", 1.0, 10.0, False),
    ],
)
def test_a_value_passes_within_its_tolerance(
    path: str, expected: object, tolerance: float | None, passed: bool
) -> None:
    (compared,) = compare({path: expected}, {} if tolerance is None else {path: tolerance}, ENTRIES)
    assert compared.passed is passed


def test_values_to_expect_are_those_of_the_file_or_a_choice() -> None:
    assert current(("autobalancer.ball_count", "nothing"), ENTRIES) == {"autobalancer.ball_count": 4}
    chosen = current((), ENTRIES)
    assert chosen["fits.0.interference_um.1"] == 15.0 and chosen["status"] == "pass"
    assert current(("a",), {"a": 1.23456789}) == {"a": 1.23457}


def test_a_file_that_expects_nothing_or_cannot_is_refused(tmp_path) -> None:
    preset = abu_calc.read("mmg-3200k-knife-shaft")
    file = tmp_path / "bare.toml"
    file.write_text(preset.text.split("[expected]")[0], encoding="utf-8")
    with pytest.raises(InputError, match="--update"):
        verify([abu_calc.read(file)])
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE, encoding="utf-8")
    with pytest.raises(InputError, match="a scene"):
        expectations(abu_calc.read_scene(scene))


@pytest.mark.slow
def test_seats_and_readings_are_recomputed_by_their_own_studies() -> None:
    assert set(recompute(abu_calc.read("mmg-3200k-knife-shaft"))) == {"status", "fits"}
    balancing = recompute(abu_calc.read_readings("sapropel-screw-rig"))
    assert value_at(balancing, "left.mass_g") == pytest.approx(12.0, rel=1e-4)
    result = verify([abu_calc.read("mmg-3200k-knife-shaft"), abu_calc.read_readings("sapropel-screw-rig")])
    assert result.status == "pass" and [check.value for check in result.checks] == [0.0, 0.0]


SHOWN = {"a": 1.0, "b": "k6"}


def result(*expected: dict[str, object]) -> VerifyResult:
    files = tuple(
        VerifiedFile(file=f"file{k}.toml", values=compare(values, {}, SHOWN)) for k, values in enumerate(expected)
    )
    return VerifyResult(title="verify", checks=tuple(map(_check, files)), provenance=Provenance.today(), files=files)


def test_only_values_that_differ_stand_in_the_table() -> None:
    """1.25 expected, 1.0 there: off by 0.25/1.25."""
    mixed = result({"a": 1.25, "b": "k6", "c": 3.0})
    (grid,) = [block for block in verify_blocks(mixed) if isinstance(block, Grid)]
    assert grid.rows == (("a", "1.25000", "1.00000", "20.0 %", "0.100 %"), ("c", "3.00000", "none", "", "0.100 %"))
    assert mixed.status == "fail" and "3 values, 2 differ" in as_text(verify_screen(mixed), 80)


def test_the_screen_names_files_as_expected_in_one_line() -> None:
    text = as_text(verify_screen(result({"a": 1.0}, {"b": "k6"})), 80)
    assert text.splitlines()[0].strip().startswith("PASS: 2 of 2 files as expected")
    assert "As expected: file0.toml, file1.toml." in text and "--update" not in text
    some = as_text(verify_screen(result({"a": 1.0}, {"b": "h6"})), 80)
    assert "FAIL: 1 of 2 files as expected" in some and "--update" in some


@pytest.mark.slow
def test_many_files_still_fit_one_screen() -> None:
    text = as_text(verify_screen(result(*({"a": 2.0} for _ in range(20)))), 80)
    assert len(text.splitlines()) <= 48
