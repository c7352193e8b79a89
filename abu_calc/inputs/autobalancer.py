"""The table of the autobalancer: the room for it, how it is made, and values that may be pinned.

Table of the oil in the race: grade or viscosity, temperatures, fill.
"""

from typing import Annotated, Final, Literal, Self

from pydantic import Field, PrivateAttr, model_validator

from abu_calc.inputs.reading.table import Many, Table, entry, problem

Temperature = Annotated[float, Field(ge=-60, le=250)]
"""A temperature of the housing [°C]."""


class Autobalancer(Table):
    """The autobalancer: the room there is for it and how it is made."""

    max_outer_diameter_mm: float = entry(ge=1, le=5000, usual=(20, 600), example=68.0).means(
        "Largest permitted outer diameter [mm]; {range}, hand grinders 40 … 120."
    )
    max_width_mm: float = entry(ge=1, le=1000, usual=(4, 200), example=32.0).means(
        "Largest permitted width along the spindle [mm]; {range}, hand grinders 10 … 40."
    )
    max_mass_fraction: float = entry(0.05, gt=0, le=1, usual=(0.01, 0.25)).means(
        "Largest permitted mass with balls, as a fraction of machine.mass_kg; {range}. Default: {default} (the "
        "autobalancers of Kladiev 1996 weigh 4 … 7.5 % of the machine)."
    )
    bore_diameter_mm: float = entry(20.0, gt=0, le=2000, usual=(3, 500)).means(
        "Bore that sits on the spindle [mm]; {range}, smaller than max_outer_diameter_mm. Default: {default}, assumed."
    )
    design: Literal["one-piece", "bearing-ring", "light"] = entry("one-piece").means(
        "Construction: one-piece (race ground into steel), bearing-ring (race of a spherical bearing) or light (hard "
        "ring in aluminium). Default: {default}."
    )
    ball_sizes: Literal["metric", "all"] = entry("all").means(
        "Stock balls to choose from: metric (whole and half millimetres) or all (inch sizes, too, which are stocked as "
        "widely). Default: {default}."
    )
    ball_material: Literal["steel"] = entry("steel").means(
        "Material of the balls: steel, 7.8e-3 g/mm³. Default: {default}."
    )
    corrector: Literal["ball", "roller"] = entry("ball").means(
        "Rolling body in the race: ball (solid, rolling inertia factor 7/5) or roller (3/2). Default: {default}."
    )
    capacity_margin: float = entry(1.2, ge=1, le=100, usual=(1, 3)).means(
        "Required ratio of capacity to need; {range}, by practice 1.1 … 1.5. Default: {default}, assumed."
    )
    rolling_drag_per_s: float = entry(15.0, ge=0, le=1e5, usual=(0.5, 300)).means(
        "Viscous drag of a ball in the race, divided by its inertia m·R_p² [1/s]; {range}, thin oil 3 … 50, grease 10 "
        "… 100. Default: {default}, assumed; it settles hand grinders within a second."
    )
    rolling_friction_mm: float = entry(0.002, ge=0, le=1, usual=(0.0001, 0.1)).means(
        "Lever arm of dry rolling friction [mm]; {range}, hard ground clean race 0.0005 … 0.005, soft race 0.01 … "
        "0.05. Default: {default}, assumed for a hard race."
    )
    race_eccentricity_mm: float = entry(0.010, ge=0, le=10, usual=(0.0005, 0.2)).means(
        "Everything between the race and the axis of rotation: race to bore, half the clearance in the bore, half the "
        "spindle's indicated runout [mm]; {range}, by careful work 0.005 … 0.020. Default: {default}, assumed."
    )
    eccentricity_sum: Literal["worst-case", "rss"] = entry("worst-case").means(
        "Rule by which the drawing's parts of the eccentricity add up to race_eccentricity_mm: worst-case or rss (root "
        "of the sum of squares). The parts are race run-out, fit, spindle run-out, housing imbalance. Default: "
        "{default}."
    )
    closure: Literal["pressed", "screwed"] = entry("pressed").means(
        "Cover that closes the housing: pressed (interference fit) or screwed (a fine thread on its rim). Default: "
        "{default}."
    )
    fastening: Literal["clamped", "shrunk", "flange"] = entry("clamped").means(
        "Fastening on the spindle: clamped (by a nut), shrunk (interference fit alone) or flange (part of the flange "
        "that drives the wheel). Default: {default}."
    )
    clamp_force_N: float | None = entry(None, gt=0, le=1e7, usual=(500, 200000), example=8000.0).means(
        "Axial force of the nut that clamps the housing or the flange [N]; {range}. Without it the slip torque is not "
        "evaluated."
    )
    guard_thickness_mm: float | None = entry(None, gt=0, le=200, usual=(0.5, 20), example=2.0).means(
        "Thickness of the guard round the autobalancer, mild steel [mm]; {range}. Without it containment of a ball is "
        "not evaluated."
    )
    temperature_range_C: Many[Temperature] = entry(
        (0.0, 60.0), usual=(10, 120), example=(0.0, 80.0), min_length=2, max_length=2
    ).means(
        "Lowest and highest temperature of the housing [°C]; each {range}. Interferences are judged at both, from 20 "
        "°C at assembly. Default: 0 and 60, assumed."
    )
    race_hardness_HRC: float = entry(60.0, ge=20, le=68, usual=(55, 66)).means(
        "Hardness of the race [HRC]; {range}, at least 58 for balls not to dent it. Default: {default}, assumed."
    )
    min_wall_mm: float = entry(2.5, gt=0, le=100, usual=(1, 20)).means(
        "Thinnest permitted wall outside the race [mm]; {range}. Default: {default}, assumed (a thinner ring goes oval "
        "under the balls)."
    )
    plane_offset_mm: float = entry(0.0, ge=-1000, le=1000, usual=(1, 200)).means(
        "Race plane from wheel plane along the spindle, positive away from the machine [mm]; {range}. Default: "
        "{default}, in the wheel plane."
    )
    ball_count: int | None = entry(None, ge=2, le=100, usual=(2, 24), example=4).means(
        "Pins the number of balls; {range}. Without it the number is chosen."
    )
    ball_diameter_mm: float | None = entry(None, gt=0, le=200, usual=(2, 40), example=16.0).means(
        "Pins the diameter of the balls [mm]; {range}. Without it the diameter is chosen."
    )
    race_radius_mm: float | None = entry(None, gt=0, le=2500, usual=(8, 300), example=30.0).means(
        "Pins the radius of the race the balls roll on [mm]; {range}. Without it the radius is chosen."
    )

    _drag_by_oil: bool = PrivateAttr(default=False)
    """True if the file has [oil]."""

    @model_validator(mode="after")
    def _no_sphere_for_rollers(self) -> Self:
        if self.design == "bearing-ring" and self.corrector == "roller":
            raise problem(
                "the ring of a self-aligning bearing is a sphere, on which rollers cannot roll",
                "corrector" if "corrector" in self.model_fields_set else "design",
                found='design = "bearing-ring", corrector = "roller"',
                allowed='corrector = "ball", or design = "one-piece" or "light"',
            )
        return self

    def unused(self) -> frozenset[str]:
        """The stock to choose from, where the diameter is pinned; the default drag, where the file has [oil]."""
        unused = set[str]() if self.ball_diameter_mm is None else {"ball_sizes"}
        if self._drag_by_oil and "rolling_drag_per_s" not in self.model_fields_set:
            unused.add("rolling_drag_per_s")
        return frozenset(unused)

    @model_validator(mode="after")
    def _bore_fits_inside(self) -> Self:
        if self.bore_diameter_mm >= self.max_outer_diameter_mm:
            raise problem(
                "the bore leaves no room for an autobalancer",
                "bore_diameter_mm" if "bore_diameter_mm" in self.model_fields_set else "max_outer_diameter_mm",
                found=f"bore_diameter_mm = {self.bore_diameter_mm:g}, "
                f"max_outer_diameter_mm = {self.max_outer_diameter_mm:g}",
                allowed="bore_diameter_mm below max_outer_diameter_mm",
            )
        return self

    @model_validator(mode="after")
    def _temperatures_in_order(self) -> Self:
        low, high = self.temperature_range_C
        if low > high:
            raise problem(
                "the lowest temperature is above the highest",
                "temperature_range_C",
                found=f"[{low:g}, {high:g}]",
                allowed="the lowest first",
                remedy=f"write temperature_range_C = [{high:g}, {low:g}]",
            )
        return self


