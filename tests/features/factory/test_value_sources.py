"""Origins of the values of a file, as the comments behind them say."""

import re
import tomllib

import pytest

from abu_calc.features.factory.measurements import factory_machines
from abu_calc.features.factory.value_sources import degrees_of_freedom, value_sources

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
