"""What must hold for any machine, over random valid ones; and the order in which a design is chosen."""

import math
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from abu_calc.foundation.checks import overall
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.table import LEAST
from abu_calc.sizing import size
from abu_calc.sizing.balls import choose
from abu_calc.sizing.budget import required_capacity
from abu_calc.sizing.case import read_case
from abu_calc.sizing.design import Design
from abu_calc.standards.balls import stock_diameters
from tests.sizing.machines import machine

RANDOM = settings(max_examples=60, deadline=None, derandomize=True)


def _between(low: float, high: float) -> st.SearchStrategy[float]:
    """Evenly in the logarithm."""
    return st.floats(math.log(low), math.log(high)).map(math.exp)


def _least(low: float, high: float) -> st.SearchStrategy[float]:
    """Evenly, with 0 for what is too small to compute with, which files are refused for."""
    return st.floats(low, high).map(lambda number: number if abs(number) >= LEAST else 0.0)


@st.composite
def machines(draw: st.DrawFn) -> dict[str, Any]:
    """Changes to the base machine, from watch-makers' spindles to mill shafts."""
    speed = draw(_between(300, 60000))
    frequencies = [draw(_between(0.5, 400)), draw(_between(0.5, 400))]
    envelope = draw(_between(50, 300))
    changes: dict[str, Any] = {
        "machine__mass_kg": draw(_between(0.5, 300)),
        "machine__speed_rpm": speed,
        "machine__speed_range_rpm": [speed * draw(st.floats(0.5, 1)), speed * draw(st.floats(1, 1.5))],
        "machine__spindle_axis": draw(st.sampled_from(["horizontal", "vertical"])),
        "suspension__natural_frequencies_hz": frequencies,
        "suspension__damping_ratios": [draw(_least(0, 1)), draw(_least(0, 1))],
        "wheel__mass_kg": draw(_between(0.05, 30)),
        "wheel__imbalance_g_mm": draw(st.just(0.0) | _between(1, 1e5)),
        "wheel__runout_mm": draw(st.just(0.0) | _between(0.001, 0.5)),
        "autobalancer__max_outer_diameter_mm": envelope,
        "autobalancer__max_width_mm": draw(st.floats(10, 40)),
        "autobalancer__bore_diameter_mm": draw(st.floats(5, 0.4 * envelope)),
        "autobalancer__design": draw(st.sampled_from(["one-piece", "bearing-ring", "light"])),
        "autobalancer__corrector": draw(st.sampled_from(["ball", "roller"])),
        "autobalancer__rolling_drag_per_s": draw(_least(0, 200)),
        "autobalancer__rolling_friction_mm": draw(st.sampled_from([0.0, 0.002, 0.05])),
        "autobalancer__race_eccentricity_mm": draw(st.sampled_from([0.0, 0.01, 0.1])),
    }
    if changes["autobalancer__design"] == "bearing-ring":
        changes["autobalancer__corrector"] = "ball"
    if draw(st.booleans()):
        changes["machine__transverse_inertia_kg_m2"] = draw(_between(0.001, 10))
        changes["machine__center_of_mass_to_wheel_mm"] = draw(_between(10, 500))
        changes["autobalancer__plane_offset_mm"] = draw(_least(-50, 50))
    if draw(st.booleans()):
        contact = draw(st.sampled_from(["compliant", "rigid", "face"]))
        changes["grinding"] = {"contact": contact, "cutting_coefficient": draw(_least(0, 0.9))}
        if contact == "compliant":
            changes["grinding"]["contact_stiffness_N_per_m"] = draw(_between(1e4, 1e7))
    return changes


def _sized(changes: dict[str, Any]) -> Design | None:
    """The design, or nothing where no geometry or no formula allows one, which is an answer too."""
    try:
        return size(machine(**changes))
    except InputError as error:
        assert error.exit_status == 2 and error.message
        return None


def _numbers(value: Any) -> list[float]:
    if isinstance(value, bool) or value is None or isinstance(value, str):
        return []
    if isinstance(value, (int, float)):
        return [float(value)]
    if isinstance(value, (tuple, list)):
        return [number for each in value for number in _numbers(each)]
    return _numbers(list(vars(value).values())) if hasattr(value, "__dataclass_fields__") else []


@pytest.mark.slow
@given(machines())
@settings(RANDOM, max_examples=2)
def test_any_machine_is_sized_or_refused(changes: dict[str, Any]) -> None:
    _check_sized(changes)


@pytest.mark.hard
@given(machines())
@settings(RANDOM, max_examples=10)
def test_any_of_many_machines_is_sized_or_refused(changes: dict[str, Any]) -> None:
    _check_sized(changes)


