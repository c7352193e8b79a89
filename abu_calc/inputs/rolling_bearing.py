"""The table of a rolling bearing: the bearing itself, the load on its rings, and its two seats."""

import itertools
from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.table import Name, Table, entry, problem
from abu_calc.standards.tolerance_classes import RingLoad

SIZES: Final = ("bore_mm", "outer_mm", "width_mm")
BearingKind = Literal["ball", "angular-contact", "cylindrical", "tapered", "spherical", "needle", "drawn-cup"]
ClearanceGroup = Literal["C2", "CN", "C3", "C4", "C5", "CA", "CB", "CC", "GA", "GB", "GC"]
_CLASSES: Final = {"NORMAL": "0", "P0": "0", "PN": "0", "P6": "6", "P6X": "6X", "P5": "5", "P4": "4", "P2": "2"}


def _class_as_iso_has_it(value: object) -> object:
    """P5 and Normal for 5 and 0; everything else as it is, to be judged as written."""
    return _CLASSES.get(value.strip().upper(), value) if isinstance(value, str) else value


class RollingBearing(Table):
    """A rolling bearing by its designation or its sizes, with its load."""

    name: Name = entry("bearing", example="spindle, drive end", min_length=1).means(
        "Name of the bearing, as reports print it. Default: {default}."
    )
    designation: Name | None = entry(None, example="6203", min_length=1).means(
        "Designation whose sizes, type, series and load ratings are looked up, in quotes; seals and the like may "
        "follow (6203-2RS), C3 and P5 count. GOST's class may stand before it (6-205). Or give bore_mm, outer_mm and "
        "width_mm."
    )
    bearing_type: BearingKind | None = entry(None, example="ball").means(
        "Type of a bearing given by its sizes: ball (deep groove), angular-contact, cylindrical, tapered, spherical, "
        "needle (machined rings) or drawn-cup. Decides the makers' fits, the tables of its rings and clearance, and "
        "the catalogue's bearing of these sizes."
    )
    bore_mm: float | None = entry(None, gt=0, le=5000, usual=(3, 500), example=17.0).means(
        "Bore of the bearing [mm]; {range}."
    )
    outer_mm: float | None = entry(None, gt=0, le=8000, usual=(8, 800), example=40.0).means(
        "Outer diameter of the bearing [mm]; above bore_mm, up to {most}, {usual}."
    )
    width_mm: float | None = entry(None, gt=0, le=2000, usual=(2, 300), example=12.0).means(
        "Width of the ring [mm]; {range}."
    )
    chamfer_mm: float | None = entry(None, ge=0, le=100, usual=(0.1, 10), example=0.6).means(
        "Chamfer of one edge; the seat is as long as the width less two of them [mm]; {range}."
    )
    radial_load_kN: float | None = entry(None, ge=0, le=1e5, usual=(0.01, 300), example=0.8).means(
        "Radial load [kN]; {range}. Without it whether a ring creeps is not known."
    )
    cutting_force_N: float | None = entry(None, ge=0, le=1e8, usual=(10, 1e5), example=4100.0).means(
        "Cutting force of the process [N]; {range}. With normal_to_cutting_ratio and bearings_sharing it gives the "
        "radial load, in place of radial_load_kN."
    )
    normal_to_cutting_ratio: float | None = entry(None, ge=0, le=100, usual=(0.2, 5), example=2.8).means(
        "Force normal to the work over the cutting force; {range}, in grinding 1.5 … 3. Default: 2.8, assumed."
    )
    bearings_sharing: int | None = entry(None, ge=1, le=100, usual=(1, 4), example=4).means(
        "Number of bearings that share the load of the process alike; {range}. Default: 1."
    )
    axial_load_kN: float | None = entry(None, ge=0, le=1e5, usual=(0.01, 300), example=0.2).means(
        "Axial load [kN]; {range}. With the radial load it gives the equivalent loads. Without it they are those of "
        "the radial load alone, and the check of the axial load is not evaluated."
    )
    load_kind: Literal["moderate", "shock"] | None = entry(None, example="moderate").means(
        "Kind of the load for the load intensity (GOST 3325): moderate (overload to 150 %) or shock (shocks and "
        "vibration, to 300 %). Default: shock."
    )
    dynamic_load_rating_kN: float | None = entry(None, gt=0, le=1e5, usual=(0.1, 3000), example=9.95).means(
        "Basic dynamic load rating C [kN]; {range}. Default: that of the designation."
    )
    static_load_rating_kN: float | None = entry(None, gt=0, le=1e5, usual=(0.05, 5000), example=4.75).means(
        "Basic static load rating C0 [kN]; {range}. Default: that of the designation."
    )
    series: Literal["light", "medium", "heavy"] | None = entry(None, example="light").means(
        "Series of the bearing: light, medium or heavy. Default: by the designation; light where the sizes are given."
    )
    inner_ring_load: RingLoad = entry("rotating").means(
        "Load on the inner ring: rotating, stationary or indeterminate. Default: {default}, as of a turning shaft."
    )
    outer_ring_load: RingLoad = entry("stationary").means(
        "Load on the outer ring: rotating, stationary or indeterminate. Default: {default}."
    )
    bearing_class: Annotated[Literal["0", "6", "6X", "5", "4", "2"], BeforeValidator(_class_as_iso_has_it)] | None = (
        entry(None, example="0").means(
            'Accuracy class of the bearing, in quotes: "0", "6", "5", "4" or "2" (ISO 492 Normal, P6, P5, P4, '
            'P2, which may be written so, too); "6X" of tapered ones. Default: by the designation\'s suffix, else "0".'
        )
    )
    internal_clearance: ClearanceGroup | None = entry(None, example="C3").means(
        "Group of internal clearance: C2, CN, C3, C4 or C5 (ISO 5753-1), also of tapered pairs. Pairs of angular "
        "contact bearings of 40° have CA, CB, CC, or with preload GA, GB, GC. When given, by this key or the "
        "designation's suffix, the clearance left after mounting is checked."
    )

    @model_validator(mode="after")
    def _loaded_one_way(self) -> Self:
        if self.cutting_force_N is not None and self.radial_load_kN is not None:
            raise problem(
                "radial_load_kN and cutting_force_N both give the radial load",
                "cutting_force_N",
                remedy="keep the one or the other",
            )
        alone = next((key for key in ("normal_to_cutting_ratio", "bearings_sharing") if getattr(self, key)), None)
        if self.cutting_force_N is None and alone is not None:
            raise problem(f"{alone} without cutting_force_N", alone, remedy="add cutting_force_N, or leave it out")
        return self

    def own_defaults(self) -> dict[str, object]:
        """Class and series have a default where no designation tells them."""
        derived: dict[str, object] = {}
        if self.series is None and self.designation is None:
            derived["series"] = "light"
        if self.bearing_class is None and not self._class_is_designated():
            derived["bearing_class"] = "0"
        return {**super().own_defaults(), **derived}

    def _class_is_designated(self) -> bool:
        """True if a suffix gives the class; an unknown designation is refused where it is looked up."""
        from abu_calc.standards.bearing_catalogue import read_designation

        try:
            return self.designation is not None and read_designation(self.designation).accuracy is not None
        except InputError:
            return True

    @model_validator(mode="after")
    def _sized_one_way(self) -> Self:
        given = [key for key in SIZES if getattr(self, key) is not None]
        if self.designation is not None and given:
            raise problem(
                f"designation and {given[0]} both give the size of the bearing",
                given[0],
                remedy="keep the designation, or the sizes (the designation may stand in name)",
            )
        absent = [key for key in SIZES if key not in given]
        if self.designation is None and absent:
            raise problem(
                "the bearing has no size" if not given else "the size of the bearing is incomplete",
                absent[0],
                found=" and ".join(given) or "none",
                allowed="designation, or all of " + ", ".join(SIZES),
                remedy=f"add {' and '.join(absent)}" if given else 'add designation = "…"',
            )
        return self


