"""A machine file as a whole, and the rules between its tables.

`larger_than_its_wheel` and `rim_too_fast` name numbers that do not go together, though each may stand alone.

Table of the type test that gives the declared vibration value of a hand-held grinder.

Table of identified values: intervals that `abu identify` found for entries of [autobalancer].

The tables [optimise] and [costs] of a file: what `abu optimise` may choose, and what each choice costs.
"""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import AfterValidator, BeforeValidator, Field, WithJsonSchema, model_validator

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.units import to_si
from abu_calc.foundation.validity import bounded
from abu_calc.inputs.autobalancer import Autobalancer, Oil
from abu_calc.inputs.bearing_file import EXPECTED, Expected, Limits
from abu_calc.inputs.body import MachineTable, Suspension
from abu_calc.inputs.duty import Grinding, Motor, RunUp, Start, SwingArm
from abu_calc.inputs.measured import MOST_MEASURED, MeasuredOctave
from abu_calc.inputs.reading.suggestions import nearest
from abu_calc.inputs.reading.table import Many, Table, Usual, all_tables, entry, problem, usual_of
from abu_calc.inputs.reading.text import key_path, shown_short
from abu_calc.inputs.reading.values_with_units import canonical_path, convert_entry, found_as, plain_number
from abu_calc.inputs.rolling_bearing import MOST_BEARINGS, Bearing
from abu_calc.inputs.variation import Sweep, Vary, path_of
from abu_calc.inputs.wheel import MeasuredAfter, Wheel

Angle = Annotated[float, Field(ge=-360, le=360)]


def _even(value: object) -> object:
    """A number of orientations as their angles, evenly spaced from 0."""
    if isinstance(value, int) and not isinstance(value, bool) and 1 <= value <= 360:
        return tuple(360.0 * k / value for k in range(value))
    return value


class TypeTest(Table):
    """Type test of `abu declare`: test wheel, orientations, runs, operators."""

    __test__: ClassVar[bool] = False  # not a test of pytest

    test_wheel_diameter_mm: float | None = entry(None, gt=0, le=1000, usual=(20, 300), example=150.0).means(
        "Diameter of the test wheel [mm]; {range}. The imbalance is built in for 25, 50, 80, 100, 125, 150 and 200 mm, "
        "and by a rule for 115, 180 and 230 mm. Without it: the diameter of the wheel."
    )
    test_wheel_imbalance_g_mm: float | None = entry(None, gt=0, le=1e6, usual=(2, 1000), example=65.0).means(
        "Imbalance of the test wheel [g·mm]; {range}. Without it: that of the test wheel of this diameter."
    )
    orientations: (
        Annotated[
            tuple[Angle, ...],
            Field(strict=False, min_length=1, max_length=360),
            BeforeValidator(
                _even,
                json_schema_input_type=Annotated[int, Field(ge=1, le=360)]
                | Annotated[tuple[Angle, ...], Field(min_length=1, max_length=360)],
            ),
        ]
        | None
    ) = entry(None, example=5).means(
        "Orientations of the test wheel on the spindle: their number, evenly spaced, or a list of angles [degrees]. "
        "Without it: 5."
    )
    runs: Annotated[int, Field(ge=1, le=1000)] = entry(1).means(
        "Starts at each orientation by each operator; 1 … 1000. Default: {default}."
    )
    operators: Annotated[int, Field(ge=1, le=100)] = entry(3).means("Operators; 1 … 100. Default: {default}.")
    background_a_hv_m_per_s2: float | None = entry(None, ge=0, le=1000, usual=(0.05, 20), example=1.0).means(
        "Weighted acceleration a_hv with a balanced wheel, of motor and gear [m/s²]; {range}. It is added to every "
        "value as energy. Without it: 0."
    )


Interval = Annotated[tuple[float, ...], Field(strict=False, min_length=2, max_length=2)]

NAMES: Final = {
    "rolling_drag_per_s": ("viscous drag rate", "1/s"),
    "rolling_friction_mm": ("lever arm", "mm"),
    "race_eccentricity_mm": ("race eccentricity", "mm"),
}
"""Identified entries of [autobalancer], their names and units."""


class Identified(Table):
    """Intervals of 95 % of entries of [autobalancer], as `abu identify` writes them."""

    starts: int | None = entry(None, ge=1, le=10_000, usual=(8, 1000), example=10).means(
        "Recorded starts behind the values; {range}."
    )
    rolling_drag_per_s: Interval | None = entry(None, example=[11.0, 14.0]).means(
        "Interval of autobalancer.rolling_drag_per_s [1/s]: [low, high]."
    )
    rolling_friction_mm: Interval | None = entry(None, example=[0.001, 0.003]).means(
        "Interval of autobalancer.rolling_friction_mm [mm]: [low, high]."
    )
    race_eccentricity_mm: Interval | None = entry(None, example=[0.008, 0.012]).means(
        "Interval of autobalancer.race_eccentricity_mm [mm]: [low, high]."
    )

    def intervals(self) -> dict[str, tuple[float, float]]:
        """Intervals by the entry of [autobalancer]."""
        given = {key: getattr(self, key) for key in NAMES}
        return {key: (value[0], value[1]) for key, value in given.items() if value is not None}

    @model_validator(mode="after")
    def _ascend(self) -> Self:
        for key, (low, high) in self.intervals().items():
            if not 0 < low <= high:
                raise problem(
                    "not an interval", key, found=f"[{low:g}, {high:g}]", allowed="[low, high], above 0 and ascending"
                )
        return self

    def in_force(self, values: object) -> dict[str, tuple[float, float]]:
        """Intervals that hold the value in force; one that was changed since is identified no more."""
        return {key: ends for key, ends in self.intervals().items() if ends[0] <= getattr(values, key) <= ends[1]}


