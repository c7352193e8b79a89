"""Subjects of studies: machines, scene files and scenes of scripts."""

import math
from pathlib import Path

import pytest

import abu_calc
from abu_calc.foundation.errors import InputError
from abu_calc.simulation.scene_of_design import STARTS
from abu_calc.simulation.subject import subject_of
from tests.dynamics.scenes import dimensionless
from tests.inputs.scenes import SCENE, read

SCRIPT = dimensionless(3.0, 0.05, 0.05, 0.2, 0.3, (1.0, 2.5), 400.0)
PINS = {"autobalancer.ball_count": 4, "autobalancer.ball_diameter_mm": 12.0, "autobalancer.race_radius_mm": 30.0}


def test_a_scene_of_a_script_has_no_file() -> None:
    subject = subject_of(SCRIPT)
    assert (subject.title, subject.reading, subject.design) == ("dimensionless", None, None)
    assert subject.provenance.input is None and subject.scene is SCRIPT


def test_a_scene_file_is_called_by_its_name(tmp_path: Path) -> None:
    subject = subject_of(read(tmp_path, SCENE))
    assert subject.title == "scene.toml" and subject.start == "as the file says"
    assert subject.provenance.sha256 is not None


@pytest.mark.parametrize(("argument", "value"), [("scene", "idle"), ("start", "spread"), ("race_centre_deg", 0.0)])
def test_what_machines_alone_take_is_refused_for_scenes(argument: str, value: str | float) -> None:
    with pytest.raises(InputError, match="for machines only") as caught:
        subject_of(SCRIPT, **{argument: value})  # type: ignore[arg-type]
    assert (caught.value.place.key, caught.value.found) == (argument, str(value))


def test_unknown_scenes_and_starts_are_refused_by_their_argument() -> None:
    for argument in ("scene", "start"):
        with pytest.raises(InputError) as caught:
            subject_of(SCRIPT, **{argument: "sideways"})
        assert caught.value.place.key == argument and "sideways" in str(caught.value)


def test_a_machine_is_idle_with_its_balls_together_unless_told_otherwise() -> None:
    machine = abu_calc.read("msh-230").changed(PINS)
    usual, spread = subject_of(machine), subject_of(machine, start="spread", race_centre_deg=90)
    assert usual.scene.name == "idle" and usual.design is not None
    assert usual.start.startswith(STARTS["bunched"]) and "180°" in usual.start
    assert spread.start.startswith(STARTS["spread"]) and "90°" in spread.start
    eccentricity = spread.scene.effect("race_eccentricity")
    assert eccentricity is not None and eccentricity.angle == pytest.approx(math.pi / 2)  # type: ignore[attr-defined]
    touching = math.asin(6.0 / (30.0 - 6.0))
    assert usual.half_angle == pytest.approx(touching)


def test_a_centre_beyond_a_turn_is_refused() -> None:
    with pytest.raises(InputError) as caught:
        subject_of(abu_calc.read("msh-230"), race_centre_deg=361)
    assert caught.value.place.key == "race_centre_deg"


def test_a_duration_too_long_is_refused_by_its_argument_or_its_key(tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        subject_of(SCRIPT).lasting(1e12)
    assert caught.value.place.key == "duration_s"
    assert subject_of(read(tmp_path, SCENE)).lasting(None).scene.duration == 700.0
