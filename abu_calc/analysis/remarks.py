"""Remarks of the effects on a run, once each.

Added is what the scene leaves out, whichever effects act in it.
"""

import math
from typing import Final

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Array, Samples

MOST_ASKED: Final = 4000
"""Samples of a run, of those that results need, that are kept for effects that look at all of it: some tenths of a
second. They are drawn by lot, so that no phase of a revolution is left out."""

STEEL: Final = 7800.0
"""Density [kg/m³] by which a ball's mass tells its radius where that is not given."""


class Remarks:
    """A reader of a run's samples at the times that results need; `texts` in the order of the effects.

    Further samples change no result, and a million of them would take an effect minutes.
    """

    def __init__(self, equations: Equations, needed: Array) -> None:
        self.equations, self.needed = equations, needed
        self.found: list[tuple[str, ...]] = [() for _ in equations.scene.effects]
        self.asked = _drawn(needed) if any(effect.whole_run for effect in equations.scene.effects) else needed[:0]
        self.kept: list[Samples] = []

    def __call__(self, samples: Samples) -> None:
        """Ask the effects that have had no remark yet; keep what others are asked of when the run is over."""
        here, asked = _within(self.needed, samples), _within(self.asked, samples)
        if len(asked):
            self.kept.append(Samples(asked, samples.at(asked).copy()))
        if len(here) < len(samples.t):
            samples = Samples(here, samples.at(here))
        for index, effect in enumerate(self.equations.scene.effects):
            if not effect.whole_run:
                self.found[index] = self.found[index] or effect.remarks(self.equations, samples)

    @property
    def texts(self) -> tuple[str, ...]:
        """Remarks of the scene and of all effects."""
        scene, remarks = self.equations.scene, self.found
        if self.kept:
            whole = Samples(np.concatenate([part.t for part in self.kept]), np.hstack([part.y for part in self.kept]))
            rows = zip(scene.effects, remarks, strict=True)
            remarks = [effect.remarks(self.equations, whole) if effect.whole_run else prior for effect, prior in rows]
        return (*without_size(scene), *(text for texts in remarks for text in texts))


def _drawn(times: Array) -> Array:
    """Some of these times, always the same and the last among them; all of a few."""
    if len(times) <= MOST_ASKED:
        return times
    chosen = np.random.default_rng(0).choice(len(times) - 1, MOST_ASKED - 1, replace=False)
    drawn: Array = times[[*np.sort(chosen), -1]]
    return drawn


def _within(times: Array, samples: Samples) -> Array:
    """Return the times that lie within the samples."""
    inside: Array = times[np.searchsorted(times, samples.t[0]) : np.searchsorted(times, samples.t[-1], side="right")]
    return inside


def without_size(scene: Scene) -> tuple[str, ...]:
    """Remark that balls of unknown size are run up without their own spin.

    It gives the share of their lag that this is, (J − 1) r/R_p. A race that speeds up turns the balls that
    roll in it; r is that of steel balls of the same mass.
    """
    balls = scene.balls
    unknown = (balls.sizes == 0) & (balls.factors > 1)
    if not scene.rotor.states or not unknown.any():
        return ()
    radii = np.minimum(np.cbrt(3 * balls.masses / (4 * math.pi * STEEL)), balls.radii)
    shares = np.where(unknown, (balls.factors - 1) * radii / balls.radii, 0.0)
    most, k = float(shares.max()), int(shares.argmax())
    return (
        f"the speed changes, but ball_radius_mm of [[scene.race]] is not given: the spin that the race gives the balls "
        f"is left out, about {most:.0%} of how far they lag while the speed rises (by a steel ball of "
        f"{1000 * balls.masses[k]:.3g} g, r = {1000 * radii[k]:.2g} mm)",
    )
