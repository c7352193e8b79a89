"""Choice of the effects to simulate: those whose absence would be seen at the requested accuracy.

`audit` simulates the same scene once more with every effect in, and gives the true difference.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from abu_calc.dynamics.effect import EffectInfluence
from abu_calc.dynamics.scene import Scene
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent
from abu_calc.simulation.nonconvergence import difference
from abu_calc.simulation.simulate import ACCURACY, Simulation, simulate, usual_work

SHARE: Final = 0.5
"""Share of the accuracy that all omitted effects together may use.

The rest is for the errors of integration.
"""


@dataclass(frozen=True)
class Entry:
    """One effect: whether it is in, what leaving it out changes, counted as accuracy counts errors, and why so."""

    name: str
    included: bool
    weight: float | None
    why: str


@dataclass(frozen=True)
class Ledger:
    """The scene to simulate, and what stands for each effect there is data for; `promise`: weight of what is out.

    `spared`: what those left out for being light may take of the accuracy, so that the rest is for the integration.
    """

    scene: Scene
    entries: tuple[Entry, ...]
    spared: float = 0.0

    @property
    def promise(self) -> float:
        """Largest expected influence of the omitted effects, as far as it is known."""
        return sum((entry.weight or 0.0) for entry in self.entries if not entry.included)


def chosen(
    full: Scene,
    accuracy: float,
    wanted: Sequence[str] = (),
    unwanted: Sequence[str] = (),
) -> Ledger:
    """The scene with the effects it calls for, out of one that has all there is data for.

    The lightest are left out as long as they weigh no more together than half the accuracy; an effect of unknown weight
    is in. `wanted` and `unwanted` are asked for by name.
    """
    weights = {effect.name: effect.weight(full) for effect in full.effects}
    out = _light(weights, accuracy)
    entries = tuple(
        Entry(name, name in wanted or (name not in out and name not in unwanted), weight.value,
              f"asked for; {weight.why}" if name in wanted
              else f"left out by request; {weight.why}" if name in unwanted
              else _why(weight, name in out))
        for name, weight in weights.items()
    )  # fmt: skip
    included = {entry.name for entry in entries if entry.included}
    scene = replace(full, effects=tuple(effect for effect in full.effects if effect.name in included))
    spared = sum(weights[name].value or 0.0 for name in out.difference(wanted, unwanted))
    return Ledger(scene, entries, spared)


def _light(weights: dict[str, EffectInfluence], accuracy: float) -> frozenset[str]:
    """The lightest effects that weigh no more together than their share of the accuracy."""
    known = [(weight.value, name) for name, weight in weights.items() if weight.value is not None]
    share = min(SHARE * accuracy, accuracy - ACCURACY.low)
    out, total = set(), 0.0
    for value, name in sorted(known):
        total += value
        if total > share:
            break
        out.add(name)
    return frozenset(out)


def _why(weight: EffectInfluence, light: bool) -> str:
    if weight.value is None:
        return f"not estimated, so simulated: {weight.why}"
    return f"{'within' if light else 'beyond'} the accuracy: {weight.why}"


@dataclass(frozen=True)
class EffectAudit:
    """The true difference, counted as accuracy counts errors, beside what the weights of what was left out promised."""

    difference: float
    promise: float
    effects: tuple[str, ...]
    """Effects added to the scene for the audit."""
    evaluations: int
    wall_s: float


def audit(
    full: Scene, ledger: Ledger, run: Simulation, accuracy: float, most_evaluations: int | None,
    integrator: str = "auto", progress: Progress = silent,
) -> EffectAudit:  # fmt: skip
    """Simulate the scene with all its effects to the same accuracy, by the work that the run has left.

    Raises NotTrustworthyError as `simulate` does.
    """
    added = tuple(entry.name for entry in ledger.entries if not entry.included)
    if not added:
        return EffectAudit(0.0, 0.0, (), 0, 0.0)
    left = max((most_evaluations or usual_work(full, integrator)) - run.cost.work, 1)
    whole = simulate(full, accuracy, (), left, integrator=integrator, progress=progress)
    return EffectAudit(
        difference=difference(run.scene, run.response, whole.response),
        promise=ledger.promise,
        effects=added,
        evaluations=whole.cost.evaluations,
        wall_s=whole.cost.wall_s,
    )
