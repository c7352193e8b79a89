"""Results as files: the suffix chooses the format."""

import csv
import importlib.util
import io
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from abu_calc.foundation.checks import verdict_codes
from abu_calc.foundation.errors import OutputError, escaped, escaped_toml
from abu_calc.foundation.quantity import flattened
from abu_calc.foundation.units import unit_of
from abu_calc.reporting.outcome import Outcome, document, to_json
from abu_calc.reporting.screen import as_text

if TYPE_CHECKING:
    from abu_calc.reporting.outcome import Target

FORMULAS: Final = ("=", "+", "-", "@")
"""First characters of texts that spreadsheets take for formulas."""


def as_toml(outcome: Outcome) -> str:
    """The JSON document as TOML, which has no null: such keys are left out, in a list the word keeps the place.

    A comment before it gives the verdict with its codes: the status of a pass with warnings is "pass".
    """
    import tomli_w

    verdict = f"# {verdict_codes(outcome.status, outcome.checks)}\n" if outcome.checks else ""
    return verdict + escaped_toml(tomli_w.dumps(_without_null(document(outcome))))


def as_csv(outcome: Outcome) -> str:
    """One row per number or text of the result: path, value, unit; no text is a formula to a spreadsheet."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(("path", "value", "unit"))
    for path, value in flattened({"status": outcome.status, **_named(outcome.result)}):
        key = next((part for part in reversed(path.split(".")) if not part.isdigit()), path)
        writer.writerow((_cell(path), _cell(value), unit_of(key)))
    for path, value in flattened({"abu": document(outcome)["abu"], "input": outcome.provenance.input or {}}):
        writer.writerow((_cell(path), _cell(value), ""))
    return buffer.getvalue()


def _cell(value: Any) -> Any:
    """A number as it is; text on one line, quoted where a spreadsheet would compute it."""
    if value is None or not isinstance(value, str):
        return "" if value is None else value
    text = escaped(value)
    return f"'{text}" if text.startswith(FORMULAS) else text


def as_svg(outcome: Outcome) -> str:
    """Every sheet of the drawing, below one another."""
    from abu_calc.reporting.drawings.svg import svg_file

    return svg_file(outcome.drawings() if outcome.drawings else ())


def as_dxf(outcome: Outcome) -> str:
    """The first sheet of the drawing; see `further_sheets` for the others."""
    from abu_calc.reporting.drawings.dxf import dxf_text

    return dxf_text((outcome.drawings() if outcome.drawings else ())[0])


def further_sheets(outcome: Outcome, path: Path) -> "tuple[Target, ...]":
    """The sheets after the first as files beside it, the sheet's name behind its own; DXF holds one sheet a file."""
    from abu_calc.reporting.drawings.dxf import dxf_text
    from abu_calc.reporting.outcome import Target

    if path.suffix.lower() != ".dxf" or outcome.drawings is None:
        return ()
    return tuple(
        Target(path.with_name(f"{path.stem}-{sheet.name}{path.suffix}"), dxf_text(sheet))
        for sheet in outcome.drawings()[1:]
    )


def as_pdf(outcome: Outcome) -> bytes:
    """Every sheet of the drawing on a page of its own size."""
    from abu_calc.reporting.charts.matplotlib_draw import drawings_pdf

    return drawings_pdf(outcome.drawings() if outcome.drawings else ())


def as_step(outcome: Outcome) -> str:
    """The parts as solids."""
    from abu_calc.reporting.solids.step import step_text

    if outcome.solids is None:
        raise OutputError("this result has no solids", found=".step", allowed=" ".join(FORMATS))
    return step_text(outcome.solids())


def as_html(outcome: Outcome) -> str:
    """One page that needs no other file."""
    from abu_calc.reporting.page.document import page

    return page(outcome)


def as_file(outcome: Outcome, suffix: str) -> str | bytes:
    """The text of a file with this suffix; a text that stands for itself is written as it is, under its own suffix.

    Raises OutputError for a suffix by which such a text would be taken for something else.
    """
    if outcome.plain is None or (suffix == ".json" and outcome.plain_suffix != ".json"):
        makers: dict[str, Callable[[Outcome], str | bytes]] = {**FORMATS, **DRAWN}
        return makers[suffix](outcome)
    if suffix in (outcome.plain_suffix, ".txt"):
        return outcome.plain
    raise OutputError(
        f"`abu {outcome.command}` does not write this here",
        found=suffix,
        allowed=" ".join(dict.fromkeys((outcome.plain_suffix, ".json", ".txt"))),
        remedy="Give the file a name with such an ending.",
    )


FORMATS: dict[str, Callable[[Outcome], str]] = {
    ".json": lambda outcome: to_json(document(outcome)) + "\n",
    ".toml": as_toml,
    ".csv": as_csv,
    ".txt": lambda outcome: as_text(outcome.blocks),
    ".html": as_html,
}

DRAWN: dict[str, Callable[[Outcome], str | bytes]] = {
    ".dxf": as_dxf, ".svg": as_svg, ".pdf": as_pdf, ".step": as_step, ".stp": as_step
}  # fmt: skip
"""Formats of those commands alone that draw."""
NEEDS = {".dxf": "ezdxf", ".pdf": "matplotlib"}
"""Packages of the extra `report`."""


def check_extra(suffix: str) -> None:
    """Refuse early a format whose package is not installed."""
    package = NEEDS.get(suffix)
    if package is not None and importlib.util.find_spec(package) is None:
        raise OutputError(
            f"{suffix} files need the package {package}, which is not installed",
            remedy='Install it: pip install "abu-calc[report]"',
        )


def _named(result: Any) -> dict[str, Any]:
    return result if isinstance(result, dict) else {"result": result}


def _without_null(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_null(inner) for key, inner in value.items() if inner is not None}
    if isinstance(value, (list, tuple)):
        return ["null" if inner is None else _without_null(inner) for inner in value]
    return value
