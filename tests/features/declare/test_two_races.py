"""`abu declare` of machines with two races: closed forms and levers written out here, full equations, refusals."""

import cmath
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from abu_calc.dynamics.averaging.resting_places import resting_places_of_races
from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.features.declare.two_race_test import TestedSpindle, receptance, simulated_two_race_test
from abu_calc.features.two_races.case import read_case
from abu_calc.features.two_races.choice import choose_both
from abu_calc.features.two_races.start_cases import StartCase, scene_of
from abu_calc.formulas.two_races import PlacedImbalance
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.simulate import simulate
from abu_calc.standards.vibration import hand_arm_weight
from tests.cli.runner import abu, once
from tests.house.structure import ROOT

ROLL = str(ROOT / "docs" / "examples" / "two-race-roll.toml")
SPEED = 5800 * 2 * math.pi / 60
GAIN = hand_arm_weight(SPEED) * SPEED**2
SMOOTH = ("--set", "autobalancer.0.rolling_friction_mm=0", "--set", "autobalancer.1.rolling_friction_mm=0")
KEYS = {
    "test_wheel", "handle", "without", "with", "handles", "break_even_eccentricity_mm", "friction_rms_mm", "lowers",
}  # fmt: skip


def mean_of_sum(a: float, b: float) -> float:
    """Mean of |a + b·e^{iα}| over the circle: 2/π·(|a| + |b|)·E(4|ab|/(|a| + |b|)²), E by the AGM."""
    a, b = abs(a), abs(b)
    x, y, total, power = 1.0, abs(a - b) / (a + b), 0.0, 0.5
    total += power * (1 - y**2)
    while abs(x - y) > 1e-15:
        x, y, gap = (x + y) / 2, math.sqrt(x * y), (x - y) / 2
        power *= 2
        total += power * gap**2
    return 2 / math.pi * (a + b) * math.pi / (2 * x) * (1 - total)


def test_the_mean_of_a_sum_is_right() -> None:
    angles = 2 * math.pi * np.arange(4000) / 4000
    assert mean_of_sum(0.3, -1.1) == pytest.approx(float(np.abs(0.3 - 1.1 * np.exp(1j * angles)).mean()), rel=1e-9)


def test_without_friction_handles_move_as_levers_through_both_races() -> None:
    """Races at 150 and -80 mm, handles at 100 and -150 mm, 2 µm each: the mean over the unknown angle between them."""
    seen = once("declare", ROLL, "--starts", "200", *SMOOTH, "--json").document["result"]
    for row, place in zip(seen["handles"], (0.100, -0.150), strict=True):
        first = (place + 0.080) / 0.230
        expected = GAIN * 2e-6 * mean_of_sum(first, 1 - first)
        assert row["with_m_per_s2"] == pytest.approx(expected, rel=2e-3)  # 16 angles stand for the circle
    highest = max(row["with_m_per_s2"] for row in seen["handles"])
    assert seen["with"]["declared_m_per_s2"] == pytest.approx(1.3 * highest, rel=1e-9)
    even = seen["break_even_eccentricity_mm"]
    rear = mean_of_sum((-0.150 + 0.080) / 0.230, (0.150 + 0.150) / 0.230)
    assert 1.3 * GAIN * even * 1e-3 * rear == pytest.approx(seen["without"]["a_hv_m_per_s2"], rel=2e-3)


def test_without_autobalancers_the_body_answers() -> None:
    """1/M + z_h·z_w/(J_t − J_p), times 1/(1 − ω0²/Ω²): 29 g·mm of the Ø100 wheel on the worse place."""
    seen = once("declare", ROLL, "--starts", "200", *SMOOTH, "--json").document["result"]
    soft = 1 / abs(1 - (2.5 * 2 * math.pi / SPEED) ** 2 + 2j * 0.5 * 2.5 * 2 * math.pi / SPEED * -1)
    for row, place in zip(seen["handles"], (0.100, -0.150), strict=True):
        values = [GAIN * 29e-6 * abs(1 / 6.0 + place * wheel / (0.100 - 0.002)) * soft for wheel in (0.120, 0.020)]
        assert row["without_m_per_s2"] == pytest.approx(max(values), rel=1e-3)


