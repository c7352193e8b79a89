"""Measured levels of machines with autobalancers beside predicted ones, by one set of assumptions."""

from collections.abc import Iterator, Sequence
from statistics import fmean
from typing import Annotated, Any, ClassVar, Final

from abu_calc.features.design.study import SizeResult, size
from abu_calc.features.factory.measurements import (
    AtHandles,
    MeasuredMachine,
    Span,
    ValueSource,
    at_handles,
    degrees_of_freedom,
    factory_machines,
    factory_source,
    machines_of,
    soft_race,
    value_sources,
)
from abu_calc.features.levels.study import levels
from abu_calc.foundation.checks import Status
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent, within
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import level_from_velocity, velocity_from_level
from abu_calc.inputs.measured import MeasuredOctave
from abu_calc.inputs.read_machine import Machine, read
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.result import Provenance, Result
from abu_calc.sizing import size as size_design
from abu_calc.standards.vibration import octave

SLIM: Final = {"autobalancer.bore_diameter_mm": 16.0, "autobalancer.min_wall_mm": 2.0}
"""Slimmer construction of the devices, to show what their mass depends on (assumed)."""
STILL_DB: Final = 60.0
"""An axis so far below the highest level [dB] has no motion but rounding."""


@record
class FactoryLevel(Record):
    """One measurement of a machine in an octave, and the prediction; null: not published, or nothing in the model."""

    machine: Annotated[str, Quantity("machine", "", 4, "the preset or the file")]
    short: Annotated[str, Quantity("name")]
    place: Annotated[str, Quantity("place")]
    axis: Annotated[str, Quantity("axis", "", 4, "x along the work, y normal to it, z along the spindle")]
    state: Annotated[str, Quantity("state", "", 4, "idle, loaded, or not said")]
    octave_hz: Annotated[float, Quantity("octave")]
    source: Annotated[str, Quantity("source")]
    without_measured_db: Annotated[Span | None, Quantity("without, measured", "L")]
    without_predicted_db: Annotated[
        float | None, Quantity("without, predicted", "L", 4, "idle: as taken from the file")
    ]
    with_measured_db: Annotated[Span | None, Quantity("with, measured", "L")]
    with_predicted_db: Annotated[
        float | None,
        Quantity("with, predicted", "L", 4, "idle: median of all start cases, hot and cold oil included; plane model"),
    ]
    with_predicted_worst_db: Annotated[float | None, Quantity("with, the worst start", "L")]
    lowered_measured_db: Annotated[Span | None, Quantity("lowered, measured", "ΔL")]
    lowered_predicted_db: Annotated[float | None, Quantity("lowered, predicted", "ΔL", 3)]
    miss_db: Annotated[
        float | None,
        Quantity("miss", "", 2, "prediction outside the published range: level, else what is lowered"),
    ]
    difference_db: Annotated[float | None, Quantity("measured − predicted", "ΔL", 3, "mean of the range in velocity")]
    at_handles_db: Annotated[
        Span | None,
        Quantity("at the handles", "L", 3, "rigid body, along the sensor's axis: band of the estimate; or lowered by"),
    ]
    at_handles_miss_db: Annotated[float | None, Quantity("miss at the handles", "", 2)]
    not_comparable: Annotated[str | None, Quantity("why the handles are not comparable")]
    degrees_of_freedom_spent: Annotated[
        int | None, Quantity("degrees of freedom spent", "", 4, "values of the file fitted to published results")
    ]
    louder_octave_hz: Annotated[
        float | None, Quantity("louder octave of the model", "", 4, "pressed before the balls have settled")
    ]
    louder_octave_db: Annotated[float | None, Quantity("its level", "L")]
    named: Annotated[str | None, Quantity("named without a number")]
    word: Annotated[str, Quantity("on the difference")]


@record
class FittedValues(Record):
    """Values of one machine file that were chosen to reach a published result."""

    machine: Annotated[str, Quantity("machine")]
    short: Annotated[str, Quantity("name")]
    published: Annotated[int, Quantity("published values")]
    assumed: Annotated[int, Quantity("assumed values")]
    fitted: tuple[ValueSource, ...]
    not_said: Annotated[int, Quantity("values without an origin")]


