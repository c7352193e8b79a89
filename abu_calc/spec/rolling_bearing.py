"""A rolling bearing: what it is, and the load on its rings."""

from typing import Annotated, Final, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.errors import InputError
from abu_calc.spec.table import Name, Table, problem
from abu_calc.spec.usual import usual
from abu_calc.standards.maker_fits import RingLoad

SIZES: Final = ("bore_mm", "outer_mm", "width_mm")
_CLASSES: Final = {"NORMAL": "0", "P0": "0", "PN": "0", "P6": "6", "P5": "5", "P4": "4", "P2": "2"}


def _class_as_iso_has_it(value: object) -> object:
    """P5 and Normal for 5 and 0; everything else as it is, to be judged as written."""
    return _CLASSES.get(value.strip().upper(), value) if isinstance(value, str) else value


class RollingBearing(Table):
    """A rolling bearing by its designation or its sizes, with its load."""

    name: Name = Field(
        default="bearing",
        description="Name of the bearing, as reports print it. Default: {default}.",
        examples=["spindle, drive end"],
        min_length=1,
    )
    designation: Name | None = Field(
        default=None,
        description="Designation whose sizes, type, series and load ratings are looked up, in quotes; seals and the "
        "like may follow (6203-2RS), C3 and P5 count. Or give bore_mm, outer_mm and width_mm.",
        examples=["6203"],
        min_length=1,
    )
    bearing_type: Literal["ball", "angular-contact", "cylindrical", "tapered", "spherical"] | None = Field(
        default=None,
        description="Type of a bearing given by its sizes: ball (deep groove), angular-contact, cylindrical, tapered "
        "or spherical. Decides the makers' fits and the tables of its rings and clearance.",
        examples=["ball"],
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
    dynamic_load_rating_kN: float | None = Field(
        default=None,
        description="Basic dynamic load rating C [kN]; {range}. Default: that of the designation.",
        examples=[9.95],
        gt=0,
        le=1e5,
        json_schema_extra=usual(0.1, 3000),
    )
    static_load_rating_kN: float | None = Field(
        default=None,
        description="Basic static load rating C0 [kN]; {range}. Default: that of the designation.",
        examples=[4.75],
        gt=0,
        le=1e5,
        json_schema_extra=usual(0.05, 5000),
    )
    series: Literal["light", "medium", "heavy"] | None = Field(
        default=None,
        description="Series of the bearing: light, medium or heavy. Default: by the designation; light where the sizes "
        "are given.",
        examples=["light"],
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
    bearing_class: Annotated[Literal["0", "6", "5", "4", "2"], BeforeValidator(_class_as_iso_has_it)] | None = Field(
        default=None,
        description='Accuracy class of the bearing, in quotes: "0", "6", "5", "4" or "2" (ISO 492 Normal, P6, P5, '
        'P4, P2, which may be written so, too). Default: by the designation\'s suffix, else "0".',
        examples=["0"],
    )
    internal_clearance: Literal["C2", "CN", "C3", "C4"] | None = Field(
        default=None,
        description="Group of radial clearance of a deep groove ball bearing: C2, CN, C3 or C4 (ISO 5753-1). When "
        "given, by this key or the designation's suffix, the clearance left after mounting is checked.",
        examples=["C3"],
    )

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
        from abu_calc.standards.designations import read_designation  # many files have no bearing

        try:
            return self.designation is not None and read_designation(self.designation).accuracy is not None
        except InputError:
            return True

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
