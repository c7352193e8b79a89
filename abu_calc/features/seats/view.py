"""The report of `abu check-fit`, on one screen and whole: advice, both seats, zones, losses, sorting.

The one screen says first what to specify, then gives each seat a line.
"""

from collections.abc import Iterator, Sequence
from typing import Final, TypeAlias

from abu_calc.features.seats.clearance import Clearance
from abu_calc.features.seats.drawing_requirements import Repair, Requirements
from abu_calc.features.seats.interference import Pair, of_all, um_pair
from abu_calc.features.seats.joints import ROOM, assumes_warmth
from abu_calc.features.seats.seats import BearingSeats, SeatResult
from abu_calc.features.seats.study import CheckFitResult
from abu_calc.features.seats.zones import legend, zone_lines
from abu_calc.foundation.errors import shortened
from abu_calc.foundation.quantity import quantities
from abu_calc.foundation.units import unit_of
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, Picture, capitalised, number
from abu_calc.reporting.parts import check_blocks, notices, provenance_blocks
from abu_calc.reporting.screen import BLANK, cut, one_screen, verdict_line
from abu_calc.standards.tolerance_classes import NORMAL_RATIO

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
    "short_pairs_share",
    "pressure_kept",
    "load_ratio",
    "catalogue_fit",
    "rule_fit",
    "recommended_fit",
    "recommended_clearance",
)
BELOW: Final = {
    "clearance_probability_truncated": "  parts beyond limits sorted out",
    "required_by": "  by",
    "permitted_by": "  by",
    "part_stress_MPa": "  of the part, MPa",
}
"""Rows that belong to the one above them."""
SHOWN: Final = {"required_interference_um": "needed_um", "required_by": "needed_by"}
"""A ring that needs no interference shows none."""
CONVENTION = (
    "Interference; negative: clearance. Limits count from the nominal size, lower … upper. Probable "
    "interference: mean ∓ root of the sum of squared half tolerances, outward to whole µm. Parts: ISO 286-2:2010, "
    "rings: ISO 492:2014 / GOST 520-2011, not held against ISO 492:2023."
)


def by_bearing(seats: Sequence[SeatResult]) -> Iterator[Seats]:
    """Shaft and housing of one bearing after another."""
    return zip(seats[::2], seats[1::2], strict=True)


def fit_blocks(seats: Sequence[SeatResult]) -> tuple[Block, ...]:
    """A table a bearing: shaft and housing side by side; below them the notes of all, each once."""
    blocks: list[Block] = []
    for pair in by_bearing(seats):
        blocks += [Heading(f"Bearing seats: {pair[0].name}"), fit_grid(pair)]
    return (*blocks, *note_blocks(seats), Paragraph(CONVENTION))


def fit_grid(pair: Seats) -> Grid:
    """The numbers of both seats side by side."""
    shaft, housing = pair
    rows = tuple((_label(name), *(_cell(getattr(seat, SHOWN.get(name, name)), name) for seat in pair)) for name in ROWS)
    return Grid(("", f"shaft {shaft.fit}", f"housing {housing.fit}"), rows)


def note_blocks(seats: Sequence[SeatResult]) -> list[Block]:
    """The notes of all seats, each once, with its seats unless it concerns them all."""
    blocks: list[Block] = []
    for note in dict.fromkeys(note for seat in seats for note in seat.notes):
        homes = [seat for seat in seats if note in seat.notes]
        blocks.append(Paragraph(f"{_places(homes, seats)}{note}"))
    return blocks


def _places(homes: Sequence[SeatResult], seats: Sequence[SeatResult]) -> str:
    """Seats that a note concerns, before it; empty if these are all."""
    if len(homes) == len(seats):
        return ""
    kinds = list(dict.fromkeys(seat.seat for seat in homes))
    of_kinds = [seat for seat in seats if seat.seat in kinds]
    names = [] if len(homes) == len(of_kinds) else list(dict.fromkeys(seat.name for seat in homes))
    places = ", ".join([*names, *(kinds if len(kinds) == 1 else [])])
    return f"{places[:1].upper()}{places[1:]}: " if places else ""


def _label(name: str) -> str:
    if name in BELOW:
        return BELOW[name]
    label, unit = quantities(SeatResult)[name].label, unit_of(name)
    return f"{label}, {unit}" if unit else label


