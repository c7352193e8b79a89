"""Missing runs as `abu validate` names them, and trial masses that are safe and visible."""

import math
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.balancing.read import METHODS, readings_template
from abu_calc.features.balancing.tolerance import missing_from
from tests.cli.runner import abu
from tests.features.balancing.field import Fan
from tests.features.balancing.rig import BARE_ROTOR, RIG, ROTOR, Workshop, trial, written


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
