"""Tables of a file of readings: the correction to make, the tolerance, and the file with its rules.

Tables of the rig and of the rotor with its correction planes.
"""

import math
from collections.abc import Iterator
from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.features.balancing.run_tables import EXAMPLE, Errors, Reading, Run, Trial, listed
from abu_calc.inputs.bearing_file import EXPECTED, Expected
from abu_calc.inputs.reading.table import Many, Name, Table, entry, problem, usual
from abu_calc.inputs.wheel import BalanceGrade

SupportMass = Annotated[float, Field(ge=0, le=1e6, json_schema_extra=usual(0.05, 20000))]
SupportStiffness = Annotated[float, Field(gt=0, le=1e12, json_schema_extra=usual(1000, 1e9))]
Length = Annotated[float, Field(ge=-100, le=100)]
Radius = Annotated[float, Field(gt=0, le=1e5, json_schema_extra=usual(5, 5000))]
Place = Annotated[float, Field(ge=-360, le=360)]
Places = Annotated[tuple[Place, ...], Field(strict=False, min_length=2, max_length=72)]

LENGTHS: Final = (
    "left_end_to_left_plane_m",
    "left_plane_to_centre_m",
    "centre_to_right_plane_m",
    "right_plane_to_right_end_m",
)
OF_THE_RIG: Final = ("mass_kg", "transverse_inertia_kg_m2", *LENGTHS)
"""Data of the roll that the equations of the rig need."""
ALIKE: Final = 1e-9
"""Places that differ by less, as directions, are one [rad]."""


class Rig(Table):
    """The rig: two supports that move to and fro on springs, at the rotor's bearings. Without it every plane needs a
    trial run.
    """

    left_support_mass_kg: SupportMass = entry(example=18.0).means("M1, what moves of the left support [kg]; {range}.")
    right_support_mass_kg: SupportMass = entry(example=21.0).means("M2, what moves of the right support [kg]; {range}.")
    left_stiffness_N_per_m: SupportStiffness = entry(example=3e5).means(
        "C1, stiffness of the left support [N/m]; {range}."
    )
    right_stiffness_N_per_m: SupportStiffness = entry(example=3.6e5).means(
        "C2, stiffness of the right support [N/m]; {range}."
    )
    damping_ratio: float = entry(0.0, ge=0, le=0.5, usual=(0.001, 0.3)).means(
        "Damping ratio of each support with the roll on it, the other support held; {range}. Default: {default}."
    )


