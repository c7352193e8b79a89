"""Needs of both races in SI, by sums made here."""

import math
from pathlib import Path

import pytest

from abu_calc.features.spindle.case import (
    SpindleCase,
    capacity_needs,
    felt_mass,
    one_race_machine,
    read_case,
    typical_needs,
)
from abu_calc.inputs.read_machine import read, read_machine
from abu_calc.sizing import size, size_race

TRUE = ("autobalancer.0.race_eccentricity_mm=0.0", "autobalancer.1.race_eccentricity_mm=0.0")


def case_of(*overrides: str) -> SpindleCase:
    tables = read_machine("pedestal-grinder", overrides).spindle
    assert tables is not None
    return read_case(tables)


def test_true_races_need_the_levers_of_both_wheels() -> None:
    """2500·560/600 + 1800·40/600 and 2500·40/600 + 1800·560/600 g·mm; rms as the root of squares."""
    case = case_of(*TRUE)
    assert [1e6 * need for need in capacity_needs(case)] == pytest.approx([2453.3333, 1846.6667], rel=1e-6)
    rms = math.hypot(2500 * 56 / 60, 1800 * 4 / 60), math.hypot(2500 * 4 / 60, 1800 * 56 / 60)
    assert [1e6 * need for need in typical_needs(case)] == pytest.approx(rms, rel=1e-6)
    assert typical_needs(case)[0] == pytest.approx(2336.42e-6, abs=5e-9)


def test_known_phases_need_their_vector_sum_alone() -> None:
    case = case_of(*TRUE, "wheel.0.imbalance_angle_deg=0.0", "wheel.1.imbalance_angle_deg=130.0")
    assert case.unknown_phases == 0
    assert [1e6 * need for need in capacity_needs(case)] == pytest.approx([2258.071, 1578.042], abs=5e-4)


def test_eccentricity_asks_for_the_mass_that_a_race_feels() -> None:
    """(J' + M z²)/(2z)² = (3.01 + 62·0.09)/0.36 and |J' − M z²|/0.36 kg; springs take 8 % of it at this speed."""
    case = case_of()
    assert felt_mass(case, 0) == pytest.approx((3.01 + 62 * 0.09) / 0.36, rel=1e-9)
    far = case_of(*TRUE)
    extra = capacity_needs(case)[0] - capacity_needs(far)[0]
    assert extra == pytest.approx(1e-5 * (8.59 + 2.57) / 0.36, rel=0.1)


@pytest.mark.slow
def test_the_machine_of_one_race_has_the_same_need() -> None:
    case = case_of()
    need = capacity_needs(case)[0]
    design = size(one_race_machine(case, 0, need))
    # The autobalancer's own mass adds to that which its race feels: M·Δ of half a kilogram, 5 g·mm.
    assert design.autobalancer.requirement.required == pytest.approx(need, rel=5e-3)


@pytest.mark.slow
def test_a_race_alone_is_that_of_its_machine() -> None:
    """Balls, race and their checks, without what only its machine needs."""
    case = case_of()
    machine = one_race_machine(case, 0, capacity_needs(case)[0])
    race, whole = size_race(machine), size(machine)
    assert race.autobalancer == whole.autobalancer and race.track == whole.track
    codes = {"ABU202", "ABU301", "ABU302", "ABU303", "ABU304"}
    of_race, of_machine = ([check for check in checks if check.code in codes] for checks in (race.checks, whole.checks))
    assert of_race == of_machine and len(of_race) >= 4


def test_springs_are_two_bearings_that_do_not_couple(tmp_path: Path) -> None:
    text = read("pedestal-grinder").document.text
    start, end = text.index("[suspension]"), text.index("[[wheel]]")
    springs = '[suspension]\nmodel = "springs"\nnatural_frequencies_hz = 5.0\ndamping_ratios = 0.1\n\n'
    file = tmp_path / "springs.toml"
    file.write_text(text[:start] + springs + text[end:], encoding="utf-8")
    tables = read(file).spindle
    assert tables is not None
    rotor = read_case(tables).rotor
    k, kz, kzz = rotor.stiffness
    c, _, czz = rotor.damping
    frequency = 2 * math.pi * 5
    assert (math.sqrt(k / 62), math.sqrt(kzz / 3.1), kz) == pytest.approx((frequency, frequency, 0.0), abs=1e-6)
    assert (c / (2 * 62 * frequency), czz / (2 * 3.1 * frequency)) == pytest.approx((0.1, 0.1))
