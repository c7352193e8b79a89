"""What one meets first: `abu` alone, its help, completion, and the files it writes."""

import json
import re
import shlex
from pathlib import Path

import pytest

from abu_calc.cli.app import COMMANDS, COMPLETION, FIRST_STEPS, run
from tests.cli.runner import abu, once


@pytest.fixture(autouse=True)
def terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")


@pytest.mark.slow
def test_alone_it_shows_three_commands_that_work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = abu()
    assert seen.status == 0 and seen.out == FIRST_STEPS + "\n" and not seen.err and seen.width <= 80
    lines = re.findall(r"(?m)^  (abu .*?)  ", seen.out)
    commands = [shlex.split(line)[1:] for line in lines]
    assert [command[0] for command in commands] == ["size", "init", "check-fit"]
    monkeypatch.chdir(tmp_path)
    for command in commands:
        further = ["--all-keys"] if command[0] == "init" else []  # in a terminal it asks
        done = once(*command) if command[0] == "size" else abu(*command, *further)
        assert done.status in (0, 1) and done.out and "Traceback" not in done.err
    assert (tmp_path / "my-grinder.toml").is_file() and abu("validate", "my-grinder.toml").status == 0


def test_help_is_not_cut_at_80_columns() -> None:
    seen = abu("--help")
    assert seen.width <= 80 and "..." not in seen.out.partition("\n")[2] and "--install-completion" in seen.out
    sections = re.findall(r"(?m)^(Design|Simulate|Measure|Files):\n((?:  .*\n)+)", seen.out)
    assert [title for title, _ in sections] == ["Design", "Simulate", "Measure", "Files"]
    listed = [name for _, rows in sections for name in re.findall(r"(?m)^  (\S+) ", rows)]
    assert sorted(listed) == sorted(COMMANDS)
    for command in listed:
        told = abu(command, "--help").out
        assert max(map(len, told.splitlines())) <= 80, command
        assert not re.search(r"[a-z,]\.\.\.", told), command
        assert len(told.splitlines()) <= 48, command


def test_help_all_explains_every_option_that_help_lists_by_name() -> None:
    short, whole = abu("check-fit", "--help").out, abu("check-fit", "--help-all").out
    named = re.search(r"(?s)More options, explained by --help-all:\n(.*?)\n\n", short)
    assert named is not None and len(whole.splitlines()) > 48
    names = re.findall(r"--[\w-]+", named[1])
    assert len(names) > 20 and all(re.search(rf"(?m)^  (-q, )?{name} .*\w", whole) for name in names)
    assert {*re.findall(r"--[\w-]+", short)} == {*re.findall(r"(?m)^  (?:-\w, )?(--[\w-]+)", whole)}


@pytest.mark.parametrize(("words", "expected"), [("abu si", "simulate"), ("abu size --acc", "--accuracy")])
def test_shells_can_complete(
    words: str, expected: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(COMPLETION, "complete_bash")
    monkeypatch.setenv("COMP_WORDS", words)
    monkeypatch.setenv("COMP_CWORD", str(len(words.split()) - 1))
    with pytest.raises(SystemExit):
        run([])
    assert expected in capsys.readouterr().out.split()


def test_a_new_scene_is_a_real_machine(tmp_path: Path) -> None:
    """A grinder of some kilograms at its speed, whose balls of steel carry the imbalance, and which balances."""
    file = tmp_path / "scene.toml"
    assert abu("init", "--scene", str(file)).status == 0
    document = abu("simulate", str(file), "--json").document
    model, result = document["model"], document["result"]
    assert document["status"] == "pass" and not document["warnings"]
    assert 3 < model["mass_kg"][0][0] < 10 and 500 < model["speed_rad_per_s"] < 1000
    race = model["races"][0]
    moment = sum(race["ball_masses_kg"]) * race["pitch_radius_m"]
    assert race["inertia_factor"] == 1.4 and model["imbalance_kg_m"] < moment / 2
    for mass in race["ball_masses_kg"]:
        assert mass == pytest.approx(4 / 3 * 3.14159 * 0.008**3 * 7800, rel=0.02)
    assert result["settling_time_s"] < 1 and result["residual_imbalance_g_mm"] < 0.05 * 256


@pytest.mark.slow
def test_the_effects_of_a_new_scene_can_be_switched_on(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    abu("init", "--scene", str(file))
    text = file.read_text(encoding="utf-8")
    before, head, after = text.partition("#[scene.effects]\n")
    wanted, gap, rest = after.partition("# Wheel and work under load.")
    file.write_text(before + head[1:] + re.sub(r"(?m)^#(?=\[|[a-z_]+ = )", "", wanted) + gap + rest, encoding="utf-8")
    document = abu("simulate", str(file), "--accuracy", "0.1", "--json").document
    assert document["status"] == "pass", json.dumps(document)[:500]
    assert {one["name"] for one in document["result"]["effects"]} == {
        "gravity", "dry_rolling_friction", "ball_contact", "race_eccentricity",
    }  # fmt: skip