def _cell(value: tuple[float, float] | float | str | None, name: str) -> str:
    if isinstance(value, float) and ("probability" in name or name == "short_pairs_share"):
        return of_all(value).removesuffix(" pairs")
    if isinstance(value, float) and name == "pressure_kept":
        return f"{value:.0%}"
    if isinstance(value, tuple):
        return " … ".join(f"{each:g}" for each in value)
    if isinstance(value, float):
        return f"{value:.4g}"
    # The source of a criterion stands in the notes and in JSON.
    return "–" if value is None else value.partition(" (")[0]


NO_CLASS: Final = "No tabulated tolerance class both holds the ring and is permitted."
NAME = 22
"""Signs of a bearing's name in a table: more would be wrapped, and a wrapped name may look like a verdict."""
VERDICTS = {"pass": "pass", "warn": "WARN", "fail": "FAIL", "not-done": "NOT EVALUATED"}


def advice_lines(pair: Seats) -> list[Block]:
    """The tolerance classes to specify with the clearance to order, then the nearest ones that fail."""
    shaft, housing = pair
    if shaft.recommended_fit is None and housing.recommended_fit is None:
        return [Paragraph(NO_CLASS)]
    fits = [f"{seat.seat} {seat.recommended_fit}" for seat in pair if seat.recommended_fit]
    none = [f" No tabulated class of the {seat.seat} passes." for seat in pair if not seat.recommended_fit]
    lines: list[Block] = [
        Paragraph(f"Specify {', '.join([*fits, *_order(shaft, housing)])}{_ratio(shaft)}.{''.join(none)}")
    ]
    wrong = tuple((f"{seat.seat} {rejected.fit}", rejected.why) for seat in pair for rejected in seat.rejected_fits)
    return [*lines, Grid(("rejected", "reason"), wrong)] if wrong else lines


def bearing_table(pairs: Sequence[Seats]) -> Grid:
    """A line a bearing: its tolerance classes, the verdict, the advice."""
    rows = tuple(
        (shortened(shaft.name, NAME), shaft.fit, housing.fit, VERDICTS[shaft.bearing_verdict], _short(shaft, housing))
        for shaft, housing in pairs
    )
    return Grid(("bearing", "shaft", "housing", "verdict", "specify"), rows)


def repair_lines(pair: Seats) -> list[Block]:
    """Lines on the interference left in measured seats, and on the limits that a repair must restore."""
    return [
        Paragraph(f"{seat.seat.capitalize()} as measured: {_repair(seat, seat.repair)}") for seat in pair if seat.repair
    ]


def sorting_blocks(pair: Seats) -> list[Block]:
    """The groups of selective assembly for the bench."""
    blocks: list[Block] = []
    for seat in pair:
        if not seat.sorting_groups:
            continue
        ring = "bore" if seat.seat == "shaft" else "outer ring"
        rows = tuple(
            (str(group.number), _span(group.part_limits_um), _span(group.ring_limits_um), _span(group.interference_um),
             f"{group.pairs_of_100:.3g}")
            for group in seat.sorting_groups
        )  # fmt: skip
        header = ("group", f"{seat.seat}, µm", f"{ring}, µm", "interference, µm", "pairs of 100")
        blocks += [
            Heading(f"Sorting of {seat.name}: parts of one group go together"),
            Grid(header, rows, frozenset({4})),
        ]
    return blocks


def _repair(seat: SeatResult, fix: Repair) -> str:
    (low, high), (least, most) = fix.grip_left_um, fix.restore_limits_um
    needed = "" if seat.needed_um is None else f", {seat.needed_um:.3g} µm required"
    left = f"interference after losses {low:.3g} … {high:.3g} µm{needed}"
    if least <= seat.part_limits_um[0] and seat.part_limits_um[1] <= most:
        return f"{left}. The seat is within {fix.restore_fit}: no repair is needed."
    bond = f" Or bond the ring: the gap is up to {fix.bonding_gap_um:.3g} µm." if fix.bonding_gap_um > 0 else ""
    next_size = ""
    if fix.next_bearing is not None:
        how, other = ("turn down", "housing") if seat.seat == "shaft" else ("bore out", "shaft")
        next_size = (
            f" Or {how} to {fix.next_seat_mm:g} mm for bearing {fix.next_bearing}, and fit the {other} to that bearing."
        )
    return (
        f"{left}. To restore {fix.restore_fit}, finish a sleeve or sprayed metal to {least:+g} … {most:+g} µm."
        f"{bond}{next_size or ' The next size is not tabulated.'}"
    )


