"""What every effect of the registry promises, alone and beside every other one, on every support."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import numpy as np
import pytest

from abu_calc.dynamics.effect import Effect, EffectInfluence
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.equations.assemble import STEP, Equations, assemble
from abu_calc.dynamics.equations.right_hand_side import accelerations, with_states
from abu_calc.dynamics.rotor import STEADY
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.planar import LinearSupport
from abu_calc.dynamics.switching.modes import at_break, settled
from abu_calc.foundation.errors import InputError
from tests.dynamics.energy import Bodies, demanded, energy, mass_matrix, power, resisting
from tests.dynamics.examples import CONTACT, EXAMPLES, HELD, NOTHING, STATES, WEIGHTLESS, mirrored_effect, turned_effect
from tests.dynamics.scenes import SUPPORTS, scene_on, with_effects
from tests.dynamics.transforms import coordinate_units, in_units, mirrored, mirrored_state, reordered, turned

ORDER = [name for name, _ in REGISTRY]
WAYS = [name for name, effect in EXAMPLES.items() if effect.rotor is STEADY]
"""Effects that go with each of the others'; the rest say how the rotor turns."""


@dataclass(frozen=True)
class Sample:
    """A scene at a moment: state and modes in which the motion can go on."""

    equations: Equations
    t: float
    y: np.ndarray
    modes: tuple[Any, ...]

    @property
    def scene(self) -> Scene:
        """The scene."""
        return self.equations.scene

    @property
    def rhs(self) -> np.ndarray:
        """Rates of the state."""
        return self.equations.rhs(np, self.t, self.y, self.equations.in_mode(self.modes))


def fits(effect: Effect, scene: Scene) -> bool:
    """Whether an effect can act in a scene."""
    try:
        effect.check(scene)
    except InputError:
        return False
    return True


def taken(support: str, *names: str) -> Scene | None:
    """The scene with these effects in order; None where one of them refuses it."""
    effects = sorted((EXAMPLES[name] for name in names), key=lambda effect: ORDER.index(effect.name))
    scene = scene_on(support, *effects)
    if not all(fits(effect, scene) for effect in effects):
        return None
    # Both races alike: effects know one size of ball.
    return replace(scene, races=tuple(replace(race, ball_radius=0.1) for race in scene.races))


def raw_state(scene: Scene, t: float, rng: np.random.Generator) -> np.ndarray:
    """Near the start, so that balls stay in their races; some balls at rest, two together, a wheel on its work."""
    equations = assemble(scene)
    y = np.array(equations.initial) + rng.uniform(-0.15, 0.15, len(equations.states))
    first, balls = 2 * len(scene.support.names), len(scene.ball_masses)
    rates = slice(first + balls, first + 2 * balls)
    y[rates] = np.where(rng.random(balls) < 0.4, 0.0, y[rates])
    if scene.rotor.states:
        y[-2:] = rng.uniform(0, 6), scene.speed * rng.uniform(0.8, 1.1)
    contact = scene.effect("ball_contact")
    if contact is not None and rng.random() < 0.7:
        y[first + 1] = y[first] + 2 * math.asin(contact.ball_radius / scene.races[0].pitch_radius)
        y[first + balls + 1] = y[first + balls] + rng.choice((-0.1, 0.0, 0.0))
    return on_work(scene, t, y)


def on_work(scene: Scene, t: float, y: np.ndarray) -> np.ndarray:
    """The state with a wheel in rigid contact where it must be."""
    contact, support = scene.effect("grinding_contact"), scene.support
    if not isinstance(contact, GrindingContactEffect) or contact.contact != "rigid":
        return y
    assert isinstance(support, LinearSupport)
    row, size = np.array(support.race_map[1]), len(support.names)
    turn, speed = scene.rotor.turning(t, y, scene.speed)
    place = turn + contact.runout_angle
    wanted = -contact.runout * np.sin(place), -contact.runout * np.cos(place) * speed
    for part, target in zip((slice(size), slice(size, 2 * size)), wanted, strict=True):
        y[part] += row * (target - row @ y[part]) / (row @ row)
    return y


