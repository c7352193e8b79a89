"""Balls numbered round their races, so that one code serves whatever order they were given in."""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.race import Race

Places = NDArray[np.intp]


@lru_cache(maxsize=8)
def in_order(equations: Equations) -> tuple[Equations, Places]:
    """The same scene with its balls numbered round each race, and where each of its states stood."""
    scene = equations.scene
    orders = [_order(race) for race in scene.races]
    places = _places(equations, np.concatenate([np.array([], dtype=np.intp), *_shifted(orders)]))
    if np.array_equal(places, np.arange(len(places))):
        return equations, places
    races = tuple(_renumbered(race, order) for race, order in zip(scene.races, orders, strict=True))
    initial = tuple(np.array(equations.initial)[places].tolist())
    reordered = assemble(replace(scene, races=races))
    return replace(reordered, initial=initial, longest_step=equations.longest_step, breaks=equations.breaks), places


def _order(race: Race) -> Places:
    """The balls of a race as they stand round it."""
    return np.argsort(np.array(race.start_angles) % (2 * math.pi), kind="stable")


def _shifted(orders: list[Places]) -> list[Places]:
    """Counted over all races."""
    firsts = np.cumsum([0, *map(len, orders)])
    return [order + first for order, first in zip(orders, firsts, strict=False)]


def _renumbered(race: Race, order: Places) -> Race:
    masses, angles, speeds = (
        tuple(values[k] for k in order) for values in (race.ball_masses, race.start_angles, race.start_speeds)
    )
    return replace(race, ball_masses=masses, start_angles=angles, start_speeds=speeds)


def _places(equations: Equations, balls: Places) -> Places:
    """Places of all states: support, angles, speeds and further states of the balls, rotor."""
    p = equations.parameters
    first, blocks = 2 * p.size, 2 + len(equations.scene.ball_states)
    places = np.arange(len(equations.states))
    for block in range(blocks if p.balls else 0):
        start = first + block * p.balls
        places[start : start + p.balls] = start + balls
    return places
