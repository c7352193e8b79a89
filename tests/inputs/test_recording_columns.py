"""Names of columns: time, quantity, unit, volts and handle."""

import pytest

from abu_calc.inputs.recording_columns import column_of


@pytest.mark.parametrize(("name", "unit"), [("t_s", 1.0), ("Time (ms)", 1e-3), ("время", None), ("clock [min]", 60.0)])
def test_a_name_tells_time(name: str, unit: float | None) -> None:
    column = column_of(name)
    assert (column.is_time, column.unit, column.quantity) == (True, unit, None)


@pytest.mark.parametrize(("name", "handle", "volts"), [
    ("front_ax_m_per_s2", "front", None), ("rear x [m/s²]", "rear", None), ("ax_mV", "", 1e-3), ("a [V]", "", 1.0),
    ("Acc_side_handle_z [mV]", "side handle", 1e-3), ("x_mm", "", None), ("accel_x", "", None), ("signal", "", None),
    ("Channel 1 x [mV]", "", 1e-3), ("front_v_mm_per_s", "", None), ("Ускорение [мВ]", "", 1e-3),
])  # fmt: skip
def test_a_name_tells_handle_and_volts(name: str, handle: str, volts: float | None) -> None:
    column = column_of(name)
    assert (column.place, column.volts) == (handle, volts) and not column.is_time
    assert volts is None or column.unit is None