def samples(scene: Scene, count: int, seed: int = 1) -> Iterator[Sample]:
    """Moments at random, the same each time, in the modes that the effects settle on."""
    rng, equations = np.random.default_rng(seed), assemble(scene)
    for _ in range(count):
        t = float(rng.uniform(0, 2))
        y = raw_state(scene, t, rng)
        modes = at_break(equations, t, equations.first_modes)
        state, modes = settled(equations, t, y, modes)
        yield Sample(equations, t, state, modes)


def each_effect(*names: str) -> pytest.MarkDecorator:
    """Every effect on every support that takes it."""
    cases = [(support, name) for support in SUPPORTS for name in (names or EXAMPLES) if taken(support, name)]
    return pytest.mark.parametrize(("support", "name"), cases)


def of_kind(kind: str) -> list[str]:
    """Examples of effects of a kind."""
    return [name for name, effect in EXAMPLES.items() if effect.kind == kind]


def test_the_registry_is_complete():
    assert [name for name, _ in REGISTRY] == [kind.name for _, kind in REGISTRY]
    assert {type(effect) for effect in EXAMPLES.values()} == {kind for _, kind in REGISTRY}
    assert len(ORDER) == len(set(ORDER)) >= 8
    assert {kind.kind for _, kind in REGISTRY} == {"conservative", "dissipative", "driven"}


def test_a_support_that_cannot_take_an_effect_says_so():
    with pytest.raises(InputError, match="swing arm"):
        assemble(scene_on("swing arm", CONTACT))
    with pytest.raises(InputError, match="only a swing arm lifts off"):
        assemble(scene_on("planar", EXAMPLES["lift_off"]))


@pytest.mark.slow
@pytest.mark.few(1)
@each_effect(*of_kind("conservative"))
def test_conservative_force_is_the_slope_of_its_energy(support, name):
    """What Lagrange's equations ask for beside springs, energies and inertia is supplied by dampers and drag alone."""
    stored = []
    for sample in samples(taken(support, name), 5):
        scene, (t, y, modes) = sample.scene, (sample.t, sample.y, sample.modes)
        free = Bodies(scene).freedoms
        without = with_effects(scene)
        found, supplied = demanded(scene, t, y, modes)[:free], resisting(scene, t, y)[:free]
        np.testing.assert_allclose(found, supplied, rtol=1e-10, atol=1e-11)
        stored.append(abs(energy(scene, t, y, modes) - energy(without, t, y)))
        assert power_of(sample, name) == 0.0
    assert max(stored) > 1e-6


def power_of(sample: Sample, name: str) -> float:
    """Of one effect alone."""
    p, acting = sample.equations.parameters, sample.equations.in_mode(sample.modes)
    motion, _, solved = accelerations(np, sample.t, sample.y, acting)
    return sum(
        float(effect.power(motion, mode, own, solved, p))
        for effect, mode, own in with_states(sample.y, acting)
        if effect is EXAMPLES[name]
    )


@pytest.mark.few(4)
@each_effect(*of_kind("dissipative"))
def test_dissipative_effects_take_energy_only(support, name):
    """In the motion relative to the race, and in impacts too."""
    scene = taken(support, name)
    equations, rng = assemble(scene), np.random.default_rng(2)
    taken_out = 0.0
    for _ in range(10):
        y = raw_state(scene, 0.0, rng)
        state, modes = settled(equations, 0.0, y, equations.first_modes)
        lost = energy(scene, 0.0, state, modes) - energy(scene, 0.0, y, modes)
        rate = power_of(Sample(equations, 0.0, state, modes), name)
        assert lost <= 1e-12
        assert rate <= 1e-12
        taken_out += lost + rate
    assert taken_out < -1e-6


