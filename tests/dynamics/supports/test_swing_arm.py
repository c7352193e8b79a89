"""The rotor on a swing arm against Kovalenko 2010: amplitudes, parametric resonance, balancing, cutting."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport, cutting_arm, idle_arm
from abu_calc.formulas.swing_arm import Arm, pressed_angle
from abu_calc.foundation.errors import InputError, RangeError


def bare(omega: float, natural: float, h: float, kappa: float, duration: float, angle: float = 0.0) -> Scene:
    """No balls: z'' (1 + 2κ cos ωt) + 2z' (h − κω sin ωt) + ω₀² z = ω²κ sin ωt, eq. (8), with J_O = l = 1."""
    arm = idle_arm(Arm(1.0, 1.0, natural**2, 2 * h))
    return Scene("arm", arm, omega, kappa, 0.0, (), duration, (angle,), (0.0,))


def periodic(equations: Equations, period: float, times: np.ndarray) -> np.ndarray:
    """φ of the periodic solution: the equation is linear, so three runs over one period tell where it starts."""

    def run(start: tuple[float, float], samples: np.ndarray) -> np.ndarray:
        return scipy_.integrate(replace(equations, initial=start), 1e-13, samples).y

    ends = [run(start, np.array([period]))[:, -1] for start in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))]
    growth = np.column_stack([end - ends[0] for end in ends[1:]])
    start = np.linalg.solve(np.eye(2) - growth, ends[0])
    return run((float(start[0]), float(start[1])), times)[0]


def test_amplitudes_of_three_harmonics():
    """(11): z = κ(M1 cos + N1 sin) + κ²(M2 …) + κ³(M13 cos + N13 sin + M3 …), remainders two orders of κ on."""
    omega, kappa = 100.0, 0.005
    scene = bare(omega, 62.0, 4.0, kappa, 0.1)
    t = scene.revolution * np.arange(64) / 64
    z = periodic(assemble(scene), scene.revolution, t)
    M1, N1, M2, N2, M13, N13, M3, N3 = (
        -0.207596, -1.59745, 0.153636, 0.876846, -0.854914, -2.73765, -0.123908, -0.607194
    )  # fmt: skip
    first, second, third = (2 * np.mean(z * np.exp(1j * k * omega * t)) for k in (1, 2, 3))
    assert second / kappa**2 == pytest.approx(M2 + 1j * N2, rel=1e-3)
    assert third / kappa**3 == pytest.approx(M3 + 1j * N3, rel=1e-3)
    # The printed digits of M1 and N1 end where κ²M13 begins.
    D = (62.0**2 - omega**2) ** 2 + 4 * 4.0**2 * omega**2
    exact = complex(-2 * 4.0 * omega**3, omega**2 * (62.0**2 - omega**2)) / D
    assert exact == pytest.approx(M1 + 1j * N1, rel=1e-5)
    assert (first / kappa - exact) / kappa**2 == pytest.approx(M13 + 1j * N13, rel=1e-3)


@pytest.mark.parametrize("h", [0.0, 0.3, 1.0])
def test_parametric_resonance_at_twice_the_natural_frequency(h):
    """(22): of the linear equation's two solutions one goes as e^{(κω₀/2 − h)t}, the other as e^{−(κω₀/2 + h)t}."""
    natural, kappa = 50.0, 0.02
    scene = bare(2 * natural, natural, h, kappa, 1.0)
    # By two periods: half a period changes the sign.
    end = 2 * scene.revolution
    equations = assemble(scene)
    ends = [
        scipy_.integrate(replace(equations, initial=start), 1e-12, [end]).y[:, -1]
        for start in ((0.0, 0.0), (1.0, 0.0), (0.0, natural))
    ]
    growth = np.column_stack([(end - ends[0]) * (1.0, 1 / natural) for end in ends[1:]])
    rates = sorted(np.log(np.linalg.eigvals(growth).real) / end)
    assert rates == pytest.approx([-(h + kappa * natural / 2), -(h - kappa * natural / 2)], abs=0.01 * kappa * natural)


