"""Choice of the effects to simulate: those whose absence would be seen at the requested accuracy."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from abu_calc.analysis.simulate import ACCURACY
from abu_calc.dynamics.effect import Weight
from abu_calc.dynamics.scene import Scene
from abu_calc.frozen import dataclass

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


def _light(weights: dict[str, Weight], accuracy: float) -> frozenset[str]:
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


def _why(weight: Weight, light: bool) -> str:
    if weight.value is None:
        return f"not estimated, so in; {weight.why}"
    return f"{'below' if light else 'above'} what the accuracy lets pass; {weight.why}"
