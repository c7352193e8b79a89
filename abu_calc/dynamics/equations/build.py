"""Conversion of a scene to the numbers that its equations read."""

from dataclasses import replace

import numpy as np

from abu_calc.dynamics.motion import Array
from abu_calc.dynamics.parameters import Frame, Parameters
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import InputError


def parameters_of(scene: Scene) -> Parameters:
    """The numbers of a scene. Raises InputError when the support's mass is not symmetric and positive definite."""
    balls, rotor = scene.balls, scene.rotor
    spins = (balls.factors - 1) * balls.sizes
    frame = scene.support.frame(balls)
    if rotor.rows:
        frame = _with_rotor(frame, sum(effect.rotor_inertia for effect in scene.effects))
    return Parameters(
        size=len(scene.support.names),
        balls=len(balls.masses),
        rotor=rotor,
        geometry=scene.support.geometry(scene.unbalance),
        frame=frame,
        speed=scene.speed,
        masses=balls.masses,
        radii=balls.radii,
        static_moments=balls.static_moments,
        drags=balls.radii * balls.drags,
        braking=-balls.radii * balls.drags,
        inertia_factors=balls.factors,
        mobilities=1 / balls.factors,
        reduced_masses=balls.masses / balls.factors,
        spins=spins,
        spin_inertia=_spin_inertia(frame, float((balls.masses * spins * balls.sizes).sum())),
        places=balls.places,
        imbalance=scene.imbalance,
        imbalance_angle=scene.imbalance_angle,
        effects=scene.effects,
    )


def _spin_inertia(frame: Frame, inertia: float) -> Array | None:
    """Inertia of balls that their races turn, in the accelerations that turn the races."""
    turning = np.zeros(len(frame.mass))
    turning[list(frame.turning)] = 1.0
    return inertia * np.outer(turning, turning) if frame.turning else None


def _with_rotor(frame: Frame, inertia: float) -> Frame:
    """One more row: the rotor's own turning, which is counted from what carries it."""
    border = np.zeros((len(frame.mass), 1))
    border[list(frame.turning)] = inertia
    mass = np.block([[frame.mass, border], [border.T, np.array([[inertia]])]])
    if np.any(np.linalg.eigvalsh(mass) <= 0):
        raise InputError("the rotor has more inertia than the arm that carries it", found=f"{inertia:g} kg m²")

    def longer(rows: Array | None) -> Array | None:
        return None if rows is None else np.concatenate([rows, np.zeros((1, *rows.shape[1:]))])

    return replace(
        frame,
        mass=mass,
        held=np.vstack([frame.held, np.zeros(frame.held.shape[1])]),
        turning=(*frame.turning, -1),
        whole=None,
        held_spinning=longer(frame.held_spinning),
        carry=None if frame.carry is None else np.hstack([frame.carry, np.zeros((len(frame.carry), 1))]),
        steady_force=longer(frame.steady_force),
    )
