"""Scene files as scenes: every number in SI, every support and effect, and scenes that can be integrated."""

import math
from pathlib import Path

import numpy as np
import pytest

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.scipy_solvers import integrate
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.supports.planar import LinearSupport
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.foundation.errors import InputError
from abu_calc.simulation.scene_of_file import scene_from
from tests.inputs.scenes import ARM, PLANAR, SCENE, TILTING, read

RPM = math.pi / 30


def scene(folder: Path, text: str) -> Scene:
    return scene_from(read(folder, text).scene)


def run(scene: Scene, revolutions: float = 3.0) -> Trajectory:
    """A few revolutions at the tolerance 1e-6."""
    done = integrate(assemble(with_parted_balls(scene)[0]), 1e-6, [revolutions * scene.revolution])
    assert np.isfinite(done.y).all()
    return done


def test_planar_scene_in_si(tmp_path: Path) -> None:
    found = scene(
        tmp_path, SCENE.replace("duration_s", "initial = { x_mm = 2, y_mm = -3, vy_mm_per_s = 4 }\nduration_s")
    )
    support = found.support
    assert isinstance(support, LinearSupport)
    assert (support.mass[0][0], support.stiffness[1][1], support.damping[0][0]) == (1.0, 1.0, 0.02)
    assert (found.start_position, found.start_velocity) == ((0.002, -0.003), (0.0, 0.004))
    assert found.speed == pytest.approx(2.0)
    assert (found.imbalance, found.duration, found.effects) == (0.01, 700.0, ())
    race = found.races[0]
    assert (race.pitch_radius, race.drag, race.inertia_factor, race.ball_radius) == (1.0, 0.01, 1.0, 0.0)
    assert race.ball_masses == (0.05, 0.05) and race.start_speeds == (0.0, 0.0)
    assert race.start_angles == pytest.approx((math.pi / 2, -math.pi / 2))


@pytest.mark.parametrize(("rolling", "corrector", "factor"), [
    ("true", "ball", 7 / 5), ("true", "roller", 3 / 2), ("false", "ball", 1.0), ("false", "roller", 1.0),
])  # fmt: skip
def test_what_rolls_has_its_inertia(tmp_path: Path, rolling: str, corrector: str, factor: float) -> None:
    text = SCENE.replace("rolling_inertia = false", f"rolling_inertia = {rolling}") + f'corrector = "{corrector}"\n'
    assert scene(tmp_path, text).races[0].inertia_factor == factor


def test_every_effect_is_built_in_si_and_in_order(tmp_path: Path) -> None:
    found = scene(tmp_path, PLANAR.replace("time_s = 1.0", "time_s = 1.0, run_down_s = 2.0"))
    deg = math.pi / 180
    expected = (
        RunUpEffect(1.0, 2.0),
        MotorEffect(3.0, 6000 * RPM, 2e-3),
        RaceEccentricityEffect(1e-5, 0.0),
        TransverseMotionEffect(0.0237, 0.008, 5e-5, False),
        GravityEffect(),
        GrindingContactEffect(45.0, 0.35, "compliant", 2e5, -1, 4e-5, 0.0, 0.075, 0.0),
        BallContactEffect(0.008, 0.5),
        DryRollingFrictionEffect(2e-6, 0.008),
    )
    assert [kind for _, kind in REGISTRY if kind in map(type, expected)] == list(map(type, expected))
    for effect, wanted in zip(found.effects, expected, strict=True):
        assert type(effect) is type(wanted)
        assert vars(effect) == pytest.approx(vars(wanted)), effect.name
    turned = PLANAR.replace("magnitude_mm = 0.01, angle_deg = 0.0", "magnitude_mm = 0.01, angle_deg = 30.0")
    assert scene(tmp_path, turned).effect("race_eccentricity") == RaceEccentricityEffect(1e-5, 30 * deg)


def test_body_hangs_on_the_rotor_and_starts_at_rest(tmp_path: Path) -> None:
    text = PLANAR.partition("[scene.effects]")[0].replace("x_mm = 0.0", "x_mm = 1.5")
    found = scene(tmp_path, text)
    assert found.support.names == ("x", "y", "body_x", "body_y")
    assert found.start_position == (0.0015, 0.0, 0.0, 0.0)
    assert found.support.stiffness[0] == (2.0, 0.0, -1.0, 0.0)
    assert found.support.mass[3][3] == 0.5


