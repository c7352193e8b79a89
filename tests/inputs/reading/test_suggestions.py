"""What an unknown key or an unusual number was meant to be."""

import pytest

from abu_calc.inputs.reading.suggestions import (
    MISTAKEN,
    MOST,
    guesses,
    nearest,
    other_unit,
)
from abu_calc.inputs.reading.table import Usual


def test_every_number_of_a_list_must_become_usual() -> None:
    assert [guess.unit for guess in guesses("mass_kg", [5600.0, 600.0], Usual(0.3, 150))] == ["g"]
    assert guesses("mass_kg", [5600.0, 5.6], Usual(0.3, 150)) == []
    assert all(len(guesses("g_mm", [10.0**k], Usual(1e-9, 1e9))) <= MOST for k in range(-6, 7))


def test_no_unit_is_mistaken_for_itself() -> None:
    from abu_calc.foundation.units import SI_PER_UNIT

    for unit, others in MISTAKEN.items():
        own = SI_PER_UNIT[unit] if unit else 1.0
        assert all(size != pytest.approx(own, rel=1e-9) for size in others.values()), unit


def test_a_misspelt_word_is_nearest_to_the_right_one() -> None:
    known = ["mass_kg", "speed_rpm", "name"]
    assert [nearest(word, known) for word in ("MASS_KG", "sped_rpm", "zzz")] == ["mass_kg", "speed_rpm", None]
    assert [other_unit(key, known) for key in ("mass_lb", "speed", "name_kg", "mass_x")] == [
        "mass_kg", "speed_rpm", None, None,
    ]  # fmt: skip
