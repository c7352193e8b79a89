"""Measured levels as published, files of others, and origins of their values, as the comments behind them say.

Motion of handles per motion of the race, against the reference case V305 of an exact body, and by hand.
"""

import math
import re
import tomllib
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.factory.measurements import (
    HandleGeometry,
    at_handles,
    degrees_of_freedom,
    factory_machines,
    machines_of,
    soft_race,
    value_sources,
)
from abu_calc.foundation.errors import InputError
from tests.remembered import recalled


def test_the_rows_are_what_was_published() -> None:
    """Kladiev 1996, written down a second time: machine, state, octave; without, with, lowered."""
    told = {
        ("707-222", "idle", 125.0): ((108, 111), (102, 103), (6, 10)),
        ("707-222", "loaded", 125.0): ((110, 113), (102, 103), None),
        ("707-370", "not said", 125.0): (None, (102, 104), (7, 10)),
        ("707-305", "idle", 31.5): ((109, 113), (98, 100), None),
        ("707-305", "loaded", 31.5): ((111, 112), (102, 103), None),
        ("707-305", "idle", 125.0): (None, None, None),
        ("MSh-230", "loaded", 16.0): (None, None, (18, 19)),
        ("MSh-230", "loaded", 31.5): (None, None, (12, 16)),
        ("MSh-230", "loaded", 63.0): (None, None, (8, 9)),
    }
    rows = {(machine.short, row.state, row.octave_hz): (row.level_without_db, row.level_db, row.lowered_db)
            for machine in factory_machines() for row in machine.measured}  # fmt: skip
    assert rows == told


def test_sensors_were_on_the_handles_normal_to_the_worked_surface() -> None:
    """For face and angle machines that is along the spindle."""
    for machine in factory_machines():
        straight = machine.machine.whole().machine.layout == "straight"
        assert {row.axis for row in machine.measured} == {"y" if straight else "z"}
        assert {row.place for row in machine.measured} == {"handle"} and machine.geometry is not None
        assert all(row.source.startswith("Kladiev 1996") and row.remark for row in machine.measured)


def test_a_preset_given_as_a_file_is_the_factorys_machine_another_file_has_its_own_name() -> None:
    preset, own = machines_of(
        [abu_calc.read("msh-230"), abu_calc.read("avtovaz-707-222").changed({"wheel.mass_kg": 0.5})]
    )
    assert preset.short == "MSh-230" and preset.geometry is not None
    assert own.short == "707-222"


def test_a_file_without_measurements_is_refused() -> None:
    with pytest.raises(InputError) as refused:
        machines_of([abu_calc.read("swing-arm-grinder")])
    assert refused.value.place.key == "measured" and "[[measured]]" in str(refused.value)


def test_a_file_has_its_own_name(tmp_path: Path) -> None:
    text = Path(abu_calc.read("msh-230").document.text)
    file = tmp_path / "mine.toml"
    file.write_text(str(text), encoding="utf-8")
    [mine] = machines_of([abu_calc.read(file)])
    assert (mine.short, mine.geometry) == ("mine", None)


def test_soft_races_are_those_of_practice() -> None:
    soft = soft_race()
    assert soft["short"] == "IV-2014, Sh-2203" and soft["friction_mm"] == [0.01, 0.05]


TEXT = """
# a comment
[machine]
name = "a # b"  # published: Kladiev 1996
mass_kg = 4.0   # assumed: usual
[[machine.handle]]
from_center_of_mass_mm = 1.0  # measured by hand
[wheel]
runout_mm = 0.09# fitted: no blank before the sign
diameter_mm = 150.0   # fitted: so that it holds
[[measured]]
octave_hz = 125
[expected]
status = "pass"
"""


def test_every_value_has_its_origin_or_none() -> None:
    found = {value.key: value.status for value in value_sources(TEXT)}
    assert found == {
        "machine.name": "published", "machine.mass_kg": "assumed", "machine.handle.from_center_of_mass_mm": None,
        "wheel.runout_mm": None, "wheel.diameter_mm": "fitted",
    }  # fmt: skip
    assert degrees_of_freedom(value_sources(TEXT)) is None and degrees_of_freedom(()) is None
    assert degrees_of_freedom(value_sources("[wheel]\nmass_kg = 1  # assumed: usual\n")) == 0


