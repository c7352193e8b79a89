"""`abu simulate`, `abu stability` and `abu compare` of a machine with two races."""

import math
import shlex

import pytest

import abu_calc
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.features.compare import study
from abu_calc.features.compare.study import compare
from abu_calc.features.spindle.case import size_races
from abu_calc.features.spindle.records import repeated
from abu_calc.features.spindle.start_cases import scene_of, spindle_subject, start_cases
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import variant_of
from abu_calc.simulation.start_cases import Member, StartOutcome
from tests.cli.runner import abu
from tests.remembered import recalled

PRESET = "pedestal-grinder"


@pytest.mark.slow
def test_a_run_ends_balanced_in_both_races() -> None:
    result = abu_calc.simulate(abu_calc.read(PRESET))
    assert result.status == "pass"
    assert result.axis_amplitude_mm < 0.3 * (result.unbalanced_amplitude_mm or 0.0)
    assert result.settling_time_s is not None
    assert any("in phase" in warning for warning in result.warnings)


@pytest.mark.slow
def test_stability_changes_above_both_critical_speeds() -> None:
    """Critical speeds 730 and 804 rpm; two races of finite mass balance above 864.4 rpm with four balls each."""
    result = abu_calc.stability(abu_calc.read(PRESET), speeds_rpm=(700.0, 3000.0))
    assert result.stable
    (boundary,) = result.boundaries_rpm or ()
    assert 804.455 < boundary.speed_rpm < 950


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"start": "settled"}, "no such start"),
        ({"scene": "grinding"}, "no such scene"),
    ],
)
def test_what_two_races_do_not_have_is_refused(keys: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        abu_calc.simulate(abu_calc.read(PRESET), **keys)  # type: ignore[arg-type]


@pytest.mark.slow
def test_a_heavier_wheel_stands_beside_the_preset(monkeypatch: pytest.MonkeyPatch) -> None:
    """The design of the preset stands for both."""
    machine = abu_calc.read(PRESET)
    monkeypatch.setattr(study, "size", lambda *_, **__: recalled("size", machine))
    result = compare([machine, machine.changed({"wheel.0.imbalance_g_mm": 2000.0})])
    rows = {row.path: row.values for row in result.differences}
    assert rows["wheel[0].imbalance_g_mm"] == (2500.0, 2000.0)


def test_a_start_that_is_placed_has_an_angle_for_each_ball() -> None:
    machine = abu_calc.read(PRESET).changed({"start.angles_deg": [0.0, 90.0]})
    with pytest.raises(InputError, match="one angle for each ball") as caught:
        abu_calc.simulate(machine)
    assert caught.value.allowed == "10"


@pytest.mark.parametrize("name", ["pedestal-grinder", "washing-machine-two-races"])
def test_printed_options_make_the_scene_of_every_start_case(name: str) -> None:
    """Phases, sides, angles of balls, oil, speed, run-up and the variations of what is promised."""
    machine = abu_calc.read(name)
    design = size_races(machine)
    for member in start_cases(design):
        words = shlex.split(repeated(outcome_of(member), design))
        options = dict(zip(words[::2], words[1::2], strict=True))
        entries = [value for word, value in zip(words[::2], words[1::2], strict=True) if word == "--set"]
        side, start = float(options["--race-centre"]), options.get("--start")
        made = spindle_subject(variant_of(machine, ",".join(entries)), None, start, side).scene
        wanted = scene_of(design, member)
        assert [effect.name for effect in made.effects] == [effect.name for effect in wanted.effects]
        assert numbers(made) == pytest.approx(numbers(wanted), abs=2e-6, rel=1e-9)


def outcome_of(member: Member) -> StartOutcome:
    return StartOutcome(member, None, None, None, False, 0.0, 0.0, 0.0, 0.0, 0.0)


def numbers(scene: Scene) -> list[float]:
    """All that a start case may change, angles by their cosines and sines."""
    angles = [scene.imbalance_angle, scene.couple_angle, *(a for race in scene.races for a in race.start_angles)]
    eccentricity, run_up = scene.effect("race_eccentricity"), scene.effect("run_up")
    if isinstance(eccentricity, RaceEccentricityEffect):
        angles.append(eccentricity.angle)
    return [
        *map(math.cos, angles), *map(math.sin, angles), 1e3 * scene.imbalance, 1e3 * scene.couple, scene.speed,
        scene.duration, 1e6 * getattr(eccentricity, "magnitude", 0.0), getattr(run_up, "duration", 0.0),
        *(value for race in scene.races for value in (race.drag, race.pitch_radius, race.plane_offset)),
        *(speed for race in scene.races for speed in race.start_speeds),
    ]  # fmt: skip


def test_some_starts_only_are_refused() -> None:
    with pytest.raises(InputError, match="all start cases"):
        abu_calc.size(abu_calc.read(PRESET), starts="none")


def test_a_changed_machine_as_text_is_read_as_the_same() -> None:
    machine = abu_calc.read(PRESET).changed({"wheel.0.imbalance_g_mm": 2400.0})
    assert abu_calc.read(machine.to_toml()).tables == machine.tables


@pytest.mark.slow
def test_the_command_prints_one_screen() -> None:
    seen = abu("simulate", PRESET)
    assert "2 races with 10 balls" in " ".join(seen.out.split())
