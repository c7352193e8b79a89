"""A rolling bearing and its two seats."""

import itertools
from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import Field, model_validator

from abu_calc.spec.rolling_bearing import SIZES, RollingBearing
from abu_calc.spec.table import problem
from abu_calc.spec.usual import usual

MOST_BEARINGS: Final = 100
"""Most bearings in one file; the longest report on them takes some seconds."""
SeatMaterial = Literal["steel", "stainless-steel", "cast-iron", "aluminium", "magnesium"]
Pair = Annotated[tuple[float, ...], Field(strict=False, min_length=2, max_length=2)]


class Bearing(RollingBearing):
    """A rolling bearing and its two seats, checked by `abu check-fit`."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"designation"})

    shaft_fit: str | None = Field(
        default=None,
        description="Tolerance class of the shaft by ISO 286, small letters. Without it the answer is which to write.",
        examples=["k6"],
        pattern=r"^[a-z]{1,2}[0-9]{1,2}$",
    )
    housing_fit: str | None = Field(
        default=None,
        description="Tolerance class of the housing by ISO 286, capital letters. Without it the answer is which to "
        "write.",
        examples=["H7"],
        pattern=r"^[A-Z]{1,2}[0-9]{1,2}$",
    )
    shaft_limits_um: Pair | None = Field(
        default=None,
        description="Least and largest deviation of the shaft from its nominal size as measured [µm], {usual} either "
        "way. In place of shaft_fit, which may stand beside it as what the drawing asks for.",
        examples=[[2.0, 21.0]],
        json_schema_extra=usual(0.1, 500),
    )
    housing_limits_um: Pair | None = Field(
        default=None,
        description="Least and largest deviation of the housing from its nominal size as measured [µm], {usual} either "
        "way. In place of housing_fit, which may stand beside it as what the drawing asks for.",
        examples=[[0.0, 25.0]],
        json_schema_extra=usual(0.1, 500),
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
        description="By how much the inner ring is warmer than its shaft, negative when colder [K]; {range}. When "
        "given, the loss of interference α·d·ΔT is counted.",
        examples=[10.0],
        ge=-500,
        le=500,
        json_schema_extra=usual(0.1, 100),
    )
    housing_temperature_difference_K: float | None = Field(
        default=None,
        description="By how much the housing is warmer than the outer ring, negative when colder [K]; {range}. When "
        "given, the loss of interference α·D·ΔT is counted.",
        examples=[-5.0],
        ge=-500,
        le=500,
        json_schema_extra=usual(0.1, 100),
    )
    temperature_rise_K: float | None = Field(
        default=None,
        description="By how much the bearing is warmer in service than at mounting (20 °C), negative when colder [K]; "
        "{range}. When given, shafts and housings that expand otherwise than steel lose or gain interference by it.",
        examples=[40.0],
        ge=-300,
        le=500,
        json_schema_extra=usual(0.1, 150),
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
    shaft_material: SeatMaterial = Field(
        default="steel",
        description="Material of the shaft, for stresses and warmth: steel, stainless-steel, cast-iron, aluminium or "
        "magnesium. Default: {default}.",
    )
    housing_material: SeatMaterial = Field(
        default="steel",
        description="Material of the housing, for stresses and warmth: steel, stainless-steel, cast-iron, aluminium or "
        "magnesium. Default: {default}.",
    )
    shaft_strength_MPa: float | None = Field(
        default=None,
        description="Hoop stress that the shaft bears [MPa]; {range}. Default: a low one of its material, assumed.",
        examples=[300.0],
        gt=0,
        le=10_000,
        json_schema_extra=usual(30, 2000),
    )
    housing_strength_MPa: float | None = Field(
        default=None,
        description="Hoop stress that the housing bears [MPa]; {range}. Default: a low one of its material, assumed.",
        examples=[200.0],
        gt=0,
        le=10_000,
        json_schema_extra=usual(30, 2000),
    )
    housing_split: bool = Field(
        default=False,
        description="Whether the housing is split: its halves pinch a ring tighter than J7. Default: {default}.",
    )
    raceway_temperature_difference_K: float | None = Field(
        default=None,
        description="By how much the inner ring is warmer than the outer one, negative when colder [K]; {range}. When "
        "given, it is taken off the clearance left.",
        examples=[5.0],
        ge=-500,
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
    asked_interference_um: Pair | None = Field(
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
            return (*SIZES, "chamfer_mm", "bearing_type")
        if key in ("shaft_fit", "housing_fit"):
            return (key.replace("fit", "limits_um"),)
        return ("designation",) if key in SIZES else ()

    def unused(self) -> frozenset[str]:
        """The friction without a starting torque."""
        return frozenset() if self.starting_torque_N_m is not None else frozenset({"seat_friction"})

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
    def _limits_ascend(self) -> Self:
        for key in ("shaft_limits_um", "housing_limits_um"):
            pair = getattr(self, key)
            if pair is not None and not pair[0] <= pair[1]:
                raise problem(
                    "measured limits must ascend",
                    key,
                    found=f"[{pair[0]:g}, {pair[1]:g}]",
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
