"""Kinds of files that people write.

A new kind is an entry here: its marking tables, its reader, the models of its tables, and the command that takes it.
"""

import importlib
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass

if TYPE_CHECKING:
    from abu_calc.inputs.reading.overrides import Override
    from abu_calc.inputs.reading.sources import Document
    from abu_calc.inputs.reading.table import Table


@dataclass(frozen=True)
class Kind:
    """A kind of file; `marks`: the tables by which it is known, `reads`: module and function, `models`: the files that
    it may be, the whole one first, as module and class.
    """

    name: str
    what: str
    marks: tuple[str, ...]
    command: str
    """The command that takes it."""
    reads: str
    models: tuple[str, ...]

    def read(self, document: "Document", overrides: "Sequence[Override]") -> Any:
        """What its reader makes of a document that is open already."""
        return _imported(self.reads)(document, overrides)

    @property
    def model(self) -> "type[Table]":
        """Model of the whole file."""
        return _imported(self.models[0])  # type: ignore[no-any-return]

    def all_models(self) -> "tuple[type[Table], ...]":
        """Models of the files that it may be."""
        return tuple(map(_imported, self.models))


def _imported(name: str) -> Any:
    module, _, held = name.partition(":")
    return getattr(importlib.import_module(f"abu_calc.{module}"), held)


KINDS: Final = (
    Kind(
        "machine", "a machine", ("machine",), "size",
        "inputs.read_machine:machine_from",
        ("inputs.machine:MachineFile", "inputs.spindle:TwoRaceFile", "inputs.bearing_file:BearingFile"),
    ),
    Kind(
        "scene", "a scene", ("scene",), "simulate",
        "simulation.scene_file:described_scene", ("simulation.scene_file:SceneFile",),
    ),
    Kind(
        "readings", "readings of a rig", ("rig", "rotor", "run"), "balance",
        "features.balancing.read:readings_from", ("features.balancing.tables:ReadingsFile",),
    ),
    Kind(
        "recordings", "recordings of a type test", ("recording", "calibration"), "declare --recordings",
        "features.declare.read:recordings_from", ("features.declare.read:RecordingsFile",),
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
