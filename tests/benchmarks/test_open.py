"""The open benchmark: references, error measure, entries, runner."""

import importlib.util
import math
import shlex
import sys
from collections import Counter
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.benchmarks.open import abu_entry, scipy_switching, taylor
from tests.benchmarks.open.__main__ import held, main
from tests.benchmarks.open.files import case_of, case_path, names, reference_of, switches
from tests.benchmarks.open.measure import errors, event_errors, followed

SWITCHING = [name for name in names() if switches(case_of(case_path(name)))]


def test_errors_are_relative_of_the_axis_and_round_the_circle_of_the_balls() -> None:
    reference = [[3.0, 4.0, 1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 2.0, 0.0, 0.0, 0.0]]
    moved = [[3.0, 4.5, 1.0 + math.tau, 0.0, 0.0, 0.0], [0.0, 1.0, 2.25, 0.0, 0.0, 0.0]]
    assert errors(moved, reference, 1) == pytest.approx((0.1, 0.25))
    assert errors([[math.nan] * 6] * 2, reference, 1) == (math.inf, math.inf)
    with pytest.raises(ValueError, match="shape"):
        errors(reference[:1], reference, 1)


@pytest.mark.parametrize("name", names())
@pytest.mark.slow
def test_abu_calc_comes_within_eight_digits_of_each_reference(name: str) -> None:
    case, reference = case_of(case_path(name)), reference_of(name)
    assert max(reference["differ_axis"], reference["differ_balls_rad"]) <= 1e-10
    states = abu_entry.solved(case, 1e-11)
    assert max(errors(states, reference["states"], len(case["ball_masses_kg"]))) < 1e-8


def test_a_program_of_anyone_is_held_against_the_reference(tmp_path: Path) -> None:
    script = tmp_path / "mine.py"
    script.write_text(
        "import json, sys\ncase = json.load(open(sys.argv[1]))\n"
        "start = [*case['start_place_m'], *case['start_angles_rad'], 0, 0, *case['start_rates_rad_per_s']]\n"
        "print(json.dumps({'states': [start] * len(case['times_s'])}))\n",
        encoding="utf-8",
    )
    seen = held("stuck", f"{shlex.quote(sys.executable)} {shlex.quote(str(script))}")
    # It never moves: the axis is off by all of its way, and it is lost after the start.
    assert seen.axis == pytest.approx(1.0) and seen.balls > 1 and seen.until == 0.0 and seen.missed is None


@pytest.mark.parametrize("arguments", [[], ["nothing", "abu"], ["stuck", f"{shlex.quote(sys.executable)} -c 1/0"]])
def test_the_runner_says_what_is_wrong(arguments: list[str]) -> None:
    with pytest.raises(SystemExit, match=r"Cases:|ended with"):
        main(arguments)


@pytest.mark.slow
def test_the_script_of_scipy_is_an_entry() -> None:
    seen = held("hand-grinder", "scipy")
    assert max(seen.axis, seen.balls) < 1e-7


def test_a_program_is_told_when_it_lost_the_motion_and_which_events_it_missed() -> None:
    reference = [[0.0, 1.0, angle, 0.0, 0.0, 0.0] for angle in (0.0, 1.0, 2.0)]
    moved = [[0.0, 1.0, angle, 0.0, 0.0, 0.0] for angle in (0.0, 1.0009, 2.01 + math.tau)]
    assert followed(reference, reference, (0.0, 0.1, 0.2), 1) == 0.2
    assert followed(moved, reference, (0.0, 0.1, 0.2), 1) == 0.1
    assert followed([[math.nan] * 6] * 3, reference, (0.0, 0.1, 0.2), 1) != 0.2
    wanted = [(0.1, "stick", 0), (0.2, "slip", 0), (0.3, "stick", 1)]
    assert event_errors(wanted, wanted, 100.0) == (0, 0.0)
    assert event_errors([(0.1, "stick", 0), (0.25, "slip", 0)], wanted, math.tau) == (1, pytest.approx(0.05))
    assert event_errors([(0.1, "stick", 1)], wanted, 1.0) == (3, 0.0)


