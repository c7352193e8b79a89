"""Where balls come to rest, and what then remains, in closed form: what the tests hold the motion against.

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


def resting_amplitude(
    imbalance: float, balls_moment: float, speed: float, total_mass: float, natural_frequency: float
) -> float:
    """|w| = |m₀e + b| Ω²/(M |ω² − Ω²|) [m]: axis amplitude with all balls in one place, undamped isotropic support.

    b [kg m] is +n m R_p where they rest on the heavy side (below resonance) and −n m R_p on the light one (above it,
    when they carry too little); M [kg] with the balls, ω = √(k/M).

    >>> round(resting_amplitude(0.1, 0.2, 1.0, 2.0, 2.0), 12)
    0.05
    """
    return abs(imbalance + balls_moment) * speed**2 / (total_mass * abs(natural_frequency**2 - speed**2))
