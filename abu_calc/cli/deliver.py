"""Delivery of a command's outcome, or its error, to people and programs."""

import os
import sys
from pathlib import Path
from typing import NamedTuple

from abu_calc.errors import AbuError
from abu_calc.escapes import escaped, escaped_lines, shortened
from abu_calc.interruption import EndedBySignal, status_of
from abu_calc.report.outcome import Outcome, document, error_document, to_json

BUG = 3


class Delivery(NamedTuple):
    """Requested delivery of an outcome: the options that all commands share."""

    json: bool = False
    output: Path | None = None
    force: bool = False
    quiet: bool = False
    color: bool = True
    full: bool = False
    figures: tuple[tuple[str, Path], ...] = ()

    def check(self, command: str, drawn: tuple[str, ...] = ()) -> None:
        """Refuse before computing what could not be written after; `drawn`: formats of the command's drawing."""
        if self.figures:
            from abu_calc.cli.figures import check_figures

            check_figures(command, self.figures, self.output, force=self.force)
        if self.output is not None:
            from abu_calc.report.files import FORMATS, check_extra
            from abu_calc.report.write import check_target

            check_target(self.output, force=self.force, suffixes=(*FORMATS, *drawn), option="--output")
            check_extra(self.output.suffix.lower())


def deliver(outcome: Outcome, how: Delivery, *, wrote: bool = False) -> int:
    """Print the result, return the exit status; `wrote`: files were written, as who interrupts is told."""
    try:
        _print(outcome, how)
    except (KeyboardInterrupt, EndedBySignal) as ended:
        if not wrote:
            raise
        print("Interrupted; the files were written.", file=sys.stderr)
        sys.exit(status_of(ended))
    return outcome.exit_status


def _print(outcome: Outcome, how: Delivery) -> None:
    """Print an outcome on standard output; if that is for programs, warnings go to standard error."""
    if how.json:
        print(to_json(document(outcome)))
        for warning in () if how.quiet else outcome.warnings:
            print(f"warning: {escaped(warning)}", file=sys.stderr)
    elif how.quiet:
        pass
    elif outcome.plain is not None:
        print(outcome.plain, end="")
    else:
        from abu_calc.report.text import show

        shown = outcome.blocks if how.full else outcome.screen
        show(shown, color=how.color and not os.environ.get("NO_COLOR"))


def fail(command: str, error: BaseException, as_json: bool) -> int:
    """Tell an error: a line or two on standard error, the envelope on standard output if JSON was asked for."""
    if as_json:
        print(to_json(error_document(command, error)))
    head = " ".join(part for part in ("abu", shortened(escaped(command))) if part)
    if isinstance(error, AbuError):
        print(f"{head}: {escaped_lines(str(error))}", file=sys.stderr)
        return error.exit_status
    print(
        f"{head}: this is a bug in abu-calc: {type(error).__name__}: {shortened(escaped(str(error)))}\n"
        "  Set ABU_DEBUG=1 to see where, and report it with your file.",
        file=sys.stderr,
    )
    return BUG
