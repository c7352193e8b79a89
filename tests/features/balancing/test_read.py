"""Files of readings: overrides, records beside the file, refusals with their place."""

from pathlib import Path

import pytest

import abu_calc
from abu_calc.foundation.errors import InputError
from tests.features.balancing.rig import RIG, ROTOR, Workshop, written


def test_a_changed_entry_leaves_the_others(tmp_path: Path) -> None:
    readings = abu_calc.read_readings(written(tmp_path, RIG, ROTOR, Workshop().run()))
    changed = readings.changed({"rig.damping_ratio": 0.25}).changed({"rotor.mass_kg": 70.0})
    assert changed.tables.rig is not None and changed.tables.rig.damping_ratio == 0.25
    assert changed.tables.rotor.mass_kg == 70.0 and readings.tables.rotor.mass_kg == 64.0
    assert changed.tables.run == readings.tables.run
    with pytest.raises(InputError) as refused:
        readings.changed({"rig.damping_ratio": -1.0})
    assert refused.value.place.key == "rig.damping_ratio"


def test_a_record_is_looked_for_beside_the_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run = '[[run]]\nquantity = "velocity"\nfile = "record.csv"\n'
    (tmp_path / "below").mkdir()
    file = written(tmp_path / "below", RIG, ROTOR, run)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "record.csv").touch()  # in the working folder, where it does not count
    with pytest.raises(InputError) as refused:
        abu_calc.read_readings(file)
    assert refused.value.place.key == "run[0].file" and "not there" in str(refused.value)
    (tmp_path / "below" / "record.csv").touch()
    readings = abu_calc.read_readings(file)
    assert readings.beside("record.csv") == tmp_path / "below" / "record.csv"
    assert readings.beside("/elsewhere/record.csv") == Path("/elsewhere/record.csv")
