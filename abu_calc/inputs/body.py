"""Tables of the machine itself, of its suspension, and of the requirements on it."""

from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.foundation.units import to_si
from abu_calc.inputs.bearing_file import NAME
from abu_calc.inputs.reading.table import Many, Name, Table, boxed, entry, problem

MOST_HANDLES: Final = 100
Speed = Annotated[float, Field(ge=1, le=300_000)]
Length = Annotated[float, Field(ge=-10_000, le=10_000)]
Position = Annotated[tuple[Length, ...], Field(strict=False, min_length=3, max_length=3)]
Moment = Annotated[float, Field(gt=0, le=1e6)]
Frequency = Annotated[float, Field(gt=0, le=10_000)]
DampingRatio = Annotated[float, Field(ge=0, le=10)]


Held = Annotated[
    Literal["any", "as-given"] | None,
    Field(
        description="Whether the machine may be turned in use: any (its spindle may be horizontal or vertical) or "
        "as-given. Without it: any for hand tools; as-given with a swing arm, with two wheels, or with a natural "
        "frequency above 8 Hz.",
        examples=["any"],
    ),
]
"""Whether a machine may be turned in use."""


class Handle(Table):
    """A place where vibration levels are wanted; without any, levels are those in the wheel plane."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"from_center_of_mass_mm"})

    name: Name = Field(description="Name of the place, unique in the file.", examples=["front"], min_length=1)
    from_center_of_mass_mm: float | None = entry(None, ge=-2000, le=2000, usual=(5, 1000), example=100.0).means(
        "Place along the spindle axis, from the centre of mass, positive toward the wheel [mm]; {range}, at a grinder "
        "-300 … 200. Or position_mm."
    )

    position_mm: Position | None = entry(None, usual=(1, 1000), example=[62.0, 120.0, -8.0]).means(
        "Place [x, y, z] from the centre of mass [mm]; {range}. x runs from the body toward the spindle, z along the "
        "spindle toward the wheel. Takes the place of from_center_of_mass_mm."
    )

    @property
    def position(self) -> tuple[float, float, float]:
        """The place [m] from the centre of mass."""
        x, y, z = self.position_mm or (0.0, 0.0, self.from_center_of_mass_mm or 0.0)
        return to_si(x, "mm"), to_si(y, "mm"), to_si(z, "mm")

    @model_validator(mode="after")
    def _has_one_place(self) -> Self:
        given = [key for key in ("from_center_of_mass_mm", "position_mm") if getattr(self, key) is not None]
        if len(given) == 2:
            raise problem("a handle has one place", "position_mm", remedy="remove one of its two keys")
        if not given:
            raise problem(
                "missing: the place of the handle",
                "from_center_of_mass_mm",
                remedy="add from_center_of_mass_mm, or position_mm = [x, y, z]",
            )
        return self


class MachineTable(Table):
    """The machine: its mass, its speed, its shape."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"length_mm", "handle"})

    name: Name = Field(description=NAME, examples=["straight grinder"], min_length=1)
    layout: Literal["straight", "face", "angle"] = entry(example="straight").means(
        "Kind of machine: straight (the wheel's rim works, spindle along the body), face (the wheel's face works) or "
        "angle (spindle across the body)."
    )
    mass_kg: float = entry(ge=0.001, le=20_000, usual=(0.3, 150), example=5.6).means(
        "Mass with guard and handles, without wheel, autobalancer, cable or hose [kg]; {range}, hand grinders 1 … 8."
    )
    speed_rpm: Speed = entry(usual=(700, 60_000), example=5800.0).means(
        "Rated speed of the spindle [rpm]; {range}, hand grinders 1500 … 12000."
    )
    speed_range_rpm: Many[Speed] | None = entry(
        None, usual=(200, 60_000), example=[5800.0, 5800.0], min_length=2, max_length=2
    ).means(
        "Lowest and highest working speed, ascending, with the rated speed between them [rpm]; {range}. Frequency "
        "regions are checked over all of it, stresses at the top. Without it: the rated speed alone."
    )
    spindle_axis: Literal["horizontal", "vertical"] = entry(example="horizontal").means(
        "Direction of the spindle: horizontal (gravity acts in the plane of the balls) or vertical."
    )
    held: Held = None
    transverse_inertia_kg_m2: float | None = entry(None, gt=0, le=1e6, usual=(0.0005, 20), example=0.10).means(
        "Moment of inertia about the axis across the spindle through the centre of mass [kg·m²]; {range}, grinders "
        "0.02 … 0.3. With center_of_mass_to_wheel_mm the machine is a rigid body whose centre of mass lies on the "
        "spindle axis. Elsewhere: inertia_kg_m2, or length_mm for an estimate. Without any of them the machine is a "
        "point mass: an imbalance found from a level is uncertain by a factor of 2 to 3."
    )
    center_of_mass_to_wheel_mm: float | None = entry(None, ge=0, le=10_000, usual=(25, 1000), example=200.0).means(
        "Distance from the centre of mass to the wheel plane along the spindle [mm]; {range}, grinders 100 … 300. Goes "
        "with transverse_inertia_kg_m2."
    )
    center_of_mass_from_wheel_mm: Position | None = entry(None, usual=(1, 1000), example=[-95.0, 0.0, -48.0]).means(
        "From the wheel's centre to the centre of mass, [x, y, z] [mm]; {range}. x runs from the body toward the "
        "spindle, z along the spindle toward the wheel: an angle grinder has negative x and z. Wheel and autobalancer "
        "are on. Goes with inertia_kg_m2, or with length_mm for an estimate."
    )
    inertia_kg_m2: Many[Moment] | None = entry(
        None, usual=(0.0001, 20), example=[0.004, 0.02, 0.019], min_length=3, max_length=3
    ).means(
        "Moments of inertia about x, y, z through the centre of mass, of the machine as used [kg·m²]; {range}, "
        "grinders 0.004 … 0.3. The third holds the mass of what spins, not its spin. Goes with "
        "center_of_mass_from_wheel_mm. Without inertia, length_mm and height_mm give an estimate."
    )
    inertia_xz_kg_m2: float | None = entry(None, ge=-1e6, le=1e6, usual=(1e-5, 20), example=-0.0015).means(
        "Product of inertia J_xz = −∫xz dm [kg·m²]; {range}. Goes with inertia_kg_m2; default: 0."
    )
    rotor_polar_inertia_kg_m2: float | None = entry(None, ge=0, le=1e5, usual=(1e-6, 1), example=0.0004).means(
        "Polar moment of inertia of what spins with the spindle: wheel, flange, spindle [kg·m²]; {range}. Default: 0 "
        "with inertia_kg_m2, that of the wheel as a disk in an estimate."
    )
    length_mm: float | None = entry(None, gt=0, le=10_000, usual=(100, 1500), example=450.0).means(
        "Length for an estimate of the inertia [mm]; {range}. Layout straight: from the wheel plane to the rear end. "
        "Layout angle: from the spindle axis to the rear end."
    )
    height_mm: float | None = entry(None, gt=0, le=10_000, usual=(20, 1000), example=60.0).means(
        "Height for an estimate of the inertia [mm]; {range}. Layout face: from the wheel plane to the top. Layout "
        "angle: from the body's axis to the wheel plane; without it 0.22 of the length is assumed."
    )
    power_W: float | None = entry(None, gt=0, le=1e7, usual=(30, 30_000), example=1000.0).means(
        "Power of the motor [W]; {range}. When given, the cutting power f·N·v is checked against it."
    )
    background_level_db: float | None = entry(None, ge=0, le=200, usual=(60, 130), example=98.0).means(
        "Velocity level with a balanced wheel [dB re 5e-8 m/s]; {range}. When given, it is added as energy to every "
        "level."
    )
    handle: Many[Handle] = entry((), max_length=MOST_HANDLES).means(
        "Places where levels are wanted: [[machine.handle]], up to 100."
    )

    @property
    def speeds_rpm(self) -> tuple[float, float]:
        """Lowest and highest working speed [rpm]."""
        low, high = self.speed_range_rpm or (self.speed_rpm, self.speed_rpm)
        return low, high

    def own_defaults(self) -> dict[str, object]:
        """The range of speeds is the one default that another key makes."""
        derived = {} if self.speed_range_rpm else {"speed_range_rpm": self.speeds_rpm}
        return {**super().own_defaults(), **derived}

    @model_validator(mode="after")
    def _range_holds_rated_speed(self) -> Self:
        low, high = self.speeds_rpm
        if low > high:
            raise problem(
                "the speeds must ascend",
                "speed_range_rpm",
                found=f"[{low:g}, {high:g}]",
                remedy=f"write speed_range_rpm = [{high:g}, {low:g}]",
            )
        if not low <= self.speed_rpm <= high:
            raise problem(
                "the range must contain speed_rpm",
                "speed_range_rpm",
                found=f"[{low:g}, {high:g}] with speed_rpm = {self.speed_rpm:g}",
                remedy="widen speed_range_rpm or correct speed_rpm",
            )
        return self

    @model_validator(mode="after")
    def _rigid_body_is_whole(self) -> Self:
        pair = ("transverse_inertia_kg_m2", "center_of_mass_to_wheel_mm")
        absent = [key for key in pair if getattr(self, key) is None]
        if len(absent) == 1:
            present = pair[1 - pair.index(absent[0])]
            raise problem(
                f"{pair[0]} and {pair[1]} make a rigid body only together",
                present,
                remedy=f"add {absent[0]}, or leave {present} out (a point mass)",
            )
        if not absent:
            self._refuse_beside(pair[0], ("inertia_kg_m2", "center_of_mass_from_wheel_mm"))
        return self

    def _refuse_beside(self, key: str, others: tuple[str, ...]) -> None:
        for other in others:
            if getattr(self, other) is not None:
                raise problem(
                    f"{key} and {other} describe the body in two ways",
                    other,
                    remedy=f"leave {other} out, or both transverse_inertia_kg_m2 and center_of_mass_to_wheel_mm",
                )

    @model_validator(mode="after")
    def _body_in_space_is_whole(self) -> Self:
        inertia, center = self.inertia_kg_m2, self.center_of_mass_from_wheel_mm
        if inertia is not None and center is None:
            raise problem(
                "inertia_kg_m2 needs the place of the centre of mass",
                "inertia_kg_m2",
                remedy="add center_of_mass_from_wheel_mm = [x, y, z]",
            )
        if inertia is None and self.inertia_xz_kg_m2 is not None:
            raise problem(
                "inertia_xz_kg_m2 goes with inertia_kg_m2",
                "inertia_xz_kg_m2",
                remedy="add inertia_kg_m2 = [Jx, Jy, Jz], or leave inertia_xz_kg_m2 out",
            )
        if inertia is None and self.rotor_polar_inertia_kg_m2 is not None and not self.estimates:
            raise problem(
                "rotor_polar_inertia_kg_m2 acts only on a body in space",
                "rotor_polar_inertia_kg_m2",
                remedy="add inertia_kg_m2 or length_mm, or leave rotor_polar_inertia_kg_m2 out",
            )
        if inertia is None and center is not None and not self.estimates:
            raise problem(
                "the centre of mass makes a rigid body only with an inertia",
                "center_of_mass_from_wheel_mm",
                remedy="add inertia_kg_m2 = [Jx, Jy, Jz], or "
                + " and ".join(self._lengths_of_layout)
                + " (an estimate)",
            )
        return self

    @property
    def _lengths_of_layout(self) -> tuple[str, ...]:
        """Keys of the lengths from which an inertia is estimated; the height of an angle grinder may be missing."""
        return ("height_mm",) if self.layout == "face" else ("length_mm",)

    @property
    def estimates(self) -> bool:
        """True if the inertia is not given, and the lengths are that an estimate needs."""
        given = self.inertia_kg_m2 is not None or self.transverse_inertia_kg_m2 is not None
        return not given and all(getattr(self, key) is not None for key in self._lengths_of_layout)

    @model_validator(mode="after")
    def _handles_differ(self) -> Self:
        names = [handle.name for handle in self.handle]
        for index, name in enumerate(names):
            if name in names[:index]:
                raise problem(
                    f'two handles have the name "{name}"',
                    "handle",
                    index,
                    "name",
                    remedy="give each handle its own name",
                )
        return self


