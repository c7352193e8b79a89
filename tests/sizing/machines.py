"""Machines for the tests of sizing."""

from copy import deepcopy
from typing import Any

from abu_calc.inputs.machine import MachineFile

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
