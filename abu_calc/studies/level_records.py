"""Levels of places, as results hold them."""

from typing import Annotated, ClassVar, Self

from abu_calc.analysis.levels import AxisLevels, Band, PlaceLevels, level
from abu_calc.standards.vibration import daily_exposure
from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.units import from_si


@record
class OctaveLevel(Record):
    """One octave, on the axis where it is loudest; no level where the record does not tell it."""

    optional: ClassVar[frozenset[str]] = frozenset({"why_not"})

    nominal_hz: Annotated[float, Quantity("octave", "", 4)]
    low_hz: Annotated[float, Quantity("from", "", 5)]
    high_hz: Annotated[float, Quantity("to", "", 5)]
    limit_db: Annotated[float, Quantity("limit", "", 4)]
    level_db: Annotated[float | None, Quantity("level", "L")]
    velocity_rms_mm_per_s: Annotated[float | None, Quantity("velocity rms", "v")]
    why_not: Annotated[str | None, Quantity("why it is not known")]

    @classmethod
    def of(cls, band: Band) -> Self:
        """Record in user units."""
        octave, velocity = band.octave, band.velocity
        return cls(
            nominal_hz=float(octave.nominal),
            low_hz=from_si(octave.low, "hz"),
            high_hz=from_si(octave.high, "hz"),
            limit_db=float(octave.limit.level),
            level_db=level(velocity),
            velocity_rms_mm_per_s=None if velocity is None else from_si(velocity, "mm_per_s"),
            why_not=band.reason,
        )


@record
class AxisLevel(Record):
    """One axis of a place."""

    name: Annotated[str, Quantity("axis")]
    level_db: Annotated[float | None, Quantity("level", "L")]
    velocity_rms_mm_per_s: Annotated[float | None, Quantity("velocity rms", "v")]
    octave_levels_db: Annotated[tuple[float | None, ...], Quantity("octaves 8 … 1000 Hz", "L")]
    displacement_rms_um: Annotated[float | None, Quantity("displacement rms", "s_v", 3)]
    acceleration_m_per_s2: Annotated[float | None, Quantity("acceleration", "a", 3, "rms, not weighted")]
    weighted_acceleration_m_per_s2: Annotated[float | None, Quantity("weighted acceleration", "a_h", 3)]

    @classmethod
    def of(cls, axis: AxisLevels) -> Self:
        """Record in user units."""
        return cls(
            name=axis.name,
            level_db=level(axis.velocity),
            velocity_rms_mm_per_s=None if axis.velocity is None else from_si(axis.velocity, "mm_per_s"),
            octave_levels_db=tuple(level(band.velocity) for band in axis.bands),
            displacement_rms_um=None if axis.displacement is None else from_si(axis.displacement, "um"),
            acceleration_m_per_s2=axis.acceleration,
            weighted_acceleration_m_per_s2=axis.weighted,
        )


@record
class PlaceLevel(Record):
    """One place: its loudest axis, by octaves, corrected; the vector total of its weighted accelerations."""

    optional: ClassVar[frozenset[str]] = frozenset(
        {"level_before_db", "static_load_without_N", "static_load_N", "daily_exposure_m_per_s2"}
    )

    name: Annotated[str, Quantity("place")]
    level_db: Annotated[float | None, Quantity("level", "L", 4, "rms of the louder axis")]
    velocity_rms_mm_per_s: Annotated[float | None, Quantity("velocity rms", "v")]
    octaves: tuple[OctaveLevel, ...]
    corrected_level_db: Annotated[float | None, Quantity("corrected level", "L", 4, "of the octaves that are known")]
    displacement_rms_um: Annotated[float | None, Quantity("displacement rms", "s_v", 3, "of the louder axis")]
    acceleration_m_per_s2: Annotated[float | None, Quantity("acceleration", "a", 3, "rms, not weighted, louder axis")]
    weighted_axis_m_per_s2: Annotated[float | None, Quantity("weighted acceleration of one axis", "a_h", 3)]
    weighted_acceleration_m_per_s2: Annotated[
        float | None, Quantity("weighted acceleration", "a_hv", 3, "vector total of the axes that there are")
    ]
    daily_exposure_m_per_s2: Annotated[float | None, Quantity("daily exposure", "A(8)", 3)]
    axes: tuple[AxisLevel, ...]
    level_before_db: Annotated[float | None, Quantity("level without autobalancer", "L")]
    static_load_without_N: Annotated[float | None, Quantity("static load of the hand without autobalancer", "", 3)]
    static_load_N: Annotated[float | None, Quantity("static load of the hand", "", 3)]

    @classmethod
    def of(
        cls, place: PlaceLevels, minutes: float | None, before: float | None = None,
        loads: tuple[float, float] | None = None,
    ) -> Self:  # fmt: skip
        """Record in user units; `minutes` of a day, level `before` [dB].

        `loads` [N]: without and with the autobalancer.
        """
        velocity, moved, total = place.velocity, place.louder("displacement"), place.total
        count = len(place.axes[0].bands)
        return cls(
            name=place.name,
            level_db=level(velocity),
            velocity_rms_mm_per_s=None if velocity is None else from_si(velocity, "mm_per_s"),
            octaves=tuple(OctaveLevel.of(place.loudest(index)) for index in range(count)),
            corrected_level_db=level(place.corrected),
            displacement_rms_um=None if moved is None else from_si(moved, "um"),
            acceleration_m_per_s2=place.louder("acceleration"),
            weighted_axis_m_per_s2=place.louder("weighted"),
            weighted_acceleration_m_per_s2=total,
            daily_exposure_m_per_s2=None if minutes is None or total is None else daily_exposure(total, 60 * minutes),
            axes=tuple(map(AxisLevel.of, place.axes)),
            level_before_db=before,
            static_load_without_N=None if loads is None else loads[0],
            static_load_N=None if loads is None else loads[1],
        )
