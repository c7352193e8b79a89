"""Effects of the model; of a scene those that are simulated, their estimated influence, and the reasons.

Effects as text: those of the model, and the list of effects of a scene.
"""

from collections.abc import Sequence
from typing import Annotated, ClassVar, Final

from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.foundation.checks import Status
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.parts import notices, of_scene, provenance_blocks
from abu_calc.reporting.screen import many, shortened
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.records import SceneModel
from abu_calc.simulation.result import Provenance, Result
from abu_calc.simulation.simulate import ACCURACY
from abu_calc.simulation.subject import EffectEntry, Source, subject_of


@record
class KnownEffect(Record):
    """An effect this version knows."""

    name: Annotated[str, Quantity("effect")]
    kind: Annotated[str, Quantity("kind", "", 4, "conservative, dissipative or driven")]
    about: Annotated[str, Quantity("what it is")]
    table: Annotated[str, Quantity("table of a scene file")]


@record
class KnownEffectsResult(Result):
    """All effects there are."""

    command: ClassVar[str] = "effects"

    effects: tuple[KnownEffect, ...]

    @property
    def status(self) -> Status:
        """A list cannot fail."""
        return "pass"


@record
class EffectsResult(Result):
    """The effects a scene has data for."""

    command: ClassVar[str] = "effects"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"promise"}

    model: SceneModel
    scene: Annotated[str, Quantity("scene")]
    accuracy: Annotated[float, Quantity("accuracy asked for", "", 2)]
    effects: tuple[EffectEntry, ...]
    promise: Annotated[float, Quantity("estimated influence of all that is left out", "", 2)]

    @property
    def status(self) -> Status:
        """A list cannot fail."""
        return "pass"


def known_effects() -> KnownEffectsResult:
    """Every effect, in the order in which scenes hold them."""
    return KnownEffectsResult(
        title="Effects",
        provenance=Provenance.today(),
        effects=tuple(
            KnownEffect(name=name, kind=kind.kind, about=kind.about, table=kind.table or f"scene.effects.{name}")
            for name, kind in REGISTRY
        ),
    )


@checked
def effects(
    source: Source,
    scene: str | None = None,
    *,
    accuracy: float = 0.01,
    with_effects: Sequence[str] = (),
    without_effects: Sequence[str] = (),
) -> EffectsResult:
    """Effects of a scene that `simulate` includes at an accuracy, with the reasons. Raises InputError."""
    ACCURACY.check(accuracy)
    subject = subject_of(source, scene, command="effects")
    ledger = subject.ledger(accuracy, with_effects, without_effects)
    return EffectsResult(
        title=subject.title,
        warnings=subject.warnings,
        provenance=subject.provenance,
        model=SceneModel.of(ledger.scene),
        scene=ledger.scene.name,
        accuracy=accuracy,
        effects=ledger.entries,
        promise=ledger.promise,
    )


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
