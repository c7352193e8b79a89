"""Action of a wheel pressed to its workpiece: the change of spindle displacement, and remarks on a run.

Equations and signs are those of a `GrindingContactEffect`.
"""

from typing import Final

import numpy as np

from abu_calc.dynamics.motion import AnyArray
from abu_calc.dynamics.scene_context import Circumstances
from abu_calc.dynamics.supports.receptance import receptance, reference_imbalance
from abu_calc.dynamics.trajectory import Samples

STOPPED: Final = 0.01
"""Share of the scene's speed: a rotor slower than this stands."""

_REMEDY: Final = ": press harder, or run the wheel truer"

PARTING: Final = (
    f"wheel and workpiece lose contact again and again{_REMEDY}. Nothing damps their contact, so the bouncing may "
    "depend on the start case"
)
DRIVEN: Final = (
    "with rotation_sense = 1 the workpiece drives the rotor, as published in Kladiev 1996. A cutting wheel is braked: "
    "set rotation_sense = -1"
)

BRAKES: Final = {
    True: "cutting brakes a driven rotor",
    False: "no wheel radius: cutting does not brake the rotor",
}
"""Texts by whether the radius of the wheel is known."""


def moved(scene: Circumstances, plane_offset: float, drag: float, surface: complex, give: float, press: float) -> float:
    """Change of the axis's motion [m] by the contact, without balls, as if contact were never lost.

    N~ = −(y + E)/(give + h_wn), y of the wheel without contact, E = `surface`, h_wn its motion by the
    contact, `drag` T per N. Added is the remaining swing near the end about the place to which T moves it.
    """
    h = receptance(scene.support, scene.speed)
    wheel = np.vstack([np.eye(2), plane_offset * np.eye(2)])[: len(h)]
    pull = reference_imbalance(scene) * scene.speed**2 * np.exp(1j * scene.imbalance_angle)
    free = (wheel[:, 1] @ h)[:2] @ (pull * np.array((1, -1j)))
    pressed = wheel @ np.array((drag, 1.0))
    X, Y = -(free + surface) / (give + wheel[:, 1] @ h @ pressed) * (h[:2] @ pressed)
    swings = scene.small_motion.swinging(wheel @ (drag * press, 0.0), 0.95 * scene.duration)
    return float(abs(X + 1j * Y) + abs(X - 1j * Y)) / 2 + swings


def pulls(t: AnyArray, normal: AnyArray) -> tuple[str, ...]:
    """Remark on the share of time in which a rigid contact would have to pull, and on the least force.

    The samples may be unevenly spaced.
    """
    if not len(t) or normal.min() >= 0:
        return ()
    spans = np.diff(t, prepend=t[0], append=t[-1])
    share = float(((spans[:-1] + spans[1:]) * (normal < 0)).sum() / spans.sum() / 2) if len(t) > 1 else 1.0
    return (
        f"wheel and work would part if they could: the rigid contact pulls for {100 * share:.2g} % of the time, its "
        f"least force {normal.min():.3g} N{_REMEDY}, or give it a stiffness",
    )


def stopped(scene: Circumstances, samples: Samples, most: float) -> tuple[str, ...]:
    """Remark that cutting has stopped the rotor before anything switched its motor off.

    Cutting takes up to `most` [N m].
    """
    if scene.run_down:
        return ()
    _, speeds = scene.rotor.turning(samples.t, samples.y, scene.speed)
    moves = np.flatnonzero(np.abs(speeds) > STOPPED * scene.speed)
    if not len(samples.t) or (len(moves) and moves[-1] == len(speeds) - 1):
        return ()
    since = samples.t[moves[-1] + 1] if len(moves) else samples.t[0]
    return (
        f"the rotor stands on the work from t = {since:.4g} s on: cutting takes up to {most:.3g} N·m; press less, or "
        "take a stronger motor",
    )
