"""Race eccentricity: how the races are carried round, and what an axis that whirls with them weighs."""

import cmath

import numpy as np
import pytest

from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.equations.right_hand_side import motion_of
from tests.dynamics.scenes import ROTORS, dimensionless, scene_on

EFFECT = RaceEccentricityEffect(0.05, 0.3)


@pytest.mark.parametrize("acceleration", [0.0, 0.7])
def test_races_are_carried_as_a_point_on_a_turning_disc(acceleration: float) -> None:
    """Δ e^{i(turn + φ)} differentiated twice: Δ (iΩ' − Ω²) e^{i(turn + φ)}, along e_t and e_r of each ball."""
    equations = assemble(scene_on("planar", *ROTORS["guided"], EFFECT))
    p, y = equations.parameters, np.array(equations.initial)
    y[-2:] = 0.9, 1.7
    m = motion_of(np, 0.4, y, p)
    EFFECT.move(m, None, None)
    levers = p.geometry.levers(m, p)  # the guided rotor carries the balls of a race by R_p Ω' from here
    m.acceleration = acceleration
    before = levers.carried_along, levers.carried_outward
    EFFECT.act(m, None, None, levers, None, p)  # type: ignore[arg-type]
    centre = 0.05 * cmath.exp(1j * (0.9 + 0.3))
    assert complex(*m.offset) == pytest.approx(centre)
    moved = (1j * acceleration - 1.7**2) * centre
    seen = moved * (m.cos - 1j * m.sin)
    np.testing.assert_allclose(levers.carried_outward - before[1], seen.real, atol=1e-15)
    np.testing.assert_allclose(levers.carried_along - before[0], seen.imag, atol=1e-15)


def test_its_influence_is_the_whirl_over_the_amplitude_that_it_is_weighed_by() -> None:
    """1 % of m₀e Ω²/|k − MΩ² + iΩc| of the rotor alone: 0.02·9/|1 − 9 + 1.8i| here."""
    scene = dimensionless(3.0, 0.01, 0.02, 0.3, 0.05, (0.4, 1.0), 10.0)
    expected = 0.05 / (0.01 * 0.02 * 9 / abs(complex(1 - 9, 3 * 0.6)))
    assert EFFECT.weight(scene).value == pytest.approx(expected, rel=1e-12)
    assert RaceEccentricityEffect(0.0).weight(scene).value == 0.0


def test_the_offset_is_a_complex_number_in_the_rotor() -> None:
    assert EFFECT.offset == pytest.approx(cmath.rect(0.05, 0.3))
