"""Balls under load: the numbers of the corrected theory, second derivations, and where the printed formulas fail.

The grinder of these numbers: 5.6 kg with its balls, 5800 rpm, ω 80 and 120 rad/s, undamped, 100 g·mm, ε = 0.04 mm.
"""

import cmath
import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from abu_calc.features.grinding.formulas import (
    BallArrangement,
    characteristic,
    flutter_drag,
    growing_roots,
    hodograph_limit,
    largest_factor,
    loaded_stiffness,
    published_resultant,
    runout_rate,
    stiffness_regions,
)
from abu_calc.formulas.tilting_contact import SteadyContact

W = 5800 * math.pi / 30
M, BALL, RP = 5.6, 16.728353e-3, 24e-3
C = M * 80.0**2, M * 120.0**2
D = complex(C[0] - M * W**2), complex(C[1] - M * W**2)
OWN, EPS = 100e-6, 4e-5
E = cmath.rect(EPS, 0.6)


def contact(friction: float = 0.0, stiffness: float | None = None) -> SteadyContact:
    return SteadyContact(W, D, 0.0 if stiffness is None else 1 / stiffness, friction)


GOLDEN = [
    (0.0, -181.6678 - 124.2857j, 307.8696, -156.1906, (136.3550, 271.2639), 160.6097, -55.623, 0.3834),
    (-0.35, -65.8037 - 209.4975j, 267.1705, -128.3593, (161.0753, 302.2060), 151.5928, -36.332, 0.3327),
    (0.35, -219.1043 + 14.5814j, 319.4373, 177.3837, (110.8259, 243.9415), 151.5928, -74.913, 0.3978),
]


@pytest.mark.parametrize(("friction", "total", "length", "angle", "places", "force", "phase", "use"), GOLDEN)
def test_golden_numbers(friction, total, length, angle, places, force, phase, use):
    one = contact(friction)
    U = one.balancing_imbalance(E)
    assert pytest.approx(total, abs=1e-4) == U * 1e6
    V = U - OWN
    assert 1e6 * abs(V) == pytest.approx(length, abs=1e-4)
    assert math.degrees(cmath.phase(V)) == pytest.approx(angle, abs=1e-4)
    half = math.acos(abs(V) / (2 * BALL * RP))
    found = [math.degrees(cmath.phase(V) + sign * half) % 360 for sign in (-1, 1)]
    assert found == pytest.approx(places, abs=1e-4)
    N = one.normal_force(U, E)
    assert abs(N) == pytest.approx(force, abs=1e-4)
    assert math.degrees(cmath.phase(N)) == pytest.approx(phase, abs=1e-3)
    assert abs(V) / (2 * BALL * RP) == pytest.approx(use, abs=1e-4)


def solved(friction: float, stiffness: float, U: complex, runout: complex) -> tuple[complex, complex, complex]:
    """X, Y, N from the three equations themselves: M x'' + c x = Ω²U + sf N, M y'' + c y = −iΩ²U + N, N by the gap.

    N = −c_n (Y − iE); a rigid contact is one of 1e15 N/m.
    """
    rows = np.array([[D[0], 0, -friction], [0, D[1], -1], [0, stiffness, 1]])
    right = np.array([W**2 * U, -1j * W**2 * U, 1j * stiffness * runout])
    x, y, n = np.linalg.solve(rows, right)
    return complex(x), complex(y), complex(n)


@pytest.mark.parametrize("friction", [0.0, 0.5, -0.5])
@pytest.mark.parametrize("stiffness", [3e5, 3e6, 6e6, None])
def test_axis_and_force_solve_the_equations(friction, stiffness):
    """Whatever the total imbalance; and where it is that of free balls, the forward whirl vanishes."""
    one = contact(friction, stiffness)
    for U in (0j, 120e-6 + 50e-6j, one.balancing_imbalance(E)):
        x, y, n = solved(friction, stiffness or 1e15, U, E)
        assert one.axis(U, E) == pytest.approx((x, y), rel=1e-5)
        assert one.normal_force(U, E) == pytest.approx(n, rel=1e-5, abs=1e-3)
    assert abs(x + 1j * y) < 1e-6 * abs(x)