def _short(shaft: SeatResult, housing: SeatResult) -> str:
    fits = f"{shaft.recommended_fit or '–'}/{housing.recommended_fit or '–'}"
    group = shaft.clearance_of_recommended or shaft.recommended_clearance
    return ", ".join([fits, *([group] if group else [])])


def _order(shaft: SeatResult, housing: SeatResult) -> list[str]:
    left, group = shaft.internal_clearance, shaft.recommended_clearance
    if group is None:
        tried = left and shaft.recommended_fit and housing.recommended_fit
        return ["but no tabulated clearance group keeps clearance"] if tried else []
    own = shaft.clearance_of_recommended or group
    given = f" ({group} for the classes given)" if own != group else ""
    return [f"clearance {own}{given}{f' in place of {left.group}' if left and left.group != group else ''}"]


def _ratio(shaft: SeatResult) -> str:
    if shaft.joint.load_assumed:
        return f" (P/C = {NORMAL_RATIO:g}, a normal load, assumed)"
    return "" if shaft.load_ratio is None else f" (P/C = {shaft.load_ratio:.2g})"


def _span(interval: tuple[float, float]) -> str:
    return " … ".join(f"{round(each, 2):g}" for each in interval)


SIGN: Final = (
    "Interference in µm, loosest to tightest pair; negative: clearance. A ring whose load is fixed in direction "
    "requires none."
)
MOST_LINES: Final = 24
"""Most lines of the table of several bearings; the whole report has the rest."""


def check_fit_screen(result: CheckFitResult) -> tuple[Block, ...]:
    """The one screen: of one bearing the advice and its seats, of several a table of them all."""
    pairs = list(by_bearing(result.seats))
    sizes = ", ".join(f"{seat.seat} Ø{seat.diameter_mm:g} mm" for seat in result.seats) if len(pairs) == 1 else ""
    title = f"Bearing seats: {result.title}{f', {sizes}' if sizes else ''}"
    about: list[Block] = [Heading(title), verdict_line(result)]
    if len(pairs) > 1:
        about += [BLANK, *cut([bearing_table(pairs)], MOST_LINES)]
    else:
        about += [line for pair in pairs for line in advice_lines(pair)]
    body: list[Block] = []
    names = _that_differ(result.judged)
    for judged in result.judged:
        body += _states(judged, names, several=len(pairs) > 1)
    inside = " Inside: what 99 of 100 bearings have, with a catalogue's own classes 95."
    told = inside if any(judged.group_inside for judged in result.judged) else ""
    body.append(Paragraph(f"{SIGN}{told} {_temperatures_told(result.judged, names)}"))
    body += _below_required(result.judged)
    for pair in pairs:
        repairs = repair_lines(pair)
        asked = result.judged[pairs.index(pair)].bearing.asked_interference is not None
        body += [
            *repairs,
            *(sorting_blocks(pair) if asked else ()),
            *([] if repairs else mounting_lines(pair, named=len(pairs) > 1)),
        ]
    return one_screen(result, about, body, ("--explain, every formula with its numbers",))


STATES: Final = ("cold", "mounted", "hot")


def _states(judged: BearingSeats, names: Sequence[str], *, several: bool) -> list[Block]:
    """Both seats and the clearance inside the bearing in the states named; required and permitted."""
    rows = [
        (seat.seat, seat.fit, *(_whole(_in_state(seat, name)) for name in names),
         "none" if seat.needs_no_grip else _required(seat.required_interference_um),
         _permitted(seat.permitted_interference_um))
        for seat in judged.seats
    ]  # fmt: skip
    if inside := judged.clearance_at_work:
        spans = (_whole(um_pair(inside[name])) for name in names)
        rows.append(("inside", judged.group_inside or "", *spans, "clearance", ""))
    first = shortened(judged.shaft.name, 16) if several else ""
    right = frozenset({len(names) + 2, len(names) + 3})
    return [Grid((first, "class", *names, "required", "permitted"), tuple(rows), right)]


