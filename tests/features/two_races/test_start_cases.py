"""Start cases against equations of four freedoms and eight or more balls that are integrated here."""

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from abu_calc.dynamics.scene import Scene, without
from abu_calc.features.two_races import start_cases as start_cases_module
from abu_calc.features.two_races.case import read_case
from abu_calc.features.two_races.checks import _lost_in_words
from abu_calc.features.two_races.choice import TwoRaceDesign, choose_both
from abu_calc.features.two_races.start_cases import (
    MOST_ONE,
    MOST_WORK,
    LostRun,
    StartCase,
    TwoRaceRun,
    all_work,
    quiet_time,
    rest_time,
    revolution_times,
    run_of,
    runs_of,
    scene_of,
    settling_time,
    start_cases,
    wheels_share,
)
from abu_calc.foundation import patience
from abu_calc.foundation.errors import ChaoticError
from abu_calc.foundation.progress import silent
from abu_calc.foundation.units import velocity_from_level
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.simulate import Simulation, simulate

TRUE = (
    *(f"autobalancer.{k}.race_eccentricity_mm=0.0" for k in (0, 1)),
    *(f"autobalancer.{k}.rolling_friction_mm=0.0" for k in (0, 1)),
    'machine.spindle_axis="vertical"',
)


@cache
def design_of(*overrides: str) -> TwoRaceDesign:
    tables = read_machine("pedestal-grinder", overrides).two_races
    assert tables is not None
    return choose_both(read_case(tables))


@pytest.mark.slow
def test_start_cases_cover_phases_starts_and_oils() -> None:
    cases = list(start_cases(design_of()))
    assert {case.start for case in cases} == {"bunched", "spread", "standstill", "run-up"}
    assert {case.phases for case in cases if case.drag_factor == 1} == {(phase * math.pi / 2,) for phase in range(4)}
    assert {case.drag_factor for case in cases} == {1.0, 1 / 3, 3.0}


@pytest.mark.slow
def test_what_the_scene_turns_is_what_the_wheels_have() -> None:
    design = design_of()
    start = StartCase("spread", 1.0, (math.pi / 2,))
    scene = scene_of(design, start)
    force = scene.imbalance * np.exp(1j * scene.imbalance_angle)
    moment = scene.couple * np.exp(1j * scene.couple_angle)
    assert force == pytest.approx(2500e-6 + 1800e-6j, rel=1e-9)
    assert moment == pytest.approx(0.26 * 2500e-6 - 0.26j * 1800e-6, rel=1e-9)
    for race, place in enumerate((0.3, -0.3)):
        share = wheels_share(design, race, start)
        assert abs(share - (force / 2 + moment / (2 * place))) < 1e-12


@pytest.mark.slow
def test_both_races_end_where_the_levers_say() -> None:
    """Without friction, eccentricity and gravity the balls' resultants are exactly opposite what the races carry."""
    design = design_of(*TRUE)
    run = run_of(design, StartCase("spread", 1.0, (math.radians(130),)), 0.01)
    assert isinstance(run, TwoRaceRun)
    assert run.balances
    assert run.slip < 1e-3
    for end, bare in zip(run.displacements, run.displacements_without, strict=True):
        assert end < 0.02 * bare


