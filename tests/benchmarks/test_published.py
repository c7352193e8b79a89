"""Published statements worked out again: against hand calculations and against each other."""

import json
import math
import subprocess
import sys

import numpy as np
import pytest

from tests.benchmarks.published import ramps, routh, runs, stiction, stuck, two_planes
from tests.house.structure import ROOT


def test_routh_tells_stable_polynomials_from_unstable_ones() -> None:
    random = np.random.default_rng(7)
    for _ in range(200):
        roots = random.uniform(-2, 0.5, 3) + 1j * random.uniform(0.1, 3, 3)
        coefficients = np.poly([*roots, *roots.conj()]).real
        assert (min(routh.first_column(coefficients)) > 0) == bool(roots.real.max() < 0)


def test_the_polynomial_has_the_roots_of_a_rotor_without_coupling() -> None:
    # With nearly no mass the balls (s = 0, −h₀ twice) and the rotor (s ± iΩ = −ζ ± i) part.
    roots = np.roots(routh.polynomial(2.0, 1e-12, 1e-12, 0.1, 0.3))
    lost, own = 0.1, math.sqrt(1 - 0.01)
    wanted = [0, 0, -0.3, -0.3, *(-lost + 1j * (side * 2.0 + way * own) for side in (1, -1) for way in (1, -1))]
    for value in wanted:
        assert np.abs(roots - value).min() < 1e-4


@pytest.mark.slow
def test_stability_changes_where_the_list_of_reference_numbers_says() -> None:
    assert routh.changes(0.01) == pytest.approx([1.40154], abs=1e-5)
    assert routh.changes(0.05) == pytest.approx([1.02969, 1.09363, 1.88224], abs=1e-5)


@pytest.mark.slow
def test_stuck_speeds_number_one_three_three_one_on_one_axis() -> None:
    at = stuck.speeds()
    found = stuck.ranges(at, stuck.curve(at))
    assert [(row.count, row.below) for row in found] == list(stuck.PUBLISHED)
    # By hand, one axis: h₀(Ω − ν)·n m = n m·(n m) c ν⁶/(2 |1 − ν² + i c ν|²) per rad/s, M_t = k = R = 1.
    speed, balls, c = 2.0, 2 * stuck.MASS, 2 * stuck.DAMPING
    for nu in stuck.curve([speed])[0]:
        brakes = balls * c * nu**5 / (2 * ((1 - nu**2) ** 2 + (c * nu) ** 2))
        assert stuck.DRAG * (speed - nu) == pytest.approx(brakes, rel=1e-3)


def test_simulated_stuck_speeds_deviate_in_the_ratio_of_the_masses() -> None:
    small, large = stuck.deviation(0.005), stuck.deviation(0.02)
    assert small.closed == pytest.approx(large.closed, rel=1e-6)
    assert small.share == pytest.approx(large.share, rel=0.2) and 0 < small.share < 1


def test_run_up_decides_in_one_set_and_not_in_the_other(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ramps, "GRID", 4)
    decides, ignored = ramps.SETS.values()
    assert ramps.share(decides, 0.0) - ramps.share(decides, 30.0) > 0.3
    assert ramps.share(ignored, 0.0) == ramps.share(ignored, 30.0) == 1.0


def test_friction_scatters_what_balances_without_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stiction, "GRID", 3)
    smooth, rough = stiction.ends(0.0, None).left, stiction.ends(0.005, None).left
    assert smooth[-1] < 1e-3 < 0.05 < rough[-1] - rough[0]


def test_imbalance_left_is_that_of_the_end() -> None:
    # Nothing drives light balls at rest on a balanced axis: they stay where they are.
    scene = runs.rotor(3.0, 1e-9, 1e-9, 0.1, 1.0, (0.0, math.pi / 2), 3.0)
    left, rate = runs.left_over(scene)
    assert left == pytest.approx(abs(1 + 1 + 1j), rel=1e-6) and rate < 1e-6


def test_two_planes_start_as_newtons_law_says() -> None:
    speed, state = 4.0, np.zeros(16)
    static = speed**2 * two_planes.ECCENTRICITY
    state[4:8] = two_planes.STARTS
    slope = two_planes.rhs(0.0, state, speed)
    # At the start balls at ± 90° cancel in pairs, so only imbalance and couple act; balls answer by x'' sin γ and tilt.
    sine = np.sin(two_planes.STARTS)
    assert slope[12:] == pytest.approx(sine * slope[8] + two_planes.PLANES * sine * slope[11], rel=1e-9)
    force = static * math.cos(two_planes.PHASE)
    assert slope[8] * (1 + 4e-4) - 1e-4 * (sine * slope[12:]).sum() == pytest.approx(force, rel=1e-9)


@pytest.mark.slow
def test_the_module_prints_json_and_refuses_what_it_does_not_know() -> None:
    command = [sys.executable, "-m", "tests.benchmarks.published"]
    seen = subprocess.run([*command, "two-planes"], cwd=ROOT, capture_output=True, text=True, check=True)
    assert len(json.loads(seen.stdout)["largest"]) == len(two_planes.SPEEDS)
    wrong = subprocess.run([*command, "three-planes"], cwd=ROOT, capture_output=True, text=True, check=False)
    assert wrong.returncode == 1 and "two-planes" in wrong.stderr


@pytest.mark.hard
def test_the_record_of_two_planes_is_made_again() -> None:
    record = json.loads(two_planes.RECORD.read_text("utf-8"))["largest"]["6.0"]
    assert two_planes.largest(6.0) == pytest.approx(record, rel=1e-4)
