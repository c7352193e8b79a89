"""The frequency region of a machine without approximations: where its idle balanced state is stable."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from abu_calc.analysis.hanging import hanging_bounds
from abu_calc.checks import Check, coded, verdict
from abu_calc.dynamics.balanced.boundaries import Boundary, excess_of, limits_of, quick
from abu_calc.dynamics.balanced.crossings import Motion
from abu_calc.dynamics.balanced.hanging import HangingBounds
from abu_calc.dynamics.balanced.stability import MARGIN, judged
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import NotTrustworthyError
from abu_calc.frozen import dataclass
from abu_calc.scenes.from_design import contact_half_angle, idle_scene
from abu_calc.sizing.design import Design
from abu_calc.units import from_si

PLACES: Final = 9
"""Speeds of a range at which the growth rate is compared."""


@dataclass(frozen=True)
class Mode:
    """A free motion of the idle machine with its balls: frequency |λ| [rad/s] and damping ratio −Re λ/|λ|."""

    frequency: float
    damping_ratio: float


@dataclass(frozen=True)
class TrueRegion:
    """Whether the idle balanced state is stable at the rated speed, and where that changes; None: not known.

    In the worst arrangement that balances. Boundaries from half the lowest natural frequency, or half the lowest speed
    where that is less, to twice the highest speed. `modes`: those that swing, ascending.
    """

    stable: bool | None
    boundaries: tuple[Boundary, ...] | None
    modes: tuple[Mode, ...]
    hanging: HangingBounds
    check: Check


def true_region(design: Design) -> TrueRegion:
    """By the eigenvalues of the idle scene, with the drag and the damping of the file."""
    scene, half = idle_scene(design), contact_half_angle(design)
    low, high = design.case.speed_range
    modes, hanging = _modes(scene), hanging_bounds(design)
    try:
        motions = quick(judged(scene, half)[1])
        if not motions:
            reason = "there is no balanced state: the balls cannot carry the imbalance"
            remedy = "Heavier or more balls, a larger race, or a better balanced wheel."
            check = coded("ABU103", "fail", reason, unit="1/s", remedy=remedy)
            return TrueRegion(False, (), modes, hanging, check)
        first = min(low, *design.frequency.natural_frequencies) / 2
        limits = limits_of(_scanned(motions), scene, first, 2 * high, coarse=True)
        stable = excess_of(motions, scene.speed) < 0
        return TrueRegion(stable, limits, modes, hanging, _check(design, motions, limits))
    except NotTrustworthyError as error:
        reason = f"not known: {str(error).splitlines()[0]}"
        check = coded("ABU103", "not-done", reason, unit="1/s", remedy="Another drag, or springs in place of hands.")
        return TrueRegion(None, None, modes, hanging, check)


def _scanned(motions: Sequence[Motion]) -> Sequence[Motion]:
    """All where that is quick; on an anisotropic support the least even one, which needs the highest speed."""
    return motions if all(motion.isotropic for motion in motions) else motions[-1:]


def _check(design: Design, motions: Sequence[Motion], limits: Sequence[Boundary]) -> Check:
    """Every speed of the range: its ends, the rated one, those of a grid, and no boundary between."""
    low, high = design.case.speed_range
    grid = np.geomspace(low, high, PLACES).tolist() if low < high else ()
    speeds = {**dict.fromkeys(grid, _scanned(motions)), **dict.fromkeys((low, design.case.speed, high), motions)}
    rates = {speed: (excess_of(each, speed) - MARGIN) * speed for speed, each in speeds.items()}
    worst = max(rates, key=lambda speed: rates[speed])
    stable = rates[worst] < -MARGIN * worst and not any(low < one.speed < high for one in limits)
    rpm = f"{from_si(worst, 'rpm'):.6g} rpm"
    if stable:
        where = f"the slowest at {rpm}" if low < high else f"at {rpm}"
        message = f"every small disturbance dies out, {where}, in the worst arrangement that balances"
    else:
        message = f"not every small disturbance dies out at {rpm}, in the worst arrangement that balances"
    return coded(
        "ABU103", verdict(stable), message, rates[worst], 0.0, "1/s", None if stable else _remedy(limits, high)
    )


def _remedy(limits: Sequence[Boundary], high: float) -> str:
    """The speed above which all is stable, where it is within reach."""
    last = limits[-1] if limits and limits[-1].stable_above else None
    if last is None:
        return "More drag or damping, lighter balls, or a softer suspension."
    above = "" if last.speed < high else ", beyond this range; or hold the machine more softly"
    return f"Keep all speeds above {from_si(last.speed, 'rpm'):.6g} rpm{above}."


def _modes(scene: Scene) -> tuple[Mode, ...]:
    rates = np.linalg.eigvals(scene.small_motion.motion)
    swinging = rates[rates.imag > 0]
    found = (Mode(float(abs(rate)), float(-rate.real / abs(rate))) for rate in swinging)
    return tuple(sorted(found, key=lambda one: one.frequency))
