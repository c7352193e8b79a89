"""Machines for the tests of sizing."""

from copy import deepcopy
from typing import Any

from abu_calc.foundation.checks import Check
from abu_calc.inputs.machine import MachineFile
from abu_calc.sizing import size
from abu_calc.sizing.design import Design

BASE: dict[str, Any] = {
    "machine": {
        "name": "test grinder",
        "layout": "straight",
        "mass_kg": 5.6,
        "speed_rpm": 5800,
        "spindle_axis": "horizontal",
    },
    "suspension": {"model": "springs", "natural_frequencies_hz": [2.5, 2.5], "damping_ratios": [0.5, 0.5]},
    "wheel": {"mass_kg": 0.6, "diameter_mm": 150.0, "imbalance_g_mm": 250.0},
    "autobalancer": {"max_outer_diameter_mm": 68.0, "max_width_mm": 32.0},
}

PINNED = {"autobalancer__ball_count": 4, "autobalancer__ball_diameter_mm": 8.0, "autobalancer__race_radius_mm": 30.0}
DRUM = {
    "machine__mass_kg": 30.0, "machine__speed_rpm": 1250, "wheel__mass_kg": 3.0, "wheel__diameter_mm": 500.0,
    "wheel__imbalance_g_mm": 60000.0, "autobalancer__design": "light", "autobalancer__ball_count": 8,
    "autobalancer__max_outer_diameter_mm": 520.0, "autobalancer__max_width_mm": 40.0,
    "autobalancer__max_mass_fraction": 0.3, "autobalancer__ball_diameter_mm": 24.0,
    "autobalancer__race_radius_mm": 250.0,
}  # fmt: skip


def machine(**changes: Any) -> MachineFile:
    """The base machine with entries changed: `wheel__runout_mm=0.09`; None removes an entry, a dict sets a table."""
    tables = deepcopy(BASE)
    for path, value in changes.items():
        table, _, key = path.partition("__")
        if not key:
            tables[table] = value
        elif value is None:
            tables[table].pop(key, None)
        else:
            tables.setdefault(table, {})[key] = value
    return MachineFile.model_validate(tables)


def check_of(design: Design, code: str) -> Check:
    """The check of one code."""
    return next(check for check in design.checks if check.code == code)


def ranged(limit: float) -> Design:
    """Four balls of 8 mm, 2500 to 12000 rpm, with a limit [dB] of the level."""
    changes = {"machine__speed_rpm": 5000, "machine__speed_range_rpm": [2500, 12000], "wheel__imbalance_g_mm": 100.0}
    return size(machine(**changes, **PINNED, limits={"vibration_level_db": limit}))
