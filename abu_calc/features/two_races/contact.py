"""A wheel of a machine with two races pressed to its workpiece: closed forms for one phase of the imbalances."""

import cmath
import math
from collections.abc import Sequence
from typing import Final

import numpy as np

from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.features.grinding.steady_contact import even_fan
from abu_calc.features.two_races.case import TwoRaceCase, eccentric_needs
from abu_calc.features.two_races.choice import TwoRaceDesign
from abu_calc.formulas.balls import half_angle
from abu_calc.formulas.two_race_contact import TiltingContact
from abu_calc.formulas.two_races import Pair, PlacedImbalance, balancing_resultants, lever_shares
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import to_si
from abu_calc.inputs.duty import Grinding

ARRANGEMENTS: Final = 12
"""Arrangements of the balls that are judged besides the even one, drawn at random with a fixed seed."""
SEED: Final = 41
STEPS: Final = 200
"""Newton steps that bring random balls to a resultant."""
GROWS: Final = 1e-3
"""Growth [1/s] that counts as such: arrangements of more than two balls have neutral motions."""


@dataclass(frozen=True)
class PressedWheel:
    """A wheel at work: its number from 0 and its contact [SI]; `runout` [m], its angle from its own imbalance [rad]."""

    index: int
    name: str
    place: float
    radius: float
    runout: float
    runout_angle: float
    table: Grinding

    @property
    def friction(self) -> float:
        """s·f."""
        return self.table.rotation_sense * self.table.cutting_coefficient

    @property
    def compliance(self) -> float:
        """q_n [m/N]; 0 of a rigid contact."""
        return 1 / self.table.contact_stiffness_N_per_m if self.table.contact == "compliant" else 0.0

    @property
    def presses(self) -> bool:
        """True if runout presses in the plane; that of a face does not."""
        return self.table.contact != "face"

    def runout_at(self, case: TwoRaceCase, phases: Sequence[float]) -> complex:
        """E [m] in the rotor's frame, with the imbalances at these phases [rad]."""
        own = case.turned(phases)[self.index].imbalance
        return cmath.rect(self.runout, (cmath.phase(own) if own else 0.0) + self.runout_angle)

    def effect(self, case: TwoRaceCase, phases: Sequence[float]) -> GrindingContactEffect:
        """The contact as an effect of a scene."""
        runout, table = self.runout_at(case, phases), self.table
        stiffness = table.contact_stiffness_N_per_m if table.contact == "compliant" else 0.0
        return GrindingContactEffect(
            table.press_force_N, table.cutting_coefficient, table.contact, stiffness, table.rotation_sense,
            self.runout, cmath.phase(runout) if runout else 0.0, self.radius, self.place,
        )  # fmt: skip


def pressed_wheels(case: TwoRaceCase) -> tuple[PressedWheel, ...]:
    """Each wheel of the file at the contact that the file gives; none without [grinding]."""
    table = case.table.grinding
    if table is None:
        return ()
    return tuple(
        PressedWheel(
            index, wheel.name or f"wheel {index + 1}", to_si(wheel.plane_mm, "mm"), to_si(wheel.diameter_mm, "mm") / 2,
            to_si(wheel.runout, "mm"), to_si(wheel.runout_angle_deg, "deg"), table,
        )
        for index, wheel in enumerate(case.table.wheel)
    )  # fmt: skip


def contact_of(
    design: TwoRaceDesign, wheel: PressedWheel, phases: Sequence[float] = (), *, bare: bool = False
) -> TiltingContact:
    """The steady contact of a wheel; `bare`: of the machine without autobalancers. Without `phases` all are 0."""
    case = design.bare if bare else design.case
    swings = 1 - 1 / (8 * case.inertia_factor)  # balls swing at twice the speed in a backward whirl
    balls = () if bare else tuple(
        PlacedImbalance(race.place, swings * mass) for race, mass in zip(design.races, design.ball_masses, strict=True)
    )  # fmt: skip
    return TiltingContact.of(
        case.rotor, wheel.place, case.speed, wheel.compliance, wheel.friction, wheel.runout_at(case, phases), balls,
        wheel.presses,
    )  # fmt: skip


def resultants_at_work(
    design: TwoRaceDesign, wheel: PressedWheel, phases: Sequence[float] = ()
) -> tuple[complex, complex]:
    """Resultants [kg m] with which both races balance at work, races without eccentricity."""
    acting = PlacedImbalance(wheel.place, contact_of(design, wheel, phases).acting_imbalance())
    return balancing_resultants(design.case.races, [*design.case.turned(phases), acting])


