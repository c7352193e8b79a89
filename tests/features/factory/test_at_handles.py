"""Motion of handles per motion of the race, against the reference case V305 of an exact body, and by hand."""

import math

import pytest

import abu_calc
from abu_calc.features.factory.measurements import HandleGeometry, at_handles, factory_machines
from tests.remembered import recalled


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
