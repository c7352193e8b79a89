"""Numbers written with a unit: known conversions, every unit of every key, and what is refused."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from abu_calc.foundation.units import SI_PER_UNIT
from abu_calc.foundation.written_units import (
    SUFFIXES,
    UNITS,
    WrittenUnitError,
    allowed_units,
    written_unit,
)
from tests.rows import for_each

# Worked out by hand from the definitions of the units (SI Brochure; NIST SP 811 for inch, pound, ounce, kgf).
GOLDENS = [
    ("mass_kg", "5.6 kg", 5.6),
    ("mass_kg", "5600 g", 5.6),
    ("mass_kg", "1 lb", 0.45359237),
    ("ball_mass_g", "0.0164 kg", 16.4),
    ("speed_rpm", "97 Hz", 5820.0),
    ("speed_rpm", "100 rad/s", 954.92965855137),
    ("speed_rpm", "5800 r/min", 5800.0),
    ("natural_frequency_hz", "150 rpm", 2.5),
    ("natural_frequency_hz", "10 rad/s", 1.5915494309189535),
    ("diameter_mm", "5 in", 127.0),
    ("diameter_mm", "12.5 cm", 125.0),
    ("runout_um", "2 mil", 50.8),
    ("imbalance_g_mm", "25.6 g·cm", 256.0),
    ("imbalance_g_mm", "0.00025 kg m", 250.0),
    ("imbalance_g_mm", "1 oz·in", 720.07788737500),
    ("inertia_kg_m2", "138 kg·cm²", 0.0138),
    ("inertia_kg_m2", "1e6 g mm2", 1e-3),
    ("angle_deg", "0.5 rad", 28.64788975654116),
    ("angle_rad", "180°", math.pi),
    ("time_s", "90 ms", 0.09),
    ("life_min", "1 h", 60.0),
    ("drag_per_s", "900 1/min", 15.0),
    ("force_N", "2 kgf", 19.6133),
    ("load_kN", "500 N", 0.5),
    ("torque_N_m", "30 N·cm", 0.3),
    ("stiffness_N_per_m", "2 N/µm", 2e6),
    ("damping_N_s_per_m", "0.003 N*s/mm", 3.0),
    ("power_W", "1.2 kW", 1200.0),
    ("strength_MPa", "250 N/mm^2", 250.0),
    ("velocity_mm_per_s", "0.5 in/s", 12.7),
    ("acceleration_m_per_s2", "1 g", 9.80665),
    ("viscosity_mm2_per_s", "46 cSt", 46.0),
    ("density_kg_per_m3", "7.8 g/cm³", 7800.0),
    ("share_percent", "5 ‰", 0.5),
    ("oil_temperature_C", "104 °F", 40.0),
    ("oil_temperature_C", "0 K", -273.15),
    ("rise_K", "30 K", 30.0),
    ("level_db", "102 dB", 102.0),
    ("hardness_HRC", "60 HRC", 60.0),
]


@for_each(GOLDENS)
def test_known_conversions(key: str, text: str, value: float) -> None:
    unit = written_unit(key)
    assert unit is not None
    assert unit.value(text) == pytest.approx(value, rel=1e-14)


def test_exact_factors_give_the_number_that_a_file_would_have() -> None:
    """No digits of rounding: what was written in the unit of the key, or by powers of ten, comes out the same."""
    for key, text, value in (("mass_kg", "5600 g", 5.6), ("mass_kg", "5.6 kg", 5.6), ("d_mm", "0.0673 m", 67.3),
                             ("d_mm", "2.65 in", 67.31), ("speed_rpm", "96.7 Hz", 5802.0)):  # fmt: skip
        assert written_unit(key).value(text) == value  # type: ignore[union-attr]


def test_every_unit_of_keys_is_known_with_the_same_size() -> None:
    """The second table of sizes, by which results are converted, agrees with this one."""
    assert set(SI_PER_UNIT) | {"db", "HRC"} <= set(SUFFIXES)
    for quantity, suffixes, _ in allowed_units():
        sized = [suffix for suffix in suffixes if suffix in SI_PER_UNIT]
        for one in sized:
            for other in sized:
                unit, (_, symbol) = written_unit(f"x_{other}"), SUFFIXES[one]
                ratio = SI_PER_UNIT[one] / SI_PER_UNIT[other]
                assert unit.value(f"1 {symbol}") == pytest.approx(ratio, rel=1e-14), quantity  # type: ignore[union-attr]


@pytest.mark.few(4)
@pytest.mark.parametrize("suffix", SUFFIXES)
@given(st.floats(-1e6, 1e6, allow_subnormal=False))
def test_a_number_in_the_unit_of_the_key_is_that_number(suffix: str, number: float) -> None:
    unit = written_unit(f"x_{suffix}")
    assert unit is not None and unit.unit in UNITS[unit.quantity]
    assert unit.value(f"{number!r} {unit.unit}") == number


def test_the_longest_ending_counts() -> None:
    keys = [
        ("damping_N_s_per_m", "damping", "N_s_per_m"), ("a_m_per_s2", "a", "m_per_s2"),
        ("runout_tir_mm", "runout_tir", "mm"), ("imbalance_g_mm", "imbalance", "g_mm"),
    ]  # fmt: skip
    for key, stem, suffix in keys:
        unit = written_unit(key)
        assert unit is not None and (unit.stem, unit.suffix) == (stem, suffix)
    assert written_unit("capacity_margin") is None and written_unit("mm") is None


REFUSED = [
    ("5.6", "missing"), ("kg", "not a number"), ("", "not a number"), ("5,6 kg", "decimal comma"), (" 5 kg", "blanks"),
    ("5 kg ", "blanks"), ("5  kg", "not a number"), ("5 Kg", "not a unit of mass"), ("5 KG", "not a unit"),
    ("5 k g", "not a unit"), ("5 kg kg", "not a unit"), ("5 mm", "not a unit of mass"), (".5 kg", "not a number"),
    ("5. kg", "not a unit"), ("+-5 kg", "not a number"), ("1_000 kg", "not a unit"), ("0x10 kg", "not a unit"),
    ("nan kg", "not a number"), ("inf kg", "not a number"), ("1e999 kg", "too large"), ("5 kg\n", "blanks"),
    ("5\u00a0kg", "not a"), ("٥ kg", "not a number"), ("5/2 kg", "not a unit"), ("5 kg/m", "not a unit"),
    ("5 kg·", "not a unit"), ("5 ·kg", "not a unit"), ("9" * 70 + " kg", "not a number"), ("5e kg", "not a unit"),
]  # fmt: skip


@for_each(REFUSED)
def test_other_texts_are_refused_with_the_units(text: str, fault: str) -> None:
    unit = written_unit("mass_kg")
    with pytest.raises(WrittenUnitError, match=fault) as caught:
        unit.value(text)  # type: ignore[union-attr]
    assert caught.value.allowed == "a number with one of kg, g, mg, t, lb, oz"


@pytest.mark.slow
@given(st.text(max_size=20))
def test_no_text_makes_anything_but_a_finite_number_or_a_refusal(text: str) -> None:
    for key in ("mass_kg", "drag_per_s", "t_C", "rise_K"):
        try:
            value = written_unit(key).value(text)  # type: ignore[union-attr]
        except WrittenUnitError:
            continue
        assert math.isfinite(value) and re.match(r"[+-]?[0-9]", text)


def test_a_temperature_difference_has_no_zero() -> None:
    for text in ("20 °C", "68 °F", "20 C", "20 deg"):
        with pytest.raises(WrittenUnitError):
            written_unit("temperature_rise_K").value(text)  # type: ignore[union-attr]
