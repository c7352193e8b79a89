"""Arrangements that balance: moved on the constraint, by their likeness, and to their neighbours.

Which arrangements of balls balance, and how stable the worst of them is: published and derived numbers.
"""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import minimize

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.boundaries import boundaries, crossings_of
from abu_calc.dynamics.stability.family import (
    Family,
    _sizes,
    closed,
    largest,
    likeness,
    moved_to,
    neighbours,
    rests,
    spread,
)
from abu_calc.dynamics.stability.linearised import BalancedMotion
from abu_calc.dynamics.stability.resting import NotKnownError
from abu_calc.dynamics.stability.two_modes import two_modes
from abu_calc.dynamics.stability.verdict import judged, stability
from abu_calc.dynamics.supports.planar import PlanarSupport, in_hands, planar
from abu_calc.standards.vibration import hand
from tests.dynamics.scenes import dimensionless

MASSES, ANGLES = np.array((1.0, 1.0, 0.8, 1.2)), np.array((0.3, 1.9, 3.4, 5.0))


def test_angles_are_moved_to_the_sum_that_is_wanted_and_no_further_than_needed() -> None:
    resultant = complex(MASSES @ np.exp(1j * ANGLES)) + 0.02 + 0.01j
    moved = moved_to(MASSES, ANGLES, resultant)
    assert moved is not None
    assert complex(MASSES @ np.exp(1j * moved)) == pytest.approx(resultant, abs=1e-12)
    assert np.abs(moved - ANGLES).max() < 0.03
    assert moved_to(MASSES, ANGLES, 4.5) is None  # all four together carry 4


@pytest.mark.parametrize("chi", [0.0, 0.4, 1.0])
def test_equal_balls_with_room_have_every_likeness(chi: float) -> None:
    """Four equal balls that balance nothing: from a cross, χ = 0, to two pairs on one line, χ = 1."""
    family = Family.of((1.0,) * 4, (0.0, math.pi / 2, math.pi, 1.5 * math.pi), 0.0)
    angles = family.nearest(chi)
    assert likeness((1.0,) * 4, angles.tolist()) == pytest.approx(chi, abs=1e-6)
    assert abs(np.exp(1j * angles).sum()) < 1e-9
    assert np.all(np.diff(family.chi) >= 0) and len(family.rows) == len(family.chi)


def test_neighbours_balance_as_well_each_a_step_away() -> None:
    """Four balls have two free directions, each both ways."""
    resultant = complex(MASSES @ np.exp(1j * ANGLES))
    races = [(MASSES, resultant, 0.1)]
    around = list(neighbours(races, ANGLES, 1e-3))
    assert len(around) == 4
    for angles in around:
        assert complex(MASSES @ np.exp(1j * angles)) == pytest.approx(resultant, abs=1e-12)
        assert np.linalg.norm(angles - ANGLES) == pytest.approx(1e-3, rel=1e-2)
    assert closed([(MASSES, resultant, 1.7)], ANGLES) is None  # balls of this size overlap


@pytest.mark.parametrize("place", [0.0, 0.21, 0.5, 0.83, 1.0])
def test_the_largest_value_is_found_at_the_ends_too(place: float) -> None:
    assert largest(lambda x: -abs(x - place), (0.0, 0.5, 1.0), 40) == pytest.approx(place, abs=1e-8)
    assert largest(lambda x: -abs(x - place), (0.7,), 40) == 0.7


OPPOSITE = {2: (90.0, -90.0), 4: (90.0, 90.0, -90.0, -90.0), 8: (90.0,) * 4 + (-90.0,) * 4}


def scene_of(
    balls: int, share: float = 0.0, mass: float = 0.005, inertia_factor: float = 1.4, damping: float = 0.02,
    drag: float = 0.05, speed: float = 2.0, stiffness: tuple[float, float] = (1.0, 1.0),
) -> Scene:  # fmt: skip
    """1 kg with its balls on 1 N/m, R_p = 1 m; `share`: imbalance over that of all balls in one place."""
    angles = np.radians(OPPOSITE.get(balls, range(balls)))
    scene = dimensionless(
        speed, mass, share * balls * mass, damping, drag, tuple(angles), 100.0, inertia_factor=inertia_factor
    )
    return replace(scene, support=planar(1 - balls * mass, stiffness, (2 * damping, 2 * damping)))


