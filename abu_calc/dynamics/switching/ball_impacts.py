"""Balls that touch: changes of all speeds by impacts, and which touching pairs press.

Accelerations are linear in torques on the balls, so unit torques give all that is needed of the mass matrix, whatever
the support and the other effects. Balls that touch pass on torques about the race's centre: their angles are bound.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from abu_calc.dynamics.effect import SwitchPoint
from abu_calc.dynamics.equations.right_hand_side import by_pulls, derivative, prepared, solve_all
from abu_calc.dynamics.motion import AnyArray
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass

MOST_IMPACTS = 10_000
"""Most impacts in a chain that passes them on without end.

After that all balls that still approach lose their speed at once.
"""

SOFT = 1e-11
"""Compliance of contacts and of sticking, relative to that of the balls: it picks one distribution of the forces of a
chain that sticks between its neighbours, where rigid bodies leave them open."""

SURPLUS = 1e-7 / 4
"""A ball at rest slips when pulled by this much more, relatively, than friction holds."""


@dataclass(frozen=True, eq=False)
class Responses:
    """Responses of a state with all balls free: θ'', normal forces per ball mass, and effects of torques.

    `pairs` (P × n): 1 for the ball ahead, −1 for the one behind. `by_torque`, `normal_by_torque` (n × n):
    per unit torque about the race's centre [N m] on each ball. `friction` (n): ±m R f, negative where the
    inner side of the race presses; zero without dry friction. `kick`: change of the state by an impulse of
    torques [N m s].
    """

    t: float
    pairs: AnyArray
    accelerations: AnyArray
    by_torque: AnyArray
    normal: AnyArray
    normal_by_torque: AnyArray
    friction: AnyArray
    kick: Callable[[AnyArray], AnyArray]

    def among(self, chosen: AnyArray) -> "Responses":
        """The same for some of the pairs."""
        return replace(self, pairs=self.pairs[chosen])


def responses(at: SwitchPoint, behind: list[int], ahead: list[int]) -> Responses:
    """Responses of a state to torques on the balls, for pairs of balls."""
    p = at.parameters
    m, levers, loads = prepared(np, at.t, at.y, at.acting)
    hold = np.zeros(p.balls) if loads.hold is None else loads.hold
    # What friction does to balls that it cannot hold is known.
    grip = np.zeros(p.balls) if loads.grip is None else np.where(hold != 0, 0.0, loads.grip)
    loads = replace(loads, mates=None, free=None, grip=grip)
    base, levered = solve_all(m, levers, loads, p), p.masses * m.radii
    balls, normal = by_pulls(m, levers, loads, p)

    def kick(torques: AnyArray) -> AnyArray:
        """Change of the state by torques, from the difference of two solutions.

        The forces are as large as the scene's, so that no digits are lost.
        """
        size = (levered * p.radii).max() * p.speed**2 / np.abs(torques).max()
        pull = torques * size / levered
        more = replace(loads, pull=pull if loads.pull is None else loads.pull + pull)
        changed, still = (derivative(m, answer, at.y, at.acting) for answer in (solve_all(m, levers, more, p), base))
        return np.asarray((changed - still) / size)

    unity = np.eye(p.balls)
    return Responses(
        at.t, unity[ahead] - unity[behind], base.balls / m.radii, balls / np.outer(m.radii, levered), base.normal,
        normal / levered, hold * levered, kick,
    )  # fmt: skip


def impacts(answer: Responses, y: AnyArray, rates: slice, restitution: float, slow: AnyArray, rest: float) -> AnyArray:
    """The state after all pairs that approach have met, v⁺ = v⁻ + M⁻¹ Dᵀ Λ; the same object where none does.

    One after the other, the fastest approach first: each leaves −e times its speed of approach, so energy never grows.
    Pairs that then part or approach more slowly than `slow` (P) [rad/s] get equal speeds to within `rest` [rad/s],
    momentum conserved. Where none approaches by more than that, nothing is done: pairs part as slowly as they do.
    """
    D = answer.pairs
    matrix, relative, total = D.dot(answer.by_torque).dot(D.T), D.dot(y[rates]), np.zeros(len(D))
    if not np.any(relative < -rest):
        return y
    for count in range(MOST_IMPACTS):
        worst = int((relative + slow).argmin())
        near = np.abs(relative) <= slow if count < MOST_IMPACTS - 1 else relative <= slow
        if relative[worst] < -slow[worst] and not near[worst]:
            impulse = -(1 + restitution) * relative[worst] / matrix[worst, worst]
            total[worst] += impulse
            relative = relative + matrix[:, worst] * impulse
        elif np.any(np.abs(relative) > rest, where=near):
            impulses = -np.linalg.solve(matrix[np.ix_(near, near)], relative[near])
            total[near] += impulses
            relative = relative + matrix[:, near].dot(impulses)
            relative[near] = 0.0
        else:
            break
    torques = total.dot(D)
    return y + answer.kick(torques) if torques.any() else y


def approaches(answer: Responses, torques: AnyArray) -> AnyArray:
    """Relative accelerations [rad/s²] at which pairs would meet again that torques [N m] press together."""
    own = np.einsum("ij,jk,ik->i", answer.pairs, answer.by_torque, answer.pairs)
    accelerations: AnyArray = own * np.maximum(torques, 0.0)
    return accelerations


def pressing(answer: Responses, directions: AnyArray, joined: AnyArray, margin: float) -> tuple[AnyArray, AnyArray]:
    """1 for each touching pair with equal speeds that presses, 0 for one that parts; by what torques they press.

    Relative acceleration ≥ 0 ⟂ λ ≥ 0 of pairs, and Coulomb's law of the balls at rest (direction 0) on their races, as
    one complementarity problem. Block principal pivoting from the pairs that were joined, after some rounds by the
    first index alone: it ends, because the matrix is symmetric and positive definite but for a small f (Júdice & Pires
    1994). `margin` [N m]: what counts as no torque. Raises NotTrustworthyError when a large f leaves no solution.
    """
    problem = _Problem(answer, margin)
    rests = (directions == 0) & (answer.friction != 0)
    status, fixed = np.concatenate([joined, np.where(rests, 0.0, directions)]), np.concatenate([joined < 0, ~rests])
    for attempt in range(20 + 10 * len(status)):
        wrong, better, torques = problem.failing(status)
        wrong &= ~fixed
        if not wrong.any():
            return status[: len(joined)], torques[: len(joined)]
        if attempt > 10 + len(status):
            wrong &= np.cumsum(wrong) <= 1
        status = np.where(wrong, better, status)
    raise NotTrustworthyError(
        f"at t = {answer.t:.6g} s no combination of touching and sticking balls is consistent\n"
        "  check the lever arm of dry rolling friction, or leave ball_contact out"
    )


class _Problem:
    """Torques z = (λ of pairs, friction on balls) and what they do: w = W z + q, relative and own accelerations."""

    def __init__(self, answer: Responses, margin: float) -> None:
        self.pairs, balls = answer.pairs.shape
        E = np.vstack([answer.pairs, np.eye(balls)])
        self.W, self.q = E.dot(answer.by_torque).dot(E.T), E.dot(answer.accelerations)
        rows = np.zeros((self.pairs, len(E)))
        self.most = np.concatenate([np.zeros(self.pairs), answer.friction * answer.normal])
        self.most_by_torque = np.vstack([rows, answer.friction[:, None] * answer.normal_by_torque.dot(E.T)])
        self.margin = margin

    def failing(self, status: AnyArray) -> tuple[AnyArray, AnyArray, AnyArray]:
        """Failing assumptions, better ones (pairs 1 joined or 0; balls 0 sticking or ±1), and all torques."""
        pair = np.arange(len(status)) < self.pairs
        held = np.where(pair, status > 0, status == 0)
        unit, own = np.eye(len(status)), np.diag(self.W)
        # A force that is not free to hold is 0 in a pair, and −σ f n on a ball.
        signs = np.where(pair, 0.0, status)
        matrix = np.where(held[:, None], self.W + SOFT * np.diag(own), unit + signs[:, None] * self.most_by_torque)
        right = np.where(held, -self.q, -signs * self.most)
        z = np.linalg.solve(matrix, right)
        # Softness is taken back where it was not needed.
        z += np.linalg.solve(matrix, np.where(held, right - self.W.dot(z), 0.0))
        w, most = self.W.dot(z) + self.q, np.maximum(self.most + self.most_by_torque.dot(z), 0.0)
        parts, meets = z < -self.margin, w < -self.margin * own
        slips, stops = np.abs(z) > (1 + SURPLUS) * most, status * w < -self.margin * own
        wrong = np.where(pair, np.where(held, parts, meets), np.where(held, slips, stops))
        better = np.where(pair, 1.0 - status, np.where(held, -np.sign(z), 0.0))
        return wrong, better, z
