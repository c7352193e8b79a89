"""Reading a machine file: document → overrides → model, every fault told with its place."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from abu_calc.errors import InputError, Place
from abu_calc.spec.bearing_file import BearingFile
from abu_calc.spec.document import LARGEST_FILE, Document, Reading, open_document, validate

if TYPE_CHECKING:
    from abu_calc.spec.machine import Machine

__all__ = ["LARGEST_FILE", "Loaded", "machine_from", "read_machine"]


@dataclass(frozen=True)
class Loaded(Reading):
    """A machine file, read and found right."""

    machine: "Machine | BearingFile"


def read_machine(source: str, overrides: Sequence[str] = ()) -> Loaded:
    """Reads a machine file, or a preset by its name, with entries overridden (`table.key=value`, typed as TOML).

    Raises InputError for whatever is wrong, with file, line, key and remedy; several faults come as SpecErrors.
    """
    return machine_from(open_document(source), overrides)


def machine_from(document: Document, overrides: Sequence[str] = ()) -> Loaded:
    """The machine of a document that is open already; raises as `read_machine` does."""
    _refuse_other_files(document.content, document.file)
    # Only overrides ask what keys are known, so that a file of bearings alone loads no more than it needs.
    known = _whole() if overrides else BearingFile
    machine, reading = validate(document, overrides, known, _model)
    return Loaded(**vars(reading), machine=machine)


def _model(content: Mapping[str, object]) -> "type[Machine] | type[BearingFile]":
    return BearingFile if _bearings_alone(content) else _whole()


def _whole() -> "type[Machine]":
    from abu_calc.spec.machine import Machine

    return Machine


def _refuse_other_files(document: Mapping[str, object], source: str) -> None:
    """A scene or a set of readings is a good file, only not a machine's."""
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
