"""Subjects of studies: machines, scene files and scenes of scripts.

Which effects are simulated, and whether what is left out changes as little as it promises.
"""

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import abu_calc
from abu_calc.dynamics.effect import Effect, EffectInfluence, Kind
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import integrate_with
from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.supports.planar import planar
from abu_calc.dynamics.supports.steady_motion import unbalanced_amplitude
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.model_level import amplitude, angles, difference, quiet, rest, settling
from abu_calc.simulation.quiet import TimeRange
from abu_calc.simulation.response import evaluate, needed_times
from abu_calc.simulation.scene_of_design import STARTS
from abu_calc.simulation.simulate import simulate
from abu_calc.simulation.subject import SHARE, audit, chosen, simulate_chosen, subject_of
from tests.dynamics.random_scenes import random_scene
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


VERY_UNLIKE = ("avtovaz-707-222", "swing-arm-grinder")
OTHERS = ("avtovaz-707-305", "avtovaz-707-370", "msh-230")
"""Hand grinders too."""


@dataclass(frozen=True)
class Weighed(Effect):
    """An effect that does nothing, of a weight that is given."""

    named: str
    known: float | None

    kind: ClassVar[Kind] = "conservative"

    @property
    def name(self) -> str:  # type: ignore[override]
        return self.named

    def weight(self, scene: Scene) -> EffectInfluence:
        return EffectInfluence(self.known, "by decree")


def scene(*effects: Effect, speed: float = 300.0) -> Scene:
    """Two balls on a machine of some kilograms, far above its suspension, that settles well within the run."""
    race = Race(0.025, (0.012, 0.012), 30.0, 1.4, (1.0, 2.0), (0.0, 0.0))
    support = planar(5.0, (1200.0, 1200.0), (80.0, 80.0))
    return Scene("test", support, speed, 3e-4, 0.0, (race,), 3.0, (0.0, 0.0), (0.0, 0.0), effects=effects)


weights = st.lists(st.one_of(st.none(), st.floats(0, 0.1)), max_size=8)


@given(weights, st.floats(1e-4, 0.5))
@settings(max_examples=200, deadline=None, derandomize=True)
@pytest.mark.slow
def test_what_is_left_out_weighs_no_more_than_its_share(known: list[float | None], accuracy: float) -> None:
    effects = tuple(Weighed(f"e{k}", value) for k, value in enumerate(known))
    ledger = chosen(scene(*effects), accuracy)
    out = [entry.weight for entry in ledger.entries if not entry.included]
    assert None not in out and ledger.promise == sum(out) <= SHARE * accuracy
    assert ledger.scene.effects == tuple(e for e, entry in zip(effects, ledger.entries, strict=True) if entry.included)
    # The lightest go first, and as many as there is room for.
    inside = [entry.weight for entry in ledger.entries if entry.included and entry.weight is not None]
    if inside:
        assert max(out, default=0.0) <= min(inside) and sum(out) + min(inside) > SHARE * accuracy


def test_what_is_asked_for_by_name() -> None:
    full = scene(Weighed("light", 1e-9), Weighed("heavy", 5.0), Weighed("unknown", None))
    ledger = chosen(full, 0.01, wanted=("light",), unwanted=("heavy", "unknown"))
    assert [(entry.name, entry.included) for entry in ledger.entries] == [
        ("light", True), ("heavy", False), ("unknown", False),
    ]  # fmt: skip
    assert ledger.promise == 5.0 and all("by decree" in entry.why for entry in ledger.entries)


def test_what_is_left_out_for_being_light_takes_its_part_of_the_accuracy() -> None:
    """Not what was asked out: that is not held against the accuracy."""
    full = scene(Weighed("light", 1e-3), Weighed("lighter", 5e-4), Weighed("heavy", 5.0), Weighed("unlike", 1e-4))
    ledger = chosen(full, 0.01, wanted=("lighter",), unwanted=("heavy", "unlike"))
    assert ledger.spared == 1e-3 and ledger.promise == pytest.approx(5.0011)


def test_where_as_many_events_remain_nothing_light_is_left_out() -> None:
    """Friction that decides switches all the same; balls that hardly cross their race stay out, with their events."""
    eccentric, friction = RaceEccentricityEffect(1e-10, 0.5), DryRollingFrictionEffect(2e-6, 0.003)
    kept = chosen(scene(eccentric, friction), 0.01)
    assert kept.scene.effects == (eccentric, friction) and "save no work" in kept.entries[0].why
    across = TransverseMotionEffect(0.024, 0.003, 1e-9)
    assert chosen(scene(eccentric, across, friction), 0.01).scene.effects == (friction,)
    resting = TransverseMotionEffect(0.024, 0.003)
    assert chosen(scene(eccentric, resting, friction), 0.01).scene.effects == (eccentric, friction)


