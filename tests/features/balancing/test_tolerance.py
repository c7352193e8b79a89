"""Shares of the permitted imbalance by hand, and imbalances as the bearings feel them.

Missing runs as `abu validate` names them, and trial masses that are safe and visible.
"""

import math
from pathlib import Path

import numpy as np
import pytest

import abu_calc
from abu_calc.features.balancing.read import METHODS, readings_template
from abu_calc.features.balancing.study import BalanceResult
from abu_calc.features.balancing.tolerance import TolerancePlanes, bearing_levers, missing_from, tolerance_shares
from tests.cli.runner import abu
from tests.features.balancing.field import Fan
from tests.features.balancing.rig import BARE_ROTOR, RIG, ROTOR, Workshop, trial, written

LENGTHS = (
    "left_end_to_left_plane_m", "left_plane_to_centre_m", "centre_to_right_plane_m", "right_plane_to_right_end_m",
)  # fmt: skip


def rotor(mass: float, lengths: tuple[float, ...]) -> str:
    rows = [f"{key} = {value}" for key, value in zip(LENGTHS, lengths, strict=True)]
    radii = "left_correction_radius_mm = 120.0\nright_correction_radius_mm = 150.0"
    return "\n".join(["[rotor]", f"mass_kg = {mass}", *rows, radii])


def balanced(folder: Path, table: str, grade: str) -> BalanceResult:
    shop = Workshop()
    runs = [shop.run(), *(shop.put_on(k, 10.0, 0.0).run(trial(k, 10.0, 0.0)) for k in (0, 1))]
    return abu_calc.balance(
        written(folder, table, *runs, f'[tolerance]\nbalance_grade = "{grade}"\nservice_speed_rpm = 3000')
    )


def test_a_centre_of_mass_near_one_bearing_holds_the_shares_within_limits(tmp_path: Path) -> None:
    """30 kg, G2.5, 3000 rpm: 9549·2.5·30/3000 = 238.7 g·mm; 0.68/0.8 = 85 % and 15 % are held at 70 and 30 %."""
    result = balanced(tmp_path, rotor(30.0, (0.1, 0.02, 0.58, 0.1)), "G2.5")
    assert result.tolerance.whole_g_mm == pytest.approx(238.73, abs=0.01)
    assert result.tolerance.left_g_mm == pytest.approx(167.1, abs=0.05)
    assert result.tolerance.right_g_mm == pytest.approx(71.6, abs=0.05)
    assert result.tolerance.planes == "bearing planes" and "0.3 … 0.7" in result.tolerance.rule
    assert (result.left.permitted_g_mm, result.right.permitted_g_mm) == pytest.approx((167.1, 71.6), abs=0.05)


def test_an_overhung_rotor_by_hand(tmp_path: Path) -> None:
    """Bearings at 0 and 0.4 m, wheel with both planes beyond the right one, its centre of mass at 0.5 m.

    30 kg, G6.3, 3000 rpm: 601.6 g·mm. The right bearing next to the wheel carries 0.5/0.4 = 1.25 of the weight, so it
    may have 1.25·601.6 = 752.0 g·mm. The left one carries 0.1/0.4 = 0.25 and is held at 0.3·601.6 = 180.5 g·mm.
    """
    result = balanced(tmp_path, rotor(30.0, (0.45, 0.05, 0.05, -0.15)), "G6.3")
    assert result.tolerance.right_g_mm == pytest.approx(752.0, abs=0.1)
    assert result.tolerance.left_g_mm == pytest.approx(180.5, abs=0.1)
    assert "outside the bearings" in result.tolerance.rule and "1.3" in result.tolerance.rule
    # forces in the planes at 0.45 and 0.55 m: the left bearing carries 1 − 0.45/0.4 and 1 − 0.55/0.4 of them
    left, right = ([1 - 0.45 / 0.4, 1 - 0.55 / 0.4], [0.45 / 0.4, 0.55 / 0.4])
    Q = np.array([12.0 * 120 * np.exp(-1j * np.radians(205)), 7.0 * 150 * np.exp(-1j * np.radians(320))])
    assert result.tolerance.left_now_g_mm == pytest.approx(abs(np.dot(left, Q)), rel=1e-6)
    assert result.tolerance.right_now_g_mm == pytest.approx(abs(np.dot(right, Q)), rel=1e-6)


