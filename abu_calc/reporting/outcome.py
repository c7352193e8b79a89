"""Return value of a command, and the one JSON document it becomes."""

import math
from collections.abc import Callable
from dataclasses import asdict
from functools import cached_property
from typing import TYPE_CHECKING, Any

from abu_calc.foundation.checks import Check, Status
from abu_calc.foundation.errors import AbuError, InputError
from abu_calc.foundation.frozen import dataclass
from abu_calc.reporting.blocks import Block

if TYPE_CHECKING:
    from abu_calc.reporting.charts.figure import MakesExtras
    from abu_calc.reporting.drawings.shapes import Drawing
    from abu_calc.reporting.solids.assembly import SolidAssembly
    from abu_calc.reporting.write import Target
    from abu_calc.simulation.result import Provenance, Result

SCHEMA = 1
EXIT_STATUS: dict[Status, int] = {"pass": 0, "fail": 1, "not-done": 1}


@dataclass(frozen=True)
class Outcome:
    """The frozen result of a command: numbers in user units, checks, and how they are shown."""

    command: str
    content: "Result | dict[str, Any]"
    """The typed result of a study, or what a command without a study answers."""
    view: tuple[Block, ...] | Callable[[], tuple[Block, ...]]
    """Blocks, or what makes them where text is wanted."""
    notes: tuple[str, ...] = ()
    """Warnings of a command without a study."""
    short: Callable[[], tuple[Block, ...]] | None = None
    """The one screen that stands in a terminal for blocks that take more."""
    drawings: "Callable[[], tuple[Drawing, ...]] | None" = None
    """Function that makes the sheets of a drawing; None if the command has none."""
    solids: "Callable[[], SolidAssembly] | None" = None
    """Function that makes the parts as solids; None if the command has none."""
    extras: "MakesExtras | None" = None
    """Function that makes the figures and the calculation note of a page; None if the command has none."""
    settings: tuple[tuple[str, str], ...] = ()
    """The command with its arguments and options, each with its value; files that it writes are left out."""
    plain: str | None = None
    """Text that stands for itself (a file, a schema): printed and written as it is, instead of the blocks."""
    plain_suffix: str = ".json"
    """The ending of files that hold such a text."""
    further: tuple["Target", ...] = ()
    """Files that were asked for beside the result's own."""

    @cached_property
    def result(self) -> Any:
        """The result as the JSON document has it."""
        return self.content if isinstance(self.content, dict) else self.content.to_dict()

    @cached_property
    def provenance(self) -> "Provenance":
        """Provenance of the result; of this day if it stands on no file."""
        return _today() if isinstance(self.content, dict) else self.content.provenance

    @property
    def checks(self) -> tuple[Check, ...]:
        """Checks of the result."""
        return () if isinstance(self.content, dict) else self.content.checks

    @property
    def model(self) -> dict[str, Any]:
        """SI numbers behind the result."""
        return {} if isinstance(self.content, dict) else self.content.model.to_dict()

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings of the result."""
        return self.notes if isinstance(self.content, dict) else self.content.warnings

    @property
    def status(self) -> Status:
        """The worst of the checks; a command without a study passes."""
        return "pass" if isinstance(self.content, dict) else self.content.status

    @property
    def blocks(self) -> tuple[Block, ...]:
        """The whole report."""
        return self.view() if callable(self.view) else self.view

    @property
    def screen(self) -> tuple[Block, ...]:
        """The report on one screen; the whole one where that is short anyway."""
        return self.short() if self.short else self.blocks

    @property
    def exit_status(self) -> int:
        """0 when every check passed, else 1."""
        return EXIT_STATUS[self.status]


def document(outcome: Outcome) -> dict[str, Any]:
    """The envelope of a result."""
    return {
        "abu": _head(outcome.command, outcome.provenance),
        "input": outcome.provenance.input,
        "status": outcome.status,
        "checks": [asdict(check) | {"change": _change(check.overrides)} for check in outcome.checks],
        "result": outcome.result,
        "model": outcome.model,
        "warnings": list(outcome.warnings),
    }


def _change(entries: tuple[str, ...]) -> dict[str, object] | None:
    """Everything that an action replaces, by key path; None where it replaces nothing."""
    from abu_calc.inputs.reading.overrides import parse_override

    return {override.key: override.value for override in map(parse_override, entries)} if entries else None


def error_document(command: str, error: BaseException) -> dict[str, Any]:
    """The envelope of an error."""
    facts: dict[str, Any] = {"kind": error.kind if isinstance(error, AbuError) else "bug", "message": str(error)}
    if isinstance(error, InputError):
        facts |= {
            "message": error.message,
            "file": error.place.file,
            "line": error.place.line,
            "key": error.place.key,
            "found": error.found,
            "allowed": error.allowed,
            "remedy": error.remedy,
        }
    return {"abu": _head(command, _today()), "input": None, "status": "not-done", "checks": [],
            "result": None, "model": {}, "warnings": [], "error": facts}  # fmt: skip


def _today() -> "Provenance":
    from abu_calc.simulation.result import Provenance

    return Provenance.today()


def _head(command: str, provenance: "Provenance") -> dict[str, Any]:
    return {"version": provenance.version, "command": command, "schema": SCHEMA, "date": provenance.date}


def to_json(content: dict[str, Any]) -> str:
    """One JSON document; refuses NaN and infinities, which no result may hold; ASCII, so every console can take it."""
    import json

    return json.dumps(content, allow_nan=False, indent=2)


def finite(value: float | None) -> float | None:
    """A number for JSON: null where it is not finite."""
    return value if value is not None and math.isfinite(value) else None
