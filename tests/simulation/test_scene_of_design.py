"""From files to scenes: every number in SI, every support and effect, and scenes that can be integrated."""

import math
from dataclasses import replace
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
from abu_calc.dynamics.supports.receptance import receptance
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.formulas.suspension import dynamic_stiffness
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading import sources as presets
from abu_calc.inputs.scene import read_any
from abu_calc.simulation.durations import lasting
from abu_calc.simulation.scene_of_design import SCENES, STARTS, contact_half_angle, idle_scene, scene_of_design
from abu_calc.simulation.scene_of_file import scene_from
from abu_calc.sizing import Design, size
from tests.inputs.scenes import ARM, PLANAR, SCENE, TILTING, read
from tests.sizing.machines import machine

RPM = math.pi / 30


def scene(folder: Path, text: str) -> Scene:
    return scene_from(read(folder, text).scene)


def run(scene: Scene, revolutions: float = 3.0) -> Trajectory:
    """A few revolutions at the tolerance 1e-6."""
    done = integrate(assemble(with_parted_balls(scene)[0]), 1e-6, [revolutions * scene.revolution])
    assert np.isfinite(done.y).all()
    return done


# Scene files: the numbers


def test_planar_scene_in_si(tmp_path):
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
    assert race.ball_masses == (0.05, 0.05)
    assert race.start_angles == pytest.approx((math.pi / 2, -math.pi / 2))


@pytest.mark.parametrize(("rolling", "corrector", "factor"), [
    ("true", "ball", 7 / 5), ("true", "roller", 3 / 2), ("false", "ball", 1.0), ("false", "roller", 1.0),
])  # fmt: skip
def test_what_rolls_has_its_inertia(tmp_path, rolling, corrector, factor):
    text = SCENE.replace("rolling_inertia = false", f"rolling_inertia = {rolling}") + f'corrector = "{corrector}"\n'
    assert scene(tmp_path, text).races[0].inertia_factor == factor


def test_every_effect_is_built_in_si_and_in_order(tmp_path):
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


def test_body_hangs_on_the_rotor_and_starts_at_rest(tmp_path):
    text = PLANAR.partition("[scene.effects]")[0].replace("x_mm = 0.0", "x_mm = 1.5")
    found = scene(tmp_path, text)
    assert found.support.names == ("x", "y", "body_x", "body_y")
    assert found.start_position == (0.0015, 0.0, 0.0, 0.0)
    assert found.support.stiffness[0] == (2.0, 0.0, -1.0, 0.0)
    assert found.support.mass[3][3] == 0.5


def test_tilting_scene_in_si(tmp_path):
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


def test_arm_starts_where_it_stands(tmp_path):
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
def test_arm_that_cannot_cut_is_refused(tmp_path, old, new, key, words):
    with pytest.raises(InputError, match=words) as caught:
        scene(tmp_path, ARM.replace(old, new))
    assert caught.value.place.key == f"scene.swing_arm.{key}"
    scene(tmp_path, ARM.replace(old, new).replace("cutting = true", "cutting = false"))


def test_arm_that_just_touches_is_not_refused(tmp_path):
    text = ARM.replace("pressing_moment_N_m = 20.0", "pressing_moment_N_m = 0.0")
    assert scene(tmp_path, text.replace("touch_angle_deg = 2.0", "touch_angle_deg = 0.0")).start_position == (0.0,)


def test_balls_take_their_radius_from_race_or_effects(tmp_path):
    contact = "[scene.effects]\nball_contact = { ball_radius_mm = 8 }\n"
    assert scene(tmp_path, SCENE + contact).races[0].ball_radius == 0.008
    assert scene(tmp_path, SCENE + "ball_radius_mm = 5\n").races[0].ball_radius == 0.005


def test_balls_that_touch_but_for_rounding_touch(tmp_path):
    """Half the angle is 30°; what the file says is 2e-7 rad less than 60° each."""
    angles = SCENE.replace("[50.0, 50.0]", "[50, 50, 50]").replace("[90.0, -90.0]", "[0, 59.99999, 119.99998]")
    found = scene(tmp_path, angles + "[scene.effects]\nball_contact = { ball_radius_mm = 500 }\n")
    assert np.diff(found.races[0].start_angles) == pytest.approx([math.pi / 3] * 2, abs=1e-12)
    run(found)


def test_rigid_contact_places_the_axis(tmp_path):
    contact = 'grinding_contact = { contact = "rigid", runout_mm = 0.04, runout_angle_deg = 30 }'
    found = scene(tmp_path, f"{SCENE}[scene.effects]\n{contact}\n")
    assert found.start_position[1] == pytest.approx(-4e-5 * 0.5)
    assert found.start_velocity[1] == pytest.approx(-4e-5 * math.cos(math.pi / 6) * 2.0)


