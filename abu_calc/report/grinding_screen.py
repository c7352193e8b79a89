"""The report of `abu grinding` on one screen."""

from abu_calc.report.blocks import Block
from abu_calc.report.grinding import grinding_blocks
from abu_calc.report.screen import shortened
from abu_calc.studies.grinding import GrindingResult

LEFT_OUT = (
    "Simulated with the autobalancer",
    "Pressed before the balls have settled",
    "Without",
    "Contact alone, simulated against the closed form: relative differences",
    "Axis against the angle from imbalance to runout",
    "Over the speeds",
    "Force round the wheel, from its imbalance",
    "The source's claim",
    "Course of wear without autobalancer",
    "Course of wear with it",
    "Model",
)


def grinding_screen(result: GrindingResult) -> tuple[Block, ...]:
    """Verdict, numbers that matter, balls, contact, wear, friction; curves are left to the whole report."""
    return shortened(result, grinding_blocks(result), *LEFT_OUT, head=3)
