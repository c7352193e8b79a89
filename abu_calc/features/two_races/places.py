"""Search of the races' places within the stretches of the spindle that the file allows.

Races off by Δ leave a place p of the spindle at most Δ·(|p − z₁| + |p − z₂|)/|z₁ − z₂| off: Δ between both races, more
outside. Of the pairs that leave the loudest place least, the one with the smallest required capacity is chosen.
"""

from collections.abc import Callable, Iterator, Sequence
from itertools import product
from typing import Final

from abu_calc.formulas.two_races import ONE_PLANE, Pair

STEPS: Final = 40
"""Steps from one end of a stretch to the other."""
LEAST_APART: Final = 1e-3
"""Least distance [m] of both races."""
ALIKE: Final = 1e-6
"""Relative difference below which two pairs leave as much."""
Stretch = Pair | None


def arms(places: Sequence[float], races: Pair) -> float:
    """Largest displacement of the places [m] per eccentricity of both races, worst directions.

    >>> round(arms((0.2, -0.2), (0.3, -0.3)), 9), round(arms((0.6,), (0.3, -0.3)), 9)
    (1.0, 2.0)
    """
    first, second = races
    return max((abs(place - first) + abs(place - second)) / abs(first - second) for place in places)


def best_races(
    given: Pair, stretches: tuple[Stretch, Stretch], places: Sequence[float], needs: Callable[[Pair], Pair]
) -> Pair:
    """Places [m] of both races: within their stretches, or as given. `needs`: required capacities [kg m] of a pair."""
    if stretches == (None, None):
        return given

    def rank(races: Pair) -> tuple[float, float, float]:
        """Least displacement of the loudest place, then the least capacity of the larger race, then of both."""
        capacities = needs(races)
        return round(arms(places or races, races) / ALIKE) * ALIKE, max(capacities), sum(capacities)

    return min(_pairs(given, stretches), key=rank)


def _pairs(given: Pair, stretches: tuple[Stretch, Stretch]) -> Iterator[Pair]:
    """The given pair, and all others on a grid that stand apart."""
    yield given
    first, second = (_on(place, stretch) for place, stretch in zip(given, stretches, strict=True))
    yield from (pair for pair in product(first, second) if abs(pair[0] - pair[1]) > LEAST_APART + ONE_PLANE)


def _on(place: float, stretch: Stretch) -> list[float]:
    if stretch is None:
        return [place]
    low, high = stretch
    return [low + (high - low) * step / STEPS for step in range(STEPS + 1)]