@pytest.mark.slow
def test_settling_agrees_with_an_own_integration() -> None:
    """Lagrange's equations of x, y, two tilts and all balls, integrated by DOP853 in space-fixed angles.

    Balls pass each other there and do not move along the spindle, so contact and axial inertia are left out on both
    sides. Races without eccentricity and friction end with no residual imbalance at all: the limit is a tenth of it.
    """
    design = design_of(*TRUE)
    start = StartCase("spread", 1.0, (math.radians(130),))
    ours = without(scene_of(design, start), ["ball_contact"])
    ours = replace(ours, support=replace(ours.support, axial_inertia=False))
    case, scene = design.case, scene_of(design, start)
    W, J, rotor = case.speed, case.inertia_factor, case.rotor
    z = np.concatenate([[race.plane_offset] * len(race.ball_masses) for race in scene.races])
    m = np.concatenate([race.ball_masses for race in scene.races])
    R = np.concatenate([[race.pitch_radius] * len(race.ball_masses) for race in scene.races])
    h = np.concatenate([[race.drag] * len(race.ball_masses) for race in scene.races])
    gamma = np.concatenate([race.start_angles for race in scene.races])
    n = len(m)
    k = sum(b.stiffness for b in rotor.bearings)
    kt = sum(b.stiffness * b.place**2 for b in rotor.bearings)
    c, ct = sum(b.damping for b in rotor.bearings), sum(b.damping * b.place**2 for b in rotor.bearings)
    static = sum(w.imbalance for w in case.turned((0.0, math.radians(130))))
    couple = sum(w.place * w.imbalance for w in case.turned((0.0, math.radians(130))))

    def rhs(t: float, s: np.ndarray) -> np.ndarray:
        x, y, p, q = s[:4]
        vx, vy, vp, vq = s[4:8]
        a, w = s[8 : 8 + n], s[8 + n :]
        A = np.zeros((4 + n, 4 + n))
        A[0, 0] = A[1, 1] = rotor.mass + m.sum()
        A[2, 2] = A[3, 3] = rotor.transverse_inertia + (m * z**2).sum()
        A[0, 2] = A[2, 0] = A[1, 3] = A[3, 1] = (m * z).sum()
        cos, sin = np.cos(a), np.sin(a)
        A[0, 4:], A[1, 4:] = -m * R * sin, m * R * cos
        A[2, 4:], A[3, 4:] = -m * z * R * sin, m * z * R * cos
        A[4:, :4] = A[:4, 4:].T
        A[range(4, 4 + n), range(4, 4 + n)] = J * m * R**2
        turn = np.exp(1j * W * t)
        F, M = W**2 * static * turn, W**2 * couple * turn
        b = np.zeros(4 + n)
        G = rotor.polar_inertia * W
        b[0] = F.real + (m * R * w**2 * cos).sum() - k * x - c * vx
        b[1] = F.imag + (m * R * w**2 * sin).sum() - k * y - c * vy
        b[2] = M.real + (m * z * R * w**2 * cos).sum() - kt * p - ct * vp - G * vq
        b[3] = M.imag + (m * z * R * w**2 * sin).sum() - kt * q - ct * vq + G * vp
        b[4:] = -m * R**2 * h * (w - W)
        return np.concatenate([s[4:8], np.linalg.solve(A, b)[:4], w, np.linalg.solve(A, b)[4:]])

    first = np.concatenate([np.zeros(8), gamma, np.full(n, W)])
    times = revolution_times(ours)
    until = times[times <= 1.0]
    own = solve_ivp(rhs, (0, 1.0), first, "DOP853", until, rtol=1e-8, atol=1e-11)
    states = simulate(ours, 0.001, times).trajectory.at(times)
    turned = own.y[8 : 8 + n] - W * own.t
    assert np.abs(turned - states[8 : 8 + n, : len(until)]).max() < 2e-6
    settled, counts = 0.0, [len(race.ball_masses) for race in scene.races]
    for race, inside in enumerate((slice(0, counts[0]), slice(counts[0], n))):
        need = wheels_share(design, race, start)
        left = np.abs(need + (m[inside] * R[inside]) @ np.exp(1j * turned[inside]))
        assert left[-1] < 0.03 * abs(need)
        settled = max(settled, until[np.flatnonzero(left > 0.1 * abs(need))[-1] + 1])
    needs = wheels_share(design, 0, start), wheels_share(design, 1, start)
    assert settling_time(ours, states, needs) == pytest.approx(settled, abs=1e-9)
    # Nothing is left, so that |U − U_end| is |U|: they rest when that has settled, between two samples.
    assert rest_time(ours, states, needs) == pytest.approx(settled, abs=until[1])
    # A turn of the velocity at each place, less its mean and the change since the turn before.
    limit, without_balls = velocity_from_level(case.table.limits.vibration_level_db), 2e-4
    limit, until_quiet = min(limit, without_balls * W / math.sqrt(2)), 0
    for held in case.places:
        for axis in (0, 1):
            rate = own.y[4 + axis] + held.place * own.y[6 + axis]
            for k in range(16, len(rate)):
                turn = rate[k - 15 : k + 1]
                trend = (rate[k] - rate[k - 16]) / 16 * (np.arange(16) - 7.5)
                if math.sqrt(np.mean((turn - turn.mean() - trend) ** 2)) > limit:
                    until_quiet = max(until_quiet, k)
    assert 16 < until_quiet < len(until) - 2
    assert quiet_time(ours, states, case, without_balls) == pytest.approx(until[until_quiet], abs=2 * until[1])
    # Balls that move along the spindle with their tilting race, as start cases have them, change next to nothing.
    leaning = scene_of(design, start)
    assert leaning.support.axial_inertia
    leaning = without(leaning, ["ball_contact"])
    moved = simulate(leaning, 0.001, times).trajectory.at(times)
    assert np.abs(moved - states)[8 : 8 + n].max() < 2e-4


