"""The report of `abu stability` on one screen."""

from abu_calc.report.blocks import Block
from abu_calc.report.screen import shortened
from abu_calc.report.stability import stability_blocks
from abu_calc.studies.stability import StabilityResult

LEFT_OUT = ("Eigenvalues, 1/s", "Floquet multipliers of one revolution")


def stability_screen(result: StabilityResult) -> tuple[Block, ...]:
    """What the whole report says, but for the eigenvalues; their largest real part is the growth rate."""
    more = () if result.boundaries_rpm is not None else ("--speeds LOW:HIGH, where stability changes",)
    return shortened(result, stability_blocks(result), *LEFT_OUT, more=more)
