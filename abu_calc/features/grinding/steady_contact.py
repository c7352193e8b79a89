"""Steady contact of a machine at work: places of its balls, spindle displacement, force of wheel and workpiece.

Everything is in the rotor's frame, angles from the imbalance; phasors as in `formulas.tilting_contact`. The race is
taken to be in the plane of the wheel.

Levels under load that are lower bounds: the model lacks the excitation that sets the level on the shop floor.
"""

import cmath
import math
from collections.abc import Callable
from dataclasses import replace
from typing import Annotated, Final, Literal

from abu_calc.features.grinding.formulas import BallArrangement, characteristic, growing_roots, loaded_stiffness
from abu_calc.formulas.suspension import dynamic_stiffness
from abu_calc.formulas.tilting_contact import SteadyContact
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import velocity_from_level
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.design import Design
from abu_calc.sizing.imbalance import readings

Places = Literal["balanced", "restless", "short", "gathered", "turning"]
"""Balls balance; do not stay where they would; carry too little and lie side by side; gather where they add to the
imbalance; or come to no rest."""

HALVINGS = 60
"""Halvings of an interval, down to rounding."""


@dataclass(frozen=True)
class RestingBalls:
    """Resting places of the balls: resultant needed and reached [kg m], each angle [rad], slow stiffness.

    `stiffness` [1/s²] of their slow motion, as if they were light; `worst`: that of a cross, which more
    than two may form.
    """

    places: Places
    needed: complex
    resultant: complex | None
    angles: tuple[float, ...]
    stiffness: tuple[complex, complex]
    worst: tuple[complex, complex]


@dataclass(frozen=True)
class SteadyWork:
    """One steady motion: the contact, runout E [m], imbalance [kg m] of the wheel itself and U in all.

    U None: balls that come to no rest. `balls` None without, or with fixed ones.
    """

    contact: SteadyContact
    runout: complex
    own: complex
    imbalance: complex | None
    balls: RestingBalls | None = None

    @property
    def axis(self) -> tuple[complex, complex] | None:
        """X, Y [m]."""
        return None if self.imbalance is None else self.contact.axis(self.imbalance, self.runout)

    @property
    def amplitude(self) -> float | None:
        """The larger of |X|, |Y| [m]."""
        return None if self.axis is None else max(map(abs, self.axis))

    @property
    def reaction(self) -> complex | None:
        """N_c [N]: the force of wheel and work is N₀ + Re(N_c e^{iΩt})."""
        return None if self.imbalance is None else self.contact.normal_force(self.imbalance, self.runout)

    @property
    def pressure(self) -> complex | None:
        """H = −i·N_c [N]: where the wheel's point ψ touches, the force is N₀ + Re(H e^{−iψ})."""
        return None if self.reaction is None else -1j * self.reaction


def contact_of(case: Case, added_mass: float, speed: float | None = None, *, rigid: bool = False) -> SteadyContact:
    """The machine at a speed [rad/s], by default the rated one; `rigid`: as if its contact were.

    A face contact does not press in the plane: an idle machine. So does a file without a contact.
    """
    at, mass, contact = speed or case.speed, case.body.effective_mass(added_mass), case.contact
    dx, dy = (dynamic_stiffness(case.suspension, axis, at, mass) for axis in (0, 1))
    if contact is None or not contact_presses(case):
        return SteadyContact(at, (dx, dy), 1.0, 0.0, 0.0)
    compliance = 0.0 if rigid or contact.contact == "rigid" else 1 / contact.contact_stiffness
    return SteadyContact(at, (dx, dy), compliance, contact.rotation_sense * contact.cutting_coefficient)


def contact_presses(case: Case) -> bool:
    """True if the contact presses in the plane; that of a face does not."""
    return case.contact is not None and case.contact.contact != "face"


def runout_of(case: Case) -> complex:
    """E [m] of the file."""
    return cmath.rect(case.runout, case.table.wheel.runout_angle)


def bare(design: Design, runout: complex, *, speed: float | None = None, rigid: bool = False) -> SteadyWork:
    """The machine without its autobalancer."""
    own = complex(design.imbalance.value)
    return SteadyWork(contact_of(design.case, 0.0, speed, rigid=rigid), runout, own, own)


def fixed(design: Design, runout: complex) -> SteadyWork:
    """Steady motion with the autobalancer, its balls fixed where they balance at idle."""
    return SteadyWork(contact_of(design.case, design.autobalancer.mass), runout, complex(design.imbalance.value), 0j)


