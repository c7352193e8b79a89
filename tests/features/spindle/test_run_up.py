"""Run-up and section drawing of a machine with two races."""

import math
from functools import cache
from itertools import pairwise

import pytest
from scipy.integrate import solve_ivp

from abu_calc.features.spindle.case import SpindleDesign, size_races
from abu_calc.features.spindle.study import run_up_amplitudes
from abu_calc.inputs.read_machine import read_machine


@cache
def design_of() -> SpindleDesign:
    return size_races(read_machine("pedestal-grinder", ['machine.spindle_axis="vertical"']))


@pytest.mark.slow
def test_the_machine_without_autobalancers_runs_up_as_an_own_integration_does() -> None:
    """M·r'' = force of both imbalances, J·Θ'' with gyroscopic moment: largest in a revolution about its mean."""
    design = design_of()
    W, up = design.case.speed, 1.0
    static, couple = 2500e-6 + 1800e-6, 0.26 * (2500e-6 - 1800e-6)
    M, J, Jp, k, c = 62.0, 3.1, 0.09, 4.4e5, 600.0

    def rhs(t: float, s: list[complex]) -> list[complex]:
        w, a = (W * t / up, W / up) if t < up else (W, 0.0)
        turn = W * t**2 / (2 * up) if t < up else W * up / 2 + W * (t - up)
        drive = (w**2 - 1j * a) * complex(math.cos(turn), math.sin(turn))
        r, tilt, vr, vt = s
        force = static * drive - k * r - c * vr
        moment = couple * drive - k * 0.04 * tilt - c * 0.04 * vt + 1j * Jp * w * vt
        return [vr, vt, force / M, moment / J]

    times = [k * 2 * math.pi / W / 40 for k in range(int(1.7 * W / 2 / math.pi * 40))]
    own = solve_ivp(rhs, (0, times[-1]), [0j] * 4, "DOP853", times, rtol=1e-9, atol=1e-12)
    turned = [W * t**2 / (2 * up) if t < up else W * up / 2 + W * (t - up) for t in times]
    points = run_up_amplitudes(design, accuracy=0.01)
    for number in (3, 6, len(points) - 1):
        inside = [index for index, turn in enumerate(turned) if int(turn / 2 / math.pi) == number]
        amplitude = 0.0
        for side in (1, -1):
            path = [complex(own.y[0][index] + side * 0.2 * own.y[1][index]) for index in inside]
            mean = sum(path) / len(path)
            amplitude = max(amplitude, *(abs(place - mean) for place in path))
        assert points[number].without == pytest.approx(amplitude, rel=0.03)


@pytest.mark.slow
def test_balls_help_at_full_speed_and_speeds_ascend() -> None:
    points = run_up_amplitudes(design_of(), accuracy=0.02)
    assert all(a.speed <= b.speed + 1e-9 for a, b in pairwise(points))
    assert points[-1].speed == pytest.approx(design_of().case.speed, rel=1e-6)
    last = points[-1]
    assert last.with_um is not None
    assert last.with_um < 0.5 * last.without_um