def test_durations_are_bounded_by_work_and_run_up(tmp_path):
    ramped = scene(tmp_path, f"{SCENE}[scene.effects]\nrun_up = {{ time_s = 100, run_down_s = 50 }}\n")
    assert lasting(ramped, 150.0, "--duration").duration == 150.0
    for wanted in (149.0, 1e9, math.nan, -1.0):
        with pytest.raises(InputError, match="one revolution and the run-up") as caught:
            lasting(ramped, wanted, "--duration")
        assert caught.value.place.key == "--duration"
    assert lasting(ramped, None, "x") == ramped


# Scene files: they can be integrated

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
def test_scenes_of_every_support_run(tmp_path, text):
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
def test_scenes_of_every_effect_run(tmp_path, name):
    found = scene(tmp_path, GRINDER + EFFECTS[name])
    assert [effect.name for effect in found.effects] == [name]
    run(found)


def test_a_scene_of_all_effects_at_once_runs(tmp_path):
    chosen = (text for name, text in EFFECTS.items() if name not in ("run_up", "motor"))
    run(scene(tmp_path, GRINDER + "\n".join(chosen)), 2.0)


# Machines


@pytest.fixture(scope="module")
def designs() -> dict[str, Design]:
    return {}


def design_of(designs: dict[str, Design], name: str) -> Design:
    """The design of a preset, with the tables that it lacks."""
    if name not in designs:
        tables = ["grinding.contact=rigid"] if "swing" in name else ["swing_arm.arm_length_mm=350"]
        loaded = read_any(name, [*tables, "run_up.time_s=0.5", "motor.no_load_speed_rpm=7000"])
        assert isinstance(loaded, Machine)
        designs[name] = size(loaded.tables)
    return designs[name]


GRINDERS = [name for name in presets.names() if "knife" not in name and "rig" not in name]


@pytest.mark.parametrize("which", SCENES)
@pytest.mark.parametrize("name", GRINDERS)
def test_presets_make_each_of_their_scenes(designs, name, which):
    design = design_of(designs, name)
    found = scene_of_design(design, which)
    assert found.name == which
    assert found.support.couples is False
    horizontal = design.case.table.machine.spindle_axis == "horizontal"
    names = [effect.name for effect in found.effects]
    assert ("gravity" in names) == horizontal
    pressed = which == "grinding" and design.case.contact.kind != "face"
    assert ("grinding_contact" in names) == pressed
    assert {"race_eccentricity", "ball_contact", "dry_rolling_friction"} <= set(names)
    assert ("motor" in names) == ("run_up" in names) == (which == "run-up")
    order = [each for each, _ in REGISTRY]
    assert names == sorted(names, key=order.index)
    assert isinstance(found.support, SwingArmSupport) == which.startswith("swing-arm")
    run(found, 1.5)


def test_grinder_scene_has_the_numbers_of_its_design(designs):
    design = design_of(designs, "avtovaz-707-222")
    one, found = design.autobalancer, scene_of_design(design, "grinding")
    race = found.races[0]
    assert race.ball_radius == one.ball_diameter / 2
    assert found.effect("dry_rolling_friction") == DryRollingFrictionEffect(2e-6, one.ball_diameter / 2)
    assert found.effect("race_eccentricity") == RaceEccentricityEffect(1e-5, math.pi)
    contact = found.effect("grinding_contact")
    assert isinstance(contact, GrindingContactEffect)
    assert (contact.press_force, contact.contact_stiffness, contact.runout) == (45.0, 4.9e5, pytest.approx(9e-5))
    assert contact.wheel_radius == 0.075
    # T = −f N₀ on the spring along the work; the press is in equilibrium by itself.
    assert found.start_position == pytest.approx((-0.35 * 45.0 / found.support.stiffness[0][0], 0.0))
    mass = found.support.mass[0][0] + one.ball_count * one.ball_mass
    assert mass == pytest.approx(design.system_mass, rel=1e-12)


def test_arm_carries_the_autobalancer_but_not_its_balls(designs):
    design = design_of(designs, "swing-arm-grinder")
    one, arm = design.autobalancer, scene_of_design(design, "swing-arm-idle").support
    assert arm.inertia == pytest.approx(0.62 + (one.mass - one.ball_count * one.ball_mass) * 0.35**2, rel=1e-12)
    cutting = scene_of_design(design, "swing-arm-cutting")
    assert cutting.start_position == pytest.approx((design.swing_arm.pressed_angle,), rel=1e-12)


def test_settled_balls_balance(designs):
    """They start where they carry the imbalance, idle and pressed to the work."""
    for scene in ("idle", "grinding"):
        found = scene_of_design(design_of(designs, "avtovaz-707-222"), scene, "settled")
        carried = sum(
            moment * np.exp(1j * angle) for moment, angle in zip(found.static_moments, found.start_angles, strict=True)
        )
        assert abs(carried + found.imbalance) < 0.01 * found.imbalance


@pytest.mark.parametrize("start", [start for start in STARTS if start not in ("settled", "placed")])
def test_starts_of_the_balls(designs, start):
    design = design_of(designs, "avtovaz-707-222")
    race = scene_of_design(design, "idle", start).races[0]
    gaps = np.diff(race.start_angles)
    spread = 2 * math.pi / len(race.ball_masses)
    assert gaps == pytest.approx([spread if start == "spread" else 2 * contact_half_angle(design)] * len(gaps))
    if start == "spread":
        assert race.start_angles[0] == pytest.approx(math.radians(20))
    else:
        assert np.mean(race.start_angles) == pytest.approx(math.radians(-20 if start == "behind" else 20))
    assert set(race.start_speeds) == {-design.case.speed if start == "standstill" else 0.0}
    assert set(scene_of_design(design, "run-up", start).races[0].start_speeds) == {0.0}


