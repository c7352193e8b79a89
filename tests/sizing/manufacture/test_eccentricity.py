"""The split of the eccentricity: its parts add up to what the simulation uses, and each part counts."""

import math
from dataclasses import replace
from functools import cache
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from abu_calc.sizing.drawing_requirements import drawing
from abu_calc.sizing.manufacture.construction import construct
from abu_calc.sizing.manufacture.cover import standard_fits
from abu_calc.sizing.manufacture.eccentricity import _stretched, eccentricity_check, split_eccentricity
from abu_calc.standards.tolerance_classes import part_limits

PRESETS = ("avtovaz-707-222", "avtovaz-707-305", "avtovaz-707-370", "msh-230", "swing-arm-grinder")


@cache
def preset(name: str, *overrides: str) -> Design:
    return size(read_machine(name, overrides).tables)


def sized(*overrides: str) -> Design:
    return preset("avtovaz-707-222", *overrides)


@pytest.mark.parametrize("name", PRESETS)
def test_an_independent_sum_of_the_drawn_parts_is_the_checked_one_and_within_the_simulated_one(name: str) -> None:
    """From frames, classes and grade alone: TIR/2 + (ES − ei + growth)/2 + TIR/2 + e_per·m/m_F, with e_per = G/Ω."""
    design = preset(name)
    case, best, split = design.case, design.autobalancer, design.eccentricity
    race = next(surface for surface in design.construction.parts.race_part.surfaces if surface.name == "race")
    race_run_out = next(each.value for each in race.geometrical if each.kind == "run-out")
    assert split.fit is not None
    bore = case.autobalancer.bore_diameter_mm * 1e-3
    hole = part_limits("housing", split.fit.bore_class, bore)
    shaft = part_limits("shaft", split.fit.spindle_class, bore)
    warm = max(0.0, (case.autobalancer.temperature_range_C[1] - 20) * bore)
    alpha = 23.5e-6 - 12e-6 if case.autobalancer.design == "light" else 0.0
    E, nu, rho = (70e9, 0.33, 2700.0) if case.autobalancer.design == "light" else (206e9, 0.3, 7800.0)
    rim, omega = best.housing.outer_diameter / 2, case.speed_range[1]
    spun = bore * rho * omega**2 / (4 * E) * ((3 + nu) * rim**2 + (1 - nu) * bore**2 / 4)
    clearance = max(0.0, hole.upper - shaft.lower + alpha * warm + spun) / 2
    spindle_run_out = 2 * split.spindle
    grade = float(split.balance_grade[1:]) * 1e-3
    housing = grade / omega * best.housing.mass / case.body.effective_mass(best.mass, case.race_place)
    total = race_run_out / 2 + clearance + spindle_run_out / 2 + housing
    check = next(check for check in design.checks if check.code == "ABU206")
    assert check.status == "pass"
    assert check.value == pytest.approx(1e6 * total, rel=1e-6)
    assert total <= case.race_eccentricity
    assert best.budget.race_eccentricity == case.race_eccentricity


@pytest.mark.parametrize("part", ["race", "clearance", "spindle", "housing"])
@pytest.mark.parametrize("rule", ["worst-case", "rss"])
def test_each_part_moves_the_sum(part: str, rule: str) -> None:
    """Worst case: by the same micrometre; root of the sum of squares: by the hypotenuse."""
    split = replace(sized().eccentricity, rule=rule)
    more = replace(split, **{part: getattr(split, part) + 1e-6})
    parts = {name: getattr(more, name) for name in ("race", "clearance", "spindle", "housing")}
    expected = sum(parts.values()) if rule == "worst-case" else math.sqrt(sum(each**2 for each in parts.values()))
    assert more.sum == pytest.approx(expected)
    assert more.sum > split.sum
    assert not replace(split, **{part: split.total * 1.01}).holds


