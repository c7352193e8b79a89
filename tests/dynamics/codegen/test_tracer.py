"""The equations as plain Python against the same in arrays: every support and effect, in the modes of random states."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.codegen import tracer as plain
from abu_calc.dynamics.codegen.tracer import Numbers
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.rotor import Modes
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.switching.modes import settled, watched, watches
from abu_calc.foundation.errors import NotTrustworthyError
from tests.dynamics.effects.test_contract import taken
from tests.dynamics.examples import EXAMPLES
from tests.dynamics.random_scenes import random_scene
from tests.dynamics.scenes import ROTORS, SUPPORTS, scene_on, straight_grinder

ROUNDING = 1e-11
"""Relative to the largest part of the answer: sums are taken in another order."""


def both(equations: Equations, modes: Modes, t: float, y: np.ndarray) -> None:
    """Rates and watched numbers, plain and by arrays."""
    acting = equations.in_mode(modes)
    rates, numbers = plain.functions(equations, Numbers(equations), modes)
    expected = equations.rhs(np, t, y, acting) / equations.scales
    np.testing.assert_allclose(rates(t, y) / np.array(equations.scales), expected, 1e-9, ROUNDING * np.ptp(expected))
    if watches(equations):
        values = np.array(watched(t, y, acting))
        np.testing.assert_allclose(numbers(t, y), values, 1e-9, ROUNDING * np.abs(values).max())


def everywhere(scene: Scene, count: int = 5) -> None:
    """At random states about the start, where the effects can settle on modes."""
    equations, rng = assemble(scene), np.random.default_rng(3)
    for _ in range(count):
        t = float(rng.uniform(0, scene.revolution))
        y = np.array(equations.initial) + 0.1 * rng.normal(size=len(equations.states)) * np.array(equations.scales)
        try:
            y, modes = settled(equations, t, y, equations.first_modes)
        except NotTrustworthyError:  # balls anywhere may overlap
            modes = equations.first_modes
        both(equations, modes, t, y)


@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("way", ROTORS)
def test_every_support_and_rotor(support, way):
    everywhere(scene_on(support, *ROTORS[way]))


@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("name", EXAMPLES)
def test_every_effect(support, name):
    scene = taken(support, name)
    if scene is None:
        pytest.skip("such a support has no such effect")
    everywhere(scene)


@pytest.mark.parametrize("seed", range(0, 60, 3))
def test_random_scenes(seed):
    everywhere(random_scene(seed), 2)


def test_written_once_for_all_designs_of_a_structure(monkeypatch):
    plain._makers.clear()
    written = []
    write = plain._write
    monkeypatch.setattr(plain, "_write", lambda *parts: written.append(1) or write(*parts))
    scene = straight_grinder()
    for speed in (400.0, 500.0):
        everywhere(replace(scene, speed=speed), 2)
    assert len(written) == 1


def test_what_is_no_number_is_told_as_one():
    """Plain Python would raise where arrays go on with NaN."""
    equations = assemble(straight_grinder())
    rates, _ = plain.functions(equations, Numbers(equations), equations.first_modes)
    y = np.array(equations.initial)
    y[4] = math.inf
    assert all(math.isnan(value) for value in rates(0.0, y))
