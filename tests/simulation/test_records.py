"""Studies of scenes from Python: what their commands print, of machines, of scene files, and of scenes in SI."""

from dataclasses import replace
from pathlib import Path

import pytest

import abu_calc
from abu_calc.cli import command as scene_options
from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.features.accuracy import study as accuracy_module
from abu_calc.features.effects.study import known_effects
from abu_calc.features.stability import command as cli_stability
from abu_calc.features.stability import study as stability_module
from abu_calc.foundation.quantity import as_plain
from abu_calc.simulation import scene_of_design as from_design
from abu_calc.simulation.result import Result
from abu_calc.simulation.subject import subject_of
from tests.cli.runner import abu
from tests.inputs.scenes import SCENE
from tests.remembered import recalled
from tests.results.test_face import without_clock


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Two balls on a planar rotor, gravity and a race that is hardly eccentric."""
    path = tmp_path / "scene.toml"
    effects = "[scene.effects]\ngravity = {}\nrace_eccentricity = { magnitude_mm = 0.0003 }\n"
    path.write_text(SCENE.replace("700.0", "20.0") + effects, encoding="utf-8")
    return path


def same(result: Result, *arguments: str) -> None:
    """Whether a result is what `abu arguments… --json` prints."""
    document = abu(*arguments, "--json").document
    assert without_clock(result.to_dict()) == without_clock(document["result"])
    assert (result.status, list(result.warnings)) == (document["status"], document["warnings"])
    checks = [{key: value for key, value in check.items() if key != "change"} for check in document["checks"]]
    assert [as_plain(vars(check)) for check in result.checks] == checks
    assert result.model.to_dict().keys() == document["model"].keys()
    assert result.provenance.input == document["input"]


def test_simulating_returns_what_the_command_prints(file: Path) -> None:
    scene = abu_calc.read_scene(file).changed({"scene.speed_rpm": 30.0})
    result = abu_calc.simulate(scene, accuracy=0.05, duration_s=15.0, without_effects=["gravity"], audit=True)
    same(result, "simulate", str(file), "--set", "scene.speed_rpm=30.0", "--accuracy", "0.05", "--duration", "15",
         "--without", "gravity", "--audit")  # fmt: skip
    assert result.audit is not None and [check.code for check in result.checks] == ["ABU801", "ABU803"]
    assert result.motion is None and result.title == "scene.toml"


@pytest.mark.slow
def test_stability_and_effects_return_what_their_commands_print(file: Path) -> None:
    scene, machine = abu_calc.read_scene(file), abu_calc.read("avtovaz-707-222")
    same(abu_calc.stability(scene, speeds_rpm=(5, 190)), "stability", str(file), "--speeds", "5:190")
    same(abu_calc.stability(machine), "stability", "avtovaz-707-222")
    same(abu_calc.effects(scene, accuracy=0.1), "effects", str(file), "--accuracy", "0.1")
    same(abu_calc.effects(machine, "grinding"), "effects", "avtovaz-707-222", "--scene", "grinding")
    same(known_effects(), "effects")


@pytest.mark.slow
def test_accuracy_returns_what_the_command_prints(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One measurement for both, a short one: what is quickest is the clock's."""
    file.write_text(SCENE.replace("700.0", "20.0"), encoding="utf-8")
    monkeypatch.setattr(accuracy_module, "TOLERANCES", (1e-4,))
    monkeypatch.setattr(accuracy_module, "REPEATS", 1)
    once, found = accuracy_module.price_list, []

    def measured(*given):
        found.extend([] if found else [once(*given)])
        return found[0]

    monkeypatch.setattr(accuracy_module, "price_list", measured)
    result = abu_calc.accuracy(abu_calc.read_scene(file), quantity="level", accuracy=0.02, budget_s=60)
    same(result, "accuracy", str(file), "--quantity", "level", "--accuracy", "0.02", "--time-budget", "60")
    assert result.points and result.chosen is not None
    assert {check.code: check.value for check in result.checks} == {"ABU811": result.chosen.error}


@pytest.mark.slow
def test_sizing_and_simulating_agree_on_a_scene() -> None:
    """With the same effects, to the last digit."""
    machine = abu_calc.read("avtovaz-707-222")
    sized, alone = recalled("size", machine).simulation[0].to_dict(), recalled("simulate", machine).to_dict()
    for key in sized.keys() - {"effects", "cost", "settling_estimates"}:
        assert alone[key] == sized[key], key
    assert {each["name"]: each["included"] for each in alone["effects"]} == {
        each["name"]: each["included"] for each in sized["effects"]
    }


def test_a_scene_in_si_is_simulated_as_its_file(file: Path) -> None:
    """With its own effects, chosen by their weights as those of a file are."""
    description = abu_calc.read_scene(file)
    scene = replace(subject_of(description).scene, name="mine")
    told, mine = abu_calc.simulate(description), abu_calc.simulate(scene)
    one, other = (without_clock(result.to_dict()) for result in (told, mine))
    assert {**one, "scene": "mine"} == other and [each.name for each in mine.effects if each.included] == ["gravity"]
    assert (mine.title, mine.provenance.input, mine.warnings) == ("mine", None, told.warnings)
    assert abu_calc.stability(scene).growth_rate_per_s == abu_calc.stability(description).growth_rate_per_s
    assert abu_calc.effects(scene).effects == abu_calc.effects(description).effects


def test_a_simulation_hands_on_how_it_moved(file: Path) -> None:
    result = abu_calc.simulate(abu_calc.read_scene(file), samples=5)
    motion = result.motion
    assert motion is not None and motion.t_s.tolist() == [0, 5, 10, 15, 20]
    assert motion.x_mm.shape == motion.y_mm.shape == (5,) and motion.ball_angles_deg.shape == (2, 5)
    assert (motion.x_mm[-1], motion.y_mm[-1]) == pytest.approx((result.final.x_mm, result.final.y_mm), rel=1e-9)
    assert {"motion", "run"}.isdisjoint(result.to_dict())
    # Further states than axis and balls stand in the run.
    assert len(result.run.trajectory.at([5.0])) == 8 and result == replace(result, motion=None)


def test_every_effect_says_itself_what_it_is() -> None:
    """Not by its docstring, which `python -OO` takes away."""
    assert all(vars(kind)["about"][0].isupper() and kind.name == name for name, kind in REGISTRY)


def test_help_names_the_scenes_there_are() -> None:
    """Written out in the commands, so that `--help` loads no numerics."""
    assert tuple(from_design.SCENES) == scene_options.SCENES and cli_stability.SCENES == stability_module.SCENES
