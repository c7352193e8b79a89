"""The report of `abu levels`: octaves against limits, weighted acceleration, exposure, loads on the hands."""

from collections.abc import Callable, Sequence

from abu_calc.features.levels.study import LevelsResult, PlaceLevel
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number, or_dash
from abu_calc.reporting.parts import (
    check_blocks,
    default_blocks,
    measured_after_blocks,
    provenance_blocks,
    warning_blocks,
)
from abu_calc.reporting.screen import BLANK, one_screen, verdict_line
from abu_calc.standards.vibration import corrected_limit

CONVENTIONS = (
    "Levels are 20 lg(v / 5e-8 m/s), v rms. Bands of IEC 61260-1:2014 (base ten), by filters within 0.01 dB over "
    "three quarters of an octave, 0.15 dB of a third octave. An instrument of class 1 may show a tone near an edge up "
    "to 3 dB lower. A filter settles over 28 periods of its octave, 43 of its third octave; no mean contains them. "
    "Limits: GOST 17770-86. Weighted: W_h of ISO 5349-1:2001. a_hv is the vector sum of the known axes; A(8) = "
    "a_hv·√(T/8 h)."
)
LEAST_DB = 20.0
"""Level below which a level says nothing [dB]: 0.5 µm/s."""


def levels_blocks(result: LevelsResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_about(result),
        *_octaves(result.places),
        *_third_octaves(result.places),
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
    thirds = _third_octaves(result.places)[1:]
    bands = [*_octaves(result.places)[1:], BLANK, *thirds, *([BLANK] if thirds else [])]
    body = [*bands, *_totals(result), *measured_after_blocks(result.measured_after)]
    return one_screen(result, _about(result), body)


def _about(result: LevelsResult) -> list[Block]:
    """Title, verdict, and the level with its place and record."""
    of_scene = f", {result.scene}" if result.scene and result.scene != "scene" else ""
    title = f"{result.title}: levels{of_scene}"
    return [Heading(title), verdict_line(result), Paragraph(_sentence(result))]


def _sentence(result: LevelsResult) -> str:
    where = "" if result.loudest_place == "file" else f" at the {_place(result.loudest_place)}"
    level = "Level not known" if result.level_db is None else f"Level {_loud(result.level_db)}{where}"
    kind = f"recorded {result.quantity}" if result.source == "recording" else "simulated motion"
    axis = ", louder axis" if len(result.places[0].axes) > 1 else ""
    record = f"from {number(result.duration_s, 3)} s of {kind}, sampled at {number(result.sampling_rate_hz, 4)} Hz"
    return f"{level}{axis}, {record}."


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
        word = word or ("NOT EVALUATED" if octave.why_not else "pass")
        rows.append((f"{octave.nominal_hz:g}", *map(_tenths, levels), f"{octave.limit_db:g}", word))
    weighted, limit = [place.corrected_level_db for place in places], corrected_limit().level
    above = any(level is not None and level > limit for level in weighted)
    missing = any(octave.why_not for octave in places[0].octaves)
    word = "FAIL" if above else "NOT EVALUATED" if missing else "pass"
    rows.append(("weighted overall", *map(_tenths, weighted), f"{limit:g}", word))
    return [Heading("Octaves"), Grid(header, tuple(rows), frozenset(range(1, len(places) + 2)))]


def _third_octaves(places: Sequence[PlaceLevel]) -> list[Block]:
    """Levels of each place in the three third octaves of each octave; nothing if they were not asked for."""
    thirds = [place.third_octaves for place in places if place.third_octaves is not None]
    if not thirds:
        return []
    header = ("third octaves, Hz", *(f"{place.name}, dB" for place in places))
    rows = tuple(
        (
            "  ".join(f"{band.nominal_hz:g}" for band in thirds[0][first : first + 3]),
            *("  ".join(f"{_tenths(band.level_db):>5}" for band in bands[first : first + 3]) for bands in thirds),
        )
        for first in range(0, len(thirds[0]), 3)
    )
    return [Heading("Third octaves"), Grid(header, rows, frozenset(range(1, len(places) + 1)))]


def _tenths(value: float | None) -> str:
    """A level; one that holds only rounding has the bound alone."""
    return "–" if value is None else f"{value:.1f}" if value >= LEAST_DB else f"<{LEAST_DB:g}"


def _totals(result: LevelsResult) -> list[Block]:
    """Per place: level, velocity, weighted acceleration, exposure, load of the hand, as far as they are known."""
    columns: list[tuple[str, Callable[[PlaceLevel], str]]] = [
        ("without, dB", lambda place: _tenths(place.level_before_db)),
        ("level, dB", lambda place: _tenths(place.level_db)),
        ("mm/s", lambda place: or_dash(place.velocity_rms_mm_per_s)),
        ("µm", lambda place: or_dash(place.displacement_rms_um)),
        ("m/s²", lambda place: or_dash(place.acceleration_m_per_s2)),
        ("a_h", lambda place: or_dash(place.weighted_axis_m_per_s2)),
        ("a_hv", lambda place: or_dash(place.weighted_acceleration_m_per_s2)),
        ("A(8)", lambda place: or_dash(place.daily_exposure_m_per_s2)),
    ]
    filled = [(name, cell) for name, cell in columns if any(cell(place) != "–" for place in result.places)]
    rows = tuple((place.name, *(cell(place) for _, cell in filled)) for place in result.places)
    blocks: list[Block] = [Grid(("", *(name for name, _ in filled)), rows, frozenset(range(1, len(filled) + 1)))]
    loads = [
        f"{place.name} {or_dash(place.static_load_N)} N ({or_dash(place.static_load_without_N)} N without autobalancer)"
        for place in result.places
        if place.static_load_N is not None
    ]
    if loads:
        blocks.append(Paragraph(f"Load on each hand, machine held still in the air: {', '.join(loads)}."))
    legend = "Values are rms, a_h and a_hv weighted by W_h, in m/s²."
    if any(place.level_before_db is not None for place in result.places):
        legend = f"Without: idle, without autobalancer. {legend}"
    if result.minutes is None:
        legend += " For the daily exposure A(8), add --minutes with the minutes of use a day."
    blocks.append(Paragraph(legend))
    return blocks


def _axes(places: Sequence[PlaceLevel]) -> list[Block]:
    header = ("place", "axis", *(f"{octave.nominal_hz:g}" for octave in places[0].octaves), "all", "a_h")
    rows = tuple(
        (place.name, axis.name, *map(_tenths, axis.octave_levels_db), _tenths(axis.level_db),
         or_dash(axis.weighted_acceleration_m_per_s2))
        for place in places
        for axis in place.axes
    )  # fmt: skip
    return [Heading("Axis by axis, dB in octaves, a_h in m/s²"), Grid(header, rows, frozenset(range(2, len(header))))]
