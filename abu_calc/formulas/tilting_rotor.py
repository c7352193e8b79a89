"""Two races on one rigid rotor: resultants that balance, worst phases, critical speeds and stability.

Complex coordinates q = (r, Θ), r_z = r + z·Θ the whirl at z along the spindle, z [m] from the centre of mass.
Imbalances U_j [kg m, complex] lie at z_j, the races at z₁ and z₂. With Z = K − Ω²·diag(M, J_t − J_p) + iΩC the forward
whirl is q = Ω²·Z⁻¹·Σ (1, z)ᵀU. Bearings are alike along x and y.
"""

import math
from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import Final, NamedTuple

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range

Pair = tuple[float, float]
ComplexPair = tuple[complex, complex]
Square = tuple[ComplexPair, ComplexPair]
_MASS: Final = Range("mass of the rotor", 0.0, 1e6, "kg", open_low=True)
_TRANSVERSE: Final = Range("transverse inertia", 0.0, 1e9, "kg·m²", open_low=True)
_SHARE: Final = Range("share of phases", 0.0, 1.0)
ONE_PLANE: Final = 1e-9
"""Races nearer than this [m] lie in one plane."""


class Bearing(NamedTuple):
    """Bearing alike along x and y: place [m], stiffness [N/m], damping [N s/m]."""

    place: float
    stiffness: float
    damping: float = 0.0


class PlacedImbalance(NamedTuple):
    """Imbalance [kg m] in the rotor's frame, and its place [m] along the spindle."""

    place: float
    imbalance: complex


class WhirlMode(NamedTuple):
    """Forward whirl at a speed of the rotor: frequency [rad/s], modal mass [kg], damping ratio, shape (r, Θ)."""

    frequency: float
    modal_mass: float
    damping_ratio: float
    shape: Pair

    def at(self, place: float) -> float:
        """Whirl of the mode at a place [m] of the spindle."""
        return self.shape[0] + place * self.shape[1]


