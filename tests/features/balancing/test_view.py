"""Both planes in characters, as one stands before the roll."""

import math
import re
from dataclasses import replace

import pytest

import abu_calc
from abu_calc.features.balancing.corrections import Share
from abu_calc.features.balancing.solution import PlaneCorrection
from abu_calc.features.balancing.view import balance_blocks, drawing
from abu_calc.reporting.screen import as_text

PRESET = "sapropel-screw-rig"


def plane(angle: float) -> PlaneCorrection:
    at = math.radians(angle)
    return replace(abu_calc.balance(PRESET).left, corrections=(Share(action="remove", mass=1e-3, angle=at),), angle=at)


@pytest.mark.parametrize("angle", [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0])
@pytest.mark.parametrize("sense", ["counterclockwise", "clockwise"])
def test_angles_are_drawn_as_one_stands_before_the_roll(angle: float, sense: str) -> None:
    """The roll turns with the arrows; laid off against them from the mark on top, the sign is where the angle says."""
    side = plane(angle)
    lines = drawing(side, side, sense)
    turn = math.radians(angle)
    from_left = 1.0 if sense == "counterclockwise" else -1.0
    for start, flip in ((2, from_left), (40, -from_left)):
        cells = [line.ljust(80)[start : start + 36] for line in lines[1:]]
        upper = next(row for row in cells if re.search(r"<---|--->", row))
        assert ("<---" in upper) == (flip > 0)  # counterclockwise: the top runs to the left
        bare = [re.sub("<---|--->", "    ", row) for row in cells]
        signs = [(x, y) for y, row in enumerate(bare) for x, letter in enumerate(row) if letter == "-"]
        ((x, y),) = signs
        across, up = (x - 18) / 11 * flip, (6 - y) / 5
        assert across == pytest.approx(math.sin(turn), abs=0.1) and up == pytest.approx(math.cos(turn), abs=0.15)


def test_rounding_has_no_digits_and_the_formula_is_as_published() -> None:
    whole = as_text(balance_blocks(abu_calc.balance(PRESET)))
    assert "differ by less than 0.0001 % of the largest reading" in " ".join(whole.split())
    assert "The published formula" in whole and "printed" not in whole and "take off" not in whole
