"""The study of bearing seats, as Python scripts call it."""

import dataclasses

import pytest

from abu_calc.features.seats.study import check_fit
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.quantity import as_plain
from abu_calc.inputs.read_machine import read_machine
from tests.cli.runner import abu

PRESET = "mmg-3200k-knife-shaft"


def test_the_study_answers_what_the_command_prints():
    result, document = check_fit(read_machine(PRESET)), abu("check-fit", PRESET, "--json").document
    assert result.to_dict() == document["result"]
    assert [as_plain(dataclasses.asdict(check)) | {"change": None} for check in result.checks] == document["checks"]
    assert result.status == document["status"] and list(result.warnings) == document["warnings"]
    assert result.provenance.input == document["input"]
    assert [seat.seat for seat in result.seats] == ["shaft", "housing"] * 3


def test_a_changed_machine_is_judged_anew():
    machine = read_machine(PRESET)
    before = check_fit(machine)
    after = check_fit(machine.changed({"bearing[0].shaft_fit": "m6"}))
    creep = [next(check.status for check in one.checks if check.code == "ABU601") for one in (before, after)]
    assert creep == ["warn", "pass"]
    assert before.seats[0].recommended_fit == "m6" == after.seats[0].fit
    assert after.provenance.overrides == (("bearing[0].shaft_fit", "m6"),)
    with pytest.raises(dataclasses.FrozenInstanceError):
        after.seats[0].fit = "k6"  # type: ignore[misc]


def test_only_defaults_of_the_bearings_are_told(tmp_path):
    file = tmp_path / "seats.toml"
    file.write_text("[machine]\nname = 'm'\n[[bearing]]\ndesignation = '6203'\n", encoding="utf-8")
    machine = read_machine(str(file))
    assert ("limits.quiet_time_s", 1.0) in machine.defaults_used
    keys = [key for key, _ in check_fit(machine).provenance.defaults]
    assert "bearing[0].inner_ring_load" in keys and all(key.startswith("bearing[") for key in keys)


def test_a_machine_without_bearings_is_refused():
    with pytest.raises(InputError, match="no bearings") as raised:
        check_fit(read_machine("avtovaz-707-222"))
    assert raised.value.place.file == "avtovaz-707-222" and raised.value.place.key == "bearing"
    assert raised.value.remedy == "Add a table [[bearing]]."


@pytest.mark.parametrize(
    ("inner", "outer", "told"),
    [("rotating", "rotating", 1), ("rotating", "stationary", 0), ("indeterminate", "indeterminate", 0)],
)
def test_a_load_that_is_to_rotate_against_both_rings_is_told(inner: str, outer: str, told: int) -> None:
    """With the classes for an indeterminate load, which are those of the file that says so."""
    machine = read_machine(PRESET)
    loads = {f"bearing[{k}].{ring}_ring_load": load for k in range(3) for ring, load in
             (("inner", inner), ("outer", outer))}  # fmt: skip
    notes = [text for text in check_fit(machine.changed(loads)).warnings if "both rings" in text]
    assert len(notes) == told
    other = {f"bearing[{k}].{ring}_ring_load": "indeterminate" for k in range(3) for ring in ("inner", "outer")}
    shaft, housing, *_ = check_fit(machine.changed(other)).seats
    assert all(f"{shaft.recommended_fit}/{housing.recommended_fit} (calculated)" in text for text in notes)


def test_the_fleshing_machine_follows_its_source() -> None:
    """Afanasiev 2015 rejects k6 and H7/K7, and takes m6/M7 for a load that he calls circulating on both rings."""
    machine = read_machine(PRESET)
    assert {each.outer_ring_load for each in machine.tables.bearing} == {"rotating"}
    result = check_fit(machine)
    assert [seat.recommended_fit for seat in result.seats] == ["m6", "M7"] * 3
    failing = [check.name.rpartition("housing, ")[2] for check in result.checks if check.status == "fail"]
    assert set(failing) == {"7516 as built", "7516 proposed, K7"}
