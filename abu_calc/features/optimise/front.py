"""Front of cost against share: designs of which none cheaper has a higher share, and runners-up of the best one."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from abu_calc.features.optimise.racing import CandidateRace

ENOUGH: Final = 256
"""Samples of a design on the front."""
LONGEST: Final = 7
"""Designs on the front."""
RUNNERS_UP: Final = 2
FURTHER: Final = 4
"""Designs dearer than the best that are tried for a higher share."""


def front(race: CandidateRace, best: int) -> tuple[int, ...]:
    """Numbers of the candidates on the front by their cost, each with enough samples as far as the budget goes."""
    dearer = [k for k in np.lexsort((-race.means(), race.costs)).tolist() if race.costs[k] > race.costs[best] + 1e-12]
    pool = {k for k in range(len(race.costs)) if race.costs[k] <= race.costs[best] + 1e-12 and _sampled(race, k)}
    for k in (best, *dearer[:FURTHER]) if race.shares()[best] < 1 else (best,):
        _to_enough(race, k)
        pool.add(k)
    while True:
        found = _front(race, best, pool)
        before = race.spent
        for k in found:
            _to_enough(race, k)
        if race.spent == before:
            return _thinned(found, best)


def _sampled(race: CandidateRace, candidate: int) -> bool:
    return all(race.samples(arm) for arm in race.candidates[candidate].tolist())


def _to_enough(race: CandidateRace, candidate: int) -> None:
    arms = race.candidates[candidate].tolist()
    race.sample({arm: ENOUGH for arm in arms if race.samples(arm) < ENOUGH})


def _front(race: CandidateRace, best: int, pool: set[int]) -> list[int]:
    """The best one, cheaper ones that raise the share above all before, and dearer ones above the best one's."""
    shares, found, highest = race.shares(), list[int](), -1.0
    for k in np.lexsort((-race.means(), race.costs)).tolist():
        if k == best or (k in pool and _sampled(race, k) and shares[k] > highest):
            found.append(k)
            highest = max(highest, shares[k])
    return found


def _thinned(found: Sequence[int], best: int) -> tuple[int, ...]:
    """At most so many, with both ends and the best one."""
    if len(found) <= LONGEST:
        return tuple(found)
    places = {round(k * (len(found) - 1) / (LONGEST - 1)) for k in range(LONGEST)}
    return tuple(k for place, k in enumerate(found) if place in places or k == best)


def runners_up(race: CandidateRace, best: int) -> tuple[int, ...]:
    """The two candidates next in cost whose share may reach the wanted one."""
    possible = race.possible()
    others = [k for k in np.flatnonzero(possible).tolist() if k != best]
    means = race.means()
    others.sort(key=lambda k: (abs(race.costs[k] - race.costs[best]), -means[k], k))
    if len(others) < RUNNERS_UP:
        rest = [k for k in np.argsort(-means, kind="stable").tolist() if k != best and k not in others]
        others += rest
    for k in others[:RUNNERS_UP]:
        _to_enough(race, k)
    return tuple(k for k in others[:RUNNERS_UP] if _sampled(race, k))
