"""Advice on bearing seats in words: drawing entries, orders, repair and sorting."""

from collections.abc import Sequence

from abu_calc.escapes import shortened
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.fits import Seats
from abu_calc.studies.seat_parts import Repair
from abu_calc.studies.seat_records import SeatResult

NAME = 22
"""Signs of a bearing's name in a table: more would be wrapped, and a wrapped name may look like a verdict."""
VERDICTS = {"pass": "PASS", "warn": "PASS, warning", "fail": "FAIL", "not-done": "NOT DONE"}


def advice_lines(pair: Seats) -> list[Paragraph]:
    """The fields to write with the clearance to order, then the nearest ones that will not do."""
    shaft, housing = pair
    if shaft.recommended_fit is None and housing.recommended_fit is None:
        return [Paragraph("No tabulated field both grips and is borne.")]
    fits = [f"{seat.seat} {seat.recommended_fit}" for seat in pair if seat.recommended_fit]
    none = [f" No tabulated field of the {seat.seat} will do." for seat in pair if not seat.recommended_fit]
    lines = [Paragraph(f"Write {', '.join([*fits, *_order(shaft)])}{_ratio(shaft)}.{''.join(none)}")]
    wrong = [f"{rejected.fit}: {rejected.why}" for seat in pair for rejected in seat.rejected_fits]
    return [*lines, Paragraph(f"Not {'; not '.join(wrong)}.")] if wrong else lines


def bearing_table(pairs: Sequence[Seats]) -> Grid:
    """A line a bearing: its fits, the verdict, the advice."""
    rows = tuple(
        (shortened(shaft.name, NAME), shaft.fit, housing.fit, VERDICTS[shaft.bearing_verdict], _short(shaft, housing))
        for shaft, housing in pairs
    )
    return Grid(("bearing", "shaft", "housing", "verdict", "write"), rows)


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
        header = ("group", f"{seat.seat}, µm", f"{ring}, µm", "tight by, µm", "pairs of 100")
        blocks += [
            Heading(f"Sorting of {seat.name}: parts of one group go together"),
            Grid(header, rows, frozenset({4})),
        ]
    return blocks


def _repair(seat: SeatResult, fix: Repair) -> str:
    (low, high), (least, most) = fix.grip_left_um, fix.restore_limits_um
    needed = "" if seat.needed_um is None else f", {seat.needed_um:.3g} needed"
    if least <= seat.part_limits_um[0] and seat.part_limits_um[1] <= most:
        return f"grip left {low:.3g} … {high:.3g} µm{needed}; within {fix.restore_fit}, no repair is needed."
    bond = f" a bond must fill {fix.bonding_gap_um:.3g} µm;" if fix.bonding_gap_um > 0 else ""
    next_size = ""
    if fix.next_bearing is not None:
        how, other = ("turn down", "housing") if seat.seat == "shaft" else ("bore out", "shaft")
        next_size = f" or {how} to {fix.next_seat_mm:g} mm for {fix.next_bearing}, with its own size in the {other}"
    return (
        f"grip left {low:.3g} … {high:.3g} µm{needed}. To bring it back to {fix.restore_fit}, finish a sleeve or "
        f"sprayed metal to {least:+g} … {most:+g} µm;{bond}{next_size or ' the next size is not tabulated'}."
    )


def _short(shaft: SeatResult, housing: SeatResult) -> str:
    fits = f"{shaft.recommended_fit or '–'}/{housing.recommended_fit or '–'}"
    return ", ".join([fits, *([shaft.recommended_clearance] if shaft.recommended_clearance else [])])


def _order(shaft: SeatResult) -> list[str]:
    left, group = shaft.internal_clearance, shaft.recommended_clearance
    if group is None:
        return ["no tabulated clearance keeps it"] if left else []
    return [f"clearance {group}{f' in place of {left.group}' if left and left.group != group else ''}"]


def _ratio(shaft: SeatResult) -> str:
    return "" if shaft.load_ratio is None else f" (P/C = {shaft.load_ratio:.2g})"


def _span(interval: tuple[float, float]) -> str:
    return " … ".join(f"{round(each, 2):g}" for each in interval)
