"""A case by SciPy alone, from the equations of the page: python -m tests.benchmarks.open.scipy_entry CASE.json [RTOL].

It shares no code with abu-calc, and serves as an example of an entry. Cases that switch go to `scipy_switching`.
"""

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from tests.benchmarks.open import scipy_switching
from tests.benchmarks.open.files import switches


def solved(case: dict[str, Any], rtol: float, method: str = "DOP853") -> list[list[float]]:
    """States [x, y, θ₁ …, x', y', θ₁' …] at the case's times."""
    m, radius, inertia, drag = (
        np.array(case[key])
        for key in ("ball_masses_kg", "pitch_radii_m", "ball_inertia_factors", "viscous_drag_rates_per_s")
    )
    n, speed, total = len(m), case["speed_rad_per_s"], case["mass_kg"] + m.sum()
    stiffness, damping = np.array(case["stiffness_N_per_m"]), np.array(case["damping_N_s_per_m"])
    imbalance, phase = case["imbalance_kg_m"], case["imbalance_angle_rad"]

    def rhs(t: float, state: Any) -> Any:
        place, theta, velocity, rate = state[:2], state[2 : 2 + n], state[2 + n : 4 + n], state[4 + n :]
        gamma = speed * t + theta
        sin, cos = np.sin(gamma), np.cos(gamma)
        # θ'' = (x'' sin γ − y'' cos γ)/(J R) − h₀ θ'/J, put into the two equations of the axis.
        free = -drag * rate / inertia
        matrix = total * np.eye(2)
        for axis, away in enumerate((sin, -cos)):
            for other, along in enumerate((sin, -cos)):
                matrix[axis, other] -= (m / inertia * away * along).sum()
        swing = m * radius * (speed + rate) ** 2
        force = imbalance * speed**2 * np.array((np.cos(speed * t + phase), np.sin(speed * t + phase)))
        force += np.array(
            ((swing * cos + m * radius * free * sin).sum(), (swing * sin - m * radius * free * cos).sum())
        )
        acceleration = np.linalg.solve(matrix, force - damping * velocity - stiffness * place)
        turning = (acceleration[0] * sin - acceleration[1] * cos) / (inertia * radius) + free
        return np.concatenate([velocity, rate, acceleration, turning])

    start = [
        *case["start_place_m"],
        *case["start_angles_rad"],
        *case["start_velocity_m_per_s"],
        *case["start_rates_rad_per_s"],
    ]
    scale = np.concatenate([np.full(2, case["length_scale_m"]), np.ones(n)] * 2)
    scale[2 + n :] *= speed
    run = solve_ivp(rhs, (0.0, case["times_s"][-1]), start, method, case["times_s"], rtol=rtol, atol=rtol * scale)
    if not run.success:
        raise SystemExit(run.message)
    states: list[list[float]] = run.y.T.tolist()
    return states


if __name__ == "__main__":
    document = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    wanted = float(sys.argv[2]) if len(sys.argv) > 2 else 1e-8
    if switches(document):
        states, events = scipy_switching.solved(document, wanted)
        print(json.dumps({"states": states, "events": events}))
    else:
        print(json.dumps({"states": solved(document, wanted)}))
