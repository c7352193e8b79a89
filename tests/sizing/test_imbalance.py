"""The wheel's imbalance from each of its sources."""

import math

import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.foundation.units import velocity_from_level
from abu_calc.sizing import size
from abu_calc.sizing.case import read_case
from abu_calc.sizing.imbalance import find_imbalance, imbalance_from_level
from tests.sizing.machines import machine

OMEGA = 5800 * math.pi / 30


@pytest.mark.parametrize(("inertance", "grams"), [(1 / 6.4, 265), (1 / 6.4 + 0.2, 116), (1 / 6.4 - 0.4, 169)])
def test_imbalance_of_111_db_by_place(inertance: float, grams: float) -> None:
    found = imbalance_from_level(velocity_from_level(111), OMEGA, inertance)
    assert 1e6 * found == pytest.approx(grams, abs=1.0)


@pytest.mark.slow
def test_background_is_taken_off_the_measured_level() -> None:
    level = {"wheel__imbalance_g_mm": None, "wheel__measured_level_db": 111.0}
    quiet = size(machine(**level))
    noisy = size(machine(**level, machine__background_level_db=105.0))
    share = math.sqrt(1 - 10 ** ((105 - 111) / 10))
    assert noisy.imbalance.value == pytest.approx(quiet.imbalance.value * share, rel=1e-9)
    assert noisy.idle.worst.before == pytest.approx(111.0) == quiet.idle.worst.before
    with pytest.raises(InputError, match="background"):
        size(machine(**level, machine__background_level_db=111.0))


def test_a_handle_at_a_node_says_nothing_of_the_imbalance() -> None:
    node = 1000 * 0.1 / (6.2 * 0.2)  # p = −J/(M·a)
    with pytest.raises(InputError, match="node") as caught:
        size(
            machine(
                machine__transverse_inertia_kg_m2=0.1,
                machine__center_of_mass_to_wheel_mm=200.0,
                machine__handle=[{"name": "rear", "from_center_of_mass_mm": -node}],
                wheel__imbalance_g_mm=None,
                wheel__measured_level_db=100.0,
                wheel__measured_at="rear",
            )
        )
    assert caught.value.place.key == "wheel.measured_at"


def test_a_balance_grade_is_a_speed_of_the_centre_of_mass() -> None:
    """G16: eΩ = 16 mm/s for the wheel of 0.6 kg at 5800 rpm."""
    imbalance = find_imbalance(read_case(machine(wheel__imbalance_g_mm=None, wheel__balance_grade="G16")))
    assert imbalance.value == pytest.approx(0.6 * 16e-3 / OMEGA)
    assert "G16" in imbalance.source