def test_far_overhung_shares_are_held_at_the_largest() -> None:
    assert tolerance_shares(100.0, 0.9, -0.5) == (pytest.approx(125.0), pytest.approx(130.0))
    assert tolerance_shares(100.0, -0.5, 0.9) == (pytest.approx(130.0), pytest.approx(125.0))
    assert tolerance_shares(100.0, 0.5, 0.0) == (pytest.approx(30.0), pytest.approx(70.0))


def test_levers_keep_force_and_moment() -> None:
    for lengths in ((0.1, 0.02, 0.58, 0.1), (0.45, 0.05, 0.05, -0.15), (-0.1, 0.4, 0.3, 0.2)):
        (ll, lr), (rl, rr) = bearing_levers(lengths)
        length, planes = sum(lengths), (lengths[0], lengths[0] + lengths[1] + lengths[2])
        for plane, left, right in zip(planes, (ll, lr), (rl, rr), strict=True):
            assert left + right == pytest.approx(1.0) and right * length == pytest.approx(plane)


def test_errors_that_pull_opposite_ways_are_judged_in_the_bearing_planes() -> None:
    """A couple in planes that stand far inside the bearings is small there; each plane alone is as large as before."""
    planes = TolerancePlanes(1.0, (0.5, 0.5), "bearing planes", bearing_levers((0.4, 0.1, 0.1, 0.4)))
    assert planes.sizes([(1.0 + 0j, -1.0 + 0j)]) == pytest.approx((0.2, 0.2))
    assert planes.sizes([(1.0 + 0j, 0j), (0j, -1.0 + 0j)]) == pytest.approx((np.hypot(0.6, 0.4),) * 2)


def test_without_lengths_each_correction_plane_gets_half(tmp_path: Path) -> None:
    table = rotor(30.0, (0.1, 0.02, 0.58, 0.1)).replace("right_plane_to_right_end_m = 0.1\n", "")
    result = balanced(tmp_path, table, "G2.5")
    assert result.tolerance.planes == "correction planes"
    assert result.tolerance.left_g_mm == pytest.approx(119.4, abs=0.1)
    assert result.tolerance.left_rest_g_mm == result.left.rest_g_mm


def missing(folder: Path, *parts: str) -> tuple[str, ...]:
    return missing_from(abu_calc.read_readings(written(folder, *parts)))


def test_two_planes_run_by_run(tmp_path: Path) -> None:
    """What it names is what makes the answer: without, left, right."""
    shop = Workshop()
    runs = [shop.run(), *(shop.put_on(k, 10.0, 0.0).run(trial(k, 10.0, 0.0)) for k in (0, 1))]
    one, two = missing(tmp_path, ROTOR, runs[0]), missing(tmp_path, ROTOR, *runs[:2])
    assert "left plane, trial mass" in one[0] and "Then 1 more run." in one
    assert "right plane, trial mass" in two[0] and not any("more run" in line for line in two)
    assert missing(tmp_path, ROTOR, *runs) == () == missing(tmp_path, RIG, ROTOR, runs[0])
    assert "without a trial mass" in missing(tmp_path, ROTOR, *runs[1:])[0]


def test_four_runs_one_by_one(tmp_path: Path) -> None:
    fan = Fan()
    runs = [fan.run(1500.0, phases=False), *(fan.run(1500.0, (9.0, a), phases=False) for a in (30.0, 150.0, 270.0))]
    assert "trial mass" in missing(tmp_path, fan.plane, runs[0])[0]
    assert "9 g at 150°" in missing(tmp_path, fan.plane, *runs[:2])[0]
    assert "9 g at 270°" in missing(tmp_path, fan.plane, *runs[:3])[0]
    assert missing(tmp_path, fan.plane, *runs) == ()
    assert "without a trial mass" in missing(tmp_path, fan.plane, *runs[1:])[0]


