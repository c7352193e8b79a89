"""What the effects have to say of a run, once each."""

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.trajectory import Array, Samples


class Remarks:
    """A reader of a run's samples at the times that results need; `texts` in the order of the effects.

    Further samples change no result, and a million of them would take an effect minutes.
    """

    def __init__(self, equations: Equations, needed: Array) -> None:
        self.equations, self.needed = equations, needed
        self.found: list[tuple[str, ...]] = [() for _ in equations.scene.effects]

    def __call__(self, samples: Samples) -> None:
        """Ask the effects that have had no remark yet."""
        first = np.searchsorted(self.needed, samples.t[0])
        here = self.needed[first : np.searchsorted(self.needed, samples.t[-1], side="right")]
        if len(here) < len(samples.t):
            samples = Samples(here, samples.at(here))
        for index, effect in enumerate(self.equations.scene.effects):
            self.found[index] = self.found[index] or effect.remarks(self.equations, samples)

    @property
    def texts(self) -> tuple[str, ...]:
        """Of all effects."""
        return tuple(text for texts in self.found for text in texts)