@pytest.mark.few(9)
@pytest.mark.parametrize("nothing", NOTHING, ids=lambda effect: effect.name)
@pytest.mark.parametrize("support", SUPPORTS)
def test_an_effect_of_no_strength_does_nothing(support, nothing):
    """Accelerations are the same to the last bit."""
    if not fits(nothing, scene_on(support)):
        return
    rng = np.random.default_rng(3)
    for rotor in ((), (EXAMPLES["run_up"],), (EXAMPLES["motor"],)):
        scene = scene_on(support, *rotor)
        y = np.array(assemble(scene).initial) + rng.uniform(-0.1, 0.1, len(assemble(scene).states))
        plain, equations = assemble(scene), assemble(with_effects(scene, *rotor, nothing))
        y, modes = settled(equations, 0.0, y, equations.first_modes)
        found = equations.rhs(np, 0.0, y, equations.in_mode(modes))
        np.testing.assert_array_equal(found, plain.rhs(np, 0.0, y, plain.acting))
        assert power(equations.scene, 0.0, y, modes) == pytest.approx(power(scene, 0.0, y), rel=1e-12)


def pairs() -> list[tuple[str, ...]]:
    """Every effect alone, and every two of different names."""
    two = [pair for pair in combinations(EXAMPLES, 2) if EXAMPLES[pair[0]].name != EXAMPLES[pair[1]].name]
    return [(name,) for name in EXAMPLES] + two


def shared_out() -> list[Any]:
    """Each of them on two supports in every run, and on the others by `-m slow`: every two supports take turns."""
    cases = [(k - place, support, names) for k, names in enumerate(pairs()) for place, support in enumerate(SUPPORTS)]
    return [
        pytest.param(support, names, marks=[pytest.mark.slow] * (turn % 3 > 0), id=f"{' + '.join(names)}-{support}")
        for turn, support, names in cases
        if taken(support, *names)
    ]


def check_energy(sample: Sample) -> None:
    """d(energy)/dt along the motion is the power, the drive's included."""
    t, y, modes, rates = sample.t, sample.y, sample.modes, sample.rhs
    change = energy(sample.scene, t + 1j * STEP, y + 1j * STEP * rates, modes).imag / STEP
    assert change == pytest.approx(power(sample.scene, t, y, modes), rel=1e-9, abs=1e-10)


@pytest.mark.few(6)
@pytest.mark.parametrize(("support", "names"), shared_out())
def test_energy_changes_by_the_power_alone(support, names):
    for sample in samples(taken(support, *names), 2):
        check_energy(sample)


@pytest.mark.parametrize("support", SUPPORTS)
def test_energy_with_everything_at_once(support):
    scene = scene_on(support)
    names = [name for name, effect in EXAMPLES.items() if name == effect.name and fits(effect, scene)]
    names.remove("run_up")  # the motor says how the rotor turns
    for sample in samples(taken(support, *names), 5):
        check_energy(sample)


@pytest.mark.parametrize("support", ["planar", "coupled", "hand", "tilting"])
def test_work_does_its_power_on_the_wheel_where_they_touch(support):
    """(T, N) on the wheel's own material at the contact, less the press on the axis; so the torque is right too."""
    scene = taken(support, "motor", "grinding_contact")
    P, size = np.array(scene.support.race_map)[:2], len(scene.support.names)
    for sample in samples(scene, 5):
        place, moving = P @ sample.y[:size], P @ sample.y[size : 2 * size]
        x, y = (CONTACT.runout * f(sample.y[-2] + CONTACT.runout_angle) for f in (np.cos, np.sin))
        normal = max(CONTACT.press_force - CONTACT.contact_stiffness * (place[1] + y), 0.0)
        arm = np.array((x, y - CONTACT.wheel_radius))
        there = moving + sample.y[-1] * np.array((-arm[1], arm[0]))
        force = normal * np.array((-CONTACT.cutting_coefficient, 1.0))
        expected = force @ there - CONTACT.press_force * moving[1]
        assert power_of(sample, "grinding_contact") == pytest.approx(expected, rel=1e-12)


