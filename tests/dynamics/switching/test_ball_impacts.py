"""What torques on the balls do, against the mass matrix of the second derivation and against torques put in as such."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
import pytest

from abu_calc.dynamics.effect import Effect, Kind, SwitchPoint
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.equations.right_hand_side import accelerations, derivative
from abu_calc.dynamics.motion import Levers, Loads, Motion
from abu_calc.dynamics.rotor import Parameters
from abu_calc.dynamics.switching.ball_impacts import Responses, responses
from tests.dynamics.effects.test_contract import Sample, samples, taken
from tests.dynamics.energy import mass_matrix
from tests.dynamics.scenes import SUPPORTS, with_effects

ROTORS = ((), ("run_up",), ("motor",))
BESIDE = ("race_eccentricity", "transverse_motion", "transverse_motion, free spin", "grinding_contact, rigid")


@dataclass(frozen=True)
class Twist(Effect):
    """Torques [N m] on the balls about the centre of their race; asks for the normal forces too."""

    torques: tuple[float, ...]

    name: ClassVar[str] = "twist"
    kind: ClassVar[Kind] = "driven"

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """Along the race."""
        if loads.grip is None:
            loads.own(grip=np.zeros(p.balls))
        loads.add(pull=np.array(self.torques) / (p.masses * m.radii))


def asked(sample: Sample) -> Responses:
    moment = SwitchPoint(sample.equations, sample.t, sample.y, sample.modes, 0)
    return responses(moment, [0], [1])


def twisted(sample: Sample, torques: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """θ'', normal forces per mass, and the rates of all states."""
    scene = with_effects(sample.scene, *sample.scene.effects, Twist(tuple(torques.tolist())))
    acting = assemble(scene).in_mode((*sample.modes, None))
    motion, _, solved = accelerations(np, sample.t, sample.y, acting)
    return solved.balls / motion.radii, solved.normal, derivative(motion, solved, sample.y, acting)


@pytest.mark.few(10)
@pytest.mark.parametrize("rotor", ROTORS)
@pytest.mark.parametrize(("support", "beside"), [(s, b) for s in SUPPORTS for b in BESIDE if taken(s, b)])
def test_unit_torques_answer_like_torques_put_in(support, beside, rotor):
    """Linear to the last digits: the tolerance is rounding's share of the difference of two solutions."""
    scene = taken(support, beside, *rotor)
    for sample in samples(scene, 3):
        answer, torques = asked(sample), np.random.default_rng(3).uniform(-1, 1, len(scene.ball_masses))
        (rates, normal, state), still = twisted(sample, torques), twisted(sample, 0 * torques)
        np.testing.assert_allclose(answer.by_torque @ torques, rates - still[0], rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(answer.normal_by_torque @ torques, normal - still[1], rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(answer.kick(torques), state - still[2], rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("rotor", ROTORS)
@pytest.mark.parametrize("support", SUPPORTS)
def test_unit_torques_answer_by_the_inverse_mass_matrix(support, rotor):
    """Balls that roll one way: their block of M⁻¹."""
    scene = taken(support, *rotor)
    for sample in samples(scene, 3):
        size, balls = len(scene.support.names), len(scene.ball_masses)
        inverse = np.linalg.inv(mass_matrix(scene, sample.t, sample.y))[size : size + balls, size : size + balls]
        np.testing.assert_allclose(asked(sample).by_torque, inverse, rtol=1e-10, atol=1e-12 * abs(inverse).max())