@dataclass(frozen=True)
class TiltingRotor:
    """Rigid rotor on bearings: mass M [kg], transverse and polar inertia J_t, J_p [kg m²] about the centre of mass.

    Without the balls: at rest in their balanced places they do not take part in the forward whirl.
    """

    mass: float
    transverse_inertia: float
    polar_inertia: float
    bearings: tuple[Bearing, ...]

    def __post_init__(self) -> None:
        _MASS.check(self.mass)
        _TRANSVERSE.check(self.transverse_inertia)
        Range("polar inertia", 0.0, 2 * self.transverse_inertia, "kg·m²").check(self.polar_inertia)

    @property
    def forward_inertia(self) -> float:
        """J' = J_t − J_p [kg m²], the inertia of a forward whirl at the speed of the rotor."""
        return self.transverse_inertia - self.polar_inertia

    @cached_property
    def stiffness(self) -> tuple[float, float, float]:
        """Σk, Σkz and Σkz² of the bearings [N/m, N, N m]."""
        return _moments((bearing.place, bearing.stiffness) for bearing in self.bearings)

    @cached_property
    def damping(self) -> tuple[float, float, float]:
        """Σc, Σcz and Σcz² of the bearings."""
        return _moments((bearing.place, bearing.damping) for bearing in self.bearings)

    def dynamic_stiffness(self, speed: float) -> Square:
        """Z = K − Ω²·diag(M, J') + iΩC of the forward whirl."""
        (k, kz, kzz), (c, cz, czz) = self.stiffness, self.damping
        square = speed**2
        coupled = kz + 1j * speed * cz
        return (
            (k - square * self.mass + 1j * speed * c, coupled),
            (coupled, kzz - square * self.forward_inertia + 1j * speed * czz),
        )

    @formula(
        "Whirl at one place of a rotor on bearings per rotating force at another",
        "h_pq = (1, z_p)·(K_r − Ω²·diag(M, J_t − J_p) + i·Ω·C_r)⁻¹·(1, z_q)ᵀ",
        "m/N",
        assumed="bearings alike along x and y, small tilts",
        source="Genta 2005, Dynamics of Rotating Systems, 2.5 (rigid rotor, four freedoms)",
    )
    def receptance(self, at: float, force_at: float, speed: float) -> complex:
        """
        >>> free = TiltingRotor(2.0, 0.5, 0.1, ())
        >>> round(free.receptance(0.1, 0.2, 10.0).real, 6)
        -0.0055
        """
        r, tilt = _solved(self.dynamic_stiffness(speed), (1, force_at))
        return r + at * tilt

    def whirl(self, at: float, imbalances: Sequence[PlacedImbalance], speed: float) -> complex:
        """Whirl [m] at a place, caused by imbalances: Ω²·Σ h(z, z_j)·U_j."""
        each = (self.receptance(at, place, speed) * imbalance for place, imbalance in imbalances)
        return speed**2 * sum(each, 0j)

    @formula(
        "Critical speed of a rotor, at which its forward whirl is at resonance",
        "det(K_r − Ω²·diag(M, J_t − J_p)) = 0",
        "rad/s",
        where="A rotor with J_p > J_t has one critical speed only: its tilt does not resonate with the imbalance.",
        assumed="no damping",
        source="Genta 2005, Dynamics of Rotating Systems, 2.5",
    )
    def critical_speeds(self) -> tuple[float, ...]:
        """Ascending.

        >>> bearings = (Bearing(-0.5, 4.0), Bearing(0.5, 4.0))
        >>> [round(speed, 6) for speed in TiltingRotor(2.0, 0.5, 0.0, bearings).critical_speeds()]
        [2.0, 2.0]
        """
        k, kz, kzz = self.stiffness
        mass, inertia = self.mass, self.forward_inertia
        if not inertia:
            return (math.sqrt(max(k - kz**2 / kzz, 0.0) / mass),) if kzz else ()
        middle = (k / mass + kzz / inertia) / 2
        product = (k * kzz - kz**2) / (mass * inertia)
        root = math.sqrt(max(middle**2 - product, 0.0))
        return tuple(math.sqrt(square) for square in (middle - root, middle + root) if square > 0)

    @formula(
        "Natural frequency of a forward whirl of a rotor at its speed",
        "det(K_r − ν_w²·diag(M, J_t) + ν_w·Ω·diag(0, J_p)) = 0",
        "rad/s",
        where="Positive roots are forward whirls. At ν_w = Ω it is a critical speed.",
        assumed="no damping",
        source="Genta 2005, Dynamics of Rotating Systems, 2.5",
    )
    def forward_modes(self, speed: float) -> tuple[WhirlMode, ...]:
        """Forward whirls with modal mass μ = φᵀ(diag(M, J_t) − (Ω/2ν)·diag(0, J_p))φ and damping ratio, ascending."""
        import numpy as np

        (k, kz, kzz), gyroscopic = self.stiffness, speed * self.polar_inertia
        M, J = self.mass, self.transverse_inertia
        roots = np.roots((M * J, -M * gyroscopic, -(M * kzz + J * k), gyroscopic * k, k * kzz - kz**2))
        real = sorted(float(root.real) for root in roots if root.real > 0 and abs(root.imag) < 1e-6 * abs(root))
        return tuple(self._mode(frequency, speed) for frequency in real)

    def _mode(self, frequency: float, speed: float) -> WhirlMode:
        (k, kz, kzz), (c, cz, czz) = self.stiffness, self.damping
        first, last = k - frequency**2 * self.mass, kzz - frequency**2 * self.transverse_inertia
        last += frequency * speed * self.polar_inertia
        # The row with the larger entries gives the shape; an uncoupled mode is pure translation or pure tilt.
        scale = math.sqrt(self.transverse_inertia / self.mass)
        upper, lower = (abs(first) + abs(kz) / scale, abs(kz) + abs(last) / scale)
        shape = (-kz, first) if upper * scale >= lower else (-last, kz)
        size = math.hypot(shape[0], shape[1] * scale) or 1.0
        r, tilt = shape[0] / size, shape[1] / size
        mass = self.mass * r**2 + (self.transverse_inertia - speed * self.polar_inertia / (2 * frequency)) * tilt**2
        damped = c * r**2 + 2 * cz * r * tilt + czz * tilt**2
        return WhirlMode(frequency, mass, damped / (2 * frequency * mass), (r, tilt))