Grade = Literal[
    "VG 10", "VG 15", "VG 22", "VG 32", "VG 46", "VG 68", "VG 100", "VG 150", "VG 220", "VG 320", "VG 460", "VG 680"
]


class Oil(Table):
    """Oil in the race. It gives the viscous drag rate, unless the file gives rolling_drag_per_s, too."""

    grade: Grade | None = entry(None, example="VG 46").means(
        "ISO viscosity grade (ISO 3448), the kinematic viscosity at 40 °C: VG 10 … VG 680. Or give viscosity_mm2_per_s."
    )
    viscosity_mm2_per_s: float | None = entry(None, ge=5, le=2000, usual=(5, 1000), example=46.0).means(
        "Kinematic viscosity at 40 °C of the data sheet [mm²/s]; {range}. Or give grade."
    )
    viscosity_100C_mm2_per_s: float | None = entry(None, ge=2, le=500, usual=(2, 100), example=6.7).means(
        "Kinematic viscosity at 100 °C of the data sheet [mm²/s]; {range}. Without it: by viscosity_index."
    )
    viscosity_index: float = entry(95.0, ge=0, le=250, usual=(50, 200)).means(
        "Viscosity index (ISO 2909); {range}, mineral oils 90 … 105, synthetic ones up to 160. Default: {default}, "
        "assumed."
    )
    density_g_per_cm3: float = entry(0.87, ge=0.6, le=1.5, usual=(0.8, 1.1)).means(
        "Density [g/cm³]; {range}. Default: {default}, assumed."
    )
    temperature_C: float = entry(40.0, ge=-20, le=120, usual=(15, 90)).means(
        "Temperature of the oil at work [°C]; {range}. Default: {default}, assumed."
    )
    cold_temperature_C: float = entry(5.0, ge=-20, le=120).means(
        "Temperature of cold oil, at the first start of a day [°C]; {range}, not above temperature_C. Default: "
        "{default}, assumed."
    )
    hot_temperature_C: float = entry(80.0, ge=-20, le=120, usual=(40, 110)).means(
        "Temperature of hot oil, after long work [°C]; {range}, not below temperature_C. Default: {default}, assumed."
    )
    fill_ml: float = entry(gt=0, le=1e5, usual=(0.1, 200), example=2.0).means(
        "Oil in the race [ml]; {range}, hand grinders 0.5 … 5."
    )
    slip_m_per_s: float = entry(0.5, ge=0.001, le=50, usual=(0.01, 20)).means(
        "Speed of a ball along the race for which the drag rate is taken [m/s]; {range}. The drag grows faster than "
        "the speed. Default: {default}, assumed: between 0.02 at rest and 14 for balls at standstill."
    )

    @classmethod
    def displaced_by(cls, key: str, value: object) -> tuple[str, ...]:
        """An oil takes the place of another one and of a drag rate, an index that of the viscosity at 100 °C."""
        return DISPLACED.get(key, ())

    def unused(self) -> frozenset[str]:
        """The index, where the viscosity at 100 °C is given."""
        return frozenset() if self.viscosity_100C_mm2_per_s is None else frozenset({"viscosity_index"})

    @property
    def viscosity_at_40(self) -> float:
        """Kinematic viscosity at 40 °C [mm²/s]."""
        if self.grade is not None:
            return float(self.grade.removeprefix("VG "))
        assert self.viscosity_mm2_per_s is not None
        return self.viscosity_mm2_per_s

    @model_validator(mode="after")
    def _one_viscosity(self) -> Self:
        if (self.grade is None) == (self.viscosity_mm2_per_s is None):
            raise problem(
                "the oil has no viscosity" if self.grade is None else "the viscosity is given twice",
                "grade" if self.grade is None else "viscosity_mm2_per_s",
                found="neither" if self.grade is None else "both",
                allowed='grade = "VG 46", or viscosity_mm2_per_s',
            )
        hot = self.viscosity_100C_mm2_per_s
        if hot is not None and hot >= self.viscosity_at_40:
            raise problem(
                "oil is thinner at 100 °C than at 40 °C",
                "viscosity_100C_mm2_per_s",
                found=f"{hot:g} mm²/s",
                allowed=f"below {self.viscosity_at_40:g} mm²/s",
            )
        return self

    @model_validator(mode="after")
    def _temperatures_ascend(self) -> Self:
        if not self.cold_temperature_C <= self.temperature_C <= self.hot_temperature_C:
            cold = self.cold_temperature_C > self.temperature_C
            raise problem(
                "temperatures of the oil must ascend",
                "cold_temperature_C" if cold else "hot_temperature_C",
                found=f"{self.cold_temperature_C:g}, {self.temperature_C:g}, {self.hot_temperature_C:g} °C",
                allowed="cold_temperature_C ≤ temperature_C ≤ hot_temperature_C",
            )
        return self


DISPLACED: Final = {
    "grade": ("viscosity_mm2_per_s", "viscosity_100C_mm2_per_s", "autobalancer.rolling_drag_per_s"),
    "viscosity_mm2_per_s": ("grade", "viscosity_100C_mm2_per_s", "autobalancer.rolling_drag_per_s"),
    "viscosity_index": ("viscosity_100C_mm2_per_s",),
}


def oil_name(oil: Oil) -> str:
    """The oil in words: its grade, or its viscosity."""
    return oil.grade or f"oil of {oil.viscosity_mm2_per_s:g} mm²/s at 40 °C"
