"""`abu verify [FILE|FOLDER …]`: hold files of machines and readings to the results they expect."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from abu_calc.cli.command import Answer, Command, Option, Study
from abu_calc.foundation.errors import InputError, OutputError, Place
from abu_calc.foundation.progress import Progress
from abu_calc.reporting.blocks import Paragraph
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.inputs.reading.document import FileReading


def _verified(study: Study, files: Sequence[str] = (), update: bool = False, *, progress: Progress) -> Answer:
    from abu_calc.features.verify.study import expectations
    from abu_calc.inputs.bearing_file import expected_values
    from abu_calc.inputs.read_machine import read_file

    named = _named(files)
    machines = [read_file(file) for file in named]
    if update:
        return _updated(machines, progress)
    # A file named itself must expect something; one found in a folder, or a preset, may pass.
    asked = [each for each in machines if expected_values(expectations(each)) or each.file in files]
    if not asked:
        raise InputError("no file here has [expected]", found=", ".join(named), remedy="Write it with --update.")
    return study(asked, progress)


def _updated(machines: "list[FileReading]", tell: Progress) -> Outcome:
    """All files with their present values written into [expected]."""
    from abu_calc.reporting.outcome import Target, write

    paths = [_path_of(machine) for machine in machines]
    results, blocks, targets = [], [], []
    for index, (path, machine) in enumerate(zip(paths, machines, strict=True), 1):
        tell(f"{index}/{len(machines)} {machine.file}")
        text, count = _updated_text(machine)
        targets.append(Target(path, text))
        results.append({"file": machine.file, "written": count})
        blocks.append(Paragraph(f"{machine.file}: {count} values written", "pass"))
    for machine in machines:
        _refuse_changed(machine)
    write(targets, force=True)
    return Outcome("verify", {"files": results}, tuple(blocks))


def _path_of(machine: "FileReading") -> Path:
    """The file that holds a machine."""
    path = Path(machine.file)
    if not path.is_file():
        raise InputError(
            "only a file can be updated, not a preset by name, nor standard input",
            place=Place(machine.file),
            remedy="Name its file, or write a copy with `abu init FILE`.",
        )
    return path


def _updated_text(machine: "FileReading") -> tuple[str, int]:
    """The file with its values in [expected], its comments and layout kept; how many these are."""
    import tomlkit

    from abu_calc.features.verify.study import present_values

    document = tomlkit.parse(machine.text)
    table = document.setdefault("expected", tomlkit.table())
    values = present_values(machine)
    for key, value in values.items():
        table[key] = value
    return tomlkit.dumps(document), len(values)


def _refuse_changed(machine: "FileReading") -> None:
    """Nothing is written over what was edited while its results were computed."""
    from abu_calc.inputs.reading.document import open_document

    if open_document(machine.file).sha256 != machine.sha256:
        raise OutputError("changed while it was recomputed", place=Place(machine.file), remedy="Run it again.")


def _named(files: Sequence[str]) -> list[str]:
    """Files as given, folders as the files in them that expect something, nothing as all presets."""
    from abu_calc.inputs.reading.sources import names

    if not files:
        return list(names())
    paths: list[str] = []
    for file in files:
        if Path(file).is_dir():
            inside = sorted(str(path) for path in Path(file).glob("*.toml") if _may_expect(path))
            if not inside:
                raise InputError("no file with [expected] in this folder", place=Place(file))
            paths += inside
        else:
            paths.append(file)
    return paths


def _may_expect(path: Path) -> bool:
    """True if a file in a folder is of a kind that can give expected values, and gives them.

    A file that cannot be read is not skipped.
    """
    from abu_calc.inputs.reading.document import open_document
    from abu_calc.inputs.reading.kinds import kind_of

    try:
        tables = open_document(str(path)).content
    except InputError:
        return not path.is_dir()
    return "expected" in tables and kind_of(tables).name != "scene" and bool({"machine", "rotor"} & tables.keys())


COMMAND = Command(
    "verify.study:verify",
    (
        Option("files", list[str], "FILE|FOLDER", "Files of machines or readings, folders, or presets."),
        Option("update", bool, "--update", "Write the results into [expected]; comments stay."),
    ),
    "Without files, the command verifies the presets.",
    around=_verified,
    simulates=True,
)
