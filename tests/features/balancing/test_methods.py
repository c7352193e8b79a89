"""What readings say of two planes, held against a rig simulated in other coordinates, and against published numbers."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import abu_calc
from abu_calc.features.balancing.formulas import (
    RollOnRig,
    condition_number,
    influence,
    kernels,
    natural_frequencies,
    support_damping,
)
from abu_calc.features.balancing.methods import Solution, method_of, solved
from abu_calc.features.balancing.runs import Balancing, RunOnRig, TrialMass
from abu_calc.features.balancing.study import BalanceResult
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from tests.features.balancing.field import Fan, any_fan
from tests.features.balancing.rig import BARE_ROTOR, RIG, ROTOR, Simulated, Workshop, trial, turned, written

ROLL = RollOnRig(18, 21, 3e5, 3.6e5, 0, 64, 9.5, 0.15, 0.52, 0.61, 0.2)
OMEGA = 100 * math.pi
RADII = (0.12, 0.15)
QUANTITIES = ("displacement", "velocity", "acceleration")


def run_of(shop: Workshop, *weights: TrialMass) -> RunOnRig:
    (A, alpha), (B, beta) = shop.read()
    scale = 1e-3 if shop.quantity != "acceleration" else 1.0
    return RunOnRig(
        shop.speed, shop.quantity, (A * scale, B * scale), (math.radians(alpha), math.radians(beta)),
        math.radians(shop.sensor_deg), weights,
    )  # fmt: skip


def grams(solution: Solution) -> list[tuple[float, float]]:
    return [(1e3 * abs(Q) / R, -math.degrees(np.angle(Q)) % 360)
            for Q, R in zip(solution.imbalance, RADII, strict=True)]  # fmt: skip


def answer(shop: Workshop, roll: RollOnRig = ROLL) -> list[tuple[float, float]]:
    return grams(solved(Balancing(roll, (run_of(shop),)), "rig data"))


# Published and derived numbers


def test_golden_numbers_of_the_test_rig() -> None:
    shop = Workshop()
    (A, alpha), (B, beta) = shop.read()
    assert (A, alpha, B, beta) == pytest.approx((0.038109, 18.7489, 0.031642, 152.7485), rel=2e-5)
    assert shop.rig.natural_hz() == pytest.approx([12.5422, 17.3499], rel=1e-5)
    (k11, k12), (k21, k22) = kernels(ROLL, OMEGA)
    X = [1e-3 * A * np.exp(-1j * np.radians(alpha)), 1e-3 * B * np.exp(-1j * np.radians(beta))]
    S, G = k11 * X[0] + k12 * X[1], k21 * X[0] + k22 * X[1]
    assert (S.real, -S.imag, G.real, -G.imag) == pytest.approx(
        (-5.007365e-4, -1.283497e-3, -1.169295e-3, 9.524891e-5), rel=1e-5
    )
    assert answer(shop) == [pytest.approx((12.0, 205.0), rel=1e-9), pytest.approx((7.0, 320.0), rel=1e-9)]


@pytest.mark.parametrize(("hz", "errors", "left"), [(50.0, (0.003, 0.51), 104.9), (21.0, (0.025, 3.31), 15.8)])
def test_golden_numbers_of_a_damped_rig_taken_for_undamped(hz: float, errors: tuple[float, float], left: float) -> None:
    """1 % of damping: errors below these, and 1/105 and 1/16 of the vibration left after one correction."""
    damped = Simulated(damping=support_damping(replace(ROLL, damping_ratio=0.01)))
    shop = Workshop(damped, speed_rpm=60 * hz)
    found = answer(shop)
    for (mass, angle), true_mass, true_angle in zip(found, shop.masses, shop.angles, strict=True):
        assert abs(mass / true_mass - 1) < errors[0] and abs(turned(angle, true_angle)) < errors[1]
    after = shop
    for plane, (mass, angle) in enumerate(found):
        after = after.put_on(plane, mass, angle + 180)
    assert min(np.abs(shop.motion()) / np.abs(after.motion())) == pytest.approx(left, rel=0.01)


def test_with_its_damping_the_rig_tells_all() -> None:
    roll = replace(ROLL, damping_ratio=0.03)
    shop = Workshop(Simulated(damping=support_damping(roll)), speed_rpm=1100.0)
    assert answer(shop, roll) == [pytest.approx((12.0, 205.0), rel=1e-9), pytest.approx((7.0, 320.0), rel=1e-9)]


# Every quadrant


ANGLES = (0.0, 1e-7, 30.0, 90.0, 135.0, 180.0, 205.0, 270.0, 300.0, 359.9999999)


@pytest.mark.parametrize("quantity", QUANTITIES)
@pytest.mark.parametrize("left", ANGLES)
def test_every_quadrant_and_degenerate_angle(quantity: str, left: float) -> None:
    for right in ANGLES:
        for masses in ((12.0, 7.0), (0.0, 7.0), (12.0, 0.0)):
            shop = Workshop(quantity=quantity, masses=masses, angles=(left, right), sensor_deg=37.0)
            for (mass, angle), true, at in zip(answer(shop), masses, shop.angles, strict=True):
                assert mass == pytest.approx(true, abs=1e-9)
                assert true == 0 or abs(turned(angle, at)) < 1e-6


@pytest.mark.parametrize("quantity", QUANTITIES)
@pytest.mark.parametrize(("left", "right"), [(0.0, 90.0), (180.0, 270.0), (100.0, 200.0), (300.0, 30.0)])
def test_the_command_finds_them(tmp_path: Path, quantity: str, left: float, right: float) -> None:
    shop = Workshop(quantity=quantity, angles=(left, right), sensor_deg=-60.0)
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR, shop.run()))
    for one, mass, at in ((result.left, 12.0, left), (result.right, 7.0, right)):
        assert one.mass_g == pytest.approx(mass, rel=1e-9)
        assert 0 <= one.angle_deg < 360 and abs(turned(one.angle_deg, at)) < 1e-6
        assert one.remove_at_deg == one.angle_deg
        assert 0 <= one.add_at_deg < 360 and abs(turned(one.add_at_deg, at + 180)) < 1e-6


positive = st.floats(0.2, 5.0)


@pytest.mark.slow
@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    st.tuples(*[positive] * 10), st.floats(0, 0.2), st.floats(1.5, 8.0), st.tuples(*[st.floats(0.01, 50)] * 2),
    st.tuples(*[st.floats(0, 360)] * 2), st.sampled_from(QUANTITIES), st.floats(-180, 180),
)  # fmt: skip
def test_any_rig_gives_back_what_it_was_made_of(factors, ratio, over, masses, angles, quantity, sensor) -> None:
    values = dict(zip(["M1", "M2", "C1", "C2", "M3", "J3", "a", "b", "c", "d"], factors, strict=True))
    base = vars(Simulated())
    values = {key: value * base[key] for key, value in values.items()}
    roll = RollOnRig(**values, damping_ratio=ratio)
    rig = Simulated(**values, damping=support_damping(roll))
    assert [w / math.tau for w in natural_frequencies(roll)] == pytest.approx(rig.natural_hz(), rel=1e-9)
    speed = over * natural_frequencies(roll)[1]
    shop = Workshop(rig, masses, angles, speed * 30 / math.pi, quantity, sensor)
    found = answer(shop, roll)
    room = 1e-9 * condition_number(influence(roll, speed)) * max(masses)
    for (mass, angle), true, at in zip(found, masses, angles, strict=True):
        assert abs(mass * np.exp(1j * math.radians(angle)) - true * np.exp(1j * math.radians(at))) < room


# Noise


@pytest.mark.slow
def test_two_runs_bring_a_damped_noisy_rig_below_a_tenth_in_99_of_100_seeds() -> None:
    damped = Simulated(damping=support_damping(replace(ROLL, damping_ratio=0.02)))
    good = 0
    for seed in range(100):
        rng = np.random.default_rng(seed)
        shop = first = Workshop(
            damped, tuple(rng.uniform(2, 20, 2)), tuple(rng.uniform(0, 360, 2)), rng.uniform(1500, 3600),
            QUANTITIES[seed % 3], rng.uniform(-180, 180), 0.01, rng,
        )  # fmt: skip
        for _ in range(2):
            for plane, (mass, angle) in enumerate(answer(shop)):
                shop = shop.put_on(plane, mass, angle + 180)
        good += bool(np.all(np.abs(shop.motion()) < 0.1 * np.abs(first.motion()).max()))
    assert good >= 99


# Trial masses


def test_influence_coefficients_recover_the_rig(tmp_path: Path) -> None:
    """No data of the rig; damped, near a natural frequency, sensors 50° off: mass, angle, and the coefficients."""
    rig = Simulated(damping=(300.0, 500.0))
    shop = Workshop(rig, speed_rpm=1150.0, quantity="velocity", sensor_deg=50.0)
    runs = [shop.run(), *(shop.put_on(k, 15.0, 70.0).run(trial(k, 15.0, 70.0)) for k in (0, 1))]
    result = abu_calc.balance(written(tmp_path, BARE_ROTOR, *runs))
    assert result.method == "trial masses"
    assert (result.left.mass_g, result.left.angle_deg) == pytest.approx((12.0, 205.0), rel=1e-9)
    assert (result.right.mass_g, result.right.angle_deg) == pytest.approx((7.0, 320.0), rel=1e-9)
    for plane, radius in enumerate(rig.radii):
        masses = [1.0 * (k == plane) for k in (0, 1)]
        moved = rig.motion(shop.speed, masses, (0.0, 0.0)) * 1e6 / (1e3 * radius)
        found = [complex(*row[plane]) for row in result.influence_coefficients]
        assert found == pytest.approx(list(moved), rel=1e-9)


def test_trial_masses_go_before_data_of_the_rig_and_tell_where_these_are_wrong(tmp_path: Path) -> None:
    shop = Workshop(Simulated(C1=2e5, M3=50.0), speed_rpm=1400.0)
    runs = [shop.run(), *(shop.put_on(k, 10.0, 0.0).run(trial(k, 10.0, 0.0)) for k in (0, 1))]
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR, *runs))
    assert result.method == "trial masses" and result.left.mass_g == pytest.approx(12.0, rel=1e-9)
    assert any("differ by" in line for line in result.warnings)
    wrong = abu_calc.balance(written(tmp_path, RIG, ROTOR, shop.run()))
    assert abs(wrong.left.mass_g / 12.0 - 1) > 0.05


def test_too_few_trials_are_taken_into_account_by_the_rigs_data(tmp_path: Path) -> None:
    shop = Workshop()
    both = 'trial = [{ plane = "left", mass_g = 8.0, angle_deg = 30.0, radius_mm = 60.0 }, { plane = "right", mass_g = -3.0, angle_deg = 200.0 }]'  # noqa: E501
    spoiled = shop.put_on(0, 4.0, 30.0).put_on(1, -3.0, 200.0)
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR, spoiled.run(both)))
    assert result.method == "rig data"
    assert (result.left.mass_g, result.right.mass_g) == pytest.approx((12.0, 7.0), rel=1e-9)
    assert any("do not suffice" in line for line in result.warnings)


def test_influence_coefficients_bring_noise_down_too() -> None:
    shop = Workshop(Simulated(damping=(200.0, 200.0)), noise=0.01)
    runs = [run_of(shop)]
    for k in (0, 1):
        mass = 10.0
        runs.append(run_of(shop.put_on(k, mass, 0.0), TrialMass(k, 1e-3 * mass, RADII[k], 0.0)))
    case = Balancing(None, tuple(runs))
    assert method_of(case) == "trial masses"
    after = shop
    for plane, (mass, angle) in enumerate(grams(solved(case, "trial masses"))):
        after = after.put_on(plane, mass, angle + 180)
    assert np.all(np.abs(after.motion()) < 0.1 * np.abs(shop.motion()))


# Published


def test_example_6_of_a_balancing_text(tmp_path: Path) -> None:
    """Vaughan, "Static and dynamic balancing", Brüel & Kjær application note 17-227, example 6.

    170 at 112° and 53 at 78° as it is; 1.15 g in plane 1 makes 235 at 94° and 58 at 68°, in plane 2 185 at 115° and 77
    at 104°. Masses to add: 1.98 g at 236° and 1.07 g at 122°, angles from the trial mass in the sense of the phases.
    """
    readings = [((170, 112), (53, 78)), ((235, 94), (58, 68)), ((185, 115), (77, 104))]
    trials = ["", 'trial = { plane = "left", mass_g = 1.15, angle_deg = 0 }',
              'trial = { plane = "right", mass_g = 1.15, angle_deg = 0 }']  # fmt: skip
    runs = [
        f'[[run]]\nspeed_rpm = 1500\nunit = "mm/s rms"\nphase = "lag"\nleft = {{ amplitude = {left[0]}, phase_deg = '
        f"{left[1]} }}\nright = {{ amplitude = {right[0]}, phase_deg = {right[1]} }}\n{trial_}\n"
        for (left, right), trial_ in zip(readings, trials, strict=True)
    ]
    result = abu_calc.balance(written(tmp_path, BARE_ROTOR, *runs))
    assert (result.left.mass_g, result.left.add_at_deg) == pytest.approx((1.979, 236.2), abs=0.05)
    assert (result.right.mass_g, result.right.add_at_deg) == pytest.approx((1.071, 121.8), abs=0.05)


# One plane, many sensors and speeds


def test_one_plane_by_one_trial_mass(tmp_path: Path) -> None:
    fan = Fan(reading_error=0.0, placing_error=0.0)
    result = abu_calc.balance(written(tmp_path, fan.plane, fan.run(1500.0), fan.run(1500.0, (12.0, 40.0))))
    assert result.method == "trial masses" and result.left is None and result.right is None
    assert (result.single_plane.mass_g, result.single_plane.angle_deg) == pytest.approx((30.0, 130.0), rel=1e-9)
    assert "left" not in result.to_dict() and result.to_dict()["single_plane"]["add_at_deg"] == pytest.approx(310.0)


COUNTS = [10, pytest.param(40, marks=pytest.mark.slow), pytest.param(100, marks=pytest.mark.hard)]
"""Of seeds: few by default, runs by hand have the hundred of which 95 must hold."""

FIELD = {
    "one sensor": (1, (1500.0,)),
    "three sensors": (3, (1500.0,)),
    "two sensors at three speeds": (2, (1200.0, 1500.0, 1800.0)),
}


@pytest.mark.few(2, 1)
@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("name", FIELD)
def test_the_residual_of_one_plane_is_within_the_uncertainty_told(tmp_path: Path, name: str, count: int) -> None:
    """Twenty fans, five corrections of each, everything off by a percent: 95 of 100."""
    sensors, speeds = FIELD[name]
    inside = 0
    for seed in range(count):
        fan = any_fan(seed % 20, sensors)
        fan.rng = np.random.default_rng(1000 + seed)
        trials = [(fan.imbalance[0] * fan.rng.uniform(0.3, 1.0), fan.rng.uniform(0, 360)) for _ in speeds]
        runs = [run for rpm, one in zip(speeds, trials, strict=True) for run in (fan.run(rpm), fan.run(rpm, one))]
        plane = abu_calc.balance(written(tmp_path, fan.plane, *runs)).single_plane
        inside += fan.left_by(plane.mass_g, plane.add_at_deg) <= plane.rest_at_most_g_mm
    assert inside >= 0.95 * count


def noisy_rig(seed: int) -> Workshop:
    """A rig of any size, with readings off by a percent."""
    rng = np.random.default_rng(seed)
    base = vars(Simulated())
    values = {key: float(base[key] * rng.uniform(0.6, 1.6)) for key in ("M1", "M2", "C1", "C2", "M3", "J3")}
    rig = Simulated(**values, damping=tuple(rng.uniform(100, 400, 2)))
    speed = 60 * max(rig.natural_hz()) * rng.uniform(1.6, 3.0)
    return Workshop(
        rig, tuple(rng.uniform(3, 20, 2)), tuple(rng.uniform(0, 360, 2)), float(speed), QUANTITIES[seed % 3],
        float(rng.uniform(-180, 180)), 0.01, rng,
    )  # fmt: skip


def placed(shop: Workshop, plane: int, mass: float, angle: float) -> Workshop:
    """The roll with a mass that is placed with errors of a percent."""
    one, other = 0.01 * shop.rng.standard_normal(2)
    return shop.put_on(plane, mass * (1 + one), angle + float(np.degrees(other)))


def with_trials(shop: Workshop) -> list[str]:
    runs = [shop.run()]
    for k in (0, 1):
        mass, angle = float(shop.masses[k] * shop.rng.uniform(0.5, 1.2)), float(shop.rng.uniform(0, 360))
        runs.append(placed(shop, k, mass, angle).run(trial(k, mass, angle)))
    return runs


def judged(shop: Workshop, result: BalanceResult) -> bool:
    """Whether the imbalance that is left in each plane is as told."""
    after = shop
    for k, (_, plane) in enumerate(result.planes):
        after = placed(after, k, plane.mass_g, plane.add_at_deg)
    left = np.abs(after.vectors()) * np.array(shop.rig.radii) * 1e3
    return bool(np.all(left <= [plane.rest_at_most_g_mm for _, plane in result.planes]))


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.slow
def test_the_residual_of_two_planes_by_trials_is_within_the_uncertainty_told(tmp_path: Path, count: int) -> None:
    """Both planes of a hundred rigs within their bounds; each bound alone may be exceeded once in twenty."""
    inside = 0
    for seed in range(count):
        shop = noisy_rig(seed)
        inside += judged(shop, abu_calc.balance(written(tmp_path, BARE_ROTOR, *with_trials(shop))))
    assert inside >= 0.95 * count


@pytest.mark.parametrize("count", [8, pytest.param(20, marks=pytest.mark.slow)])
@pytest.mark.slow
def test_two_planes_at_two_speeds_are_within_the_uncertainty_told(tmp_path: Path, count: int) -> None:
    """The same rolls with trial runs at a second speed, too: surer than at one, and as good as told."""
    inside, surer = 0, 0
    for seed in range(count):
        shop = noisy_rig(seed)
        slower = replace(shop, speed_rpm=0.85 * shop.speed_rpm)
        first = with_trials(shop)
        both = abu_calc.balance(written(tmp_path, BARE_ROTOR, *first, *with_trials(slower)))
        one = abu_calc.balance(written(tmp_path, BARE_ROTOR, *first))
        inside += judged(shop, both)
        surer += both.left.rest_g_mm < one.left.rest_g_mm
    assert inside >= 0.95 * count and surer >= 0.75 * count


def test_trials_in_one_fixed_ratio_are_refused_with_the_reason(tmp_path: Path) -> None:
    """Two runs with trial masses in both planes, twice as heavy in the second: they move as one."""
    shop, runs = Workshop(), [Workshop().run()]
    for factor in (1.0, 2.0):
        both = shop.put_on(0, 10.0 * factor, 0.0).put_on(1, 5.0 * factor, 90.0)
        masses = (f'{{ plane = "left", mass_g = {10.0 * factor}, angle_deg = 0.0 }}',
                  f'{{ plane = "right", mass_g = {5.0 * factor}, angle_deg = 90.0 }}')  # fmt: skip
        runs.append(both.run(f"trial = [{', '.join(masses)}]"))
    with pytest.raises(InputError, match="do not distinguish the planes") as refused:
        abu_calc.balance(written(tmp_path, BARE_ROTOR, *runs))
    assert "one fixed ratio" in str(refused.value)


def test_sensors_that_see_both_planes_alike_are_not_trusted(tmp_path: Path) -> None:
    """Both sensors beside each other: whatever the trials, the equations are singular."""

    def run(left: float, right: float, extra: str = "") -> str:
        value = 1.0 + 0.5 * left + 0.3 * right
        reading = f"{{ amplitude = {value}, phase_deg = 0.0 }}"
        return (
            f'[[run]]\nspeed_rpm = 1500\nquantity = "velocity"\nphase = "lag"\nleft = {reading}\nright = {reading}\n'
            f"{extra}\n"
        )

    runs = [run(0, 0), run(1, 0, trial(0, 1.0, 0.0)), run(0, 1, trial(1, 1.0, 0.0))]
    with pytest.raises(NotTrustworthyError, match="condition number"):
        abu_calc.balance(written(tmp_path, BARE_ROTOR, *runs))
