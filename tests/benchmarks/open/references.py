"""Cases and their reference motions, made anew: python -m tests.benchmarks.open.references.

Two integrators with equations of their own must agree to ten digits: SciPy's and the loop of abu-calc for smooth
cases; Taylor series in decimal arithmetic and SciPy's steps, each with its own location of events, for those that
switch. Names of cases after the command make only these.
"""

import json
import math
import sys
from collections.abc import Sequence
from typing import Any

from tests.benchmarks.open import abu_entry, scipy_entry, scipy_switching, taylor
from tests.benchmarks.open.files import case_path, reference_path, switches
from tests.benchmarks.open.measure import errors, event_errors

TIGHT = 1e-13
AGREED = 1e-10
"""Largest difference of the two, in the error measure."""

MOMENTS = 21
DIGITS = 12


def cases() -> dict[str, dict[str, Any]]:
    """Cases by name."""
    small: dict[str, Any] = {"mass": 1.0, "radius": 1.0}
    touching = 2 * math.asin(0.008 / 0.023)
    grinder: dict[str, Any] = {"mass": 6.333, "radius": 0.023, "k": (1579.1, 1579.1), "c": (100.5, 100.5),
               "speed": 607.37, "imbalance": 256e-6, "factor": 1.4}  # fmt: skip
    return {
        "transient": _case(**small, k=(1, 1), c=(0.02, 0.02), speed=2.0, imbalance=0.01, m=(0.05,) * 2, drag=0.01,
                           start=(math.pi / 2, -math.pi / 2), end=700.0),
        "stuck": _case(**small, k=(1, 1), c=(0.1, 0.1), speed=2.0, imbalance=0.0025, m=(0.01,) * 2, drag=0.05,
                       start=(0.1, 0.4), rates=(-2.0, -2.0), end=120.0),
        "one-stuck": _case(**small, k=(1, 1), c=(0.1, 0.1), speed=2.0, imbalance=0.0025, m=(0.01,) * 2, drag=0.05,
                           start=(0.1, 2.4), rates=(-1.07, 0.0), end=120.0),
        "hand-grinder": _case(**grinder, m=(0.016728,) * 4, drag=15.0,
                              start=tuple(0.349 + touching * (k - 1.5) for k in range(4)), end=1.0),
        "two-frequencies": _case(mass=5.0, radius=0.024, k=(5 * 300**2, 5 * 700**2), c=(150, 350), speed=460.0,
                                 imbalance=1e-4, m=(0.004, 0.005, 0.006), drag=30.0, factor=1.4,
                                 start=(0.2, 1.3, -2.0), end=0.5),
        "impacts": _case(**grinder, m=(0.016728,) * 4, drag=5.0, start=(0.3, 1.3, 2.5, 3.6),
                         rates=(0.0, 0.0, -300.0, 100.0), end=0.4) | {"ball_radius_m": 0.008, "restitution": 0.9},
        "stick-slip": _case(**grinder, m=(0.016728,) * 3, drag=15.0, start=(-2.6, 1.0, 2.0), end=0.4)
                      | {"ball_radius_m": 0.008, "rolling_friction": 1e-3, "gravity_m_per_s2": 9.80665},
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


def smooth(case: dict[str, Any]) -> tuple[list[list[float]], dict[str, Any]]:
    """States, and how far the two integrators agree."""
    by_scipy, states = scipy_entry.solved(case, TIGHT), abu_entry.solved(case, TIGHT)
    return states, _agreement(case, ("SciPy DOP853", "abu-calc, order 8"), by_scipy, states)


def switched(case: dict[str, Any]) -> tuple[list[list[float]], dict[str, Any]]:
    """States of a case that switches, how far the two integrators agree, and all events."""
    states, events = taylor.solved(case)
    by_scipy, seen = scipy_switching.solved(case, TIGHT)
    missed, apart = event_errors(seen, events, case["speed_rad_per_s"])
    if missed:
        raise SystemExit(f"{case['name']}: {len(events)} and {len(seen)} events, {missed} differ")
    programs = "Taylor series of order 28, 34 digits", "SciPy DOP853, steps that end on events"
    listed = [[float(f"{event.time:.{DIGITS}g}"), event.kind, event.ball] for event in events]
    return states, _agreement(case, programs, by_scipy, states) | {
        "differ_events_revolutions": float(f"{apart:.1e}"), "events": listed,
    }  # fmt: skip


def _agreement(
    case: dict[str, Any], programs: Sequence[str], some: list[list[float]], others: list[list[float]]
) -> dict[str, Any]:
    axis, balls = errors(some, others, len(case["ball_masses_kg"]))
    print(f"{case['name']}: two integrators differ by {axis:.1e} (axis), {balls:.1e} rad (balls)")
    if max(axis, balls) > AGREED:
        raise SystemExit(f"{case['name']}: no ten digits")
    return {"integrators": programs, "differ_axis": float(f"{axis:.1e}"), "differ_balls_rad": float(f"{balls:.1e}")}


def main(wanted: Sequence[str]) -> None:
    """Write the files of some cases, of all if none is named."""
    for name, numbers in cases().items():
        if wanted and name not in wanted:
            continue
        case = {"name": name, **numbers}
        states, agreement = switched(case) if switches(case) else smooth(case)
        rounded = [[float(f"{value:.{DIGITS}g}") for value in row] for row in states]
        case_path(name).write_text(json.dumps(case, indent=1) + "\n", encoding="utf-8")
        reference_path(name).write_text(json.dumps({**agreement, "states": rounded}) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
