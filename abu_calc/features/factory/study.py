"""The factory's machines: measured levels beside predicted ones, by one set of assumptions.

`factory_rows` gives the maker's measurements of machines with autobalancers.
"""

from statistics import fmean
from typing import Annotated, ClassVar

from abu_calc.features.design.study import SizeResult, size
from abu_calc.features.levels.study import levels
from abu_calc.foundation.checks import Status
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent, within
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import level_from_velocity, to_si, velocity_from_level
from abu_calc.inputs.read_machine import Machine, read
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.result import Provenance, Result
from abu_calc.standards.tables import toml_table
from abu_calc.standards.vibration import octave

Span = tuple[float, float]


@dataclass(frozen=True)
class FactoryRow:
    """One measurement: levels [dB], lowest and highest, in an octave [Hz]; None: not published.

    `machine`: the preset, `short`: its name in a table; `state`: idle, loaded or not said; `word`: on how it differs
    from what the model predicts.
    """

    machine: str
    short: str
    state: str
    octave: float
    without: Span | None
    fitted: Span | None
    lowered: Span | None
    word: str
    peak: str | None = None


def factory_rows() -> tuple[FactoryRow, ...]:
    """All measurements published with numbers, and the peaks named without. Source: Kladiev 1996."""
    return tuple(
        FactoryRow(
            row["machine"], row["short"], row["state"], float(row["octave"]), _span(row, "without"),
            _span(row, "with"), _span(row, "lowered"), row["word"], row.get("peak"),
        )
        for row in toml_table("factory_machines")["row"]
    )  # fmt: skip


def factory_source() -> tuple[str, str]:
    """The source, and what it says of backgrounds."""
    table = toml_table("factory_machines")
    return table["source"], table["background"]


def _span(row: dict[str, list[float]], key: str) -> Span | None:
    if key not in row:
        return None
    low, high = row[key]
    return float(low), float(high)


@record
class FactoryLevel(Record):
    """One measurement of a machine in an octave, and the prediction; null: not published, or nothing in the model."""

    machine: Annotated[str, Quantity("machine", "", 4, "the preset")]
    short: Annotated[str, Quantity("name")]
    state: Annotated[str, Quantity("state", "", 4, "idle, loaded, or not said")]
    octave_hz: Annotated[float, Quantity("octave")]
    without_measured_db: Annotated[Span | None, Quantity("without, measured", "L")]
    without_predicted_db: Annotated[
        float | None, Quantity("without, predicted", "L", 4, "idle: as taken from the file")
    ]
    with_measured_db: Annotated[Span | None, Quantity("with, measured", "L")]
    with_predicted_db: Annotated[float | None, Quantity("with, predicted", "L", 4, "idle: median of the start cases")]
    with_predicted_worst_db: Annotated[float | None, Quantity("with, the worst start", "L")]
    lowered_measured_db: Annotated[Span | None, Quantity("lowered, measured", "ΔL")]
    lowered_predicted_db: Annotated[float | None, Quantity("lowered, predicted", "ΔL", 3)]
    outside_db: Annotated[
        float | None,
        Quantity("outside what was measured", "", 2, "with it, else what it lowers"),
    ]
    difference_db: Annotated[float | None, Quantity("measured − predicted", "ΔL", 3, "mean of the range in velocity")]
    louder_octave_hz: Annotated[
        float | None, Quantity("louder octave of the model", "", 4, "pressed before the balls have settled")
    ]
    louder_octave_db: Annotated[float | None, Quantity("its level", "L")]
    named: Annotated[str | None, Quantity("named without a number")]
    word: Annotated[str, Quantity("on the difference")]


@record
class FactoryResult(Result):
    """All of them in one table."""

    command: ClassVar[str] = "factory"

    rows: tuple[FactoryLevel, ...]
    source: Annotated[str, Quantity("source")]
    background: Annotated[str, Quantity("background")]

    @property
    def status(self) -> Status:
        """A comparison passes; its differences are information."""
        return "pass"


@dataclass(frozen=True)
class _Predicted:
    """Levels [dB] in one state and octave."""

    without: float | None = None
    fitted: float | None = None
    worst: float | None = None
    louder: tuple[float, float] | None = None
    """Another octave [Hz] that is the loudest when pressed before the balls have settled, and its level."""


