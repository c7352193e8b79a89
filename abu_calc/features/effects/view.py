"""Effects as text: those of the model, and the list of effects of a scene."""

from collections.abc import Sequence
from typing import Final

from abu_calc.features.effects.study import EffectsResult, KnownEffectsResult
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.parts import notices, of_scene, provenance_blocks
from abu_calc.reporting.screen import many, shortened
from abu_calc.simulation.effect_selection import EffectEntry

INFLUENCE: Final = (
    "The estimated influence says how much the result would change without the effect, in the measure of --accuracy. "
    "That is the largest of three: relative change of the spindle displacement, relative change of the times, "
    "change of a ball angle in rad. The displacement counts relative to 1 % of that without balls if it is smaller. "
    "The weakest effects are left out while their influences together stay below half the accuracy. An effect "
    "without an estimate is simulated."
)


def known_blocks(result: KnownEffectsResult) -> tuple[Block, ...]:
    """All effects as a table."""
    rows = tuple((each.name, each.kind, each.about) for each in result.effects)
    note = (
        "A scene file switches an effect on by its table, [scene.effects.NAME]. A machine file has its numbers in the "
        "tables of the machine. `abu effects FILE` lists which are simulated, and why. `abu explain ball_contact` "
        "gives the rule of impacts."
    )
    return (Heading(result.title), Grid(("effect", "kind", "meaning"), rows), Paragraph(note))


def effects_grid(entries: Sequence[EffectEntry]) -> Grid:
    """List of effects as a table."""
    rows = tuple(
        (entry.name, "yes" if entry.included else "no", "?" if entry.weight is None else number(entry.weight, 2),
         entry.why)
        for entry in entries
    )  # fmt: skip
    return Grid(("effect", "simulated", "influence / accuracy", "because"), rows, frozenset({2}))


def effects_blocks(result: EffectsResult) -> tuple[Block, ...]:
    """List of effects of a scene with its rule."""
    return (
        Heading(f"{result.title}: effects{of_scene(result.scene)} at accuracy {result.accuracy:g}"),
        *_list(result),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def effects_screen(result: EffectsResult) -> tuple[Block, ...]:
    """List of effects on one screen."""
    return shortened(result, effects_blocks(result), "weights", head=1)


def _list(result: EffectsResult) -> list[Block]:
    if not result.effects:
        return [Paragraph("The file has data for no effect.")]
    left_out = [entry for entry in result.effects if not entry.included]
    together = "No effect is left out."
    if left_out:
        together = (
            f"Left out: {many(len(left_out), 'effect')}, estimated influence together {number(result.promise, 2)} "
            f"(accuracy {result.accuracy:g}). `abu simulate` checks that by one run with all effects."
        )
    return [
        effects_grid(result.effects),
        Paragraph(together),
        Heading("Estimated influence", "weights"),
        Paragraph(INFLUENCE),
    ]
