"""Effects as text: those of the model, and the list of effects of a scene."""

from collections.abc import Sequence

from abu_calc.features.effects.study import EffectsResult, KnownEffectsResult
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.parts import notices, of_scene, provenance_blocks
from abu_calc.reporting.screen import shortened
from abu_calc.simulation.records import EffectEntry

WEIGHTS = (
    "A weight is an estimate of what leaving the effect out would change, counted as --accuracy counts errors: axis "
    "amplitude relative to the larger of itself and 1 % of that without balls, settling time relative, ball angles in "
    "rad. The lightest effects are left out as long as they weigh no more together than half the accuracy; an effect "
    "without an estimate is simulated."
)


def known_blocks(result: KnownEffectsResult) -> tuple[Block, ...]:
    """All effects as a table."""
    rows = tuple((each.name, each.kind, each.about) for each in result.effects)
    note = (
        "In a scene file an effect is on when its table is there, [scene.effects.NAME]; in a machine file its numbers "
        "stand with the machine. `abu effects FILE` tells which are simulated. "
        "`abu explain ball_contact` states the rule of impacts."
    )
    return (Heading(result.title), Grid(("effect", "kind", "what it is"), rows), Paragraph(note))


def effects_grid(entries: Sequence[EffectEntry]) -> Grid:
    """The ledger as a table."""
    rows = tuple(
        (entry.name, "in" if entry.included else "out", "?" if entry.weight is None else number(entry.weight, 2),
         entry.why)
        for entry in entries
    )  # fmt: skip
    return Grid(("effect", "", "weight", "why"), rows, frozenset({2}))


def effects_blocks(result: EffectsResult) -> tuple[Block, ...]:
    """The ledger of a scene with its rule."""
    return (
        Heading(f"{result.title}: effects{of_scene(result.scene)} at accuracy {result.accuracy:g}"),
        *_ledger(result),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def effects_screen(result: EffectsResult) -> tuple[Block, ...]:
    """The ledger on one screen."""
    return shortened(result, effects_blocks(result), "weights", head=1)


def _ledger(result: EffectsResult) -> list[Block]:
    if not result.effects:
        return [Paragraph("The file has data for none.")]
    together = f"Left out, all together: {number(result.promise, 2)} of {result.accuracy:g}."
    return [effects_grid(result.effects), Paragraph(together), Heading("Weights", "weights"), Paragraph(WEIGHTS)]
