"""Units as instruments show them: every one by hand, and what is refused."""

import math
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.balancing.run_tables import instrument_of, known_units
from abu_calc.foundation.errors import InputError
from tests.features.balancing.rig import RIG, ROTOR, Workshop, written
from tests.rows import for_each

FACTORS = {
    "µm": 1e-6, "mil": 25.4e-6, "mm": 1e-3, "mm/s": 1e-3, "ips": 25.4e-3, "m/s²": 1.0, "g": 9.80665,
}  # fmt: skip
PER_PEAK = {"0-peak": 1.0, "peak-peak": 2.0, "rms": 1 / math.sqrt(2)}


@for_each(known_units())
def test_every_unit_by_hand(unit: str) -> None:
    size, detector = unit.split(" ")
    shown = instrument_of(unit)
    assert shown is not None and shown.shown == unit
    assert shown.amplitude(3.0) == pytest.approx(3.0 * FACTORS[size] / PER_PEAK[detector], rel=1e-12)
    assert shown.reading(shown.amplitude(3.0)) == pytest.approx(3.0, rel=1e-12)


def test_known_units_are_all_of_them() -> None:
    assert set(known_units()) == {f"{size} {detector}" for size in FACTORS for detector in PER_PEAK}


@pytest.mark.parametrize("unit", known_units())
def test_the_answer_does_not_depend_on_the_unit(tmp_path: Path, unit: str) -> None:
    """A rig read in each unit gives 12 g and 7 g; the verification is in that unit."""
    shown = instrument_of(unit)
    assert shown is not None
    shop = Workshop(quantity=shown.quantity)
    scale = {"displacement": 1e-3, "velocity": 1e-3, "acceleration": 1.0}[shown.quantity]
    (A, alpha), (B, beta) = shop.read()
    left, right = (shown.reading(value * scale) for value in (A, B))
    run = (
        f'[[run]]\nspeed_rpm = 3000\nunit = "{unit}"\nphase = "lag"\n'
        f"left = {{ amplitude = {left!r}, phase_deg = {alpha!r} }}\n"
        f"right = {{ amplitude = {right!r}, phase_deg = {beta!r} }}"
    )
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR, run))
    assert (result.left.mass_g, result.right.mass_g) == pytest.approx((12.0, 7.0), rel=1e-9)
    (after,) = result.residual_check.verification
    assert after.unit == unit and (after.left_before, after.right_before) == pytest.approx((left, right), rel=1e-9)


@pytest.mark.parametrize(
    "unit", ["mil", "", "rms", "furlong rms", "mm/s avg", "G rms", "MM rms", "µm/s rms", "rms mm/s"]
)
def test_unknown_units_are_refused_with_those_there_are(tmp_path: Path, unit: str) -> None:
    run = Workshop().run().replace('quantity = "displacement"', f'unit = "{unit}"')
    with pytest.raises(InputError) as refused:
        abu_calc.balance(written(tmp_path, RIG, ROTOR, run))
    assert "the unit is not known" in str(refused.value) and "mil peak-peak" in str(refused.value)


@pytest.mark.parametrize(
    ("written_unit", "printed"),
    [
        ("um rms", "µm rms"), ("μm rms", "µm rms"), ("µm  rms", "µm rms"), ("in/s rms", "ips rms"),
        ("m/s2 0–peak", "m/s² 0-peak"), ("mil peak–peak", "mil peak-peak"), ("mil pk-pk", "mil peak-peak"),
        ("µm p-p", "µm peak-peak"), ("in/s pk", "ips 0-peak"), ("mm/s RMS", "mm/s rms"),
        ("um Peak-Peak", "µm peak-peak"), ("g 0-pk", "g 0-peak"),
    ],
)  # fmt: skip
def test_short_forms_of_displays_are_known(written_unit: str, printed: str) -> None:
    found, same = instrument_of(written_unit), instrument_of(printed)
    assert found == same and found is not None and found.shown == printed


def test_a_unit_that_contradicts_the_quantity_is_refused(tmp_path: Path) -> None:
    run = Workshop().run() + 'unit = "ips rms"\n'
    with pytest.raises(InputError, match="contradict"):
        abu_calc.balance(written(tmp_path, RIG, ROTOR, run))
