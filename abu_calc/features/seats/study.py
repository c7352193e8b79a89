"""Bearing seats judged: interference, probability of clearance, what is required, what is permitted."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, ClassVar, Final

from abu_calc.features.seats.clearance import PRELOADED
from abu_calc.features.seats.seats import BearingSeats, SeatResult, bearing_notes, seat_bearings
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.quantity import record
from abu_calc.foundation.units import shown
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.result import Provenance, Result


@record
class CheckFitResult(Result):
    """The seats of every bearing, in the order of the file: the shaft's, then the housing's."""

    command: ClassVar[str] = "check-fit"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"judged"}

    seats: tuple[SeatResult, ...]
    judged: tuple[BearingSeats, ...]
    """The same in SI, by bearing."""

    @classmethod
    def json_type(cls) -> Any:
        """A list of seats."""
        return tuple[SeatResult, ...]

    def to_dict(self) -> list[dict[str, Any]]:  # type: ignore[override]
        """The seats as JSON has them: check-fit answers a list."""
        return [seat.to_dict() for seat in self.seats]


@checked
def check_fit(machine: Machine) -> CheckFitResult:
    """Judge the seats of the bearings of a machine.

    Raises InputError with file, line, key and remedy for what is wrong in the file, and for one without bearings.
    """
    judged = judged_seats(machine)
    provenance = Provenance.of(machine)
    return CheckFitResult(
        title=machine.tables.machine.name,
        checks=tuple(check for bearing in judged for check in bearing.checks),
        warnings=(
            *machine.warnings,
            *bearing_notes(judged),
            *_run_out_notes(machine, judged),
        ),
        # The other tables of a whole machine play no part here.
        provenance=replace(
            provenance, defaults=tuple(default for default in provenance.defaults if default[0].startswith("bearing["))
        ),
        seats=tuple(seat for bearing in judged for seat in bearing.seats),
        judged=judged,
    )


def _run_out_notes(machine: Machine, judged: tuple[BearingSeats, ...]) -> Iterator[str]:
    """A floating outer ring beside the run-out of the spindle that an autobalancer leaves room for."""
    autobalancer = getattr(machine.tables, "autobalancer", None)
    if autobalancer is None:
        return
    first = autobalancer[0] if isinstance(autobalancer, tuple) else autobalancer
    for bearing in judged:
        housing = bearing.housing
        low, high = housing.at_work_um["hot"]
        float_um, asked_um = -low, 1e3 * first.race_eccentricity_mm
        spring = bearing.bearing.internal_clearance in PRELOADED
        if spring or not housing.needs_no_grip or bearing.bearing.drawn_cup or float_um <= asked_um:
            continue
        yield (
            f"{bearing.bearing.name}: the outer ring floats by {abs(min(high, 0.0)):.0f} … {float_um:.0f} µm hot, and "
            f"the spindle with it, while the autobalancer asks for at most {asked_um:.3g} µm off axis in all "
            "(race_eccentricity_mm). A spring or a pair under preload holds the ring; a closer class leaves less: "
            f"{_closer(bearing)}."
        )


CLOSER: Final = ("J7", "J6", "JS5")


def _closer(judged: BearingSeats) -> str:
    """Classes with the clearance that they leave hot."""
    joint = judged.housing.joint
    loss = joint.hottest.loss
    spans = ((name, joint.with_class(name).interference) for name in CLOSER)
    return ", ".join(f"{name} {shown(max(loss - each.smallest, 0.0), 'um', '.0f')}" for name, each in spans)


def judged_seats(machine: Machine) -> tuple[BearingSeats, ...]:
    """The bearings of a machine with their seats, in SI. Raises as `check_fit` does."""
    if not machine.tables.bearing:
        raise InputError(
            "the file has no bearings", place=Place(machine.file, key="bearing"), remedy="Add a table [[bearing]]."
        )
    with machine.located():
        return seat_bearings(machine.tables.bearing)
