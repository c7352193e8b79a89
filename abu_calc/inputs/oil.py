"""Table of the oil in the race: grade or viscosity, temperatures, fill."""

from typing import Final, Literal, Self

from pydantic import model_validator

from abu_calc.inputs.reading.table import Table, entry, problem

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
