"""Small linear systems for any kind of number, and accelerations by forces on the balls."""

from fractions import Fraction

import numpy as np
import pytest

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.equations.right_hand_side import by_pulls, prepared, solve, solve_all
from tests.dynamics.scenes import ROTORS, SUPPORTS, scene_on


@pytest.mark.parametrize("size", [1, 2, 3, 4, 7])
def test_a_solution_solves_fractions_as_well_as_numbers(size: int) -> None:
    """Exactly for one and two unknowns, beyond that to the rounding of its zeros."""
    root = [[Fraction((3 * i + 5 * j) % 7 + (i == j) * 9, 4) for j in range(size)] for i in range(size)]
    matrix = [[sum(root[k][i] * root[k][j] for k in range(size)) for j in range(size)] for i in range(size)]
    right = [Fraction(k + 1, 3) for k in range(size)]
    x = solve(matrix, right)
    left = [sum(a * b for a, b in zip(row, x, strict=True)) for row in matrix]
    assert left == (right if size <= 2 else pytest.approx([float(value) for value in right], rel=1e-12))


def test_complex_numbers_are_solved_alike() -> None:
    rng = np.random.default_rng(1)
    matrix = rng.random((5, 5)) + 1j * rng.random((5, 5)) + 9 * np.eye(5)
    right = rng.random(5) - 1j * rng.random(5)
    np.testing.assert_allclose(solve(matrix.tolist(), right.tolist()), np.linalg.solve(matrix, right), rtol=1e-12)


@pytest.mark.parametrize("rotor", ROTORS)
@pytest.mark.parametrize("support", SUPPORTS)
def test_unit_forces_along_the_race_answer_like_forces_put_in(support: str, rotor: str) -> None:
    """Accelerations are linear in forces: the answer to one is the difference that it makes."""
    equations = assemble(scene_on(support, *ROTORS[rotor]))
    y, p = np.array(equations.initial) + 0.05, equations.parameters

    def balls(pull: np.ndarray | None) -> np.ndarray:
        motion, levers, loads = prepared(np, 0.3, y, equations.acting)
        if pull is not None:
            loads.add(pull=pull)
        return solve_all(motion, levers, loads, p).balls

    answers, _ = by_pulls(*prepared(np, 0.3, y, equations.acting), p)
    for k, unit in enumerate(np.eye(5)):
        np.testing.assert_allclose(answers[:, k], balls(unit) - balls(None), rtol=1e-9, atol=1e-11)
    assert np.all(np.diag(answers) > 0)