@record
class SoftRaceLevel(Record):
    """Levels by a friction arm of a soft race, computed with an assumed machine and its design."""

    short: Annotated[str, Quantity("machines")]
    assumed_machine: Annotated[str, Quantity("assumed machine")]
    published: Annotated[str, Quantity("published")]
    rolling_friction_mm: Annotated[float, Quantity("friction arm", "k_r", 3)]
    level_without_db: Annotated[float | None, Quantity("without", "L")]
    with_median_db: Annotated[float | None, Quantity("with, median of all start cases", "L")]
    with_worst_db: Annotated[float | None, Quantity("with, loudest start case", "L")]


@record
class DeviceNumber(Record):
    """One number of a device that the factory built: published, and predicted with its balls pinned; null: none."""

    short: Annotated[str, Quantity("name")]
    balls: Annotated[str, Quantity("balls")]
    state: Annotated[str, Quantity("state", "", 4, "for which the factory found it enough")]
    quantity: Annotated[str, Quantity("quantity")]
    published: Annotated[float | None, Quantity("published")]
    predicted: Annotated[float | None, Quantity("predicted")]


@record
class FactoryResult(Result):
    """All of them in one table."""

    command: ClassVar[str] = "factory"

    rows: tuple[FactoryLevel, ...]
    fitted: tuple[FittedValues, ...]
    soft_races: tuple[SoftRaceLevel, ...]
    devices: tuple[DeviceNumber, ...]
    source: Annotated[str, Quantity("source")]
    background: Annotated[str, Quantity("background")]

    @property
    def status(self) -> Status:
        """A comparison passes; its differences are information."""
        return "pass"


@dataclass(frozen=True)
class _Predicted:
    """Levels [dB] in one state and octave; `level`: with the autobalancer, idle the median of all start cases."""

    without: float | None = None
    level: float | None = None
    worst: float | None = None
    louder: tuple[float, float] | None = None
    """Another octave [Hz] that is the loudest when pressed before the balls have settled, and its level."""

    @property
    def lowered(self) -> float | None:
        """Level without − level with the autobalancer [dB]."""
        return None if self.without is None or self.level is None else self.without - self.level


@checked
def factory(machines: Sequence[Machine] = (), progress: Progress = silent) -> FactoryResult:
    """Size every machine that was measured, and set the predictions beside the measurements.

    `machines`: files with tables [[measured]]; without them the presets of the machines that a factory measured.
    Presets hold published figures, assumed ones, and some that were fitted to published results: `fitted` lists these.
    Raises InputError for a file without measurements.
    """
    own = not machines
    measured = factory_machines() if own else machines_of(machines)
    rows, sources, devices = list[FactoryLevel](), list[FittedValues](), list[DeviceNumber]()
    for machine in measured:
        progress(machine.short)
        design = size(machine.machine, progress=within(progress, machine.short))
        origins = value_sources(machine.machine.document.text)
        sources.append(_fitted(machine, origins))
        handles = machine.geometry and at_handles(machine.machine.whole(), design, machine.geometry)
        rows += [_row(machine, row, design, handles or None, degrees_of_freedom(origins), progress)
                 for row in machine.measured]  # fmt: skip
        for device in machine.devices:
            devices += _device(machine, *device, progress)
    source, background = factory_source() if own else ("; ".join(dict.fromkeys(row.source for row in rows)), "")
    return FactoryResult(
        title="Machines that a factory measured" if own else "Measured machines", provenance=Provenance.today(),
        rows=tuple(rows), fitted=tuple(sources), soft_races=_soft_races(soft_race(), progress) if own else (),
        devices=tuple(devices), source=source, background=background,
    )  # fmt: skip