def capacities_at_work(design: TwoRaceDesign, wheel: PressedWheel) -> Pair:
    """Capacities [kg m] that work requires of both races, over all unknown phases, with the worst eccentricities."""
    case, acting = design.case, contact_of(design, wheel).acting_imbalance()
    turned, off = case.turned(()), eccentric_needs(case, case.speed)
    needs = []
    for race in (0, 1):
        parts = [lever_shares(case.races, load.place)[race] * load.imbalance for load in turned]
        parts[wheel.index] += lever_shares(case.races, wheel.place)[race] * acting
        whole = sum(map(abs, parts)) if case.unknown_phases else abs(sum(parts))
        needs.append(whole + off[race])
    return needs[0], needs[1]


def ball_angles(design: TwoRaceDesign, resultants: Sequence[complex]) -> tuple[tuple[float, ...], ...] | None:
    """Angles [rad] of the balls of both races, evenly spread about each resultant; None beyond a capacity."""
    angles = []
    for race, resultant in zip(design.races, resultants, strict=True):
        abu = race.design.autobalancer
        if abs(resultant) > abu.capacity:
            return None
        beta = half_angle(abu.ball_diameter / 2, abu.pitch_radius)
        fan = even_fan(abu.ball_count, abs(resultant) / (abu.ball_mass * abu.pitch_radius), beta)
        angles.append(tuple(cmath.phase(resultant) + angle for angle in fan))
    return tuple(angles)


def growth_rates(design: TwoRaceDesign, wheel: PressedWheel) -> tuple[float, ...] | None:
    """Largest growth rates [1/s] of small motions of light balls: evenly spread, then in other arrangements.

    Imbalances of unknown phase are in phase. None if a race cannot carry its resultant.
    """
    resultants = resultants_at_work(design, wheel)
    even = ball_angles(design, resultants)
    if even is None:
        return None
    contact, random = contact_of(design, wheel), np.random.default_rng(SEED)
    drawn = (
        tuple(
            _drawn(race.design.autobalancer.ball_count, resultant / _moment(design, k), random)
            for k, (race, resultant) in enumerate(zip(design.races, resultants, strict=True))
        )
        for _ in range(ARRANGEMENTS)
    )
    return tuple(_growth(design, contact, arrangement) for arrangement in (even, *drawn))


def _moment(design: TwoRaceDesign, race: int) -> float:
    abu = design.races[race].design.autobalancer
    return abu.ball_mass * abu.pitch_radius


def _drawn(count: int, total: complex, random: np.random.Generator) -> tuple[float, ...]:
    """Random angles whose unit vectors add up to `total`; balls may overlap."""
    angles = random.uniform(-math.pi, math.pi, count)
    for _ in range(STEPS):
        off = np.exp(1j * angles).sum() - total
        if abs(off) < 1e-10:
            break
        slope = np.stack([-np.sin(angles), np.cos(angles)])
        step = np.linalg.lstsq(slope, -np.array([off.real, off.imag]), rcond=None)[0]
        angles = angles + step * min(1.0, 0.5 / max(float(np.abs(step).max()), 1e-12))
    return tuple(angles.tolist())


def _growth(design: TwoRaceDesign, contact: TiltingContact, angles: Sequence[Sequence[float]]) -> float:
    """Largest real part of the roots of J·δ'' + h₀·δ' + κ·δ = 0, κ_jl = −(Ω²/R_j)·m·R_l·Re(G·e^{i(θ_l − θ_j)})."""
    case, races = design.case, design.races
    which = [race for race in (0, 1) for _ in angles[race]]
    flat = np.array([angle for own in angles for angle in own])
    whirl = [[contact.whirl_per_imbalance(at, force_at) for force_at in case.races] for at in case.races]
    G = np.array([[whirl[i][k] for k in which] for i in which])
    radii = np.array([races[k].design.autobalancer.pitch_radius for k in which])
    moments = np.array([_moment(design, k) for k in which])
    turned = np.exp(1j * (flat[None, :] - flat[:, None]))
    stiffness = -(case.speed**2 / radii)[:, None] * moments[None, :] * (G * turned).real
    J, size = case.inertia_factor, len(flat)
    drag = np.diag([case.drags[k] for k in which])
    system = np.block([[np.zeros((size, size)), np.eye(size)], [-stiffness / J, -drag / J]])
    return float(np.linalg.eigvals(system).real.max())
