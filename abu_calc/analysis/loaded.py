"""Levels under load in `abu size`: those that `abu grinding` finds of the same design."""

from dataclasses import replace

from abu_calc.analysis.grinding import Work, at_work
from abu_calc.analysis.machine import Failure, Run
from abu_calc.analysis.under_load import contact_presses
from abu_calc.errors import NotTrustworthyError
from abu_calc.progress import Progress, silent
from abu_calc.sizing.design import Design
from abu_calc.sizing.vibration import Loaded, handle_levels


def work_of(
    design: Design, accuracy: float, progress: Progress = silent, hard: Run | Failure | None = None
) -> Work | Failure | None:
    """The machine at its work, see `at_work`; None without a contact that presses in the plane: there it idles."""
    if not contact_presses(design.case):
        return None
    try:
        return at_work(design, accuracy, progress, hard)
    except NotTrustworthyError as error:
        return Failure("at work", str(error).splitlines()[0])


def loaded_levels(design: Design, work: Work | Failure | None) -> Loaded | None:
    """Levels by steady contact and runs: pressed after the balls have settled, and at once."""
    steady = design.loaded
    if steady is None or work is None:
        return steady
    if isinstance(work, Failure):
        return replace(steady, levels=handle_levels(design.case, None, None, design.autobalancer.mass))
    return replace(
        steady, levels=work.settled, hasty=work.hasty, stays=work.stays_loud, parts_before=work.without.parts,
        parts_after=work.fitted.parts,
    )  # fmt: skip
