"""The swing arm at the tongue of parametric resonance, and one that work pushes away."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.verdict import stability
from abu_calc.dynamics.supports.swing_arm import cutting_arm
from abu_calc.formulas.swing_arm import Arm
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.simulation.simulate import simulate
from tests.cli.runner import abu
from tests.dynamics.supports.test_swing_arm import bare
from tests.hard.scenes import check_claim, run, scene_of
from tests.inputs.scenes import ARM

pytestmark = pytest.mark.hard

KAPPA, NATURAL = 0.02, 50.0
MIDDLE = 0.5 - 13 * KAPPA**2 / 32
"""ω₀/ω in the middle of the tongue, to the second order."""


def arm_at(share: float, damping: float) -> Scene:
    """Beside the middle of the tongue by this share of its half width, κ/4, with h [1/s]; 200 revolutions."""
    omega = NATURAL / (MIDDLE + share * KAPPA / 4)
    return bare(omega, NATURAL, damping, KAPPA, 400 * math.pi / omega)


def growth_in(scene: Scene) -> float:
    """Growth rate [1/s] of the difference of two motions, a motion without imbalance: over the second half."""
    times = np.array((scene.duration / 2, scene.duration))
    one, other = (run(replace(scene, start_position=(x,)), times, tolerance=1e-10).y for x in (1e-3, 0.0))
    unit = np.array(((1.0,), (1 / NATURAL,)))
    sizes = np.hypot(*((one - other) * unit))
    return float(np.log(sizes[1] / sizes[0]) / (times[1] - times[0]))


@pytest.mark.parametrize("share", [-1.05, -0.95, 0.0, 0.95, 1.05])
def test_the_edge_of_the_undamped_tongue(share: float) -> None:
    """|ω₀/ω − ½| < κ/4: 5 % inside the arm's motion grows by (κω₀/2) √(1 − share²), 5 % outside it does not.

    By multipliers, and by simulation of all terms; at the edge that beats, so there it is told only roughly.
    """
    scene = arm_at(share, 0.0)
    expected = KAPPA * NATURAL / 2 * math.sqrt(max(0.0, 1 - share**2))
    judged = stability(scene)
    assert judged.growth_rate == pytest.approx(expected, abs=0.02 * KAPPA * NATURAL)
    assert (judged.growth_rate > 0.1 * KAPPA * NATURAL) is (abs(share) < 1)
    assert growth_in(scene) == pytest.approx(expected, abs=KAPPA * NATURAL / 8)


@pytest.mark.parametrize("share", [0.95, 1.05])
def test_the_damping_that_parametric_resonance_needs(share: float) -> None:
    """h > (κω₀/2)(1 + 17κ²/64) at ω = 2ω₀: 5 % less is unstable, 5 % more is stable, at the rate h − κω₀/2."""
    limit = KAPPA * NATURAL / 2 * (1 + 17 * KAPPA**2 / 64)
    scene = arm_at(0.0, share * limit)
    judged = stability(scene)
    assert judged.stable is (share > 1)
    assert judged.growth_rate == pytest.approx((1 - share) * limit, abs=0.01 * limit)
    assert growth_in(scene) == pytest.approx((1 - share) * limit, abs=0.02 * limit)
    check_claim(replace(scene, duration=2.0))


def pushed_away() -> Scene:
    """f = 0.45, R/l = 0.33 at 0.144 rad: g = −0.022, a joint of c_n/60 is too soft by a quarter."""
    arm = cutting_arm(Arm(0.35, 0.62, 1e5 / 60, 40.0, 1e5, 0.45, 0.33 * 0.35, 0.144))
    assert -600 < arm.stiffness < -500
    return scene_of(arm, 300.0, 1e-5, (), 1.4)


def test_work_that_pushes_the_arm_away() -> None:
    """Static divergence: no place to rest, not stable, and a motion that grows by the root of J s² + b l² s + c l² = 0.

    A simulation long enough for the arm to turn right round is refused with that reason; it is no result.
    """
    scene = pushed_away()
    arm = scene.support
    with pytest.raises(InputError, match="the arm does not stand"):
        arm.resting_position()[0]
    rate = float(np.roots([arm.inertia, arm.damping * 0.35**2, arm.stiffness * 0.35**2]).real.max())
    assert stability(scene).growth_rate == pytest.approx(rate, rel=1e-3)
    ends = run(scene, [1.0, 1.4], tolerance=1e-10).y[0]
    assert math.log(ends[1] / ends[0]) / 0.4 == pytest.approx(rate, rel=1e-2)
    with pytest.raises(NotTrustworthyError, match=r"turned right round at t = [12]\.\d+ s"):
        simulate(replace(scene, duration=5.0), integrator="scipy")


def test_a_file_with_such_an_arm_is_refused(tmp_path) -> None:
    """By its key, with what is found and the remedy."""
    file = tmp_path / "arm.toml"
    file.write_text(ARM, encoding="utf-8")
    seen = abu("simulate", str(file), "--set", "scene.swing_arm.contact_angle_deg=5")
    assert seen.status == 2
    assert "scene.swing_arm.contact_angle_deg" in seen.err
    assert "does not stand" in seen.err