def exact_growth(scene: Scene, chi: float) -> float:
    """Largest real part by the characteristic equation, second derivation:

    X² D(a)D(b) − (N/2)(a⁴D(b) + b⁴D(a)) X + (N/2)²(1 − χ²)a⁴b⁴ = 0, roots that are neutral or free left out.
    """
    race, W = scene.races[0], scene.speed
    N = len(race.ball_masses) * race.ball_masses[0]
    c = scene.support.damping[0][0]
    a, b = np.poly1d([1, 1j * W]), np.poly1d([1, -1j * W])
    X = np.poly1d([race.inertia_factor, race.drag, 0])
    Da, Db = a**2 + c * a + np.poly1d([1]), b**2 + c * b + np.poly1d([1])
    equation = X**2 * Da * Db - N / 2 * (a**4 * Db + b**4 * Da) * X + N**2 / 4 * (1 - chi**2) * a**4 * b**4
    roots = equation.roots
    return float(max(root.real for root in roots if abs(root) > 1e-7))


@pytest.mark.parametrize(
    ("balls", "way", "share", "mass", "factor", "damping", "drag", "expected"),
    [
        (2, "start", 0.0, 0.005, 1.4, 0.01, 0.01, 1.318823),
        (2, "fan", 0.5, 0.005, 1.0, 0.01, 0.01, 1.320171),
        (3, "fan", 0.5, 0.005, 1.4, 0.02, 0.05, 1.294794),
        (4, "start", 0.0, 0.005, 1.4, 0.02, 0.05, 1.376846),
        (6, "fan", 0.3, 0.002, 1.4, 0.005, 0.02, 1.270440),
        (8, "start", 0.0, 0.002, 1.4, 0.002, 0.02, 1.373689),
    ],
)
def test_derived_boundaries(
    balls: int, way: str, share: float, mass: float, factor: float, damping: float, drag: float, expected: float
) -> None:
    """The highest boundary of each arrangement; the worst of all is at least as high."""
    scene = scene_of(balls, share, mass, factor, damping, drag)
    assert boundaries(scene, 1.1, 4.0, 0.0, way)[-1].speed == pytest.approx(expected, abs=6e-7)
    last = boundaries(scene, 1.1, 4.0)[-1]
    assert last.speed >= expected - 6e-7 and last.stable_above


def test_four_balls_in_two_groups_are_the_worst() -> None:
    """The even fan is stable from 1.328039 on, two and two from 1.376846."""
    scene = scene_of(4, speed=1.35)
    assert [stability(scene, 0.0, way).stable for way in ("worst", "fan", "start")] == [False, True, False]
    assert boundaries(scene, 1.1, 4.0)[-1].speed == pytest.approx(1.376846, abs=6e-7)
    assert boundaries(scene, 1.1, 4.0, 0.0, "fan")[-1].speed == pytest.approx(1.328039, abs=6e-7)
    found = stability(scene)
    assert likeness((1.0,) * 4, found.angles) == pytest.approx(1.0) and found.arrangements > 2
    assert found.growth_rate == pytest.approx(exact_growth(scene, 1.0), rel=1e-9)


@pytest.mark.parametrize("speed", [1.02, 1.25, 1.35, 3.0])
@pytest.mark.parametrize("share", [0.0, 0.2, 0.6])
def test_every_arrangement_by_the_characteristic_equation(speed: float, share: float) -> None:
    scene = scene_of(5, share, speed=speed)
    for motion in judged(scene, 0.05)[1]:
        chi = likeness(scene.ball_masses, motion.angles)
        assert motion.growth(speed) == pytest.approx(exact_growth(scene, chi), abs=1e-9)


@pytest.mark.parametrize(
    "support",
    [
        planar(0.98, (1.0, 1.0), (0.04, 0.04)),
        planar(0.98, (1.0, 2.5), (0.04, 0.3)),
        in_hands(0.98, (hand("x"), hand("z"))),
    ],
    ids=["alike", "unlike", "hands"],
)
@pytest.mark.slow
def test_two_modes_are_all_of_the_motion(support: PlanarSupport) -> None:
    """Against the equations themselves, of every ball."""
    scale = 1.0 if len(support.names) == 2 else 300.0
    still = (0.0,) * len(support.names)
    scene = replace(scene_of(4, 0.3), support=support, speed=1.8 * scale, start_position=still, start_velocity=still)
    for rest in rests(scene):
        whole = BalancedMotion(scene, rest.angles)
        two = two_modes(whole)
        assert two is not None and two.isotropic == whole.isotropic
        for factor in (0.8, 1.0):
            speed = factor * scene.speed
            assert two.growth(speed) == pytest.approx(whole.growth(speed), abs=2e-8 * speed)
            assert two.growing(speed, 1e-7 * speed) == whole.growing(speed, 1e-7 * speed)


