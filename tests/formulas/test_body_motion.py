"""Motion of bodies in space: reference cases in closed form, and against an integration of six degrees of freedom.

The numbers of the cases have five to six digits; closed forms meet them within the last one.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from abu_calc.formulas.body_motion import (
    BodyMotion,
    BodySprings,
    imbalance_at,
    vector_total,
    velocity_rms,
    weighted_acceleration,
    whirl_receptances,
)
from abu_calc.formulas.rigid_body import Inertia, RigidBody
from abu_calc.foundation.errors import InputError
from abu_calc.standards.vibration import hand_arm_weight
from tests.formulas.bodies import G125, G230, V305, SpaceCase, settled_amplitudes

DIGITS = 5e-6
CASES = {"G125": G125, "G230": G230, "V305": V305}


def moving(case: SpaceCase) -> BodyMotion:
    return BodyMotion(case.body, case.speed, case.suspension)


def settled(case: SpaceCase) -> Any:
    return moving(case).settled_balls(
        case.imbalance, case.wheel, case.race, case.eccentricity, case.count * case.ball_mass
    )


@pytest.mark.parametrize(
    ("name", "place", "with_balls", "expected"),
    [
        ("G125", "rear", False, (12.5264, 2.93740, 8.17211)),
        ("G125", "side", False, (19.7999, 18.3292, 39.0305)),
        ("G230", "rear", False, (11.7180, 1.62991, 9.09178)),
        ("G230", "side", False, (15.0394, 14.5331, 36.8850)),
        ("G230", "race", False, (14.5891, 31.8361, 6.45995)),
        ("V305", "rear", False, (13.9062, 2.31820, 10.4077)),
        ("V305", "side", False, (19.9160, 27.9588, 20.3801)),
        ("G230", "rear", True, (1.37008, 0.674601, 2.47761)),
        ("G230", "side", True, (2.66239, 3.69102, 11.9759)),
        ("G230", "race", True, (0.589188, 0.589188, 1.75225)),
        ("V305", "rear", True, (0.543895, 0.090124, 0.405572)),
        ("V305", "side", True, (0.773367, 1.07650, 0.787375)),
    ],
)
def test_velocities(name: str, place: str, with_balls: bool, expected: tuple[float, float, float]) -> None:
    case = CASES[name]
    at = case.race if place == "race" else case.handles[place]
    loads = settled(case).loads if with_balls else [imbalance_at(case.wheel, case.imbalance)]
    motion = moving(case).displacement(at, loads)
    assert [1e3 * v for v in velocity_rms(motion, case.speed)] == pytest.approx(expected, rel=DIGITS)


@pytest.mark.parametrize("place", ["rear", "side"])
def test_race_in_the_wheel_plane_stills_every_place(place: str) -> None:
    without = moving(G125).displacement(G125.handles[place], [imbalance_at(G125.wheel, G125.imbalance)])
    left = moving(G125).displacement(G125.handles[place], settled(G125).loads)
    assert max(map(abs, left)) < 1e-12 * max(map(abs, without))


@pytest.mark.parametrize(("case", "expected"), [(G125, -38.0), (G230, -167.471 - 0.0149j), (V305, -577.517 - 6.0495j)])
def test_resultant_of_the_balls(case: SpaceCase, expected: complex) -> None:
    V = 1e6 * settled(case).resultant
    assert V.real == pytest.approx(expected.real, rel=DIGITS)
    assert V.imag == pytest.approx(complex(expected).imag, abs=1e-4)


def test_level_and_its_bound_where_the_race_is_in_another_plane() -> None:
    """Root of the sum of squares of both handles' amplitudes: without balls, with them, and the best possible [µm]."""
    motion, places = moving(G230), list(G230.handles.values())

    def amplitudes(loads: Any) -> Any:
        return 1e6 * np.concatenate([motion.displacement(place, loads) for place in places])

    without = amplitudes([imbalance_at(G230.wheel, G230.imbalance)])
    with_balls = amplitudes(settled(G230).loads)
    a = amplitudes([imbalance_at(G230.race, 1e-6)])
    best = -np.vdot(a, without) / np.vdot(a, a).real
    assert float(np.linalg.norm(without)) == pytest.approx(93.391, rel=DIGITS)
    assert float(np.linalg.norm(with_balls)) == pytest.approx(27.296, rel=2e-5)
    # the balls' own mass, left out here, changes the rest by 1e-4
    assert float(np.linalg.norm(without + best * a)) == pytest.approx(25.436, rel=2e-4)
    assert abs(best) == pytest.approx(188.12, rel=2e-4)


def test_reference_machine_of_the_type_test() -> None:
    """A body of mass 6.0 kg along its spindle, 65 g·mm at 5800 rpm: 1.45775 and 0.92766 m/s² at its handles."""
    speed = 5800 * math.pi / 30
    motion = BodyMotion(RigidBody(6.0, Inertia(0.10, 0.10, 0.10)), speed)
    wheel, race = (0.0, 0.0, 0.20), (0.0, 0.0, 0.18)
    assert motion.effective_mass(race) == pytest.approx(2.03804, rel=DIGITS)
    four_digits = 1.2e-4  # W_h with the quality factor 0.71 of the standard; 1/√2 gives 0.165800
    assert hand_arm_weight(speed) == pytest.approx(0.165800, rel=four_digits)
    for place, without in ((0.10, 1.45775), (-0.20, 0.92766)):
        x = motion.displacement((0, 0, place), [imbalance_at(wheel, 65e-6)])
        a_h = [weighted_acceleration(v, speed) for v in velocity_rms(x, speed)]
        assert vector_total(a_h) == pytest.approx(without, rel=four_digits)


