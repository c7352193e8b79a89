"""Where balls come to rest in closed form: what the tests hold the motion against.

Angles [rad] from the zero mark; imbalances as complex numbers U e^{iφ} [kg m]. An idle, freely suspended rotor.
"""

import cmath
import math


def balls_resultant(imbalance: float, imbalance_angle: float) -> complex:
    """V = −m₀e e^{iφ} [kg m]: what the balls must add up to. It fixes two balls; of more, n − 2 angles stay free."""
    return -cmath.rect(imbalance, imbalance_angle)


def two_ball_angles(imbalance: float, ball_moment: float, imbalance_angle: float = 0.0) -> tuple[float, float]:
    """θ = arg V ∓ arccos(|V|/2mR_p) [rad] of two equal balls of moment m R_p [kg m], so cos(θ − φ) = −m₀e/(2mR_p).

    >>> [round(math.degrees(a), 6) for a in two_ball_angles(1.0, 1.0, math.radians(45))]
    [165.0, 285.0]
    """
    opposite = imbalance_angle + math.pi
    half = math.acos(imbalance / (2 * ball_moment))
    return opposite - half, opposite + half