def test_tilting_scene_in_si(tmp_path: Path) -> None:
    found = scene(tmp_path, TILTING.replace("duration_s = 1\n", "duration_s = 1\ninitial = { y_mm = 1 }\n"))
    support = found.support
    assert support.couples and support.axial_inertia
    assert [support.mass[k][k] for k in range(4)] == [0.8, 0.8, 0.0138, 0.0138]
    assert support.gyroscopic[2][3] == 0.00124
    assert support.bearings == pytest.approx((0.11, -0.15))
    assert support.stiffness[0] == pytest.approx((43000.0, 0, 21500 * (0.11 - 0.15), 0))
    assert support.damping[3][3] == pytest.approx(3.95 * (0.11**2 + 0.15**2))
    assert found.couple == pytest.approx(6.8e-5 * (0.0138 - 0.00124), rel=1e-12)
    assert [race.plane_offset for race in found.races] == [0.02, -0.02]
    assert found.start_position == (0, 0.001, 0, 0)
    still = scene(tmp_path, TILTING.replace("ball_tilt_inertia = true", "ball_tilt_inertia = false"))
    assert not still.support.axial_inertia
    without = "\n".join(line for line in TILTING.splitlines() if "couple" not in line)
    assert scene(tmp_path, without).couple == 0.0


def test_arm_starts_where_it_stands(tmp_path: Path) -> None:
    """Kovalenko 2010, (5') at Z = 90°: φ = (M_p + (l + f R) c_n l φ₀)/(c_sh l² + (l + f R) c_n l)."""
    found = scene(tmp_path, ARM)
    length, R, f, cn, touch = 0.3, 0.115, 0.45, 1e6, math.radians(2)
    contact = (length + f * R) * cn * length
    assert isinstance(found.support, SwingArmSupport)
    assert found.support.stiffness * length**2 == pytest.approx(2000 * length**2 + contact, rel=1e-12)
    angle = (20.0 + contact * touch) / (2000 * length**2 + contact)
    assert found.start_position == pytest.approx((angle,), rel=1e-12)
    idle = scene(tmp_path, ARM.replace("cutting = true", "cutting = false"))
    assert (idle.support.stiffness, idle.support.damping, idle.support.torque) == (2000.0, 40.0, 0.0)
    assert idle.start_position == (0.0,)


@pytest.mark.parametrize(("old", "new", "key", "words"), [
    ("contact_angle_deg = 90.0", "contact_angle_deg = 8.0", "contact_angle_deg", "does not stand"),
    ("pressing_moment_N_m = 20.0", "pressing_moment_N_m = 5.0", "pressing_moment_N_m", "not pressed"),
])  # fmt: skip
def test_arm_that_cannot_cut_is_refused(tmp_path: Path, old: str, new: str, key: str, words: str) -> None:
    with pytest.raises(InputError, match=words) as caught:
        scene(tmp_path, ARM.replace(old, new))
    assert caught.value.place.key == f"scene.swing_arm.{key}"
    scene(tmp_path, ARM.replace(old, new).replace("cutting = true", "cutting = false"))


def test_arm_that_just_touches_is_not_refused(tmp_path: Path) -> None:
    text = ARM.replace("pressing_moment_N_m = 20.0", "pressing_moment_N_m = 0.0")
    assert scene(tmp_path, text.replace("touch_angle_deg = 2.0", "touch_angle_deg = 0.0")).start_position == (0.0,)


def test_balls_take_their_radius_from_race_or_effects(tmp_path: Path) -> None:
    contact = "[scene.effects]\nball_contact = { ball_radius_mm = 8 }\n"
    assert scene(tmp_path, SCENE + contact).races[0].ball_radius == 0.008
    assert scene(tmp_path, SCENE + "ball_radius_mm = 5\n").races[0].ball_radius == 0.005


