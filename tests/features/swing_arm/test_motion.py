"""The tongue of a swing arm and its forced motion, against theory and against an integration of the arm's equation.

The second derivation is SciPy's integration of (J + 2l·ds·cos ωt) φ'' + h_sh l² φ' + c l² φ − 2l·ds·ω sin ωt φ' =
l·ds·ω² sin ωt (Kovalenko 2010, (7)), written here.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.rotor import Race
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.floquet import arm_growth, floquet_edge
from abu_calc.dynamics.stability.verdict import stability
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.features.swing_arm.motion import arm_motion, simulated_motion, tongue
from abu_calc.features.swing_arm.view import ArmMotion, TongueEdge
from abu_calc.formulas.swing_arm import averaged_edge, contact_gain, forced_harmonics, free_rates, lifting_angle
from abu_calc.foundation.errors import RangeError

NAMES = ("M1", "N1", "M2", "N2", "M13", "N13", "M3", "N3")
PUBLISHED = dict(
    zip(NAMES, (-0.207596, -1.59745, 0.153636, 0.876846, -0.854914, -2.73765, -0.123908, -0.607194), strict=True)
)
"""At ω = 100, ω₀ = 62, h = 4 1/s."""


def coefficients(kappa: float) -> dict[str, float]:
    """What stands before the powers of κ, of which the first order has two."""
    one, two, three = forced_harmonics(kappa, 100.0, 62.0, 4.0)
    bare = forced_harmonics(1e-9, 100.0, 62.0, 4.0)[0] / 1e-9
    again = (one / kappa - bare) / kappa**2
    found = (bare, two / kappa**2, again, three / kappa**3)
    return dict(zip(NAMES, (part for z in found for part in (z.real, z.imag)), strict=True))


def test_amplitudes_of_the_reference() -> None:
    assert coefficients(0.05) == pytest.approx(PUBLISHED, rel=5e-6)


def periodic(kappa: float, omega: float, natural: float, h: float) -> list[complex]:
    """M + iN of three orders: the periodic solution of the linear equation, by three runs over a period."""
    period = 2 * math.pi / omega
    times = period * np.arange(64) / 64

    def slope(t: float, y: np.ndarray) -> tuple[float, float]:
        weight = 1 + 2 * kappa * math.cos(omega * t)
        force = omega**2 * kappa * math.sin(omega * t)
        return y[1], (force - 2 * y[1] * (h - kappa * omega * math.sin(omega * t)) - natural**2 * y[0]) / weight

    def run(start: np.ndarray, samples: np.ndarray) -> np.ndarray:
        return solve_ivp(slope, (0, period), start, "DOP853", samples, rtol=1e-13, atol=1e-17).y

    unit = np.diag((1e-2, 1.0))
    still, *others = (run(start, np.array([period]))[:, -1] for start in (np.zeros(2), *unit))
    growth = np.column_stack([(end - still) for end in others]) / np.diag(unit)
    z = run(np.linalg.solve(np.eye(2) - growth, still), times)[0]
    return [complex(2 * np.mean(z * np.exp(1j * k * omega * times))) for k in (1, 2, 3)]


def test_what_the_perturbation_leaves_out() -> None:
    """κ⁵, κ⁴, κ⁵ of the three orders: halving κ makes the remainders 32, 16 and 32 times smaller."""
    rests = [
        [abs(a - b) for a, b in zip(periodic(k, 100.0, 62.0, 4.0), forced_harmonics(k, 100.0, 62.0, 4.0), strict=True)]
        for k in (0.04, 0.02)
    ]
    ratios = [large / small for large, small in zip(*rests, strict=True)]
    assert ratios == pytest.approx([32.0, 16.0, 32.0], rel=0.02)


def test_the_equation_at_a_large_imbalance() -> None:
    """κ = 0.05: time integration agrees to the remainder, κ² of each order."""
    for found, expected in zip(periodic(0.05, 100.0, 62.0, 4.0), forced_harmonics(0.05, 100.0, 62.0, 4.0), strict=True):
        assert abs(found - expected) < 0.02 * abs(expected)


def test_a_resonance_that_nothing_damps_is_infinite() -> None:
    assert not any(math.isfinite(abs(z)) for z in forced_harmonics(0.01, 50.0, 100.0, 0.0))
    with pytest.raises(RangeError):
        forced_harmonics(0.31, 50.0, 100.0, 1.0)


@pytest.mark.parametrize(("kappa", "derived"), [(0.005, 0.49999), (0.05, 0.49867), (0.1, 0.49461), (0.2, 0.47687)])
def test_the_edge_at_twice_the_natural_frequency(kappa: float, derived: float) -> None:
    assert floquet_edge(kappa, 0.5) == pytest.approx(derived, abs=1e-5)
    assert averaged_edge(kappa, 0.5) == 0.5


@pytest.mark.parametrize("kappa", [0.05, 0.1])
def test_the_worst_detuning(kappa: float) -> None:
    """½ + 17κ²/128 at k = ½ − 13κ²/32, to the second order: the next is κ⁴."""
    middle = 0.5 - 13 * kappa**2 / 32
    highest = floquet_edge(kappa, middle)
    assert highest == pytest.approx(0.5 + 17 * kappa**2 / 128, abs=5 * kappa**4)
    assert highest > 0.5
    assert all(floquet_edge(kappa, middle + side * kappa / 20) < highest for side in (-1, 1))


@pytest.mark.parametrize("share", [-0.9, -0.5, 0.0, 0.5, 0.9])
def test_averaging_and_floquet_at_a_small_imbalance(share: float) -> None:
    """σ_c = ½√(1 − 16((k − ½)/κ)²) but for the shift of the middle, of the second order."""
    kappa = 0.001
    ratio = 0.5 - 13 * kappa**2 / 32 + share * kappa / 4
    assert floquet_edge(kappa, ratio) == pytest.approx(0.5 * math.sqrt(1 - share**2), abs=1e-3)
    assert floquet_edge(kappa, 0.5 + 1.02 * kappa / 4) == averaged_edge(kappa, 0.5 + 1.02 * kappa / 4) == 0


@pytest.mark.parametrize(
    ("kappa", "place", "derived"),
    [
        (0.2, -1.146, 0.00034),
        pytest.param(0.3, -1.2535, 0.0009, marks=pytest.mark.slow),
        pytest.param(0.4, -1.489, 0.0021, marks=pytest.mark.slow),
    ],
)
@pytest.mark.slow
def test_the_next_tongue_is_negligible(kappa: float, place: float, derived: float) -> None:
    """About k = 3/2 + place·κ², where a scan found its tip: σ_c to the digits that were derived."""
    low, high = 0.0, 0.004
    for _ in range(8):
        sigma = (low + high) / 2
        near = (arm_growth(kappa, 1.5 + (place + x) * kappa**2, sigma) for x in np.linspace(-0.012, 0.012, 25))
        low, high = (sigma, high) if any(one > 0 for one in near) else (low, sigma)
    assert low == pytest.approx(derived, rel=0.1)
    assert arm_growth(kappa, 1.5, 0.0) < 1e-6


def test_friction_lifts_at_small_angles() -> None:
    """f = 0.45, R/l = 0.33: least g = −0.0220 at 0.144 rad, so that c_n > 45 c_sh diverges; by a grid."""
    grid = np.linspace(0, math.pi, 200001)
    gains = np.sin(grid) * (np.sin(grid) + 0.45 * (0.33 - np.cos(grid)))
    lowest = lifting_angle(0.45, 0.33)
    assert lowest == pytest.approx(grid[gains.argmin()], abs=1e-4) == pytest.approx(0.144, abs=5e-4)
    assert contact_gain(lowest, 0.45, 0.33) == pytest.approx(gains.min(), abs=1e-9) == pytest.approx(-0.0220, abs=5e-5)
    assert lifting_angle(0.0, 0.33) == lifting_angle(0.45, 1.0) == lifting_angle(0.0, 1.0) == 0.0


def test_below_a_gap_of_finite_mass_nothing_balances() -> None:
    """m l²/J_O = 0.002 of two balls, ω₀/ω = 0.95, light damping: supercritical, not stable; at half the speed it is."""
    length, inertia, omega = 0.3, 0.45, 300.0
    mass = 0.002 * inertia / length**2 / 2

    def scene(ratio: float) -> Scene:
        support = SwingArmSupport(length, inertia, inertia * (ratio * omega) ** 2 / length**2, 10.0)
        race = Race(0.03, (mass, mass), 10.0, 1.0, (2.0, -1.0), (0.0, 0.0))
        return Scene("arm", support, omega, mass * 0.03, 0.0, (race,), 1.0, (0.0,), (0.0,))

    assert stability(scene(0.95)).stable is False
    assert stability(scene(0.5)).stable is True


@dataclass(frozen=True)
class Drawn:
    """An arm near its tongue [SI]: length, inertia, natural frequency, κ, ω₀/ω, σ."""

    length: float
    inertia: float
    natural: float
    kappa: float
    ratio: float
    sigma: float

    @property
    def speed(self) -> float:
        return self.natural / self.ratio

    @property
    def imbalance(self) -> float:
        return self.kappa * self.inertia / self.length

    @property
    def damping(self) -> float:
        """h_sh = 2J·σκω₀/l²."""
        return 2 * self.inertia * self.sigma * self.kappa * self.natural / self.length**2

    @property
    def scene(self) -> Scene:
        support = SwingArmSupport(
            self.length, self.inertia, self.inertia * self.natural**2 / self.length**2, self.damping
        )  # fmt: skip
        return Scene("arm", support, self.speed, self.imbalance, 0.0, (), TURNS * 2 * math.pi / self.speed, (0.0,),
                     (0.0,))  # fmt: skip


TURNS = 6


def drawn(count: int, seed: int) -> list[Drawn]:
    """Both sides of the edge, 3 % of the tongue's height and more from it; κ so small that the arm's angles are."""
    rng, found = np.random.default_rng(seed), []
    while len(found) < count:
        kappa = float(np.exp(rng.uniform(math.log(1e-4), math.log(1e-2))))
        ratio = 0.5 - 13 * kappa**2 / 32 + float(rng.uniform(-1.3, 1.3)) * kappa / 4
        sigma = float(rng.uniform(0, 0.7))
        edge = 0.5 * math.sqrt(max(0.0, 1 - (4 * (ratio - 0.5 + 13 * kappa**2 / 32) / kappa) ** 2))
        if abs(sigma - edge) > 0.03:
            found.append(Drawn(float(rng.uniform(0.2, 0.8)), float(rng.uniform(0.1, 3.0)),
                               float(rng.uniform(20, 500)), kappa, ratio, sigma))  # fmt: skip
    return found


def growth_of_runs(ends: list[np.ndarray], natural: float, start: float, duration: float) -> float:
    """Growth rate [1/s] of the difference of motions from three starts: at rest, moved, pushed."""
    columns = [(end - ends[0]) * (1.0, 1 / natural) / start for end in ends[1:]]
    return math.log(np.abs(np.linalg.eigvals(np.column_stack(columns))).max()) / duration


def integrated(arm: Drawn) -> float:
    """By the equation of the arm, integrated for all its turns."""
    J, l_ds, omega, square = arm.inertia, arm.imbalance * arm.length, arm.speed, arm.length**2
    stiffness = arm.inertia * arm.natural**2

    def slope(t: float, y: np.ndarray) -> tuple[float, float]:
        c, s = l_ds * math.cos(omega * t), l_ds * math.sin(omega * t)
        force = omega**2 * s + 2 * omega * s * y[1] - arm.damping * square * y[1] - stiffness * y[0]
        return y[1], force / (J + 2 * c)

    end, size = arm.scene.duration, 1e-3
    starts = ((0.0, 0.0), (size, 0.0), (0.0, size * arm.natural))
    runs = [solve_ivp(slope, (0, end), start, "DOP853", rtol=1e-11, atol=1e-15).y[:, -1] for start in starts]
    return growth_of_runs(runs, arm.natural, size, end)


def simulated(arm: Drawn) -> float:
    """By the equations of motion of the package, in which angles are not small."""
    equations, end, size = assemble(arm.scene), arm.scene.duration, 1e-4
    starts = ((0.0, 0.0), (size, 0.0), (0.0, size * arm.natural))
    runs = [scipy_.integrate(replace(equations, initial=start), 1e-10, [end]).y[:, -1] for start in starts]
    return growth_of_runs(runs, arm.natural, size, end)


def same_side(arm: Drawn) -> None:
    """Multipliers, the package's simulation and the equation above: one rate, and one side of the edge by it."""
    found = stability(arm.scene)
    assert found.growth_rate is not None and found.state == "arm alone"
    own, equation = simulated(arm), integrated(arm)
    scale = arm.kappa * arm.natural / 2  # the rate at which it grows without damping
    edge = floquet_edge(arm.kappa, arm.ratio)
    grows = arm.sigma < edge
    assert found.growth_rate == pytest.approx(equation, abs=1e-3 * scale)
    assert own == pytest.approx(equation, abs=0.02 * scale)
    assert (found.growth_rate > 0) is grows and (equation > 0) is grows and (own > 0) is grows, (arm, edge)
    assert found.stable is not grows


