"""Cases and their reference motions, made anew: python -m tests.benchmarks.open.references.

Two integrators with equations of their own, SciPy's and the loop of abu-calc, must agree to ten digits.
"""

import json
import math
from typing import Any

from tests.benchmarks.open import abu_entry, scipy_entry
from tests.benchmarks.open.files import case_path, reference_path
from tests.benchmarks.open.measure import errors

TIGHT = 1e-13
AGREED = 1e-10
"""Largest difference of the two, in the error measure."""

MOMENTS = 21
DIGITS = 12


def cases() -> dict[str, dict[str, Any]]:
    """Cases by name."""
    small = {"mass": 1.0, "radius": 1.0}
    touching = 2 * math.asin(0.008 / 0.023)
    return {
        "transient": _case(**small, k=(1, 1), c=(0.02, 0.02), speed=2.0, imbalance=0.01, m=(0.05,) * 2, drag=0.01,
                           start=(math.pi / 2, -math.pi / 2), end=700.0),
        "stuck": _case(**small, k=(1, 1), c=(0.1, 0.1), speed=2.0, imbalance=0.0025, m=(0.01,) * 2, drag=0.05,
                       start=(0.1, 0.4), rates=(-2.0, -2.0), end=120.0),
        "one-stuck": _case(**small, k=(1, 1), c=(0.1, 0.1), speed=2.0, imbalance=0.0025, m=(0.01,) * 2, drag=0.05,
                           start=(0.1, 2.4), rates=(-1.07, 0.0), end=120.0),
        "hand-grinder": _case(mass=6.333, radius=0.023, k=(1579.1, 1579.1), c=(100.5, 100.5), speed=607.37,
                              imbalance=256e-6, m=(0.016728,) * 4, drag=15.0, factor=1.4,
                              start=tuple(0.349 + touching * (k - 1.5) for k in range(4)), end=1.0),
        "two-frequencies": _case(mass=5.0, radius=0.024, k=(5 * 300**2, 5 * 700**2), c=(150, 350), speed=460.0,
                                 imbalance=1e-4, m=(0.004, 0.005, 0.006), drag=30.0, factor=1.4,
                                 start=(0.2, 1.3, -2.0), end=0.5),
    }  # fmt: skip


def _case(
    *, mass: float, radius: float, k: tuple[float, float], c: tuple[float, float], speed: float, imbalance: float,
    m: tuple[float, ...], drag: float, start: tuple[float, ...], end: float, rates: tuple[float, ...] = (),
    factor: float = 1.0,
) -> dict[str, Any]:  # fmt: skip
    count = len(m)
    return {
        "mass_kg": mass, "stiffness_N_per_m": k, "damping_N_s_per_m": c, "speed_rad_per_s": speed,
        "imbalance_kg_m": imbalance, "imbalance_angle_rad": 0.0, "ball_masses_kg": m,
        "pitch_radii_m": (radius,) * count, "viscous_drag_rates_per_s": (drag,) * count,
        "ball_inertia_factors": (factor,) * count, "start_place_m": (0.0, 0.0), "start_velocity_m_per_s": (0.0, 0.0),
        "start_angles_rad": start, "start_rates_rad_per_s": rates or (0.0,) * count,
        "length_scale_m": imbalance / mass, "times_s": [end * step / (MOMENTS - 1) for step in range(MOMENTS)],
    }  # fmt: skip


def main() -> None:
    """Write all files."""
    for name, numbers in cases().items():
        case = {"name": name, **numbers}
        one, other = scipy_entry.solved(case, TIGHT), abu_entry.solved(case, TIGHT)
        axis, balls = errors(one, other, len(case["ball_masses_kg"]))
        print(f"{name}: two integrators differ by {axis:.1e} (axis), {balls:.1e} rad (balls)")
        if max(axis, balls) > AGREED:
            raise SystemExit(f"{name}: no ten digits")
        states = [[float(f"{value:.{DIGITS}g}") for value in row] for row in other]
        document = {"integrators": ["SciPy DOP853", "abu-calc, order 8"], "differ_axis": float(f"{axis:.1e}"),
                    "differ_balls_rad": float(f"{balls:.1e}"), "states": states}  # fmt: skip
        case_path(name).write_text(json.dumps(case, indent=1) + "\n", encoding="utf-8")
        reference_path(name).write_text(json.dumps(document) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
