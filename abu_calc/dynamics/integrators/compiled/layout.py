"""Data of a scene for the compiled loop: their places, and the constants needed beside the equations."""

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effect import ACROSS_RATE, Effect, Rule
from abu_calc.dynamics.effects.ball_contact import LIFT, MARGIN
from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.compiled import arrays
from abu_calc.dynamics.integrators.compiled.kernels import METHODS, Method
from abu_calc.dynamics.integrators.compiled.program import Program, places
from abu_calc.dynamics.integrators.run import STALLED
from abu_calc.dynamics.parameters import Modes
from abu_calc.dynamics.switching.sticking import AT_REST

Array = NDArray[np.float64]

LOOSE = 1e-3
"""Tolerance below which the longest step shrinks as the method's own steps do, as with SciPy."""

LIFT_SHARE, LIFT_MOST = 50.0, 1e-4
"""Share of the tolerance, and most [rad], by which balls must part for a rebound to be one."""

SHARES: dict[Method, float] = {"rk45": 0.1, "dop853": 0.3}
"""Share of the tolerance to which a step is held, for each method.

Events are located on the dense output, whose error is not that of the steps' ends. With these shares
the motion is about as far off by both methods.
"""


def rules(equations: Equations, modes: Modes) -> list[Rule | None]:
    """Rule by which compiled code finds each effect's next mode; none if balls move across their race."""
    across = ACROSS_RATE in equations.scene.ball_states
    mode_rules = [effect.rule(mode) for effect, mode in zip(equations.scene.effects, modes, strict=True)]
    return [None if across and rule and rule.name != "one-sided contact" else rule for rule in mode_rules]


def decides(effects: tuple[Effect, ...], modes: Modes, mode_rules: list[Rule | None]) -> bool:
    """True if compiled code may decide the very first modes: no effect has modes unknown to it."""
    rows = zip(effects, modes, mode_rules, strict=True)
    return all(rule is not None or mode is None or not effect.switches for effect, mode, rule in rows)


def layout(
    equations: Equations, modes: Modes, program: Program, mode_places: list[dict[str, int]]
) -> NDArray[np.int64]:
    """Places of all data, in the order that `arrays` names."""
    p, watched, criteria = equations.parameters, 0, sum(program.watched)
    flags = arrays.BEHIND + 2 * p.balls + 2
    positions = np.full(flags + criteria, -1, dtype=np.int64)
    positions[arrays.APPARENT] = flags
    for criterion, states in program.apparent.items():
        positions[flags + criterion] = len(positions)
        positions = np.append(positions, (len(states), *states))
    positions[arrays.SEEN], positions[arrays.ORDER] = len(program.apparent), len(positions)
    others = (index for index in range(criteria) if index not in program.apparent)
    positions = np.append(positions, np.array((*program.apparent, *others), dtype=np.int64))
    first = min(min(row.values(), default=program.numbers) for row in mode_places)
    positions[: arrays.NUMBERS + 1] = (
        len(equations.states), p.balls, 2 * p.size + p.balls, criteria, program.values, first, mode_places[-1][""],
        program.numbers,
    )  # fmt: skip
    for k, (rule, mode, row) in enumerate(zip(rules(equations, modes), modes, mode_places, strict=False)):
        if rule and rule.name == "dry friction":
            positions[arrays.FRICTION : arrays.SIDE + 1] = watched, criteria, row["direction"], row["side"]
        if rule and rule.name == "ball contact":
            numbers = (row[name] for name in ("turns", "touching", "least", "joined"))
            positions[arrays.GAPS : arrays.JOINED + 1] = watched, len(mode.joined), *numbers
            positions[arrays.BEHIND : arrays.BEHIND + 2 * len(mode.joined)] = (*mode.behind, *mode.ahead)
        if rule and rule.name == "one-sided contact":
            positions[arrays.ONE_SIDED], positions[arrays.TOUCHES] = watched, row[""]
        watched, criteria = watched + program.watched[k], criteria + program.criteria[k]
    return positions


def constants(equations: Equations, modes: Modes, tolerance: float, method: Method) -> Array:
    """Constants of a scene that the loop needs beside its equations, in the order that `arrays` names."""
    p = equations.parameters
    order = METHODS[method].METHOD_ORDER
    longest = equations.longest_step * min(1.0, (tolerance / LOOSE) ** (1 / order))
    slow = equations.scales[2 * p.size + p.balls] if p.balls else 1.0
    inertias = p.static_moments * p.radii
    restitution = next((rule.restitution for rule in rules(equations, modes) if rule and rule.restitution), 0.0)
    held, rounding = SHARES[method] * tolerance, 100 * np.finfo(float).eps
    torque = (inertias.max() * p.speed**2, MARGIN * inertias.mean() * p.speed**2) if p.balls else (1.0, 1.0)
    return np.concatenate([
        (longest, 0.0, AT_REST * slow, slow, restitution, torque[0], STALLED * equations.scene.revolution, torque[1],
         lifted(tolerance)),
        held * np.array(equations.scales),
        np.where(equations.relative, max(held, rounding), rounding), inertias,
    ])  # fmt: skip


def lifted(tolerance: float) -> float:
    """Least way [rad] by which balls must part for a rebound to be one, with steps of this tolerance.

    Elastic balls that are pressed together bounce ever faster, as 1/√(this): at the usual tolerance of 2e-5 it is 1e-4
    rad, a hundredth of what the angles are asked for; at a fine one it is that of the reference.

    >>> [f"{lifted(tolerance):.0e}" for tolerance in (1e-3, 2e-6, 1e-7, 1e-9)]
    ['1e-04', '1e-04', '5e-06', '1e-06']
    """
    return min(max(LIFT, LIFT_SHARE * tolerance), LIFT_MOST)


def numbers_places(modes: Modes, count: int) -> list[dict[str, int]]:
    """Places of each mode's numbers among this many numbers, counted from the first."""
    return [{name: count + at for name, at in row.items()} for row in places(modes)]
