"""The report of `abu stability` on one screen."""

from abu_calc.report.arm import BOUNDS
from abu_calc.report.blocks import Block, Heading, Paragraph
from abu_calc.report.screen import shortened
from abu_calc.report.stability import CHANGES, hanging_word, stability_blocks
from abu_calc.studies.stability import StabilityResult

LEFT_OUT = ("Eigenvalues, 1/s", "Floquet multipliers of one revolution")
FOR_THE_ARM = (BOUNDS, "Beside the balanced state", "Model")
"""Sections that make room for those of a swing arm."""


def stability_screen(result: StabilityResult) -> tuple[Block, ...]:
    """One screen: the whole report without the eigenvalues; their largest real part is the growth rate."""
    asked = result.boundaries_rpm is not None
    more: tuple[str, ...] = () if asked else ("--speeds LOW:HIGH, where stability changes",)
    blocks = stability_blocks(result)
    if result.arm_motion is None:
        return shortened(result, blocks, *LEFT_OUT, head=3 if result.arm_advice or result.consequence else 2, more=more)
    if result.swing_arm:
        more = (*more, "`abu size`, the bounds of the arm")
    if result.hanging:
        first = next(k for k, block in enumerate(blocks) if k and isinstance(block, Heading))
        blocks = (*blocks[:first], Paragraph(hanging_word(result.hanging)), *blocks[first:])
    left_out = FOR_THE_ARM if asked else (*FOR_THE_ARM, CHANGES)
    return shortened(result, blocks, *LEFT_OUT, *left_out, head=3, more=more)
