"""Results as files: the suffix chooses the format, the file is written whole or not at all."""

import csv
import importlib.util
import io
import os
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from abu_calc.errors import OutputError
from abu_calc.report.outcome import Outcome, document, to_json
from abu_calc.report.text import as_text
from abu_calc.studies.quantity import flattened
from abu_calc.units import unit_of


def as_toml(outcome: Outcome) -> str:
    """The JSON document as TOML; what is null there is left out, since TOML has no null."""
    import tomli_w

    return tomli_w.dumps(_without_null(document(outcome)))


def as_csv(outcome: Outcome) -> str:
    """One row per number or text of the result: path, value, unit."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(("path", "value", "unit"))
    for path, value in flattened({"status": outcome.status, **_named(outcome.result)}):
        key = next((part for part in reversed(path.split(".")) if not part.isdigit()), path)
        writer.writerow((path, "" if value is None else value, unit_of(key)))
    for path, value in flattened({"abu": document(outcome)["abu"], "input": outcome.provenance.input or {}}):
        writer.writerow((path, value, ""))
    return buffer.getvalue()


def as_svg(outcome: Outcome) -> str:
    """Every sheet of the drawing, below one another."""
    from abu_calc.report.drawing.svg import svg_file

    return svg_file(outcome.drawings() if outcome.drawings else ())


def as_dxf(outcome: Outcome) -> str:
    """The first sheet of the drawing: what can be made by it."""
    from abu_calc.report.drawing.dxf import dxf_text

    return dxf_text((outcome.drawings() if outcome.drawings else ())[0])


def as_file(outcome: Outcome, suffix: str) -> str:
    """The text of a file with this suffix; what stands for itself is written as it is."""
    return {**FORMATS, **DRAWN}[suffix](outcome) if outcome.plain is None else outcome.plain


FORMATS: dict[str, Callable[[Outcome], str]] = {
    ".json": lambda outcome: to_json(document(outcome)) + "\n",
    ".toml": as_toml,
    ".csv": as_csv,
    ".txt": lambda outcome: as_text(outcome.blocks),
}

DRAWN: dict[str, Callable[[Outcome], str]] = {".dxf": as_dxf, ".svg": as_svg}
"""Formats of those commands alone that draw."""
NEEDS = {".dxf": "ezdxf"}
"""Packages of the extra `report`."""


def check_extra(suffix: str) -> None:
    """Refuse early a format whose package is not installed."""
    package = NEEDS.get(suffix)
    if package is not None and importlib.util.find_spec(package) is None:
        raise OutputError(
            f"{suffix} files need the package {package}, which is not installed",
            remedy='Install it: pip install "abu-calc[report]"',
        )


def check_target(path: Path, *, force: bool, suffixes: tuple[str, ...] = ()) -> None:
    """Refuse early what could not be written later: unknown suffix, missing folder, existing file without --force."""
    if suffixes and path.suffix.lower() not in suffixes:
        raise OutputError("unknown format", found=str(path), allowed="a name ending in " + " ".join(suffixes))
    if path.is_dir():
        raise OutputError(f"{path} is a folder", remedy="Give a file's name.")
    if not path.absolute().parent.is_dir():
        raise OutputError(f"{path}: the folder does not exist", remedy="Make it first.")
    if path.exists() and not force:
        raise OutputError(f"{path} exists already", remedy="Choose another name, or overwrite it with --force.")


def write(path: Path, text: str | Iterable[str]) -> None:
    """Write a file whole or not at all: beside it first, then put in its place. A long text may come in pieces."""
    try:
        _write(path, [text] if isinstance(text, str) else text)
    except OSError as error:
        raise OutputError(f"{path} cannot be written: {error.strerror}") from error


def _write(path: Path, pieces: Iterable[str]) -> None:
    handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.absolute().parent)
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
            file.writelines(pieces)
        Path(name).chmod(path.stat().st_mode if path.exists() else 0o666 & ~_umask())
        Path(name).replace(path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def _umask() -> int:
    current = os.umask(0)
    os.umask(current)
    return current


def _named(result: Any) -> dict[str, Any]:
    return result if isinstance(result, dict) else {"result": result}


def _without_null(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_null(inner) for key, inner in value.items() if inner is not None}
    if isinstance(value, (list, tuple)):
        return [_without_null(inner) for inner in value if inner is not None]
    return value
