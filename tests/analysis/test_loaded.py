"""Levels under load: steady contact where it holds, else the simulation of grinding, at each handle."""

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from abu_calc.analysis.loaded import loaded_levels
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.sizing.machines import machine

SPEED = 5800 * math.pi / 30


def _design(**changes: Any) -> Design:
    grinding = {"contact_stiffness_N_per_m": 4.9e5, "press_force_N": 45.0}
    return size(machine(**{"wheel__runout_mm": 0.09, "grinding": grinding, **changes}))


def _run(scene: str, velocity: float) -> Any:
    ledger = SimpleNamespace(scene=SimpleNamespace(name=scene))
    return SimpleNamespace(ledger=ledger, simulation=SimpleNamespace(response=SimpleNamespace(velocity_rms=velocity)))


def test_steady_contact_holds_while_wheel_and_work_touch() -> None:
    """A force of 200 N is never let go by the 49 N that vary: the run, whatever it says, is not asked."""
    pressed = {"contact_stiffness_N_per_m": 4.9e5, "press_force_N": 200.0}
    design = _design(grinding=pressed)
    found = loaded_levels(design, [_run("grinding", 1.0)])
    assert found is not None and found == design.loaded and not found.parts_after
    assert found.levels.worst == found.steady


def test_where_they_part_the_simulated_level_stands() -> None:
    design = _design()
    assert design.loaded is not None and design.loaded.parts_after
    assert design.loaded.levels.worst.after is None  # nothing is known before the run
    found = loaded_levels(design, [_run("idle", 1.0), _run("grinding", 5e-8 * 10 ** (106 / 20))])
    assert found is not None and found.simulated
    assert found.levels.worst.after == pytest.approx(106.0)
    assert found.levels.worst.before == pytest.approx(found.steady.before)
    assert found.steady.after is not None and found.steady.after != pytest.approx(106.0, abs=1)


def test_the_simulated_level_is_brought_to_each_handle() -> None:
    """Motion at p per motion at the wheel a of a free rigid body: (1/M + pa/J)/(1/M + a²/J), by hand."""
    body = {"machine__transverse_inertia_kg_m2": 0.1, "machine__center_of_mass_to_wheel_mm": 200.0}
    handles = [{"name": "front", "from_center_of_mass_mm": 100.0}, {"name": "rear", "from_center_of_mass_mm": -150.0}]
    design = _design(**body, machine__handle=handles, wheel__imbalance_g_mm=60.0, wheel__runout_mm=0.2)
    assert design.loaded is not None and design.loaded.parts_after
    found = loaded_levels(design, [_run("grinding", 5e-8 * 10 ** (106 / 20))])
    assert found is not None
    mass = 6.2 + design.autobalancer.mass
    for place, at in zip(found.levels.places, (0.1, -0.15), strict=True):
        share = abs(1 / mass + at * 0.2 / 0.1) / (1 / mass + 0.2**2 / 0.1)
        assert place.levels.after == pytest.approx(106 + 20 * math.log10(share))


@pytest.mark.parametrize("contact", ["rigid", "compliant"])
def test_without_an_answer_there_is_no_level(contact: str) -> None:
    """A rigid contact cannot part, so its run tells nothing; nor is there a level where the run failed."""
    grinding = {"contact": contact, "press_force_N": 10.0}
    design = _design(grinding=grinding)
    assert design.loaded is not None and design.loaded.parts_after
    runs = [_run("grinding", 1.0)] if contact == "rigid" else []
    found = loaded_levels(design, runs)
    assert found is not None and found.levels.worst.after is None and not found.simulated


def test_a_face_contact_does_not_part() -> None:
    design = _design(grinding={"contact": "face"})
    found = loaded_levels(design, [])
    assert found is not None and found.levels == design.idle and not found.parts_after
    assert loaded_levels(replace(design, loaded=None), []) is None
