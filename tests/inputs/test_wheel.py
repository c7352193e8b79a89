"""The wheel: either key of its runout, its balance grades, one source of its imbalance."""

from pathlib import Path

import pytest
from jsonschema import Draft4Validator
from pydantic import ValidationError

from abu_calc.features.balancing.tables import Tolerance
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.reading.schema import schema_of
from abu_calc.inputs.wheel import SOURCES, MeasuredAfter, Shown, Wheel, displaced_quantities
from tests.inputs.samples import BASIC, read


def machine(folder: Path, text: str) -> MachineFile:
    loaded = read(folder, text).tables
    assert isinstance(loaded, MachineFile)
    return loaded


def test_runout_from_either_key(tmp_path: Path) -> None:
    gauge = BASIC.replace("diameter_mm = 150.0", "diameter_mm = 150.0\nrunout_tir_mm = 0.08")
    direct = BASIC.replace("diameter_mm = 150.0", "diameter_mm = 150.0\nrunout_mm = 0.04")
    assert machine(tmp_path, gauge).wheel.runout == machine(tmp_path, direct).wheel.runout == 4e-5
    assert machine(tmp_path, BASIC).wheel.runout == 0


@pytest.mark.parametrize("grade", ["4000", "1600", "630", "250", "100", "40", "16", "6.3", "2.5", "1", "0.4"])
def test_balance_grades(tmp_path: Path, grade: str) -> None:
    wheel = machine(tmp_path, BASIC.replace("imbalance_g_mm = 150.0", f'balance_grade = "G{grade}"')).wheel
    assert wheel.grade == float(grade) and wheel.imbalance_g_mm is None


@pytest.mark.parametrize("written", ["G 6.3", "g6.3", "g 6.3", "G6.3"])
def test_a_balance_grade_as_people_write_it(tmp_path: Path, written: str) -> None:
    """In machine files and readings alike; a number without its letter, or cut by a space, is refused."""
    wheel = machine(tmp_path, BASIC.replace("imbalance_g_mm = 150.0", f'balance_grade = "{written}"')).wheel
    assert wheel.balance_grade == "G6.3" and Tolerance(balance_grade=written).balance_grade == "G6.3"
    schema = schema_of("readings")
    editor = Draft4Validator(schema["definitions"]["Tolerance"] | {"definitions": schema["definitions"]})
    editor.validate({"balance_grade": written})
    for other in (written[1:], written.replace(".", ". "), f"G{written}"):
        assert not editor.is_valid({"balance_grade": other})
        with pytest.raises(ValidationError, match="balance_grade"):
            Tolerance(balance_grade=other)


WHEEL = {"mass_kg": 0.6, "diameter_mm": 150.0}


@pytest.mark.parametrize(("given", "words"), [
    ({"measured_level_db": 111.0, "measured_velocity_mm_per_s": 17.7}, "exactly one source"),
    ({"imbalance_g_mm": 1.0, "measured_axes": 3}, "goes with a measured value only"),
    ({"measured_level_db": 111.0, "measured_weighting": "Wh"}, "acceleration only"),
    ({"balance_grade": "G17"}, "balance_grade"),
])  # fmt: skip
def test_an_imbalance_has_one_source_and_a_runout_one_key(given: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        Wheel.model_validate(WHEEL | given)


def test_one_number_stands_for_a_list_of_one() -> None:
    wheel = Wheel.model_validate(WHEEL | {"measured_acceleration_m_per_s2": 10.8, "measured_weighting": "Wh"})
    assert wheel.shown == Shown("measured_acceleration_m_per_s2", (10.8,), "Wh", 1, None)
    assert Wheel.model_validate(WHEEL | {"imbalance_g_mm": 1.0}).shown is None


def test_a_source_takes_the_place_of_all_others() -> None:
    for key in SOURCES:
        assert set(Wheel.displaced_by(key, None)) >= set(SOURCES) - {key}
        assert key not in Wheel.displaced_by(key, None)
    assert Wheel.displaced_by("runout_mm", 0.1) == ("runout_tir_mm",) and Wheel.displaced_by("mass_kg", 1.0) == ()


def test_only_accelerations_keep_their_weighting() -> None:
    assert "measured_weighting" in displaced_quantities("measured_level_db")
    assert "measured_weighting" not in displaced_quantities("measured_acceleration_m_per_s2")
    assert displaced_quantities("measured_axes") == ()


def test_after_the_autobalancer_one_value_is_measured() -> None:
    assert MeasuredAfter.model_validate({"measured_level_db": [102, 103]}).shown is not None
    for given in ({}, {"measured_level_db": 102.0, "measured_displacement_um": 3.0}):
        with pytest.raises(ValueError, match="exactly one measured value"):
            MeasuredAfter.model_validate(given)
