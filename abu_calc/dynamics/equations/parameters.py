"""The numbers of a scene, combined once so that an evaluation of the equations needs few operations. SI."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.frame import add_rotor, arm_frame, ball_mass, linear_frame, spin_inertia, tilt_map
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.kinds import SwingArm

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
    frame = arm_frame(arm) if arm else linear_frame(scene.support)  # type: ignore[arg-type]
    frame["ball_mass"] = ball_mass(len(frame["frame_mass"]), masses, places)
    rotor, axes = rotor_of(scene), 0 if arm else len(frame["frame_mass"])
    if rotor == "driven":
        add_rotor(frame, scene)
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
        spin_inertia=spin_inertia(frame, arm, rotor == "driven", float((masses * spins * each("ball_radius")).sum())),
        places=places,
        imbalance=scene.imbalance,
        imbalance_angle=scene.imbalance_angle,
        turning_moments=np.repeat((scene.imbalance, scene.couple), 2)[:axes],
        turning_places=np.array((scene.imbalance_angle,) * 2 + (scene.couple_angle,) * 2)[:axes] - QUARTERS[:axes],
        arm_length=arm.length if arm else None,
        race_map=None if arm else np.array(scene.support.race_map),  # type: ignore[union-attr]
        tilt_map=tilt_map(scene.support),
        effects=scene.effects,
        modes=tuple(effect.first_mode(scene) for effect in scene.effects),
        **frame,
    )
