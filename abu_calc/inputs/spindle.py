"""A machine file with two races on one spindle: pedestal grinders, drums, rolls.

Wheels and autobalancers are lists there, each with its place along the spindle from the centre of mass.
"""

from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import Field, model_validator

from abu_calc.inputs.autobalancer import Autobalancer
from abu_calc.inputs.bearing_file import EXPECTED, NAME, Expected, Limits
from abu_calc.inputs.body import DampingRatio, Frequency, Handle, Held, Speed
from abu_calc.inputs.duty import Grinding, RunUp, Start
from abu_calc.inputs.reading.table import Name, Table, entry, problem
from abu_calc.inputs.rolling_bearing import MOST_BEARINGS, Bearing
from abu_calc.inputs.variation import Sweep
from abu_calc.inputs.wheel import QUANTITIES, Wheel

MOST_WHEELS: Final = 20
RACES: Final = 2
PLANE: Final = (
    "Place along the spindle, from the centre of mass [mm]; {range}. The same sense for wheels, races, bearings and "
    "handles."
)
Positive = Annotated[float, Field(gt=0, le=1e12)]
NotNegative = Annotated[float, Field(ge=0, le=1e9)]
Place = Annotated[float, Field(ge=-10_000, le=10_000)]


class PlacedWheel(Wheel):
    """A wheel, or any part with an imbalance of its own, at its place along the spindle."""

    plane_mm: float = entry(ge=-10_000, le=10_000, usual=(1, 3000), example=260.0).means(PLANE)
    name: Name | None = Field(default=None, description="Name of the wheel.", examples=["left wheel"], min_length=1)
    imbalance_angle_deg: float | None = entry(None, ge=-360, le=360, example=0.0).means(
        "Angle of the imbalance from the zero mark of the spindle [degrees]; {range}. Without it the phase is unknown, "
        "and the worst one is taken."
    )

    @model_validator(mode="after")
    def _imbalance_by_itself(self) -> Self:
        given = [key for key in QUANTITIES if getattr(self, key) is not None]
        if given:
            raise problem(
                "one measured value does not give the imbalances of two wheels",
                given[0],
                allowed="imbalance_g_mm or balance_grade",
                remedy="balance the machine in two planes (`abu balance`), and give each imbalance",
            )
        return self


class PlacedAutobalancer(Autobalancer):
    """An autobalancer at its place along the spindle."""

    plane_mm: float = entry(ge=-10_000, le=10_000, usual=(1, 3000), example=300.0).means(PLANE)

    plane_range_mm: Annotated[tuple[Place, ...], Field(strict=False, min_length=2, max_length=2)] | None = entry(
        None, example=[280.0, 320.0]
    ).means(
        "Stretch of the spindle on which the race may stand, with plane_mm in it [mm]; {range}. The place is searched "
        "there that leaves the loudest place least, and needs the smallest capacity. Without it: plane_mm."
    )

    @model_validator(mode="after")
    def _place_within_its_stretch(self) -> Self:
        if self.plane_range_mm is not None:
            low, high = self.plane_range_mm
            if not low <= self.plane_mm <= high:
                raise problem(
                    "the stretch must ascend and contain plane_mm", "plane_range_mm",
                    found=f"[{low:g}, {high:g}] with plane_mm = {self.plane_mm:g}",
                )  # fmt: skip
        return self

    @model_validator(mode="after")
    def _place_from_the_centre_of_mass(self) -> Self:
        if self.plane_offset_mm:
            raise problem(
                "with two races plane_mm alone gives the place of a race",
                "plane_offset_mm",
                found=f"{self.plane_offset_mm:g} mm",
                remedy="leave plane_offset_mm out",
            )
        return self


