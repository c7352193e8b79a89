"""Sensitivities of sensors: numbers and texts with units, and what is refused."""

import math

import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.sensitivity import sensitivities, sensitivity_of
from tests.rows import for_each

G = 9.80665


@pytest.mark.parametrize(("given", "quantity", "volts"), [
    (10.2, "acceleration", 10.2e-3), ("10.2", "acceleration", 10.2e-3), ("100 mV/g", "acceleration", 0.1 / G),
    ("10.2 mV/(m/s²)", "acceleration", 10.2e-3), ("1 mV/ms⁻²", "acceleration", 1e-3), ("1 V/g", "acceleration", 1 / G),
    ("10.2 mV per m/s2", "acceleration", 10.2e-3), ("10.2 mV_per_m_per_s2", "acceleration", 10.2e-3),
    ("20 mV/(mm/s)", "velocity", 20.0), ("20 V/(m/s)", "velocity", 20.0), ("8 mV/µm", "displacement", 8e3),
    ("1e1mV/g", "acceleration", 0.01 / G),
])  # fmt: skip
def test_volts_per_unit_of_motion(given: float | str, quantity: str, volts: float) -> None:
    [made] = sensitivities(given)
    assert (made.channel, made.quantity) == (None, quantity)
    assert made.volts_per_unit == pytest.approx(volts, rel=1e-12)


def test_channels_by_name_and_number() -> None:
    made = sensitivities(["ax_mV=10", "2=11 mV/g", "9"])
    assert [sensitivity_of(made, name, k).volts_per_unit for k, name in enumerate(("ax_mV", "b", "c"), 1)] == (  # type: ignore[union-attr]
        pytest.approx([0.010, 0.011 / G, 0.009], rel=1e-12)
    )
    assert sensitivities({"ax_mV": 10.0})[0].channel == "ax_mV" and sensitivities(None) == ()
    assert sensitivity_of(made[:1], "b", 2) is None


@for_each([
    0.0, -1.0, math.nan, math.inf, "10,2", "", "mV/g", "100 g", "100 mV", "100 mV/kg", "100 pC/g", "100 mV/g/g",
    "ax=", "ax=1=2 mV", "1e", "1e999", ["ax=1", "ax=2"], [1.0, 2.0],
])  # fmt: skip
def test_what_is_no_sensitivity_is_refused(given: float | str | list[float | str]) -> None:
    with pytest.raises(InputError) as refused:
        sensitivities(given)
    assert refused.value.place.key == "sensitivity"
