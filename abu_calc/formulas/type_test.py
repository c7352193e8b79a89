"""Weighted acceleration at the handles in a type test, and the race eccentricity up to which balls lower it.

Imbalances that rotate with the spindle are complex numbers in the rotor [kg m]. A body answers with displacements: of
its race, forward, and of each handle along x, y and z.
"""

import math
from collections.abc import Sequence
from functools import cached_property
from typing import Final

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.roots import root
from abu_calc.foundation.validity import Range

Motion = tuple[complex, complex, complex]
"""Complex amplitudes along x, y and z, per rotating imbalance [1/kg]."""

MEAN_OF_RMS: Final = 0.88
"""Mean over starts and orientations of a vector sum, over its rms; 0.83 … 0.92 in simulations."""
SPREAD: Final = {2: 2.1, 3: 1.5, 4: 1.15, 5: 1.0}
"""Rms displacement that friction leaves, over the friction band, by number of balls; middle of what was simulated."""
SPREAD_OF_MANY: Final = 0.9


@dataclass(frozen=True)
class HandleMotion:
    """Displacement of a handle per imbalance at the wheel and at the race, with the sign of accelerations [1/kg]."""

    name: str
    by_wheel: Motion
    by_race: Motion


@dataclass(frozen=True)
class TypeTestBody:
    """A machine as its balls and its hands feel it: forward displacement of the race per imbalance at wheel and race.

    All displacements are relative to −U: g_rw, g_rr and those of the handles [1/kg].
    """

    race_by_wheel: complex
    race_by_race: complex
    handles: tuple[HandleMotion, ...]

    @property
    def effective_mass(self) -> float:
        """m_F [kg]: the mass that balls feel at the race."""
        return 1 / abs(self.race_by_race)

    @cached_property
    def gains(self) -> tuple["HandleGain", ...]:
        """Each handle with balls that settle."""
        return tuple(HandleGain.of(self, handle) for handle in self.handles)


@dataclass(frozen=True)
class HandleGain:
    """Motion of a handle by the imbalance U and by the displacement d that the race keeps: |P U + Q d|/√2 [m/m].

    `bare`: |A_hw|²/2, `imbalance`: |P|²/2, `race`: |Q|²/2, `cross`: P̄·Q/2.
    """

    name: str
    bare: float
    imbalance: float
    race: float
    cross: complex

    @classmethod
    def of(cls, body: TypeTestBody, handle: HandleMotion) -> "HandleGain":
        """Gain of a handle, which moves by −(A_hw U + A_hr V) with V = (d − g_rw·U)/g_rr."""
        Q = [-motion / body.race_by_race for motion in handle.by_race]
        P = [-wheel - q * body.race_by_wheel for wheel, q in zip(handle.by_wheel, Q, strict=True)]
        return cls(
            handle.name,
            sum(abs(motion) ** 2 for motion in handle.by_wheel) / 2,
            sum(abs(p) ** 2 for p in P) / 2,
            sum(abs(q) ** 2 for q in Q) / 2,
            sum((p.conjugate() * q for p, q in zip(P, Q, strict=True)), 0j) / 2,
        )

    def without(self, imbalance: float) -> float:
        """Rms displacement of three axes without balls [m]."""
        return math.sqrt(self.bare) * imbalance


_SPEED = Range("speed", 0.0, 1e5, "rad/s", open_low=True)


@formula(
    "Weighted acceleration of three axes per rms displacement, for vibration at the speed of rotation",
    "a_hv = W_h·Ω²·s_v",
    "m/s²",
    checked=(_SPEED,),
    source="ISO 5349-1:2001",
)
def acceleration_per_displacement(speed: float) -> float:
    """
    >>> round(acceleration_per_displacement(5800 * math.pi / 30) * 0.366667 * 65e-6, 3)
    1.458
    """
    from abu_calc.standards.vibration import hand_arm_weight

    return hand_arm_weight(_SPEED.check(speed)) * speed**2


