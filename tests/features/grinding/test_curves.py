"""What shakes dry friction out of a race: the source's claim, by simulation, against the closed threshold."""

from typing import Any

import pytest

from abu_calc.features.grinding import curves as module
from abu_calc.features.grinding.curves import Shaken, shaken
from abu_calc.features.grinding.formulas import shaking_threshold
from abu_calc.features.grinding.steady_contact import bare, fitted, runout_of
from abu_calc.features.grinding.work import Side, Work
from abu_calc.sizing import size
from tests.sizing.machines import machine


def _shaken(**changes: Any) -> tuple[Shaken, float]:
    """What is left, and the threshold [m], without running the machine at its work."""
    design = size(machine(autobalancer__ball_count=3, autobalancer__ball_diameter_mm=12.0, **changes))
    runout, one = runout_of(design.case), design.autobalancer
    press = design.case.contact.press_force if design.case.contact else 0.0
    sides = [Side(side(design, runout), press=press) for side in (bare, fitted)]
    found = shaken(Work(design, *sides, sides[1], design.idle, design.idle, None, 0.0))
    assert found is not None
    return found, shaking_threshold(design.case.friction_arm, one.pitch_radius, one.ball_diameter / 2)


FACE: dict[str, Any] = {"machine__layout": "face", "grinding": {"contact": "face"}}
STRAIGHT: dict[str, Any] = {"grinding": {"contact_stiffness_N_per_m": 3e5, "press_force_N": 1e3}}


@pytest.mark.slow
def test_axial_runout_shakes_friction_out_of_a_face_machine() -> None:
    """Above the threshold nearly nothing of the band is left within a second; well below it most of it."""
    unshaken, threshold = _shaken(**FACE)
    assert unshaken.way == "across" and not unshaken.given
    assert unshaken.amplitude == pytest.approx(module.TRIED * threshold)
    assert unshaken.unshaken is not None and unshaken.shaken is not None
    assert unshaken.unshaken > 0.3 * threshold  # balls stopped where friction held them
    assert unshaken.shaken < 0.2 * unshaken.unshaken
    little, _ = _shaken(**FACE, wheel__axial_runout_mm=0.5e3 * threshold)
    assert little.given and little.unshaken == unshaken.unshaken
    assert little.shaken is not None and little.shaken > 0.5 * unshaken.unshaken


@pytest.mark.slow
@pytest.mark.parametrize("share", [1.5, 2.0, 4.0])
def test_the_threshold_is_where_the_band_is_lost(share: float) -> None:
    """From half as much again as the threshold on."""
    found, threshold = _shaken(**FACE)
    more, _ = _shaken(**FACE, wheel__axial_runout_mm=1e3 * share * threshold)
    assert found.unshaken is not None and more.shaken is not None and more.shaken < 0.4 * found.unshaken


@pytest.mark.slow
def test_a_little_runout_in_the_plane_shakes_nothing_out() -> None:
    """A whirl below the threshold leaves what friction holds."""
    held, threshold = _shaken(**STRAIGHT, wheel__runout_mm=0.01)
    assert held.way == "along" and held.amplitude < threshold
    assert held.unshaken is not None and held.shaken is not None and held.shaken > 0.3 * held.unshaken


@pytest.mark.slow
def test_above_the_threshold_the_plane_shakes_too_but_takes_seconds(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rigid contact whirls by the runout itself: 30 µm, more than three thresholds. In six seconds friction is shaken
    out; in the second that the axial runout takes much of it is left.
    """
    rigid = {"wheel__runout_mm": 0.03, "grinding": {"contact": "rigid", "press_force_N": 1e3}}
    late, threshold = _shaken(**rigid)
    assert late.amplitude > 3 * threshold
    assert late.unshaken is not None and late.shaken is not None and late.shaken < 0.2 * late.unshaken
    monkeypatch.setattr(module, "SECONDS", (1.0, 1.0))
    soon, _ = _shaken(**rigid)
    across, _ = _shaken(**FACE)
    assert soon.shaken is not None and across.shaken is not None
    assert across.shaken < 0.5 * soon.shaken


def test_too_much_of_it_throws_the_balls_off() -> None:
    """The report says so, since the closed threshold does not know it."""
    found, threshold = _shaken(**FACE, wheel__axial_runout_mm=0.3)
    assert found.amplitude > 20 * threshold
    assert found.unshaken is not None and found.shaken is not None and found.shaken > found.unshaken


def test_without_friction_nothing_is_asked() -> None:
    design = size(machine(**FACE, autobalancer__rolling_friction_mm=0.0))
    side = Side(fitted(design, 0j))
    assert shaken(Work(design, side, side, side, design.idle, design.idle, None, 0.0)) is None
