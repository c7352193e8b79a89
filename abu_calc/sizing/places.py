"""Levels where the machine is held: three axes at each handle, and in the wheel plane, without and with the balls.

A body in space is held by its suspension in all six degrees of freedom. Other machines move along their spindle, and a
place moves as a fixed multiple of the wheel.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial

from abu_calc.formulas.body_motion import (
    BodyMotion,
    BodySprings,
    BodySuspension,
    HandsOnHandles,
    imbalance_at,
    vector_total,
    weighted_acceleration,
)
from abu_calc.formulas.rigid_body import Vector
from abu_calc.foundation.errors import RangeError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import velocity_from_level
from abu_calc.inputs.body import pair
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import displacement_level, loudest_displacement, place_response
from abu_calc.sizing.case import WHEEL_PLANE, Case, hand_axes
from abu_calc.standards.vibration import hand

AXES = ("x", "y", "z")
HANDS = 2
"""Handles that hold a machine in hands: the first two of its file."""


@dataclass(frozen=True)
class Levels:
    """Levels [dB] without and with the autobalancer; `after` is null where balls cannot balance, each under load where
    it is not known.
    """

    before: float | None
    after: float | None

    @property
    def reduction(self) -> float | None:
        """before − after [dB]."""
        return None if self.before is None or self.after is None else self.before - self.after


@dataclass(frozen=True)
class LevelPlace:
    """A handle, or the wheel plane; `effective_mass` [kg] is imbalance at the wheel over the motion it makes here.

    `levels`: of the loudest axis; `axes`: along x, y and z; `place` [m]: from the centre of mass.
    """

    name: str
    effective_mass: float | None
    levels: Levels
    axes: tuple[Levels, ...] = ()
    place: Vector | None = None

    def total(self, speed: float, *, after: bool) -> float | None:
        """Vector total a_hv [m/s²] of the axes; None if a level is not known, or W_h not defined at this speed."""
        accelerations = weighted_axes(self.axes, speed, after=after)
        return vector_total(accelerations) if accelerations else None


@dataclass(frozen=True)
class VibrationLevels:
    """Levels at the rated speed where the machine is held (the wheel plane when no handle is given).

    `worst` is the loudest of the places whose level is limited, `judged` its name; `lowered`: whether the wheel itself
    moves less with the autobalancer.
    """

    places: tuple[LevelPlace, ...]
    worst: Levels
    lowered: bool
    judged: str = WHEEL_PLANE


def weighted_axes(axes: Iterable[Levels], speed: float, *, after: bool) -> tuple[float, ...] | None:
    """Weighted accelerations a_h [m/s²] of axes; None if a level is not known, or W_h not defined at this speed."""
    levels = [each.after if after else each.before for each in axes]
    try:
        return tuple(
            weighted_acceleration(velocity_from_level(level), speed) for level in levels if level is not None
        ) if levels and None not in levels else None  # fmt: skip
    except RangeError:
        return None


Displacements = Callable[[Vector], Sequence[float]]
"""Displacements 0–peak [m] of the axes of a place."""


def handle_levels(case: Case, before: float | None, after: float | None, added_mass: float) -> VibrationLevels:
    """Levels at every place of forward whirls of the wheel [m] at the rated speed, None: not known."""

    def moved(place: Vector) -> list[float]:
        whirl = case.body.inertance(case.body.wheel, case.body.wheel, added_mass)
        return [(after or 0.0) * (axis / whirl) for axis in case.body.axes(place, added_mass)]

    lowered = before is not None and after is not None and after < before
    return _levels(case, before, None if after is None else moved, added_mass, lowered)


def settled_levels(
    case: Case, before: float | None, at_race: float | None, imbalance: float, added_mass: float,
    *, in_line: bool = False,
) -> VibrationLevels:  # fmt: skip
    """Levels at every place where balls have settled, by the displacement `at_race` [m] of the race, None: not known.

    `before`: forward whirl of the wheel without the autobalancer [m]; `in_line`: what a race off the wheel's plane
    leaves adds up with it, else both are added as squares.
    """

    def moved(place: Vector) -> Vector:
        return place_response(case, place, added_mass).displacements(at_race or 0.0, imbalance, in_line=in_line)

    lowered = False
    if before is not None and at_race is not None:
        lowered = max(moved(case.body.wheel)[:2]) < before * case.body.transmission(case.body.wheel)
    return _levels(case, before, None if at_race is None else moved, added_mass, lowered)


def _levels(
    case: Case, before: float | None, after: Displacements | None, added_mass: float, lowered: bool
) -> VibrationLevels:
    places = tuple(_moved(case, held.name, held.place, before, after, added_mass) for held in case.places)
    limited = places
    if case.body.in_space and case.handles:
        limited = (_moved(case, WHEEL_PLANE, case.body.wheel, before, after, added_mass),)
    worst = Levels(_loudest(each.levels.before for each in limited), _loudest(each.levels.after for each in limited))
    judged = max(limited, key=lambda place: place.levels.after or -math.inf).name
    return VibrationLevels(places, worst, lowered, judged)


def _moved(
    case: Case, name: str, place: Vector, before: float | None, after: Displacements | None, added_mass: float
) -> LevelPlace:
    """Levels of a place that without the autobalancer moves in proportion to the wheel."""
    body, wheel = case.body, case.body.wheel
    bare = [axis / body.inertance(wheel, wheel) for axis in body.axes(place)]
    settled = (None,) * len(AXES) if after is None else [_level(case, moved) for moved in after(place)]

    def level(share: float) -> float | None:
        return None if before is None else _level(case, before * share)

    axes = tuple(Levels(level(share), settled_level) for share, settled_level in zip(bare, settled, strict=True))
    loudest = Levels(level(body.transmission(place)), _loudest(settled[: 2 if place == wheel else 3]))
    inertance = body.loudest_axis(place, added_mass)
    return LevelPlace(name, 1 / inertance if inertance else None, loudest, axes, place)


def in_space(case: Case, imbalance: float, candidate: Candidate, residual: float | None) -> tuple[LevelPlace, ...]:
    """Levels at the handles of a body in space, idle; `residual`: forward whirl of the race that stays [m], None: the
    balls cannot balance.

    Without the autobalancer the imbalance shakes the body; with it also the balls that still the forward whirl of the
    race. What their whirl leaves at a handle and what the residual whirl of the race causes there are added as squares,
    axis by axis.
    """
    balls = candidate.balls_mass
    bare = BodyMotion(case.body.body, case.speed, body_suspension(case))
    carried = replace(case.body.body, mass=case.body.mass + candidate.mass - balls)
    fitted = BodyMotion(carried, case.speed, body_suspension(case, carrying=True))
    wheel, race = case.body.wheel, case.race_place
    settled = partial(fitted.settled_balls, wheel=wheel, race=race, ball_mass=balls, inertia_factor=case.inertia_factor)
    still = settled(imbalance).loads
    whirling = () if residual is None else settled(0.0, eccentricity=residual).loads
    places = []
    for held in case.handles:
        before = [abs(axis) for axis in bare.displacement(held.place, (imbalance_at(wheel, imbalance),))]
        after: list[float] | None = None
        if residual is not None:
            pairs = zip(fitted.displacement(held.place, still), fitted.displacement(held.place, whirling), strict=True)
            after = [math.hypot(abs(rest), abs(whirl)) for rest, whirl in pairs]
        axes = tuple(
            Levels(_level(case, before[k]), None if after is None else _level(case, after[k])) for k in range(3)
        )
        levels = Levels(_loudest(axis.before for axis in axes), _loudest(axis.after for axis in axes))
        largest = max(before)
        places.append(LevelPlace(held.name, imbalance / largest if largest else None, levels, axes, held.place))
    return tuple(places)


def body_suspension(case: Case, *, carrying: bool = False) -> BodySuspension | None:
    """The suspension of all six degrees of freedom; None: hands that the file gives no two handles for.

    `carrying`: the body carries the autobalancer, with which springs keep their stiffness.
    """
    table = case.table.suspension
    frequencies = pair(table.natural_frequencies)
    if frequencies is None or table.dampings is None:
        if len(case.handles) < HANDS:
            return None
        x, y, z = (hand(name) for name in hand_axes(case.table.machine.layout))
        return HandsOnHandles(tuple(held.place for held in case.handles[:HANDS]), (x, y, z))
    return BodySprings(frequencies, table.dampings, case.body.mass if carrying else None)


@dataclass(frozen=True)
class PlaceBand:
    """Bands [low, high] of one place: levels [dB] and vector totals a_hv [m/s²], None if the number is not known."""

    level_before_band: tuple[float, float] | None
    level_after_band: tuple[float, float] | None
    a_hv_before_band: tuple[float, float] | None
    a_hv_after_band: tuple[float, float] | None


def place_numbers(places: Iterable[LevelPlace], speed: float) -> list[float]:
    """Numbers of each place that a band is found of, in the order of `PlaceBand`; NaN: not known."""
    numbers = []
    for place in places:
        totals = (place.total(speed, after=after) for after in (False, True))
        numbers += [
            math.nan if value is None else value for value in (place.levels.before, place.levels.after, *totals)
        ]
    return numbers


def place_bands(bands: tuple[tuple[float, float], ...]) -> tuple[PlaceBand, ...]:
    """Bands of places from those of `place_numbers`."""
    known = [None if math.isnan(low) or math.isnan(high) else (low, high) for low, high in bands]
    return tuple(PlaceBand(*known[k : k + 4]) for k in range(0, len(known), 4))


def level_at_loudest(case: Case, candidate: Candidate, displacement: float) -> float:
    """The level [dB] at the loudest limited place of a displacement 0–peak [m] of the race, idle.

    What a race off the wheel's plane leaves is added as squares.
    """
    imbalance = candidate.requirement.imbalance_part
    return _level(case, loudest_displacement(case, imbalance, candidate.mass, displacement))


def _level(case: Case, displacement: float) -> float:
    return displacement_level(displacement, case.speed, case.background_level)


def _loudest(levels: Iterable[float | None]) -> float | None:
    return max((level for level in levels if level is not None), default=None)