def test_what_fails_is_told() -> None:
    lost = LostRun(StartCase("bunched"), "because")
    assert lost.case.name == "bunched"
    assert StartCase("bunched", 1.0, (math.pi,)).name == "bunched, phase 180°"


@pytest.mark.parametrize(("doubt", "counts"), [(0.1, True), (0.5, False)])
@pytest.mark.slow
def test_chaotic_runs_that_all_end_balanced_count_with_their_doubt(
    monkeypatch: pytest.MonkeyPatch, doubt: float, counts: bool
) -> None:
    """Times and displacements of the finest run, times one and the difference of the runs."""
    design, case = design_of(), StartCase("spread", 1.0, (0.0,))
    calm = run_of(design, case, 0.05)
    assert isinstance(calm, TwoRaceRun)

    def chaotic(scene: Scene, accuracy: float, times: Any, _work: int | None) -> Simulation:
        failure = ChaoticError("idle: the motion is chaotic")
        failure.ended = replace(simulate(scene, accuracy, times), error_estimate=doubt)
        raise failure

    monkeypatch.setattr(start_cases_module, "simulate", chaotic)
    run = run_of(design, case, 0.05)
    assert isinstance(run, TwoRaceRun) is counts
    if isinstance(run, TwoRaceRun):
        assert calm.settling_time and calm.quiet_time and calm.rest_time
        assert run.settling_time == pytest.approx(1.1 * calm.settling_time)
        assert run.quiet_time == pytest.approx(1.1 * calm.quiet_time)
        assert run.rest_time == pytest.approx(1.1 * calm.rest_time)
        assert run.displacements == pytest.approx([1.1 * each for each in calm.displacements])


def test_reasons_of_lost_start_cases_are_told_apart() -> None:
    lost = [
        LostRun(StartCase("spread", 1.0, (0.0,), 157.08), "the accuracy is not reached. The motion is chaotic: 1e-09"),
        LostRun(StartCase("bunched"), "the time of --patience is over"),
    ]
    text, action = _lost_in_words(lost, 80)
    assert text.startswith("2 of 80 start cases gave no answer. 1 ran out of time; 1 is chaotic")
    assert "spread, phase 0°, 1500 rpm" in text
    assert "--patience" in action and "--accuracy" not in action and "not tried" in action


def test_start_cases_end_where_all_together_have_taken_the_work(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is left is counted after each four, so that workers change nothing; the rest is lost, and says so."""
    design, given = design_of(), list[int]()
    starts = list(start_cases(design))

    def dear(_: TwoRaceDesign, start: StartCase, _accuracy: float, work: int) -> LostRun:
        given.append(work)
        return LostRun(start, "more work than allowed", work, short=True)

    monkeypatch.setattr(start_cases_module, "run_of", dear)
    runs = list(runs_of(design, 0.05, silent, 1, 2 * MOST_ONE))
    assert [run.case for run in runs] == starts and given == [MOST_ONE] * 4
    assert list(runs_of(design, 0.05, silent, 3, 2 * MOST_ONE)) == runs
    text, action = _lost_in_words([run for run in runs if isinstance(run, LostRun)], len(runs))
    assert (
        f"4 would take more work than allowed; {len(starts) - 4} were not tried" in text and "--patience 600" in action
    )


def test_patience_lifts_the_bound_of_work() -> None:
    assert all_work() == MOST_WORK
    with patience.limited(60.0):
        assert all_work() > 1000 * MOST_WORK
