"""The report of `abu factory`: measured beside predicted levels, degrees of freedom spent, and remarks on the rows."""

from collections.abc import Sequence

from abu_calc.features.factory.study import DeviceNumber, FactoryLevel, FactoryResult, FittedValues, SoftRaceLevel
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.parts import provenance_blocks
from abu_calc.reporting.screen import many

Span = tuple[float, float]

NOTE = (
    "Levels in dB re 5e-8 m/s with the autobalancer, in the octave; Δ: lowered by. Model: the plane model. Idle: "
    "the median of all start cases, hot and cold oil included. Loaded: pressed to the workpiece after the balls have "
    "settled. Miss: outside the published range. –: no motion in the model. Spent: fitted values."
)
ALONG = "Sensors of {machines} measured along the spindle, where the plane model has no motion."
ESTIMATED = (
    "At handles: a rigid body estimated from assumed lengths, with assumed places of the handles. Along the spindle "
    "only this column compares."
)
LOWERED = (
    "Without: measured, and in the model. Lowered: measured, and in the model. "
    "Loudest: level with the autobalancer of the loudest start case, or expected from manufacture and "
    "friction if that is higher."
)
SPENT = (
    "Spent: degrees of freedom, values of the file that were fitted to published results. The level without the "
    "autobalancer is an input: it gives the imbalance."
)
SOFT_WHY = (
    "Friction in a soft race holds the balls before they balance. Nothing else is published of these machines. The "
    "computation assumes the machine {machine} and its design; only the friction arm changes."
)


def factory_screen(result: FactoryResult) -> tuple[Block, ...]:
    """The one screen."""
    rows = result.rows
    heading = "machine", "Hz", "published", "model", "miss", "at handles", "miss", "spent"
    cells = tuple((_title(number, row), *_cells(row)) for number, row in enumerate(rows, 1))
    along = ", ".join(dict.fromkeys(row.short for row in rows if row.axis == "z"))
    where = [ALONG.format(machines=along)] if along else []
    where += [ESTIMATED] if any(row.axis == "z" and row.at_handles_db is not None for row in rows) else []
    return (
        Heading(result.title),
        Paragraph(_verdict(rows)),
        Paragraph(""),
        Grid(heading, cells, frozenset(range(1, 8))),
        Paragraph(NOTE),
        *([Paragraph(" ".join(where))] if where else []),
        *_devices(result.devices),
        Paragraph(f"{result.background} More: --full, with soft races and a remark on each row.".strip()),
    )


def factory_blocks(result: FactoryResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *factory_screen(result)[:-1],
        *_soft_races(result.soft_races),
        Heading("Without the autobalancer, and what it lowers, dB"),
        _lowered(result.rows),
        Paragraph(LOWERED),
        Heading("Remarks"),
        *(Paragraph(f"{number} {_remark(row)}", hang=2) for number, row in enumerate(result.rows, 1)),
        Heading("Values fitted to published results"),
        Paragraph(SPENT),
        *(Paragraph(_fitted(values), hang=2) for values in result.fitted),
        *_fitted_grid(result.fitted),
        Paragraph(f"{result.background} Source: {result.source}.".strip()),
        *provenance_blocks(result.provenance),
    )


def misses(rows: Sequence[FactoryLevel]) -> list[float]:
    """Misses of the medians [dB], row by row, of the rows that the model predicts."""
    return [row.miss_db for row in rows if row.miss_db is not None]


def _verdict(rows: Sequence[FactoryLevel]) -> str:
    """Number of predictions, and by how much each misses the published range."""
    known = misses(rows)
    counted = f"The model predicts {len(known)} of {many(len(rows), 'measurement')}"
    if not known:
        return f"{counted}."
    within = sum(miss == 0 for miss in known)
    return f"{counted}, {within} within the published range. Misses of the medians: {_listed(known)} dB."


def _listed(values: Sequence[float]) -> str:
    return ", ".join(f"{value:.1f}" for value in values)


def _title(number: int, row: FactoryLevel) -> str:
    return f"{number} {row.short}{'' if row.state == 'not said' else f' {row.state}'}"


