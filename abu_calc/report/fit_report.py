"""The whole report of `abu check-fit` on one bearing after another."""

from typing import Final

from abu_calc.fits.words import of_all
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph, Picture
from abu_calc.report.fit_advice import advice_lines, bearing_table, repair_lines, sorting_blocks
from abu_calc.report.fit_zones import legend, zone_lines
from abu_calc.report.fits import CONVENTION, Seats, by_bearing, fit_grid, note_blocks
from abu_calc.report.parts import check_blocks, notices, provenance_blocks
from abu_calc.report.screen import verdict_line
from abu_calc.studies.check_fit import CheckFitResult
from abu_calc.studies.seat_parts import Clearance, Requirements
from abu_calc.studies.seat_records import SeatResult

MOST_FITS: Final = 5
"""Admissible fields shown a seat; JSON has all."""
MARKS: Final = {"holds": "pass", "creeps": "fail", "may creep": "warn", "not known": "not-done"}
AT_START: Final = {True: ", above the starting torque", False: ", below the starting torque", None: ""}


def check_fit_blocks(result: CheckFitResult) -> tuple[Block, ...]:
    """Every bearing, then checks, warnings, defaults and where it all comes from."""
    pairs = list(by_bearing(result.seats))
    table: list[Block] = [Paragraph(""), bearing_table(pairs)] if len(pairs) > 1 else []
    return (
        Heading(result.title),
        verdict_line(result),
        *table,
        *(block for pair in pairs for block in _bearing(pair)),
        Paragraph(CONVENTION),
        *check_blocks(result.checks),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def _bearing(pair: Seats) -> list[Block]:
    """Verdict, zones, numbers, losses, fields to choose from, drawing, notes of one bearing."""
    return [
        Heading(f"Bearing seats: {pair[0].name}"),
        *map(_verdict, pair),
        *advice_lines(pair),
        *repair_lines(pair),
        Paragraph(""),
        Picture(tuple(zone_lines(*pair)), legend(), indent=2),
        Paragraph(""),
        fit_grid(pair),
        *_clearance(pair[0].internal_clearance),
        *_losses(pair),
        *_fits(pair),
        *sorting_blocks(pair),
        *_drawing(pair),
        Heading("Notes"),
        *note_blocks(pair),
    ]


def _verdict(seat: SeatResult) -> Paragraph:
    ring, creep = ("Inner ring" if seat.seat == "shaft" else "Outer ring"), seat.creep
    write = f"Write {seat.recommended_fit}." if seat.recommended_fit else "No tabulated field grips and is borne."
    start = ""
    if creep.friction_moment_N_m:
        least, probable = creep.friction_moment_N_m
        start = f" Friction torque {least:.3g} N·m, probably {probable:.3g}{AT_START[creep.holds_at_start]}."
    text = f"{ring} on {seat.fit}: {creep.verdict} ({creep.why}). {write}{start}"
    return Paragraph(text, MARKS.get(creep.verdict))


def _clearance(left: Clearance | None) -> list[Block]:
    if left is None:
        return []
    rows = (
        (f"of group {left.group}, before", _span(left.initial_um)),
        ("after mounting, extreme", _span(left.mounted_um)),
        ("after mounting, probable", _span(left.probable_um)),
        ("  mean", f"{left.mean_um:.3g}"),
        ("  none left in", of_all(left.below_zero_probability, "bearings")),
        ("  taken by temperature", f"{left.by_temperature_um:.3g}"),
        ("tightest group that will do", left.group_to_choose or "–"),
    )
    return [Heading("Radial clearance in the bearing, µm"), Grid(("", ""), rows)]


def _losses(pair: Seats) -> list[Block]:
    rows = tuple(
        (seat.seat, loss.name, f"{loss.amount_um:.4g}", "counted" if loss.counted else "", loss.formula)
        for seat in pair
        if not seat.needs_no_grip
        for loss in seat.losses
    )
    heading = Heading("What the interference must cover, µm")
    return [heading, Grid(("seat", "by", "µm", "", "formula"), rows, frozenset({2}))] if rows else []


def _fits(pair: Seats) -> list[Block]:
    rows = tuple(
        (seat.seat, fit.fit, _span(fit.interference_um), of_all(fit.clearance_probability).removesuffix(" pairs"))
        for seat in pair
        for fit in seat.admissible_fits[:MOST_FITS]
    )
    grid = Grid(("seat", "field", "interference, µm", "loose"), rows)
    return [Heading("Fields that pass, the best first"), grid] if rows else []


def _drawing(pair: Seats) -> list[Block]:
    columns = [_requirements(seat.requirements) for seat in pair]
    labels = ("field", "roundness, profile, µm", "roughness Ra, µm", "shoulder runout, µm", "hardness at least")
    grid = Grid(("", "shaft", "housing"), tuple(zip(labels, *columns, strict=True)))
    source = pair[0].requirements.source
    return [Heading("For the drawing"), grid, Paragraph(f"Form, roughness and shoulder: {source}; hardness: usual.")]


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


def _span(interval: tuple[float, float]) -> str:
    return " … ".join(f"{each:.4g}" for each in interval)