def searched(balls: int, share: float, gap: float) -> float:
    """The largest χ by a general search from random starts."""
    rng, best = np.random.default_rng(balls), 0.0
    held = [
        {"type": "eq", "fun": lambda x: [np.cos(x).sum() + share, np.sin(x).sum()]},
        {"type": "ineq", "fun": lambda x: np.append(np.diff(x), x[0] + 2 * math.pi - x[-1]) - gap},
    ]
    for _ in range(12):
        start = np.sort(rng.uniform(0, 2 * math.pi, balls))
        found = minimize(lambda x: -(abs(np.exp(2j * x).sum()) ** 2), start, constraints=held, method="SLSQP")
        if found.success and abs(np.exp(1j * found.x).sum() + share) < 1e-6:
            best = max(best, float(abs(np.exp(2j * found.x).mean())))
    return best


@pytest.mark.parametrize(("balls", "share", "gap"), [(3, 0.5, 0.0), (3, 1.5, 0.2), (4, 1.2, 0.4), (5, 2.0, 0.3)])
def test_the_least_even_arrangement_is_found(balls: int, share: float, gap: float) -> None:
    found = spread(np.ones(balls), complex(-share), gap, 2 * math.pi / balls)
    chi = [likeness((1.0,) * balls, one) for one in found]
    assert chi == sorted(chi) and chi[-1] == pytest.approx(searched(balls, share, gap), abs=2e-3)
    for angles in found:
        assert abs(np.exp(1j * np.array(angles)).sum() + share) < 1e-12
        places = sorted(angle % (2 * math.pi) for angle in angles)
        assert min(b - a for a, b in pairwise([*places, places[0] + 2 * math.pi])) >= gap - 1e-8


@pytest.mark.parametrize("share", [0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01])
def test_next_to_no_imbalance_changes_nothing(share: float) -> None:
    """What brings two balls that stand all but opposite back goes with the square of what they lack."""
    scene = scene_of(2, share, damping=0.01, drag=0.01)
    assert stability(scene).stable
    assert not stability(replace(scene, speed=1.2)).stable
    found = [one.speed for one in boundaries(scene, 0.9, 4.0)]
    assert found == pytest.approx([1.0, 1.0099, 1.318823], abs=0.0025)
    uneven = replace(scene, support=planar(0.99, (1.0, 1.0 + 1e-6), (0.02, 0.02)))
    assert stability(uneven).stable and stability(uneven).multipliers is not None


@pytest.mark.slow
def test_crossings_tell_how_many_grow() -> None:
    """Each at the right place: the number of growing roots of the characteristic equation is that on either side."""
    scene = scene_of(4)
    found = crossings_of(scene, 0.9, 4.0, 0.0, "start")
    assert [(one.growing_below, one.growing_above) for one in found] == [(1, 0), (0, 2), (2, 0)]
    assert [one.speed for one in found] == pytest.approx([1.0, 1.0178023, 1.3768462], abs=1e-6)
    for one in found:
        for factor, growing in ((0.9999, one.growing_below), (1.0001, one.growing_above)):
            there = replace(scene, speed=factor * one.speed)
            assert (exact_growth(there, 1.0) > 0) is (growing > 0)
    unlike = scene_of(2, 0.3, stiffness=(1.0, 2.0))
    changes = [one.speed for one in boundaries(unlike, 0.9, 4.0)]
    crossed = crossings_of(unlike, 0.9, 4.0)
    assert [one.speed for one in crossed if not (one.growing_below and one.growing_above)] == pytest.approx(
        changes, rel=1e-6
    )


@pytest.mark.slow
def test_the_start_decides_where_balls_go() -> None:
    """From two and two to two and two; from one place exactly opposite to none."""
    scene = scene_of(4, 0.2)
    (found,) = rests(scene, 0.0, "start")
    assert abs(np.exp(1j * np.array(found.angles)).sum() + 0.8) < 1e-10
    assert found.angles[0] == pytest.approx(found.angles[1]) and found.angles[2] == pytest.approx(found.angles[3])
    stuck = replace(scene, races=(replace(scene.races[0], start_angles=(0.0,) * 4),))
    with pytest.raises(NotKnownError, match="start angles"):
        rests(stuck, 0.0, "start")
    with pytest.raises(NotKnownError, match="start angles"):  # they would end one in another
        rests(scene, 0.1, "start")
    assert stability(stuck, 0.0, "start").stable is None


def test_equal_balls_are_grouped_once_and_others_in_every_order() -> None:
    once = {(3, 1, 0), (2, 2, 0), (2, 1, 1)}
    assert set(_sizes(np.ones(4))) == once
    assert set(_sizes(np.array([1.0, 1.0, 1.0, 2.0]))) == once | {(1, 3, 0), (1, 2, 1), (1, 1, 2)}
