"""The whole report of `abu check-fit` on one bearing after another."""

from collections.abc import Sequence
from typing import Any, Final

from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.fit_zones import legend, zone_lines
from abu_calc.report.fits import CONVENTION, fit_grid, note_blocks

MOST_FITS: Final = 5
"""Admissible fields shown a seat; JSON has all."""
MARKS: Final = {"holds": "pass", "creeps": "fail", "may creep": "fail", "not known": "not-done"}


def report_blocks(rows: Sequence[dict[str, Any]]) -> tuple[Block, ...]:
    """Verdict, zones, numbers, losses, fields to choose from, drawing, notes of every bearing."""
    blocks: list[Block] = []
    for pair in zip(rows[::2], rows[1::2], strict=True):
        blocks.append(Heading(f"Bearing seats: {pair[0]['name']}"))
        blocks += [_verdict(row) for row in pair]
        # A drawing is a paragraph a line, so that nothing is wrapped.
        blocks += [Paragraph(""), *(Paragraph(line) for line in zone_lines(*pair)), Paragraph(legend()), Paragraph("")]
        blocks.append(fit_grid(*pair))
        blocks += [*_clearance(pair[0]["internal_clearance"]), *_losses(pair), *_fits(pair), *_drawing(pair)]
        blocks += [Heading("Notes"), *note_blocks(*pair)]
    return (*blocks, Paragraph(CONVENTION))


def _verdict(row: dict[str, Any]) -> Paragraph:
    ring, creep = ("Inner ring" if row["seat"] == "shaft" else "Outer ring"), row["creep"]
    write = f"Write {row['recommended_fit']}." if row["recommended_fit"] else "No tabulated field is known to pass."
    start = ""
    if moments := creep["friction_moment_N_m"]:
        least, probable = (f"{moment:.3g}" for moment in moments)
        holds = {True: ", above the starting torque", False: ", below the starting torque", None: ""}
        start = f" Friction moment {least} N·m, probably {probable}{holds[creep['holds_at_start']]}."
    text = f"{ring} on {row['fit']}: {creep['verdict']} ({creep['why']}). {write}{start}"
    return Paragraph(text, MARKS.get(creep["verdict"]))


def _clearance(left: dict[str, Any] | None) -> list[Block]:
    if left is None:
        return []
    rows = (
        (f"of group {left['group']}, before", _span(left["initial_um"])),
        ("after mounting, extreme", _span(left["mounted_um"])),
        ("after mounting, probable", _span(left["probable_um"])),
        ("  taken by temperature", f"{left['by_temperature_um']:.3g}"),
        ("tightest group that will do", left["group_to_choose"] or "–"),
    )
    return [Heading("Radial clearance in the bearing, µm"), Grid(("", ""), rows)]


def _losses(pair: Sequence[dict[str, Any]]) -> list[Block]:
    rows = tuple(
        (row["seat"], loss["name"], f"{loss['amount_um']:.4g}", "counted" if loss["counted"] else "", loss["formula"])
        for row in pair
        for loss in row["losses"]
    )
    heading = Heading("What the interference must cover, µm")
    return [heading, Grid(("seat", "by", "µm", "", "formula"), rows, frozenset({2}))] if rows else []


def _fits(pair: Sequence[dict[str, Any]]) -> list[Block]:
    rows = tuple(
        (row["seat"], one["fit"], _span(one["interference_um"]), f"{one['clearance_probability']:.3g}")
        for row in pair
        for one in row["admissible_fits"][:MOST_FITS]
    )
    grid = Grid(("seat", "field", "interference, µm", "P(clearance)"), rows)
    return [Heading("Fields that pass, the best first"), grid] if rows else []


def _drawing(pair: Sequence[dict[str, Any]]) -> list[Block]:
    columns = [_requirements(row["requirements"]) for row in pair]
    labels = ("field", "roundness, profile, µm", "roughness Ra, µm", "shoulder runout, µm", "hardness at least")
    grid = Grid(("", "shaft", "housing"), tuple(zip(labels, *columns, strict=True)))
    source = pair[0]["requirements"]["source"]
    return [Heading("For the drawing"), grid, Paragraph(f"Form, roughness and shoulder: {source}; hardness: usual.")]


def _requirements(asked: dict[str, Any]) -> tuple[str, ...]:
    lower, upper = asked["limits_um"]
    runout = "" if asked["shoulder_runout_um"] is None else f" ({asked['shoulder_runout_um']:g})"
    return (
        f"{asked['field']} ({upper:+g}/{lower:+g})",
        f"{asked['roundness_um']:.2g}",
        f"{asked['roughness_Ra_um']:g}",
        f"{asked['shoulder_runout_grade']}{runout}",
        asked["hardness"],
    )


def _span(interval: list[float]) -> str:
    return " … ".join(f"{each:.4g}" for each in interval)