@pytest.mark.few(1)
@pytest.mark.parametrize("rotor", [(), ("run_up",), ("motor",)], ids=str)
@pytest.mark.parametrize("support", SUPPORTS)
def test_points_in_a_groove_obey_lagrange(support, rotor):
    """Balls that roll two ways may not slip, so only points do; their drag acts at R instead of R_p."""
    scene = taken(support, *rotor, "transverse_motion", "race_eccentricity", "gravity")
    scene = replace(scene, races=tuple(replace(race, inertia_factor=1.0, drag=0.0) for race in scene.races))
    for sample in samples(scene, 2):
        free = Bodies(scene).freedoms
        supplied = resisting(scene, sample.t, sample.y)
        if rotor == ("motor",):
            supplied[-1] += 2.0 * (1 - sample.y[-1] / 3.0)
        if rotor == ("run_up",) and support == "swing arm":  # what drives the rotor stands on the arm
            supplied[0] -= 0.7 * scene.speed / 3.0
        found = demanded(scene, sample.t, sample.y, sample.modes)
        np.testing.assert_allclose(found[:free], supplied[:free], rtol=1e-10, atol=1e-11)
        matrix = mass_matrix(scene, sample.t, sample.y)
        assert len(matrix) == free
        assert np.linalg.eigvalsh(matrix).min() > 0


@pytest.mark.parametrize("rotor", ["", "run_up", "motor"])
@each_effect(*(name for name in WAYS if name not in (*HELD, "transverse_motion", "transverse_motion, free spin")))
def test_space_knows_no_direction(support, name, rotor):
    if support == "swing arm":  # its spring knows where it stands
        return
    check_turned(taken(support, name, *([rotor] if rotor else [])), 0.7)


def check_turned(scene: Scene, angle: float) -> None:
    first = 2 * len(scene.support.names)
    seen = replace(
        turned(scene, angle, turned_effect),
        races=tuple(replace(r, start_angles=tuple(a + angle for a in r.start_angles)) for r in scene.races),
    )
    equations = assemble(seen)
    for sample in samples(scene, 3):
        y = sample.y.copy()
        y[first : first + 5] += angle
        modes = at_break(equations, sample.t, equations.first_modes)
        state, modes = settled(equations, sample.t, y, modes)
        np.testing.assert_allclose(state, y, rtol=0, atol=1e-12)
        found = equations.rhs(np, sample.t, state, equations.in_mode(modes))
        np.testing.assert_allclose(found, sample.rhs, rtol=1e-9, atol=1e-9)


@pytest.mark.few(30)
@pytest.mark.parametrize("rotor", ["", "run_up", "motor"])
@each_effect(*WAYS)
def test_mirror_case_turns_the_other_way(support, name, rotor):
    scene = taken(support, name, *([rotor] if rotor else []))
    seen = assemble(mirrored(scene, mirrored_effect))
    p = replace(seen.parameters, speed=-scene.speed)
    seen = replace(seen, parameters=p)
    for sample in samples(scene, 3):
        y = mirrored_state(scene, sample.y)
        modes = at_break(seen, sample.t, seen.first_modes)
        modes = tuple(-m if isinstance(e, RunUpEffect) else m for e, m in zip(seen.scene.effects, modes, strict=True))
        state, modes = settled(seen, sample.t, y, modes)
        np.testing.assert_allclose(state, y, rtol=0, atol=1e-12)
        found = seen.rhs(np, sample.t, state, seen.in_mode(modes))
        # Of a rate, the mirror takes no angle away.
        expected = mirrored_state(scene, sample.rhs) - mirrored_state(scene, np.zeros(len(y)))
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