class TwoRaceMachineTable(Table):
    """The machine: its mass, inertia and speed."""

    name: Name = Field(description=NAME, examples=["pedestal grinder"], min_length=1)
    layout: Literal["straight", "face", "angle"] = entry("straight").means(
        "Kind of machine, as for one race: straight, face or angle. Default: {default}."
    )
    mass_kg: float = entry(ge=0.001, le=1e6, example=62.0).means(
        "Mass of all that moves with the spindle on its springs, with wheels, without autobalancers [kg]; {range}."
    )
    speed_rpm: Speed = Field(description="Rated speed of the spindle [rpm]; {range}.", examples=[2850.0])
    speed_range_rpm: Annotated[tuple[Speed, ...], Field(strict=False, min_length=2, max_length=2)] | None = entry(
        None, example=[2850.0, 2850.0]
    ).means("Lowest and highest working speed [rpm]; {range}. Without it: the rated speed alone.")
    spindle_axis: Literal["horizontal", "vertical"] = entry(example="horizontal").means(
        "Direction of the spindle: horizontal (gravity acts in the plane of the balls) or vertical."
    )
    held: Held = None
    transverse_inertia_kg_m2: float = entry(gt=0, le=1e6, example=3.1).means(
        "Moment of inertia across the spindle about the centre of mass, of all that mass_kg counts [kg·m²]; {range}."
    )
    rotor_polar_inertia_kg_m2: float = entry(0.0, ge=0, le=1e6, example=0.09).means(
        "Polar moment of inertia of what spins [kg·m²]; {range}, at most twice the transverse one. Default: {default}, "
        "which leaves gyroscopic moments out."
    )
    handle: Annotated[tuple[Handle, ...], Field(strict=False, max_length=100)] = entry(()).means(
        "Places on the spindle axis where levels are wanted: [[machine.handle]]. Without any: the bearings, or the "
        "races of a machine whose bearings are not given."
    )

    @property
    def speeds_rpm(self) -> tuple[float, float]:
        """Lowest and highest working speed [rpm]."""
        low, high = self.speed_range_rpm or (self.speed_rpm, self.speed_rpm)
        return low, high

    @model_validator(mode="after")
    def _is_a_body_at_its_speed(self) -> Self:
        if self.rotor_polar_inertia_kg_m2 > 2 * self.transverse_inertia_kg_m2:
            raise problem(
                "no body has such moments of inertia",
                "rotor_polar_inertia_kg_m2",
                found=f"{self.rotor_polar_inertia_kg_m2:g} kg·m²",
                allowed=f"at most {2 * self.transverse_inertia_kg_m2:g} kg·m²",
            )
        low, high = self.speeds_rpm
        if not low <= self.speed_rpm <= high:
            raise problem(
                "the range must ascend and contain speed_rpm",
                "speed_range_rpm",
                found=f"[{low:g}, {high:g}] with speed_rpm = {self.speed_rpm:g}",
            )
        for index, handle in enumerate(self.handle):
            if any(handle.position[:2]):
                raise problem(
                    "with two races handles lie on the spindle axis", "handle", index, "position_mm",
                    remedy="write from_center_of_mass_mm",
                )  # fmt: skip
        return self


class TwoRaceSuspension(Table):
    """Support of a machine with two races: bearings at their places, or springs for all freedoms alike."""

    model: Literal["bearings", "springs"] = entry(example="bearings").means(
        "bearings (places, stiffness and damping of each, alike along x and y) or springs (one natural frequency and "
        "damping ratio of translation and tilt)."
    )
    bearing_positions_mm: Annotated[tuple[Place, ...], Field(strict=False, min_length=1, max_length=20)] | None = entry(
        None, example=[200.0, -200.0]
    ).means("For bearings: places along the spindle, from the centre of mass [mm]; {range}.")
    bearing_stiffness_N_per_m: Annotated[tuple[Positive, ...], Field(strict=False, max_length=20)] | None = entry(
        None, example=[2.2e5, 2.2e5]
    ).means("For bearings: stiffness of each with what carries it [N/m]; {range}.")
    bearing_damping_N_s_per_m: Annotated[tuple[NotNegative, ...], Field(strict=False, max_length=20)] | None = entry(
        None, example=[300.0, 300.0]
    ).means("For bearings: damping of each [N·s/m]; {range}.")
    natural_frequencies_hz: Frequency | None = entry(None, example=5.0).means(
        "For springs: natural frequency of translation and tilt [Hz]; {range}."
    )
    damping_ratios: DampingRatio | None = entry(None, example=0.1).means(
        "For springs: damping ratio of translation and tilt; {range}."
    )

    KEYS: ClassVar = {
        "bearings": ("bearing_positions_mm", "bearing_stiffness_N_per_m", "bearing_damping_N_s_per_m"),
        "springs": ("natural_frequencies_hz", "damping_ratios"),
    }

    @property
    def frequencies(self) -> tuple[float, float] | None:
        """Natural frequencies of springs, of translation and tilt alike [Hz]."""
        return None if self.natural_frequencies_hz is None else (self.natural_frequencies_hz,) * 2

    @model_validator(mode="after")
    def _numbers_of_its_model(self) -> Self:
        for model, keys in self.KEYS.items():
            for key in keys:
                given = getattr(self, key) is not None
                if given != (model == self.model):
                    text = f'model = "{self.model}" {"takes no" if given else "needs"} {key}'
                    raise problem(text, key, remedy=f"{'leave it out' if given else 'add it'}, or change model")
        count = len(self.bearing_positions_mm or ())
        for key in self.KEYS["bearings"][1:]:
            values = getattr(self, key)
            if values is not None and len(values) != count:
                raise problem(
                    "one number for each bearing of bearing_positions_mm",
                    key,
                    found=str(len(values)),
                    allowed=str(count),
                )
        return self


