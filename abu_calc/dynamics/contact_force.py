"""The force between wheel and work along a run, and whether they part."""

import numpy as np

from abu_calc.dynamics.assemble import Equations
from abu_calc.dynamics.effects.grinding_contact import TOUCHING, GrindingContact
from abu_calc.dynamics.equations import accelerations
from abu_calc.dynamics.parameters import Array
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.errors import InputError


def normal_forces(equations: Equations, trajectory: Trajectory) -> Array:
    """N [N] at the samples of a run with a grinding contact; raises InputError for a scene without.

    Rigid: of the no-separation solution, so it may be negative. Balls that stick by dry friction count as rolling.
    """
    contact = equations.scene.effect("grinding_contact")
    if not isinstance(contact, GrindingContact):
        raise InputError("the scene has no grinding contact")
    p = equations.parameters
    found = []
    for t, y in zip(trajectory.t, trajectory.y.T, strict=True):
        motion, _, solved = accelerations(np, t, y, p)
        normal = solved.reaction if contact.contact == "rigid" else contact.pressed(motion, TOUCHING, p)
        found.append(normal if contact.contact == "rigid" else max(normal, 0.0))
    return np.array(found, dtype=float)


def separates(equations: Equations, trajectory: Trajectory) -> bool:
    """Whether wheel and work part, or would part if they could, at any sample of a run."""
    return bool(normal_forces(equations, trajectory).min() <= 0)