@pytest.mark.parametrize("index", range(4))
def test_every_value_of_the_grinders_is_published_assumed_or_fitted(index: int) -> None:
    """Keys as TOML reads them, against the comments: none is left out, none is made up."""
    machine = factory_machines()[index].machine
    content = tomllib.loads(machine.document.text)
    keys = {f"{table}.{key}" for table, entries in content.items() if table not in ("measured", "expected")
            for key in entries}  # fmt: skip
    sources = value_sources(machine.document.text)
    assert {source.key for source in sources} == keys and len(sources) == len(keys)
    assert all(source.status and len(source.why) > 5 for source in sources)
    assert all(re.search(r"\d", source.why) for source in sources if source.status == "published")


def test_what_was_chosen_by_results_is_said_to_be_fitted() -> None:
    """The choices that reached the factory's designs and levels."""
    fitted = {(machine.short, source.key) for machine in factory_machines()
              for source in value_sources(machine.machine.document.text) if source.status == "fitted"}  # fmt: skip
    assert fitted == {
        ("707-222", "wheel.runout_mm"), ("707-222", "grinding.contact"),
        ("707-222", "grinding.contact_stiffness_N_per_m"), ("707-370", "wheel.measured_level_db"),
        ("707-305", "autobalancer.max_outer_diameter_mm"), ("707-305", "autobalancer.design"),
        ("707-305", "grinding.contact"), ("MSh-230", "machine.speed_rpm"),
    }  # fmt: skip


@pytest.mark.slow
def test_the_estimate_holds_the_reference_case_along_the_spindle() -> None:
    """V305: 1750 rpm, hands, race eccentricity 10 µm; rear z 0.405572 mm/s, side z 0.787375 (an integrated body).

    The forward whirl of the race is 0.01 mm·Ω/√2. The estimate knows mass, layout and lengths only.
    """
    found = factory_machines()[2]
    assert found.geometry is not None
    there = at_handles(found.machine.whole(), recalled("size", found.machine), found.geometry)
    race = 0.010 * 1750 * 2 * math.pi / 60 / math.sqrt(2)
    low, high = there.carried["z"]
    for reference in (0.405572, 0.787375):
        assert low < 20 * math.log10(reference / race) < high
    assert high - low < 10


def test_a_straight_grinder_by_the_lever() -> None:
    """Free body, axial symmetry but for the gyroscopic moment (0.1 dB): (1/M + p·a/J)/(1/M + a²/J) per axis."""
    found = factory_machines()[0]
    design = recalled("size", found.machine)
    geometry = HandleGeometry({"L": 0.45}, {"front": (0.0, 0.0, 0.1)})
    there = at_handles(found.machine.whole(), design, geometry)
    mass, a, k = design.system_mass_kg, 0.44 * 0.45, 0.284 * 0.45
    ratio = (1 + 0.1 * a / k**2) / (1 + a**2 / k**2)
    middle = 20 * math.log10(ratio)
    low, high = there.carried["y"]
    assert low < middle < high and high - low < 4
    assert there.carried["x"] == pytest.approx(there.carried["y"], abs=0.01)
    lighter = 20 * math.log10(mass * (1 + a**2 / k**2) / mass)
    assert there.lowered[0] < lighter < there.lowered[1]
    assert max(there.carried["z"]) < -100


def test_geometry_needs_lengths_and_handles() -> None:
    assert HandleGeometry.of({"length_mm": 450.0}) is None and HandleGeometry.of({}) is None
    geometry = HandleGeometry.of({"length_mm": 450.0, "handles": {"front": [0, 0, 100]}})
    assert geometry == HandleGeometry({"L": 0.45}, {"front": (0, 0, 0.1)})
    assert abu_calc.read("msh-230").whole().measured