def _check_sized(changes: dict[str, Any]) -> None:
    design = _sized(changes)
    assume(design is not None)
    assert design is not None
    best, abu = design.autobalancer, design.case.autobalancer
    status = overall(design.checks)
    if status == "pass":
        assert best.capacity >= abu.capacity_margin * best.requirement.required
        assert best.budget.residual <= best.budget.permitted
        assert best.mass_fraction <= abu.max_mass_fraction
        assert design.idle.worst.after is not None
        assert design.idle.worst.after <= design.case.table.limits.vibration_level_db
        assert design.frequency.balancing_possible
    assert not any(math.isnan(number) for number in _numbers(best) + _numbers(design.idle) + _numbers(design.track))
    assert best.housing.outer_diameter <= abu.max_outer_diameter_mm * 1e-3 * (1 + 1e-9)
    assert best.housing.width <= abu.max_width_mm * 1e-3 * (1 + 1e-9)
    inner = best.pitch_radius - best.ball_diameter / 2
    assert inner > abu.bore_diameter_mm * 1e-3 / 2


@given(machines(), st.floats(1.0, 5.0))
@RANDOM
@pytest.mark.slow
def test_more_runout_never_needs_less_capacity(changes: dict[str, Any], factor: float) -> None:
    runout = changes.pop("wheel__runout_mm") + 0.01
    needs = []
    for value in (runout, runout * factor):
        case = read_case(machine(**changes, wheel__runout_mm=value))
        needs.append(required_capacity(case, 1e-4, 0.1).required)
    assert needs[1] >= needs[0] * (1 - 1e-12)


@given(machines())
@RANDOM
@pytest.mark.slow
def test_runout_as_the_gauge_shows_it_is_the_same_runout(changes: dict[str, Any]) -> None:
    runout = changes.pop("wheel__runout_mm")
    one = read_case(machine(**changes, wheel__runout_mm=runout))
    two = read_case(machine(**changes, wheel__runout_tir_mm=2 * runout))
    assert required_capacity(one, 1e-4, 0.1) == required_capacity(two, 1e-4, 0.1)


@given(machines(), st.sampled_from([0.01, 0.1, 10.0]))
@RANDOM
@pytest.mark.slow
def test_need_scales_with_all_masses(changes: dict[str, Any], factor: float) -> None:
    """All masses, inertia and contact stiffness × k: the need × k, since frequencies stay."""
    grinding = dict(changes.get("grinding") or {})
    changes["machine__mass_kg"] = min(changes["machine__mass_kg"], 100)
    heavier = dict(changes)
    for key in ("machine__mass_kg", "wheel__mass_kg", "machine__transverse_inertia_kg_m2"):
        if key in changes:
            heavier[key] = changes[key] * factor
    if "contact_stiffness_N_per_m" in grinding:
        scaled = grinding | {"contact_stiffness_N_per_m": grinding["contact_stiffness_N_per_m"] * factor}
        heavier["grinding"] = scaled
    try:
        cases = read_case(machine(**changes)), read_case(machine(**heavier))
    except ValueError:  # the scaled machine is outside what a file may hold
        assume(False)
    light = required_capacity(cases[0], 1e-4, 0.1)
    heavy = required_capacity(cases[1], 1e-4 * factor, 0.1 * factor)
    assert heavy.required == pytest.approx(light.required * factor, rel=1e-9)
    if light.compliant is not None:
        assert heavy.compliant == pytest.approx(light.compliant * factor, rel=1e-9)


# The choice.
@pytest.mark.slow
def test_the_choice_is_the_lightest_of_all_that_suffice() -> None:
    """Against every stock diameter, count and half millimetre, tried one by one."""
    from abu_calc.sizing.balls import ball_counts, evaluate, race_radii

    case = read_case(machine())
    best = choose(case, 250e-6).best
    lightest = math.inf
    for diameter in stock_diameters():
        radii = race_radii(case, diameter)
        for radius in radii:
            for count in ball_counts(case, diameter, radius):
                one = evaluate(case, 250e-6, count, diameter, radius)
                if one.capacity_ratio >= 1.2 and one.budget.within and one.mass_fraction <= 0.05:
                    lightest = min(lightest, one.mass)
    assert best.mass == pytest.approx(lightest, rel=1e-9)


def test_runners_up_are_four_others_each_with_a_reason() -> None:
    choice = choose(read_case(machine()), 250e-6)
    kinds = {(one.ball_count, one.ball_diameter) for one, _ in choice.runners_up}
    assert len(kinds) == 4 and (choice.best.ball_count, choice.best.ball_diameter) not in kinds
    assert all(len(why) > 10 for _, why in choice.runners_up)


def test_budget_comes_before_mass() -> None:
    """With friction so large that the lightest rests too far, a heavier, more accurate one is chosen."""
    free = choose(read_case(machine(autobalancer__rolling_friction_mm=0.0)), 250e-6).best
    rough = choose(read_case(machine(autobalancer__rolling_friction_mm=0.009)), 250e-6).best
    assert rough.budget.within and rough.mass > free.mass
    same = read_case(machine(autobalancer__rolling_friction_mm=0.009))
    from abu_calc.sizing.balls import evaluate

    lightest = evaluate(same, 250e-6, free.ball_count, free.ball_diameter, free.race_radius)
    assert not lightest.budget.within