# whether weights are honest
@pytest.mark.parametrize("speed", [300.0, *(pytest.param(one, marks=pytest.mark.slow) for one in (600.0, 1500.0))])
def test_gravity_weighs_what_it_changes(speed: float) -> None:
    """Balls swing by a = g/(J R_p Ω²) once per turn; the axis, at 2Ω, by up to Σ m R_p a/2 over M.

    The balls stand at ± 120°, where their e^{2iθ} add up to half. The push-off of a ball at rest, a Ω J/h₀, is undone
    here, since two balls have but one place to rest; in settling it is felt. Quiet counts to below the level without
    balls: without gravity this motion dies out, and has no level of its end.
    """
    plain = scene(speed=speed)
    plain = replace(plain, quiet_velocity=unbalanced_amplitude(plain) * speed / math.sqrt(2))
    full = replace(plain, effects=(GravityEffect(),))
    with_, without = simulate(full, 0.001), simulate(plain, 0.001)
    assert without.response.quiet_time is not None and without.response.rest_time is not None
    weight = GravityEffect().weight(full).value
    true = difference(full, without.response, with_.response)
    assert weight is not None and weight / 3 < true < 3 * weight
    assert amplitude(full, without.response, with_.response) == pytest.approx(weight / 2, rel=0.3)


def test_among_four_balls_gravity_shifts_where_they_stay() -> None:
    race = Race(0.025, (0.012,) * 4, 15.0, 1.4, (1.0, 1.5, 2.0, 2.5), (0.0,) * 4)
    full = replace(scene(GravityEffect(), speed=600.0), races=(race,))
    with_, without = simulate(full, 0.001), simulate(replace(full, effects=()), 0.001)
    swing, weight = 9.80665 / (1.4 * 0.025 * 600**2), GravityEffect().weight(full).value
    true = angles(full, without.response, with_.response)
    assert weight is not None and 3 * swing < true < weight


def test_gravity_weighs_no_less_beside_a_friction_that_holds_nothing() -> None:
    """What it shakes loose comes on top of its own pull."""
    own = GravityEffect().weight(scene(GravityEffect())).value
    assert own is not None
    for lever, more in ((1e-12, False), (1e-6, True)):
        weight = GravityEffect().weight(scene(GravityEffect(), DryRollingFrictionEffect(lever, 0.003))).value
        assert weight is not None and (weight > own if more else weight == own)


@pytest.mark.parametrize("magnitude", [1e-8, 1e-7, 5e-7])
def test_race_eccentricity_weighs_what_it_changes(magnitude: float) -> None:
    """The axis whirls with Δ, below 1 % of A₀ of 55 µm; with it the balls stand elsewhere by M Δ/(m R_p sin θ)."""
    effect = RaceEccentricityEffect(magnitude, 0.5)
    full = scene(effect)
    with_, without = simulate(full, 1e-3), simulate(scene(), 1e-3)
    weight = effect.weight(full).value
    true = amplitude(full, without.response, with_.response)
    assert weight is not None and weight == pytest.approx(true, rel=0.1)
    assert max(true, angles(full, without.response, with_.response)) < 3 * weight


@pytest.mark.parametrize("name", [*VERY_UNLIKE, *(pytest.param(one, marks=pytest.mark.slow) for one in OTHERS)])
@pytest.mark.slow
def test_what_is_left_out_of_a_machine_changes_no_more_than_promised(name: str) -> None:
    """Idle, friction aside: at an accuracy that lets something pass, and with everything that can be weighed out."""
    full = subject_of(read_machine(name), "idle").scene
    smooth = tuple(effect for effect in full.effects if effect.name in ("gravity", "race_eccentricity"))
    full = replace(full, effects=smooth)
    names = [effect.name for effect in smooth]
    for unwanted in ((), *((one,) for one in names)):
        ledger = chosen(full, 0.5, unwanted=unwanted)
        told = audit(full, ledger, simulate(ledger.scene, 0.01), 0.01, 10**7)
        assert told.difference <= 3 * told.promise, (told, unwanted)
        if not unwanted:
            assert told.difference <= 0.5


@pytest.mark.slow
def test_balls_roll_across_a_race_that_tilts_without_any_axial_runout() -> None:
    """Left out it changes this run by 0.16, with no runout at all."""
    bare = replace(random_scene(16), effects=())
    assert bare.name.startswith("tilting")
    race = bare.races[0]
    full = replace(bare, effects=(TransverseMotionEffect(0.95 * race.pitch_radius, race.ball_radius),))
    assert difference(full, simulate(bare, 1e-3).response, simulate(full, 1e-3).response) > 0.1
    assert chosen(full, 0.01).scene == full