def identified_note(identified: Identified | None, values: object) -> Iterator[str]:
    """Which values are identified, in a sentence; nothing if none is."""
    known = {} if identified is None else identified.in_force(values)
    if identified is None or not known:
        return
    told = (
        f"{NAMES[key][0]} {getattr(values, key):.4g} {NAMES[key][1]} ({low:.3g} … {high:.3g})"
        for key, (low, high) in known.items()
    )
    starts = "" if identified.starts is None else f" from {identified.starts} recorded starts"
    yield f"Identified values{starts} are used, with intervals of 95 %: {', '.join(told)}."


PARTS: Final = ("balls", "race", "housing", "oil")
"""Parts that machines of a family can share."""
Part = Literal["balls", "race", "housing", "oil"]
COST: Final = "a cost is a number of at least 0 for each unit of the value, or a list of [value, cost]"
MOST_COST: Final = 1e9


class Optimise(Table):
    """The cheapest design of a series, for `abu optimise`: values to choose from, and the wanted share."""

    choose: Vary | None = entry(None, example=["autobalancer.race_eccentricity_mm=choice(0.005, 0.010, 0.020)"]).means(
        "Values to choose from. Each is KEY=choice(A, B, …); KEY is one of this file. Or a table by key. Without it "
        "`abu optimise` takes balls, race, eccentricity, friction and viscous drag rate."
    )
    share: float = entry(0.95, ge=0.5, le=0.9999).means(
        "Share of machines built that must meet the limits; {range}. Default: {default}."
    )
    share_parts: Many[Part] | None = entry(None, example=["balls", "race"]).means(
        "Parts that several machines share: balls, race, housing, oil. Default: balls and race."
    )
    seed: int = entry(0, ge=0, le=2**31 - 2).means("Seed of the random numbers; {range}. Default: {default}.")


def _flat(costs: object) -> object:
    """Costs by key path; [costs.autobalancer] with ball_count in it says the same as "autobalancer.ball_count"."""
    if not isinstance(costs, dict):
        return costs
    return dict(_entries(costs))


def _entries(costs: dict[str, object], above: str = "") -> Iterator[tuple[str, object]]:
    for key, cost in costs.items():
        path = f"{above}.{key}" if above else str(key)
        if isinstance(cost, dict):
            yield from _entries(cost, path)
        else:
            yield path, cost


def _checked(costs: dict[str, object]) -> dict[str, object]:
    for key, cost in costs.items():
        pairs = cost if isinstance(cost, list) else [[None, cost]]
        if not pairs:
            raise problem(COST, key, found="an empty list")
        for pair in pairs:
            number = plain_number(pair[1]) if isinstance(pair, list) and len(pair) == 2 else None
            if number is None or not 0 <= number <= MOST_COST:
                raise problem(COST, key, found=found_as(pair if isinstance(cost, list) else cost))
        values = [pair[0] for pair in pairs if isinstance(pair, list)]
        if len({repr(value) for value in values}) < len(values):
            raise problem("a value has two costs", key, found=found_as(cost))
    return costs


def own_cost(written: str, cost: object, model: type[Table]) -> tuple[str, object]:
    """A key of [costs] and its cost, with the file's own key and values in its unit."""
    listed = cost if isinstance(cost, list) else []
    try:
        path = path_of(written)
        own = canonical_path(path, model)
        pairs = [[convert_entry(path, value, model, lambda _: Place())[1], each] for value, each in listed]
    except InputError as error:
        raise problem(error.message, "costs", written, found=error.found, allowed=error.allowed) from None
    if own is None:
        near = nearest(
            written, [key_path((*above, key)) for above, table in all_tables(model) for key in table.model_fields]
        )
        raise problem("no key of a machine", "costs", written, remedy=f'the nearest is "{near}"' if near else None)
    if own != path and not listed:
        remedy = f'write "{key_path(own)}", or a list of [value with unit, cost]'
        raise problem("a cost for each unit, and the key names no unit", "costs", written, remedy=remedy)
    return (written if own == path else key_path(own)), pairs or cost


COSTS: Final = (
    "Cost of each choice of `abu optimise`, in units of your own, by key path: a number for each unit of the value, or "
    "a list of [value, cost]; between listed numbers the cost is interpolated. Keys without an entry keep the default."
)
Costs = Annotated[
    dict[str, object],
    AfterValidator(_checked),
    BeforeValidator(_flat),
    WithJsonSchema({"type": "object"}),
]


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