class Rotor(Table):
    """The rotor, roll or screw, with its two correction planes and the metal there. The four lengths go along it from
    the left bearing to the right one. An overhung rotor has negative ones.
    """

    shown_in_template: ClassVar[frozenset[str]] = frozenset(
        {*OF_THE_RIG, "left_correction_radius_mm", "right_correction_radius_mm"}
    )

    name: Name = Field(default="roll", description="Name, as reports print it. Default: {default}.", min_length=1)
    mass_kg: float | None = entry(None, gt=0, le=1e6, usual=(0.1, 50000), example=64.0).means(
        "M3, mass of the roll [kg]; {range}."
    )
    transverse_inertia_kg_m2: float | None = entry(None, gt=0, le=1e9, usual=(1e-4, 1e6), example=9.5).means(
        "J3, moment of inertia about a transverse axis through the centre of mass [kg·m²]; {range}."
    )
    left_end_to_left_plane_m: Length | None = entry(None, usual=(0.01, 20), example=0.15).means(
        "a, from the left bearing to the left plane [m]; {range}. Negative: the plane is outside."
    )
    left_plane_to_centre_m: Length | None = entry(None, usual=(0.01, 20), example=0.52).means(
        "b, from the left plane to the centre of mass [m]; {range}. Negative: the centre of mass is left of it."
    )
    centre_to_right_plane_m: Length | None = entry(None, usual=(0.01, 20), example=0.61).means(
        "c, from the centre of mass to the right plane [m]; {range}. Negative: the centre of mass is right of it."
    )
    right_plane_to_right_end_m: Length | None = entry(None, usual=(0.01, 20), example=0.2).means(
        "d, from the right plane to the right bearing [m]; {range}. Negative: the plane is outside."
    )
    left_correction_radius_mm: Radius | None = entry(None, example=120.0).means(
        "R1, radius at which mass is removed or added in the left plane [mm]; {range}. Not with [single_plane]."
    )
    right_correction_radius_mm: Radius | None = entry(None, example=150.0).means(
        "R2, likewise in the right plane [mm]; {range}. Not with [single_plane]."
    )
    angle_marks: Literal["against", "with"] = entry("against").means(
        "Direction in which the angle marks of the rotor count from its zero mark: against rotation or with it. It "
        "holds for trial masses, places and the angles of the answer. Default: {default}."
    )
    max_removable_g: float | None = entry(None, ge=0, le=1e6, usual=(0.1, 10000), example=50.0).means(
        "Largest mass that may be removed in a plane [g]; {range}. Beyond that, mass is added opposite."
    )
    left_places_deg: Places | None = entry(None, example=[0.0, 120.0, 240.0]).means(
        "Left plane: the places where there is metal, such as screw flights or bolt holes, from the zero mark by "
        "angle_marks [degrees]; two or more, each {range}. Without it: anywhere."
    )
    right_places_deg: Places | None = entry(None, example=[60.0, 180.0, 300.0]).means(
        "Right plane, likewise [degrees]; each {range}. Without it: anywhere."
    )
    turns_from_left: Literal["counterclockwise", "clockwise"] = entry("counterclockwise").means(
        "How the roll turns, to one who stands at its left end: counterclockwise or clockwise. For the drawing alone. "
        "Default: {default}."
    )
    first_bending_speed_rpm: float | None = entry(None, gt=0, le=1e7, usual=(100, 1e6), example=9000.0).means(
        "Lowest speed at which the roll itself bends [rpm]; {range}. Without it: that of a solid steel bar of its mass "
        "and length."
    )

    def contradictions(self) -> Iterator[tuple[tuple[str, ...], str]]:
        """More inertia than the mass could have between the ends."""
        ends = [getattr(self, key) for key in LENGTHS]
        if self.mass_kg is None or self.transverse_inertia_kg_m2 is None or None in ends:
            return
        arms = (ends[0] + ends[1], ends[2] + ends[3])
        most = self.mass_kg * arms[0] * arms[1]
        if min(arms) > 0 and self.transverse_inertia_kg_m2 > most:
            yield (
                ("transverse_inertia_kg_m2",),
                f"is unusual: all of mass_kg at the two ends would have {most:.3g} kg·m².",
            )

    @property
    def lengths(self) -> tuple[float, float, float, float] | None:
        """a, b, c and d [m]; None if one is missing."""
        a, b, c, d = (getattr(self, key) for key in LENGTHS)
        return None if a is None or b is None or c is None or d is None else (a, b, c, d)

    @model_validator(mode="after")
    def _has_two_planes(self) -> Self:
        b, c = self.left_plane_to_centre_m, self.centre_to_right_plane_m
        if b is not None and c is not None and b + c <= 0:
            same = b + c == 0
            raise problem(
                "the two planes coincide: they cannot be distinguished" if same else "the left plane is the right one",
                "centre_to_right_plane_m",
                found=f"b + c = {b + c:g} m",
                allowed="b + c above 0 m",
                remedy="a thin rotor is balanced in one plane: [single_plane]" if same else "exchange the planes",
            )
        if self.lengths is not None and sum(self.lengths) <= 0:
            raise problem(
                "the left bearing is not left of the right one", "right_plane_to_right_end_m",
                found=f"a + b + c + d = {sum(self.lengths):g} m", allowed="above 0 m", remedy="correct the lengths",
            )  # fmt: skip
        return self

    @model_validator(mode="after")
    def _places_span_the_plane(self) -> Self:
        for key in ("left_places_deg", "right_places_deg"):
            refuse_one_line(getattr(self, key), key)
        return self


def refuse_one_line(places: tuple[float, ...] | None, key: str) -> None:
    """Raise a problem if places lie on one line through the axis."""
    turned = [math.radians(2 * (place - places[0])) for place in places or ()] if places else []
    if places and all(abs(math.sin(angle / 2)) < ALIKE for angle in turned):
        raise problem(
            "the places lie on one line: a mass at any other angle cannot be split over them",
            key,
            found=", ".join(f"{place:g}°" for place in places),
            remedy="give places at two angles that are not opposite",
        )


class SinglePlane(Table):
    """One correction plane, for thin rotors such as fans and grinding wheels. It takes the place of the two planes of
    [rotor].
    """

    correction_radius_mm: Radius = entry(example=120.0).means("Radius at which mass is removed or added [mm]; {range}.")
    places_deg: Places | None = entry(None, example=[0.0, 120.0, 240.0]).means(
        "Places where there is metal, such as blades, from the zero mark by rotor.angle_marks [degrees]; two or more, "
        "each {range}. Without it: anywhere."
    )

    @model_validator(mode="after")
    def _places_span_the_plane(self) -> Self:
        refuse_one_line(self.places_deg, "places_deg")
        return self


__all__ = ["Errors", "Reading", "ReadingsFile", "Rig", "Rotor", "Run", "SinglePlane", "Tolerance", "Trial"]

Weight = Annotated[float, Field(gt=0, le=1e6)]

PLANES: Final = ("left", "right")
"""Names of two planes, and of two sensors."""
DENSITIES: Final = {
    "steel": 7850.0,
    "cast iron": 7200.0,
    "aluminium": 2700.0,
    "brass": 8500.0,
    "bronze": 8800.0,
    "titanium": 4430.0,
}
"""Densities of materials that are drilled [kg/m³], usual values."""


