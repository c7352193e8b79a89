"""The frequency region of a machine without approximations: where its idle balanced state is stable."""

from dataclasses import dataclass

from abu_calc.dynamics.balanced.boundaries import Boundary, boundaries
from abu_calc.dynamics.balanced.stability import stability
from abu_calc.errors import NotTrustworthyError
from abu_calc.scenes.from_design import contact_half_angle, idle_scene
from abu_calc.sizing.design import Design
from abu_calc.units import from_si


@dataclass(frozen=True)
class TrueRegion:
    """Whether the idle balanced state is stable at the rated speed, and where that changes; None: not known, `reason`.

    Boundaries from half the lowest natural frequency, or half the lowest speed where that is less, to twice the highest
    speed.
    """

    stable: bool | None
    boundaries: tuple[Boundary, ...] | None
    warnings: tuple[str, ...]


def true_region(design: Design) -> TrueRegion:
    """By the eigenvalues of the idle scene, with the drag and the damping of the file.

    Warns where they contradict the simple rule, which knows nothing of damping and little of the mass of the balls.
    """
    scene, half = idle_scene(design), contact_half_angle(design)
    low, high = design.case.speed_range
    try:
        found = stability(scene, half)
        limits = boundaries(scene, min(low, *design.frequency.natural_frequencies) / 2, 2 * high, half, coarse=True)
    except NotTrustworthyError as error:
        return TrueRegion(None, None, (f"Stability at idle is not known: {str(error).splitlines()[0]}.",))
    contradicts = found.state is not None and not found.stable and design.frequency.balancing_possible
    return TrueRegion(found.stable, limits, (_contradiction(design),) if contradicts else ())


def _contradiction(design: Design) -> str:
    region = design.frequency
    return (
        f"At {from_si(region.speed, 'rpm'):.6g} rpm the balanced state is not stable, although the speed lies in a "
        "zone where balls balance by the simple rule. That rule holds for light balls on lightly damped springs; it "
        f"widens the forbidden zone by the finite-mass gap (2m/JM)^⅓ = {region.finite_mass_gap:.3g}, an estimate that "
        "knows neither the drag of the balls nor the damping of the suspension. Lighter balls, or another drag, help; "
        "`abu stability --speeds` shows where."
    )