def _in_state(seat: SeatResult, name: str) -> Pair:
    """Interference [µm] in a state."""
    at_work: Pair = seat.interference_um if name == "mounted" else seat.at_work_um[name]
    return at_work


def _that_differ(judged: Sequence[BearingSeats]) -> tuple[str, ...]:
    """The state as mounted, and those in which a seat or the clearance inside is another."""

    def differs(name: str) -> bool:
        return any(
            any(_in_state(seat, name) != seat.interference_um for seat in each.seats)
            or (bool(each.clearance_at_work) and _whole(um_pair(each.clearance_at_work[name]))
                != _whole(um_pair(each.clearance_at_work["mounted"])))
            for each in judged
        )  # fmt: skip

    return tuple(name for name in STATES if name == "mounted" or differs(name))


def _below_required(judged: Sequence[BearingSeats]) -> list[Block]:
    """Seats that pass although some pairs have less than the rule for the load asks for."""
    seats = [seat for each in judged for seat in each.seats if seat.joint.must_grip and seat.joint.grip == "pass"]
    short = [
        (seat.fit, seat.joint.short)
        for seat in seats
        if seat.joint.short and seat.interference_um[0] < (seat.needed_um or 0.0)
    ]
    return [
        Paragraph(f"{of_all(share)} of {fit} have less than required; the catalogue gives this class.")
        for fit, share in short[:1]
    ]


def _whole(span: tuple[float, float]) -> str:
    """A span to whole micrometres where it is wide, else to three digits."""
    return " … ".join(f"{each:.3g}" if abs(each) < 10 else f"{each:.0f}" for each in span)


def _temperatures_told(judged: Sequence[BearingSeats], names: Sequence[str]) -> str:
    """Temperatures of the states, whether they are assumed, and which are alike."""
    told = {_told_of(each, names) for each in judged}
    return told.pop() if len(told) == 1 else "The temperatures of cold and hot are those of each bearing."


def _told_of(judged: BearingSeats, names: Sequence[str]) -> str:
    seats = judged.seats
    cold, hot = {seat.joint.coldest.rise for seat in seats}, {seat.joint.hottest.rise for seat in seats}
    if None in hot:
        return "Hot: with the temperature differences given."
    low, high = (end or 0.0 for end in (min(cold), max(hot)))  # type: ignore[type-var]
    assumed = f"both are assumed: --temperature-range {low:g}:{high:g}, in K above {ROOM:g} °C"
    shown = {"cold": f"{ROOM + low:g} °C", "hot": f"{ROOM + high:g} °C"}
    alike = [f"{name} ({text})" for name, text in shown.items() if name not in names]
    apart = [f"{name} is {text}" for name, text in shown.items() if name in names]
    verb = "are" if len(alike) > 1 else "is"
    sentences = ([f"{' and '.join(alike)} {verb} as mounted"] if alike else []) + ([", ".join(apart)] if apart else [])
    sentences += [assumed] if assumes_warmth(judged.bearing) else []
    return " ".join(f"{capitalised(sentence)}." for sentence in sentences)


def mounting_lines(pair: Seats, *, named: bool) -> list[Block]:
    """How each ring gets onto its seat, and when a housing lets it go."""
    name = f"{pair[0].name}: " if named else ""
    return [Paragraph(f"{name}{text}") for seat in pair if (text := _mounting(seat))]


def _mounting(seat: SeatResult) -> str:
    way = seat.mounting
    hot = way.heat_ring_C if seat.seat == "shaft" else way.heat_housing_C
    if hot is None or way.press_force_N is None:
        return "The outer ring slides into its housing." if seat.seat == "housing" else ""
    least, most = (f"{force / 1e3:.3g}" for force in way.press_force_N)
    press = f"or press with {least} … {most} kN"
    clear = f"{way.mounting_clearance_um:.3g} µm of clearance"
    if seat.seat == "housing":
        apart = way.lets_go_at_C
        go = "" if apart is None else f" When warm it lets the ring go, from {apart[0]:.0f} … {apart[1]:.0f} °C on."
        return f"Mount the outer ring: heat the housing to {hot:.0f} °C ({clear}), {press}.{go}"
    if way.cool_part_C is not None:
        heat = f"{way.hottest_C:g} °C, the hottest permitted, and cool the shaft to {way.cool_part_C:.0f} °C"
        return f"Mount the inner ring: {press.removeprefix('or ')}. Or heat it to {heat} ({clear})."
    return f"Mount the inner ring: heat it to {hot:.0f} °C ({clear}; at most {way.hottest_C:g} °C), {press}."


