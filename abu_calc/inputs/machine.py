"""A machine file as a whole, and the rules between its tables.

`larger_than_its_wheel` and `rim_too_fast` name numbers that do not go together, though each may stand alone.
"""

from collections.abc import Iterator
from typing import ClassVar, Final, Self

from pydantic import Field, model_validator

from abu_calc.foundation.units import to_si
from abu_calc.foundation.validity import bounded
from abu_calc.inputs.autobalancer import Autobalancer
from abu_calc.inputs.bearing_file import EXPECTED, Expected, Limits
from abu_calc.inputs.body import MachineTable, Suspension
from abu_calc.inputs.duty import Grinding, Motor, RunUp, Start, SwingArm
from abu_calc.inputs.identified import Identified
from abu_calc.inputs.measured import MOST_MEASURED, MeasuredOctave
from abu_calc.inputs.oil import Oil
from abu_calc.inputs.optimisation import COSTS, Costs, Optimise, own_cost
from abu_calc.inputs.reading.table import Many, Table, Usual, entry, problem, usual_of
from abu_calc.inputs.reading.text import shown_short
from abu_calc.inputs.rolling_bearing import MOST_BEARINGS, Bearing
from abu_calc.inputs.type_test import TypeTest
from abu_calc.inputs.variation import Sweep
from abu_calc.inputs.wheel import MeasuredAfter, Wheel

FASTEST_RIM: Final = 160.0
"""Few wheels may run faster [m/s]; hand grinders stay below 80, machines below 125 (EN 12413)."""
LARGEST_HAND_HELD: Final = 300.0
"""Diameter [mm] of the largest wheels on hand grinders."""


def larger_than_its_wheel(abu: "Autobalancer", wheel: "Wheel") -> Iterator[tuple[tuple[str, ...], str]]:
    """An autobalancer that may be larger than the wheel beside which it must vanish.

    Another unit is suggested only for a diameter that is unusual by itself: mounted points have 20 to 40 mm.
    """
    envelope, diameter = abu.max_outer_diameter_mm, wheel.diameter_mm
    if envelope <= diameter:
        return
    meant, usual = "", usual_of(Wheel.model_fields["diameter_mm"])
    if envelope <= LARGEST_HAND_HELD and not (usual and usual.holds(diameter)):
        from abu_calc.inputs.reading.suggestions import guesses, meant_in

        meant = meant_in(guesses("diameter_mm", [diameter], Usual(envelope, LARGEST_HAND_HELD)), " mm")
    yield (
        ("autobalancer", "max_outer_diameter_mm"),
        f"is unusual, larger than the wheel: wheel.diameter_mm = {bounded(diameter)}."
        + (f" The wheel's {meant}?" if meant else ""),
    )


def rim_too_fast(
    machine: "MachineTable", wheel: "Wheel", motor: "Motor | None"
) -> Iterator[tuple[tuple[str, ...], str]]:
    """A rim that runs faster than wheels bear, at the highest working speed or at the motor's no-load speed."""
    key = "speed_rpm" if machine.speed_range_rpm is None else "speed_range_rpm"
    path, speed = ("machine", key), machine.speeds_rpm[1]
    if motor is not None and motor.no_load_speed_rpm > speed:
        path, speed = ("motor", "no_load_speed_rpm"), motor.no_load_speed_rpm
    rim = to_si(speed, "rpm") * wheel.diameter / 2
    if rim <= FASTEST_RIM:
        return
    yield (
        path,
        f"is unusual with wheel.diameter_mm = {bounded(wheel.diameter_mm)}: the rim would run at {rim:.0f} m/s, up to "
        f"{FASTEST_RIM:g} m/s is usual.",
    )


class MachineFile(Table):
    """A machine and the autobalancer wanted for it."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"autobalancer"})

    machine: MachineTable
    suspension: Suspension
    wheel: Wheel
    measured_after: MeasuredAfter | None = None
    autobalancer: Autobalancer | None = None
    oil: Oil | None = None
    identified: Identified | None = None
    grinding: Grinding | None = None
    run_up: RunUp | None = None
    start: Start | None = None
    motor: Motor | None = None
    swing_arm: SwingArm | None = None
    bearing: Many[Bearing] = entry((), max_length=MOST_BEARINGS).means(
        "Bearings and their seats: [[bearing]], up to 100."
    )
    measured: Many[MeasuredOctave] = entry((), max_length=MOST_MEASURED).means(
        "Levels measured by octaves, for `abu factory`: [[measured]], up to 200."
    )
    limits: Limits = Field(default_factory=Limits)
    type_test: TypeTest | None = None
    sweep: Sweep | None = None
    optimise: Optimise | None = None
    costs: Costs = Field(default_factory=dict, description=COSTS)
    expected: Expected = Field(default_factory=dict, description=EXPECTED)

    def contradictions(self) -> Iterator[tuple[tuple[str, ...], str]]:
        """An autobalancer larger than the wheel, a rim faster than wheels bear."""
        if self.autobalancer is not None:
            yield from larger_than_its_wheel(self.autobalancer, self.wheel)
        if self.identified is not None and self.autobalancer is not None:
            held = self.identified.in_force(self.autobalancer)
            for key in self.identified.intervals().keys() - held.keys():
                value = getattr(self.autobalancer, key)
                yield ("identified", key), f"does not hold autobalancer.{key} = {bounded(value)}: it is not used."
        yield from rim_too_fast(self.machine, self.wheel, self.motor)

    @model_validator(mode="after")
    def _costs_are_of_keys(self) -> Self:
        own = [own_cost(key, cost, MachineFile) for key, cost in self.costs.items()]
        if len(dict(own)) < len(own):
            raise problem("a key has two costs", "costs", remedy="keep one of the two")
        self.costs.clear()
        self.costs.update(own)
        return self

    @model_validator(mode="after")
    def _oil_is_in_a_race(self) -> Self:
        if self.oil is None:
            return self
        if self.autobalancer is None:
            raise problem(
                "oil needs a race to be in",
                "oil",
                remedy="add [autobalancer] with max_outer_diameter_mm and max_width_mm, or remove [oil]",
            )
        self.autobalancer._drag_by_oil = True
        return self

    @model_validator(mode="after")
    def _identified_values_have_an_autobalancer(self) -> Self:
        if self.identified is not None and self.autobalancer is None:
            raise problem("there is no autobalancer whose values are identified", "identified")
        return self

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
            raise problem("the motor decides the run-up", *place, found=f"{pause:g} rpm beside [motor]",
                          remedy="leave one of them out")  # fmt: skip
        lowest = min(self.machine.speeds_rpm)
        if pause >= lowest:
            raise problem("the temporary speed reduction must be below the working speeds", *place,
                          found=f"{pause:g} rpm",
                          allowed=f"below {lowest:g} rpm",
                          remedy="set a speed at which the balls rest in the race")  # fmt: skip
        return self