class Suspension(Table):
    """Support of the machine: springs, or two hands."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"natural_frequencies_hz", "damping_ratios"})

    model: Literal["springs", "hands"] = entry(example="springs").means(
        "springs (natural frequencies and damping ratios) or hands (two hands by ISO 10068; no numbers). At 5800 rpm "
        "springs of 2.5 Hz with damping ratio 0.5 stand for hands; at 1750 rpm the hands themselves matter."
    )
    natural_frequencies_hz: (
        Annotated[
            tuple[Frequency, ...],
            Field(strict=False, min_length=1, max_length=2),
            BeforeValidator(
                boxed,
                json_schema_input_type=Frequency | Annotated[tuple[Frequency, ...], Field(min_length=1, max_length=2)],
            ),
        ]
        | None
    ) = entry(None, usual=(0.2, 300), example=[2.5, 2.5]).means(
        "For springs: natural frequency, one number, or two along x (along the work) and y (normal to it) [Hz], "
        "{range}; of the machine as used, wheel on, idle, without autobalancer."
    )
    damping_ratios: (
        Annotated[
            tuple[DampingRatio, ...],
            Field(strict=False, min_length=1, max_length=2),
            BeforeValidator(
                boxed,
                json_schema_input_type=DampingRatio
                | Annotated[tuple[DampingRatio, ...], Field(min_length=1, max_length=2)],
            ),
        ]
        | None
    ) = entry(None, usual=(0.001, 2), example=[0.5, 0.5]).means(
        "For springs: damping ratio, one number, or two along x and y; {range}, hands 0.25 … 0.9."
    )

    @property
    def frequencies(self) -> tuple[float, float] | None:
        """Natural frequencies along x and y [Hz]; None for hands."""
        return pair(self.natural_frequencies_hz)

    @property
    def dampings(self) -> tuple[float, float] | None:
        """Damping ratios along x and y; None for hands."""
        return pair(self.damping_ratios)

    @classmethod
    def displaced_by(cls, key: str, value: object) -> tuple[str, ...]:
        """Hands bring their own numbers."""
        return ("natural_frequencies_hz", "damping_ratios") if (key, value) == ("model", "hands") else ()

    @model_validator(mode="after")
    def _numbers_go_with_springs(self) -> Self:
        given = [key for key in _EXAMPLE if getattr(self, key) is not None]
        missing = [key for key in _EXAMPLE if key not in given]
        if self.model == "springs" and missing:
            example = " and ".join(f"{key} = {_EXAMPLE[key]}" for key in missing)
            raise problem(f'model = "springs" needs {" and ".join(missing)}', missing[0], remedy=f"add {example}")
        if self.model == "hands" and given:
            raise problem(
                f'model = "hands" takes no {" and no ".join(given)}: its numbers are those of ISO 10068',
                given[0],
                remedy=f'leave {" and ".join(given)} out, or write model = "springs"',
            )
        return self


_EXAMPLE = {"natural_frequencies_hz": "[2.5, 2.5]", "damping_ratios": "[0.5, 0.5]"}


def pair(values: tuple[float, ...] | None) -> tuple[float, float] | None:
    """Values along x and y of one or two."""
    return (values[0], values[-1]) if values else None
