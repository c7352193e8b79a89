"""The cover and what holds it: an interference fit or a fine thread, over temperature and speed."""

import math
from collections.abc import Iterator
from typing import Final

from abu_calc.formulas.press_fit import (
    ASSEMBLY_TEMPERATURE,
    MATERIALS,
    Ring,
    contact_pressure,
    fit_force,
    inner_hoop,
    interference_left,
    outer_hoop,
)
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import RangeError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import GRAVITY, from_si, shown, to_si
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import GROOVE_CLEARANCE
from abu_calc.sizing.manufacture.closure import OVERSPEED, PROOF_SHARE
from abu_calc.sizing.manufacture.spindle_fit import Fit
from abu_calc.sizing.parts.housing_parts import HousingParts
from abu_calc.standards.tables import metres
from abu_calc.standards.tolerance_classes import DeviationLimits, grade_tolerance, part_limits

SHOCK: Final = 50 * GRAVITY
"""Axial shock of handling that the cover withstands [m/s²] (assumed)."""
EDGE_FRICTION: Final = 0.05
"""Axial force of a roller on the cover over its radial force (assumed)."""
COVER_FACTOR: Final = 1.5
COVER_FITS: Final = (("H7", "p6"), ("H6", "p5"), ("H7", "r6"), ("H6", "r6"))
THREAD_PITCHES_MM: Final = (2.0, 1.5, 1.0, 0.75, 0.5, 0.35, 0.25)
LEAST_TURNS: Final = 3


@dataclass(frozen=True)
class Cover:
    """Hold of the cover: what holds it, its axial force and the one it needs [N].

    `fit`: of a pressed cover in its seat; `pitch`: of a screwed one's thread [m]. `stress`, `permitted`: largest hoop
    stress of wall or cover by the fit, over the temperatures, and the permitted one [Pa].
    """

    fit: Fit | None
    pitch: float | None
    held: float
    needed: float
    stress: float = 0.0
    permitted: float = math.inf

    @property
    def holds(self) -> bool:
        """True if it holds the force, and the fit stresses nothing too much."""
        return self.held >= self.needed and self.stress <= self.permitted


def choose_cover(case: Case, parts: HousingParts, ball_force: float, top: float) -> Cover:
    """The cover's hold, by the loosest standard fit that suffices, or by the coarsest thread of three turns."""
    needed = COVER_FACTOR * _axial_load(parts, OVERSPEED**2 * ball_force)
    size = parts.dimensions
    if parts.closure == "screwed":
        pitches = metres(() if ring_fills_thread(parts) else THREAD_PITCHES_MM)
        pitch = next((each for each in pitches if each * LEAST_TURNS <= size.web), None)
        strength = MATERIALS[parts.cover.density].strength
        shear = 0.5 * 2 * math.pi * size.seat_radius * size.web * 0.58 * strength * PROOF_SHARE
        return Cover(None, pitch, shear if pitch else 0.0, needed)
    fits = [*_standard_fits(2 * size.seat_radius), _own_fit(case, parts, needed, top)]
    holding = (_pressed(case, parts, fit, needed, top) for fit in fits)
    return next((each for each in holding if each.holds), None) or _pressed(case, parts, fits[-1], needed, top)


def ring_fills_thread(parts: HousingParts) -> bool:
    """True if a screwed cover's thread has the diameter of a ring behind it, which does not pass its minor diameter."""
    size = parts.dimensions
    return parts.closure == "screwed" and size.ring_end <= size.cover_start and size.seat_radius <= size.ring_radius


def _standard_fits(diameter: float) -> Iterator[Fit]:
    for hole, shaft in COVER_FITS:
        try:
            yield Fit(hole, shaft, part_limits("housing", hole, diameter), part_limits("shaft", shaft, diameter))
        except RangeError:
            continue


def _own_fit(case: Case, parts: HousingParts, needed: float, top: float) -> Fit:
    """A seat of width IT7 from zero, and limits of the cover, IT6 wide, that hold the force where no class does."""
    inside, outside = cover_rings(parts)
    diameter = 2 * outside.inner
    per_metre = fit_force(contact_pressure(1.0, inside, outside), outside.inner, parts.dimensions.web)
    lost = -_left(case, parts, 0.0, top)
    hole = DeviationLimits(0.0, grade_tolerance(7, diameter))
    low = to_si(math.ceil(from_si(hole.upper + lost + needed / per_metre, "um")), "um")
    return Fit("", "", hole, DeviationLimits(low, low + grade_tolerance(6, diameter)))


