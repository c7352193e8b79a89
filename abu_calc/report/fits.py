"""Bearing seats as blocks: both seats of a bearing side by side."""

from collections.abc import Iterator, Sequence
from typing import Final, TypeAlias

from abu_calc.fits.words import of_all
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.studies.quantity import quantities
from abu_calc.studies.seat_records import SeatResult
from abu_calc.units import unit_of

Seats: TypeAlias = tuple[SeatResult, SeatResult]
"""Seats of one bearing: shaft, housing."""

ROWS: Final = (
    "part_limits_um",
    "ring_limits_um",
    "interference_um",
    "probable_interference_um",
    "clearance_probability",
    "clearance_probability_truncated",
    "required_interference_um",
    "required_by",
    "permitted_interference_um",
    "permitted_by",
    "hoop_stress_MPa",
    "part_stress_MPa",
    "load_ratio",
    "recommended_fit",
    "recommended_clearance",
)
BELOW: Final = {
    "clearance_probability_truncated": "  fields kept by sorting out",
    "required_by": "  by",
    "permitted_by": "  by",
    "part_stress_MPa": "  of the part, MPa",
}
"""Rows that belong to the one above them."""
SHOWN: Final = {"required_interference_um": "needed_um", "required_by": "needed_by"}
"""A ring that needs no interference shows none."""
CONVENTION = (
    "Interference is positive when tight, negative when loose; limits from the nominal size, lower … upper. Probable "
    "interference: mean ∓ root of the sum of squared half tolerances, outward to whole µm. Parts: ISO 286-2:2010, "
    "rings: ISO 492 / GOST 520."
)


def by_bearing(seats: Sequence[SeatResult]) -> Iterator[Seats]:
    """Shaft and housing of one bearing after another."""
    return zip(seats[::2], seats[1::2], strict=True)


def fit_blocks(seats: Sequence[SeatResult]) -> tuple[Block, ...]:
    """A table a bearing: shaft and housing side by side, notes below."""
    blocks: list[Block] = []
    for pair in by_bearing(seats):
        blocks += [Heading(f"Bearing seats: {pair[0].name}"), fit_grid(pair), *note_blocks(pair)]
    return (*blocks, Paragraph(CONVENTION))


def fit_grid(pair: Seats) -> Grid:
    """The numbers of both seats side by side."""
    shaft, housing = pair
    rows = tuple((_label(name), *(_cell(getattr(seat, SHOWN.get(name, name)), name) for seat in pair)) for name in ROWS)
    return Grid(("", f"shaft {shaft.fit}", f"housing {housing.fit}"), rows)


def note_blocks(pair: Seats) -> list[Block]:
    """The notes of both seats, each once, with its seat where they differ."""
    blocks: list[Block] = []
    for note in dict.fromkeys(note for seat in pair for note in seat.notes):
        homes = [seat.seat for seat in pair if note in seat.notes]
        blocks.append(Paragraph(note if len(homes) == 2 else f"{homes[0].capitalize()}: {note}"))
    return blocks


def _label(name: str) -> str:
    if name in BELOW:
        return BELOW[name]
    label, unit = quantities(SeatResult)[name].label, unit_of(name)
    return f"{label}, {unit}" if unit else label


def _cell(value: tuple[float, float] | float | str | None, name: str) -> str:
    if isinstance(value, float) and "probability" in name:
        return of_all(value).removesuffix(" pairs")
    if isinstance(value, tuple):
        return " … ".join(f"{each:g}" for each in value)
    if isinstance(value, float):
        return f"{value:.4g}"
    # The source of a criterion stands in the notes and in JSON.
    return "–" if value is None else value.partition(" (")[0]
