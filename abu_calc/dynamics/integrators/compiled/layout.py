"""Where the compiled loop finds what of a scene, and what it needs of it beside the equations."""

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
"""As with SciPy: below this tolerance the longest step shrinks as the method's own steps do."""

LIFT_SHARE, LIFT_MOST = 50.0, 1e-4
"""Of the tolerance, and at most [rad]: by how much balls must part for a rebound to be one."""

SHARES: dict[Method, float] = {"rk45": 0.1, "dop853": 0.3}
"""Of the tolerance, that a step is held to: events are located on the dense output, whose error is not that of the
steps' ends, so the motion is about as far off by both methods."""


def rules(equations: Equations, modes: Modes) -> list[Rule | None]:
    """By which rule each effect's next mode is found in compiled code; where balls move across their race, by none."""
    across = ACROSS_RATE in equations.scene.ball_states
    found = [effect.rule(mode) for effect, mode in zip(equations.scene.effects, modes, strict=True)]
    return [None if across and rule and rule.name != "one-sided contact" else rule for rule in found]


def decides(effects: tuple[Effect, ...], modes: Modes, found: list[Rule | None]) -> bool:
    """Whether compiled code may decide the very first modes: no effect has modes that it knows nothing of."""
    rows = zip(effects, modes, found, strict=True)
    return all(rule is not None or mode is None or not effect.switches for effect, mode, rule in rows)


def layout(
    equations: Equations, modes: Modes, program: Program, mode_places: list[dict[str, int]]
) -> NDArray[np.int64]:
    """Where something is, by the places that `arrays` names."""
    p, watched, criteria = equations.parameters, 0, sum(program.watched)
    flags = arrays.BEHIND + 2 * p.balls + 2
    found = np.full(flags + criteria, -1, dtype=np.int64)
    found[arrays.APPARENT] = flags
    for one, states in program.apparent.items():
        found[flags + one] = len(found)
        found = np.append(found, (len(states), *states))
    found[arrays.SEEN], found[arrays.ORDER] = len(program.apparent), len(found)
    others = (one for one in range(criteria) if one not in program.apparent)
    found = np.append(found, np.array((*program.apparent, *others), dtype=np.int64))
    first = min(min(row.values(), default=program.numbers) for row in mode_places)
    found[: arrays.NUMBERS + 1] = (
        len(equations.states), p.balls, 2 * p.size + p.balls, criteria, program.values, first, mode_places[-1][""],
        program.numbers,
    )  # fmt: skip
    for k, (rule, mode, row) in enumerate(zip(rules(equations, modes), modes, mode_places, strict=False)):
        if rule and rule.name == "dry friction":
            found[arrays.FRICTION : arrays.SIDE + 1] = watched, criteria, row["direction"], row["side"]
        if rule and rule.name == "ball contact":
            numbers = (row[name] for name in ("turns", "touching", "least", "joined"))
            found[arrays.GAPS : arrays.JOINED + 1] = watched, len(mode.joined), *numbers
            found[arrays.BEHIND : arrays.BEHIND + 2 * len(mode.joined)] = (*mode.behind, *mode.ahead)
        if rule and rule.name == "one-sided contact":
            found[arrays.ONE_SIDED], found[arrays.TOUCHES] = watched, row[""]
        watched, criteria = watched + program.watched[k], criteria + program.criteria[k]
    return found


def constants(equations: Equations, modes: Modes, tolerance: float, method: Method) -> Array:
    """What the loop needs of a scene beside its equations, by the places that `arrays` names."""
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
    """By how much [rad] balls must part for a rebound to be one, with steps of this tolerance.

    Elastic balls that are pressed together bounce ever faster, as 1/√(this): at the usual tolerance of 2e-5 it is 1e-4
    rad, a hundredth of what the angles are asked for; at a fine one it is that of the reference.

    >>> [f"{lifted(tolerance):.0e}" for tolerance in (1e-3, 2e-6, 1e-7, 1e-9)]
    ['1e-04', '1e-04', '5e-06', '1e-06']
    """
    return min(max(LIFT, LIFT_SHARE * tolerance), LIFT_MOST)


def numbers_places(modes: Modes, count: int) -> list[dict[str, int]]:
    """Where the numbers of each mode are among so many, from the first."""
    return [{name: count + at for name, at in row.items()} for row in places(modes)]
