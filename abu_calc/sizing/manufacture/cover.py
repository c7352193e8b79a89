"""The cover and what holds it: an interference fit or a fine thread, over temperature and speed.

Checks of the closed housing: filling, stress and burst at overspeed, containment of a ball.

Standard fits of bore and spindle (ISO 286), warm and at speed.
"""

import math
from collections.abc import Iterator
from typing import Final

from abu_calc.formulas.press_fit import (
    ASSEMBLY_TEMPERATURE,
    MATERIALS,
    Ring,
    RingMaterial,
    contact_pressure,
    fit_force,
    inner_hoop,
    interference_left,
    outer_hoop,
    spin_stress,
)
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import RangeError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import GRAVITY, from_si, shown, to_si
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import GROOVE_CLEARANCE, LEAST_FILLING, balls_go_in, filling_gap, last_ball_passes
from abu_calc.sizing.parts.housing_parts import HousingParts, moments
from abu_calc.standards.tables import metres
from abu_calc.standards.tolerance_classes import DeviationLimits, grade_tolerance, part_limits

PAIRS: Final = (
    ("H8", "h7"), ("H7", "h6"), ("H6", "h5"), ("H7", "js6"), ("H6", "js5"), ("H7", "k6"), ("H6", "k5"),
    ("H7", "m6"), ("H6", "m5"), ("H7", "n6"), ("H6", "n5"), ("H7", "p6"), ("H6", "p5"), ("H7", "r6"),
)  # fmt: skip
"""Fits of a bore H and a spindle that ISO 286-1:2010 recommends, as far as both classes are tabulated here."""


@formula(
    "Eccentricity by the largest clearance of a fit",
    "(ES − ei + I_g)/2, at least 0",
    "m",
    shown="um",
    where=(
        "A transition fit may be tight or loose; its largest clearance counts. An interference fit centres. I_g is "
        "what the bore outgrows the spindle by, warm and at the highest speed."
    ),
    source="ISO 286-1:2010",
)
def fit_eccentricity(bore: DeviationLimits, spindle: DeviationLimits, growth: float = 0.0) -> float:
    """
    >>> round(1e6 * fit_eccentricity(DeviationLimits(0.0, 13e-6), DeviationLimits(-6.5e-6, 6.5e-6)), 3)
    9.75
    """
    return max(0.0, round(bore.upper - spindle.lower + growth, 12)) / 2


@dataclass(frozen=True)
class Fit:
    """A fit of bore and spindle by ISO 286: classes and limit deviations [m].

    `growth`: what the bore outgrows the spindle by in diameter, warm and at the highest speed [m].
    """

    bore_class: str
    spindle_class: str
    bore: DeviationLimits
    spindle: DeviationLimits
    growth: float = 0.0

    @property
    def eccentricity(self) -> float:
        """Half the largest clearance [m], warm and at speed."""
        return fit_eccentricity(self.bore, self.spindle, self.growth)

    @property
    def tightest(self) -> float:
        """Largest interference [m], negative if there is always clearance."""
        return round(self.spindle.upper - self.bore.lower, 12)

    @property
    def loosest(self) -> float:
        """Least interference [m], negative if there can be clearance."""
        return round(self.spindle.lower - self.bore.upper, 12)

    @property
    def named(self) -> str:
        """The fit as a drawing writes it."""
        return f"{self.bore_class}/{self.spindle_class}"


def standard_fits(bore: float, growth: float = 0.0) -> tuple[Fit, ...]:
    """Standard fits for a bore [m], the easiest to mount first; none outside the tables of ISO 286-2."""
    return tuple(sorted(_tabulated(bore, growth), key=lambda fit: (fit.tightest, -fit.eccentricity)))


def _tabulated(bore: float, growth: float) -> Iterator[Fit]:
    for hole, shaft in PAIRS:
        try:
            yield Fit(hole, shaft, part_limits("housing", hole, bore), part_limits("shaft", shaft, bore), growth)
        except RangeError:
            continue


OVERSPEED: Final = 1.2
"""Overspeed of the proof, over the highest speed (assumed)."""
PROOF_SHARE: Final = 2 / 3
"""Share of the yield strength that overspeed may use (assumed)."""
BURST_RATIO: Final = 1.87
"""Least burst speed over the highest speed: √3.5, the factor of hand-held grinding wheels (EN 12413)."""
PERFORATION: Final = 1.4e9
"""Energy per (diameter × thickness)^1.5 at which a ball perforates mild steel [J/m³], of the BRL formula."""


def filling_gap_of(parts: HousingParts) -> float:
    """Gap [m] beside a ball on its way into the race."""
    size = parts.dimensions
    return filling_gap(size.shoulder_radius, parts.balls.diameter, size.hub_radius)


def filling_check(parts: HousingParts) -> Check:
    """Check that the balls can be put in through the open cover side."""
    size, balls = parts.dimensions, parts.balls
    beside = last_ball_passes(size, balls.count, balls.diameter)
    side = "beside the others" if beside else "but the last one does not pass the others"
    passed = balls_go_in(size, balls.count, balls.diameter)
    message = (
        f"The balls go in one by one before the cover is {parts.closure}, between hub and edge of the race, {side}"
    )
    return coded("ABU305", verdict(passed), message, filling_gap_of(parts), LEAST_FILLING)