def _left(case: Case, parts: HousingParts, interference: float, top: float) -> float:
    """Least interference left [m] over the temperatures, at rest and at overspeed."""
    inside, outside = cover_rings(parts)
    return min(
        interference_left(interference, inside, outside, temperature, speed)
        for temperature in (*case.autobalancer.temperature_range_C, ASSEMBLY_TEMPERATURE)
        for speed in (0.0, OVERSPEED * top)
    )


def _pressed(case: Case, parts: HousingParts, fit: Fit, needed: float, top: float) -> Cover:
    """Hold of a pressed cover and the stresses of its fit."""
    inside, outside = cover_rings(parts)
    held = fit_force(
        contact_pressure(_left(case, parts, fit.loosest, top), inside, outside), outside.inner, parts.dimensions.web
    )
    most = max(
        contact_pressure(interference_left(fit.tightest, inside, outside, temperature, 0.0), inside, outside)
        for temperature in (*case.autobalancer.temperature_range_C, ASSEMBLY_TEMPERATURE)
    )
    stresses = {
        PROOF_SHARE * outside.material.strength: outer_hoop(most, outside),
        PROOF_SHARE * inside.material.strength: inner_hoop(most, inside),
    }
    permitted, stress = max(stresses.items(), key=lambda pair: pair[1] / pair[0])
    return Cover(fit, None, held, needed, stress, permitted)


def cover_rings(parts: HousingParts) -> tuple[Ring, Ring]:
    """The cover, and the wall round it, as rings."""
    size = parts.dimensions
    seat_in_ring = size.ring_end > size.cover_start
    holder = parts.race_part if seat_in_ring else parts.body
    outer = size.ring_radius if seat_in_ring else size.outer_radius
    return (
        Ring(size.hub_radius, size.seat_radius, MATERIALS[parts.cover.density]),
        Ring(size.seat_radius, outer, MATERIALS[holder.density]),
    )


@formula(
    "Axial force on the cover",
    "max(n·F·b_c/(R_g − r), 50·g·(m_c + n·m))",
    "N",
    signs="n F b_c R_g r g m_c m",
    where=(
        "The groove pushes a ball back that has climbed by its clearance b_c to the cover; the same force holds it "
        "there. A roller's race is straight: it takes 0.05·F. The second value is a shock of 50 g. The cover holds "
        "1.5 times the larger."
    ),
    assumed="the shock of handling",
    source="derived; assumed",
)
def axial_load(count: int, force: float, slope: float, mass: float) -> float:
    return max(count * force * slope, SHOCK * mass)


def _axial_load(parts: HousingParts, force: float) -> float:
    groove, balls = parts.dimensions.groove_radius, parts.balls
    clearance = (parts.dimensions.inner_width - balls.diameter) / 2
    slope = EDGE_FRICTION
    if groove is not None:
        slope = min(1.0, max(clearance, GROOVE_CLEARANCE) / (groove - balls.diameter / 2))
    return axial_load(balls.count, force, slope, parts.cover.mass + balls.count * balls.mass)


def seat_growth(parts: HousingParts, interference: float) -> float:
    """Growth in diameter [m] of the wall round a pressed cover, at its seat: D/E·(σ_θ + ν·p), by Lamé.

    The wall counts as a free ring as wide as the seat, so the race beside the seat grows by less.
    """
    inside, outside = cover_rings(parts)
    left = interference_left(interference, inside, outside, ASSEMBLY_TEMPERATURE, 0.0)
    pressure, material = contact_pressure(left, inside, outside), outside.material
    return 2 * outside.inner / material.modulus * (outer_hoop(pressure, outside) + material.poisson * pressure)


def seat_name(parts: HousingParts, hold: Cover) -> str:
    """The cover's fit or thread, as a drawing writes it."""
    if parts.closure == "screwed":
        none = "no thread lets the ring pass" if ring_fills_thread(parts) else "no thread of three turns"
        return parts.thread_name(hold.pitch) if hold.pitch else none
    fit = hold.fit
    assert fit is not None
    if fit.bore_class:
        return fit.named
    seat, rim = (shown((limits.upper, limits.lower), "um", "+.3g", "/") for limits in (fit.bore, fit.spindle))
    return f"seat {seat.removesuffix(' µm')}, cover {rim}"


def cover_check(parts: HousingParts, hold: Cover) -> Check:
    """Check that the cover stays on, over the temperatures, at overspeed."""
    message = (
        f"Axial force that holds the {parts.closure} cover ({seat_name(parts, hold)}), least over temperatures up to "
        "1.2 × the highest speed"
    )
    if hold.stress > hold.permitted:
        permitted = shown(hold.permitted, "MPa")
        message += f". Its fit stresses wall or cover with {shown(hold.stress, 'MPa')}, permitted {permitted}"
    return coded("ABU307", verdict(hold.holds), message, hold.held, hold.needed)
