"""Records of the atlas: one CSV for each letter."""

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final

from tests.studies.atlas.charts import AtlasChart, CellPlace, charts, place
from tests.studies.atlas.recipe import FOLDER, CellValue

HEADER: Final = ("chart", "across", "up", "value", "low", "high", "starts", "lost", "command")
Row = Mapping[str, str]


def record(letter: str) -> Path:
    """File of a letter's cells."""
    return FOLDER / f"{family(letter)[0].file}.csv"


def family(letter: str) -> tuple[AtlasChart, ...]:
    """Charts of a letter."""
    return tuple(chart for chart in charts() if chart.letter == letter)


def letters() -> tuple[str, ...]:
    """Letters of all charts."""
    return tuple(dict.fromkeys(chart.letter for chart in charts()))


def spots(letter: str) -> list[tuple[AtlasChart, float, float]]:
    """Charts and values across and up of all cells of a letter, row by row."""
    return [(chart, x, y) for chart in family(letter) for y in chart.up.values for x in chart.across.values]


def stored(letter: str) -> dict[CellPlace, Row]:
    """Rows of a letter's record by cell."""
    if not record(letter).exists():
        return {}
    with record(letter).open(encoding="utf-8", newline="") as file:
        return {(row["chart"], row["across"], row["up"]): row for row in csv.DictReader(file)}


def row(at: CellPlace, cell: CellValue, command: str) -> Row:
    """Row of a cell."""
    numbers = (f"{number:.4f}" for number in (cell.value, cell.low, cell.high))
    return dict(zip(HEADER, (*at, *numbers, str(cell.starts), str(cell.lost), command), strict=True))


def write(letter: str, rows: Mapping[CellPlace, Row]) -> None:
    """Write a letter's record, its cells in their order."""
    order = [place(chart.name, x, y) for chart, x, y in spots(letter)]
    _written(record(letter), HEADER, [rows[at] for at in order if at in rows])


def _written(path: Path, header: Sequence[str], rows: Sequence[Row]) -> None:
    """Write a file whole or not at all."""
    whole = path.with_suffix(".new")
    with whole.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, header, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)
    whole.replace(path)
