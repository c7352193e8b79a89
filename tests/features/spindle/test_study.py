"""`abu size` of two races: verdicts of the reference cases, phases at random, the report."""

import json
import math
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import abu_calc
from abu_calc.features.design.start_rules import checks_of_starts
from abu_calc.features.spindle.case import capacity_needs, read_case, size_races
from abu_calc.features.spindle.judgement import capacity_checks, facts_of, region_check
from abu_calc.features.spindle.records import SpindleSizeResult
from abu_calc.features.spindle.start_cases import start_of
from abu_calc.features.spindle.view import both_solids, spindle_extras
from abu_calc.formulas.tilting_rotor import resultant_quantile
from abu_calc.foundation import patience
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.start_cases import Ensemble, Lost
from tests.cli.runner import again
from tests.remembered import recalled

BALL = 7800 * 4 / 3 * math.pi
"""Mass of a steel ball per cube of its radius [kg/m³]."""

BETWEEN = (
    "machine.mass_kg=40.0", "machine.transverse_inertia_kg_m2=1.2", "machine.rotor_polar_inertia_kg_m2=0.06",
    "machine.speed_rpm=840.0", "suspension.bearing_positions_mm=[250.0, -250.0]",
    "suspension.bearing_stiffness_N_per_m=[9e4, 9e4]", "suspension.bearing_damping_N_s_per_m=[120.0, 120.0]",
    "wheel.0.plane_mm=200.0", "wheel.0.imbalance_g_mm=3000.0", "wheel.1.plane_mm=-150.0",
    "wheel.1.imbalance_g_mm=2000.0", "autobalancer.0.plane_mm=220.0", "autobalancer.1.plane_mm=-220.0",
)  # fmt: skip
"""Case P2: between the critical speeds 640.586 and 948.626 rpm."""


@cache
def sized(*overrides: str) -> SpindleSizeResult:
    result = recalled("size", read_machine("pedestal-grinder", overrides))
    assert isinstance(result, SpindleSizeResult)
    return result


@pytest.mark.slow
def test_between_the_modes_it_fails_and_names_one_race_within_137_mm() -> None:
    result = sized(*BETWEEN)
    assert result.status == "fail"
    both = result.autobalancers
    check = next(check for check in result.checks if check.code == "ABU101")
    assert check.status == "fail"
    # Two housings of h on the machine: translation √(1.8e5/(40 + 2h)), tilt √(1.8e5·0.25²/(1.14 + 2h·0.22²)).
    housings = [race.mass_g / 1e3 - race.ball_count * BALL * (race.ball_diameter_mm / 2e3) ** 3 for race in both]
    mass, inertia = 40 + sum(housings), 1.14 + sum(housings) * 0.22**2
    own = [math.sqrt(1.8e5 / mass) * 30 / math.pi, math.sqrt(1.8e5 * 0.0625 / inertia) * 30 / math.pi]
    assert result.frequency.critical_speeds_rpm == pytest.approx(own, rel=1e-4)
    assert check.limit == pytest.approx(own[1] / 60, rel=1e-4)
    assert result.frequency.region == "between"
    match = re.search(r"one race within ([\d.]+) mm", str(check.remedy))
    assert match is not None
    # 136.95 mm for the bare machine; the race that stays has the mass h: z²·((40 + 2h)·Ω² − 1.8e5) = 11250 − 1.14·Ω².
    square, h = (840 * math.pi / 30) ** 2, max(race.mass_g for race in both) / 1e3
    limit = math.sqrt((11250 - 1.14 * square) / ((40 + 2 * h) * square - 1.8e5))
    assert float(match[1]) == pytest.approx(1e3 * limit, rel=2e-3)
    assert 100 < 1e3 * limit < 136.95
    assert result.ensemble is None
    assert {check.status for check in result.checks if check.code in ("ABU701", "ABU702", "ABU704")} == {"not-done"}


@pytest.mark.slow
def test_a_disc_is_told_to_take_one_race() -> None:
    check = region_check(size_races(read_machine("pedestal-grinder", ["machine.rotor_polar_inertia_kg_m2=3.5"])), None)
    assert check.status == "fail"
    assert "takes one race" in str(check.remedy)


def test_the_worst_phase_and_the_share_hold_in_ten_thousand_phases() -> None:
    """Resultants of random phases of wheels and eccentricities, by sums of moments about the other race."""
    tables = read_machine("pedestal-grinder").spindle
    assert tables is not None
    case = read_case(tables)
    random, count = np.random.default_rng(41), 10_000
    phases = np.exp(2j * math.pi * random.random((4, count)))
    speed = 2850 * 2 * math.pi / 60
    k, c = np.diag((4.4e5, 4.4e5 * 0.04)), np.diag((600.0, 600 * 0.04))
    Z = (k - speed**2 * np.diag((62.0, 3.01)) + 1j * speed * c) / speed**2
    # r + zΘ = −e at both races; forces V₁ + V₂ and moments 0.3·(V₁ − V₂) that hold the rotor there.
    e = 1e-5 * phases[2:]
    force = Z[0, 0] * -(e[0] + e[1]) / 2
    moment = Z[1, 1] * -(e[0] - e[1]) / 0.6
    U = np.array((2500e-6, 1800e-6))[:, None] * phases[:2]
    force, moment = force - U.sum(axis=0), moment - 0.26 * (U[0] - U[1])
    by_race = np.abs(np.array((force + moment / 0.3, force - moment / 0.3)) / 2)
    for race, need in enumerate(capacity_needs(case)):
        assert by_race[race].max() <= need * (1 + 1e-9)
        assert by_race[race].max() > 0.99 * need
    # Without eccentricity 95 % of the phases stay below the closed form.
    share = np.abs((-U[0] * 0.56 - U[1] * 0.04) / 0.6)
    told = resultant_quantile((2500e-6 * 0.56 / 0.6, 1800e-6 * 0.04 / 0.6), 0.95)
    assert np.mean(share <= told) == pytest.approx(0.95, abs=0.01)


