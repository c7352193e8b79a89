"""Levels under load: those of `abu grinding`, steady contact where it holds, else simulated, at each handle."""

import math
from dataclasses import replace
from typing import Any

import pytest

from abu_calc.features.grinding.work import at_work, loaded_levels, work_of
from abu_calc.simulation.design_scenes import SceneFailure, simulated
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.sizing.machines import machine

FAILED = SceneFailure("grinding", "no answer")
"""Of the start from bunched balls, where that is not what is tested."""


def _design(**changes: Any) -> Design:
    grinding = {"contact_stiffness_N_per_m": 4.9e5, "press_force_N": 45.0}
    return size(machine(**{"wheel__runout_mm": 0.09, "grinding": grinding, **changes}))


@pytest.mark.slow
def test_steady_contact_holds_while_wheel_and_work_touch() -> None:
    """A force of 200 N is never let go by the 49 N that vary."""
    design = _design(grinding={"contact_stiffness_N_per_m": 4.9e5, "press_force_N": 200.0})
    found = loaded_levels(design, work_of(design, 0.01, hard=FAILED))
    assert found is not None and design.loaded is not None and not found.parts_after
    assert found.levels.worst.before == pytest.approx(design.loaded.levels.worst.before)
    assert found.levels.worst.after == pytest.approx(design.loaded.levels.worst.after)
    assert found.levels.worst == found.steady
    assert found.hasty == found.levels and not found.stays


@pytest.mark.slow
def test_where_they_part_the_simulated_level_stands() -> None:
    """Bunched balls come to another state, 119.6 dB, that stays; both are told, as `abu grinding` has them."""
    design = _design(
        autobalancer__ball_count=4, autobalancer__ball_diameter_mm=15.875, autobalancer__race_radius_mm=31.0,
        wheel__imbalance_g_mm=256.0,
    )  # fmt: skip
    assert design.loaded is not None and design.loaded.parts_after
    assert design.loaded.levels.worst.after is None  # nothing is known before the run
    runs, _ = simulated(design, 0.01, names=("grinding",))
    work, own = work_of(design, 0.01, hard=runs[0]), at_work(design, 0.01)
    found = loaded_levels(design, work)
    assert found is not None and found.hasty is not None and found.parts_after
    assert found.levels == own.settled and found.hasty == own.hasty and found.stays == own.stays_loud
    assert found.steady.after is not None and found.levels.worst.after != pytest.approx(found.steady.after, abs=1)
    assert found.stays and found.hasty.worst.after == pytest.approx(119.6, abs=0.3)


@pytest.mark.slow
def test_the_level_is_brought_to_each_handle() -> None:
    """Motion at p per motion at the wheel a of a free rigid body: (1/M + pa/J)/(1/M + a²/J), by hand."""
    body = {"machine__transverse_inertia_kg_m2": 0.1, "machine__center_of_mass_to_wheel_mm": 200.0}
    handles = [{"name": "front", "from_center_of_mass_mm": 100.0}, {"name": "rear", "from_center_of_mass_mm": -150.0}]
    pressed = {"contact_stiffness_N_per_m": 1e5, "press_force_N": 18.0}
    design = _design(**body, machine__handle=handles, wheel__imbalance_g_mm=60.0, grinding=pressed)
    found = loaded_levels(design, work_of(design, 0.01, hard=FAILED))
    assert found is not None
    mass, levels = 6.2 + design.autobalancer.mass, [place.levels.after for place in found.levels.places]
    shares = [abs(1 / mass + at * 0.2 / 0.1) for at in (0.1, -0.15)]
    assert None not in levels
    assert (levels[0] or 0) - (levels[1] or 0) == pytest.approx(20 * math.log10(shares[0] / shares[1]))
    assert found.levels.worst.after == max(level or 0 for level in levels)


@pytest.mark.slow
def test_without_an_answer_there_is_no_level() -> None:
    """A rigid contact cannot part, so its run tells nothing."""
    design = _design(grinding={"contact": "rigid", "press_force_N": 10.0})
    assert design.loaded is not None and design.loaded.parts_after
    found = loaded_levels(design, work_of(design, 0.01, hard=FAILED))
    assert found is not None and found.levels.worst.after is None
    none = loaded_levels(design, FAILED)
    assert none is not None and none.levels.worst.before is none.levels.worst.after is None


def test_a_face_contact_does_not_part() -> None:
    design = _design(grinding={"contact": "face"})
    found = loaded_levels(design, work_of(design, 0.01))
    assert found is not None and found.levels == design.idle and not found.parts_after
    assert loaded_levels(replace(design, loaded=None), None) is None
