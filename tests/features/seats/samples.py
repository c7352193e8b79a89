"""The worked example of Afanasiev 2015 (bearing 7516, 3 kN, chamfers of 4 mm in all), to be varied."""

from typing import Any

from abu_calc.features.seats.bearing import SeatedBearing
from abu_calc.features.seats.lookup import from_table
from abu_calc.features.seats.seats import BearingSeats, seat_bearing
from abu_calc.inputs.rolling_bearing import Bearing


def table(**changes: Any) -> Any:
    """A bearing table as a machine file gives it."""
    example = {
        "name": "knife shaft",
        "designation": None,
        "bore_mm": 80.0,
        "outer_mm": 140.0,
        "width_mm": 33.0,
        "chamfer_mm": 2.0,
        "radial_load_kN": 3.0,
        "load_kind": None,
        "series": "light",
        "inner_ring_load": "rotating",
        "outer_ring_load": "stationary",
        "bearing_class": None,
        "shaft_fit": "k6",
        "housing_fit": "K7",
        "shaft_rz_um": None,
        "housing_rz_um": None,
        "ring_temperature_difference_K": None,
        "speed_rpm": None,
        "shaft_bore_mm": None,
        "housing_outer_mm": None,
        "housing_material": "steel",
        "internal_clearance": None,
        "raceway_temperature_difference_K": None,
        "starting_torque_N_m": None,
        "seat_friction": 0.12,
        "asked_interference_um": None,
        "bearing_type": None,
        "dynamic_load_rating_kN": None,
        "static_load_rating_kN": None,
        "shaft_limits_um": None,
        "housing_limits_um": None,
        "housing_temperature_difference_K": None,
        "temperature_rise_K": None,
        "shaft_material": "steel",
        "shaft_strength_MPa": None,
        "housing_strength_MPa": None,
        "housing_split": False,
        "axial_load_kN": None,
        "position_mm": None,
        "lubricant_viscosity_mm2_per_s": None,
        "contamination_factor": 0.5,
        "required_life_h": None,
        "short_pairs_warn_percent": 1.0,
        "short_pairs_fail_percent": 5.0,
        "temperature_range_K": None,
        "cutting_force_N": None,
        "normal_to_cutting_ratio": None,
        "bearings_sharing": None,
        "ring_bore_limits_um": None,
        "ring_outer_limits_um": None,
        "mounting_clearance_um": None,
    }
    assert set(changes) <= set(example)
    return Bearing.model_construct(**(example | changes))  # type: ignore[arg-type]  # some values no file may hold


def by_designation(designation: str, **changes: Any) -> Any:
    """A table that leaves the sizes to a designation."""
    sizes = {"bore_mm": None, "outer_mm": None, "width_mm": None, "chamfer_mm": None, "series": None}
    return table(designation=designation, **(sizes | changes))


def bearing(**changes: Any) -> SeatedBearing:
    return from_table(table(**changes))


def seats(**changes: Any) -> BearingSeats:
    return seat_bearing(table(**changes))
