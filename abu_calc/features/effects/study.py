"""Effects of the model; of a scene those that are simulated, their estimated influence, and the reasons."""

from collections.abc import Sequence
from typing import Annotated, ClassVar

from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.foundation.checks import Status
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.effect_selection import EffectEntry
from abu_calc.simulation.records import SceneModel
from abu_calc.simulation.result import Provenance, Result
from abu_calc.simulation.simulate import ACCURACY
from abu_calc.simulation.subject import Source, subject_of


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
