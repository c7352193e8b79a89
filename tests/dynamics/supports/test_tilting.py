"""A rigid rotor that tilts, against closed forms: conical whirl, imbalances, bearings, and balls that are glued."""

import cmath
import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.scene import Race
from abu_calc.dynamics.supports.planar import LinearSupport
from abu_calc.dynamics.supports.steady_motion import unbalanced_amplitude
from abu_calc.dynamics.supports.tilting import tilting
from abu_calc.foundation.errors import RangeError
from tests.dynamics.supports.steady import MASS, PLACES, POLAR, SPEED, TRANSVERSE, acceleration, assert_steady, scene_on

STIFFNESS, DAMPING = ((21500.0, 15800.0), (21500.0, 15800.0)), ((5.375, 3.95), (5.375, 3.95))


def isotropic(polar: float = POLAR, places=PLACES, stiffness: float = 2e4, damping: float = 0.0) -> LinearSupport:
    count = len(places)
    return tilting(
        MASS, TRANSVERSE, polar, places, ((stiffness,) * 2,) * count, ((damping,) * 2,) * count, axial_inertia=False
    )


@pytest.mark.parametrize("polar", [0.0, POLAR, TRANSVERSE, 2 * TRANSVERSE])
def test_conical_whirl_has_the_gyroscopic_frequencies(polar):
    """J_t ω² − J_p Ω ω − k_t = 0 on bearings that do not couple tilts to translation; forward and backward."""
    z, k = 0.13, 2e4
    scene = scene_on(isotropic(polar, (z, -z), k), imbalance=0.0)
    spread = math.sqrt((polar * SPEED) ** 2 + 4 * TRANSVERSE * 2 * k * z**2)
    for omega in ((polar * SPEED + spread) / (2 * TRANSVERSE), (polar * SPEED - spread) / (2 * TRANSVERSE)):
        assert_steady(scene, np.array((0, 0, 1e-3, -1e-3j)), omega)
    assert_steady(scene, np.array((1e-3, -1e-3j, 0, 0)), math.sqrt(2 * k / MASS))


def test_static_imbalance_moves_the_centre_and_couple_tilts_alone():
    z, k, lean = 0.13, 2e4, 6.8e-5
    couple = lean * (TRANSVERSE - POLAR)
    scene = scene_on(isotropic(POLAR, (z, -z), k), couple=couple, couple_angle=1.1)
    r = scene.imbalance * SPEED**2 / (2 * k - MASS * SPEED**2) * cmath.exp(0.3j)
    tilt = couple * SPEED**2 / (2 * k * z**2 - (TRANSVERSE - POLAR) * SPEED**2) * cmath.exp(1.1j)
    assert_steady(scene, np.array((r, -1j * r, tilt, -1j * tilt)))
    assert unbalanced_amplitude(scene) == pytest.approx(abs(r), rel=1e-12)


def test_polar_axis_that_leans_tends_to_be_the_axis_of_rotation():
    """Far above its supports a rotor turns about its principal axis: the shaft leans by −χ."""
    lean = 6.8e-5
    scene = scene_on(isotropic(stiffness=1e-6), imbalance=0.0, couple=lean * (TRANSVERSE - POLAR))
    assert_steady(scene, np.array((0, 0, -lean, 1j * lean)))


def test_unequal_bearings_couple_tilt_and_translation():
    """Complex 2 × 2 system in r and Θ, written down from the equations of the rigid rotor."""
    k, b = 2e4, 4.0
    couple = 5e-7
    scene = scene_on(isotropic(stiffness=k, damping=b), couple=couple, couple_angle=-0.7)
    z, square = np.array(PLACES), SPEED**2
    bearing = k + 1j * SPEED * b
    matrix = np.array(
        (
            (2 * bearing - MASS * square, bearing * z.sum()),
            (bearing * z.sum(), bearing * (z**2).sum() - (TRANSVERSE - POLAR) * square),
        )
    )
    forces = square * np.array((scene.imbalance * cmath.exp(0.3j), couple * cmath.exp(-0.7j)))
    r, tilt = np.linalg.solve(matrix, forces)
    assert_steady(scene, np.array((r, -1j * r, tilt, -1j * tilt)))