def _moments(pairs: Iterable[Pair]) -> tuple[float, float, float]:
    total = [0.0, 0.0, 0.0]
    for place, value in pairs:
        for power in range(3):
            total[power] += value * place**power
    return total[0], total[1], total[2]


def _solved(matrix: Square, right: ComplexPair) -> ComplexPair:
    (a, b), (c, d) = matrix
    determinant = a * d - b * c
    if determinant == 0:
        raise InputError("an undamped rotor has no steady whirl at a critical speed")
    return (d * right[0] - b * right[1]) / determinant, (a * right[1] - c * right[0]) / determinant


def _checked(races: Sequence[float]) -> tuple[float, float]:
    """Places of two races, in two planes."""
    first, second = races
    if abs(first - second) < ONE_PLANE:
        raise InputError(
            "both races lie in one plane", place=Place(key="autobalancer.plane_mm"), found=f"{1e3 * races[0]:g} mm",
            allowed="two planes", remedy="Two races in one plane balance no couple: move one, or use one race.",
        )  # fmt: skip
    return first, second


@formula(
    "Share of an imbalance that a race carries",
    "s_1j = (z_j − z₂)/(z₁ − z₂), s_2j = (z₁ − z_j)/(z₁ − z₂)",
    where="The shares of both races add up to 1. One is outside 0 … 1 if the imbalance lies outside the races.",
    checked=("z₁ ≠ z₂",),
    assumed="both races still",
    source="equilibrium of two parallel rotating forces; Rodrigues et al. 2008",
)
def lever_shares(races: Sequence[float], place: float) -> tuple[float, ...]:
    """
    >>> [round(share, 5) for share in lever_shares((0.3, -0.3), 0.26)]
    [0.93333, 0.06667]
    """
    first, second = _checked(races)
    return (place - second) / (first - second), (first - place) / (first - second)


@formula(
    "Resultant of the balls of race i that balances both races",
    "V_i = −Σ_j s_ij·U_j",
    "kg m",
    where="It depends on neither mass, inertia, springs nor speed: static and couple part vanish together.",
    checked=("z₁ ≠ z₂",),
    assumed="races without eccentricity, a rigid rotor",
    source="derived; Rodrigues et al. 2008",
)
def balancing_resultants(races: Sequence[float], imbalances: Sequence[PlacedImbalance]) -> tuple[complex, ...]:
    """
    >>> [round(1e6 * abs(V)) for V in balancing_resultants((0.3, -0.3), [PlacedImbalance(0.3, 1e-3)])]
    [1000, 0]
    """
    shares = [(lever_shares(races, place), imbalance) for place, imbalance in imbalances]
    return tuple(-sum((share[race] * U for share, U in shares), 0j) for race in (0, 1))


@formula(
    "Resultant of the balls of race i that the eccentricity of the races asks for",
    "V_1 = [(J_t − J_p + M·z₂²)·Δ₁ − (J_t − J_p + M·z₁·z₂)·Δ₂]/(z₁ − z₂)²",
    "kg m",
    where=(
        "Race 2 with 1 and 2 exchanged. The equation is that far above resonance; computed with the bearings, "
        "K_r − Ω²·diag(M, J_t − J_p) + i·Ω·C_r for −Ω²·diag(M, J_t − J_p)."
    ),
    checked=("z₁ ≠ z₂",),
    assumed="a rigid rotor on bearings alike along x and y",
    source="derived: each race whirls about its own centre",
)
def eccentricity_resultants(
    rotor: TiltingRotor, races: Sequence[float], eccentricities: ComplexPair, speed: float
) -> tuple[complex, ...]:
    """
    >>> rotor = TiltingRotor(62.0, 3.1, 0.09, ())
    >>> [round(1e6 * abs(V), 3) for V in eccentricity_resultants(rotor, (0.3, -0.3), (1e-6, 0j), 300.0)]
    [23.861, 7.139]
    """
    first, second = _checked(races)
    span = second - first
    # The motion (r, Θ) of a rotor whose races stay where their centres rotate.
    r = -(second * eccentricities[0] - first * eccentricities[1]) / span
    tilt = -(eccentricities[1] - eccentricities[0]) / span
    (a, b), (c, d) = rotor.dynamic_stiffness(speed)
    force, moment = (a * r + b * tilt) / speed**2, (c * r + d * tilt) / speed**2
    return (second * force - moment) / span, (moment - first * force) / span