def _device(
    machine: MeasuredMachine, count: int, diameter: float, state: str, mass: float, progress: Progress
) -> Iterator[DeviceNumber]:  # fmt: skip
    """Numbers of a device; its race is the least that goes round the bore of the file."""
    balls = f"{count} × {diameter:g}"
    pinned = machine.machine.changed({"autobalancer.ball_count": count, "autobalancer.ball_diameter_mm": diameter})
    made = size(pinned, progress=within(progress, f"{machine.short}, {balls} mm"))
    slim = size_design(pinned.changed(SLIM).whole("factory")).autobalancer
    idle, many = made.imbalance_g_mm + made.model.eccentricity_part_g_mm, made.ensemble
    own, loaded = made.autobalancer, made.vibration_loaded
    starts = (None,) * 4 if many is None else (many.predicted_level_db, many.level_db.worst,
                                               many.quiet_time_s.worst, many.settling_time_s.worst)  # fmt: skip
    required = idle if state == "idle" else made.required_capacity_g_mm
    for quantity, published, predicted in (
        ("mass, %", mass, 100 * own.mass_fraction), ("mass if slim, %", mass, 100 * slim.mass_fraction),
        ("capacity, g·mm", None, own.capacity_g_mm), ("required, g·mm", None, required),
        ("idle, median, dB", None, starts[0]), ("idle, loudest, dB", None, starts[1]),
        ("grinding, dB", None, None if loaded is None else loaded.level_after_db),
        ("quiet, slowest, s", 1.0, starts[2]), ("settling, slowest, s", 1.0, starts[3]),
    ):  # fmt: skip
        yield DeviceNumber(short=machine.short, balls=balls, state=state, quantity=quantity, published=published,
                           predicted=predicted)  # fmt: skip


def _fitted(machine: MeasuredMachine, origins: Sequence[ValueSource]) -> FittedValues:
    count = {status: sum(origin.status == status for origin in origins) for status in ("published", "assumed", None)}
    return FittedValues(
        machine=machine.name, short=machine.short, published=count["published"], assumed=count["assumed"],
        fitted=tuple(origin for origin in origins if origin.status == "fitted"), not_said=count[None],
    )  # fmt: skip


def _soft_races(soft: dict[str, Any], progress: Progress) -> tuple[SoftRaceLevel, ...]:
    """The assumed machine with its design kept and its race softer: the smallest and the largest friction arm."""
    progress(soft["short"])
    machine = read(soft["machine"])
    made = size(machine, progress=within(progress, soft["short"])).autobalancer
    kept = {f"autobalancer.{key}": getattr(made, key) for key in ("ball_count", "ball_diameter_mm", "race_radius_mm")}
    rows = []
    for friction in soft["friction_mm"]:
        softer = machine.changed({**kept, "autobalancer.rolling_friction_mm": friction})
        design = size(softer, progress=within(progress, soft["short"]))
        many = design.ensemble
        rows.append(
            SoftRaceLevel(
                short=soft["short"],
                assumed_machine=soft["machine"],
                published=soft["published"],
                rolling_friction_mm=friction,
                level_without_db=design.vibration.level_before_db,
                with_median_db=None if many is None else many.predicted_level_db,
                with_worst_db=None if many is None else many.level_db.worst,
            )
        )
    return tuple(rows)


def _predicted(machine: Machine, design: SizeResult, row: MeasuredOctave, progress: Progress) -> _Predicted:
    """Idle the median of the start cases, in the octave of the spindle; at work in the plane the simulated octaves.

    Pressed to the work when the balls have settled, as one works; `louder`: pressed before.
    """
    table = machine.whole()
    own = octave(table.machine.speed).nominal
    if row.state == "loaded" and table.grinding is not None and table.grinding.contact != "face":
        usual, hard = (_octaves(machine, start, progress) for start in ("settled", "bunched"))
        loudest, loaded = max(hard, key=hard.__getitem__), design.vibration_loaded
        louder = None if loudest == row.octave_hz else (loudest, hard[loudest])
        before = None if loaded is None or own != row.octave_hz else loaded.level_before_db
        level = usual.get(row.octave_hz)
        return _Predicted(before, level, louder=louder)
    if own != row.octave_hz:
        return _Predicted()
    many = design.ensemble
    if many is None:
        after = design.vibration.level_after_db
        return _Predicted(design.vibration.level_before_db, after)
    known_levels = [level for level in (many.level_db.worst, design.vibration.level_after_db) if level is not None]
    return _Predicted(
        design.vibration.level_before_db, many.predicted_level_db, max(known_levels, default=None),
    )  # fmt: skip


