"""Start cases against equations of four freedoms and eight or more balls that are integrated here."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from abu_calc.dynamics.scene import without
from abu_calc.features.spindle.case import SpindleDesign, size_races
from abu_calc.features.spindle.start_cases import (
    FIRST_TOLERANCE,
    OF_BAND,
    OF_USUAL,
    StartOutcome,
    ensemble_of,
    imbalances_left,
    race_needs,
    references,
    rest_time,
    revolution_times,
    scene_of,
    settling_time,
    start_cases,
    start_of,
    start_once,
)
from abu_calc.foundation import patience
from abu_calc.foundation.progress import silent
from abu_calc.foundation.units import velocity_from_level
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation import ensemble as ensemble_module
from abu_calc.simulation.ensemble import MOST_MORE, TOLERANCE, WORK, Runner, simulate_starts
from abu_calc.simulation.response import evaluate
from abu_calc.simulation.simulate import simulate
from abu_calc.simulation.start_cases import Lost, Member, Variation
from abu_calc.sizing.vibration import LEVEL_ERROR

TRUE = (
    *(f"autobalancer.{k}.race_eccentricity_mm=0.0" for k in (0, 1)),
    *(f"autobalancer.{k}.rolling_friction_mm=0.0" for k in (0, 1)),
    'machine.spindle_axis="vertical"',
)


SOFT = {"stiffness_N_per_m": 2.0, "damping_N_s_per_m": 0.01}


@cache
def design_of(*overrides: str) -> SpindleDesign:
    return size_races(read_machine("pedestal-grinder", overrides))


@pytest.mark.slow
def test_start_cases_cover_phases_starts_and_oils() -> None:
    design = design_of()
    cases = list(start_cases(design))
    nominal = [case for case in cases if case.at_nominal]
    assert {case.start for case in cases} == {"bunched", "spread", "standstill"} and any(case.run_up for case in cases)
    assert {case.phases for case in nominal} == {(phase * math.pi / 2,) for phase in range(4)}
    of_band = [case for case in cases if case.varied != Variation()]
    assert {case.drag / design.case.drag for case in cases if case not in of_band} == {1.0, 1 / 3, 3.0}
    assert [case.promised for case in of_band] == [True] * OF_BAND + [False] * OF_USUAL
    usual = of_band[OF_BAND:]
    assert all(0.3 <= case.varied.friction_arm <= 2 for case in usual)
    assert all(1 / 3 <= case.drag / design.case.drag <= 3 for case in usual)
    assert all(0.95 <= (case.speed or 0) / design.case.speed <= 1.05 for case in usual)
    assert all(0 <= case.varied.race_eccentricity <= 1 and 0.1 <= case.varied.imbalance <= 1 for case in of_band)


@pytest.mark.slow
def test_a_varied_start_is_that_of_a_file_with_those_values_judged_by_the_first_one() -> None:
    """A truer race and lighter imbalances: the same motion as of a file that gives them, but other limits."""
    varied = Variation(0.5, 0.25)
    design, lighter = design_of(), design_of(
        "wheel.0.imbalance_g_mm=625.0", "wheel.1.imbalance_g_mm=450.0",
        *(f"autobalancer.{k}.race_eccentricity_mm=0.005" for k in (0, 1)),
    )  # fmt: skip
    assert design.case.eccentricity == pytest.approx(1e-5)
    ours = scene_of(design, start_of(design, "spread", (1.0,), varied=varied))
    same = replace(design, case=replace(lighter.case, rotor=design.case.rotor, races=design.case.races))
    other = scene_of(same, start_of(same, "spread", (1.0,)))
    assert (ours.imbalance, ours.couple) == pytest.approx((other.imbalance, other.couple), rel=1e-12)
    assert ours.effects == other.effects and ours.races == other.races
    outcome = start_once(design, start_of(design, "spread", (1.0,), varied=varied), 0.05, TOLERANCE, WORK)
    whole = start_once(design, start_of(design, "spread", (1.0,)), 0.05, TOLERANCE, WORK)
    assert isinstance(outcome, StartOutcome) and isinstance(whole, StartOutcome)
    assert {outcome.allowed, outcome.moved} <= {
        number
        for race in (0, 1)
        for need in [abs(race_needs(design, start_of(design, "spread", (1.0,)))[race])]
        for number in (need, need / 2)
    }


@pytest.mark.slow
def test_what_the_scene_turns_is_what_the_wheels_have() -> None:
    design = design_of()
    member = start_of(design, "spread", (math.pi / 2,))
    scene = scene_of(design, member)
    force = scene.imbalance * np.exp(1j * scene.imbalance_angle)
    moment = scene.couple * np.exp(1j * scene.couple_angle)
    assert force == pytest.approx(2500e-6 + 1800e-6j, rel=1e-9)
    assert moment == pytest.approx(0.26 * 2500e-6 - 0.26j * 1800e-6, rel=1e-9)
    for race, place in enumerate((0.3, -0.3)):
        share = race_needs(design, member)[race]
        assert abs(share - (force / 2 + moment / (2 * place))) < 1e-12


@pytest.mark.slow
def test_both_races_end_where_the_levers_say() -> None:
    """Without friction, eccentricity and gravity the balls' resultants are exactly opposite what the races carry."""
    design = design_of(*TRUE)
    run = start_once(design, start_of(design, "spread", (math.radians(130),)), 0.05, 0.1 * TOLERANCE, WORK)
    assert isinstance(run, StartOutcome)
    assert run.balanced
    assert run.slip < 1e-3
    wheels = design.case.turned((0.0, math.radians(130)))
    for end, held in zip(run.displacements, design.case.places, strict=True):
        assert end < 0.02 * abs(design.case.rotor.whirl(held.place, wheels, design.case.speed))