@formula(
    "Hoop stress of the wall by balls that touch all round, and by its own rotation",
    "q_b·(R_o² + R²)/(R_o² − R²) + ρ·Ω²/4·[(3 + ν)·R_o² + (1 − ν)·R²], q_b = F/(d·b_r)",
    "Pa",
    signs="F d b_r R R_o",
    where="R and R_o are the inner and the outer radius of the wall, F the force of one ball, all at 1.2 × top speed.",
    assumed="a free ring: the webs carry nothing; balls side by side all round, an upper bound",
    source="Lamé; Timoshenko",
)
def wall_stress(wall: Ring, width: float, ball_force: float, ball_diameter: float, speed: float) -> float:
    pressure = ball_force / (ball_diameter * width)
    lame = (wall.outer**2 + wall.inner**2) / (wall.outer**2 - wall.inner**2)
    return pressure * lame + spin_stress(wall, speed)


def overspeed_stress(parts: HousingParts, force: float, top: float) -> tuple[str, float, RingMaterial]:
    """Place, stress [Pa] and material where overspeed takes the largest share of the strength; `force` at top speed."""
    size, speed = parts.dimensions, OVERSPEED * top
    race, body = MATERIALS[parts.race_part.density], MATERIALS[parts.body.density]
    wall = Ring(size.race_radius, size.ring_radius, race)
    width = size.ring_end - size.web
    stressed = (
        ("wall of the race", wall_stress(wall, width, OVERSPEED**2 * force, parts.balls.diameter, speed), race),
        ("bore of the body", spin_stress(Ring(size.bore_radius, size.outer_radius, body), speed), body),
        ("hole of the cover", spin_stress(Ring(size.hub_radius, size.seat_radius, body), speed), body),
    )
    return max(stressed, key=lambda place: place[1] / place[2].strength)


def overspeed_check(parts: HousingParts, force: float, top: float) -> Check:
    """Check of the stresses of wall, body and cover at overspeed, against what each material bears."""
    place, stress, material = overspeed_stress(parts, force, top)
    limit = PROOF_SHARE * material.strength
    passed = stress <= limit
    return coded("ABU306", verdict(passed), f"Hoop and spin stress at 1.2 × the highest speed, largest at the {place} "
        f"({material.name})", stress, limit,
    )  # fmt: skip


@formula(
    "Burst speed over the highest speed",
    "√(Σ σ_m·A_p/(Σ ρ·Ω²·I_p + n·F/2))",
    "1",
    signs="σ_m A_p ρ Ω I_p n F",
    where=(
        "Each half of the housing pulls on the cut through the axis. A_p is the area of a part's half section, "
        "I_p its second moment about the axis, σ_m its strength. All n balls lie on one side."
    ),
    assumed="the section yields as a whole before it bursts; a hard ring counts at the same strength",
    source="Robinson 1944 (mean hoop stress)",
)
def burst_ratio(parts: HousingParts, ball_force: float, speed: float) -> float:
    pull, held = parts.balls.count * ball_force / 2, 0.0
    for part in parts.turned:
        section = moments(part.profile)
        pull += part.density * speed**2 * section.second
        if part is not parts.cover:
            held += MATERIALS[part.density].strength * section.area
    return math.sqrt(held / pull)


def burst_check(parts: HousingParts, force: float, top: float) -> Check:
    """Check of the burst speed; the cover, which may be loose in its seat, pulls and does not hold."""
    ratio = burst_ratio(parts, force, top)
    passed = ratio >= BURST_RATIO
    return coded("ABU309", verdict(passed), "Burst speed over the highest speed, by the mean hoop stress with all "
        "balls on one side; the cover counts as load alone", ratio, BURST_RATIO,
    )  # fmt: skip


def _ball_energy(parts: HousingParts, top: float) -> float:
    return parts.balls.mass * (OVERSPEED * top * parts.balls.pitch_radius) ** 2 / 2


def contained(case: Case, parts: HousingParts, top: float) -> bool:
    """True if the guard stops a ball, or no guard is given."""
    given = case.autobalancer.guard_thickness
    return given is None or bool(given >= perforated_thickness(_ball_energy(parts, top), parts.balls.diameter))


def containment_check(case: Case, parts: HousingParts, top: float) -> tuple[Check, ...]:
    """Check that the guard stops a ball; none if no guard is given."""
    energy = _ball_energy(parts, top)
    least = perforated_thickness(energy, parts.balls.diameter)
    given = case.autobalancer.guard_thickness
    if given is None:
        return ()
    message = f"A ball that leaves the housing at 1.2 × the highest speed has {energy:.3g} J"
    passed = contained(case, parts, top)
    return (coded("ABU310", verdict(passed), f"{message}, which the guard of mild steel must stop", given, least,
                  None if passed else "Specify a thicker guard."),)  # fmt: skip


@formula(
    "Thickness of mild steel that stops a ball, with a factor of 1.5 on its energy",
    "(1.5·E_b/(1.4·10⁹))^(2/3)/d",
    "m",
    signs="E_b d",
    where="The formula was fitted at 57 … 270 m/s; slower balls dent more than they perforate.",
    assumed="a hard sphere at a right angle",
    source="BRL formula for missiles (Bechtel 1974)",
)
def perforated_thickness(energy: float, diameter: float) -> float:
    """
    >>> round(1e3 * perforated_thickness(100.0, 16e-3), 2)
    1.41
    """
    return float((1.5 * energy / PERFORATION) ** (2 / 3)) / diameter


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
