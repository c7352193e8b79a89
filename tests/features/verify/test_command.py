"""`abu verify` as its users see it."""

from pathlib import Path

import pytest

from abu_calc.features.spindle.case import size_races
from abu_calc.features.spindle.records import PlacedAutobalancerRecord
from abu_calc.features.verify.study import compare, expectations
from abu_calc.foundation.units import from_si
from abu_calc.inputs.bearing_file import expected_values
from abu_calc.inputs.read_machine import read_machine
from tests.cli.runner import abu, again

PRESETS = sorted(file.stem for file in (Path(__file__).parents[3] / "presets").glob("*.toml"))
TWO_RACES = ("pedestal-grinder", "washing-machine-two-races")


@pytest.mark.hard
def test_presets_keep_what_they_expect() -> None:
    seen = again("verify", *(name for name in PRESETS if name not in TWO_RACES))
    assert seen.status == 0, seen.out
    assert all(name in seen.out for name in PRESETS if name not in TWO_RACES)


def test_without_files_every_preset_is_verified(monkeypatch: pytest.MonkeyPatch) -> None:
    """By name, in one report; what a file expects stands in the place of its results."""
    monkeypatch.setattr(
        "abu_calc.features.verify.study.recompute",
        lambda machine: dict(expected_values(expectations(machine))),
    )
    monkeypatch.setattr("abu_calc.features.verify.study.value_at", lambda entries, path: entries[path])
    seen = abu("verify", "--json")
    assert seen.status == 0 and [check["name"] for check in seen.document["checks"]] == PRESETS


@pytest.mark.parametrize(
    "name",
    [
        pytest.param("pedestal-grinder", marks=pytest.mark.slow),
        pytest.param("washing-machine-two-races", marks=pytest.mark.hard),  # a minute of start cases
    ],
)
def test_presets_with_two_races_keep_what_they_expect(name: str) -> None:
    seen = again("verify", name)
    assert seen.status == 0 and name in seen.out, seen.out


@pytest.mark.slow
@pytest.mark.parametrize("name", TWO_RACES)
def test_designs_of_two_races_keep_what_is_expected(name: str) -> None:
    """What needs no start case of what their files expect: balls, race, capacity, mass."""
    machine = read_machine(name)
    assert machine.spindle is not None
    design = size_races(machine)
    entries = {
        "required_capacity_g_mm": from_si(design.races[0].need, "g_mm"),
        "autobalancer": PlacedAutobalancerRecord.of_race(design, 0),
    }
    expected = expected_values(expectations(machine))
    kept = {path: value for path, value in expected.items() if path.partition(".")[0] in entries}
    assert len(kept) == 6 and not [value for value in compare(kept, {}, entries) if not value.passed]


@pytest.mark.slow
def test_verify_tells_differences_and_update_keeps_comments(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    text = abu("presets", "mmg-3200k-knife-shaft").out.replace('"fits.0.fit" = "k6"', '"fits.0.fit" = "m6"')
    file.write_text(text, encoding="utf-8")
    seen = abu("verify", str(file))
    assert seen.status == 1 and "fits.0.fit" in seen.out
    assert abu("verify", "--update", str(tmp_path / "machine.toml")).status == 0
    after = file.read_text(encoding="utf-8")
    assert after.split("[expected]")[0] == text.split("[expected]")[0]
    assert '"fits.0.fit" = "k6"\n' in after
    (tmp_path / "other.toml").write_text(text.split("[expected]")[0], encoding="utf-8")
    assert abu("verify", str(tmp_path)).status == 0  # a folder may hold files that expect nothing
    seen = abu("verify", str(tmp_path / "other.toml"))
    assert seen.status == 2 and "--update" in seen.err


def test_verify_knows_tolerances(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    text = abu("presets", "mmg-3200k-knife-shaft").out.split("[expected]")[0]
    expected = '[expected]\n"fits.0.hoop_stress_MPa" = 80.0\n"fits.0.interference_um" = [2.0, 36.0]\n'
    file.write_text(text + expected, encoding="utf-8")
    assert abu("verify", str(file)).status == 1  # it is 78.0
    file.write_text(text + expected + '[expected.tolerance]\n"fits.0.hoop_stress_MPa" = 0.05\n', encoding="utf-8")
    assert abu("verify", str(file)).status == 0
    file.write_text(text + expected + '"fits.0.no_such_key" = 1\n', encoding="utf-8")
    assert abu("verify", str(file)).status == 1