@pytest.mark.slow
def test_settling_agrees_with_an_own_integration() -> None:
    """Lagrange's equations of x, y, two tilts and all balls, integrated by DOP853 in space-fixed angles.

    Balls pass each other there and do not move along the spindle, so contact and axial inertia are left out on both
    sides. Races without eccentricity and friction end with no residual imbalance at all: the limit is a tenth of it.
    """
    design = design_of(*TRUE)
    member = start_of(design, "spread", (math.radians(130),))
    ours = without(scene_of(design, member), ["ball_contact"])
    ours = replace(ours, support=replace(ours.support, axial_inertia=False))
    case, scene = design.case, scene_of(design, member)
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
    limit = min(velocity_from_level(case.table.limits.vibration_level_db), 2e-4 * W / math.sqrt(2))
    ours = replace(ours, quiet_velocity=limit)
    run = simulate(ours, 0.001, times)
    states = run.trajectory.at(times)
    turned = own.y[8 : 8 + n] - W * own.t
    assert np.abs(turned - states[8 : 8 + n, : len(until)]).max() < 2e-6
    settled, counts = 0.0, [len(race.ball_masses) for race in scene.races]
    for race, inside in enumerate((slice(0, counts[0]), slice(counts[0], n))):
        need = race_needs(design, member)[race]
        left = np.abs(need + (m[inside] * R[inside]) @ np.exp(1j * turned[inside]))
        assert left[-1] < 0.03 * abs(need)
        settled = max(settled, until[np.flatnonzero(left > 0.1 * abs(need))[-1] + 1])
    needs = race_needs(design, member)
    left, small = imbalances_left(ours, states, needs), references(ours, needs)
    assert settling_time(ours, left, small) == pytest.approx(settled, abs=1e-9)
    # Nothing is left, so that |U − U_end| is |U|: they rest when that has settled, between two samples.
    assert rest_time(ours, left, small) == pytest.approx(settled, abs=until[1])
    # A turn of the velocity at each place, less its mean and the change since the turn before.
    until_quiet = 0
    for held in case.places:
        for axis in (0, 1):
            rate = own.y[4 + axis] + held.place * own.y[6 + axis]
            for k in range(16, len(rate)):
                turn = rate[k - 15 : k + 1]
                trend = (rate[k] - rate[k - 16]) / 16 * (np.arange(16) - 7.5)
                if math.sqrt(np.mean((turn - turn.mean() - trend) ** 2)) > limit:
                    until_quiet = max(until_quiet, k)
    assert 16 < until_quiet < len(until) - 2
    assert evaluate(ours, run.trajectory).quiet_time == pytest.approx(until[until_quiet], abs=2 * until[1])
    # Balls that move along the spindle with their tilting race, as start cases have them, change next to nothing.
    leaning = scene_of(design, member)
    assert leaning.support.axial_inertia
    leaning = without(leaning, ["ball_contact"])
    moved = simulate(leaning, 0.001, times).trajectory.at(times)
    assert np.abs(moved - states)[8 : 8 + n].max() < 2e-4


def test_names_of_start_cases() -> None:
    design = design_of()
    assert start_of(design, "bunched", (math.pi,)).name == "bunched, phase 180°"
    assert start_of(design, "run-up", (0.0,), speed=157.08).name == "run-up in 1 s (1500 rpm), phase 0°"