def test_idle_scene_is_the_idle_one_without_effects(designs):
    design = design_of(designs, "avtovaz-707-370")
    assert idle_scene(design, "spread") == replace(scene_of_design(design, "idle", "spread"), effects=())


def test_run_up_lasts_for_the_motor_or_the_time_given(designs):
    """J Ω₀/M = 2e-3·733/3 = 0.489 s, five of them; balls at standstill take up the speed in both scenes."""
    design = design_of(designs, "avtovaz-707-370")
    more = scene_of_design(design, "run-up").duration - scene_of_design(design, "idle", "standstill").duration
    assert more == pytest.approx(5 * 2e-3 * 7000 * RPM / 3.0, rel=1e-9)
    given = size(machine(run_up={"time_s": 0.7}))
    more = scene_of_design(given, "run-up").duration - scene_of_design(given, "idle", "standstill").duration
    assert more == pytest.approx(0.7, rel=1e-9)


def test_duration_is_seven_decay_times_within_bounds():
    slow = size(machine(suspension__natural_frequencies_hz=[1.0, 2.5], suspension__damping_ratios=[0.4, 0.5]))
    rate = 0.4 * 2 * math.pi * slow.case.body.effective_mass() / slow.system_mass
    assert idle_scene(slow).duration == pytest.approx(7 / rate, rel=1e-9)
    longest = size(machine(suspension__natural_frequencies_hz=[0.1, 0.1]))
    assert idle_scene(longest).duration == pytest.approx(400 * 2 * math.pi / longest.case.speed)
    shortest = size(machine(suspension__damping_ratios=[3.0, 3.0], autobalancer__rolling_drag_per_s=25.0))
    assert idle_scene(shortest).duration >= 40 * idle_scene(shortest).revolution


@pytest.mark.parametrize("body", [{}, {"transverse_inertia_kg_m2": 0.1, "center_of_mass_to_wheel_mm": 200.0}])
def test_hands_hold_the_machine_as_in_sizing(body):
    """With balls in the race the receptance is that which sizing works with, at any speed."""
    keys = {f"machine__{key}": value for key, value in body.items()}
    design = size(machine(suspension={"model": "hands"}, **keys))
    found, one = scene_of_design(design, "idle"), design.autobalancer
    support, balls = found.support, one.ball_count * one.ball_mass
    loaded = [list(row) for row in support.mass]
    for axis in (0, 1):
        loaded[axis][axis] += balls
    h = receptance(replace(support, mass=tuple(map(tuple, loaded))), design.case.speed)
    for axis in (0, 1):
        wanted = dynamic_stiffness(design.case.suspension, axis, design.case.speed, one.requirement.effective_mass)
        assert h[axis, axis] * wanted == pytest.approx(1, rel=1e-9)
    run(found, 1.5)


def test_race_in_another_plane_feels_the_mass_and_the_imbalance_there():
    keys = {"machine__transverse_inertia_kg_m2": 0.1, "machine__center_of_mass_to_wheel_mm": 200.0}
    design = size(machine(autobalancer__plane_offset_mm=-30.0, **keys))
    found, one, body = scene_of_design(design, "idle"), design.autobalancer, design.case.body
    felt = found.support.mass[0][0] + one.ball_count * one.ball_mass
    mass = body.mass + one.mass
    assert 1 / felt == pytest.approx(1 / mass + 0.17**2 / 0.1)
    # Imbalance at the wheel moves the race by U (1/M + a_r a_w/J).
    assert found.imbalance / felt == pytest.approx(design.imbalance.value * (1 / mass + 0.17 * 0.2 / 0.1))


@pytest.mark.parametrize(("which", "table"), [pair for pair in SCENES.items() if pair[1]])
def test_a_missing_table_is_named(which, table):
    with pytest.raises(InputError, match=rf"needs the table \[{table}\]") as caught:
        scene_of_design(size(machine()), which)
    assert caught.value.place.key == table


def test_unknown_scenes_and_arms_that_cannot_cut_are_refused():
    with pytest.raises(InputError, match=r"no such scene.*found idling.*swing-arm-cutting"):
        scene_of_design(size(machine()), "idling")
    leaning = size(machine(swing_arm={"contact_angle_deg": 8.0}))
    with pytest.raises(NotTrustworthyError, match="does not stand"):
        scene_of_design(leaning, "swing-arm-cutting")
    loose = size(machine(swing_arm={"pressing_moment_N_m": 1.0}))
    with pytest.raises(NotTrustworthyError, match="does not reach the work"):
        scene_of_design(loose, "swing-arm-cutting")
    assert scene_of_design(loose, "swing-arm-idle").start_position == (0.0,)
