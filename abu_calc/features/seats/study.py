"""Bearing seats judged: interference, probability of clearance, what is required, what is permitted."""

from dataclasses import replace
from typing import Any, ClassVar

from abu_calc.features.seats.seats import BearingSeats, SeatResult, bearing_notes, seat_bearings
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.quantity import record
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
        ),
        # The other tables of a whole machine play no part here.
        provenance=replace(
            provenance, defaults=tuple(default for default in provenance.defaults if default[0].startswith("bearing["))
        ),
        seats=tuple(seat for bearing in judged for seat in bearing.seats),
        judged=judged,
    )


def judged_seats(machine: Machine) -> tuple[BearingSeats, ...]:
    """The bearings of a machine with their seats, in SI. Raises as `check_fit` does."""
    if not machine.tables.bearing:
        raise InputError(
            "the file has no bearings", place=Place(machine.file, key="bearing"), remedy="Add a table [[bearing]]."
        )
    with machine.located():
        return seat_bearings(machine.tables.bearing)
