"""Levels as instruments show them, and the measurement with the autobalancer beside its prediction."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated, ClassVar, Self

from abu_calc.formulas.rigid_body import Vector
from abu_calc.foundation.quantity import LEVEL_AFTER, Quantity, Record, record
from abu_calc.foundation.units import level_from_velocity, velocity_from_level
from abu_calc.inputs.wheel import Shown
from abu_calc.sizing.budget import displacement_level
from abu_calc.sizing.case import WHEEL_PLANE, Case
from abu_calc.sizing.design import Design
from abu_calc.sizing.imbalance import UNITS, InstrumentReadings, as_shown, in_words, measured_velocity, readings
from abu_calc.sizing.places import AXES, LevelPlace, PlaceBand, weighted_axes


def measured_place(case: Case, shown: Shown) -> tuple[str, Vector]:
    """Name and place [m] from the centre of mass of where it was measured."""
    named_handle = next((handle for handle in case.handles if handle.name == shown.at), None)
    return (WHEEL_PLANE, case.body.wheel) if named_handle is None else (named_handle.name, named_handle.place)


def level_where_measured(design: Design, moved: float | None) -> float | None:
    """Level [dB] at the place of [measured_after] of a displacement 0–peak [m] of the wheel; None without either."""
    case, table = design.case, design.case.table.measured_after
    if table is None or table.shown is None or not moved:
        return None
    there = moved * case.body.transmission(measured_place(case, table.shown)[1], design.autobalancer.mass)
    return displacement_level(there, case.speed, case.background_level) if there else None


@record
class HandleAxis(Record):
    """One axis of a place: levels, and weighted accelerations, null where W_h is not defined."""

    axis: Annotated[str, Quantity("axis")]
    level_before_db: Annotated[float | None, Quantity("level before", "L")]
    level_after_db: Annotated[float | None, LEVEL_AFTER]
    a_h_before_m_per_s2: Annotated[float | None, Quantity("weighted, before", "a_h", 3)]
    a_h_after_m_per_s2: Annotated[float | None, Quantity("weighted, after", "a_h", 3)]


@record
class HandleLevels(Record):
    """Levels at one place where the machine is held: of its loudest axis, and of each axis.

    `a_hv_…`: vector total of the weighted accelerations. Bands [low, high] are those that an estimated inertia leaves.
    """

    optional: ClassVar[frozenset[str]] = frozenset(
        {
            "level_at_once_db",
            "shown_before",
            "shown_after",
            "level_before_band_db",
            "level_after_band_db",
            "a_hv_before_band_m_per_s2",
            "a_hv_after_band_m_per_s2",
        }
    )

    decimals: ClassVar[Mapping[str, int]] = {"mm": 9}

    name: Annotated[str, Quantity("place")]
    level_before_db: Annotated[float | None, Quantity("level before", "L")]
    level_after_db: Annotated[float | None, LEVEL_AFTER]
    reduction_db: Annotated[float | None, Quantity("reduction", "ΔL", 3)]
    effective_mass_kg: Annotated[float | None, Quantity("felt mass", "", 4, "imbalance at the wheel over motion here")]
    level_at_once_db: Annotated[float | None, Quantity("level after, pressed at once", "L")] = None
    shown_before: InstrumentReadings | None = None
    shown_after: InstrumentReadings | None = None
    position: Annotated[tuple[float, float, float] | None, Quantity("from the centre of mass", "", 4, unit="mm")] = None
    axes: tuple[HandleAxis, ...] | None = None
    a_hv_before_m_per_s2: Annotated[float | None, Quantity("three axes, before", "a_hv", 3)] = None
    a_hv_after_m_per_s2: Annotated[float | None, Quantity("three axes, after", "a_hv", 3)] = None
    level_before_band_db: Annotated[tuple[float, float] | None, Quantity("band of the level before", "L")] = None
    level_after_band_db: Annotated[tuple[float, float] | None, Quantity("band of the level after", "L")] = None
    a_hv_before_band_m_per_s2: Annotated[tuple[float, float] | None, Quantity("band before", "a_hv", 3)] = None
    a_hv_after_band_m_per_s2: Annotated[tuple[float, float] | None, Quantity("band after", "a_hv", 3)] = None

    @classmethod
    def of(
        cls,
        place: LevelPlace,
        speed: float | None = None,
        hasty: LevelPlace | None = None,
        band: PlaceBand | None = None,
    ) -> Self:
        """Levels of one place; with the speed [rad/s] also each axis, and readings as instruments show them.

        `hasty`: the same place, pressed at once; `band`: what an estimated inertia leaves open.
        """
        levels = place.levels
        totals = [None if speed is None else place.total(speed, after=after) for after in (False, True)]
        return cls.read(
            place,
            levels,
            *(() if band is None else (band,)),
            level_before_db=levels.before,
            level_after_db=levels.after,
            level_at_once_db=None if hasty is None else hasty.levels.after,
            shown_before=_shown(levels.before, speed, totals[0]),
            shown_after=_shown(levels.after, speed, totals[1]),
            position=place.place,
            axes=None if speed is None else _axes(place, speed),
            a_hv_before_m_per_s2=totals[0],
            a_hv_after_m_per_s2=totals[1],
        )


def _shown(level: float | None, speed: float | None, total: float | None) -> InstrumentReadings | None:
    """Readings of a level [dB] at a speed [rad/s]; without a vector total a_hv [m/s²] two axes move alike."""
    if level is None or speed is None:
        return None
    values = readings(velocity_from_level(level), speed)
    return values if total is None else replace(values, total=total)


def _axes(place: LevelPlace, speed: float) -> tuple[HandleAxis, ...]:
    """Records of the axes of a place at a speed [rad/s]."""
    before, after = (weighted_axes(place.axes, speed, after=after) or (None,) * 3 for after in (False, True))
    return tuple(
        HandleAxis(
            axis=name,
            level_before_db=levels.before,
            level_after_db=levels.after,
            a_h_before_m_per_s2=a_before,
            a_h_after_m_per_s2=a_after,
        )
        for name, levels, a_before, a_after in zip(AXES[: len(place.axes)], place.axes, before, after, strict=False)
    )


@record
class MeasuredAfterRecord(Record):
    """Measurement with the autobalancer, idle, beside the prediction for the same place.

    The prediction is the median of all start cases, hot and cold oil included, in every command.
    `predicted_loaded_db`: the prediction there under load, in reports of the machine at its workpiece.
    `this_run_db`: the level of the one idle run that a command reports.
    """

    schema_title: ClassVar[str] = "MeasuredAfter"

    optional: ClassVar[frozenset[str]] = frozenset({"predicted_loaded_db", "this_run_db"})

    place: Annotated[str, Quantity("measured at")]
    measured: Annotated[str, Quantity("as measured")]
    measured_level_db: Annotated[float, Quantity("measured", "L")]
    predicted_level_db: Annotated[float | None, Quantity("predicted, median of the start cases", "L")]
    difference_db: Annotated[float | None, Quantity("measured − predicted", "ΔL", 3)]
    predicted_value: Annotated[float | None, Quantity("predicted, as the instrument shows it")]
    unit: Annotated[str, Quantity("unit of that value")]
    predicted_loaded_db: Annotated[float | None, Quantity("predicted under load", "L")] = None
    this_run_db: Annotated[float | None, Quantity("level of this run", "L")] = None


def compared(
    case: Case, level: float | None, loaded: float | None = None, this_run: float | None = None
) -> MeasuredAfterRecord | None:
    """[measured_after] beside a predicted level [dB] at its place; None without the table.

    `loaded`: predicted under load, `this_run`: of an idle run, both [dB].
    """
    table = case.table.measured_after
    if table is None or table.shown is None:
        return None
    shown = table.shown
    measured = level_from_velocity(measured_velocity(shown, case.speed, "measured_after"))
    return MeasuredAfterRecord(
        place=measured_place(case, shown)[0],
        measured=in_words(shown),
        measured_level_db=measured,
        predicted_level_db=level,
        difference_db=None if level is None else measured - level,
        predicted_value=None if level is None else as_shown(shown, velocity_from_level(level), case.speed),
        unit=UNITS[shown.key],
        predicted_loaded_db=loaded,
        this_run_db=this_run,
    )