def mean_motion(
    gain: HandleGain, imbalance: float, eccentricity: float, friction: float, background: float = 0.0
) -> float:
    """Mean rms displacement [m] over starts and orientations, closed: 0.88·√(P²U² + Q²(Δ² + c_f²)).

    Without friction the mean is taken over the orientations alone, exactly. `background`: rms at other frequencies.
    """
    if not friction:
        return mean_over_orientations(gain, imbalance, eccentricity, evenly(MANY), background)
    square = gain.imbalance * imbalance**2 + gain.race * (eccentricity**2 + friction**2)
    return math.hypot(MEAN_OF_RMS * math.sqrt(square), background)


MANY: Final = 72
"""Orientations that stand for all."""


def evenly(count: int) -> tuple[float, ...]:
    """So many orientations [rad], the first at 0."""
    return tuple(2 * math.pi * k / count for k in range(count))


def mean_over_orientations(
    gain: HandleGain, imbalance: float, eccentricity: float, orientations: Sequence[float], background: float = 0.0
) -> float:
    """Mean rms displacement [m] over orientations [rad] of the wheel, with a race that keeps its eccentricity."""
    steady = gain.imbalance * imbalance**2 + gain.race * eccentricity**2 + background**2
    swing = 2 * imbalance * eccentricity
    squares = (
        steady + swing * (gain.cross * complex(math.cos(angle), -math.sin(angle))).real for angle in orientations
    )
    return sum(math.sqrt(max(square, 0.0)) for square in squares) / len(orientations)


@formula(
    "Race displacement, rms, that dry rolling friction leaves after random starts",
    "c_f = k_n·w_f",
    "m",
    shown="um",
    where=(
        "k_n is 2.1 for two balls, 1.5 for three, 1.15 for four, 1.0 for five and 0.9 for more: the middle of "
        "simulated ranges (1.3–3.2, 1.1–2.0, 1.0–1.3, 0.8–1.0)."
    ),
    assumed="random starts; balls that use 10–60 % of their capacity",
    source="found by simulation of 24 designs with 2500 starts each",
)
def friction_displacement(count: int, band: float) -> float:
    """
    >>> round(1e6 * friction_displacement(4, 10.4e-6), 2)
    11.96
    """
    return SPREAD.get(count, SPREAD_OF_MANY) * band


@formula(
    "Race eccentricity below which the autobalancer lowers the declared value",
    "Δ* = ½(Δ₀ + √(Δ₀² − c_f²)), Δ₀ = U/(k_d·m_F)",
    "m",
    shown="um",
    where=(
        "k_d is the factor 1.3 of machines that balance themselves. There is no such eccentricity if c_f exceeds Δ₀. "
        "If the race lies beside the wheel plane, Δ₀ follows from the mean over the orientations."
    ),
    assumed="vibration of the imbalance alone",
    source="derived; simulated eccentricities differ by −1.5 … 1.1 % (three balls and more)",
)
def break_even(frictionless: float, friction: float) -> float | None:
    """
    >>> round(1e6 * (break_even(6.9712e-6, 5.22e-6) or 0.0), 2), break_even(1e-6, 2e-6)
    (5.8, None)
    """
    if friction > frictionless:
        return None
    return (frictionless + math.sqrt(frictionless**2 - friction**2)) / 2


def frictionless_break_even(
    gains: Sequence[HandleGain], imbalance: float, allowed: float, orientations: Sequence[float],
    background: float = 0.0,
) -> float | None:  # fmt: skip
    """Δ₀ [m]: without friction, the highest handle then moves by the rms displacement `allowed` [m]; None: none.

    >>> point = HandleGain("wheel plane", (1 / 3.2) ** 2, 0.0, 1.0, 0j)
    >>> round(1e6 * (frictionless_break_even([point], 29e-6, point.without(29e-6) / 1.3, (0.0,)) or 0.0), 4)
    6.9712
    """

    def excess(eccentricity: float) -> float:
        means = (mean_over_orientations(gain, imbalance, eccentricity, orientations, background) for gain in gains)
        return max(means) - allowed

    if excess(0.0) >= 0:
        return None
    high = 2 * allowed / math.sqrt(max(gain.race for gain in gains))
    while excess(high) < 0:
        high *= 2
    return root(excess, 0.0, high)