def fitted(
    design: Design,
    runout: complex,
    *,
    speed: float | None = None,
    rigid: bool = False,
    judged: bool = True,
) -> SteadyWork:
    """Steady motion with the autobalancer, its balls free, with an ideal race and no dry friction.

    `judged`: see `with_balls`.
    """
    contact = contact_of(design.case, design.autobalancer.mass, speed, rigid=rigid)
    return with_balls(design, contact, runout, complex(design.imbalance.value), judged=judged)


def with_balls(
    design: Design, contact: SteadyContact, runout: complex, imbalance: complex, *, judged: bool = True
) -> SteadyWork:
    """Free balls at a contact, with what they leave of the imbalance or add to it.

    Unless `judged`, balls that balance are taken to stay there.
    """
    autobalancer, ratio = design.autobalancer, design.autobalancer.requirement.plane_ratio
    needed = (contact.balancing_imbalance(runout) - imbalance) * ratio
    whirl, moment = contact.whirl_per_imbalance, autobalancer.ball_moment
    balances, enough = whirl.real < 0, abs(needed) <= autobalancer.capacity
    places: Places = "balanced" if balances and enough else "short" if balances else "gathered"
    resultant = needed if balances and enough else _side_by_side(whirl, needed, autobalancer.capacity)
    angles: tuple[float, ...] = ()
    if resultant is None:
        places = "turning"
    else:
        spread = even_fan(autobalancer.ball_count, abs(resultant) / moment, design.autobalancer.half_angle)
        angles = tuple(cmath.phase(resultant) + angle for angle in spread)
    doubled = abs(sum(cmath.exp(2j * angle) for angle in angles))

    def stiffness(line: float) -> tuple[complex, complex]:
        """Both eigenvalues [1/s²] of balls whose |Σe^{2iΘ}| this is."""
        return loaded_stiffness(whirl, autobalancer.ball_mass, contact.speed, autobalancer.ball_count, line)

    if judged and places == "balanced" and leaving(design.case, contact, autobalancer, doubled):
        places = "restless"
    worst = stiffness(doubled if autobalancer.ball_count == 2 else 0.0)
    balls = RestingBalls(places, needed, resultant, angles, stiffness(doubled), worst)
    total = None if resultant is None else imbalance + resultant / ratio
    return SteadyWork(contact, runout, imbalance, total, balls)


def leaving(case: Case, contact: SteadyContact, candidate: Candidate, doubled: float) -> int:
    """Number of growing small disturbances of balls that balance.

    `doubled`: |Σe^{2iΘ}| of their arrangement.
    """
    mass = case.body.effective_mass(candidate.mass)

    def whirl(speed: complex) -> complex:
        """G [m/(kg m)] at a complex speed [rad/s]."""
        dx, dy = (case.suspension.reaction(axis, speed) - mass * speed**2 for axis in (0, 1))
        return contact.whirl_at(speed, (dx, dy))

    balls = BallArrangement(candidate.ball_count, candidate.ball_mass, doubled, case.inertia_factor, case.drag)
    return growing_roots(lambda s: characteristic(whirl, balls, contact.speed, s), contact.speed)


def _side_by_side(whirl: complex, needed: complex, capacity: float) -> complex | None:
    """The resultant of balls side by side, where nothing turns them: Im[G(C − V e^{−iψ})] = 0, the stable root.

    None where there is none: they go on turning. Source: derived.
    """
    if needed == 0:
        return complex(capacity) if capacity == 0 else None
    lean = cmath.phase(-whirl) if whirl.real < 0 else cmath.phase(whirl)
    turned = capacity / abs(needed) * math.sin(lean)
    if abs(turned) > 1:
        return None
    to = math.asin(turned) if whirl.real < 0 else math.pi - math.asin(turned)
    return cmath.rect(capacity, cmath.phase(needed) + lean - to)


def even_fan(count: int, length: float, beta: float) -> tuple[float, ...]:
    """Angles [rad] of balls spread evenly about 0 whose unit vectors add up to `length`; β half angle of touching ones.

    Of more than two the typical one of many arrangements.

    >>> [round(math.degrees(angle), 6) for angle in even_fan(2, 1.0, 0.1)]
    [-60.0, 60.0]
    """
    low, high = 2 * beta, 2 * math.pi / count
    for _ in range(HALVINGS):
        spacing = (low + high) / 2
        longer = math.sin(count * spacing / 2) / math.sin(spacing / 2) > length
        low, high = (spacing, high) if longer else (low, spacing)
    return tuple((k - (count - 1) / 2) * low for k in range(count))