@given(
    total=st.floats(1e-4, 0.5), bore=st.floats(3.0, 30.0), rule=st.sampled_from(["worst-case", "rss"]),
    fastening=st.sampled_from(["clamped", "shrunk", "flange"]), design=st.sampled_from(["one-piece", "light"]),
)  # fmt: skip
@settings(max_examples=30, deadline=None, derandomize=True)
def test_a_split_that_holds_is_within_the_total_whatever_the_machine(
    total: float, bore: float, rule: str, fastening: str, design: str
) -> None:
    best = sized()
    table: Any = best.case.autobalancer.model_copy(update={
        "race_eccentricity_mm": total, "bore_diameter_mm": bore, "eccentricity_sum": rule, "fastening": fastening,
        "design": design,
    })  # fmt: skip
    case = replace(best.case, autobalancer=table, race_eccentricity=total * 1e-3)
    split = split_eccentricity(case, best.autobalancer)
    if split.holds:
        assert split.sum <= split.total * (1 + 1e-9)
        assert eccentricity_check(case, split).status == "pass"
    else:
        assert split.least > split.total


def test_rss_permits_coarser_run_outs() -> None:
    worst, rss = sized().eccentricity, sized("autobalancer.eccentricity_sum=rss").eccentricity
    assert rss.race > worst.race and rss.spindle > worst.spindle
    assert rss.sum <= rss.total


def test_an_eccentricity_that_no_fit_holds_fails_and_names_the_least() -> None:
    """Run-outs IT2: 3 µm at Ø62 and 2.5 µm at Ø20; an interference fit; the imbalance of G1."""
    design = sized("autobalancer.race_eccentricity_mm=0.002")
    check = next(check for check in design.checks if check.code == "ABU206")
    assert check.status == "fail" and check.value is not None and check.value > 2.0
    best, case = design.autobalancer, design.case
    imbalance = 1e-3 / case.speed_range[1] * best.housing.mass / case.body.effective_mass(best.mass, case.race_place)
    assert check.value == pytest.approx(1.5 + 1.25 + 1e6 * imbalance, rel=1e-9)


def test_a_bore_outside_the_tables_is_not_evaluated() -> None:
    best = sized()
    wide = replace(best.case, autobalancer=best.case.autobalancer.model_copy(update={"bore_diameter_mm": 700.0}))
    split = split_eccentricity(wide, best.autobalancer)
    assert split.fit is None and not split.holds
    assert eccentricity_check(wide, split).status == "not-done"
    construction = construct(best.case, best.autobalancer, replace(best.eccentricity, fit=None))
    advice = drawing(best.case, best.autobalancer, best.track, replace(best.eccentricity, fit=None), construction)
    assert "no standard fit" in [each.requirement for each in advice]
    assert standard_fits(0.7) == ()


@pytest.mark.slow
def test_a_bearings_ring_brings_its_own_run_out() -> None:
    """Ø62: 25, 13, 8 µm in the classes 0, 6, 5 (ISO 492); 10 µm leave room for class 5 alone."""
    design = sized("autobalancer.design=bearing-ring")
    split = design.eccentricity
    assert (split.ring_class, split.ring_run_out) == ("5", pytest.approx(8e-6))
    assert split.race > 4e-6
    assert split.least > sized().eccentricity.least + 3.9e-6
    seat = next(each for each in design.construction.parts.body.surfaces if each.name == "ring seat")
    assert seat.geometrical[0].value == pytest.approx(2 * split.race - 8e-6)


@pytest.mark.parametrize(("rule", "fixed"), [("rss", (6e-6, 8e-6)), ("worst-case", (6e-6, 4e-6))])
def test_run_outs_are_stretched_in_proportion_until_all_parts_use_up_the_total(
    rule: str, fixed: tuple[float, float]
) -> None:
    """26² = 10² + 24², and 10 = √(6² + 8²); 24 = 10·2.4 = √(6² + 8²)·2.4. In line: 26 − 10 = 16 of 3 + 4."""
    needed = (6e-6, 8e-6) if rule == "rss" else (3e-6, 4e-6)
    race, spindle = _stretched(needed, fixed, 26e-6, rule)
    parts = (race, spindle, *fixed)
    total = sum(parts) if rule == "worst-case" else math.sqrt(sum(part**2 for part in parts))
    assert total == pytest.approx(26e-6, rel=1e-12)
    assert race / spindle == pytest.approx(3 / 4, rel=1e-12)