@formula(
    "Largest resultant of a race over all phases of the imbalances and of the eccentricities",
    "|s_i1|·U_1 + |s_i2|·U_2 + |V_1Δ| + |V_2Δ|",
    "kg m",
    where="V_1Δ and V_2Δ: resultants of this race that the eccentricities of the two races ask for.",
    assumed="unknown phases: the worst is taken",
    source="triangle inequality",
)
def worst_resultants(
    rotor: TiltingRotor, races: Sequence[float], imbalances: Sequence[PlacedImbalance],
    eccentricities: Sequence[float], speed: float,
) -> tuple[float, ...]:  # fmt: skip
    """
    >>> wheels = [PlacedImbalance(0.26, 2500e-6), PlacedImbalance(-0.26, 1800e-6)]
    >>> found = worst_resultants(TiltingRotor(62.0, 3.1, 0.09, ()), (0.3, -0.3), wheels, (0.0, 0.0), 300.0)
    >>> [round(1e6 * V, 2) for V in found]
    [2453.33, 1846.67]
    """
    shares = [(lever_shares(races, place), abs(imbalance)) for place, imbalance in imbalances]
    by_race = (
        eccentricity_resultants(rotor, races, (eccentricities[0], 0j), speed),
        eccentricity_resultants(rotor, races, (0j, eccentricities[1]), speed),
    )
    return tuple(
        sum(abs(share[race]) * size for share, size in shares) + sum(abs(each[race]) for each in by_race)
        for race in (0, 1)
    )


@formula(
    "Resultant that a share p of the phases between two imbalances stays below",
    "V_p = √(s_i1²·U_1² + s_i2²·U_2² + 2·|s_i1·s_i2|·U_1·U_2·cos(π·(1 − p)))",
    "kg m",
    checked=("share of phases",),
    assumed="the phase between both imbalances is uniform; no eccentricity",
    source="derived: law of cosines",
)
def resultant_quantile(sizes: Pair, share: float) -> float:
    """Resultant [kg m] of two vectors of these `sizes`, not exceeded in a `share` of all phases.

    >>> round(resultant_quantile((2333.333, 120.0), 0.95), 2)
    2451.93
    """
    _SHARE.check(share)
    square = sizes[0] ** 2 + sizes[1] ** 2 + 2 * abs(sizes[0] * sizes[1]) * math.cos(math.pi * (1 - share))
    return math.sqrt(max(square, 0.0))


@formula(
    "Limit to the place of one race between the two critical speeds, translation passed and tilt ahead",
    "z_r² < (K_Θ − (J_t − J_p)·Ω²)/(M·Ω² − K_Σ)",
    "m",
    where="K_Σ and K_Θ: stiffness of translation and tilt. A race farther out drives the tilt.",
    assumed="bearings that do not couple translation and tilt; light damping",
    source="derived: the receptance of the race is negative",
)
def one_race_limit(rotor: TiltingRotor, speed: float) -> float | None:
    """The limit to |z_r| [m]; None if the speed is not between a passed translation and a tilt ahead.

    >>> rotor = TiltingRotor(40.0, 1.2, 0.06, (Bearing(-0.25, 9e4, 120.0), Bearing(0.25, 9e4, 120.0)))
    >>> round(one_race_limit(rotor, 840 * 2 * math.pi / 60), 3)
    0.137
    """
    k, _, kzz = rotor.stiffness
    above, ahead = rotor.mass * speed**2 - k, kzz - rotor.forward_inertia * speed**2
    return math.sqrt(ahead / above) if above > 0 and ahead > 0 else None


