"""Effects as a result and as text: those there are, and the ledger of a scene."""

import inspect
from collections.abc import Sequence
from typing import Any

from abu_calc.analysis.ledger import Entry, Ledger
from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.common import of_scene
from abu_calc.report.numbers import number
from abu_calc.report.outcome import finite

WEIGHTS = (
    "A weight is an estimate of what leaving the effect out would change, counted as --accuracy counts errors: axis "
    "amplitude relative to the larger of itself and 1 % of that without balls, settling time relative, ball angles in "
    "rad. The lightest effects are left out as long as they weigh no more together than half the accuracy; an effect "
    "without an estimate is simulated."
)


def known_effects() -> list[dict[str, Any]]:
    """Name, kind and what it is, of every effect."""
    return [{"name": name, "kind": kind.kind, "about": _about(kind), "table": f"scene.effects.{name}"}
            for name, kind in REGISTRY]  # fmt: skip


def _about(kind: type) -> str:
    """The first sentence of the effect's own file."""
    module = inspect.getmodule(kind)
    text = " ".join((module.__doc__ if module and module.__doc__ else kind.__doc__ or "").split("\n\n")[0].split())
    return text.rstrip(".:")


def known_blocks() -> tuple[Block, ...]:
    """All effects as a table."""
    rows = tuple((each["name"], each["kind"], each["about"]) for each in known_effects())
    told = (
        "In a scene file an effect is on when its table is there, [scene.effects.NAME]; in a machine file its numbers "
        "stand with the machine. `abu effects FILE` tells which are simulated."
    )
    return (Heading("Effects"), Grid(("effect", "kind", "what it is"), rows), Paragraph(told))


def ledger_result(entries: Sequence[Entry]) -> list[dict[str, Any]]:
    """The ledger under the keys of the interface."""
    return [
        {"name": entry.name, "included": entry.included, "weight": finite(entry.weight), "why": entry.why}
        for entry in entries
    ]


def ledger_grid(entries: Sequence[dict[str, Any]]) -> Grid:
    """The ledger as a table."""
    rows = tuple(
        (entry["name"], "in" if entry["included"] else "out",
         "?" if entry["weight"] is None else number(entry["weight"], 2), entry["why"])
        for entry in entries
    )  # fmt: skip
    return Grid(("effect", "", "weight", "why"), rows, frozenset({2}))


def ledger_blocks(title: str, ledger: Ledger, accuracy: float) -> tuple[Block, ...]:
    """The ledger of a scene with its rule."""
    head = Heading(f"{title}: effects{of_scene(ledger.scene.name)} at accuracy {accuracy:g}")
    if not ledger.entries:
        return (head, Paragraph("The file has data for none."))
    told = f"Left out, all together: {number(ledger.promise, 2)} of {accuracy:g}."
    return (head, ledger_grid(ledger_result(ledger.entries)), Paragraph(told), Heading("Weights"), Paragraph(WEIGHTS))
