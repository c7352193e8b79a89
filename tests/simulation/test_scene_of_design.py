"""From designs to scenes: every number in SI, starts of the balls, and scenes that can be integrated."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.scipy_solvers import integrate
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.supports.steady_motion import receptance
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.formulas.suspension import dynamic_stiffness
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading import sources as presets
from abu_calc.simulation.scene_file import read_any
from abu_calc.simulation.scene_of_design import SCENES, STARTS, idle_scene, scene_of_design
from abu_calc.sizing import Design, size
from tests.sizing.machines import machine

RPM = math.pi / 30


def run(scene: Scene, revolutions: float = 3.0) -> Trajectory:
    """A few revolutions at the tolerance 1e-6."""
    done = integrate(assemble(with_parted_balls(scene)[0]), 1e-6, [revolutions * scene.revolution])
    assert np.isfinite(done.y).all()
    return done


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


OTHERS = {"knife", "rig", "pedestal", "washing", "125"}
GRINDERS = [name for name in presets.names() if not OTHERS & set(name.split("-"))]


@pytest.mark.slow
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
    pressed = which == "grinding" and design.case.contact.contact != "face"
    assert ("grinding_contact" in names) == pressed
    assert {"race_eccentricity", "ball_contact", "dry_rolling_friction"} <= set(names)
    assert ("motor" in names) == ("run_up" in names) == (which == "run-up")
    order = [each for each, _ in REGISTRY]
    assert names == sorted(names, key=order.index)
    assert isinstance(found.support, SwingArmSupport) == which.startswith("swing-arm")
    run(found, 1.5)


@pytest.mark.slow
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


@pytest.mark.slow
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
    assert gaps == pytest.approx([spread if start == "spread" else 2 * design.autobalancer.half_angle] * len(gaps))
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
