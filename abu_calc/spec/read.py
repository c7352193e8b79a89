"""Reading a machine file: path or preset → text → document → overrides → model, every fault told with its place."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from pydantic import ValidationError

from abu_calc.errors import InputError, Place
from abu_calc.spec import presets
from abu_calc.spec.errors import Origin, told
from abu_calc.spec.lines import key_lines
from abu_calc.spec.machine import BearingFile, Machine
from abu_calc.spec.names import nearest
from abu_calc.spec.overrides import apply, parse_override
from abu_calc.spec.syntax import parse
from abu_calc.spec.text import key_path

LARGEST_FILE: Final = 1_000_000
"""Bytes of the largest file that is read; machine files have a few thousand."""


@dataclass(frozen=True)
class Loaded:
    """A machine file, read and found right, and what is to be told about it."""

    file: str
    """As it was named: a path, or a preset."""
    text: str
    sha256: str
    machine: Machine | BearingFile
    lines: Mapping[str, int]
    """Key path → line."""
    defaults_used: tuple[tuple[str, object], ...]
    """Key path and value of each default in force in the tables that are there."""
    warnings: tuple[str, ...] = ()


def read_machine(source: str, overrides: Sequence[str] = ()) -> Loaded:
    """Reads a machine file, or a preset by its name, with entries overridden (`table.key=value`, typed as TOML).

    Raises InputError for whatever is wrong, with file, line, key and remedy; several faults come as SpecErrors.
    """
    raw = _bytes(source)
    text = _decoded(raw, source)
    document = parse(text, source)
    _refuse_other_files(document, source)
    given = [parse_override(override) for override in overrides]
    notes = apply(document, given, Machine)
    model = BearingFile if _bearings_alone(document) else Machine
    lines = key_lines(text)
    try:
        machine = model.model_validate(document)
    except ValidationError as error:
        options = {override.path: override.option for override in given}
        raise told(error, Origin(source, document, lines, options, model)) from None
    defaults = tuple((key_path(path), value) for path, value in machine.defaults())
    digest = hashlib.sha256(raw).hexdigest()
    return Loaded(source, text, digest, machine, lines, defaults, tuple(notes))


def _bytes(source: str) -> bytes:
    path, place = _path(source), Place(source)
    try:
        with path.open("rb") as stream:
            raw = stream.read(LARGEST_FILE + 1)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror or error}", place=place) from None
    if len(raw) > LARGEST_FILE:
        raise InputError("the file is too large", place=place, allowed=f"at most {LARGEST_FILE} bytes")
    return raw


def _path(source: str) -> Path:
    """The file that is meant: one that exists before a preset."""
    path, place = Path(source), Place(source or None)
    try:
        if source and path.is_dir():
            raise InputError("a folder, not a file", place=place, remedy="name the machine file inside")
        if source and path.exists():
            return path
    except (OSError, ValueError):
        raise InputError("not a file name", place=place) from None
    if preset := presets.find(source):
        return preset
    known = presets.names()
    if close := nearest(path.stem, known):
        remedy = f'the nearest preset is "{close}"'
    else:
        remedy = f"presets: {', '.join(known)}" if known else "`abu init FILE` writes a new file"
    raise InputError("no such file, and no preset of this name", place=place, remedy=remedy)


def _decoded(raw: bytes, source: str) -> str:
    place = Place(source)
    if raw[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\0" in raw[:4]:
        raise InputError("the text is UTF-16 or UTF-32", place=place, allowed="UTF-8", remedy="save the file as UTF-8")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        found = f"byte 0x{raw[error.start]:02x}"
        raise InputError(
            "the text is not UTF-8", place=Place(source, line), found=found, remedy="save the file as UTF-8"
        ) from None
    if not text.strip():
        raise InputError("the file is empty", place=place, remedy="`abu init FILE` writes a commented one")
    return text


def _refuse_other_files(document: Mapping[str, object], source: str) -> None:
    """A scene or a set of readings is a good file, only not a machine's."""
    if not document:
        raise InputError(
            "the file holds comments only", place=Place(source), remedy="`abu init FILE` writes a commented one"
        )
    for table, kind in (("scene", "a scene"), ("rig", "readings of a rig")):
        if table in document and "machine" not in document:
            remedy = "`abu simulate` takes scenes" if table == "scene" else "`abu balance` takes readings"
            raise InputError(f"this file holds {kind}, not a machine", place=Place(source, key=table), remedy=remedy)


def _bearings_alone(document: Mapping[str, object]) -> bool:
    """Whether a file is for bearing seats only: its machine has no more than a name, and there are bearings."""
    head = document.get("machine", {})
    named_only = isinstance(head, dict) and head.keys() <= {"name"}
    return (
        named_only and bool(document.get("bearing")) and not document.keys() & {"suspension", "wheel", "autobalancer"}
    )