MOST_BEARINGS: Final = 100
"""Most bearings in one file; the longest report on them takes some seconds."""
SeatMaterial = Literal["steel", "stainless-steel", "cast-iron", "aluminium", "magnesium"]
Pair = Annotated[tuple[float, ...], Field(strict=False, min_length=2, max_length=2)]


class Bearing(RollingBearing):
    """A rolling bearing and its two seats, checked by `abu check-fit`."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"designation"})

    position_mm: float | None = entry(None, ge=-10_000, le=10_000, usual=(1, 1000), example=40.0).means(
        "Place of the bearing along the spindle from the wheel's centre, positive toward the machine [mm]; {range}. "
        "With the places of two bearings, `abu size` computes their life with and without the autobalancer."
    )
    lubricant_viscosity_mm2_per_s: float | None = entry(None, gt=0, le=1e5, usual=(2, 1000), example=20.0).means(
        "Kinematic viscosity of the oil, or of the grease's base oil, at the bearing's temperature [mm²/s]; {range}. "
        "With the speed it gives the modified rating life (a_ISO); without it that is not evaluated."
    )
    contamination_factor: float = entry(0.5, ge=0, le=1, usual=(0.1, 1)).means(
        "Contamination factor e_C of ISO 281: 1 (extreme cleanliness), 0.8 (high), 0.5 (normal), 0.3 (slight), 0.1 "
        "(typical contamination), down to 0; {range}. Default: {default}, assumed."
    )
    required_life_h: float | None = entry(None, gt=0, le=1e9, usual=(300, 100_000), example=5000.0).means(
        "Rating life that the bearing must reach [h]; {range}. Without it a life below 3000 h, the makers' guide for "
        "hand-held tools, is a warning."
    )
    short_pairs_warn_percent: float = entry(1.0, ge=0, le=100, usual=(0.1, 10)).means(
        "Share of pairs with too little interference above which ABU605 and ABU615 warn [%]; {range}. Default: "
        "{default}."
    )
    short_pairs_fail_percent: float = entry(5.0, ge=0, le=100, usual=(0.5, 50)).means(
        "Share of pairs with too little interference above which ABU605 and ABU615 fail [%]; {range}, not below "
        "short_pairs_warn_percent. Default: {default}."
    )
    shaft_fit: str | None = entry(None, example="k6", pattern=r"^[a-z]{1,2}[0-9]{1,2}$").means(
        "Tolerance class of the shaft by ISO 286, small letters. Without it the answer is which to write."
    )
    housing_fit: str | None = entry(None, example="H7", pattern=r"^[A-Z]{1,2}[0-9]{1,2}$").means(
        "Tolerance class of the housing by ISO 286, capital letters. Without it the answer is which to write."
    )
    shaft_limits_um: Pair | None = entry(None, usual=(0.1, 500), example=[2.0, 21.0]).means(
        "Least and largest deviation of the shaft from its nominal size as measured [µm], {usual} either way. In place "
        "of shaft_fit, which may stand beside it as what the drawing asks for."
    )
    housing_limits_um: Pair | None = entry(None, usual=(0.1, 500), example=[0.0, 25.0]).means(
        "Least and largest deviation of the housing from its nominal size as measured [µm], {usual} either way. In "
        "place of housing_fit, which may stand beside it as what the drawing asks for."
    )
    ring_bore_limits_um: Pair | None = entry(None, usual=(0.1, 100), example=[-8.0, -3.0]).means(
        "Least and largest deviation of the bore of the bearing as measured [µm], {usual} either way. In place of the "
        "limits of its accuracy class."
    )
    ring_outer_limits_um: Pair | None = entry(None, usual=(0.1, 100), example=[-7.0, -2.0]).means(
        "Least and largest deviation of the outer diameter of the bearing as measured [µm], {usual} either way. In "
        "place of the limits of its accuracy class."
    )
    mounting_clearance_um: float | None = entry(None, ge=0, le=1000, usual=(5, 100), example=20.0).means(
        "Clearance wanted when a heated ring or housing is mounted [µm]; {range}. Default: a two-thousandth of the "
        "diameter, at least 5, assumed."
    )
    shaft_rz_um: float | None = entry(None, ge=0, le=1000, usual=(0.1, 50), example=4.0).means(
        "Roughness Rz of the shaft [µm]; {range}. When given, its smoothing is taken off the interference."
    )
    housing_rz_um: float | None = entry(None, ge=0, le=1000, usual=(0.1, 50), example=6.3).means(
        "Roughness Rz of the housing [µm]; {range}. When given, its smoothing is taken off the interference."
    )
    ring_temperature_difference_K: float | None = entry(None, ge=-500, le=500, usual=(0.1, 100), example=10.0).means(
        "By how much the inner ring is warmer than its shaft, negative when colder [K]; {range}. When given, the loss "
        "of interference α·d·ΔT is counted."
    )
    housing_temperature_difference_K: float | None = entry(None, ge=-500, le=500, usual=(0.1, 100), example=-5.0).means(
        "By how much the housing is warmer than the outer ring, negative when colder [K]; {range}. When given, the "
        "loss of interference α·D·ΔT is counted."
    )
    temperature_rise_K: float | None = entry(None, ge=-300, le=500, usual=(0.1, 150), example=40.0).means(
        "By how much the bearing is warmer in service than at mounting (20 °C), negative when colder [K]; {range}. "
        "When given, shafts and housings that expand otherwise than steel lose or gain interference by it."
    )
    temperature_range_K: Pair | None = entry(None, usual=(1, 150), example=[-40.0, 60.0]).means(
        "Lowest and highest temperature of all parts above that of mounting (20 °C) [K], ascending, {usual} either "
        "way. When given, the fits are shown and advised for both ends, too."
    )
    speed_rpm: float | None = entry(None, ge=0, le=300_000, usual=(10, 60_000), example=5800.0).means(
        "Speed of the shaft with the inner ring [rpm]; {range}. When given, the loss of interference by centrifugal "
        "growth is counted, and the rating life and the limiting speed are checked."
    )
    shaft_bore_mm: float | None = entry(None, ge=0, le=5000, usual=(1, 500), example=0.0).means(
        "Bore of a hollow shaft, for stresses [mm]; 0 (solid) up to the bearing's bore, {usual}."
    )
    housing_outer_mm: float | None = entry(None, gt=0, le=20_000, usual=(10, 2000), example=60.0).means(
        "Outer diameter of the housing, for stresses [mm]; above that of the bearing, up to {most}, {usual}."
    )
    shaft_material: SeatMaterial = entry("steel").means(
        "Material of the shaft, for stresses and thermal effects: steel, stainless-steel, cast-iron, aluminium or "
        "magnesium. Default: {default}."
    )
    housing_material: SeatMaterial = entry("steel").means(
        "Material of the housing, for stresses and thermal effects: steel, stainless-steel, cast-iron, aluminium or "
        "magnesium. Default: {default}."
    )
    shaft_strength_MPa: float | None = entry(None, gt=0, le=10_000, usual=(30, 2000), example=300.0).means(
        "Hoop stress that the shaft bears [MPa]; {range}. Default: a low one of its material, assumed."
    )
    housing_strength_MPa: float | None = entry(None, gt=0, le=10_000, usual=(30, 2000), example=200.0).means(
        "Hoop stress that the housing bears [MPa]; {range}. Default: a low one of its material, assumed."
    )
    housing_split: bool = entry(False).means(
        "Whether the housing is split: its halves pinch a ring tighter than J7. Default: {default}."
    )
    raceway_temperature_difference_K: float | None = entry(None, ge=-500, le=500, usual=(0.1, 60), example=5.0).means(
        "By how much the inner ring is warmer than the outer one, negative when colder [K]; {range}. When given, it is "
        "taken off the clearance left."
    )
    starting_torque_N_m: float | None = entry(None, ge=0, le=1e7, usual=(0.01, 5000), example=2.0).means(
        "Torque that a ring under a rotating load must pass on by friction when the machine starts [N·m]; {range}. "
        "When given, the seat's friction torque is checked against it."
    )
    seat_friction: float = entry(0.12, ge=0, le=1, usual=(0.05, 0.3)).means(
        "Coefficient of friction between ring and seat; {range}. Default: {default}, assumed (steel on steel)."
    )
    asked_interference_um: Pair | None = entry(None, usual=(1, 300), example=[10.0, 28.0]).means(
        "Least and largest interference asked of the pairs, ascending, tight positive [µm], {usual} either way. When "
        "given, the groups for selective assembly are given."
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
        """The friction without a starting torque; the contamination without a viscosity."""
        absent = (
            ("seat_friction", self.starting_torque_N_m),
            ("contamination_factor", self.lubricant_viscosity_mm2_per_s),
        )
        return frozenset(key for key, needed in absent if needed is None)

    @model_validator(mode="after")
    def _shares_ascend(self) -> Self:
        if self.short_pairs_warn_percent > self.short_pairs_fail_percent:
            raise problem(
                "the share of short pairs that fails is below the one that warns",
                "short_pairs_fail_percent",
                found=f"{self.short_pairs_fail_percent:g}",
                allowed=f"at least {self.short_pairs_warn_percent:g}",
            )
        return self

    @model_validator(mode="after")
    def _band_ascends(self) -> Self:
        ascending = (("asked_interference_um", "the band of interference"), ("temperature_range_K", "the temperatures"))
        for key, what in ascending:
            band = getattr(self, key)
            if band is not None and not band[0] < band[1]:
                raise problem(
                    f"{what} must ascend", key, found=f"[{band[0]:g}, {band[1]:g}]", remedy="write the least first"
                )
        return self

    @model_validator(mode="after")
    def _limits_ascend(self) -> Self:
        for key in ("shaft_limits_um", "housing_limits_um", "ring_bore_limits_um", "ring_outer_limits_um"):
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