@checked
def factory(progress: Progress = silent) -> FactoryResult:
    """Size every machine that a factory measured, from its preset, and set the predictions beside the measurements.

    Presets hold published figures, and assumed ones where none were published. Some assumed figures were chosen by
    published results: the comments of the presets say which.
    """
    rows, sized = [], dict[str, SizeResult]()
    for row in factory_rows():
        machine = read(row.machine)
        if row.machine not in sized:
            progress(row.short)
            sized[row.machine] = size(machine, progress=within(progress, row.short))
        rows.append(_row(row, _predicted(row, machine, sized[row.machine], progress)))
    source, background = factory_source()
    return FactoryResult(
        title="Machines that a factory measured", provenance=Provenance.today(), rows=tuple(rows), source=source,
        background=background,
    )  # fmt: skip


def _predicted(row: FactoryRow, machine: Machine, design: SizeResult, progress: Progress) -> _Predicted:
    """Idle the median of the start cases, in the octave of the spindle; at work in the plane the simulated octaves.

    Pressed to the work when the balls have settled, as one works; `louder`: pressed before.
    """
    table = machine.whole()
    own = octave(to_si(table.machine.speed_rpm, "rpm")).nominal
    if row.state == "loaded" and table.grinding is not None and table.grinding.contact != "face":
        usual, hard = (_octaves(machine, start, progress) for start in ("settled", "bunched"))
        loudest, loaded = max(hard, key=hard.__getitem__), design.vibration_loaded
        louder = None if loudest == row.octave else (loudest, hard[loudest])
        before = None if loaded is None or own != row.octave else loaded.level_before_db
        return _Predicted(before, usual.get(row.octave), louder=louder)
    if own != row.octave:
        return _Predicted()
    many = design.ensemble
    if many is None:
        return _Predicted(design.vibration.level_before_db, design.vibration.level_after_db)
    known_levels = [level for level in (many.level_db.worst, design.vibration.level_after_db) if level is not None]
    return _Predicted(design.vibration.level_before_db, many.predicted_level_db, max(known_levels, default=None))


def _octaves(machine: Machine, start: str, progress: Progress) -> dict[float, float]:
    """Levels [dB] by octave [Hz] of the machine at its work, pressed with its balls there."""
    spectrum = levels(machine, "grinding", start=start, progress=progress)
    return {band.nominal_hz: band.level_db for band in spectrum.octaves if band.level_db is not None}


def _row(row: FactoryRow, forecast: _Predicted) -> FactoryLevel:
    both = forecast.without is not None and forecast.fitted is not None
    measured = row.lowered
    if measured is None and row.without is not None and row.fitted is not None:
        measured = max(0.0, row.without[0] - row.fitted[1]), row.without[1] - row.fitted[0]
    return FactoryLevel(
        machine=row.machine,
        short=row.short,
        state=row.state,
        octave_hz=row.octave,
        without_measured_db=row.without,
        without_predicted_db=forecast.without,
        with_measured_db=row.fitted,
        with_predicted_db=forecast.fitted,
        with_predicted_worst_db=forecast.worst,
        lowered_measured_db=measured,
        lowered_predicted_db=(forecast.without or 0.0) - (forecast.fitted or 0.0) if both else None,
        outside_db=_outside(row, forecast),
        difference_db=_difference(row, forecast),
        louder_octave_hz=None if forecast.louder is None else forecast.louder[0],
        louder_octave_db=None if forecast.louder is None else forecast.louder[1],
        named=row.peak,
        word=row.word,
    )


def _outside(row: FactoryRow, forecast: _Predicted) -> float | None:
    """Distance of the prediction from the measured span [dB]; None if they do not concern the same."""
    if forecast.fitted is None:
        return None
    if row.fitted is not None:
        return _gap(row.fitted, forecast.fitted)
    if row.lowered is None or forecast.without is None:
        return None
    return _gap(row.lowered, forecast.without - forecast.fitted)


def _difference(row: FactoryRow, forecast: _Predicted) -> float | None:
    """Measured − predicted [dB] with the autobalancer, the mean of the span in velocity as in [measured_after]."""
    if row.fitted is None or forecast.fitted is None:
        return None
    return level_from_velocity(fmean(map(velocity_from_level, row.fitted))) - forecast.fitted


def _gap(measured: Span, predicted: float) -> float:
    return max(0.0, measured[0] - predicted, predicted - measured[1])