def one_race_resultant(
    rotor: TiltingRotor, race: float, imbalances: Sequence[PlacedImbalance], speed: float
) -> complex:
    """Resultant [kg m] of the balls of a single race that stills its own plane: −Σ U_j·h(z_r, z_j)/h(z_r, z_r)."""
    own = rotor.receptance(race, race, speed)
    return -sum((U * rotor.receptance(race, place, speed) / own for place, U in imbalances), 0j)


@formula(
    "Balls in two races balance exactly if this holds, to first order",
    "K_r − Ω²·diag(M, J_t − J_p) is negative definite",
    where="That is J_t > J_p and Ω above both critical speeds, wherever the races are.",
    assumed="balls light compared with the rotor, light damping",
    source="derived; Rodrigues et al. 2008, Sperling et al. 2002",
)
def two_races_balance(rotor: TiltingRotor, speed: float) -> bool:
    """
    >>> rotor = TiltingRotor(40.0, 1.2, 0.06, (Bearing(-0.25, 9e4, 120.0), Bearing(0.25, 9e4, 120.0)))
    >>> [two_races_balance(rotor, rpm * 2 * math.pi / 60) for rpm in (840, 960)]
    [False, True]
    """
    (a, b), (_, d) = rotor.dynamic_stiffness(speed)
    return a.real < 0 and a.real * d.real - b.real**2 > 0


class ModeMargin(NamedTuple):
    """Three conditions of stability for one forward whirl; each margin is above 1 where its condition holds."""

    mode: WhirlMode
    distance: float
    damping: float
    drag: float

    @property
    def holds(self) -> bool:
        """True if all three conditions hold."""
        return min(self.distance, self.damping, self.drag) > 1


@formula(
    "Forward whirl that leaves the balance of two races stable, a sufficient rule of three conditions",
    "(Ω − ν_w)/Ω > (3·N_ν/J)^(1/3), ζ > N_ν·ν_w²·h₀/(2·(Ω − ν_w)·(J²·(Ω − ν_w)² + h₀²)), "
    "h₀ > 4·ζ·ν_w·Ω³·√(N_ν·J/2)/(Ω² − ν_w²)^(3/2)",
    where="N_ν = Σ n·m·(r + z_i·Θ)²/μ_ν over both races, for the shape (r, Θ) of the whirl and its modal mass μ_ν.",
    assumed="equal balls in each race, in any balanced places",
    source="derived; 9163 random rotors, none of 5794 that pass is unstable, 23 % of the stable are refused",
)
def mode_margin(
    mode: WhirlMode, ball_masses: Sequence[PlacedImbalance], speed: float, drag: float, inertia_factor: float
) -> ModeMargin:
    """Margins of one whirl; `ball_masses`: Σ n·m [kg] of each race as `imbalance`, at its place."""
    J = inertia_factor
    share = sum(abs(total) * mode.at(place) ** 2 for place, total in ball_masses) / mode.modal_mass
    gap, zeta, nu = speed - mode.frequency, mode.damping_ratio, mode.frequency
    if gap <= 0 or share <= 0:
        return ModeMargin(mode, 0.0, 0.0, 0.0)
    damping = share * nu**2 * drag / (2 * gap * (J**2 * gap**2 + drag**2))
    least_drag = 4 * zeta * nu * speed**3 * math.sqrt(share * J / 2) / (speed**2 - nu**2) ** 1.5
    return ModeMargin(
        mode, gap / speed / (3 * share / J) ** (1 / 3), zeta / damping if damping else math.inf,
        drag / least_drag if least_drag else math.inf,
    )  # fmt: skip