@pytest.mark.parametrize("stiffness", [3e5, 3e6, None])
def test_whirl_per_imbalance_is_a_difference(stiffness):
    one, step = contact(-0.35, stiffness), 1e-6
    whirl = [(x + 1j * y) / 2 for x, y in (one.axis(U, E) for U in (0j, complex(step)))]
    assert one.whirl_per_imbalance == pytest.approx((whirl[1] - whirl[0]) / step, rel=1e-9)


def test_a_face_leaves_the_machine_idling():
    face = SteadyContact(W, D, 1.0, 0.0, 0.0)
    assert face.balancing_imbalance(E) == 0
    assert face.normal_force(1e-4, E) == 0
    x, y = face.axis(1e-4, E)
    assert (x, y) == pytest.approx((W**2 * 1e-4 / D[0], -1j * W**2 * 1e-4 / D[1]))
    assert face.whirl_per_imbalance == pytest.approx(W**2 / 2 * (1 / D[0] + 1 / D[1]))


# What is printed.
def test_printed_places_are_those_without_friction():
    V = published_resultant(M, OWN, E, 80.0, W)
    assert pytest.approx(contact().balancing_imbalance(E) - OWN, rel=1e-12) == V


@pytest.mark.parametrize(("friction", "wrong"), [(0.35, 27), (-0.35, 31)])
def test_printed_places_are_wrong_by_friction(friction, wrong):
    """Two balls, angles Θ₁ and Θ₂: wrong by 27° and 31° at the most."""

    def places(V: complex) -> list[float]:
        half = math.acos(abs(V) / (2 * BALL * RP))
        return [cmath.phase(V) + sign * half for sign in (-1, 1)]

    true = places(contact(friction).balancing_imbalance(E) - OWN)
    printed = places(published_resultant(M, OWN, E, 80.0, W))
    off = [abs(math.remainder(math.degrees(a - b), 360)) for a, b in zip(true, printed, strict=True)]
    assert max(off) == pytest.approx(wrong, abs=0.6)


def test_printed_arctan_loses_the_quadrant():
    """φ₀ = 2.9 and Mε > m₀e: exactly opposite, 2|V| left."""
    runout = cmath.rect(EPS, 2.9)
    V = contact().balancing_imbalance(runout) - OWN
    assert published_resultant(M, OWN, runout, 80.0, W) == pytest.approx(-V, rel=1e-9)
    assert abs(published_resultant(M, OWN, runout, 80.0, W) - V) / abs(V) == pytest.approx(2.0)


def test_axis_with_fixed_balls_moves_along_too():
    """(8) has x = 0: with friction it is sf ε D_y/D_x, 13.69 µm."""
    x, y = contact(0.35).axis(0j, E)
    assert 1e6 * abs(x) == pytest.approx(13.69, abs=5e-3)
    assert abs(y) == pytest.approx(EPS)


@pytest.mark.parametrize(("moved", "low", "high"), [(17.9e-6, 5.6e-6, 32.9e-6), (89e-6, 82.6e-6, 110e-6)])
def test_the_autobalancer_does_not_always_help(moved, low, high):
    """Rigid: ε with it; without, 5.6…32.9 µm or 82.6…110 µm round φ₀."""
    one = contact(-0.35)
    without = [abs(one.axis(M * moved, cmath.rect(EPS, math.radians(a)))[0]) for a in range(360)]
    assert (min(without), max(without)) == pytest.approx((low, high), rel=0.01)
    fitted = [abs(one.axis(one.balancing_imbalance(E), E)[0])]
    assert fitted == pytest.approx([EPS])
    assert (low > EPS) == (moved > EPS)


def test_wear_is_not_as_printed():
    """At a rigid contact the high spot carries the least: the runout grows, twice as fast with free balls."""
    one = contact(0.35)
    rates = [runout_rate(-1j * one.normal_force(U, E), E, 200.0) for U in (0j, one.balancing_imbalance(E))]
    assert rates[0] == pytest.approx(79.4 / 200, abs=1e-3)
    assert rates[1] / rates[0] == pytest.approx(2 * math.cos(math.atan(0.35)) ** 2, rel=0.02)
    assert abs(one.normal_force(0j, E)) == pytest.approx(79.4, abs=0.05)


def test_capacity_as_printed_is_the_limit_far_above_resonance():
    """m₀e + Mε: 324.0 against 320.1 g·mm, the worst over φ₀."""
    needs = [abs(contact().balancing_imbalance(cmath.rect(EPS, math.radians(a))) - OWN) for a in range(0, 360)]
    assert 1e6 * max(needs) == pytest.approx(320.1, abs=0.5)


