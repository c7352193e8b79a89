"""Which field to choose: by what it must hold, and by the handbooks' load intensity."""

from typing import Final

from abu_calc.fits.joint import Joint
from abu_calc.fits.ranges import SEAT_LENGTH
from abu_calc.formula import formula
from abu_calc.standards.limits import Seat, tolerance_classes
from abu_calc.standards.tables import toml_table
from abu_calc.units import from_si

LOOSE_ENOUGH: Final = 0.5
"""A ring under a load fixed in direction should be loose in at least half of all pairs: it creeps, spreads its wear
and can be moved along its seat."""

SHOCK_FACTOR: Final = 1.8
"""k₁ of the load intensity: strong shocks, overload to 300 %, taken always as the safe side (moderate ones: 1.0)."""

_USUAL_GRADE: Final[dict[Seat, str]] = {"shaft": "6", "housing": "7"}
_RUNNING: Final = "f"
_SLIDING: Final = ("h", "g")


def admissible(joint: Joint) -> tuple[Joint, ...]:
    """The joint with every tabulated class that passes both checks, the one to choose first.

    Classes of the given grade go before those of the usual one, these before others. A ring that must grip: the loosest
    first. A ring under a load fixed in direction: those loose in half of all pairs go before the tighter ones, among
    them the given class, then h (H), then g (G), then the others.
    """
    joints = (joint.with_class(name) for name in tolerance_classes(joint.seat))
    passing = [one for one in joints if one.grips and one.bears]
    return tuple(sorted(passing, key=lambda one: (*_preference(one, joint), *_tightness(one))))


@formula(
    "Load intensity of a seat",
    "P_R = k₁·k₂·k₃·R/b",
    "N/m",
    where=(
        "R radial load [N], b length of the seat [m]; k₁ = 1.8 strong shocks, k₂ = 1 solid shaft or thick housing, k₃ "
        "= 1 single row. Unverified advice."
    ),
    checked=(SEAT_LENGTH,),
    source="handbooks as quoted by Afanasiev 2015",
)
def load_intensity(load: float, seat_length: float) -> float:
    """
    >>> round(1e-3 * load_intensity(3000.0, 29e-3), 1)
    186.2
    """
    return SHOCK_FACTOR * load / SEAT_LENGTH.check(seat_length)


def advised_class(seat: Seat, diameter: float, intensity: float) -> str | None:
    """The loosest class that handbook tables allow at a load intensity [N/m]; None outside the tables.

    Range: shafts over 18 up to 630 mm, housings over 50 up to 1600 mm; unverified advice, never the only criterion.
    Source: handbooks as quoted by Afanasiev 2015.

    >>> advised_class("shaft", 0.080, 186.2e3), advised_class("housing", 0.140, 186.2e3)
    ('js6', 'K7')
    """
    table = toml_table("load_intensity")[seat]
    size = round(from_si(diameter, "mm"), 6)
    for over, to, *limits in table["rows"]:
        if over < size <= to:
            pairs = zip(table["fields"], limits, strict=True)
            return next((field for field, limit in pairs if from_si(intensity, "kN_per_m") <= limit), None)
    return None


def _preference(one: Joint, given: Joint) -> tuple[bool, bool, int, int]:
    grade, letter = _grade(one.tolerance_class), _letter(one.tolerance_class)
    grades = (_grade(given.tolerance_class), _USUAL_GRADE[given.seat])
    by_grade = grades.index(grade) if grade in grades else len(grades)
    if given.must_grip:
        return False, False, by_grade, 0
    by_letter = _SLIDING.index(letter) if letter in _SLIDING else len(_SLIDING)
    slides = one.clearance_probability >= LOOSE_ENOUGH
    return not slides, one.tolerance_class != given.tolerance_class, by_grade, by_letter + (letter == _RUNNING)


def _tightness(one: Joint) -> tuple[float, float]:
    return one.interference.smallest, one.interference.largest


def _letter(tolerance_class: str) -> str:
    return tolerance_class.rstrip("0123456789").lower()


def _grade(tolerance_class: str) -> str:
    return tolerance_class.lstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ")
