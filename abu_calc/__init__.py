"""abu-calc: design calculator for passive ball autobalancers.

The names below are the public ones; each is imported when it is first used, so that importing the package costs
nothing.

    machine = read_machine("machine.toml").machine
    design = size(machine)
    simulation = simulate(idle_scene(design))
"""

import importlib
from typing import Any

from abu_calc.version import __version__

_HOMES = {
    "AbuError": "errors",
    "InputError": "errors",
    "NotTrustworthyError": "errors",
    "Check": "checks",
    "read_machine": "spec.read",
    "Machine": "spec.machine",
    "size": "sizing",
    "Design": "sizing",
    "seat_bearing": "fits.seats",
    "Scene": "dynamics.scene",
    "Race": "dynamics.scene",
    "planar": "dynamics.supports.linear",
    "idle_scene": "scenes.from_design",
    "simulate": "analysis.simulate",
}

__all__ = ["__version__", *sorted(_HOMES)]


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(importlib.import_module(f"abu_calc.{_HOMES[name]}"), name)
    raise AttributeError(f"module 'abu_calc' has no attribute {name!r}")