def _cells(row: FactoryLevel) -> tuple[str, ...]:
    is_level = row.with_measured_db is not None
    published = row.with_measured_db if is_level else row.lowered_measured_db
    model = row.with_predicted_db if is_level else row.lowered_predicted_db
    sign = "" if is_level else "Δ "
    handles = "–" if model is None else "not comparable"
    if row.at_handles_db is not None:
        handles = sign + "–".join(dict.fromkeys(f"{value:.0f}" for value in row.at_handles_db))
    return (
        f"{row.octave_hz:g}",
        row.named or sign + _span(published),
        "–" if model is None else f"{sign}{model:.1f}",
        _one(row.miss_db),
        handles,
        _one(row.at_handles_miss_db),
        "not said" if row.degrees_of_freedom_spent is None else f"{row.degrees_of_freedom_spent}",
    )


def _lowered(rows: Sequence[FactoryLevel]) -> Grid:
    """Levels measured without the autobalancer, and the reduction with it."""
    heading = "machine", "Hz", "without", "model", "lowered", "model", "loudest"
    cells = tuple(
        (
            _title(number, row),
            f"{row.octave_hz:g}",
            row.named or _span(row.without_measured_db),
            _one(row.without_predicted_db),
            _span(row.lowered_measured_db),
            _one(row.lowered_predicted_db),
            _one(row.with_predicted_worst_db),
        )
        for number, row in enumerate(rows, 1)
    )
    return Grid(heading, cells, frozenset(range(1, 7)))


def _remark(row: FactoryLevel) -> str:
    """The remark of the file, and the octave in which the model is louder than in this one."""
    parts = [row.word]
    if row.louder_octave_hz is not None:
        parts.append(
            f"Pressed before the balls have settled, the model is loudest at {row.louder_octave_hz:g} Hz, "
            f"{_one(row.louder_octave_db)} dB."
        )
    if row.with_predicted_db is not None and row.not_comparable is not None:
        parts.append(f"Not comparable at the handles: {row.not_comparable}.")
    return " ".join(part for part in (*parts, f"Source: {row.source}.") if part)


def _fitted(values: FittedValues) -> str:
    """Counts of one file, and its fitted keys."""
    if values.not_said:
        return f"{values.short}: {many(values.not_said, 'value')} without an origin in the file."
    keys = ", ".join(value.key.partition(".")[2] for value in values.fitted) or "none"
    return f"{values.short}: {values.published} published, {values.assumed} assumed; fitted: {keys}."


def _fitted_grid(files: Sequence[FittedValues]) -> list[Block]:
    rows = tuple((values.short, value.key, value.why) for values in files for value in values.fitted)
    return [Grid(("machine", "value", "why"), rows)] if rows else [Paragraph("None.")]


def _soft_races(races: Sequence[SoftRaceLevel]) -> list[Block]:
    """Machines with soft races: levels of an assumed machine."""
    if not races:
        return []
    heading = f"{races[0].short}, ASSUMED MACHINE", "without", "median", "loudest start case"
    cells = tuple(
        (f"friction arm {race.rolling_friction_mm:g} mm", *map(_one, (race.level_without_db, race.with_median_db,
         race.with_worst_db)))
        for race in races
    )  # fmt: skip
    why = SOFT_WHY.format(machine=races[0].assumed_machine)
    return [
        Paragraph(""),
        Grid(heading, cells, frozenset(range(1, 4))),
        Paragraph(f"Published: {races[0].published}. {why}"),
    ]


DEVICES = (
    "Balls as built, the rest as in the file; in brackets: published. The source gives no bore, wall or start. Slim: "
    "bore Ø16, walls of 2 mm. Required: in the state named, without margin. Never: from some start cases not."
)


def _devices(numbers: Sequence[DeviceNumber]) -> list[Block]:
    """Devices that the factory built, number by number."""
    if not numbers:
        return []
    columns = {(row.short, row.balls, row.state): dict[str, str]() for row in numbers}
    for row in numbers:
        time = row.quantity.endswith(", s")
        published = "" if row.published is None else f" ({'< ' if time else ''}{row.published:g})"
        missing = "never" if time else "–"
        predicted = missing if row.predicted is None else number(row.predicted, 3)
        columns[row.short, row.balls, row.state][row.quantity] = predicted + published
    rows = [("balls, Ø mm", *(key[1] for key in columns)), ("enough for", *(key[2] for key in columns))]
    rows += [(name, *(cells[name] for cells in columns.values())) for name in next(iter(columns.values()))]
    grid = Grid(("as the factory built", *(key[0] for key in columns)), tuple(rows), frozenset(range(1, len(rows))))
    return [Paragraph(""), grid, Paragraph(DEVICES)]


def _span(span: Span | None) -> str:
    return "–" if span is None else f"{span[0]:g}–{span[1]:g}"


def _one(level: float | None) -> str:
    return "–" if level is None else f"{level:.1f}"
