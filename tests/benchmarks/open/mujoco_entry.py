"""A case by MuJoCo: python -m tests.benchmarks.open.mujoco_entry CASE.json [STEPS], steps a revolution, 400 without it.

A body on two slides carries the rotor on a hinge, whose inertia is so large that nothing brakes it, and the rotor a
hinge for each ball. Imbalance and weight of the balls are added as forces. Steps are those of Runge and Kutta, order 4.
Dry friction is that of MuJoCo's joints, by the normal force of the step before. Balls that meet are spheres on springs
and dampers that give the restitution, sixteen steps long: MuJoCo knows no rigid impact. Needs `pip install mujoco`; the
project does not depend on it.
"""

import json
import math
import sys
from pathlib import Path
from typing import Any, Final

import numpy as np

STEPS: Final = 400
IMPACT: Final = 16
"""Steps that an impact takes."""

HEAVY: Final = 1e9
"""Moment of inertia [kg m²] of the rotor."""

POINT: Final = 1e-14
"""Moment of inertia [kg m²] of a ball about itself; MuJoCo allows no point."""


def model_of(case: dict[str, Any], step: float) -> str:
    """The machine in MuJoCo's XML."""
    keys = ("ball_masses_kg", "pitch_radii_m", "ball_inertia_factors", "viscous_drag_rates_per_s")
    rows, rubs = zip(*(case[key] for key in keys), strict=True), float("rolling_friction" in case)
    bodies = "".join(
        f'<body><joint type="hinge" axis="0 0 1" armature="{(factor - 1) * mass * radius**2!r}" '
        f'damping="{mass * radius**2 * drag!r}" frictionloss="{rubs}" solreffriction="{2 * step!r} 1" '
        f'solimpfriction="0.9999 0.9999 0.001"/><inertial pos="{radius!r} 0 0" mass="{mass!r}" '
        f'diaginertia="{POINT} {POINT} {POINT}"/>{_sphere(case, radius)}</body>'
        for mass, radius, factor, drag in rows
    )
    slides = "".join(
        f'<joint type="slide" axis="{axis}" stiffness="{stiffness!r}" damping="{damping!r}"/>'
        for axis, stiffness, damping in zip(
            ("1 0 0", "0 1 0"), case["stiffness_N_per_m"], case["damping_N_s_per_m"], strict=True
        )
    )
    return (
        f'<mujoco><compiler boundinertia="0" balanceinertia="false"/>'
        f'<option timestep="{step!r}" integrator="RK4" gravity="0 0 0" solver="Newton" tolerance="0" '
        f'iterations="50"/><default><geom condim="1" solref="{_reference(case, step)}" solimp="0.9999 0.9999 0.001"/>'
        f'</default><worldbody><body>{slides}<inertial pos="0 0 0" mass="{case["mass_kg"]!r}" '
        f'diaginertia="1 1 1"/><body><joint type="hinge" axis="0 0 1" armature="{HEAVY}"/>'
        f'<inertial pos="0 0 0" mass="{POINT}" diaginertia="1 1 1"/>{bodies}</body></body></worldbody></mujoco>'
    )


def _sphere(case: dict[str, Any], radius: float) -> str:
    if "restitution" not in case:
        return ""
    return f'<geom type="sphere" size="{case["ball_radius_m"]!r}" pos="{radius!r} 0 0" mass="0"/>'


def _reference(case: dict[str, Any], step: float) -> str:
    """Spring and damper of an impact: half a swing of a damped oscillator leaves −e times the speed."""
    fall = -math.log(case.get("restitution", 1.0))
    ratio = fall / math.hypot(math.pi, fall)
    own = math.pi / (IMPACT * step * math.sqrt(1 - ratio**2))
    return f"{-(own**2)!r} {-2 * ratio * own!r}"


def solved(case: dict[str, Any], steps: int = STEPS) -> list[list[float]]:
    """States [x, y, θ₁ …, x', y', θ₁' …] at the case's times."""
    import mujoco

    speed = case["speed_rad_per_s"]
    m, radii = np.array(case["ball_masses_kg"]), np.array(case["pitch_radii_m"])
    gravity, friction = case.get("gravity_m_per_s2", 0.0), case.get("rolling_friction", 0.0)
    model = mujoco.MjModel.from_xml_string(model_of(case, math.tau / abs(speed) / steps))
    data = mujoco.MjData(model)
    data.qpos[:] = [*case["start_place_m"], 0.0, *case["start_angles_rad"]]
    data.qvel[:] = [*case["start_velocity_m_per_s"], speed, *case["start_rates_rad_per_s"]]

    def act(model: Any, data: Any) -> None:
        """Imbalance and weight of the balls."""
        turn = data.qpos[2] + case["imbalance_angle_rad"]
        data.qfrc_passive[:2] += case["imbalance_kg_m"] * speed**2 * np.array((math.cos(turn), math.sin(turn)))
        data.qfrc_passive[3:] -= m * radii * gravity * np.cos(data.qpos[2] + data.qpos[3:])

    def rub() -> None:
        """Most that friction holds of each ball, by the normal force of the last step."""
        gamma = data.qpos[2] + data.qpos[3:]
        sine, cosine = np.sin(gamma), np.cos(gamma)
        flung = radii * (speed + data.qvel[3:]) ** 2 - gravity * sine
        model.dof_frictionloss[3:] = friction * m * radii * (flung - data.qacc[0] * cosine - data.qacc[1] * sine)

    mujoco.set_mjcb_passive(act)
    mujoco.mj_forward(model, data)
    states = [_state(data)]
    for begun, end in zip(case["times_s"], case["times_s"][1:], strict=False):
        count = math.ceil((end - begun) / (math.tau / abs(speed) / steps))
        model.opt.timestep = (end - begun) / count
        for _ in range(count):
            if friction:
                rub()
            mujoco.mj_step(model, data)
        states.append(_state(data))
    mujoco.set_mjcb_passive(None)
    return states


def _state(data: Any) -> list[float]:
    return [*data.qpos[:2], *data.qpos[3:], *data.qvel[:2], *data.qvel[3:]]


if __name__ == "__main__":
    document = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    print(json.dumps({"states": solved(document, int(sys.argv[2]) if len(sys.argv) > 2 else STEPS)}))
