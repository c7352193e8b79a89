"""Loads on each hand of a machine that is held still in the air."""

from abu_calc.frozen import dataclass
from abu_calc.sizing.design import Design
from abu_calc.units import GRAVITY


@dataclass(frozen=True)
class HeldLoad:
    """Static load [N] of a hand, without and with the autobalancer, upward; negative: it must press down."""

    name: str
    without: float
    fitted: float


def held_loads(design: Design) -> tuple[HeldLoad, ...] | None:
    """Load on each handle by the lever of two handles; None if statics does not give it.

    The machine's centre of mass may lie between or outside the handles. Equilibrium of a horizontal
    spindle: F₁ + F₂ = (M + m)g, F₁p₁ + F₂p₂ = m·g·a_r, places from the centre of mass of machine and wheel,
    the autobalancer in the plane of its race. One handle carries all; three are statically indeterminate.
    """
    case, added = design.case, design.autobalancer.mass
    handles = case.handles
    if len(handles) == 1:
        return (HeldLoad(handles[0].name, case.body.mass * GRAVITY, (case.body.mass + added) * GRAVITY),)
    known = case.table.machine.spindle_axis == "horizontal" and case.body.is_rigid
    if len(handles) != 2 or not known or handles[0].place == handles[1].place:
        return None
    first, second = handles
    span = first.place - second.place

    def share(mass: float) -> tuple[float, float]:
        weight, moment = (case.body.mass + mass) * GRAVITY, mass * GRAVITY * case.race_place
        at_first = (moment - weight * second.place) / span
        return at_first, weight - at_first

    bare, fitted = share(0.0), share(added)
    return tuple(
        HeldLoad(handle.name, before, after) for handle, before, after in zip(handles, bare, fitted, strict=True)
    )
