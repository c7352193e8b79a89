"""`abu balance` as its users see it: orders, drawing, checks with their numbers, one screen, files."""

import json
import subprocess
import sys
import tomllib
from pathlib import Path

import jsonschema
import pytest

import abu_calc
from tests.cli.runner import Seen, abu
from tests.features.balancing.rig import BARE_ROTOR, RIG, ROTOR, Workshop, trial, turned, written
from tests.house.structure import ROOT

PRESET = "sapropel-screw-rig"


@pytest.fixture(autouse=True)
def terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")


def fits(seen: Seen) -> bool:
    return len(seen.out.splitlines()) <= 48 and seen.width <= 80


def test_the_preset_says_what_to_do_on_one_screen() -> None:
    seen = abu("balance", PRESET)
    lines = [line.strip() for line in seen.out.splitlines()]
    assert seen.status == 0 and fits(seen)
    assert lines[1] == "PASS: 8 of 8 checks pass"
    assert lines[2:4] == ["LEFT plane: remove 12.00 g at 205.0°.", "RIGHT plane: remove 7.000 g at 320.0°."]
    assert any(line.startswith("expected after correction") and "48 g·mm" in line for line in lines)
    assert "AGAINST rotation" in abu("balance", PRESET, "--full").out


def test_explain_adds_every_formula_with_the_numbers_to_the_report() -> None:
    full, explained = (abu("balance", PRESET, option) for option in ("--full", "--explain"))
    assert explained.status == 0 and explained.width <= 80 and explained.out.startswith(full.out.rstrip()[:2000])
    assert "→ left plane: q = 12.00 g at 205.0°" in explained.out and "→ left plane" not in full.out
    assert "Source: Goodman 1964" in explained.out


@pytest.mark.slow
def test_the_document_is_as_interface_and_schema_say() -> None:
    document = abu("balance", PRESET, "--json").document
    result = document["result"]
    for side in ("left", "right"):
        assert result[side].keys() >= {
            "mass_g", "angle_deg", "mass_uncertainty_g", "angle_uncertainty_deg", "remove_at_deg", "add_at_deg",
        }  # fmt: skip
    assert result["residual_check"]["reproduced"] < 1e-12
    assert result["natural_frequencies_hz"] == pytest.approx([12.5422, 17.3499], rel=1e-5)
    assert result == abu_calc.balance(PRESET).to_dict() == abu_calc.balance(abu_calc.read_readings(PRESET)).to_dict()
    jsonschema.Draft202012Validator(json.loads(abu("schema", "result").out)).validate(document)


@pytest.mark.slow
def test_init_validate_schema_verify_presets_and_explain_know_the_kind(tmp_path: Path) -> None:
    file = str(tmp_path / "mine.toml")
    assert "abu balance" in " ".join(abu("init", "--readings", file).out.split())
    assert abu("validate", file).status == 0 and abu("balance", file, "-q").status == 0
    assert abu("init", "--readings", file).status == 2
    schema = json.loads(abu("schema", "readings").out)
    jsonschema.Draft4Validator(schema).validate(tomllib.loads(Path(file).read_text(encoding="utf-8")))
    assert abu("init", "--readings", "--scene", str(tmp_path / "x.toml")).status == 2
    copy = str(tmp_path / "copy.toml")
    assert "abu balance" in " ".join(abu("init", "--preset", PRESET, copy).out.split())
    assert abu("verify", copy).status == 0 and abu("verify", str(tmp_path)).status == 0
    text = Path(copy).read_text(encoding="utf-8")
    Path(copy).write_text(text.replace('"left.mass_g" = 12.0', '"left.mass_g" = 13.0'), encoding="utf-8")
    assert abu("verify", copy).status == 1
    assert abu("verify", "--update", copy).status == 0 and abu("verify", copy).status == 0
    Path(copy).write_text(text.split("[expected]")[0], encoding="utf-8")
    assert abu("verify", "--update", copy).status == 0 and '"left.angle_deg" = 205.0' in Path(copy).read_text("utf-8")
    assert PRESET in abu("presets").out and abu("presets", PRESET).out == text
    assert "wrong side" in " ".join(abu("explain", "balance").out.split())
    assert abu("verify", PRESET).status == 0


@pytest.mark.slow
def test_it_needs_no_scipy() -> None:
    lines = ("import sys", "from abu_calc.cli.app import run", f"run(['balance', '{PRESET}', '-q'])")
    code = "; ".join((*lines, "print('scipy' in sys.modules)"))
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_other_commands_send_readings_to_balance() -> None:
    for command in ("size", "simulate", "stability", "check-fit"):
        seen = abu(command, PRESET)
        assert seen.status == 2 and "`abu balance FILE` takes it" in seen.err
    assert "`abu size FILE` takes it" in abu("balance", "msh-230").err


def test_trial_runs_that_do_not_suffice_are_refused_with_what_is_missing(tmp_path: Path) -> None:
    shop = Workshop()
    runs = [shop.run(), shop.put_on(0, 10.0, 0.0).run(trial(0, 10.0, 0.0))]
    seen = abu("balance", written(tmp_path, BARE_ROTOR, *runs))
    assert seen.status == 2 and "none with a trial in the right plane" in seen.err and "three runs" in seen.err
    other = Workshop(speed_rpm=2000.0).put_on(1, 10.0, 0.0).run(trial(1, 10.0, 0.0))
    seen = abu("balance", written(tmp_path, BARE_ROTOR, *runs, other))
    assert seen.status == 2 and "one speed" in seen.err


@pytest.mark.slow
@pytest.mark.parametrize("count", [1, 12])
def test_every_report_fits(tmp_path: Path, count: int) -> None:
    """Many runs of all quantities near a natural frequency, with everything that can be said."""
    shops = [Workshop(speed_rpm=1100.0 + 40 * k, quantity=("acceleration", "velocity")[k % 2]) for k in range(count)]
    extra = "max_removable_g = 1.0\nleft_places_deg = [200, 210]\nfirst_bending_speed_rpm = 1500"
    grade = '[tolerance]\nbalance_grade = "G0.4"'
    file = written(tmp_path, RIG, ROTOR, extra, *(shop.run() for shop in shops), grade)
    seen = abu("balance", file)
    assert seen.status == 1 and fits(seen), seen.out
    assert abu("balance", file, "--full").width <= 80
    assert abs(turned(abu_calc.balance(file).left.angle_deg, 205)) < 1e-3
