"""The report of `abu grinding`: balls, contact, friction and wear in sentences with their numbers."""

from dataclasses import replace

import pytest

from abu_calc.features.grinding.study import GrindingResult
from abu_calc.features.grinding.view import (
    _row,
    balls_blocks,
    contact_blocks,
    friction_blocks,
    grinding_screen,
    numbers_that_matter,
    wear_blocks,
)
from abu_calc.reporting.blocks import Block
from abu_calc.reporting.screen import as_text
from tests.features.grinding.test_command import STRAIGHT, worked


def said(blocks: list[Block]) -> str:
    return " ".join(as_text(tuple(blocks), 80).split())


@pytest.fixture(scope="module")
def golden() -> GrindingResult:
    return worked(STRAIGHT, "golden")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("stiffness", "bounds", "part"),
    [
        (4.9e5, (1e6, 2e6), "4.9e5 N/m, below 1e6 N/m: the balls balance, and wear reduces the runout"),
        (1.5e6, (1e6, 2e6), "1.5e6 N/m, between 1e6 and 2e6 N/m: the balls add to the imbalance"),
        (3e6, (1e6, 2e6), "3e6 N/m, above 2e6 N/m: the balls balance, and wear increases the runout"),
        (None, (1e6, 2e6), "Rigid, above 2e6 N/m"),
        (4.9e5, (-1.0, 2e6), "too stiff for balls to balance on any contact below 2e6 N/m"),
        (4.9e5, (-2.0, -1.0), "too stiff for balls to balance on any contact that is not rigid"),
    ],
)
def test_the_contact_is_placed_among_its_regions(
    golden: GrindingResult, stiffness: float | None, bounds: tuple[float, float], part: str
) -> None:
    model = replace(golden.model, contact_stiffness_N_per_m=stiffness)
    assert part in said(contact_blocks(replace(golden, model=model, contact_stiffness_regions=bounds)))


@pytest.mark.slow
def test_balls_are_told_with_their_places(golden: GrindingResult) -> None:
    here = replace(golden, ball_resultant=1e-4, ball_angles_deg=(10.0, -20.0), printed=None)
    assert "The balls balance: 100.0 g·mm, at 10.00°, -20.00° from the imbalance." in said(balls_blocks(here))
    three = replace(here, ball_angles_deg=(10.0, -20.0, 90.0))
    assert "one of many arrangements" in said(balls_blocks(three))
    lost = replace(here, balls="turning", ball_angles_deg=None)
    assert "The balls come to no rest." in said(balls_blocks(lost))


@pytest.mark.slow
def test_friction_that_is_none_is_told_as_none(golden: GrindingResult) -> None:
    smooth = replace(golden.friction, threshold=0.0)
    assert said(friction_blocks(replace(golden, friction=smooth))).endswith("None.")
    thrown = replace(golden.friction, unshaken=1e-6, shaken=9e-6)
    assert "That runout moves the balls away from their places." in said(
        friction_blocks(replace(golden, friction=thrown))
    )


def test_wear_tells_what_comes_first() -> None:
    """The golden wheel is driven off, until after 79.3 µm wheel and work part at 91.9 µm of runout."""
    wear = worked(STRAIGHT, "golden").wear
    assert wear is not None and wear.stages
    row = _row("with", wear)
    assert row[2] == "grows" and row[3].startswith("wheel loses contact after ") and " µm, at " in row[3]
    timed = replace(wear, ends="halved", depth=2.5e-3, time=30.0, centres=True, runout_rate=-0.1)
    assert _row("with", timed) == ("with", "-0.10", "falls", "runout halved after 2.50 mm (30 s)")
    assert _row("with", replace(wear, depth=0.0))[3] == "wheel loses contact already"
    assert wear_blocks(worked("avtovaz-707-370")) == []


def test_levels_stand_in_the_table_and_the_verdict_on_top(golden: GrindingResult) -> None:
    rows = {row[0]: row[1:] for row in numbers_that_matter(golden).rows}
    assert rows["level, pressed after settling"] == (
        f"{golden.level_before_db:.1f} dB",
        "",
        f"{golden.level_after_db:.1f} dB",
    )
    assert rows["normal force 400 N ±"][2].startswith(f"{golden.reaction.amplitude_N:.0f}"[:2])
    text = as_text(grinding_screen(replace(golden, level_after_db=None)), 80)
    assert "not known" in text and golden.verdict.split()[0] in text.splitlines()[2]