def scene(**other: Any) -> dict[str, Any]:
    """Two balls on a rotor so heavy that its axis stands still, within some 1e-7."""
    return {
        "mass_kg": 1e9, "stiffness_N_per_m": [1e9, 1e9], "damping_N_s_per_m": [0.0, 0.0], "speed_rad_per_s": 10.0,
        "imbalance_kg_m": 0.0, "imbalance_angle_rad": 0.0, "ball_masses_kg": [1.0, 3.0], "pitch_radii_m": [1.0, 1.0],
        "viscous_drag_rates_per_s": [0.0, 0.0], "ball_inertia_factors": [1.0, 1.0], "ball_radius_m": 0.5,
        "start_place_m": [0.0, 0.0], "start_velocity_m_per_s": [0.0, 0.0], "start_angles_rad": [0.0, 2.0],
        "start_rates_rad_per_s": [0.0, 0.0], "length_scale_m": 1.0, "times_s": [0.0, 1.0],
    } | other  # fmt: skip


def test_integrators_meet_the_closed_impact_of_two_balls() -> None:
    """By hand: ball 0 at 1 rad/s meets ball 1 after 2 − 2β = 2 − π/3 rad; e = ½, m = 1 and 3: it leaves at −1/8."""
    case = scene(restitution=0.5, start_rates_rad_per_s=[1.0, 0.0], times_s=[0.0, 2.0])
    meeting = 2 - math.pi / 3
    for states, events in (taylor.solved(case), scipy_switching.solved(case, 1e-12)):
        assert [tuple(event[1:]) for event in events] == [("impact", 0)]
        assert events[0][0] == pytest.approx(meeting, abs=1e-6)
        assert states[-1][6:8] == pytest.approx([-1 / 8, 3 / 8], abs=1e-6)
        after = 2 - meeting
        assert states[-1][2:4] == pytest.approx([meeting - after / 8, 2 + 3 * after / 8], abs=1e-6)


@pytest.mark.slow
def test_integrators_meet_the_closed_motion_under_dry_friction() -> None:
    """By hand: θ'' = −f (Ω + θ')², so Ω + θ' = 1/(1/γ'₀ + f t) until θ' = 0; ball 1 goes back: Ω + θ' grows.

    Drag and gravity are none, and at rest nothing pulls: both stick for good.
    """
    case = scene(rolling_friction=0.01, start_rates_rad_per_s=[1.0, -1.0], start_angles_rad=[0.0, 4.0],
                 times_s=[0.0, 0.05, 2.0])  # fmt: skip
    for states, events in (taylor.solved(case), scipy_switching.solved(case, 1e-12)):
        stops = [(1 / 10 - 1 / 11) / 0.01, (1 / 9 - 1 / 10) / 0.01]
        assert [tuple(event[1:]) for event in events] == [("stick", 0), ("stick", 1)]
        assert [event[0] for event in events] == pytest.approx(stops, abs=1e-6)
        assert states[1][6] == pytest.approx(1 / (1 / 11 + 0.01 * 0.05) - 10, abs=1e-6)
        assert states[1][7] == pytest.approx(1 / (1 / 9 - 0.01 * 0.05) - 10, abs=1e-6)
        assert states[2][6:8] == [0.0, 0.0]
        assert states[2][2] == pytest.approx(math.log(1.1) / 0.01 - 10 * stops[0], abs=1e-6)


def test_a_ball_that_gravity_pulls_slips_where_friction_ends() -> None:
    """By hand: at rest |g cos γ| ≤ f (R Ω² − g sin γ); f = 0.05, g = 9, R Ω² = 100."""
    case = scene(rolling_friction=0.05, gravity_m_per_s2=9.0, start_angles_rad=[math.pi / 2, -2.0], times_s=[0, 0.2])
    excess = lambda angle: abs(9 * math.cos(angle)) - 0.05 * (100 - 9 * math.sin(angle))  # noqa: E731
    _, events = taylor.solved(case)
    first = next(event for event in events if event.ball == 0)
    assert first.kind == "slip" and excess(math.pi / 2 + 10 * first.time) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.slow
