"""`abu validate FILE…`: check files and nothing else.

A file that its own commands would refuse, seconds later, is refused at once (`refuse_unusable`). A file of readings
grows from run to run: what is missing for an answer is said, with the next run.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.quantity import as_plain
from abu_calc.foundation.units import shown
from abu_calc.inputs.read_machine import Machine, read_document
from abu_calc.inputs.reading.document import Document, FileReading, open_document
from abu_calc.inputs.reading.kinds import KINDS
from abu_calc.reporting.blocks import Block, Paragraph
from abu_calc.reporting.outcome import Outcome
from abu_calc.reporting.screen import many

if TYPE_CHECKING:
    from abu_calc.features.balancing.coefficients import Stored


def refuse_unusable(source: FileReading) -> None:
    """Go the way of the file's commands as far as closed formulas lead, and simulate nothing.

    Raises InputError with file, line and key for what sizing, seats or the scenes of the file would refuse.
    """
    with source.located():
        if scene := getattr(source, "scene", None):  # a machine's check loads no equations
            from abu_calc.simulation.quiet import lasting
            from abu_calc.simulation.scene_of_file import scene_from

            lasting(scene_from(scene), None, "scene.duration_s")
        if isinstance(source, Machine):
            _machine(source)


def _machine(machine: Machine) -> None:
    if machine.tables.bearing:
        from abu_calc.features.seats.study import judged_seats

        judged_seats(machine)
    if machine.spindle is not None:
        from abu_calc.registry import imported

        imported("spindle.case:size_races")(machine)
    elif machine.autobalancers:
        _design(machine)


def _design(machine: Machine) -> None:
    from abu_calc.simulation.design_scenes import scenes_of
    from abu_calc.simulation.scene_of_design import scene_of_design
    from abu_calc.sizing import size

    design = size(machine.whole("size"))
    for name in scenes_of(design):
        try:
            scene_of_design(design, name)
        except NotTrustworthyError:  # for `abu size` to tell: the file may be right
            continue


def missing_of(source: FileReading) -> tuple[str, ...]:
    """Sentences on the runs that a file of readings still needs; empty for all other files."""
    from abu_calc.features.balancing.read import Readings

    if not isinstance(source, Readings):
        return ()
    from abu_calc.features.balancing.tolerance import missing_from

    with source.located():
        return missing_from(source)


def stored_coefficients(document: Document, overrides: Sequence[str]) -> "Stored | None":
    """Influence coefficients that a file holds; None for a file of another kind. Raises InputError for wrong ones."""
    content = document.content
    if "coefficients" not in content or content.keys() & {mark for kind in KINDS for mark in kind.marks}:
        return None
    from abu_calc.features.balancing.coefficients import coefficients_from

    if overrides:
        raise InputError(
            "stored coefficients have no entries to set", place=Place(document.file, key="--set"),
                found=", ".join(overrides),
            remedy="leave --set out",
        )  # fmt: skip
    return coefficients_from(document)


def _named(stored: "Stored") -> str:
    speeds = shown(stored.values.speeds, "rpm", ".0f", ", ")
    return (
        f"Influence coefficients of {stored.rotor}: {many(len(stored.planes), 'plane')}, "
        f"{many(len(stored.sensors), 'sensor')}, {speeds}. Use: `abu balance READINGS --coefficients FILE`."
    )


def validate(files: Sequence[str], set_: Sequence[str] = ()) -> Outcome:
    """Check files of any kind that abu reads; raises InputError with all that is wrong in them."""
    results, blocks, faults, warnings = [], list[Block](), list[InputError](), list[str]()
    for file in files:
        try:
            document = open_document(file)
            if (stored := stored_coefficients(document, set_)) is not None:
                results.append({"file": file, "sha256": stored.sha256, "overrides": {}, "defaults": {}, "warnings": []})
                blocks += [Paragraph(f"{file}: valid", "pass"), Paragraph(_named(stored), indent=4)]
                continue
            loaded = read_document(document, set_)
            refuse_unusable(loaded)
        except InputError as error:
            faults.append(error)
            continue
        defaults = dict(loaded.defaults_used)
        missing = missing_of(loaded)
        replaced = {override.key: override.value for override in loaded.overrides}
        results.append({"file": file, "sha256": loaded.sha256, "overrides": as_plain(replaced), "defaults": defaults,
                        "warnings": list(loaded.warnings),
                        **({"converted": [str(each) for each in loaded.converted]} if loaded.converted else {}),
                        **({"missing": list(missing)} if missing else {})})  # fmt: skip
        warnings += [f"{file}: {warning}" for warning in loaded.warnings]
        blocks.append(Paragraph(f"{file}: valid, {many(len(defaults), 'default')} used", "pass"))
        blocks += [Paragraph(str(conversion), indent=4) for conversion in loaded.converted]
        blocks += [Paragraph(f"! {warning}", indent=4) for warning in loaded.warnings]
        blocks += [Paragraph(line, indent=4) for line in missing]
    if len(faults) == 1:
        raise faults[0]
    if faults:
        raise InputError("\n".join(map(str, faults)))
    return Outcome("validate", {"files": results}, tuple(blocks), notes=tuple(warnings))