def test_validate_passes_a_file_that_grows_and_balance_refuses_it(tmp_path: Path) -> None:
    file = written(tmp_path, ROTOR, Workshop().run())
    seen = abu("validate", file)
    assert seen.status == 0 and "Next run: 3000 rpm, left plane" in " ".join(seen.out.split())
    assert abu("validate", file, "--json").document["result"]["files"][0]["missing"]
    assert abu("balance", file).status == 2
    assert "missing" not in abu("validate", "sapropel-screw-rig", "--json").document["result"]["files"][0]


@pytest.mark.parametrize("method", METHODS)
def test_a_new_file_for_each_method_validates_and_balances(tmp_path: Path, method: str) -> None:
    file = str(tmp_path / f"{method}.toml")
    assert abu("init", "--readings", "--method", method, file).status == 0
    text = Path(file).read_text("utf-8")
    assert text == readings_template(method) and max(map(len, text.splitlines())) <= 120
    assert abu("validate", file).status == 0
    assert ('phase = "lag"' in text) == (method != "four-runs")
    options = []
    if method == "coefficients":
        trials = str(tmp_path / "trials.toml")
        assert abu("init", "--readings", "--method", "trials", trials).status == 0
        options = ["--coefficients", str(tmp_path / "own.toml")]
        assert abu("balance", trials, "-q", "--save-coefficients", options[1]).status == 0
    seen = abu("balance", file, "--json", *options)
    assert seen.status == 0 and not [c for c in seen.document["checks"] if c["status"] == "fail"]


def test_unknown_methods_and_method_without_readings_are_refused(tmp_path: Path) -> None:
    seen = abu("init", "--readings", "--method", "guess", str(tmp_path / "x.toml"))
    assert seen.status == 2 and "four-runs" in seen.err and "--method" in seen.err
    assert abu("init", "--method", "trials", str(tmp_path / "x.toml")).status == 2


def test_the_safe_mass_by_hand(tmp_path: Path) -> None:
    """40 kg, 300 mm, 1500 rpm: a tenth of the weight is 39.2 N, over 0.3·157.08² m/s² that is 5.30 g."""
    fan = Fan()
    runs = (fan.run(1500.0), fan.run(1500.0, (12.0, 40.0)))
    (trial_mass,) = abu_calc.balance(written(tmp_path, "[rotor]\nmass_kg = 40\n" + fan.plane, *runs)).trial_masses
    assert trial_mass.safe_g == pytest.approx(1e3 * 0.1 * 40 * 9.80665 / (0.3 * (50 * math.pi) ** 2), rel=1e-9)
    assert trial_mass.mass_g <= trial_mass.safe_g and trial_mass.force_percent <= 10.0
    # visible: 30 % of the vibration of 30 g are 9 g, since one plane and one sensor are in proportion
    assert trial_mass.visible_g == pytest.approx(9.0, rel=0.2)


def test_no_bearing_of_two_is_loaded_above_a_tenth(tmp_path: Path) -> None:
    """Forces of the proposed masses on both bearings, by the levers, against the loads at rest."""
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR, Workshop().run()))
    a, b, c, d = 0.15, 0.52, 0.61, 0.20
    length, weight = a + b + c + d, 64 * 9.80665
    loads = ((c + d) / length * weight, (a + b) / length * weight)
    for each, place, radius in zip(result.trial_masses, (a, a + b + c), (0.12, 0.15), strict=True):
        force = 1e-3 * each.safe_g * radius * (100 * math.pi) ** 2
        shares = force * (1 - place / length) / loads[0], force * place / length / loads[1]
        assert max(shares) == pytest.approx(0.1, rel=1e-9)


def test_without_the_mass_a_safe_trial_cannot_be_named(tmp_path: Path) -> None:
    lines = missing(tmp_path, BARE_ROTOR, Workshop().run())
    assert any("Give rotor.mass_kg" in line for line in lines)