def test_samples_do_not_change_the_motion_of_balls_that_stick() -> None:
    """Steps end where the series of the axis do, too, not only at the balls'."""
    case = scene(mass_kg=10.0, stiffness_N_per_m=[10.0, 10.0], imbalance_kg_m=0.1, rolling_friction=0.5)
    once, _ = taylor.solved(case | {"times_s": [0.0, 4.0]})
    often, events = taylor.solved(case | {"times_s": [k / 10 for k in range(41)]})
    assert not events and np.ptp([row[0] for row in often]) > 0.01
    assert once[-1] == pytest.approx(often[-1], abs=1e-13)


def test_a_short_dip_between_two_looks_is_an_event() -> None:
    dip = [Decimal(text) for text in ("0.2499999999", "-1", "1")]
    assert float(taylor.first_root(dip, Decimal(2)) or 0) == pytest.approx(0.5 - 1e-5, abs=1e-8)
    assert taylor.first_root([Decimal("0.2500000001"), *dip[1:]], Decimal(2)) is None
    crossing = scipy_switching._crossing(lambda t: (t - 0.47) ** 2 - 1e-4, 0.0, 2.0)
    assert crossing == pytest.approx(0.46, abs=1e-9)
    assert scipy_switching._crossing(lambda t: (t - 0.47) ** 2 + 1e-4, 0.0, 2.0) is None


@pytest.mark.parametrize("name", SWITCHING)
def test_cases_that_switch_have_many_events_away_from_their_samples(name: str) -> None:
    case, reference = case_of(case_path(name)), reference_of(name)
    kinds = Counter(kind for _, kind, _ in reference["events"])
    assert (kinds["impact"] if "restitution" in case else min(kinds["stick"], kinds["slip"])) >= 25
    times = np.array([event[0] for event in reference["events"]])
    assert np.all(np.diff(times) > 1e-5) and reference["differ_events_revolutions"] < 1e-6
    assert np.abs(times[:, None] - np.array(case["times_s"][1:])).min() > 1e-4


@pytest.mark.slow
def test_taylor_series_meet_a_smooth_reference() -> None:
    case, reference = case_of(case_path("hand-grinder")), reference_of("hand-grinder")["states"][:3]
    case["times_s"] = case["times_s"][:3]
    assert max(errors(taylor.solved(case)[0], reference, 4)) < 1e-11


@pytest.mark.parametrize("share", [pytest.param(4, marks=pytest.mark.slow), pytest.param(1, marks=pytest.mark.hard)])
@pytest.mark.parametrize("name", SWITCHING)
def test_references_of_cases_that_switch_are_made_again(name: str, share: int) -> None:
    """The first quarter of a case, and all of it."""
    case, reference = case_of(case_path(name)), reference_of(name)
    count = (len(case["times_s"]) - 1) // share + 1
    case["times_s"] = case["times_s"][:count]
    states, events = taylor.solved(case)
    expected = [event for event in reference["events"] if event[0] <= case["times_s"][-1]]
    assert len(expected) > 4
    assert max(errors(states, reference["states"][:count], len(case["ball_masses_kg"]))) < 1e-10
    assert event_errors(events, expected, case["speed_rad_per_s"])[0] == 0


def test_sine_and_cosine_have_all_digits() -> None:
    # sin 1 and cos 1 to 34 digits, by OEIS A049469 and A049470.
    sine, cosine = taylor.sin_cos(Decimal(1) + 200 * taylor.PI)
    assert abs(sine - Decimal("0.8414709848078965066525023216302990")) < Decimal("1e-31")
    assert abs(cosine - Decimal("0.5403023058681397174009366074429766")) < Decimal("1e-31")


@pytest.mark.skipif(importlib.util.find_spec("mujoco") is None, reason="pip install mujoco")
@pytest.mark.parametrize(("name", "allowed"), [("hand-grinder", 1e-7), ("stick-slip", 1e-4)])
def test_mujoco_is_an_entry(name: str, allowed: float) -> None:
    seen = held(name, "mujoco")
    assert max(seen.axis, seen.balls) < allowed
