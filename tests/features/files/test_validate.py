"""`abu validate` refuses what the commands of a file would refuse."""

import json
import re
from pathlib import Path

import pytest

from tests.cli.runner import abu
from tests.inputs.samples import BASIC
from tests.inputs.scenes import ARM, SCENE


@pytest.mark.slow
def test_validate_takes_overrides() -> None:
    """Of every file it is given, as all commands that read one do."""
    seen = abu("validate", "msh-230", "swing-arm-grinder", "--set", "wheel.mass_kg=0.5", "--json")
    assert [one["overrides"] for one in json.loads(seen.out)["result"]["files"]] == [{"wheel.mass_kg": 0.5}] * 2
    wrong = abu("validate", "msh-230", "--set", "wheel.mass_kg=-1")
    assert wrong.status == 2 and "--set wheel.mass_kg" in wrong.err


@pytest.mark.slow
def test_validate_tells_every_file(tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.toml"
    wrong.write_text("[machine]\n", encoding="utf-8")
    seen = abu("validate", "msh-230", "swing-arm-grinder")
    assert seen.status == 0 and "msh-230: valid" in seen.out
    seen = abu("validate", "msh-230", str(wrong))
    assert seen.status == 2 and "wrong.toml" in seen.err


@pytest.mark.slow
def test_validate_prints_the_warnings_of_each_file(tmp_path: Path) -> None:
    odd, scene = tmp_path / "odd.toml", tmp_path / "scene.toml"
    odd.write_text(BASIC.replace("= 5800", "= 97") + "[swing_arm]\n", encoding="utf-8")
    scene.write_text(ARM.partition("arm_length_mm")[0], encoding="utf-8")
    arguments = ("validate", str(odd), "msh-230", str(scene))
    seen = abu(*arguments)
    told = " ".join(seen.out.split())
    assert seen.status == 0 and "! machine.speed_rpm = 97 (line 6) is unusual" in told
    assert "! [swing_arm] (line 29) takes example data" in told and "! [scene.swing_arm] (line 11)" in told
    files = json.loads(abu(*arguments, "--json", "--quiet").out)
    assert [len(one["warnings"]) for one in files["result"]["files"]] == [2, 0, 1]
    assert [line.startswith(str(path)) for line, path in zip(files["warnings"], (odd, odd, scene), strict=True)] == [
        True, True, True
    ]  # fmt: skip


FILE = "machine.toml"


@pytest.mark.parametrize(("old", "new", "key"), [
    ("max_width_mm = 32.0", "max_width_mm = 4.0", "autobalancer.max_width_mm"),
    ("max_width_mm = 32.0", "max_width_mm = 32.0\nball_count = 80", "autobalancer.ball_count"),
    ("max_width_mm = 32.0", "max_width_mm = 32.0\nrace_radius_mm = 45.0", "autobalancer.race_radius_mm"),
    ('"6203"', '"99999"', "bearing[0].designation"),
    ('"k6"', '"k9"', "bearing[0].shaft_fit"),
    ("natural_frequencies_hz = [2.5, 2.5]\ndamping_ratios = [0.5, 0.5]",
     "natural_frequencies_hz = [2.5, 2.5]\ndamping_ratios = [0.5, 0.5]\n[swing_arm]\ncutting_coefficient = 1.9",
     "swing_arm.cutting_coefficient"),
])  # fmt: skip
def test_validate_refuses_what_size_would(tmp_path: Path, old: str, new: str, key: str) -> None:
    file = tmp_path / FILE
    assert old in BASIC
    file.write_text(BASIC.replace(old, new), encoding="utf-8")
    one, other = abu("validate", str(file)), abu("size", str(file))
    assert one.status == other.status == 2
    assert re.search(rf"{re.escape(str(file))}:\d+: {re.escape(key)}: ", one.err)
    assert one.err.removeprefix("abu validate") == other.err.removeprefix("abu size")


def test_validate_refuses_scenes_too_long_to_integrate(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(SCENE.replace("= 700.0", "= 1e9"), encoding="utf-8")
    seen = abu("validate", str(file))
    assert seen.status == 2 and "scene.duration_s" in seen.err and f"{file}:9" in seen.err


def test_stored_coefficients_are_named_as_what_they_are(tmp_path: Path) -> None:
    file = tmp_path / "rolls.toml"
    file.write_text(
        '[coefficients]\nrotor = "roll"\nplanes = ["single"]\nsensors = ["1"]\n[[coefficients.at]]\n'
        "speed_rpm = 900.0\ninfluence_um_per_g_mm = [[[0.1, -0.2]]]\nstandard_error_um_per_g_mm = [[0.001]]\n",
        encoding="utf-8",
    )
    good = abu("validate", str(file))
    assert good.status == 0 and "Influence coefficients of roll: 1 plane, 1 sensor, 900 rpm" in " ".join(
        good.out.split()
    )
    file.write_text(file.read_text(encoding="utf-8").replace('["1"]', '["1", "2"]'), encoding="utf-8")
    bad = abu("validate", str(file))
    assert bad.status == 2 and "not one number for each sensor and plane" in bad.err