class TwoRaceFile(Table):
    """A machine with two autobalancers on one spindle, and its wheels."""

    machine: TwoRaceMachineTable
    suspension: TwoRaceSuspension
    wheel: Annotated[tuple[PlacedWheel, ...], Field(strict=False, min_length=1, max_length=MOST_WHEELS)] = (
        entry().means("Wheels with their places: [[wheel]], one or more.")
    )
    autobalancer: Annotated[tuple[PlacedAutobalancer, ...], Field(strict=False, min_length=RACES, max_length=RACES)] = (
        Field(description="Autobalancers with their places: [[autobalancer]], two.")
    )
    grinding: Grinding | None = None
    run_up: RunUp | None = None
    start: Start | None = None
    bearing: Annotated[tuple[Bearing, ...], Field(strict=False, max_length=MOST_BEARINGS)] = entry(()).means(
        "Bearings and their seats, for `abu check-fit`: [[bearing]], up to 100."
    )
    limits: Limits = Field(default_factory=Limits)
    sweep: Sweep | None = None
    expected: Expected = Field(default_factory=dict, description=EXPECTED)

    oil: ClassVar[None] = None
    identified: ClassVar[None] = None
    """Tables of a machine with one race, which several races do not take."""

    @model_validator(mode="before")
    @classmethod
    def _as_many_as_there_must_be(cls, given: object) -> object:
        races = given.get("autobalancer") if isinstance(given, dict) else None
        if isinstance(races, dict) or (isinstance(races, (list, tuple)) and len(races) == 1):
            raise problem(
                "two wheels need two autobalancers", "autobalancer", found="one", allowed="two [[autobalancer]]",
                remedy="write [[autobalancer]] twice, each with plane_mm; for one race give one [wheel]",
            )  # fmt: skip
        if isinstance(races, (list, tuple)) and len(races) > RACES:
            raise problem(
                "too many autobalancers on one spindle", "autobalancer", found=f"{len(races)}",
                allowed="two [[autobalancer]]",
                remedy="two races balance a rigid spindle: keep the two that stand farthest apart",
            )  # fmt: skip
        return given

    @model_validator(mode="after")
    def _two_planes(self) -> Self:
        first, second = (race.plane_mm for race in self.autobalancer)
        if abs(first - second) < 1:
            raise problem(
                "both races lie in one plane", "autobalancer", 1, "plane_mm", found=f"{second:g} mm",
                allowed=f"at least 1 mm from autobalancer[0], {first:g} mm",
                remedy="two races in one plane balance no couple: move one, or use one race",
            )  # fmt: skip
        return self

    @model_validator(mode="after")
    def _one_ball_in_both(self) -> Self:
        first, second = self.autobalancer
        for key in ("corrector", "ball_material", "rolling_friction_mm", "race_eccentricity_mm", "ball_diameter_mm"):
            values = getattr(first, key), getattr(second, key)
            if values[0] != values[1] and None not in values:
                raise problem(
                    f"both races have the same {key}", "autobalancer", 1, key, found=f"{values[1]}",
                    allowed=f"{values[0]}, as in autobalancer[0]", remedy="balls of one lot serve both races",
                )  # fmt: skip
        return self
