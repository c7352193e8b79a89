"""`abu verify [FILE|FOLDER …]`: hold machine files to the results they expect."""

import sys
import tomllib
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from abu_calc.checks import Check, overall, verdict
from abu_calc.cli.command import add_command
from abu_calc.cli.deliver import Delivery
from abu_calc.errors import InputError, Place
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.spec.read import Machine


def verify(
    how: Delivery,
    files: Annotated[
        list[str] | None, typer.Argument(metavar="[FILE|FOLDER]...", help="Machine files, folders of them, or presets.")
    ] = None,
    update: Annotated[
        bool, typer.Option("--update", help="Write the results into the files instead; comments are kept.")
    ] = False,
) -> Outcome:
    """Recompute files that have [expected] and compare; without files, the presets."""
    from abu_calc.cli.load import load
    from abu_calc.spec.bearing_file import expected_values

    blocks: list[Block] = []
    checks: list[Check] = []
    results: list[dict[str, Any]] = []
    named = _named(files)
    loaded = [load(file) for file in named]
    for index, each in enumerate(loaded, 1):
        if sys.stderr.isatty() and not how.quiet:
            print(f"{index}/{len(loaded)} {each.file}", file=sys.stderr)
        if not expected_values(each.tables) and not update:
            if not _asked_for(files, each.file):
                continue
            raise InputError(
                "nothing is expected of this file",
                place=Place(each.file, key="expected"),
                remedy=f"`abu verify --update {each.file}` writes its present results.",
            )
        found = recompute(each)
        if update:
            results.append(_update(each, found))
            blocks.append(Paragraph(f"{each.file}: {results[-1]['written']} values written", "pass"))
        else:
            _compare(each, found, blocks, checks, results)
    if not results:
        raise InputError("no file here has [expected]", found=", ".join(named), remedy="Write it with --update.")
    return Outcome(
        "verify", {"files": results}, tuple(blocks), checks=tuple(checks), status="pass" if update else overall(checks)
    )


def recompute(loaded: "Machine") -> dict[str, Any]:
    """The result of a file as paths in [expected] name it, its status included."""
    from abu_calc.cli.check_fit import fitted
    from abu_calc.cli.size import sized
    from abu_calc.spec.bearing_file import BearingFile

    whole = not isinstance(loaded.tables, BearingFile) and loaded.tables.autobalancer is not None
    outcome = None
    result = outcome.result if whole else {"fits": outcome.result}
    return {"status": outcome.status, **result}


def _compare(
    loaded: "Machine", found: dict[str, Any], blocks: list[Block], checks: list[Check], results: list[dict[str, Any]]
) -> None:
    from abu_calc.report.expected import compare, shown_value
    from abu_calc.spec.bearing_file import expected_tolerances, expected_values

    differences = compare(expected_values(loaded.tables), expected_tolerances(loaded.tables), found)
    failed = [each for each in differences if not each.passed]
    passed = not failed
    message = f"{len(differences)} values, {len(failed)} differ"
    checks.append(
        Check("ABU901", loaded.file, verdict(passed), message, float(len(failed)), 0.0, None,
              None if passed else "If the change is meant, write it with --update.")
    )  # fmt: skip
    results.append({"file": loaded.file, "values": [vars(each) for each in differences]})
    blocks.append(Paragraph(f"{loaded.file}: {message}", "pass" if passed else "fail"))
    if failed:
        rows = tuple(
            (each.path, shown_value(each.expected), shown_value(each.found),
             "" if each.deviation is None else f"{each.deviation:.2e}", f"{each.tolerance:.0e}")
            for each in failed
        )  # fmt: skip
        blocks += [Heading(loaded.file), Grid(("path", "expected", "found", "deviation", "allowed"), rows)]


def _update(loaded: "Machine", found: dict[str, Any]) -> dict[str, Any]:
    """Write the values into the file's [expected], its comments and layout kept."""
    import tomlkit

    from abu_calc.report.expected import current
    from abu_calc.report.files import write
    from abu_calc.spec.bearing_file import expected_values

    path = Path(loaded.file)
    if not path.is_file():
        raise InputError(
            "a preset cannot be updated by name",
            place=Place(loaded.file),
            remedy="Name its file, or `abu init` a copy.",
        )
    document = tomlkit.parse(loaded.text)
    table = document.setdefault("expected", tomlkit.table())
    values = current(tuple(expected_values(loaded.tables)), found)
    for key, value in values.items():
        table[key] = value
    write(path, tomlkit.dumps(document))
    return {"file": loaded.file, "written": len(values)}


def _named(files: list[str] | None) -> list[str]:
    """Files as given, folders as the machine files in them, nothing as all presets."""
    from abu_calc.spec.presets import names

    if not files:
        return list(names())
    found: list[str] = []
    for file in files:
        if Path(file).is_dir():
            inside = sorted(str(path) for path in Path(file).glob("*.toml") if _may_expect(path))
            if not inside:
                raise InputError("no machine file with [expected] in this folder", place=Place(file))
            found += inside
        else:
            found.append(file)
    return found


def _may_expect(path: Path) -> bool:
    """Whether a file in a folder is a machine's and expects something; one that cannot be read is not passed over."""
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError):
        return True
    return "machine" in tables and "expected" in tables


def _asked_for(files: list[str] | None, file: str) -> bool:
    """Whether a file was named itself, and not found in a folder or among the presets."""
    return file in (files or ())


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "verify", verify)