# Stability.
def test_slow_stiffness_of_two_balls():
    """κ(1 ± √(C² − f²S²)), κ = 560.7237 1/s², at all angles; J s² + h₀ s + K from the matrix itself."""
    kappa = BALL * W**4 / (2 * M * (W**2 - 80.0**2))
    assert kappa == pytest.approx(560.7237, abs=1e-4)
    G = contact(0.35).whirl_per_imbalance
    for apart in np.linspace(0.1, 3.0, 9):
        matrix = [[kappa * (math.cos(b - a) - 0.35 * math.sin(b - a)) for b in (0, apart)] for a in (0, apart)]
        found = loaded_stiffness(G, BALL, W, 2, abs(1 + cmath.exp(2j * apart)))
        wanted = np.linalg.eigvals(matrix).astype(complex)
        assert sorted(found, key=lambda k: (k.real, k.imag)) == pytest.approx(
            sorted(wanted.tolist(), key=lambda k: (k.real, k.imag)), abs=1e-6 * kappa
        )


@pytest.mark.slow
@given(st.lists(st.floats(0, 6.28), min_size=2, max_size=7), st.floats(-0.8, 0.8), st.floats(1e4, 1e8))
def test_slow_stiffness_of_any_balls(angles, friction, stiffness):
    """The two eigenvalues of −mΩ² Re[G e^{i(Θ_j − Θ_k)}] that are not neutral."""
    G = contact(friction, stiffness).whirl_per_imbalance
    turned = np.exp(1j * np.array(angles))
    matrix = -BALL * W**2 * (G * np.outer(turned.conj(), turned)).real
    found = loaded_stiffness(G, BALL, W, len(angles), abs((turned**2).sum()))
    scale = float(np.abs(matrix).max()) * len(angles)
    assert sum(found) == pytest.approx(np.trace(matrix), abs=1e-9 * scale)
    assert sum(k**2 for k in found) == pytest.approx(np.trace(matrix @ matrix), abs=1e-9 * scale**2)


def test_flutter_limit_at_right_angles():
    """8.2879 1/s for f = 0.35, 11.84 for 0.5, J = 1; the roots of J s² + h₀ s + k change sides there."""
    for friction, limit in ((0.35, 8.2879), (0.5, 11.84)):
        ks = loaded_stiffness(contact(friction).whirl_per_imbalance, BALL, W, 2, 0.0)
        found = flutter_drag(ks, 1.0)
        assert found == pytest.approx(limit, abs=1e-4 if limit < 9 else 5e-3)
        for drag, grows in ((0.99 * found, True), (1.01 * found, False)):
            roots = np.concatenate([np.roots([1.0, drag, k]) for k in ks])
            assert (roots.real.max() > 0) == grows


def test_no_flutter_where_balls_are_nearly_opposite():
    """As printed, (7), needs nothing: true here, wrong at right angles above."""
    ks = loaded_stiffness(contact(0.35).whirl_per_imbalance, BALL, W, 2, abs(1 + cmath.exp(2j * math.radians(141))))
    assert flutter_drag(ks, 1.4) == 0
    assert flutter_drag((complex(-1), complex(2)), 1.0) == math.inf


def test_regions_of_stiffness_are_where_signs_change():
    first, second = stiffness_regions(D)
    assert (first, second) == pytest.approx((1.985e6, 4.015e6), abs=1e3)
    for stiffness in np.geomspace(1e5, 1e8, 60):
        one = contact(0.0, float(stiffness))
        assert (one.whirl_per_imbalance.real < 0) == (not first < stiffness < second)
        pressure = -1j * one.normal_force(one.balancing_imbalance(E), E)
        assert ((pressure * E.conjugate()).real > 0) == (stiffness < second)
        without = -1j * one.normal_force(0j, E)
        assert ((without * E.conjugate()).real > 0) == (stiffness < first)


