"""The rooms of dynamics: arrows run one way, no circle of files, and a new effect or support needs no other file."""

import ast
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

import abu_calc.dynamics
from abu_calc.dynamics.effect import Effect, EffectInfluence, Kind
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.integrators.compiled import run as loop
from abu_calc.dynamics.motion import Levers, Loads, Motion
from abu_calc.dynamics.rotor import Parameters
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.dynamics.switching.modes import starting
from abu_calc.foundation.errors import InputError
from abu_calc.simulation.response import evaluate, needed_times
from tests.dynamics.energy import mass_matrix
from tests.dynamics.scenes import dimensionless, scene_on, with_effects
from tests.house import structure
from tests.house.newcomers.rail import Rail

DYNAMICS = Path(abu_calc.dynamics.__file__).parent
PACKAGE = DYNAMICS.parent
ROOMS = ("", "supports", "equations", "switching", "effects", "codegen", "integrators", "averaging", "stability")
"""Of dynamics, in order; the first are its own files."""
BELOW = {"version", "foundation", "standards", "formulas", "inputs"}


def imports(path: Path) -> set[str]:
    """Modules of the package that a file imports, for types alone too."""
    return structure.imports()[next(name for name, file in structure.files().items() if file == path)]


def file_of(module: str) -> Path | None:
    """Path of a module of the package."""
    return structure.files().get(module)


def room_of(path: Path) -> str:
    """Of a file of dynamics."""
    return path.relative_to(DYNAMICS).parts[0] if path.parent != DYNAMICS else ""


@pytest.mark.slow
def test_a_room_imports_only_rooms_before_it():
    seen = set()
    for path in DYNAMICS.rglob("*.py"):
        room = room_of(path)
        seen.add(room)
        files = {module: file_of(module) for module in imports(path)}
        within = {room_of(file) for file in files.values() if file and DYNAMICS in file.parents}
        assert within <= set(ROOMS[: ROOMS.index(room) + 1]), path
        assert {module.split(".")[1] for module in files} <= BELOW | {"dynamics"}, path
    assert seen >= set(ROOMS)


@pytest.mark.slow
def test_no_file_of_dynamics_or_simulation_is_in_a_circle():
    files = [*DYNAMICS.rglob("*.py"), *(PACKAGE / "simulation").rglob("*.py")]
    left = {path: {file_of(module) for module in imports(path)} & set(files) for path in files}
    while free := [path for path, needed in left.items() if not needed]:
        left = {path: needed - set(free) for path, needed in left.items() if path not in free}
    assert not left


def test_nobody_asks_which_kind_a_support_is():
    """Outside supports/ at most three files of the package know of any difference."""
    asks = ("isinstance(support", "isinstance(scene.support", "support.turns", "support.couples")
    asking = [
        path
        for path in PACKAGE.rglob("*.py")
        if "supports" not in path.parts and any(one in path.read_text(encoding="utf-8") for one in asks)
    ]
    assert len(asking) <= 3, asking


def test_effects_are_asked_for_by_name_nowhere_in_dynamics():
    for path in DYNAMICS.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        assert '.effect("' not in text and "getattr(scene" not in text, path


def test_effects_do_not_know_each_other():
    for path in (DYNAMICS / "effects").glob("*.py"):
        if path.name not in ("registry.py", "__init__.py"):
            assert not any(module.startswith("abu_calc.dynamics.effects") for module in imports(path)), path


# Slots of the loads


@pytest.mark.parametrize(
    "effect",
    [TransverseMotionEffect(0.7, 0.1), DryRollingFrictionEffect(0.02, 0.1), DryRollingFrictionEffect(0.01, 0.2)],
    ids=str,
)
def test_two_effects_that_want_one_slot_are_refused(effect):
    equations = assemble(scene_on("planar", effect, replace(effect, ball_radius=0.11)))
    with pytest.raises(InputError, match="two effects"):
        equations.rhs(np, 0.0, np.array(equations.initial), equations.acting)


def test_effects_set_no_slot_past_the_contract():
    """`act` adds, or owns; it never assigns to the loads."""
    slots = {field.name for field in fields(Loads)}
    for path in (DYNAMICS / "effects").glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
                assert not (ast.unparse(node.value) == "loads" and node.attr in slots), path


# What effects tell of themselves


# A new effect