def fast_transient(*effects: Effect) -> Scene:
    """Three balls that pass the heavy side at 60 000 rpm, ten times in 0.1 s: whatever is small at first grows."""
    race = Race(0.023, (0.0163,) * 3, 15.0, 1.4, (0.0, math.pi / 4, math.pi / 2), (0.0,) * 3)
    support = planar(6.0, (1500.0,) * 2, (95.0,) * 2)
    return Scene("fast", support, 2000 * math.pi, 250e-6, 0.0, (race,), 0.1, (0.0, 0.0), (0.0, 0.0), effects=effects)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("effects", "accuracy"),
    [((GravityEffect(),), 1e-2), ((RaceEccentricityEffect(1e-10, 0.0), GravityEffect()), 1e-3)],
    ids=["gravity", "next to no eccentricity"],
)
def test_an_effect_that_is_light_at_steady_state_is_taken_in_where_a_transient_shows_it(
    effects: tuple[Effect, ...], accuracy: float
) -> None:
    """Gravity swings the balls by 0.0045 of the amplitude at rest, and leads them 2.5 rad and 13 % away in this run."""
    full = fast_transient(*effects)
    ledger = chosen(full, accuracy)
    assert ledger.scene.effects == effects[1:] if len(effects) > 1 else ledger.spared == pytest.approx(0.0045, rel=0.1)
    after, run = simulate_chosen(ledger, accuracy)
    assert run.scene.effects == effects and after.spared == 0 and run.error_estimate <= accuracy
    assert "light at steady state" in after.entries[0].why
    true = integrate_with("scipy-dop853", assemble(full), 1e-11, needed_times(full), 10**6)
    assert difference(full, run.response, evaluate(full, true)) <= run.error_estimate


def test_what_a_run_with_the_light_effects_changes_is_part_of_the_error() -> None:
    """An eccentricity that a settled motion hardly shows stays out, and the run with it is counted as work."""
    full = scene(RaceEccentricityEffect(1e-9, 0.5))
    ledger, run = simulate_chosen(chosen(full, 0.01), 0.01)
    whole = simulate(full, 1e-4)
    assert run.scene.effects == () and run.cost.work > simulate(scene(), 0.01).cost.work
    assert difference(full, run.response, whole.response) <= run.error_estimate + ledger.spared <= 0.01


# differences
QUIET, REST = TimeRange(0.3, 0.29, 0.31), TimeRange(0.6, 0.59, 0.61)


@dataclass(frozen=True)
class Said:
    axis_amplitude: float = 1e-5
    velocity_rms: float = 1e-3
    settling_time: float | None = 0.5
    quiet: TimeRange = QUIET
    rest: TimeRange = REST
    ball_angles: tuple[float, ...] = (1.0, 2.0)


def test_differences() -> None:
    one = scene()
    assert difference(one, Said(), Said()) == 0
    assert amplitude(one, Said(1.1e-5), Said()) == pytest.approx(0.1)
    # Nothing is small against 1 % of A₀, m₀e/(M + …) by hand without balls: 3e-4 · 9e4/(5 · 9e4 − 1200) m.
    least = 0.01 * 3e-4 * 9e4 / abs(complex(1200 - 5 * 9e4, 80 * 300))
    assert amplitude(one, Said(1e-9), Said(0.0)) == pytest.approx(1e-9 / least)
    assert settling(one, Said(settling_time=0.6), Said()) == pytest.approx(0.2)
    assert settling(one, Said(settling_time=None), Said()) == math.inf
    assert settling(one, Said(settling_time=None), Said(settling_time=None)) == 0
    late, never = TimeRange(0.36, 0.35, 0.37), TimeRange(None, None, None)
    assert quiet(one, Said(quiet=late), Said()) == pytest.approx(0.2) == difference(one, Said(quiet=late), Said())
    assert rest(one, Said(rest=never), Said()) == math.inf == difference(one, Said(rest=never), Said())
    assert rest(one, Said(rest=never), Said(rest=never)) == 0
    # Where a threshold is grazed, each in the range of the other, both are one answer.
    assert quiet(one, Said(quiet=TimeRange(0.36, 0.2, 0.5)), Said(quiet=TimeRange(0.3, 0.2, 0.4))) == 0
    assert quiet(one, Said(quiet=TimeRange(0.36, 0.2, None)), Said(quiet=TimeRange(None, 0.3, None))) == 0
    # Alike balls may change places and go round.
    assert angles(one, Said(ball_angles=(2.0 + 2 * math.pi, 1.0)), Said()) == pytest.approx(0, abs=1e-12)
    assert angles(one, Said(ball_angles=(1.0, 2.3)), Said()) == pytest.approx(0.3)


def test_unlike_balls_do_not_change_places() -> None:
    race = Race(0.025, (0.012, 0.013), 15.0, 1.4, (1.0, 2.0), (0.0, 0.0))
    assert angles(replace(scene(), races=(race,)), Said(ball_angles=(2.0, 1.0)), Said()) == pytest.approx(1.0)
