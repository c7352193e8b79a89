"""Bearing seats as a result and as blocks."""

from collections.abc import Sequence
from typing import Any

from abu_calc.fits.seats import BearingSeats, SeatFit
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.units import from_si

ROWS = (
    ("tolerance class", "fit"),
    ("limits of the part, µm", "part_limits_um"),
    ("limits of the ring, µm", "ring_limits_um"),
    ("interference, µm", "interference_um"),
    ("probable interference, µm", "probable_interference_um"),
    ("probability of clearance", "clearance_probability"),
    ("required interference, µm", "required_interference_um"),
    ("  by", "required_by"),
    ("permitted interference, µm", "permitted_interference_um"),
    ("  by", "permitted_by"),
    ("hoop stress, MPa", "hoop_stress_MPa"),
    ("recommended class", "recommended_fit"),
)
CONVENTION = (
    "Interference is positive when tight; limits from the nominal size, lower … upper. Probable interference: mean ∓ "
    "root of the sum of squared half tolerances, outward to whole µm. Parts: ISO 286-2:2010, rings: ISO 492 / GOST 520."
)


def seats_result(bearing: BearingSeats) -> list[dict[str, Any]]:
    """Both seats of a bearing, shaft first."""
    return [_seat(seat) for seat in bearing.seats]


def _seat(seat: SeatFit) -> dict[str, Any]:
    return {
        "name": seat.name,
        "seat": seat.seat,
        "fit": seat.fit,
        "part_limits_um": [_um(seat.part_limits.lower), _um(seat.part_limits.upper)],
        "ring_limits_um": [_um(seat.ring_limits.lower), _um(seat.ring_limits.upper)],
        "interference_um": [_um(seat.interference.smallest), _um(seat.interference.largest)],
        "probable_interference_um": [
            _um(seat.probable_interference.smallest), _um(seat.probable_interference.largest)
        ],
        "clearance_probability": seat.clearance_probability,
        "required_interference_um": None if seat.required_interference is None else _um(seat.required_interference),
        "required_by": seat.required_by,
        "losses_um": {name: _um(loss) for name, loss in seat.losses},
        "permitted_interference_um": _um(seat.permitted_interference),
        "permitted_by": seat.permitted_by,
        "hoop_stress_MPa": from_si(seat.hoop_stress, "MPa"),
        "recommended_fit": seat.recommended_fit,
        "load_intensity_kN_per_m": None if seat.load_intensity is None else from_si(seat.load_intensity, "kN_per_m"),
        "notes": list(seat.notes),
    }  # fmt: skip


def fit_blocks(rows: Sequence[dict[str, Any]]) -> tuple[Block, ...]:
    """A table a bearing: shaft and housing side by side, notes below."""
    blocks: list[Block] = []
    for shaft, housing in zip(rows[::2], rows[1::2], strict=True):
        table = tuple((label, _cell(shaft[key]), _cell(housing[key])) for label, key in ROWS)
        blocks += [Heading(f"Bearing seats: {shaft['name']}"), Grid(("", "shaft", "housing"), table)]
        blocks += [Paragraph(note) for note in dict.fromkeys((*shaft["notes"], *housing["notes"]))]
    return (*blocks, Paragraph(CONVENTION))


def _cell(value: Any) -> str:
    if isinstance(value, (list, tuple)):
        return " … ".join(f"{each:g}" for each in value)
    if isinstance(value, float):
        return f"{value:.4g}"
    return "–" if value is None else str(value)


def _um(length: float) -> float:
    """Micrometres, freed of the rounding of the conversion."""
    return round(from_si(length, "um"), 6)
