"""Bearing seats as a result and as blocks."""

from collections.abc import Sequence
from typing import Any

from abu_calc.fits.interference import Interval
from abu_calc.fits.seats import BearingSeats, SeatFit
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.standards.limits import Limits
from abu_calc.units import from_si

ROWS = (
    ("limits of the part, µm", "part_limits_um"),
    ("limits of the ring, µm", "ring_limits_um"),
    ("interference, µm", "interference_um"),
    ("probable interference, µm", "probable_interference_um"),
    ("probability of clearance", "clearance_probability"),
    ("  fields kept by sorting out", "clearance_probability_truncated"),
    ("required interference, µm", "required_interference_um"),
    ("  by", "required_by"),
    ("permitted interference, µm", "permitted_interference_um"),
    ("  by", "permitted_by"),
    ("hoop stress, MPa", "hoop_stress_MPa"),
    ("recommended field", "recommended_fit"),
)
CONVENTION = (
    "Interference is positive when tight, negative when loose; limits from the nominal size, lower … upper. Probable "
    "interference: mean ∓ root of the sum of squared half tolerances, outward to whole µm. Parts: ISO 286-2:2010, "
    "rings: ISO 492 / GOST 520."
)


def seats_result(bearing: BearingSeats) -> list[dict[str, Any]]:
    """Both seats of a bearing, shaft first; the clearance left in the bearing stands in both."""
    return [_seat(seat) | {"internal_clearance": _clearance(bearing)} for seat in bearing.seats]


def _seat(seat: SeatFit) -> dict[str, Any]:
    return {
        "name": seat.name,
        "seat": seat.seat,
        "fit": seat.fit,
        "part_limits_um": _limits(seat.part_limits),
        "ring_limits_um": _limits(seat.ring_limits),
        "interference_um": _interval(seat.interference),
        "probable_interference_um": _interval(seat.probable_interference),
        "clearance_probability": seat.clearance_probability,
        "clearance_probability_truncated": seat.truncated_probability,
        "required_interference_um": None if seat.required_interference is None else um(seat.required_interference),
        "required_by": seat.required_by,
        "losses_um": {loss.name: um(loss.value) for loss in seat.losses},
        "losses": [
            {"name": item.loss.name, "amount_um": um(item.loss.value), "formula": item.loss.formula,
             "counted": item.counted}
            for item in seat.ledger
        ],
        "permitted_interference_um": um(seat.permitted_interference),
        "permitted_by": seat.permitted_by,
        "hoop_stress_MPa": from_si(seat.hoop_stress, "MPa"),
        "recommended_fit": seat.recommended_fit,
        "admissible_fits": [
            {"fit": one.fit, "interference_um": _interval(one.interference),
             "clearance_probability": one.clearance_probability}
            for one in seat.admissible
        ],
        "load_intensity_kN_per_m": None if seat.load_intensity is None else from_si(seat.load_intensity, "kN_per_m"),
        "creep": _creep(seat),
        "requirements": _requirements(seat),
        "asked_interference_um": None if seat.asked is None else _interval(seat.asked),
        "selective_groups": seat.selection.groups if seat.selection else None,
        "selective_interference_um": _interval(seat.selection.interference) if seat.selection else None,
        "notes": list(seat.notes),
    }  # fmt: skip


def _creep(seat: SeatFit) -> dict[str, Any]:
    found = seat.creep
    return {
        "ring_load": seat.joint.ring.load,
        "verdict": found.verdict,
        "why": found.why,
        "probability": found.probability,
        "friction_moment_N_m": None if found.least_torque is None else [found.least_torque, found.probable_torque],
        "holds_at_start": found.holds_at_start,
    }


def _requirements(seat: SeatFit) -> dict[str, Any]:
    asked = seat.requirements
    return {
        "field": asked.field,
        "limits_um": _limits(asked.limits),
        "roundness_um": um(asked.form),
        "profile_um": um(asked.form),
        "roughness_Ra_um": um(asked.roughness),
        "shoulder_runout_grade": asked.shoulder_grade,
        "shoulder_runout_um": None if asked.shoulder_runout is None else um(asked.shoulder_runout),
        "hardness": asked.hardness,
        "source": asked.source,
    }


def _clearance(bearing: BearingSeats) -> dict[str, Any] | None:
    left = bearing.clearance
    if left is None:
        return None
    return {
        "group": left.group,
        "initial_um": _interval(left.initial),
        "mounted_um": _interval(left.mounted),
        "probable_um": _interval(left.probable),
        "by_temperature_um": um(left.warmth),
        "group_to_choose": left.group_to_choose,
    }


def fit_blocks(rows: Sequence[dict[str, Any]]) -> tuple[Block, ...]:
    """A table a bearing: shaft and housing side by side, notes below."""
    blocks: list[Block] = []
    for shaft, housing in zip(rows[::2], rows[1::2], strict=True):
        blocks += [Heading(f"Bearing seats: {shaft['name']}"), fit_grid(shaft, housing), *note_blocks(shaft, housing)]
    return (*blocks, Paragraph(CONVENTION))


def fit_grid(shaft: dict[str, Any], housing: dict[str, Any]) -> Grid:
    """The numbers of both seats side by side."""
    rows = tuple((label, _cell(shaft[key]), _cell(housing[key])) for label, key in ROWS)
    return Grid(("", f"shaft {shaft['fit']}", f"housing {housing['fit']}"), rows)


def note_blocks(shaft: dict[str, Any], housing: dict[str, Any]) -> list[Block]:
    """The notes of both seats, each once and told of its seat where they differ."""
    blocks: list[Block] = []
    for note in dict.fromkeys((*shaft["notes"], *housing["notes"])):
        homes = [row["seat"] for row in (shaft, housing) if note in row["notes"]]
        blocks.append(Paragraph(note if len(homes) == 2 else f"{homes[0].capitalize()}: {note}"))
    return blocks


def _cell(value: Any) -> str:
    if isinstance(value, (list, tuple)):
        return " … ".join(f"{each:g}" for each in value)
    if isinstance(value, float):
        return f"{value:.5g}" if 0.99 < value < 1 else f"{value:.4g}"
    # The source of a criterion stands in the notes and in JSON.
    return "–" if value is None else str(value).partition(" (")[0]


def um(length: float) -> float:
    """Micrometres, freed of the rounding of the conversion."""
    return round(from_si(length, "um"), 6)


def _limits(limits: Limits) -> list[float]:
    return [um(limits.lower), um(limits.upper)]


def _interval(interval: Interval) -> list[float]:
    return [um(interval.smallest), um(interval.largest)]