class Correction(Table):
    """How the correction is made, and whether masses that are fitted already stay."""

    answer: Literal["trim", "total"] = entry("trim").means(
        "trim: the correction comes in addition to the fitted masses. total: it takes the place of the fitted masses. "
        "Default: {default}."
    )
    fitted: Annotated[
        tuple[Trial, ...],
        Field(strict=False, max_length=100),
        BeforeValidator(listed, json_schema_input_type=Trial | Annotated[tuple[Trial, ...], Field(max_length=100)]),
    ] = entry(()).means(
        "Correction masses that were fitted in all runs, as trial: plane, mass_g, angle_deg. A negative mass is metal "
        "that was removed."
    )
    max_added_g: float | None = entry(None, ge=0, le=1e6, usual=(0.1, 10000), example=100.0).means(
        "Largest mass that may be added in a plane [g]; {range}."
    )
    max_per_place_g: float | None = entry(None, gt=0, le=1e6, usual=(0.1, 10000), example=20.0).means(
        "Largest mass that may be removed or added at one place [g]; {range}. More is split over several places."
    )
    stock_weights_g: Many[Weight] | None = entry(None, example=[5.0, 10.0, 20.0], min_length=1, max_length=20).means(
        "Weights in stock, of which any number may be added [g]; one or more, each {range}."
    )
    drill_diameter_mm: float | None = entry(None, gt=0, le=1000, usual=(1, 100), example=10.0).means(
        "Diameter of the holes that remove mass [mm]; {range}. The report then gives their depth."
    )
    drill_direction: Literal["axial", "radial"] | None = entry(None, example="axial").means(
        "axial: the middle of a hole is at the correction radius. radial: a hole begins there and goes inward. Without "
        "it: axial."
    )
    drill_point_deg: float | None = entry(None, ge=60, le=180, example=118.0).means(
        "Angle of the drill's point [degrees]; {range}. The depth counts to the tip. Without it: 180, a flat bottom."
    )
    max_hole_depth_mm: float | None = entry(None, gt=0, le=1000, usual=(1, 200), example=15.0).means(
        "Largest depth of a hole [mm]; {range}. More mass is split over several holes."
    )
    hole_spacing_mm: float | None = entry(None, gt=0, le=1e4, usual=(2, 500), example=15.0).means(
        "Distance of neighbouring holes or weights along the circle, centre to centre [mm]; {range}. Without it: one "
        "and a half diameters of the drill."
    )
    material: Literal["steel", "cast iron", "aluminium", "brass", "bronze", "titanium"] | None = entry(
        None, example="steel"
    ).means("Material that is drilled. Without it: steel.")
    density_kg_per_m3: float | None = entry(None, gt=0, le=30000, usual=(1000, 20000), example=7850.0).means(
        "Density of the material that is drilled [kg/m³]; {range}. Without it: the usual one of material."
    )

    def unused(self) -> frozenset[str]:
        """Keys of the drill without a drill."""
        if self.drill_diameter_mm is not None:
            return frozenset({"material"}) if self.density_kg_per_m3 is not None else frozenset()
        return frozenset({"drill_direction", "drill_point_deg", "material", "density_kg_per_m3", "max_hole_depth_mm"})

    @property
    def density(self) -> float:
        """Density of the material [kg/m³]."""
        return DENSITIES[self.material or "steel"] if self.density_kg_per_m3 is None else self.density_kg_per_m3

    @model_validator(mode="after")
    def _drills_or_adds(self) -> Self:
        if self.drill_diameter_mm is not None and self.stock_weights_g is not None:
            raise problem(
                "holes remove mass and stock weights add it: one of them is wanted", "stock_weights_g",
                remedy="leave stock_weights_g out, or drill_diameter_mm",
            )  # fmt: skip
        return self


class Tolerance(Table):
    """Limits of the balanced roll."""

    balance_grade: BalanceGrade | None = entry(None, example="G6.3").means(
        "Balance quality grade by ISO 21940-11, of rotor.mass_kg at service_speed_rpm: G4000 … G0.4."
    )
    service_speed_rpm: float | None = entry(None, gt=0, le=1e6, usual=(10, 60000), example=3000.0).means(
        "Highest speed in service [rpm]; {range}. Without it: the highest of the runs."
    )