def test_the_value_does_not_depend_on_the_test_wheel_without_friction() -> None:
    results = [
        once("declare", ROLL, "--starts", "200", *SMOOTH, "--set", f"type_test.test_wheel_imbalance_g_mm={size}",
             "--json").document["result"]
        for size in (5, 40)
    ]  # fmt: skip
    assert results[0]["with"]["a_hv_m_per_s2"] == pytest.approx(results[1]["with"]["a_hv_m_per_s2"], rel=1e-12)
    assert results[1]["without"]["a_hv_m_per_s2"] == pytest.approx(8 * results[0]["without"]["a_hv_m_per_s2"], rel=1e-9)


def design_of(*overrides: str):  # type: ignore[no-untyped-def]
    tables = read_machine(ROLL, overrides).two_races
    assert tables is not None
    return choose_both(read_case(tables))


def test_balls_rest_where_friction_holds_them() -> None:
    """From the angles at the end: c = T − Σ g·m·R·Σe^{iθ}, and |Im(c·e^{−iθ})| ≤ b for every ball of both races."""
    design = design_of("autobalancer.0.rolling_friction_mm=0.002", "autobalancer.1.rolling_friction_mm=0.002")
    case, spindle = design.case, TestedSpindle.of(design)
    answers = [[receptance(case, at, force_at) for force_at in case.races] for at in case.races]
    target = np.array([[3e-6 - answers[k][0] * 20e-6 * cmath.exp(1j * run) for run in range(60)] for k in (0, 1)])
    ends = resting_places_of_races(spindle.balls, answers, target, 3)
    assert ends.moving == 0
    count = spindle.balls[0].count
    angles = (ends.angles[:count], ends.angles[count:])
    moments = [balls.moment * np.exp(1j * own).sum(axis=0) for balls, own in zip(spindle.balls, angles, strict=True)]
    for race, (balls, own) in enumerate(zip(spindle.balls, angles, strict=True)):
        kept = target[race] - answers[race][0] * moments[0] - answers[race][1] * moments[1]
        assert np.abs(kept - ends.displacements[race]).max() < 1e-4 * balls.band
        pulls = np.abs((kept * np.exp(-1j * own)).imag)
        assert pulls.max() <= balls.band * (1 + 1e-6)
        assert pulls.max() > 0.2 * balls.band


def test_turned_about_wheels_give_the_same() -> None:
    """The order of the wheels in the file does not matter."""
    design = design_of()
    spindle = TestedSpindle.of(design)
    loads = [PlacedImbalance(place, 29e-6) for place in (0.12, 0.02)]
    together = [spindle.without((load,)) for load in loads]
    assert together[0].keys() == {"front", "rear"}
    swapped = replace(design, bare=replace(design.bare, wheels=design.bare.wheels[::-1]))
    assert TestedSpindle.of(swapped).without((loads[1],)) == together[1]
    first = simulated_two_race_test(spindle, (loads[0],), 2e-6, 320)
    again = simulated_two_race_test(TestedSpindle.of(swapped), (loads[0],), 2e-6, 320)
    assert first.means == again.means


@pytest.mark.slow
def test_full_equations_end_at_the_same_places() -> None:
    """The tilting rotor integrated from the same starts with exact friction, balls as points: handles within 15 %."""
    design = design_of("autobalancer.0.rolling_friction_mm=0.002", "autobalancer.1.rolling_friction_mm=0.002")
    case, spindle, runs = design.case, TestedSpindle.of(design), 8
    eccentricity = case.eccentricity
    answers = [[receptance(case, at, force_at) for force_at in case.races] for at in case.races]
    target = np.array([[eccentricity - receptance(case, z, 0.12) * 29e-6] * runs for z in case.races], dtype=complex)
    ends = resting_places_of_races(spindle.balls, answers, target, 5)
    counts = [balls.count for balls in spindle.balls]
    starts = np.random.default_rng(5).uniform(-math.pi, math.pi, (sum(counts), runs))
    base = scene_of(design, StartCase("spread", 1.0, (0.0,) * case.unknown_phases))
    kinds = (BallContactEffect, RaceEccentricityEffect)
    effects = tuple(effect for effect in base.effects if not isinstance(effect, kinds))
    pairs = []
    for run in range(runs):
        angles = starts[: counts[0], run], starts[counts[0] :, run]
        scene = replace(
            base,
            races=tuple(replace(race, start_angles=tuple(own)) for race, own in zip(base.races, angles, strict=True)),
            imbalance=29e-6, imbalance_angle=0.0, couple=0.12 * 29e-6, couple_angle=0.0,
            duration=3.0, effects=(*effects, RaceEccentricityEffect(eccentricity, 0.0)),
        )  # fmt: skip
        times = np.arange(2.8, 3.0, scene.revolution / 16)
        states = simulate(scene, 0.02, times).trajectory.at(times)
        for handle in spindle.handles:
            path = scene.axis_place(states, handle.place)
            path = path - path.mean(axis=1, keepdims=True)
            slow = abs(np.array(spindle.shares(handle)) @ (eccentricity - ends.displacements[:, run]))
            pairs.append((float(np.sqrt((path**2).sum(axis=0)).max()), float(slow)))
    full, averaged = np.array(pairs).T
    assert np.abs(full - averaged).mean() < 0.15 * averaged.mean()
    assert full.mean() == pytest.approx(averaged.mean(), rel=0.1)


