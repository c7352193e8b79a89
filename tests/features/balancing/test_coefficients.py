"""Stored influence coefficients: written, read back, used for the next rotor, and checked."""

import json
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import abu_calc
from abu_calc.features.balancing.coefficients import read_coefficients
from abu_calc.foundation.errors import InputError
from tests.cli.runner import abu
from tests.features.balancing.field import Fan
from tests.features.balancing.rig import BARE_ROTOR, Workshop, trial, written
from tests.features.balancing.test_methods import judged, noisy_rig, placed, with_trials


def saved(folder: Path, shop: Workshop, name: str = "coefficients.toml") -> str:
    target = folder / name
    seen = abu(
        "balance", written(folder, BARE_ROTOR, *with_trials(shop)), "-q", "--force", "--save-coefficients", str(target)
    )
    assert seen.status in (0, 1), seen.err
    return str(target)


def next_rotor(shop: Workshop, seed: int) -> Workshop:
    rng = np.random.default_rng(5000 + seed)
    return replace(shop, masses=tuple(rng.uniform(3, 20, 2)), angles=tuple(rng.uniform(0, 360, 2)), rng=rng)


def check(result: object, code: str) -> object:
    return next(each for each in result.checks if each.code == code)  # type: ignore[attr-defined]


def test_a_file_reads_back_to_the_same_coefficients(tmp_path: Path) -> None:
    shop = replace(noisy_rig(3), noise=0.0)
    stored = read_coefficients(saved(tmp_path, shop))
    result = abu_calc.balance(written(tmp_path, BARE_ROTOR, *with_trials(replace(shop, rng=np.random.default_rng(3)))))
    assert stored.planes == ("left", "right") == stored.sensors and len(stored.values.speeds) == 1
    assert stored.values.speeds[0] == pytest.approx(shop.speed, rel=1e-9)
    content = tomllib.loads(Path(stored.file).read_text("utf-8"))["coefficients"]["at"][0]
    assert np.shape(content["influence_um_per_g_mm"]) == (2, 2, 2)
    for plane, radius in enumerate(shop.rig.radii):
        moved = shop.rig.motion(shop.speed, [1.0 * (k == plane) for k in (0, 1)], (0.0, 0.0)) / (1e-3 * radius)
        column = [row[plane] for row in stored.values.matrices[0]]
        assert column == pytest.approx(list(moved * np.exp(-1j * np.radians(0))), rel=0.1)
    assert result.coefficients_text is not None


@pytest.mark.parametrize(
    "count", [8, pytest.param(40, marks=pytest.mark.slow), pytest.param(100, marks=pytest.mark.hard)]
)
@pytest.mark.slow
def test_the_next_rotor_is_balanced_within_the_uncertainty_told(tmp_path: Path, count: int) -> None:
    """Coefficients of a noisy set of trial runs of one rotor, another rotor on the same rig: 95 of 100."""
    inside = 0
    for seed in range(count):
        shop = noisy_rig(seed)
        coefficients = saved(tmp_path, shop)
        other = next_rotor(shop, seed)
        result = abu_calc.balance(written(tmp_path, BARE_ROTOR, other.run(), name="next.toml"), coefficients)
        assert result.method == "stored coefficients"
        inside += judged(other, result)
    assert inside >= 0.95 * count


def test_one_run_warns_and_the_run_after_the_correction_passes_or_fails(tmp_path: Path) -> None:
    """A second run with the correction as its trial tells whether the coefficients still fit."""
    shop = noisy_rig(7)
    coefficients = saved(tmp_path, shop)
    other = next_rotor(shop, 7)
    first = other.run()
    once = abu_calc.balance(written(tmp_path, BARE_ROTOR, first, name="one.toml"), coefficients)
    assert check(once, "ABU1010").status == "warn" and once.status == "pass"

    def second(machine: Workshop) -> str:
        left, right = once.left, once.right
        after = placed(placed(machine, 0, left.mass_g, left.add_at_deg), 1, right.mass_g, right.add_at_deg)
        masses = ", ".join(trial(k, p.mass_g, p.add_at_deg)[8:] for k, p in enumerate((left, right)))
        return after.run(f"trial = [{masses}]")

    twice = abu_calc.balance(written(tmp_path, BARE_ROTOR, first, second(other), name="two.toml"), coefficients)
    assert check(twice, "ABU1010").status == "pass"
    softer = replace(other, rig=replace(other.rig, C1=0.3 * other.rig.C1, M1=2 * other.rig.M1))
    changed = abu_calc.balance(
        written(tmp_path, BARE_ROTOR, softer.run(), second(softer), name="two.toml"), coefficients
    )
    assert check(changed, "ABU1010").status in ("warn", "fail") and "anew" in check(changed, "ABU1010").remedy


def test_other_speeds_planes_and_sensors_are_refused(tmp_path: Path) -> None:
    shop = noisy_rig(4)
    coefficients = saved(tmp_path, shop)
    slower = replace(shop, speed_rpm=0.8 * shop.speed_rpm)
    with pytest.raises(InputError, match="no stored coefficients are of this speed"):
        abu_calc.balance(written(tmp_path, BARE_ROTOR, slower.run(), name="next.toml"), coefficients)
    fan = Fan()
    with pytest.raises(InputError, match="other planes"):
        abu_calc.balance(written(tmp_path, fan.plane, fan.run(1500.0), name="next.toml"), coefficients)
    with pytest.raises(InputError, match="holds no influence coefficients"):
        abu_calc.balance(written(tmp_path, BARE_ROTOR, shop.run(), name="next.toml"), "sapropel-screw-rig")


def test_coefficients_in_place_of_readings_are_refused_with_the_option(tmp_path: Path) -> None:
    seen = abu("balance", saved(tmp_path, noisy_rig(2)))
    assert seen.status == 2 and "--coefficients FILE" in seen.err


def test_a_damaged_file_is_refused_with_line_and_key(tmp_path: Path) -> None:
    coefficients = Path(saved(tmp_path, noisy_rig(5)))
    good = coefficients.read_text("utf-8")
    file = written(tmp_path, BARE_ROTOR, noisy_rig(5).run(), name="next.toml")
    for old, new, words in (
        ("speed_rpm", "speed", "speed_rpm"), ("sensors = [", 'sensors = [\n"third",', "for each sensor and plane"),
        ("standard_error_um_per_g_mm = [", "standard_error_um_per_g_mm = [[-1.0, 0.0],", "at least 0"),
    ):  # fmt: skip
        coefficients.write_text(good.replace(old, new, 1), "utf-8")
        seen = abu("balance", file, "--coefficients", str(coefficients))
        assert seen.status == 2 and words in seen.err and "coefficients.toml:" in seen.err, seen.err


@pytest.mark.slow
def test_the_options_of_the_command(tmp_path: Path) -> None:
    """A file is not overwritten, and answers without trial masses have no coefficients to save."""
    shop = noisy_rig(6)
    coefficients = saved(tmp_path, shop)
    trials = written(tmp_path, BARE_ROTOR, *with_trials(shop))
    again = abu("balance", trials, "-q", "--save-coefficients", coefficients)
    assert again.status == 2 and "--force" in again.err
    none = abu("balance", "sapropel-screw-rig", "-q", "--save-coefficients", str(tmp_path / "x.toml"))
    assert none.status == 2 and "come from trial masses" in none.err and not (tmp_path / "x.toml").exists()
    used = abu(
        "balance", written(tmp_path, BARE_ROTOR, shop.run(), name="n.toml"), "--json", "--coefficients", coefficients
    )
    assert used.status == 0 and json.loads(used.out)["result"]["coefficients_file"] == coefficients
