"""What the effects have to say of a run, once each."""

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.trajectory import Samples


class Remarks:
    """A reader of a run's samples; `texts` in the order of the effects."""

    def __init__(self, equations: Equations) -> None:
        self.equations = equations
        self.found: list[tuple[str, ...]] = [() for _ in equations.scene.effects]

    def __call__(self, samples: Samples) -> None:
        """Ask those effects that have said nothing yet."""
        for index, effect in enumerate(self.equations.scene.effects):
            self.found[index] = self.found[index] or effect.remarks(self.equations, samples)

    @property
    def texts(self) -> tuple[str, ...]:
        """Of all effects."""
        return tuple(text for texts in self.found for text in texts)