def test_pinned_values_are_respected() -> None:
    pins = {"ball_count": 4, "ball_diameter_mm": 16.0, "race_radius_mm": 31.0}
    best = size(machine(**{f"autobalancer__{key}": value for key, value in pins.items()})).autobalancer
    assert (best.ball_count, best.ball_diameter, best.race_radius) == (4, pytest.approx(0.016), pytest.approx(0.031))


@pytest.mark.slow
def test_a_rounded_inch_size_is_the_stock_size() -> None:
    best = size(
        machine(
            autobalancer__ball_diameter_mm=19.84, autobalancer__ball_count=2, autobalancer__max_outer_diameter_mm=85.0
        )
    ).autobalancer
    assert 1e3 * best.ball_diameter == pytest.approx(19.844, abs=1e-3)


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"max_outer_diameter_mm": 30.0}, "max_outer_diameter_mm"),
        ({"max_width_mm": 5.0}, "max_width_mm"),
        ({"ball_diameter_mm": 30.0}, "ball_diameter_mm"),
        ({"ball_diameter_mm": 20.0}, "ball_diameter_mm"),
        ({"race_radius_mm": 33.0}, "race_radius_mm"),
        ({"race_radius_mm": 12.0}, "race_radius_mm"),
        ({"ball_diameter_mm": 16.0, "race_radius_mm": 20.0}, "race_radius_mm"),
        ({"ball_diameter_mm": 16.0, "ball_count": 12}, "ball_count"),
        ({"ball_count": 80}, "ball_count"),
    ],
    ids=lambda value: str(value),
)
def test_what_no_geometry_allows_is_refused(changes: dict[str, float], key: str) -> None:
    width = {"max_width_mm": 22.0} if changes.get("ball_diameter_mm") == 20.0 else {}
    with pytest.raises(InputError) as caught:
        size(machine(**{f"autobalancer__{name}": value for name, value in (changes | width).items()}))
    assert caught.value.place.key == f"autobalancer.{key}"
    assert caught.value.exit_status == 2


def test_a_weak_pin_fails_with_its_result() -> None:
    design = size(machine(autobalancer__ball_diameter_mm=5.0, autobalancer__ball_count=2))
    failed = {check.code for check in design.checks if check.status == "fail"}
    assert "ABU201" in failed
    assert design.autobalancer.capacity_ratio < 1


# Region, race plane, warnings.
@pytest.mark.few(3)
@pytest.mark.parametrize(
    ("frequencies", "speeds", "region", "possible"),
    [
        ([2.5, 2.5], [5800, 5800], "supercritical", True),
        ([120.0, 120.0], [5800, 5800], "subcritical", False),
        ([90.0, 90.0], [5800, 5800], "supercritical", True),  # for light balls; those of this machine fail ABU103
        ([30.0, 200.0], [5800, 5800], "between", True),
        ([30.0, 110.0], [5800, 5800], "between", False),  # above √((ω₁²+ω₂²)/2)
        ([2.5, 2.5], [100, 5800], "supercritical", False),
        ([30.0, 200.0], [5800, 20000], "between", False),  # the range crosses the forbidden band
    ],
)
def test_regions_over_the_whole_speed_range(
    frequencies: list[float], speeds: list[float], region: str, possible: bool
) -> None:
    found = size(machine(suspension__natural_frequencies_hz=frequencies, machine__speed_range_rpm=speeds)).frequency
    assert (found.region, found.balancing_possible) == (region, possible)
    assert found.check.status == ("pass" if possible else "fail")


def test_hands_hold_the_machine_too() -> None:
    design = size(machine(suspension={"model": "hands"}))
    assert design.frequency.balancing_possible
    assert 1 < max(design.frequency.natural_frequencies) / (2 * math.pi) < 3


@pytest.mark.parametrize(
    ("entries", "key"),
    [
        ({"inertia_kg_m2": [0.004, 0.02, 0.03]}, "machine.inertia_kg_m2"),
        ({"inertia_xz_kg_m2": 0.02}, "machine.inertia_kg_m2"),
        ({"rotor_polar_inertia_kg_m2": 0.02}, "machine.rotor_polar_inertia_kg_m2"),
    ],
)
def test_bodies_that_no_mass_has_are_refused_by_their_key(entries: dict[str, Any], key: str) -> None:
    body = {"inertia_kg_m2": [0.004, 0.02, 0.019], "center_of_mass_from_wheel_mm": [-95.0, 0.0, -48.0], **entries}
    with pytest.raises(InputError) as refused:
        read_case(machine(**{f"machine__{name}": value for name, value in body.items()}))
    assert refused.value.place.key == key


def test_estimate_of_odd_proportions_is_refused() -> None:
    with pytest.raises(InputError) as refused:
        read_case(machine(machine__layout="angle", machine__length_mm=300.0, machine__height_mm=290.0))
    assert refused.value.place.key == "machine.height_mm"
