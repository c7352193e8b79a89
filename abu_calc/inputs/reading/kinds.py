"""Kinds of files that people write.

A new kind is an entry here: its marking tables, its reader, and the commands that take it.
"""

import importlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass

if TYPE_CHECKING:
    from abu_calc.inputs.reading.document import Document


@dataclass(frozen=True)
class Kind:
    """A kind of file; `marks`: the tables by which it is known, `reads`, `template`, `schema`: module and function."""

    name: str
    what: str
    marks: tuple[str, ...]
    command: str
    """The command that takes it."""
    reads: str
    template: str
    schema: str

    def call(self, which: str, *arguments: Any) -> Any:
        """Calls one of its functions, its module imported for it."""
        module, _, function = getattr(self, which).partition(":")
        return getattr(importlib.import_module(f"abu_calc.{module}"), function)(*arguments)


KINDS: Final = (
    Kind(
        "machine", "a machine", ("machine",), "size",
        "inputs.read_machine:machine_from", "inputs.reading.template:template", "inputs.reading.schema:machine_schema",
    ),
    Kind(
        "scene", "a scene", ("scene",), "simulate",
        "simulation.scene_file:described_scene", "simulation.scene_file:scene_template",
        "simulation.scene_file:scene_schema",
    ),
    Kind(
        "readings", "readings of a rig", ("rig", "rotor", "run"), "balance",
        "features.balancing.read:readings_from", "features.balancing.read:readings_template",
        "features.balancing.read:readings_schema",
    ),
    Kind(
        "recordings", "recordings of a type test", ("recording", "calibration"), "declare --recordings",
        "features.declare.read:recordings_from", "features.declare.read:recordings_template",
        "features.declare.read:recordings_schema",
    ),
)  # fmt: skip
"""A file that has tables of several is of the first of them, one that has none is a machine's."""

BY_NAME: Final[Mapping[str, Kind]] = {kind.name: kind for kind in KINDS}


def kind_of(content: Mapping[str, object]) -> Kind:
    """The kind of a file, by its tables.

    >>> kind_of({"run": []}).name, kind_of({"scene": {}, "machine": {}}).name, kind_of({}).name
    ('readings', 'machine', 'machine')
    """
    return next((kind for kind in KINDS if content.keys() & set(kind.marks)), KINDS[0])


def refuse_others(document: "Document", *wanted: str) -> None:
    """Raises InputError for a file of another kind: a good file, only not one of these."""
    kind = kind_of(document.content)
    mark = next((mark for mark in kind.marks if mark in document.content), None)
    if kind.name in wanted or mark is None:
        return
    raise InputError(
        f"this file holds {kind.what}, not {BY_NAME[wanted[0]].what}",
        place=Place(document.file, key=mark),
        remedy=f"`abu {kind.command} FILE` takes it",
    )
