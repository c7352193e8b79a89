"""Two hands on a machine's handles as masses and elements: what both sizing and the equations of motion start from.

Source: ISO 10068:2012, Annex C, model 2; how its elements connect is assumed.
"""

from typing import Final

from abu_calc.standards.hands import Hand

NODES: Final = ("machine", "palm", "fingers")
"""Moving nodes: the handle, which is the machine; palm and arm, m₁; the fingers, m₂.

The skin m₃, m₄ is on the handle.
"""

ELEMENTS: Final = ((0.0, 1.0, 0.0), (0.0, -1.0, 1.0), (1.0, -1.0, 0.0), (1.0, 0.0, -1.0))
"""Stretch of each element per displacement of the nodes.

The elements are: 1 palm to ground, 2 palm to fingers, 3 and 4 these to the handle.
"""

Matrix = tuple[tuple[float, float, float], ...]


def hand_masses(hand: Hand) -> tuple[float, float, float]:
    """Masses of both hands at the nodes, the machine's own left out [kg]."""
    palm, fingers, *skin = hand.masses
    return 2 * sum(skin), 2 * palm, 2 * fingers


def joined(values: tuple[float, float, float, float]) -> Matrix:
    """The symmetric matrix, nodes by nodes, of the elements of both hands: stiffness [N/m] or damping [N·s/m].

    >>> joined((5.0, 3.0, 2.0, 1.0))
    ((6.0, -4.0, -2.0), (-4.0, 20.0, -6.0), (-2.0, -6.0, 8.0))
    """
    pairs = list(zip(values, ELEMENTS, strict=True))
    return tuple(_row([2 * sum(value * way[i] * way[j] for value, way in pairs) for j in range(3)]) for i in range(3))


def _row(values: list[float]) -> tuple[float, float, float]:
    x, y, z = values
    return x, y, z


def handle_reaction(hand: Hand, speed: complex) -> complex:
    """Force of both hands per displacement of the handle [N/m] at Ω [rad/s]: palm and fingers eliminated.

    D₀₀ − D₀ᵢ (Dᵢⱼ)⁻¹ Dⱼ₀ of D = K + iΩC − Ω²M, the machine's own mass left out.
    """
    K, C, M = joined(hand.stiffness), joined(hand.damping), hand_masses(hand)
    D = [[K[i][j] + 1j * speed * C[i][j] - (M[i] * speed**2 if i == j else 0.0) for j in range(3)] for i in range(3)]
    determinant = D[1][1] * D[2][2] - D[1][2] * D[2][1]
    palm_moves = -(D[1][0] * D[2][2] - D[1][2] * D[2][0]) / determinant
    fingers_move = -(D[1][1] * D[2][0] - D[1][0] * D[2][1]) / determinant
    return D[0][0] + D[0][1] * palm_moves + D[0][2] * fingers_move
