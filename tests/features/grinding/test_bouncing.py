"""Wheels that bounce on their work without ever repeating: what stays the same from run to run."""

import math
from dataclasses import replace
from typing import Any

import pytest

from abu_calc.features.grinding import simulation as module
from abu_calc.features.grinding import work as grinding
from abu_calc.features.grinding.checks import work_checks
from abu_calc.features.grinding.simulation import WorkSimulation, bounces, bouncing
from abu_calc.features.grinding.verdict import in_words
from abu_calc.features.grinding.work import Side, Work, work_of
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.units import level_from_velocity
from abu_calc.simulation.scene_of_design import scene_of_design
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.sizing.machines import machine


def _stiff(**grinding: Any) -> Design:
    """Pressed by 45 N to a contact of 1e6 N/m, which its runout of 0.09 mm leaves each turn."""
    pressed = {"contact_stiffness_N_per_m": 1e6, "press_force_N": 45.0, **grinding}
    return size(machine(wheel__runout_mm=0.09, grinding=pressed))


@pytest.mark.slow
def test_starts_that_have_nothing_in_common_come_to_the_same_level() -> None:
    """Balls bunched on the heavy side, or where they balance: each level is within what is promised of the other's."""
    design = _stiff()
    found = [bouncing(scene_of_design(design, "grinding", start), 0.01) for start in ("settled", "bunched")]
    levels = [level_from_velocity(one.velocity) for one in found]
    assert 0.2 < max(one.scatter for one in found) < 2.5
    assert abs(levels[0] - levels[1]) < sum(one.scatter for one in found)
    assert all(one.parts and 0.6 < one.apart < 0.8 for one in found)
    # What the work gives back on average is the press: the machine does not move away.
    assert [one.force.mean() for one in found] == pytest.approx([45.0] * 2, rel=0.02)


@pytest.mark.slow
def test_the_same_machine_gives_the_same_number() -> None:
    scene = scene_of_design(_stiff(), "grinding", "settled")
    assert bouncing(scene, 0.01).velocity == bouncing(scene, 0.01).velocity


@pytest.mark.slow
def test_runs_too_far_apart_give_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "WIDEST", 0.01)
    with pytest.raises(NotTrustworthyError, match=r"hangs on the start: \d+\.\d to \d+\.\d dB"):
        bouncing(scene_of_design(_stiff(), "grinding"), 0.01)


def test_only_a_contact_that_parts_bounces() -> None:
    design = _stiff()
    assert bounces(scene_of_design(design, "grinding"))
    assert not bounces(scene_of_design(design, "idle"))
    rigid = scene_of_design(size(machine(wheel__runout_mm=0.09, grinding={"contact": "rigid"})), "grinding")
    assert not bounces(rigid)


@pytest.fixture(scope="module")
def work() -> Work:
    """What is chaotic fails after seconds of trying: here at once."""

    def fails(*_: Any) -> WorkSimulation:
        raise NotTrustworthyError("chaotic")

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(grinding, "working", fails)
        found = work_of(_stiff(), 0.01)
    assert isinstance(found, Work)
    return found


@pytest.mark.slow
def test_a_chaotic_machine_has_a_level_and_says_how_well_it_is_known(work: Work) -> None:
    assert work.fitted.scatter > 0 and work.fitted.failure is None
    assert work.levels.after is not None and work.levels.before is not None
    assert work.lowered is False  # 122 dB against 118: more than runs scatter
    words = in_words(work, ())
    assert f"{work.levels.after:.1f} ± {work.fitted.scatter:.1f} dB with it" in words
    check = next(one for one in work_checks(work, None, None) if one.code == "ABU421")
    assert check.status == "fail" and "bouncing is chaotic" in check.message


@pytest.mark.slow
def test_levels_that_scatter_over_each_other_are_not_told_apart(work: Work) -> None:
    def louder(side: Side, decibels: float) -> Side:
        run: WorkSimulation | None = side.run
        assert run is not None
        return replace(side, run=replace(run, scatter=decibels))

    assert work.levels.after is not None and work.levels.before is not None
    apart = abs(work.levels.after - work.levels.before) - work.without.scatter
    for scatter, known in ((0.9 * apart, False), (1.1 * apart, None)):
        doubtful = replace(work, fitted=louder(work.fitted, scatter))
        assert doubtful.lowered is known
    check = next(one for one in work_checks(doubtful, None, None) if one.code == "ABU421")
    assert check.status == "not-done" and check.value is not None and math.isfinite(check.value)
    assert "differ by less than runs of chaotic bouncing" in in_words(doubtful, ())