def _octaves(machine: Machine, start: str, progress: Progress) -> dict[float, float]:
    """Levels [dB] by octave [Hz] of the machine at its work, pressed with its balls there."""
    spectrum = levels(machine, "grinding", start=start, progress=progress)
    return {band.nominal_hz: band.level_db for band in spectrum.octaves if band.level_db is not None}


def _row(
    machine: MeasuredMachine, row: MeasuredOctave, design: SizeResult, handles: AtHandles | None, spent: int | None,
    progress: Progress,
) -> FactoryLevel:  # fmt: skip
    forecast = _predicted(machine.machine, design, row, progress)
    spans = dict(row.spans)
    without, fitted, lowered = (spans.get(key) for key in ("level_without_db", "level_db", "lowered_db"))
    if lowered is None and without is not None and fitted is not None:
        lowered = max(0.0, without[0] - fitted[1]), without[1] - fitted[0]
    there, reason = _there(row, forecast, design, handles, is_level=fitted is not None)
    compared = fitted if fitted is not None else lowered
    return FactoryLevel.read(
        row,
        machine=machine.name,
        short=machine.short,
        without_measured_db=without,
        without_predicted_db=forecast.without,
        with_measured_db=fitted,
        with_predicted_db=forecast.level,
        with_predicted_worst_db=forecast.worst,
        lowered_measured_db=lowered,
        lowered_predicted_db=forecast.lowered,
        miss_db=_miss(fitted, lowered, forecast.level, forecast.lowered),
        difference_db=_difference(fitted, forecast),
        at_handles_db=there,
        at_handles_miss_db=None if there is None or compared is None else _gap(compared, there),
        not_comparable=reason,
        degrees_of_freedom_spent=spent,
        louder_octave_hz=None if forecast.louder is None else forecast.louder[0],
        louder_octave_db=None if forecast.louder is None else forecast.louder[1],
        named=None if spans else "peak",
        word=row.remark or "",
    )


def _there(
    row: MeasuredOctave, forecast: _Predicted, design: SizeResult, handles: AtHandles | None, *, is_level: bool
) -> tuple[Span | None, str | None]:
    """Level at the handles along the sensor's axis, or how much it is lowered there [dB]; None with the reason.

    At a handle of the file: the levels of its axis against the level that the start cases give.
    """
    base = forecast.level if is_level else forecast.lowered
    if base is None:
        return None, "the model has no motion in this octave"
    if handles is not None:
        low, high = handles.carried[row.axis] if is_level else handles.lowered
        return (base + low, base + high), None
    vibration = design.vibration
    place = next((place for place in vibration.handles if place.name == row.place), None)
    if place is None:
        return None, "the file has no handle of this name"
    axis = next((axis for axis in place.axes or () if axis.axis == row.axis), None)
    before, after = vibration.level_before_db, vibration.level_after_db
    if (
        axis is None or axis.level_before_db is None or axis.level_after_db is None or before is None or after is None
        or axis.level_before_db < before - STILL_DB
    ):  # fmt: skip
        return None, "the model has no motion along this axis"
    there = axis.level_after_db - after
    if not is_level:
        there = axis.level_before_db - before - there
    return (base + there, base + there), None


def _miss(fitted: Span | None, lowered: Span | None, level: float | None, less: float | None) -> float | None:
    """Distance of a prediction from the published range [dB]; None if they do not concern the same."""
    if fitted is not None:
        return None if level is None else _gap(fitted, (level, level))
    return None if lowered is None or less is None else _gap(lowered, (less, less))


def _difference(fitted: Span | None, forecast: _Predicted) -> float | None:
    """Measured − predicted [dB] with the autobalancer, the mean of the span in velocity as in [measured_after]."""
    if fitted is None or forecast.level is None:
        return None
    return level_from_velocity(fmean(map(velocity_from_level, fitted))) - forecast.level


def _gap(measured: Span, predicted: Span) -> float:
    """Distance between two ranges [dB]; zero if they overlap."""
    return max(0.0, measured[0] - predicted[1], predicted[0] - measured[1])
