"""`abu migrate FILE`: bring a file to the newest format of keys; the difference is shown and the old file is kept.

Lines are changed where a key has another name, and nothing else: comments, order and numbers stay. The new text is read
as its commands would read it before anything is written.
"""

import difflib
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Final

import typer

from abu_calc.cli.command import add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.foundation.errors import InputError, OutputError, Place
from abu_calc.inputs.reading.document import Document, open_document, parsed
from abu_calc.inputs.reading.format import CHANGES, FORMAT, KEY, KeyChange, since
from abu_calc.inputs.reading.overrides import value_at
from abu_calc.inputs.reading.text import key_path
from abu_calc.inputs.reading.toml_text import Statement, statements
from abu_calc.reporting.blocks import Block, Paragraph
from abu_calc.reporting.outcome import Outcome
from abu_calc.reporting.screen import many

BACKUP: Final = ".bak"
"""Ending of the name under which the old file is kept, behind its own."""


def migrated_text(document: Document, changes: Sequence[KeyChange] = CHANGES) -> tuple[str, list[str]]:
    """The text of a file in the newest format, and the changed keys in words; the same text if nothing changes.

    Raises InputError for a key within an inline table, which has no line of its own, and for one that is there under
    both names.
    """
    newline = "\r\n" if "\r\n" in document.text else "\n"
    rows = document.text.split(newline)
    entries = list(statements(document.text))
    given = next((entry for entry in entries if entry.path == (KEY,)), None)
    notes = [
        note
        for change in since(_format(rows, given), tuple(changes))
        for note in _renamed(rows, entries, change, document)
    ]
    if given is None:
        notes.append(f"{KEY} = {FORMAT} added")
        # Below the comment that opens the file, above that of the first table.
        first = entries[0].line - 1 if entries else 0
        while first and rows[first - 1].strip().startswith("#"):
            first -= 1
        rows[first:first] = [f"{KEY} = {FORMAT}", ""]
    elif _format(rows, given) != FORMAT:
        place = given.line - 1
        rows[place] = re.sub(r"=\s*\d+", f"= {FORMAT}", rows[place], count=1)
        notes.append(f"{KEY} = {FORMAT}")
    return newline.join(rows), notes


def _format(rows: Sequence[str], given: Statement | None) -> int | None:
    number = None if given is None else re.search(r"=\s*(\d+)", rows[given.line - 1])
    return None if number is None else int(number[1])


def _renamed(rows: list[str], entries: Sequence[Statement], change: KeyChange, document: Document) -> Iterator[str]:
    """Renames a key in each line that has it; what was renamed, in words."""
    old = change.path[-1]
    for entry in entries:
        names = tuple(part for part in entry.path if isinstance(part, str))
        if names == change.path and not entry.header:
            if any(other.path == (*entry.path[:-1], change.name) for other in entries):
                raise InputError(
                    f"the value stands twice, as {old} and as {change.name}",
                    place=Place(document.file, entry.line, key_path(entry.path)), remedy="keep one of the two",
                )  # fmt: skip
            line = rows[entry.line - 1]
            head, sign, rest = line.partition("=")
            place = head.rfind(old)
            rows[entry.line - 1] = head[:place] + change.name + head[place + len(old) :] + sign + rest
            yield f"{key_path(entry.path)} is {change.name}: {change.why}"
        elif entry.header != "[[" and _inside(document.content, entry, change):
            raise InputError(
                f"{old} is now {change.name}", place=Place(document.file, entry.line, key_path(entry.path)),
                remedy="rename it by hand: it stands inside of an inline table, which has no lines",
            )  # fmt: skip


def _inside(content: object, entry: Statement, change: KeyChange) -> bool:
    """True if a statement is an inline table, or a list of them, that holds the key."""
    names = tuple(part for part in entry.path if isinstance(part, str))
    if entry.header or names != change.path[: len(names)] or len(names) >= len(change.path):
        return False
    held: list[object] = [value_at(content, entry.path)]
    for name in change.path[len(names) :]:
        held = [inner[name] for each in held for inner in (each if isinstance(each, list) else [each])
                if isinstance(inner, dict) and name in inner]  # fmt: skip
    return bool(held)


def difference(file: str, before: str, after: str) -> str:
    """Both texts as a unified difference."""
    lines = difflib.unified_diff(
        before.splitlines(), after.splitlines(), f"{file} (before)", f"{file} (after)", lineterm="", n=1
    )
    return "\n".join(lines)


def migrate(
    how: Delivery,
    file: Annotated[str, typer.Argument(metavar="FILE", help="File of any kind that abu reads.")],
    dry_run: Annotated[bool, option("--dry-run", "Show the difference and write nothing.")] = False,
) -> Outcome:
    """Rename keys that have changed since the file was written.

    The difference is printed. The old file is kept beside the new one, with the ending .bak.
    """
    from abu_calc.inputs.read_machine import read_document
    from abu_calc.reporting.write import Target, check_target, write

    path, document = Path(file), open_document(file)
    if not path.is_file():
        raise InputError(
            "only a file can be changed, not a preset by name, nor standard input", place=Place(file),
            remedy="Name its file, or write a copy with `abu init FILE --preset NAME`.",
        )  # fmt: skip
    raw = path.read_bytes()
    text, notes = migrated_text(document)
    result = {"file": file, "changes": notes, "format": FORMAT, "backup": None, "written": False}
    if not notes:
        return Outcome("migrate", result, (Paragraph(f"{file}: format {FORMAT} already, nothing to change", "pass"),))
    read_document(Document(file, text, "", parsed(text, file)))
    shown: list[Block] = [Paragraph(line) for line in difference(file, document.text, text).splitlines()]
    shown += [Paragraph(note, indent=4) for note in notes]
    if dry_run:
        return Outcome("migrate", result, (*shown, Paragraph(f"{file}: {many(len(notes), 'change')}, nothing written")))
    backup = path.with_name(path.name + BACKUP)
    check_target(backup, force=how.force)
    if open_document(file).sha256 != document.sha256:
        raise OutputError("changed while it was read", place=Place(file), remedy="Run it again.")
    write((Target(backup, raw),), force=how.force)
    write((Target(path, text),), force=True)
    result |= {"backup": str(backup), "written": True}
    done = Paragraph(f"{file}: {many(len(notes), 'change')} written; the old file is {backup}", "pass")
    return Outcome("migrate", result, (*shown, done))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "migrate", migrate)
