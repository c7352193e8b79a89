"""Modes: the discrete ways in which effects act (sticking or rolling, touching or apart), switched at events."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effect import SwitchPoint
from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.equations.right_hand_side import accelerations, with_states
from abu_calc.dynamics.rotor import Acting, Modes
from abu_calc.foundation.errors import NotTrustworthyError

MOST_ROUNDS = 100
"""Effects may have to agree on their modes in turns; a scene that takes more has no answer."""


def starting(equations: Equations) -> tuple[NDArray[np.float64], Modes]:
    """State and modes at t = 0."""
    state = np.array(equations.initial, dtype=float)
    return settled(equations, 0.0, state, at_break(equations, 0.0, equations.first_modes))


def at_break(equations: Equations, t: float, modes: Modes) -> Modes:
    """The modes from a break on."""
    pairs = zip(equations.scene.effects, modes, strict=True)
    return tuple(effect.mode_at(equations.scene, t, mode) for effect, mode in pairs)


def settled(equations: Equations, t: float, y: NDArray[np.float64], modes: Modes) -> tuple[NDArray[np.float64], Modes]:
    """State and modes with which the motion can go on: each effect decides in turn, until all agree.

    Raises NotTrustworthyError when they never do.
    """
    deciding = [index for index, effect in enumerate(equations.scene.effects) if effect.switching(equations.scene)]
    agreed = 0
    for turn in range(MOST_ROUNDS * len(deciding)):
        index = deciding[turn % len(deciding)]
        state, mode = equations.scene.effects[index].settle(SwitchPoint(equations, t, y, modes, index))
        changed = mode is not modes[index] or state is not y
        # Who has just decided need not be asked again before somebody else has changed something.
        agreed = 1 if changed else agreed + 1
        if changed:
            y, modes = state, (*modes[:index], mode, *modes[index + 1 :])
        if agreed == len(deciding):
            return y, modes
    if not deciding:
        return y, modes
    raise NotTrustworthyError(f"at t = {t:.6g} s sticking, rolling and touching contradict each other")


def watched(t: float, y: Any, acting: Acting, xp: Any = np) -> list[Any]:
    """Watched values of all effects, which stay at or above zero as long as the modes hold."""
    motion, loads, solved = accelerations(xp, t, y, acting)
    return [
        value
        for effect, mode, own in with_states(y, acting)
        for value in effect.watch(motion, mode, own, loads, solved, acting.parameters)
    ]


def watches(equations: Equations) -> bool:
    """True if any effect has modes that the state may end."""
    return any(effect.switching(equations.scene) for effect in equations.scene.effects)
