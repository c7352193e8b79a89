"""`abu validate FILE…`: check files and nothing else."""

from typing import Annotated

import typer

from abu_calc.cli.command import Overrides, add_command
from abu_calc.errors import InputError
from abu_calc.report.blocks import Block, Paragraph
from abu_calc.report.outcome import Outcome
from abu_calc.studies.quantity import as_plain


def validate(
    files: Annotated[
        list[str], typer.Argument(metavar="FILE...", help="Files of machines, scenes or readings, or names of presets.")
    ],
    set_: Overrides = None,
) -> Outcome:
    """Check files: keys, types, ranges, rules between keys, and whether their commands would take them."""
    from abu_calc.spec.read_file import read_file
    from abu_calc.studies.usable import refuse_unusable

    results, blocks, faults, warnings = [], list[Block](), list[InputError](), list[str]()
    for file in files:
        try:
            loaded = read_file(file, set_ or ())
            refuse_unusable(loaded)
        except InputError as error:
            faults.append(error)
            continue
        defaults = dict(loaded.defaults_used)
        replaced = {override.key: override.value for override in loaded.overrides}
        results.append({"file": file, "sha256": loaded.sha256, "overrides": as_plain(replaced), "defaults": defaults,
                        "warnings": list(loaded.warnings)})  # fmt: skip
        warnings += [f"{file}: {warning}" for warning in loaded.warnings]
        blocks.append(Paragraph(f"{file}: right, {len(defaults)} defaults in force", "pass"))
        blocks += [Paragraph(f"! {warning}", indent=4) for warning in loaded.warnings]
    if len(faults) == 1:
        raise faults[0]
    if faults:
        raise InputError("\n".join(map(str, faults)))
    return Outcome("validate", {"files": results}, tuple(blocks), warnings=tuple(warnings))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "validate", validate)