@pytest.mark.few(1)
@pytest.mark.parametrize("arm", drawn(3, 1), ids=lambda arm: f"k{arm.ratio:.5f}")
@pytest.mark.slow
def test_floquet_and_simulation_agree_on_the_side(arm: Drawn) -> None:
    same_side(arm)


@pytest.mark.hard
def test_floquet_and_simulation_agree_on_the_side_of_100_arms() -> None:
    arms = drawn(100, 2010)
    growing = sum(arm.sigma < floquet_edge(arm.kappa, arm.ratio) for arm in arms)
    assert 20 < growing < 80  # both sides are there
    for arm in arms:
        same_side(arm)


def test_rates_at_the_tongue() -> None:
    """−(h ± κω₀/2) in time, by multipliers of the equation itself: at 2ω₀ the second order of κ is left."""
    kappa, natural, h = 0.002, 150.0, 0.2
    high, low = free_rates(kappa, natural, h)
    assert (high, low) == (kappa * natural / 2 - h, -kappa * natural / 2 - h)
    found = arm_growth(kappa, 0.5, h / (kappa * natural)) * 2 * natural
    assert found == pytest.approx(high, abs=2 * kappa**2 * natural)


def test_motion_of_a_scene() -> None:
    """Perturbation, the package's own periodic motion, and the linear equation integrated here: one answer."""
    arm = Drawn(0.35, 0.62, 300.0, 1e-3, 0.62, 4.0)
    motion, held = arm_motion(arm.scene), arm.scene.support.standing_arm(arm.scene.balls)
    assert isinstance(motion, ArmMotion) and held is not None
    perturbation = forced_harmonics(arm.kappa, arm.speed, arm.natural, -motion.rate)
    simulated, rates = simulated_motion(arm.scene, held, perturbation) or ((), ())
    expected = periodic(arm.kappa, arm.speed, arm.natural, -motion.rate)
    for order, (one, other, third) in enumerate(zip(perturbation, simulated, expected, strict=True), 1):
        assert abs(one - third) < 1e-4 * abs(third)
        # The package's angles are not small: of the first order that is z², of the third about a tenth.
        assert abs(other - third) < (1e-4, 1e-3, 0.05)[order - 1] * abs(third)
        shown = motion.harmonics[order - 1]
        assert shown.perturbation_um == pytest.approx(1e6 * arm.length * abs(one))
        assert shown.simulation_um == pytest.approx(1e6 * arm.length * abs(other))
        assert shown.resonance_rpm == pytest.approx(arm.natural * 30 / math.pi / order)
    assert motion.simulated_rates_per_s == rates == pytest.approx((motion.rate, motion.rate), rel=1e-4)
    assert motion.parametric_speed_rpm == pytest.approx(2 * arm.natural * 30 / math.pi)


def test_no_motion_where_there_is_none() -> None:
    arm = Drawn(0.35, 0.62, 300.0, 1e-3, 0.62, 4.0)
    free = SwingArmSupport(0.35, 0.62, 0.0, 10.0)
    assert "nothing holds" in str(arm_motion(replace(arm.scene, support=free)))
    assert "κ" in str(arm_motion(replace(arm.scene, imbalance=0.0)))
    assert "κ" in str(arm_motion(replace(arm.scene, imbalance=1.0)))


def test_the_tongue_in_speeds_and_damping() -> None:
    """h = σκω₀ at ω = ω₀/k, h_sh = 2J h/l²."""
    edges = tongue(0.02, 150.0, 2 * 0.62 / 0.35**2, 9)
    assert all(isinstance(one, TongueEdge) for one in edges)
    assert [one.speed for one in edges] == sorted(one.speed for one in edges)
    middle = edges[4]
    assert middle.speed == pytest.approx(150 / (0.5 - 13 * 0.02**2 / 32))
    assert middle.floquet == pytest.approx(0.02 * 150 / 2 * 2 * 0.62 / 0.35**2 * (1 + 17 * 0.02**2 / 64), rel=1e-5)
    assert edges[0].floquet == edges[0].averaged == 0
