"""The numbers of a scene, combined once so that an evaluation of the equations needs few operations. SI."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import LinearSupport, Scene, Support, SwingArm
from abu_calc.errors import InputError

Array = NDArray[Any]

Rotor = Literal["steady", "guided", "driven"]
"""Constant speed; angle and speed are states and the acceleration is given; or the torque is given."""


@dataclass(frozen=True)
class Parameters:
    """What `rhs` reads. Per ball n, race by race: arrays of that length. Frame: the d accelerations that balls feel."""

    size: int
    """N, the support's coordinates."""
    balls: int
    rotor: Rotor
    geometry: Callable[[Any, Any], Any]
    """Levers of the frame: `supports.linear.in_plane` or `tilting`, `supports.swing_arm.on_arm`."""
    imbalance_of: Callable[[Any, Any], Any]
    """Force of the imbalance on the frame and what it weighs there."""
    speed: Any
    masses: Array
    radii: Array
    """R_p of each ball."""
    moments: Array
    """m R_p of each ball."""
    drags: Array
    """R_p h₀ of each ball."""
    braking: Array
    """−R_p h₀ of each ball."""
    inertia_factors: Array
    mobilities: Array
    """1/J of each ball."""
    reduced_masses: Array
    """m/J of each ball."""
    spins: Array
    """(J − 1) r of each ball: its own turning when the rotor's speed changes."""
    spin_inertia: Array | None
    """d × d: Σ m (J − 1) r², what that weighs in the turning of rotor and arm."""
    places: Array
    """z of each ball's race."""
    imbalance: Any
    imbalance_angle: Any
    turning_moments: Array
    """What turns with the rotor and pulls at the frame: m₀e twice, for x and y, and χ(J_t − J_p) likewise."""
    turning_places: Array
    """The angles of whose cosines these are the components."""
    arm_length: Any
    """None on supports that are no swing arm."""
    frame_mass: Array
    """d × d: what the frame weighs with the support behind it, (P M⁻¹ Pᵀ)⁻¹; with the row of a driven rotor."""
    ball_mass: Array
    """d × d: what balls at rest in their races add, where that is constant."""
    whole_mass: Array
    """Both together."""
    held: Array
    """d × 2N: the force of springs and dampers on the frame is `held @ (q, q')`."""
    held_spinning: Array | None
    """Likewise the gyroscopic force, per unit speed."""
    rest: Array | None
    """N × 2N, with the next: q'' = rest @ (q, q') + carry @ frame accelerations; None where these are the same."""
    carry: Array | None
    rest_spinning: Array | None
    steady_force: Array | None
    """d: constant forces on the frame."""
    race_map: Array | None
    """2 or 4 × N: what the frame moves per unit of each coordinate; None on a swing arm."""
    tilt_map: Array | None
    """4 × 2N: the tilts and their rates, where balls move axially with them."""
    effects: tuple[Any, ...]
    modes: tuple[Any, ...]
    """How each effect acts at the moment (sticking, touching …); None where there is one way only."""

    def in_mode(self, modes: tuple[Any, ...]) -> "Parameters":
        """The same numbers in other modes; some thousand times in a run, so without `replace`, which is slow."""
        changed = object.__new__(Parameters)
        changed.__dict__.update(self.__dict__, modes=modes)
        return changed


QUARTERS = np.array((0.0, math.pi / 2, 0.0, math.pi / 2))
"""y is what x is a quarter turn later."""


def rotor_of(scene: Scene) -> Rotor:
    """How the rotor turns: a motor has the last word."""
    ways = {effect.rotor for effect in scene.effects}
    return "driven" if "driven" in ways else "guided" if "guided" in ways else "steady"


def parameters_of(
    scene: Scene, geometry: Callable[[Any, Any], Any], imbalance_of: Callable[[Any, Any], Any]
) -> Parameters:
    """The numbers of a scene on a support of that geometry.

    Raises InputError when the support's mass is not symmetric and positive definite.
    """
    arm = scene.support if isinstance(scene.support, SwingArm) else None
    sizes = [len(race.ball_masses) for race in scene.races]

    def each(name: str) -> Array:
        return np.repeat(np.array([getattr(race, name) for race in scene.races], dtype=float), sizes)

    masses, radii, factors = np.array(scene.ball_masses, dtype=float), each("pitch_radius"), each("inertia_factor")
    places, spins = each("plane_offset"), (factors - 1) * each("ball_radius")
    frame = _arm_frame(arm) if arm else _linear_frame(scene.support)  # type: ignore[arg-type]
    frame["ball_mass"] = _ball_mass(len(frame["frame_mass"]), masses, places)
    rotor, axes = rotor_of(scene), 0 if arm else len(frame["frame_mass"])
    if rotor == "driven":
        _add_rotor(frame, scene)
    frame["whole_mass"] = frame["frame_mass"] + frame["ball_mass"]
    return Parameters(
        size=len(scene.support.names),
        balls=len(masses),
        rotor=rotor,
        geometry=geometry,
        imbalance_of=imbalance_of,
        speed=scene.speed,
        masses=masses,
        radii=radii,
        moments=masses * radii,
        drags=radii * each("drag"),
        braking=-radii * each("drag"),
        inertia_factors=factors,
        mobilities=1 / factors,
        reduced_masses=masses / factors,
        spins=spins,
        spin_inertia=_spin_inertia(frame, arm, rotor, float((masses * spins * each("ball_radius")).sum())),
        places=places,
        imbalance=scene.imbalance,
        imbalance_angle=scene.imbalance_angle,
        turning_moments=np.repeat((scene.imbalance, scene.couple), 2)[:axes],
        turning_places=np.array((scene.imbalance_angle,) * 2 + (scene.couple_angle,) * 2)[:axes] - QUARTERS[:axes],
        arm_length=arm.length if arm else None,
        race_map=None if arm else np.array(scene.support.race_map),  # type: ignore[union-attr]
        tilt_map=_tilt_map(scene.support),
        effects=scene.effects,
        modes=tuple(effect.first_mode(scene) for effect in scene.effects),
        **frame,
    )


def _tilt_map(support: Support) -> Array | None:
    if isinstance(support, SwingArm) or not support.axial_inertia:
        return None
    return np.kron(np.eye(2), np.array(support.race_map)[2:])


def _spin_inertia(frame: dict[str, Any], arm: SwingArm | None, rotor: Rotor, inertia: float) -> Array | None:
    """Which of the frame's accelerations turn the balls: that of the arm and that of a driven rotor."""
    turning = np.zeros(len(frame["frame_mass"]))
    if arm:
        turning[0] = 1.0
    if rotor == "driven":
        turning[-1] = 1.0
    return inertia * np.outer(turning, turning) if turning.any() else None


def _arm_frame(arm: SwingArm) -> dict[str, Any]:
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


def _linear_frame(support: LinearSupport) -> dict[str, Any]:
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


def _ball_mass(rows: int, masses: Array, places: Array) -> Array:
    """Σ m [[I, z I], [z I, z² I]]: balls held in their races, as the frame feels them."""
    m, mz, mzz = masses.sum(), (masses * places).sum(), (masses * places**2).sum()
    return np.kron(np.array([[m, mz], [mz, mzz]]), np.eye(2))[:rows, :rows]


def _add_rotor(frame: dict[str, Any], scene: Scene) -> None:
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