def balanced(ratio: float, duration: float) -> tuple[Scene, np.ndarray, np.ndarray]:
    """ω/ω₀ = ratio at 300 rad/s: the scene, the last twentieth of the arm's angle, the balls at the end."""
    J, length, omega = 0.45, 0.3, 300.0
    natural = omega / ratio
    arm = idle_arm(Arm(length, J, J * natural**2 / length**2, 2 * 0.1 * natural * J / length**2))
    race = Race(0.03, (0.01, 0.01), 10.0, 1.0, (2.0, -1.0), (0.0, 0.0))
    scene = Scene("arm", arm, omega, 400e-6, 0.0, (race,), duration, (0.0,), (0.0,))
    y = scipy_.integrate(assemble(scene), 1e-6, np.linspace(0.95 * duration, duration, 2001)).y
    return scene, y[0], np.degrees([math.remainder(angle, 2 * math.pi) for angle in y[2:4, -1]])


@pytest.mark.parametrize("ratio", [5.0, 2.0])
def test_above_its_natural_frequency_the_arm_is_balanced(ratio):
    """cos θ = −400/600: balls at ±131.8°, and next to nothing left of the arm's motion."""
    _, angle, balls = balanced(ratio, 12.0)
    assert sorted(balls) == pytest.approx([-131.8, 131.8], abs=0.1)
    without = 400e-6 * 300**2 * 0.3 / (0.45 * 300**2 * abs(1 - 1 / ratio**2))
    assert np.abs(angle - angle.mean()).max() < 0.01 * without


def cutting(**changes: float) -> tuple[SwingArmSupport, Arm]:
    """The arm that cuts, and as the sizing of the arm knows it."""
    numbers = {
        "length": 0.35, "inertia": 0.62, "joint_stiffness": 2000.0, "joint_damping": 40.0, "contact_stiffness": 1e5,
        "friction": 0.45, "contact_angle": 1.2, "touch_angle": 0.03, "pressing_moment": 20.0, "disk_radius": 0.115,
        **changes,
    }  # fmt: skip
    arm = Arm(**numbers)
    return cutting_arm(arm), arm


def test_resting_angle_balances_all_moments():
    """(5'): M_p − c_sh l²φ = [l sin Z + f (R − l cos Z)] N, N = c_n l (φ − φ₀) sin Z."""
    support, arm = cutting()
    angle = support.resting_position()[0]
    l, R, Z, f = 0.35, 0.115, 1.2, 0.45  # noqa: E741
    N = 1e5 * l * (angle - 0.03) * math.sin(Z)
    lever = l * math.sin(Z) + f * (R - l * math.cos(Z))
    assert 20.0 - 2000.0 * l**2 * angle == pytest.approx(lever * N)
    assert angle == pytest.approx(pressed_angle(arm))
    # Pressed where M_p > c_sh l² φ₀ only.
    assert angle > 0.03
    assert cutting(pressing_moment=5.0)[0].resting_position()[0] < 0.03


def test_a_resting_arm_stays_at_rest():
    support, _ = cutting()
    angle = support.resting_position()[0]
    equations = assemble(Scene("cutting", support, 300.0, 0.0, 0.0, (), 1.0, (angle,), (0.0,)))
    assert np.abs(equations.rhs(np, 0.0, np.array((angle, 0.0)), equations.acting)).max() < 1e-9
    assert idle_arm(Arm(0.35, 0.62, 2000.0, 40.0)) == SwingArmSupport(0.35, 0.62, 2000.0, 40.0, 0.0)
    assert idle_arm(Arm(0.35, 0.62, 0.0, 40.0)).resting_position()[0] == 0


def test_an_arm_that_lifts_itself_does_not_stand():
    """f = 0.45, R/l = 0.33: least g = −0.0220 at 0.144 rad, so the joint must be stiffer than c_n/45."""
    for joint, stands in ((1e5 / 46, False), (1e5 / 45, True)):
        support, _ = cutting(joint_stiffness=joint, contact_angle=0.144, disk_radius=0.33 * 0.35)
        assert (support.stiffness > 0) == stands
        if stands:
            support.resting_position()[0]
        else:
            with pytest.raises(InputError, match="does not stand"):
                support.resting_position()[0]


@pytest.mark.parametrize(
    "name", ["length", "disk_radius", "contact_stiffness", "friction", "contact_angle", "pressing_moment"]
)
def test_what_is_no_arm_is_refused(name):
    with pytest.raises(RangeError):
        cutting(**{name: math.nan})
    if name != "pressing_moment":
        with pytest.raises(RangeError):
            cutting(**{name: -1.0})