def test_a_machine_on_a_stand_declares_nothing_and_says_why() -> None:
    seen = once("declare", "pedestal-grinder", "--json")
    assert seen.status == 1
    result, checks = seen.document["result"], seen.document["checks"]
    assert result.keys() >= KEYS and result["with"] is result["without"] is None and result["lowers"] is False
    assert {check["code"]: check["status"] for check in checks} == {"ABU431": "not-done", "ABU432": "not-done"}
    assert all("[[machine.handle]]" in check["message"] + check["remedy"] for check in checks)


def test_the_screen_fits(tmp_path: Path) -> None:
    seen = once("declare", ROLL, "--starts", "500")
    assert seen.status == 0, seen.err
    assert "test wheel on" in seen.out and "break-even" in seen.out
    assert seen.width <= 80 and len(seen.out.splitlines()) <= 48
    page = tmp_path / "declared.html"
    assert abu("declare", ROLL, "--starts", "500", "--output", str(page)).status == 0
    assert "<svg" in page.read_text()


def test_the_document_has_the_fixed_keys() -> None:
    result = once("declare", ROLL, "--starts", "500", "--json").document["result"]
    assert result.keys() >= KEYS
    assert [place["wheel"] for place in result["test_wheels"]] == ["outer half of the drum", "inner half of the drum"]
    assert result["with"]["p05"] < result["with"]["p50"] < result["with"]["p95"]


def test_the_action_holds_when_followed() -> None:
    loose = [
        part
        for race in (0, 1)
        for key, value in (("race_eccentricity_mm", 0.02), ("rolling_friction_mm", 0.002))
        for part in ("--set", f"autobalancer.{race}.{key}={value}")
    ]
    seen = once("declare", ROLL, "--starts", "500", *loose, "--json").document
    check = next(check for check in seen["checks"] if check["code"] == "ABU431")
    assert check["status"] == "warn" and check["overrides"]
    entries = [part for override in check["overrides"] for part in ("--set", override)]
    again = abu("declare", ROLL, "--starts", "500", *loose, *entries, "--json").document
    assert next(each for each in again["checks"] if each["code"] == "ABU431")["status"] == "pass"


@pytest.mark.parametrize(
    ("overrides", "words"),
    [
        (("wheel.1.diameter_mm=110",), ("wheel", "1", "diameter_mm", "110 mm", "test_wheel_imbalance_g_mm")),
        (("type_test.test_wheel_diameter_mm=110",), ("type_test.test_wheel_diameter_mm", "110")),
        (("machine.speed_rpm=100000",), ("machine.speed_rpm", "100000")),
    ],
)
def test_wrong_entries_are_refused_by_their_key(overrides: tuple[str, ...], words: tuple[str, ...]) -> None:
    seen = abu("declare", ROLL, *(part for entry in overrides for part in ("--set", entry)))
    assert seen.status == 2
    assert all(word in seen.err for word in words), seen.err


def test_balls_that_cannot_carry_the_wheel_fail_and_nothing_is_declared() -> None:
    seen = abu("declare", ROLL, "--set", "type_test.test_wheel_imbalance_g_mm=5000", "--json")
    assert seen.status == 1
    statuses = {check["code"]: check["status"] for check in seen.document["checks"]}
    assert statuses == {"ABU431": "not-done", "ABU432": "not-done", "ABU433": "fail"}
    assert seen.document["result"]["with"] is None
    assert seen.document["result"]["without"]["a_hv_m_per_s2"] > 10


def test_a_loud_background_rules_the_autobalancers_out() -> None:
    result = abu(
        "declare", ROLL, "--starts", "500", "--set", "type_test.background_a_hv_m_per_s2=2.0", "--json"
    ).document  # fmt: skip
    assert result["result"]["lowers"] is False and result["result"]["break_even_eccentricity_mm"] is None
    assert any("no autobalancer, however perfect" in text for text in result["warnings"])