def changed(design: Design, *, stiffness: float | None = None, press: float | None = None) -> Design:
    """The same design at another contact."""
    case = design.case
    if case.contact is None:
        return design
    given = {"contact_stiffness_N_per_m": stiffness, "press_force_N": press}
    contact = case.contact.model_copy(update={key: value for key, value in given.items() if value is not None})
    return replace(design, case=replace(case, contact=contact))


def crossing(better: Callable[[float], bool], good: float, bad: float) -> float:
    """The last value towards `bad` that is better still, with at most 1 % in doubt on the good side."""
    while abs(bad - good) > 0.01 * abs(good) and abs(bad - good) > 1e-12:
        middle = (good + bad) / 2
        good, bad = (middle, bad) if better(middle) else (good, middle)
    return good


LEAST: Final = 1.0
"""Frequency-weighted vibration total a_hv [m/s²] below which the level of a grinder at its work is a lower bound.

Typical declared values of grinders are 3 to 8 m/s² (INRS, Proceedings 2023, 86(1), 13): 1 m/s² is a third of the
lowest. The lowest level known here of a grinder with an autobalancer at its work, 102 to 103 dB idle and 2 dB more
under load at 5800 rpm (Kladiev 1996), is 1.1 to 1.3 m/s². The number is reasoned, no standard has it.
"""

ALWAYS: Final = ("wheel waviness", "forces of chip formation")
"""No scene of grinding has these."""


@record
class LevelBound(Record):
    """Mark of a level under load that is a lower bound: what sets it in the model, and what the model lacks.

    No total: the speed is beyond the range of W_h.
    """

    lower_bound: Annotated[bool, Quantity("the level is a lower bound")]
    total: Annotated[float | None, Quantity("weighted vibration total of the level", "a_hv", 3, unit="m_per_s2")]
    set_by: Annotated[tuple[str, ...], Quantity("set by")]
    lacks: Annotated[tuple[str, ...], Quantity("the model lacks")]

    @property
    def sentence(self) -> str:
        """One sentence for the screen; empty if the level is no lower bound."""
        if not self.lower_bound:
            return ""
        shown = "" if self.total is None else f" (a_hv {self.total:.2g} m/s²)"
        return (
            f"The level under load{shown} is a lower bound. The model sets it by {_listed(self.set_by)}. It lacks "
            f"{_listed(self.lacks)}."
        )


def lower_bound(level: float | None, case: Case) -> LevelBound | None:
    """Lower bound that a level under load [dB] at the loudest handle may be; None if the level is not known.

    It is one if its weighted total is below `LEAST`; or if a contact presses in the plane of the wheel and the file
    gives a wheel without runout: then nothing but the imbalance that the balls remove drives the machine. What the
    model lacks adds to the levels with and without the autobalancer alike, as squares, so that their order stays.
    """
    if level is None:
        return None
    total = readings(velocity_from_level(level), case.speed).total
    presses = contact_presses(case)
    true = presses and not case.runout
    return LevelBound(
        lower_bound=true or (total is not None and total < LEAST),
        total=total,
        set_by=_set_by(case, presses),
        lacks=(
            *(("the wheel's runout (the file gives 0 mm)",) if true else ()),
            *(() if presses else ("the force of the contact",)),
            *ALWAYS,
            *(() if case.background_level is not None else ("vibration of motor and gear",)),
        ),
    )


def _set_by(case: Case, presses: bool) -> tuple[str, ...]:
    """The excitations of this machine that the model has, once per turn all of them."""
    parts = (
        ("the imbalance that the balls leave", True),
        ("the wheel's runout", presses and case.runout > 0),
        ("race eccentricity", case.race_eccentricity > 0),
        ("dry friction of the balls", case.friction_arm > 0),
        ("the background level of the file", case.background_level is not None),
    )
    return tuple(name for name, there in parts if there)


def _listed(names: tuple[str, ...]) -> str:
    """
    >>> _listed(("a", "b", "c")), _listed(("a",))
    ('a, b and c', 'a')
    """
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
