"""Levels under load that are lower bounds: the model lacks the excitation that sets the level on the shop floor."""

from typing import Annotated, Final

from abu_calc.features.grinding.steady_contact import contact_presses
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import velocity_from_level
from abu_calc.sizing.case import Case
from abu_calc.sizing.instruments import readings

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