# Curves and bounds.
def test_hodograph_far_above_resonance():
    """r² = A² + B² + 2AB cos(φ₀ − s(π/2 + δ)): largest 90° + δ against rotation for s = −1; no cardioid."""
    moved, f, s = 17.9e-6, 0.35, -1
    A, B, delta = moved * math.hypot(1, f), f * EPS, math.atan(f)
    for angle in np.linspace(0, 2 * math.pi, 37):
        wanted = math.sqrt(A**2 + B**2 + 2 * A * B * math.cos(angle - s * (math.pi / 2 + delta)))
        found = hodograph_limit(moved, cmath.rect(EPS, angle), s * f)
        assert found == pytest.approx(wanted)
        assert abs(contact(s * f).axis(M * moved, cmath.rect(EPS, angle))[0]) == pytest.approx(found, abs=1e-6)
    angles = np.radians(np.arange(-180, 180))
    worst = max(angles, key=lambda angle: hodograph_limit(moved, cmath.rect(EPS, angle), s * f))
    assert math.degrees(worst) == pytest.approx(-(90 + math.degrees(delta)), abs=0.6)


def test_largest_runout_without_parting():
    """100 N: 50.4 µm with fixed balls, 24.9 µm with free ones, friction left out."""
    one = contact()
    fixed = largest_factor(one.normal_force(0j, 1.0), 0j, 100.0)
    free = largest_factor(one.normal_force(one.balancing_imbalance(1.0), 1.0), 0j, 100.0)
    assert fixed is not None
    assert free is not None
    assert 1e6 * fixed == pytest.approx(50.4, abs=0.05)
    assert 1e6 * free == pytest.approx(24.9, abs=0.05)


@pytest.mark.slow
@given(*(st.complex_numbers(max_magnitude=10, allow_nan=False) for _ in range(2)), st.floats(0.1, 20))
def test_largest_factor_is_the_last(slope, offset, limit):
    found = largest_factor(slope, offset, limit)
    if found is None:
        assert abs(slope) < 1e-300 or abs(offset) > limit
        return
    if abs(slope) > 1e-6:
        assert abs(slope * found + offset) == pytest.approx(limit)
        assert abs(slope * found * 1.01 + offset) >= limit * (1 - 1e-9)


def test_runout_rate_is_bounded_by_any_force():
    """|dε/ds| ≤ 2 for every force that only presses: here bumps of random shape."""
    random = np.random.default_rng(5)
    turn = np.arange(720) * 2 * math.pi / 720
    rates = []
    for width in (0.01, 0.3, 3.0):
        force = np.exp(-(((turn - random.uniform(0, 6)) / width) ** 2))
        pressure = complex(2 * np.mean(force * np.exp(1j * turn)))
        rates.append(abs(runout_rate(pressure, cmath.rect(1e-5, 1.0), float(force.mean()))))
    assert max(rates) <= 2
    assert all(a != b for a, b in pairwise(rates))


# Balls of finite mass.
@pytest.mark.parametrize(
    ("count", "fan", "ball", "inertia", "zeta", "drag", "speed"),
    [
        (2, 0.0, 0.005, 1.4, 0.01, 0.01, 1.318823),
        (2, 0.5, 0.005, 1.0, 0.01, 0.01, 1.320171),
        (4, 0.0, 0.005, 1.4, 0.02, 0.05, 1.376846),
        (8, 0.0, 0.002, 1.4, 0.002, 0.02, 1.373689),
    ],
)
def test_boundaries_of_stability_are_the_published_ones(count, fan, ball, inertia, zeta, drag, speed):
    """Idle, equal axes, M = k = 1: roots grow just below the speed, none just above; ±90°, or a fan of two."""
    doubled = count * abs(math.cos(2 * math.acos(fan))) if count == 2 else float(count)
    idle = SteadyContact(1.0, (1.0, 1.0), 1.0, 0.0, 0.0)
    balls = BallArrangement(count, ball, doubled, inertia, drag)

    def growing(at: float) -> int:
        def whirl(w: complex) -> complex:
            return idle.whirl_at(w, (1 + 2j * zeta * w - w**2,) * 2)

        return growing_roots(lambda s: characteristic(whirl, balls, at, s), at)

    assert growing(speed * (1 - 2e-4)) > 0
    assert growing(speed * (1 + 2e-4)) == 0


@pytest.mark.slow
@given(st.lists(st.complex_numbers(max_magnitude=3.5, allow_nan=False), min_size=2, max_size=2))
def test_growing_roots_are_counted(roots):
    """Of a real polynomial of fourth order with known roots."""
    if any(abs(root.real) < 0.02 for root in roots):
        return
    real = np.poly([*roots, *(root.conjugate() for root in roots)]).real
    assert growing_roots(lambda s: complex(np.polyval(real, s)), 1.0) == 2 * sum(root.real > 0 for root in roots)