def test_a_start_that_no_two_runs_repeat_is_judged_by_the_worse_of_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """Chaotic starts: each run counts by its end, and the slowest of all is run once more."""
    design = design_of()
    times, run = iter(range(1000)), StartOutcome(
        start_of(design), 0.1, 0.1, 0.1, False, 1e-5, 90.0, 0.0, 1e-6, 1e-5, displacements=(1e-5, 1e-5)
    )  # fmt: skip
    tolerances = []

    def chaotic(_design: object, member: object, _accuracy: float, tolerance: float, *_: object) -> StartOutcome:
        tolerances.append(tolerance)
        return replace(run, member=member, quiet_time=0.01 * (next(times) % 7 + 1))  # type: ignore[arg-type]

    runner = ensemble_module.Runner(chaotic, lambda design, member, _: scene_of(design, member))
    starts = list(start_cases(design))
    found = ensemble_module.simulate_starts(design, starts, 0.05, TOLERANCE, silent, 1, runner)
    assert found.members == len(starts) and not found.lost
    assert len(tolerances) > len(starts) and set(tolerances) == {TOLERANCE, ensemble_module.TIGHTER * TOLERANCE}
    assert max(found.outcomes, key=lambda outcome: outcome.quiet_time_or_inf).confirmed


def test_a_start_without_an_answer_says_why() -> None:
    design = design_of()
    lost = start_once(design, start_of(design), 0.05, TOLERANCE, 10)
    assert isinstance(lost, Lost) and lost.short and lost.reason


@pytest.mark.slow
def test_chaotic_starts_take_no_more_work_than_others() -> None:
    """A lightly damped pedestal: runs at two tolerances do not agree, which once took 20 times the work."""
    soft = ("suspension.bearing_damping_N_s_per_m=[30.0, 30.0]", "machine.mass_kg=60.0")
    ensemble = ensemble_of(design_of(*soft), 0.05, silent, 1)
    assert not ensemble.lost and ensemble.balanced == ensemble.members
    assert ensemble.work < 10 * WORK


@pytest.mark.slow
def test_the_answer_does_not_depend_on_workers() -> None:
    design = design_of()
    assert ensemble_of(design, 0.05, silent, 3) == ensemble_of(design, 0.05, silent, 1)


def test_a_start_that_ends_early_is_judged_as_the_whole_one() -> None:
    """Times are final once nothing moves; the level is that of the end within what no check decides by."""
    design = design_of()
    ended = 0
    for member in list(start_cases(design))[::9]:
        short, whole = (start_once(design, member, 0.05, FIRST_TOLERANCE, early_end=early) for early in (True, False))
        assert isinstance(short, StartOutcome) and isinstance(whole, StartOutcome)
        assert (short.balanced, short.creeping, short.hanging) == (whole.balanced, whole.creeping, whole.hanging)
        assert short.quiet_time == whole.quiet_time
        assert short.rest_time == pytest.approx(whole.rest_time, rel=0.01)
        assert short.level == pytest.approx(whole.level, abs=2 * LEVEL_ERROR)
        assert short.imbalance == pytest.approx(whole.imbalance, abs=0.01 * whole.moved)
        ended += short.work < 0.8 * whole.work
    assert ended >= 3


def test_no_start_is_begun_after_the_work_of_all(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nor confirmed: what others have spent is told for each."""
    design, begun = design_of(), list[str]()

    def dear(_: object, member: Member, *given: object) -> StartOutcome | Lost:
        begun.append(member.name)
        return Lost(member, "more work than allowed", MOST_MORE // 10)

    runner = Runner(dear, lambda design, member, _: scene_of(design, member), MOST_MORE // 4)
    found = simulate_starts(design, list(start_cases(design)), 0.05, FIRST_TOLERANCE, silent, 1, runner)
    assert len(begun) == 2 and found.outcomes == ()
    reasons = {lost.reason for lost in found.lost}
    assert reasons == {
        "more work than allowed", "not tried, since others took all the work allowed",
        "not tried, since others gave no answer",
    }  # fmt: skip
    with patience.limited(600):
        simulate_starts(design, list(start_cases(design))[:6], 0.05, FIRST_TOLERANCE, silent, 1, runner)
    assert len(begun) == 2 + 6


def test_a_scene_of_few_turns_is_run_to_its_end() -> None:
    """At 30 rpm it has four: nothing is judged by parts of a turn."""
    soft = *(f"suspension.bearing_{what}=[{value}, {value}]" for what, value in SOFT.items()), "machine.speed_rpm=30.0"
    design = design_of(*soft)
    short, whole = (
        start_once(design, start_of(design), 0.05, FIRST_TOLERANCE, early_end=early) for early in (True, False)
    )
    assert isinstance(short, StartOutcome) and short == whole
