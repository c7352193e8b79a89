"""The frame: the few accelerations of a support that balls feel, and what force and mass stand behind them.

Each `frame` is a part of `Parameters`, by the names of its fields.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.kinds import LinearSupport, Support, SwingArm
from abu_calc.errors import InputError

Array = NDArray[Any]


def tilt_map(support: Support) -> Array | None:
    """4 × 2N: the tilts and their rates, where balls move axially with them."""
    if isinstance(support, SwingArm) or not support.axial_inertia:
        return None
    return np.kron(np.eye(2), np.array(support.race_map)[2:])


def spin_inertia(frame: dict[str, Any], arm: SwingArm | None, driven: bool, inertia: float) -> Array | None:
    """Which of the frame's accelerations turn the balls: that of the arm and that of a driven rotor."""
    turning = np.zeros(len(frame["frame_mass"]))
    if arm:
        turning[0] = 1.0
    if driven:
        turning[-1] = 1.0
    return inertia * np.outer(turning, turning) if turning.any() else None


def arm_frame(arm: SwingArm) -> dict[str, Any]:
    """J_O, −(c, b) l² and the constant moment: the arm's own turning is the frame."""
    square = arm.length**2
    return {
        "frame_mass": np.array([[arm.inertia]]),
        "held": np.array([[-arm.stiffness * square, -arm.damping * square]]),
        "held_spinning": None,
        "rest": None,
        "carry": None,
        "rest_spinning": None,
        "steady_force": np.array([arm.moment]) if arm.moment else None,
    }


def linear_frame(support: LinearSupport) -> dict[str, Any]:
    """(P M⁻¹ Pᵀ)⁻¹ and the forces of springs and dampers as the frame feels them; what the support does behind it.

    Raises InputError when the support's mass is not symmetric and positive definite.
    """
    M, P = np.array(support.mass), np.array(support.race_map)
    if not (np.allclose(M, M.T, rtol=1e-9, atol=0) and np.all(np.linalg.eigvalsh(M) > 0)):
        raise InputError("the support's mass matrix must be symmetric and positive definite", found=str(support.mass))
    forces = -np.hstack([support.stiffness, support.damping])
    spinning = np.hstack([np.zeros_like(M), -np.array(support.gyroscopic)]) if support.gyroscopic else None
    if np.array_equal(P, np.eye(*P.shape)) and len(P) == len(M):
        return {
            "frame_mass": M, "held": forces, "held_spinning": spinning, "rest": None, "carry": None,
            "rest_spinning": None, "steady_force": None,
        }  # fmt: skip
    push = np.linalg.solve(M, P.T)
    frame_mass = np.linalg.inv(P @ push)
    carry = push @ frame_mass

    def behind(pull: Array) -> tuple[Array, Array]:
        """Force on the frame, and what accelerates the support beside the frame."""
        free = np.linalg.solve(M, pull)
        return carry.T @ pull, free - carry @ (P @ free)

    held, rest = behind(forces)
    held_spinning, rest_spinning = behind(spinning) if spinning is not None else (None, None)
    return {
        "frame_mass": frame_mass, "held": held, "held_spinning": held_spinning, "rest": rest, "carry": carry,
        "rest_spinning": rest_spinning, "steady_force": None,
    }  # fmt: skip


def ball_mass(rows: int, masses: Array, places: Array) -> Array:
    """Σ m [[I, z I], [z I, z² I]]: balls held in their races, as the frame feels them."""
    m, mz, mzz = masses.sum(), (masses * places).sum(), (masses * places**2).sum()
    return np.kron(np.array([[m, mz], [mz, mzz]]), np.eye(2))[:rows, :rows]


def add_rotor(frame: dict[str, Any], scene: Scene) -> None:
    """One more row: the rotor's own turning, which on an arm is counted from the arm."""
    inertia = sum(effect.rotor_inertia for effect in scene.effects)
    mass = frame["frame_mass"]
    shared = inertia if isinstance(scene.support, SwingArm) else 0.0
    border = np.full((len(mass), 1), shared)
    frame["frame_mass"] = np.block([[mass, border], [border.T, np.array([[inertia]])]])
    if np.any(np.linalg.eigvalsh(frame["frame_mass"]) <= 0):
        raise InputError("the rotor has more inertia than the arm that carries it", found=f"{inertia:g} kg m²")
    frame["ball_mass"] = np.pad(frame["ball_mass"], ((0, 1), (0, 1)))
    for name in ("held", "held_spinning"):
        if frame[name] is not None:
            frame[name] = np.vstack([frame[name], np.zeros(frame[name].shape[1])])
    if frame["carry"] is not None:
        frame["carry"] = np.hstack([frame["carry"], np.zeros((len(frame["carry"]), 1))])
    if frame["steady_force"] is not None:
        frame["steady_force"] = np.append(frame["steady_force"], 0.0)