@each_effect()
def test_balls_have_no_order(support, name):
    order, scene = (2, 0, 1), taken(support, name)
    equations = assemble(reordered(scene, order))
    first = 2 * len(scene.support.names)
    for sample in samples(scene, 3):
        index = np.arange(len(sample.y))
        count = (len(sample.y) - first - (2 if scene.rotor.states else 0)) // 5
        for start in (first + 5 * k for k in range(count)):
            index[start : start + 3] = [start + k for k in order]
        modes = at_break(equations, sample.t, equations.first_modes)
        state, modes = settled(equations, sample.t, sample.y[index], modes)
        found = equations.rhs(np, sample.t, state, equations.in_mode(modes))
        np.testing.assert_allclose(found, sample.rhs[index], rtol=1e-9, atol=1e-10)


@each_effect()
def test_units_do_not_matter(support, name):
    """Of lengths, masses and times: accelerations, scales, decisions and weights."""
    length, mass, time = 1000.0, 7.0, 60.0
    scene = taken(support, name)
    one, other = assemble(scene), assemble(in_units(scene, length, mass, time))
    units = units_of(one, length, time)
    np.testing.assert_allclose(other.initial, units * np.array(one.initial), rtol=1e-12)
    np.testing.assert_allclose(other.scales, units * np.array(one.scales), rtol=1e-12)
    bare = replace(scene, imbalance=0.0)  # scales are taken from something else then
    scales = [np.array(assemble(each).scales) for each in (bare, in_units(bare, length, mass, time))]
    np.testing.assert_allclose(scales[1], units * scales[0], rtol=1e-12)
    for sample in samples(scene, 3):
        modes = at_break(other, sample.t * time, other.first_modes)
        state, modes = settled(other, sample.t * time, units * sample.y, modes)
        found = other.rhs(np, sample.t * time, state, other.in_mode(modes))
        np.testing.assert_allclose(found / units * time, sample.rhs, rtol=1e-8, atol=1e-9)
    weight, told = EXAMPLES[name].weight(scene), other.scene.effects[0].weight(other.scene)
    assert told.value == (None if weight.value is None else pytest.approx(weight.value, rel=1e-9))


def units_of(equations: Equations, length: float, time: float) -> np.ndarray:
    """Of the states of a scene."""
    u = coordinate_units(equations.scene, length)
    own = {"across": length, "across'": length / time, "spin": length / time, "turn": 1.0, "turn'": 1 / time}
    more = [own[name.rstrip("12345")] for name in equations.states[2 * (len(u) + 5) :]]
    return np.array([*u, *(u / time), *[1.0] * 5, *[1 / time] * 5, *more])


@each_effect()
def test_weights_are_numbers_with_a_reason(support, name):
    scene = taken(support, name)
    weight = EXAMPLES[name].weight(scene)
    assert isinstance(weight, EffectInfluence)
    assert len(weight.why) > 10
    assert weight.value is None or (math.isfinite(weight.value) and weight.value >= 0)


@pytest.mark.parametrize("support", SUPPORTS)
def test_what_has_no_strength_weighs_nothing(support):
    """An effect of nothing would not change the answer, as far as it can tell."""
    scene = scene_on(support)
    for effect in WEIGHTLESS:
        if not fits(effect, scene):
            continue
        value = effect.weight(with_effects(scene, effect)).value
        assert value in (0.0, None)


@pytest.mark.parametrize("name", EXAMPLES)
def test_states_are_those_of_the_effects(name):
    """Only a rotor that is not steady and motion across the race add any."""
    for support in SUPPORTS:
        scene = taken(support, name)
        if scene is None:
            continue
        equations, plain = assemble(scene), assemble(scene_on(support))
        more = list(equations.states[len(plain.states) :])
        assert equations.states[: len(plain.states)] == plain.states
        assert more == STATES.get(name, [])
        for part in (equations.initial, equations.scales, equations.relative):
            assert len(part) == len(equations.states)