class ReadingsFile(Table):
    """Readings of a rotor on a rig or in the field, for balancing in one plane or in two."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"rig", "rotor", "errors", "correction"})

    rig: Rig | None = None
    rotor: Rotor = Field(default_factory=Rotor)
    single_plane: SinglePlane | None = None
    run: Many[Run] = entry(min_length=1, max_length=1000).means("Runs: [[run]], one or more.")
    correction: Correction = Field(default_factory=Correction)
    errors: Errors = Field(default_factory=Errors)
    tolerance: Tolerance = Field(default_factory=Tolerance)
    expected: Expected = Field(default_factory=dict, description=EXPECTED)

    @property
    def planes(self) -> tuple[str, ...]:
        """Names of the correction planes."""
        return PLANES if self.single_plane is None else ("single",)

    @property
    def radii(self) -> tuple[float, ...]:
        """Correction radius [m] of each plane."""
        if self.single_plane is not None:
            return (self.single_plane.correction_radius,)
        return self.rotor.left_correction_radius or 0.0, self.rotor.right_correction_radius or 0.0

    @property
    def places_deg(self) -> tuple[tuple[float, ...] | None, ...]:
        """Places of each plane; None: anywhere."""
        if self.single_plane is not None:
            return (self.single_plane.places_deg,)
        return self.rotor.left_places_deg, self.rotor.right_places_deg

    @model_validator(mode="after")
    def _the_planes_are_known(self) -> Self:
        radii = ("left_correction_radius_mm", "right_correction_radius_mm")
        for key in radii:
            given = getattr(self.rotor, key) is not None
            if self.single_plane is None and not given:
                raise problem(
                    "the key is missing", "rotor", key, remedy=f"add {key} = …, or [single_plane] with its radius"
                )
            if self.single_plane is not None and given:
                raise problem(
                    "[single_plane] has its own radius", "rotor", key, remedy=f"leave {key} out, or [single_plane]"
                )
        for path, trial in self._masses():
            if self.single_plane is None and trial.plane is None:
                raise problem("the key is missing", *path, "plane", remedy='add plane = "left" or "right"')
            if self.single_plane is not None and trial.plane is not None:
                raise problem("there is a single plane", *path, "plane", remedy="leave plane out")
        return self

    def _masses(self) -> Iterator[tuple[tuple[str | int, ...], Trial]]:
        for index, run in enumerate(self.run):
            for number, trial in enumerate(run.trial):
                yield ("run", index, "trial", number), trial
        for number, trial in enumerate(self.correction.fitted):
            yield ("correction", "fitted", number), trial

    @model_validator(mode="after")
    def _the_rig_has_its_roll(self) -> Self:
        if self.rig is not None and self.single_plane is not None:
            raise problem(
                "the equations of [rig] are those of two planes", "single_plane",
                remedy="leave [rig] out, and make a run with a trial mass",
            )  # fmt: skip
        for key in OF_THE_RIG if self.rig is not None else ():
            if getattr(self.rotor, key) is None:
                raise problem("[rig] needs the key", "rotor", key, remedy=f"add {key} = …, or leave [rig] out")
        if self.tolerance.balance_grade is not None and self.rotor.mass_kg is None:
            raise problem("a balance grade needs the key", "rotor", "mass_kg", remedy="add mass_kg = …")
        return self

    @model_validator(mode="after")
    def _all_runs_have_the_same_sensors(self) -> Self:
        first = None
        for index, run in enumerate(self.run):
            if self.rig is not None and run.readings:
                raise problem(
                    "the equations of [rig] need a left and a right sensor", "run", index, "readings",
                    remedy="give left and right, or leave [rig] out",
                )  # fmt: skip
            if self.single_plane is None and run.file is None and not run.readings:
                for key in PLANES:
                    if getattr(run, key) is None:
                        raise problem(
                            "the key is missing", "run", index, key,
                            remedy=f"add {key} = {EXAMPLE}, or file, a recorded run",
                        )  # fmt: skip
            names = tuple(name for name, _ in run.sensors) if run.file is None else PLANES
            first = first or names
            if names != first:
                raise problem(
                    "all runs need the same sensors in the same order", "run", index, found=", ".join(names),
                    allowed=", ".join(first), remedy="give each run a reading of each sensor",
                )  # fmt: skip
        return self

    @model_validator(mode="after")
    def _all_readings_have_a_phase_or_none(self) -> Self:
        phases = [
            ((*(("run", index, "readings", number) if run.readings else ("run", index, name)), "phase_deg"), reading)
            for index, run in enumerate(self.run)
            for number, (name, reading) in enumerate(run.sensors)
        ]
        without = [path for path, reading in phases if reading.phase_deg is None]
        recorded = any(run.file is not None for run in self.run)
        if without and (recorded or len(without) < len(phases)):
            raise problem(
                "some readings have a phase and some have none", *without[0], remedy="add phase_deg = … everywhere, "
                "or leave it out everywhere and balance one plane without phase",
            )  # fmt: skip
        if without and self.single_plane is None:
            raise problem(
                "without phase one plane can be balanced, not two", *without[0],
                remedy="add phase_deg = …, or [single_plane]",
            )  # fmt: skip
        return self
