"""The report of `abu levels`: octaves against limits, weighted acceleration, exposure, loads on the hands."""

from collections.abc import Callable, Sequence

from abu_calc.features.levels.study import LevelsResult, PlaceLevel
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.parts import (
    check_blocks,
    default_blocks,
    measured_after_blocks,
    provenance_blocks,
    warning_blocks,
)
from abu_calc.reporting.screen import BLANK, one_screen, verdict_line

CONVENTIONS = (
    "Levels are 20 lg(v / 5e-8 m/s), v rms. Octaves of IEC 61260-1:2014 (base ten), by filters within 0.01 dB over "
    "three quarters of an octave; an instrument of class 1 may show a tone near an edge up to 3 dB lower. A filter "
    "settles over 28 periods of its octave, which are in no mean. Limits: GOST 17770-86. Weighted: W_h of ISO "
    "5349-1:2001, a_hv the vector sum of the axes there are; A(8) = a_hv·√(T/8 h)."
)
LEAST_DB = 20.0
"""Level below which a level says nothing [dB]: 0.5 µm/s."""


def levels_blocks(result: LevelsResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_about(result),
        *_octaves(result.places),
        *_totals(result),
        *measured_after_blocks(result.measured_after),
        *_axes(result.places),
        *check_blocks(result.checks),
        *warning_blocks(result.warnings),
        Heading("Conventions", "conventions"),
        Paragraph(CONVENTIONS),
        *default_blocks(result.provenance.defaults),
        *provenance_blocks(result.provenance),
    )


def levels_screen(result: LevelsResult) -> tuple[Block, ...]:
    """The one screen."""
    body = [*_octaves(result.places)[1:], BLANK, *_totals(result), *measured_after_blocks(result.measured_after)]
    return one_screen(result, _about(result), body)


def _about(result: LevelsResult) -> list[Block]:
    """Title, verdict, what it is about."""
    of_scene = f", {result.scene}" if result.scene and result.scene != "scene" else ""
    title = f"{result.title}: levels{of_scene}"
    return [Heading(title), verdict_line(result), Paragraph(_sentence(result))]


def _sentence(result: LevelsResult) -> str:
    where = "" if result.source == "recording" else f" at the {_place(result.loudest_place)}"
    level = "No level is known" if result.level_db is None else f"{_loud(result.level_db)}{where}"
    kind = f"recorded {result.quantity}" if result.source == "recording" else "simulated motion"
    last = f"{number(result.duration_s, 3)} s of {kind}, {number(result.sampling_rate_hz, 5)} samples a second"
    return f"{level}, the louder axis; {last}." if len(result.places[0].axes) > 1 else f"{level}; {last}."


def _loud(level: float) -> str:
    """A level to a tenth of a decibel; one below 0 dB says nothing."""
    return f"{level:.1f} dB" if level >= 0 else "< 0 dB"


def _place(name: str) -> str:
    return name if name in ("wheel plane", "axis") else f'handle "{name}"'


def _octaves(places: Sequence[PlaceLevel]) -> list[Block]:
    """Levels of each place, octave by octave, beside the limits."""
    header = ("octave, Hz", *(f"{place.name}, dB" for place in places), "limit, dB", "")
    rows = []
    for index, octave in enumerate(places[0].octaves):
        levels = [place.octaves[index].level_db for place in places]
        word = "FAIL" if any(level is not None and level > octave.limit_db for level in levels) else ""
        word = word or ("NOT EVALUATED" if octave.why_not else "")
        rows.append((f"{octave.nominal_hz:g}", *map(_tenths, levels), f"{octave.limit_db:g}", word))
    corrected = [place.corrected_level_db for place in places]
    rows.append(("corrected", *map(_tenths, corrected), "112", ""))
    return [Heading("Octaves"), Grid(header, tuple(rows), frozenset(range(1, len(places) + 2)))]


def _tenths(value: float | None) -> str:
    """Levels of nothing but rounding are not told."""
    return "–" if value is None else f"{value:.1f}" if value >= LEAST_DB else f"<{LEAST_DB:g}"


def _totals(result: LevelsResult) -> list[Block]:
    """Per place: level, velocity, weighted acceleration, exposure, load of the hand, as far as they are known."""
    columns: list[tuple[str, Callable[[PlaceLevel], str]]] = [
        ("before, dB", lambda place: _tenths(place.level_before_db)),
        ("dB", lambda place: _tenths(place.level_db)),
        ("mm/s", lambda place: _short(place.velocity_rms_mm_per_s)),
        ("µm", lambda place: _short(place.displacement_rms_um)),
        ("m/s²", lambda place: _short(place.acceleration_m_per_s2)),
        ("a_h", lambda place: _short(place.weighted_axis_m_per_s2)),
        ("a_hv", lambda place: _short(place.weighted_acceleration_m_per_s2)),
        ("A(8)", lambda place: _short(place.daily_exposure_m_per_s2)),
    ]
    filled = [(name, cell) for name, cell in columns if any(cell(place) != "–" for place in result.places)]
    rows = tuple((place.name, *(cell(place) for _, cell in filled)) for place in result.places)
    blocks: list[Block] = [Grid(("", *(name for name, _ in filled)), rows, frozenset(range(1, len(filled) + 1)))]
    loads = [
        f"{place.name} {_short(place.static_load_N)} N ({_short(place.static_load_without_N)} N without autobalancer)"
        for place in result.places
        if place.static_load_N is not None
    ]
    if loads:
        blocks.append(Paragraph(f"Held still in the air, the hands carry: {', '.join(loads)}."))
    if result.minutes is None:
        blocks.append(Paragraph("For the daily exposure A(8) give --minutes M, of work a day."))
    return blocks


def _short(value: float | None) -> str:
    return "–" if value is None else number(value, 3)


def _axes(places: Sequence[PlaceLevel]) -> list[Block]:
    """Every axis of every place, octave by octave."""
    header = ("place", "axis", *(f"{octave.nominal_hz:g}" for octave in places[0].octaves), "all", "a_h")
    rows = tuple(
        (place.name, axis.name, *map(_tenths, axis.octave_levels_db), _tenths(axis.level_db),
         _short(axis.weighted_acceleration_m_per_s2))
        for place in places
        for axis in place.axes
    )  # fmt: skip
    return [Heading("Axis by axis, dB in octaves, a_h in m/s²"), Grid(header, rows, frozenset(range(2, len(header))))]
