"""A rolling bearing and its two seats."""

import itertools
from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import Field, model_validator

from abu_calc.spec.table import Name, Table, problem
from abu_calc.spec.usual import usual

MOST_BEARINGS: Final = 100
"""In one file; the longest report on them takes some seconds."""
SIZES: Final = ("bore_mm", "outer_mm", "width_mm")
RingLoad = Literal["rotating", "stationary", "indeterminate"]


class Bearing(Table):
    """A rolling bearing and its two seats, checked by `abu check-fit`."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"designation"})

    name: Name = Field(
        default="bearing",
        description="Name of the bearing, as reports print it. Default: {default}.",
        examples=["spindle, drive end"],
        min_length=1,
    )
    designation: Name | None = Field(
        default=None,
        description="Designation whose sizes are looked up, in quotes; or give bore_mm, outer_mm and width_mm.",
        examples=["6203"],
        min_length=1,
    )
    bore_mm: float | None = Field(
        default=None,
        description="Bore of the bearing [mm]; {range}.",
        examples=[17.0],
        gt=0,
        le=5000,
        json_schema_extra=usual(3, 500),
    )
    outer_mm: float | None = Field(
        default=None,
        description="Outer diameter of the bearing [mm]; above bore_mm, up to {most}, {usual}.",
        examples=[40.0],
        gt=0,
        le=8000,
        json_schema_extra=usual(8, 800),
    )
    width_mm: float | None = Field(
        default=None,
        description="Width of the ring [mm]; {range}.",
        examples=[12.0],
        gt=0,
        le=2000,
        json_schema_extra=usual(2, 300),
    )
    chamfer_mm: float | None = Field(
        default=None,
        description="Chamfer of one edge; the seat is as long as the width less two of them [mm]; {range}.",
        examples=[0.6],
        ge=0,
        le=100,
        json_schema_extra=usual(0.1, 10),
    )
    radial_load_kN: float | None = Field(
        default=None,
        description="Radial load [kN]; {range}. Without it whether a ring creeps is not known.",
        examples=[0.8],
        ge=0,
        le=1e5,
        json_schema_extra=usual(0.01, 300),
    )
    series: Literal["light", "medium", "heavy"] = Field(
        default="light", description="Series of the bearing: light, medium or heavy. Default: {default}."
    )
    inner_ring_load: RingLoad = Field(
        default="rotating",
        description="How the load meets the inner ring: rotating, stationary or indeterminate. Default: {default}, "
        "as of a turning shaft.",
    )
    outer_ring_load: RingLoad = Field(
        default="stationary",
        description="How the load meets the outer ring: rotating, stationary or indeterminate. Default: {default}.",
    )
    bearing_class: Literal["0", "6", "5", "4", "2"] = Field(
        default="0",
        description='Accuracy class of the bearing, in quotes: "0", "6", "5", "4" or "2" (ISO 492 Normal, P6, P5, '
        'P4, P2). Default: "{default}".',
    )
    shaft_fit: str = Field(
        default="k6",
        description="Tolerance class of the shaft by ISO 286, small letters. Default: {default}.",
        pattern=r"^[a-z]{1,2}[0-9]{1,2}$",
    )
    housing_fit: str = Field(
        default="H7",
        description="Tolerance class of the housing by ISO 286, capital letters. Default: {default}.",
        pattern=r"^[A-Z]{1,2}[0-9]{1,2}$",
    )
    shaft_rz_um: float | None = Field(
        default=None,
        description="Roughness Rz of the shaft [µm]; {range}. When given, its smoothing is taken off the interference.",
        examples=[4.0],
        ge=0,
        le=1000,
        json_schema_extra=usual(0.1, 50),
    )
    housing_rz_um: float | None = Field(
        default=None,
        description="Roughness Rz of the housing [µm]; {range}. When given, its smoothing is taken off the "
        "interference.",
        examples=[6.3],
        ge=0,
        le=1000,
        json_schema_extra=usual(0.1, 50),
    )
    ring_temperature_difference_K: float | None = Field(
        default=None,
        description="By how much the inner ring is warmer than its shaft [K]; {range}. When given, the loss of "
        "interference α·d·ΔT is counted.",
        examples=[10.0],
        ge=0,
        le=500,
        json_schema_extra=usual(0.1, 100),
    )
    speed_rpm: float | None = Field(
        default=None,
        description="Speed of the shaft with the inner ring [rpm]; {range}. When given, the loss of interference by "
        "centrifugal growth is counted.",
        examples=[5800.0],
        ge=0,
        le=300_000,
        json_schema_extra=usual(10, 60_000),
    )
    shaft_bore_mm: float | None = Field(
        default=None,
        description="Bore of a hollow shaft, for stresses [mm]; 0 (solid) up to the bearing's bore, {usual}.",
        examples=[0.0],
        ge=0,
        le=5000,
        json_schema_extra=usual(1, 500),
    )
    housing_outer_mm: float | None = Field(
        default=None,
        description="Outer diameter of the housing, for stresses [mm]; above that of the bearing, up to {most}, "
        "{usual}.",
        examples=[60.0],
        gt=0,
        le=20_000,
        json_schema_extra=usual(10, 2000),
    )
    housing_material: Literal["steel", "cast-iron", "aluminium"] = Field(
        default="steel",
        description="Material of the housing, for stresses: steel, cast-iron or aluminium. Default: {default}.",
    )
    internal_clearance: Literal["C2", "CN", "C3", "C4"] | None = Field(
        default=None,
        description="Group of radial clearance of a deep groove ball bearing: C2, CN, C3 or C4 (ISO 5753-1). When "
        "given, the clearance left after mounting is checked.",
        examples=["C3"],
    )
    raceway_temperature_difference_K: float | None = Field(
        default=None,
        description="By how much the inner ring is warmer than the outer one [K]; {range}. When given, it is taken "
        "off the clearance left.",
        examples=[5.0],
        ge=0,
        le=500,
        json_schema_extra=usual(0.1, 60),
    )
    starting_torque_N_m: float | None = Field(
        default=None,
        description="Torque that a ring under a rotating load must pass on by friction when the machine starts "
        "[N·m]; {range}. When given, the seat's friction torque is checked against it.",
        examples=[2.0],
        ge=0,
        le=1e7,
        json_schema_extra=usual(0.01, 5000),
    )
    seat_friction: float = Field(
        default=0.12,
        description="Coefficient of friction between ring and seat; {range}. Default: {default}, assumed (steel on "
        "steel).",
        ge=0,
        le=1,
        json_schema_extra=usual(0.05, 0.3),
    )
    asked_interference_um: Annotated[tuple[float, ...], Field(strict=False, min_length=2, max_length=2)] | None = Field(
        default=None,
        description="Least and largest interference asked of the pairs, ascending, tight positive [µm], {usual} either "
        "way. When given, "
        "the groups for selective assembly are given.",
        examples=[[10.0, 28.0]],
        json_schema_extra=usual(1, 300),
    )

    @classmethod
    def displaced_by(cls, key: str, value: object) -> tuple[str, ...]:
        """A designation takes the place of sizes, and sizes that of a designation."""
        if key == "designation":
            return (*SIZES, "chamfer_mm")
        return ("designation",) if key in SIZES else ()

    def unused(self) -> frozenset[str]:
        """The material of a housing whose stresses are not asked for, the friction without a starting torque."""
        silent = {"housing_material": self.housing_outer_mm, "seat_friction": self.starting_torque_N_m}
        return frozenset(key for key, asked in silent.items() if asked is None)

    @model_validator(mode="after")
    def _sized_one_way(self) -> Self:
        given = [key for key in SIZES if getattr(self, key) is not None]
        if self.designation is not None and given:
            raise problem(
                f"designation and {given[0]} both size the bearing",
                given[0],
                remedy="keep the designation, or the sizes (the designation may stand in name)",
            )
        absent = [key for key in SIZES if key not in given]
        if self.designation is None and absent:
            raise problem(
                "the bearing has no size" if not given else "the bearing's size is not whole",
                absent[0],
                found=" and ".join(given) or "none",
                allowed="designation, or all of " + ", ".join(SIZES),
                remedy=f"add {' and '.join(absent)}" if given else 'add designation = "…"',
            )
        return self

    @model_validator(mode="after")
    def _band_ascends(self) -> Self:
        band = self.asked_interference_um
        if band is not None and not band[0] < band[1]:
            raise problem(
                "the band of interference must ascend",
                "asked_interference_um",
                found=f"[{band[0]:g}, {band[1]:g}]",
                remedy="write the least first",
            )
        return self

    @model_validator(mode="after")
    def _sizes_nest(self) -> Self:
        ascending = ("shaft_bore_mm", "bore_mm", "outer_mm", "housing_outer_mm")
        known = [(key, value) for key in ascending if (value := getattr(self, key)) is not None]
        for (inner, small), (outer, large) in itertools.pairwise(known):
            if small >= large:
                raise problem(
                    f"{outer} must be above {inner}", outer, found=f"{outer} = {large:g}, {inner} = {small:g}"
                )
        if self.chamfer_mm is not None and self.width_mm is not None and 2 * self.chamfer_mm >= self.width_mm:
            raise problem(
                "two chamfers leave no seat",
                "chamfer_mm",
                found=f"chamfer_mm = {self.chamfer_mm:g}, width_mm = {self.width_mm:g}",
                allowed="chamfer_mm below half of width_mm",
            )
        return self