def test_springs_of_one_frequency_are_a_factor_on_the_free_body() -> None:
    """The factor against six degrees of freedom solved together."""
    springs, speed = BodySprings((300.0, 300.0), (0.1, 0.1)), 700.0
    body = RigidBody(2.4, Inertia(0.0040, 0.0200, 0.0190, -0.0015))
    motion, at = BodyMotion(body, speed, springs), G125.handles["side"]
    quick = motion.response(at, G125.wheel)
    whole = speed**2 * (motion.receptance(at, G125.wheel) @ np.array([1, -1j, 0]))
    assert quick == pytest.approx(whole.tolist(), rel=1e-9)


def test_springs_of_two_frequencies_hold_each_axis_at_its_own() -> None:
    """A body on its axes: along x the wheel answers as with ω_x alone, along y as with ω_y alone."""
    body, wheel = RigidBody(4.0, Inertia(0.03, 0.05, 0.04)), (0.0, 0.0, 0.1)
    pairs = {100.0: 0.1, 200.0: 0.3}
    H = BodyMotion(body, 500.0, BodySprings((100.0, 200.0), (0.1, 0.3))).receptance(wheel, wheel)
    for axis, (w, z) in enumerate(pairs.items()):
        alone = BodyMotion(body, 500.0, BodySprings((w, w), (z, z))).receptance(wheel, wheel)
        assert H[axis, axis] == pytest.approx(alone[axis, axis], rel=1e-9)


def test_springs_keep_their_stiffness_when_mass_is_added() -> None:
    wheel = (0.0, 0.0, 0.1)
    heavier = RigidBody(5.0, Inertia(0.03, 0.05, 0.04))
    springs = BodySprings((100.0, 100.0), (0.1, 0.1), mass=4.0)
    K = springs.stiffness(heavier, 0.0)
    assert K[0, 0] == pytest.approx(4.0 * 100.0**2)
    assert springs.factor(500.0) is None
    assert BodyMotion(heavier, 500.0, springs).effective_mass(wheel) == pytest.approx(
        BodyMotion(heavier, 500.0).effective_mass(wheel), rel=0.04
    )


def test_undamped_resonance_is_refused() -> None:
    motion = BodyMotion(G125.body, 100.0, BodySprings((100.0, 100.0), (0.0, 0.0)))
    with pytest.raises(InputError, match="natural frequency"):
        motion.response(G125.wheel, G125.wheel)


@pytest.mark.parametrize(
    ("case", "frequency", "damping", "gyro", "boundary"),
    [
        (G125, 20.0, 0.05, False, 1359.5),
        (G230, 20.0, 0.05, False, 1408.8),
        (G230, 20.0, 0.05, True, 1425.0),
        (V305, 12.0, 0.10, False, 968.8),
        (V305, 12.0, 0.10, True, 988.6),
    ],
)
def test_boundary_of_stability(case: SpaceCase, frequency: float, damping: float, gyro: bool, boundary: float) -> None:
    """Balls two and two, race in the wheel plane: the equation of whirl against Floquet multipliers, within 0.04 %."""
    optimize = pytest.importorskip("scipy.optimize")
    body = case.body if gyro else RigidBody(case.body.mass, case.body.inertia)
    n_m, J = case.count * case.ball_mass, 7 / 5
    chi = abs(2 * (case.imbalance / (n_m * case.pitch_radius)) ** 2 - 1)
    springs = BodySprings((2 * math.pi * frequency,) * 2, (damping,) * 2)

    def equation(unknown: Any) -> list[float]:
        growth, speed = 1j * float(unknown[0]), float(unknown[1])
        h, back = whirl_receptances(BodyMotion(body, speed, springs), case.wheel, growth, n_m)
        p, q = (growth + 1j * speed) ** 4 * h, (growth - 1j * speed) ** 4 * back
        X = J * growth**2 + case.drag * growth
        left = X * X - n_m / 2 * (p + q) * X + (n_m / 2) ** 2 * (1 - chi**2) * p * q
        return [(left / speed**4).real, (left / speed**4).imag]

    roots = []
    for share in np.linspace(0.85, 1.15, 7):
        guess = share * boundary * math.pi / 30
        found = optimize.root(equation, [guess - springs.frequencies[0], guess])
        if found.success and found.x[1] > springs.frequencies[0]:
            roots.append(30 / math.pi * float(found.x[1]))
    assert roots
    assert min(roots) == pytest.approx(boundary, rel=4.5e-4)


@pytest.mark.slow
def test_six_degrees_of_freedom_without_balls() -> None:
    case = replace(G125, handles={"side": G125.handles["side"]})
    integrated = settled_amplitudes(case, case.handles, balls=False, turns=120)["side"]
    motion = moving(case).displacement(case.handles["side"], [imbalance_at(case.wheel, case.imbalance)])
    # after 120 revolutions e^{−5} of the start is left in the harmonic, mostly averaged out
    assert integrated.tolist() == pytest.approx(velocity_rms(motion, case.speed), rel=2e-3)


@pytest.mark.hard
def test_six_degrees_of_freedom_with_balls() -> None:
    places = {**G230.handles, "race": G230.race}
    integrated = settled_amplitudes(G230, places, balls=True, turns=620)
    loads = settled(G230).loads
    for name, place in places.items():
        expected = velocity_rms(moving(G230).displacement(place, loads), G230.speed)
        assert integrated[name].tolist() == pytest.approx(expected, rel=1e-5), name
