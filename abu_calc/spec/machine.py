"""A machine file as a whole, and the rules between its tables."""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Self

from pydantic import Field, model_validator

from abu_calc.spec.autobalancer import Autobalancer
from abu_calc.spec.bearing import MOST_BEARINGS, Bearing
from abu_calc.spec.bearing_file import (
    EXPECTED,
    BearingFile,
    Expected,
    Limits,
    MachineName,
    expected_tolerances,
    expected_values,
)
from abu_calc.spec.body import MachineTable, Suspension
from abu_calc.spec.duty import Grinding, Motor, RunUp, Start, SwingArm
from abu_calc.spec.measured import MeasuredAfter
from abu_calc.spec.proportions import larger_than_its_wheel, rim_too_fast
from abu_calc.spec.sweep import Sweep
from abu_calc.spec.table import Table, problem
from abu_calc.spec.text import shown_short
from abu_calc.spec.wheel import Wheel

__all__ = [
    "Autobalancer",
    "Bearing",
    "BearingFile",
    "Grinding",
    "Limits",
    "MachineFile",
    "MachineName",
    "MachineTable",
    "MeasuredAfter",
    "Motor",
    "RunUp",
    "Suspension",
    "SwingArm",
    "Wheel",
    "expected_tolerances",
    "expected_values",
]


class MachineFile(Table):
    """A machine and the autobalancer wanted for it."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"autobalancer"})

    machine: MachineTable
    suspension: Suspension
    wheel: Wheel
    measured_after: MeasuredAfter | None = None
    autobalancer: Autobalancer | None = None
    grinding: Grinding | None = None
    run_up: RunUp | None = None
    start: Start | None = None
    motor: Motor | None = None
    swing_arm: SwingArm | None = None
    bearing: Annotated[tuple[Bearing, ...], Field(strict=False, max_length=MOST_BEARINGS)] = Field(
        default=(), description="Bearings and their seats: [[bearing]], up to 100."
    )
    limits: Limits = Field(default_factory=Limits)
    sweep: Sweep | None = None
    expected: Expected = Field(default_factory=dict, description=EXPECTED)

    def contradictions(self) -> Iterator[tuple[tuple[str, ...], str]]:
        """An autobalancer larger than the wheel, a rim faster than wheels bear."""
        if self.autobalancer is not None:
            yield from larger_than_its_wheel(self.autobalancer, self.wheel)
        yield from rim_too_fast(self.machine, self.wheel, self.motor)

    @model_validator(mode="after")
    def _measured_at_a_handle(self) -> Self:
        names = [handle.name for handle in self.machine.handle]
        places = {"wheel": self.wheel.measured_at}
        if self.measured_after is not None:
            places["measured_after"] = self.measured_after.measured_at
        for table, place in places.items():
            if place is not None and place not in names:
                raise problem(
                    "no handle has this name",
                    table,
                    "measured_at",
                    found=shown_short(place),
                    allowed=", ".join(map(shown_short, names)) or "none, the file has no [[machine.handle]]",
                    remedy="name a handle, or leave measured_at out (the wheel plane)",
                )
        return self

    @model_validator(mode="after")
    def _motor_reaches_speed(self) -> Self:
        if self.motor is not None and self.motor.no_load_speed_rpm < self.machine.speed_rpm:
            raise problem(
                "the motor cannot reach machine.speed_rpm",
                "motor",
                "no_load_speed_rpm",
                found=f"{self.motor.no_load_speed_rpm:g} rpm",
                allowed=f"at least {self.machine.speed_rpm:g} rpm",
                remedy="give the no-load speed at the spindle",
            )
        return self

    @model_validator(mode="after")
    def _pauses_below_its_speed(self) -> Self:
        pause = None if self.run_up is None else self.run_up.pause_speed_rpm
        if pause is None:
            return self
        place = "run_up", "pause_speed_rpm"
        if self.motor is not None:
            raise problem("a motor sets its own pace", *place, found=f"{pause:g} rpm beside [motor]",
                          remedy="leave one of them out")  # fmt: skip
        lowest = min(self.machine.speed_range)
        if pause >= lowest:
            raise problem("the rotor pauses below its working speeds", *place, found=f"{pause:g} rpm",
                          allowed=f"below {lowest:g} rpm",
                          remedy="a speed at which the balls rest in the race")  # fmt: skip
        return self