@pytest.mark.slow
def test_the_preset_passes_and_its_numbers_fit_together() -> None:
    result = sized()
    assert result.status == "pass"
    assert result.frequency.balancing_possible
    assert result.frequency.stable
    ensemble = result.ensemble
    assert ensemble is not None
    assert (ensemble.members, ensemble.balanced, ensemble.hanging, ensemble.lost) == (52, 52, 0, 0)
    for race in result.autobalancers:
        assert race.capacity_g_mm >= 1.2 * race.resultant_worst_g_mm * (1 - 1e-9)
        assert race.resultant_typical_g_mm < race.resultant_worst_g_mm
    places = result.vibration.handles
    assert result.vibration.level_before_db == max(place.level_before_db for place in places)


@pytest.mark.slow
def test_the_response_peaks_at_the_critical_speeds() -> None:
    points = sized().response
    peak = max(points, key=lambda point: point.without_um)
    assert any(abs(peak.speed_rpm - critical) < 30 for critical in sized().frequency.critical_speeds_rpm)
    assert all((point.balanced_um is None) == (point.speed_rpm < 804) for point in points)
    assert [figure.name for figure in spindle_extras(sized()).figures] == ["section", "speeds", "run-up"]


@pytest.mark.slow
def test_screen_page_and_json_tell_of_both_races(tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    seen = again("size", "pedestal-grinder", "--output", str(page))
    assert "race 1" in seen.out
    assert "race 2" in seen.out
    text = page.read_text(encoding="utf-8")
    assert "Displacement against speed" in text
    assert "Race 2" in text
    entries = json.loads(again("size", "pedestal-grinder", "--json").out)["result"]
    assert [race["plane_mm"] for race in entries["autobalancers"]] == [300.0, -300.0]


@pytest.mark.slow
def test_lost_start_cases_are_not_passed() -> None:
    design = size_races(read_machine("pedestal-grinder"))
    ensemble = Ensemble(design.case.drag, (), (Lost(start_of(design), "too much work"),))
    checks = list(checks_of_starts(facts_of(design, ensemble)))
    assert [check.status for check in checks] == ["not-done"] * 3
    assert "too much work" in checks[0].message


@pytest.mark.parametrize(
    ("overrides", "words"),
    [
        (("wheel.0.imbalance_g_mm=1e9", "wheel.1.imbalance_g_mm=1e9"), "out of range"),
        (("machine.rotor_polar_inertia_kg_m2=6.0", "autobalancer.0.plane_mm=20.0", "autobalancer.1.plane_mm=-20.0"),
         "flat disc"),
        (("autobalancer.0.max_width_mm=1.0",), "too narrow"),
    ],
)  # fmt: skip
def test_what_cannot_be_made_is_refused(overrides: tuple[str, ...], words: str) -> None:
    with pytest.raises(InputError) as caught:
        abu_calc.size(read_machine("pedestal-grinder", overrides))
    assert words in str(caught.value)


@pytest.mark.slow
def test_an_imbalance_that_no_ball_carries_fails() -> None:
    design = size_races(read_machine("pedestal-grinder", [*BETWEEN, "wheel.0.imbalance_g_mm=1e7"]))
    assert "fail" in [check.status for check in capacity_checks(design)]
    assert region_check(design, None).status == "fail"


@pytest.mark.slow
def test_both_autobalancers_stand_at_their_planes_as_solids() -> None:
    found = sized(*BETWEEN)
    assembly = both_solids(found)
    for number, own in enumerate(found.autobalancers, 1):
        balls = [item for item in assembly.items if item.name.startswith(f"race {number} {own.corrector} ")]
        assert len(balls) == own.ball_count
        for ball in balls:
            assert math.hypot(*ball.shift[:2]) == pytest.approx(own.pitch_radius_mm)
            assert ball.shift[2] == pytest.approx(own.plane_mm)
        mass = sum(item.solid.mass_g for item in assembly.items if item.name.startswith(f"race {number} "))
        assert mass == pytest.approx(own.mass_g, rel=1e-3)


@pytest.mark.slow
def test_nothing_is_advised_where_no_start_case_was_simulated() -> None:
    with patience.limited(0.5):
        result = abu_calc.size(read_machine("pedestal-grinder"))
    actions = {check.code: check.remedy or "" for check in result.checks if check.status == "not-done"}
    assert {"ABU701", "ABU702", "ABU704"} <= set(actions) and result.verdict.word == "not-known"
    assert "--patience" in actions["ABU701"] and not any("Tried" in text for text in actions.values())