def _required(value: float | None) -> str:
    return "not known" if value is None else f"≥ {number(value, 3)}"


def _permitted(value: float | None) -> str:
    return "–" if value is None else f"≤ {number(value, 3)}"


MOST_FITS: Final = 5
"""Admissible tolerance classes shown a seat; JSON has all."""
CREEP: Final = {"needs no grip": "requires no interference"}
"""Verdicts on creep as people read them, if they differ from JSON."""
AT_START: Final = {True: "above the starting torque", False: "BELOW the starting torque", None: "–"}


def check_fit_blocks(result: CheckFitResult) -> tuple[Block, ...]:
    """Every bearing, then checks, warnings, defaults and where it all comes from."""
    pairs = list(by_bearing(result.seats))
    table: list[Block] = [Paragraph(""), bearing_table(pairs)] if len(pairs) > 1 else []
    return (
        Heading(result.title),
        verdict_line(result),
        *table,
        *(block for index, pair in enumerate(pairs, 1) for block in _bearing(index, pair)),
        *_readings(result.seats),
        *check_blocks(result.checks),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def section_of(index: int) -> str:
    """Id of the section of a bearing, counted from one."""
    return f"bearing-{index}"


def _readings(seats: Sequence[SeatResult]) -> list[Block]:
    """Notes and conventions of all bearings, each once."""
    sources = dict.fromkeys(seat.requirements.source for seat in seats)
    drawing = f"Drawings: form, roughness and shoulder by {', '.join(sources)}; hardness is usual practice."
    return [Heading("Notes"), *note_blocks(seats), Paragraph(drawing), Paragraph(CONVENTION)]


def _bearing(index: int, pair: Seats) -> list[Block]:
    """Verdict, zones, numbers, losses, tolerance classes to choose from and drawing of one bearing."""
    caption = legend() if index == 1 else "Zones as above."
    return [
        Heading(f"Bearing seats: {pair[0].name}", section_of(index)),
        *advice_lines(pair),
        Paragraph(""),
        _creep(pair),
        *repair_lines(pair),
        Paragraph(""),
        Picture(tuple(zone_lines(*pair)), caption, indent=2),
        Paragraph(""),
        fit_grid(pair),
        *_bearing_life(pair[0]),
        *_temperatures(pair),
        *_clearance(pair[0].internal_clearance),
        *_losses(pair),
        *_fits(pair),
        *sorting_blocks(pair),
        *_drawing(pair),
    ]


def _creep(pair: Seats) -> Grid:
    """Creep and slip torque of both rings."""
    columns = [_creep_of(seat) for seat in pair]
    labels = ("", "creep", "  because", "slip torque, N·m: least, probable", "  least slip torque")
    rows = tuple(row for row in zip(labels[1:], *columns, strict=True) if any(cell != "–" for cell in row[1:]))
    header = tuple(f"{'inner' if seat.seat == 'shaft' else 'outer'} ring on {seat.fit}" for seat in pair)
    return Grid(("", *header), rows)


def _creep_of(seat: SeatResult) -> tuple[str, ...]:
    creep = seat.creep
    torques = "–"
    if creep.friction_moment_N_m:
        torques = ", ".join(f"{torque:.3g}" for torque in creep.friction_moment_N_m)
    return CREEP.get(creep.verdict, creep.verdict), creep.why, torques, AT_START[creep.holds_at_start]


LIFE: Final = (
    "catalogue_bearing",
    "dynamic_load_rating_kN",
    "static_load_rating_kN",
    "equivalent_load_kN",
    "static_load_kN",
    "static_safety",
    "basic_rating_life_h",
    "life_modification",
    "modified_rating_life_h",
    "limiting_speed_rpm",
)
"""Fields of the bearing itself, alike in the records of both seats."""


def _bearing_life(seat: SeatResult) -> list[Block]:
    """Load ratings, safety and lives, as far as they are known."""
    rows = [(_label(name), _life_cell(getattr(seat, name))) for name in LIFE if getattr(seat, name) is not None]
    if seat.simulated_life is not None:
        lives = seat.simulated_life
        rows += [
            ("life in this machine without the autobalancer, h", _life_cell(lives.life_without_h)),
            ("  with the autobalancer, h", _life_cell(lives.life_with_h)),
        ]
    return [Heading("Static safety and rating life"), Grid(("", ""), tuple(rows))] if rows else []


def _life_cell(value: float | str) -> str:
    return value if isinstance(value, str) else number(value, 3)


CASES: Final = ("mounting", "working", "lowest", "highest")
"""Temperature cases in their order."""


def _temperatures(pair: Seats) -> list[Block]:
    """Interference at mounting, at work, at the lowest and highest temperature, where one is given for either seat."""
    shaft, housing = ({case.case: case for case in seat.interference_by_temperature} for seat in pair)
    names = sorted(shaft.keys() | housing.keys(), key=CASES.index)
    if len(names) < 2:  # mounting alone is in the table above
        return []
    known = {**housing, **shaft}
    rows = tuple(
        (name, "–" if known[name].rise is None else f"{known[name].rise:+g}",
         *("–" if name not in cases else _span_text(cases[name].interference_um) for cases in (shaft, housing)))
        for name in names
    )  # fmt: skip
    header = ("case", "K over mounting", "shaft, µm", "housing, µm")
    return [Heading("Interference by temperature"), Grid(header, rows)]


def _clearance(left: Clearance | None) -> list[Block]:
    if left is None:
        return []
    preload = () if left.preload_N is None else (("  preload of the pair, N", _span_text(left.preload_N)),)
    rows = (
        (f"of group {left.group}, before", _span_text(left.initial_um)),
        ("after mounting, extreme", _span_text(left.mounted_um)),
        ("after mounting, probable", _span_text(left.probable_um)),
        ("  mean", f"{left.mean_um:.3g}"),
        *preload,
        ("  no clearance left in", of_all(left.below_zero_probability, "bearings")),
        ("  taken by temperature", f"{left.by_temperature_um:.3g}"),
        ("tightest group that passes", left.group_to_choose or "–"),
    )
    name = "Axial clearance of the pair, µm" if left.axial else "Radial clearance in the bearing, µm"
    return [Heading(name), Grid(("", ""), rows)]


def _losses(pair: Seats) -> list[Block]:
    rows = tuple(
        (seat.seat, loss.name, f"{loss.amount_um:.4g}", "counted" if loss.counted else "", loss.formula)
        for seat in pair
        if not seat.needs_no_grip
        for loss in seat.losses
    )
    heading = Heading("Losses of interference, µm")
    return [heading, Grid(("seat", "by", "µm", "", "formula"), rows, frozenset({2}))] if rows else []


def _fits(pair: Seats) -> list[Block]:
    rows = tuple(
        (seat.seat, fit.fit, _span_text(fit.interference_um), of_all(fit.clearance_probability).removesuffix(" pairs"))
        for seat in pair
        for fit in seat.admissible_fits[:MOST_FITS]
    )
    grid = Grid(("seat", "class", "interference, µm", "pairs with clearance"), rows)
    return [Heading("Classes that pass, best first"), grid] if rows else []


def _drawing(pair: Seats) -> list[Block]:
    columns = [_requirements(seat.requirements) for seat in pair]
    labels = (
        "tolerance class",
        "roundness, profile, µm",
        "roughness Ra, µm",
        "shoulder runout, µm",
        "hardness at least",
    )
    grid = Grid(("", "shaft", "housing"), tuple(zip(labels, *columns, strict=True)))
    return [Heading("For the drawing"), grid]


def _requirements(asked: Requirements) -> tuple[str, ...]:
    lower, upper = asked.limits_um
    runout = "" if asked.shoulder_runout_um is None else f" ({asked.shoulder_runout_um:g})"
    return (
        f"{asked.field} ({upper:+g}/{lower:+g})",
        f"{asked.roundness_um:.2g}",
        f"{asked.roughness_Ra_um:g}",
        f"{asked.shoulder_runout_grade}{runout}",
        asked.hardness,
    )


def _span_text(interval: tuple[float, float]) -> str:
    return " … ".join(f"{each:.4g}" for each in interval)
