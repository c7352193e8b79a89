"""The bench test: a ball let go in the standing race; its decay against SciPy, and the values it gives."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from abu_calc.features.identification.bench import bench_text, bench_values, decay, read_decay
from abu_calc.foundation.errors import InputError
from abu_calc.simulation.scene_file import read_any
from abu_calc.simulation.scene_of_file import scene_from
from tests.features.identification.recorded import scene_file

RADIUS, INERTIA = 0.023, 1.4


def test_the_decay_follows_the_equation_without_friction() -> None:
    times = np.linspace(0, 3, 181)
    weight = 9.80665 / RADIUS
    reference = solve_ivp(
        lambda _, y: (y[1], (-3.0 * y[1] - weight * math.sin(y[0])) / INERTIA), (0, 3), (1.0, 0.0), t_eval=times,
        rtol=1e-10, atol=1e-12,
    ).y[0]  # fmt: skip
    # Tolerance: fourth-order steps of 2 ms at 2.8 Hz.
    assert decay(times, 1.0, 3.0, 0.0, RADIUS, INERTIA) == pytest.approx(reference, abs=2e-4)


def test_dry_friction_takes_two_friction_angles_per_half_swing() -> None:
    friction, times = 5e-3, np.linspace(0, 4, 4001)
    angles = decay(times, 0.2, 0.0, friction, RADIUS, INERTIA)
    turns = np.abs(angles[1:-1][np.diff(np.sign(np.diff(angles))) != 0])
    # Theory 1.16: small swings lose 2f each half swing; f·θ̇² adds a few per cent at 0.2 rad.
    assert np.diff(turns[:6]) == pytest.approx(-2 * friction, rel=0.08)
    assert abs(angles[-1]) <= friction * 1.001  # where it sticks


@pytest.mark.slow
@pytest.mark.parametrize(("drag", "lever"), [(4.0, 1e-6), (8.0, 5e-6), (2.0, 15e-6)])
def test_values_of_a_decay_are_found(tmp_path: Path, drag: float, lever: float) -> None:
    scene = scene_from(read_any(str(scene_file(tmp_path))).scene)  # type: ignore[union-attr]
    times = np.arange(0, 3, 1 / 60)
    angles = decay(times, 1.0, drag, lever / scene.races[0].ball_radius, RADIUS, INERTIA)
    angles += math.radians(0.5) * np.random.default_rng(1).normal(size=len(times))
    file = tmp_path / "decay.csv"
    rows = [f"{t:.4f},{math.degrees(angle):.2f}" for t, angle in zip(times, angles, strict=True)]
    file.write_text("\n".join(["t_s,angle_deg", *rows]), encoding="utf-8")
    values = bench_values(str(file), scene)
    # One film with 0.5° of noise; two errors are told to either side, and three of them are allowed.
    for known, true in ((values.rolling_drag_per_s, drag), (values.rolling_friction_mm, 1e3 * lever)):
        assert known.value == pytest.approx(true, abs=1.5 * (known.high - known.value) + 0.02 * true)
    assert "low slip" in bench_text(values)


def test_wrong_films_are_refused(tmp_path: Path) -> None:
    file = tmp_path / "decay.csv"
    long = "t_s,angle_deg\n" + "".join(f"{k}e300,{k}\n" for k in range(25))
    for text, words in (
        ("t_s,x\n0,1\n1,2\n2,3\n", "missing"), ("t_s,angle_deg\n0,1\n1,2\n", "few rows"), (long, "too long a film"),
    ):  # fmt: skip
        file.write_text(text, encoding="utf-8")
        with pytest.raises(InputError, match=words):
            read_decay(str(file))
    with pytest.raises(InputError, match="cannot be read"):
        read_decay(str(tmp_path / "none.csv"))