def test_anisotropic_bearings_without_polar_inertia_are_two_planes():
    support = tilting(MASS, TRANSVERSE, 0.0, PLACES, STIFFNESS, DAMPING)
    scene = scene_on(support, imbalance_angle=0.0)
    z, phasors = np.array(PLACES), np.zeros(4, dtype=complex)
    for axis, force in ((0, 1), (1, -1j)):
        k, b = (np.array(values)[:, axis] for values in (STIFFNESS, DAMPING))
        bearing = k + 1j * SPEED * b
        matrix = [[bearing.sum(), bearing @ z], [bearing @ z, bearing @ z**2]] - SPEED**2 * np.diag((MASS, TRANSVERSE))
        phasors[axis::2] = np.linalg.solve(matrix, (force * scene.imbalance * SPEED**2, 0))
    assert_steady(scene, phasors)


@dataclass(frozen=True)
class Held(Effect):
    """Balls glued to their race."""

    name = "held"
    kind = "dissipative"

    def act(self, m, mode, own, levers, loads, p):
        loads.own(free=0.0 * m.cos)


@pytest.mark.parametrize(("axial", "count"), [(True, 3), (True, 5), (False, 4)])
def test_balls_glued_to_their_races_are_rings_of_the_rotor(axial, count):
    """n balls evenly round races at ±z add m, ½ m R² + m z² and m R², without axial motion only m z².

    The tilt is so small that its square is no matter.
    """
    place, R, mass, z, k = 0.04, 0.03, 0.02, 0.13, 2e4
    angles = tuple(0.2 + 2 * math.pi * n / count for n in range(count))
    races = tuple(Race(R, (mass,) * count, 0.0, 1.0, angles, (0.0,) * count, at) for at in (place, -place))
    support = replace(isotropic(POLAR, (z, -z), k), axial_inertia=axial)
    scene = scene_on(support, races=races, imbalance=0.0, effects=(Held(),))
    ring = 2 * count * mass
    Jt = TRANSVERSE + ring * (place**2 + (R**2 / 2 if axial else 0.0))
    Jp = POLAR + (ring * R**2 if axial else 0.0)
    kt = 2 * k * z**2
    spread = math.sqrt((Jp * SPEED) ** 2 + 4 * Jt * kt)
    for omega in ((Jp * SPEED + spread) / (2 * Jt), (Jp * SPEED - spread) / (2 * Jt)):
        tilt = 1e-9
        computed = acceleration(scene, np.array((0, 0, tilt, 0)), np.array((0, 0, 0, omega * tilt)))
        np.testing.assert_allclose(computed / tilt, (0, 0, -(omega**2), 0), atol=1e-6 * omega**2)
    still = acceleration(scene, np.array((1e-6, 0, 0, 0)), np.zeros(4))
    assert still[0] == pytest.approx(-2 * k * 1e-6 / (MASS + ring), rel=1e-9)


def test_inertias_and_bearings_of_no_body_are_refused() -> None:
    with pytest.raises(RangeError, match="polar inertia"):
        isotropic(polar=2.01 * TRANSVERSE)
    with pytest.raises(RangeError, match="transverse inertia"):
        tilting(1.0, 0.0, 0.0, PLACES, STIFFNESS, DAMPING)
    with pytest.raises(RangeError, match="support stiffness"):
        tilting(1.0, 0.1, 0.0, PLACES, ((1.0, -1.0), (1.0, 1.0)), DAMPING)
    with pytest.raises(ValueError, match="shorter"):
        tilting(1.0, 0.1, 0.0, PLACES, STIFFNESS[:1], DAMPING)