@dataclass(frozen=True)
class Wind(Effect):
    """A toy: a steady force on the axis along x, and a pull of its own on each ball; `force` [N], `pull` [m/s²]."""

    force: float
    pull: float

    name: ClassVar[str] = "wind"
    kind: ClassVar[Kind] = "conservative"

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """Along x."""
        loads.add(frame=np.eye(len(p.frame.mass))[0] * self.force, pull=-self.pull * m.sin, press=self.pull * m.cos)

    def weight(self, scene: Any) -> EffectInfluence:
        """Unknown."""
        return EffectInfluence(None, "it blows")


@pytest.mark.slow
def test_a_new_effect_is_one_class():
    """Integrated by SciPy and by the loop beside another effect, without a change anywhere."""
    wind = Wind(0.05, 0.02)
    scene = with_effects(dimensionless(2.0, 0.05, 0.02, 0.1, 0.1, (1.6, -1.4), 40.0), wind, GravityEffect(0.01))
    equations, times = assemble(scene), np.linspace(0, 40, 5)
    one = scipy_.integrate(equations, 1e-9, times).y
    other = loop.integrate(equations, 1e-9, times, method="dop853").y
    np.testing.assert_allclose(one, other, atol=1e-5)
    alone, half = replace(scene, races=(), duration=400.0), scene.revolution / 2
    ends = scipy_.integrate(assemble(alone), 1e-8, [400.0 - half, 400.0]).y[0]
    assert ends.mean() == pytest.approx(0.05, abs=1e-6)


# A new support


def on_rail(*effects: Effect) -> Scene:
    scene = dimensionless(3.0, 0.02, 0.02, 0.1, 0.2, (1.0, 2.5), 300.0)
    rail = Rail(1.0, 1.0, 0.2, 0.4)
    return replace(scene, support=rail, start_position=(0.0,), start_velocity=(0.0,), effects=effects)


def test_a_new_support_is_one_class():
    """Integrated, traced, evaluated: balls balance it above its resonance, and without them it moves as it must."""
    scene = on_rail()
    equations, times = assemble(scene), needed_times(scene)
    found = evaluate(scene, scipy_.integrate(equations, 1e-7, times))
    assert found.axis_amplitude < 1e-3 * found.unbalanced_amplitude
    assert found.unbalanced_amplitude == pytest.approx(0.02 * 9 / abs(complex(1 - 9, 0.6)))
    other = loop.integrate(equations, 1e-9, times[-1:], method="dop853").y[:, -1]
    np.testing.assert_allclose(scipy_.integrate(equations, 1e-9, times[-1:]).y[:, -1], other, atol=1e-5)


def test_a_new_support_takes_effects_and_drives():
    scene = on_rail(GravityEffect(0.01), DryRollingFrictionEffect(0.0002, 0.1))
    state, modes = starting(assemble(scene))
    assert np.isfinite(assemble(scene).rhs(np, 0.0, state, assemble(scene).in_mode(modes))).all()
    with pytest.raises(InputError, match="tilts"):
        replace(scene, couple=0.1)
    with pytest.raises(InputError, match="no work"):
        scene.support.plane(0.0)


# The balls' mass on an arm


def test_balls_on_an_arm_weigh_by_how_their_angles_are_counted():
    """In angles relative to the rotor, which turns with the arm, m (l² + R²) on the mean; in angles in space m l².

    Both from the mass matrix of the second derivation: (φ, θ) to (φ, γ = θ + φ + Ωt).
    """
    arm = SwingArmSupport(1.3, 9.0, 5.0, 0.3)
    scene = replace(scene_on("planar"), support=arm, start_position=(0.0,), start_velocity=(0.0,), imbalance=0.0)
    scene = replace(scene, races=tuple(replace(race, inertia_factor=1.0) for race in scene.races))
    balls, held, free = scene.balls, [], []
    to_space = np.eye(6)
    to_space[1:, 0] = -1.0
    for turn in np.linspace(0, 2 * np.pi, 8, endpoint=False):
        y = np.concatenate([[0.2, 0.0], np.array(scene.start_angles) + turn, np.zeros(5)])
        matrix = mass_matrix(scene, 0.0, y)
        held.append(matrix[0, 0])
        free.append((to_space.T @ matrix @ to_space)[0, 0])
    assert np.mean(held) == pytest.approx(arm.holding(balls).inertia, rel=1e-12)
    np.testing.assert_allclose(free, arm.small_motion(1.0).carrying(balls).mass[0, 0], rtol=1e-12)
