"""What an unknown key or an unusual number was meant to be."""

import math

import pytest

from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.reading.suggestions import (
    MISTAKEN,
    MOST,
    guesses,
    header,
    meant_in,
    meant_table,
    nearest,
    other_unit,
)
from abu_calc.inputs.reading.table import Usual


@pytest.mark.parametrize(("key", "value", "usual", "unit", "meant"), [
    ("speed_rpm", 97.0, (1000, 60000), "Hz", 5820.0), ("mass_kg", 5600.0, (0.3, 150), "g", 5.6),
    ("diameter_mm", 0.15, (50, 300), "m", 150.0), ("angle_deg", math.pi, (100, 200), "rad", 180.0),
    ("time_s", 1000.0, (0.5, 2), "ms", 1.0), ("share", 5.0, (0.01, 0.2), "%", 0.05),
    ("stiffness_N_per_m", 200.0, (1e5, 1e6), "N/mm", 2e5), ("run_down_s", 1 / 60, (0.5, 2), "min", 1.0),
])  # fmt: skip
def test_a_number_in_another_unit_is_converted(
    key: str, value: float, usual: tuple[float, float], unit: str, meant: float
) -> None:
    first = guesses(key, [value], Usual(*usual))[0]
    assert first.unit == unit and first.values == pytest.approx((meant,), rel=1e-12)


def test_every_number_of_a_list_must_become_usual() -> None:
    assert [guess.unit for guess in guesses("mass_kg", [5600.0, 600.0], Usual(0.3, 150))] == ["g"]
    assert guesses("mass_kg", [5600.0, 5.6], Usual(0.3, 150)) == []
    assert all(len(guesses("g_mm", [10.0**k], Usual(1e-9, 1e9))) <= MOST for k in range(-6, 7))


def test_a_sign_stays_as_it_is() -> None:
    assert guesses("place_mm", [-0.1], Usual(10, 1000))[0].values == pytest.approx((-100.0,))


def test_an_acceleration_is_a_level_by_the_speed_alone() -> None:
    """10.8 m/s² rms at 607.37 rad/s is 17.78 mm/s, 111.02 dB re 5e-8 m/s."""
    level = 20 * math.log10(10.8 / (5800 * math.pi / 30) / 5e-8)
    values = {guess.unit: guess.values for guess in guesses("level_db", [10.8], Usual(60, 135), 5800.0)}
    assert values["m/s²"] == pytest.approx((level,), rel=1e-12)
    assert "m/s²" not in {guess.unit for guess in guesses("level_db", [10.8], Usual(60, 135))}


def test_no_unit_is_mistaken_for_itself() -> None:
    from abu_calc.foundation.units import SI_PER_UNIT

    for unit, others in MISTAKEN.items():
        own = SI_PER_UNIT[unit] if unit else 1.0
        assert all(size != pytest.approx(own, rel=1e-9) for size in others.values()), unit


def test_guesses_in_words() -> None:
    assert meant_in(guesses("mass_kg", [5600.0], Usual(0.3, 150)), " kg") == "meant in g (5.6 kg)"
    assert meant_in([], " kg") == ""


def test_a_misspelt_word_is_nearest_to_the_right_one() -> None:
    known = ["mass_kg", "speed_rpm", "name"]
    assert [nearest(word, known) for word in ("MASS_KG", "sped_rpm", "zzz")] == ["mass_kg", "speed_rpm", None]
    assert [other_unit(key, known) for key in ("mass_lb", "speed", "name_kg", "mass_x")] == [
        "mass_kg", "speed_rpm", None, None,
    ]  # fmt: skip


def test_a_lost_table_is_told_as_a_file_writes_it() -> None:
    assert header(MachineFile, ("machine",)) == "[machine]"
    assert header(MachineFile, ("bearing", 0)) == "[[bearing]]"
    assert header(MachineFile, ("machine", "handle", 2)) == "[[machine.handle]]"
    assert meant_table(MachineFile, "weel", {}) == ("wheel", "the nearest known table is [wheel]")
    meant, remedy = meant_table(MachineFile, "balance_grade", "G16")
    assert meant is None and remedy == "balance_grade belongs in [wheel]"