def test_balls_that_touch_but_for_rounding_touch(tmp_path: Path) -> None:
    """Half the angle is 30°; what the file says is 2e-7 rad less than 60° each."""
    angles = SCENE.replace("[50.0, 50.0]", "[50, 50, 50]").replace("[90.0, -90.0]", "[0, 59.99999, 119.99998]")
    found = scene(tmp_path, angles + "[scene.effects]\nball_contact = { ball_radius_mm = 500 }\n")
    assert np.diff(found.races[0].start_angles) == pytest.approx([math.pi / 3] * 2, abs=1e-12)
    run(found)


def test_rigid_contact_places_the_axis(tmp_path: Path) -> None:
    contact = 'grinding_contact = { contact = "rigid", runout_mm = 0.04, runout_angle_deg = 30 }'
    found = scene(tmp_path, f"{SCENE}[scene.effects]\n{contact}\n")
    assert found.start_position[1] == pytest.approx(-4e-5 * 0.5)
    assert found.start_velocity[1] == pytest.approx(-4e-5 * math.cos(math.pi / 6) * 2.0)


DRIVEN = "motor = { stall_torque_N_m = 3.0, no_load_speed_rpm = 6000.0, rotor_inertia_kg_m2 = 2e-3 }"


SIZED = "{ ball_radius_mm = 2.0 }"


ON_TILTING = f"""[scene.effects]
gravity = {{}}
ball_contact = {SIZED}
dry_rolling_friction = {{ lever_arm_mm = 0.002, ball_radius_mm = 2.0 }}
race_eccentricity = {{ magnitude_mm = 0.01 }}
"""


RUNNING = {
    "planar": SCENE,
    "body": PLANAR.partition("[scene.effects]")[0],
    "tilting": TILTING,
    "tilting, effects": TILTING + ON_TILTING,
    "tilting, rigid": TILTING + "[scene.effects]\ngrinding_contact = { contact = 'rigid', plane_offset_mm = 50 }\n",
    "tilting, driven": f"{TILTING}[scene.effects]\n{DRIVEN}\nrun_up = {{ time_s = 0.5 }}\n",
    "arm cutting": ARM,
    "arm idle": ARM.replace("cutting = true", "cutting = false"),
    "arm, effects": ARM + ON_TILTING,
    "arm, driven": f"{ARM}[scene.effects]\n{DRIVEN}\n",
}


@pytest.mark.parametrize("text", RUNNING.values(), ids=RUNNING)
def test_scenes_of_every_support_run(tmp_path: Path, text: str) -> None:
    run(scene(tmp_path, text))


GRINDER = """\
[scene]
mass_kg = 6.3
stiffness_N_per_m = [1600.0, 1600.0]
damping_N_s_per_m = [100.0, 100.0]
speed_rpm = 5800
imbalance_g_mm = 250
duration_s = 1
rolling_inertia = true
[[scene.race]]
pitch_radius_mm = 23
ball_masses_g = [16.7, 16.7]
rolling_drag_per_s = 15
start_angles_deg = [-30, 70]
[scene.effects]
"""


EFFECTS = {
    "gravity": "gravity = {}",
    "dry_rolling_friction": "dry_rolling_friction = { lever_arm_mm = 0.002, ball_radius_mm = 8 }",
    "ball_contact": "ball_contact = { ball_radius_mm = 8 }",
    "race_eccentricity": "race_eccentricity = { magnitude_mm = 0.01 }",
    "grinding_contact": "grinding_contact = { runout_mm = 0.04 }",
    "run_up": "run_up = { time_s = 0.5, run_down_s = 0.2 }",
    "motor": DRIVEN,
    "transverse_motion": "transverse_motion = { groove_radius_mm = 26, ball_radius_mm = 8, axial_runout_mm = 0.01 }",
}


@pytest.mark.parametrize("name", EFFECTS)
def test_scenes_of_every_effect_run(tmp_path: Path, name: str) -> None:
    found = scene(tmp_path, GRINDER + EFFECTS[name])
    assert [effect.name for effect in found.effects] == [name]
    run(found)


def test_a_scene_of_all_effects_at_once_runs(tmp_path: Path) -> None:
    chosen = (text for name, text in EFFECTS.items() if name not in ("run_up", "motor"))
    run(scene(tmp_path, GRINDER + "\n".join(chosen)), 2.0)
