"""Reading of machine files, and of files of any kind: document → overrides → tables, faults with their places.

Bearings given key by key, with no file, are read as a file of those bearings would be.
"""

import os
import tomllib
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Final

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.bearing_file import BearingFile
from abu_calc.inputs.reading.document import (
    LARGEST_FILE,
    Document,
    FileReading,
    document_from,
    open_document,
    parsed_overrides,
    validate,
)
from abu_calc.inputs.reading.kinds import kind_of, refuse_others
from abu_calc.inputs.reading.overrides import Override

if TYPE_CHECKING:
    from abu_calc.inputs.autobalancer import Autobalancer
    from abu_calc.inputs.machine import MachineFile
    from abu_calc.inputs.spindle import TwoRaceFile


OTHERS: Final = "`abu size`, `abu simulate`, `abu stability`, `abu sweep`, `abu compare` and `abu grinding` take it."


def read_file(source: str, overrides: Sequence[str] = ()) -> FileReading:
    """Reads a file of any kind, or a preset by its name, entries replaced; raises as the reader of its kind."""
    return read_document(open_document(source), overrides)


def read_document(document: Document, overrides: Sequence[str] = ()) -> FileReading:
    """Reads a document that is open already, as `read_file` does."""
    reading: FileReading = kind_of(document.content).read(document, parsed_overrides(overrides))
    return reading


__all__ = ["LARGEST_FILE", "Machine", "machine_from", "read", "read_machine", "variant_of"]


@dataclass(frozen=True)
class Machine(FileReading):
    """A machine file, or one of bearings alone; `tables` are what stands in it, in the units people wrote.

    Tables that only a whole machine has are those of `whole()`: `machine.whole().wheel.mass_kg`.
    """

    __repr__ = FileReading.__repr__

    tables: "MachineFile | BearingFile | TwoRaceFile"

    @property
    def title(self) -> str:
        """The machine's name."""
        return self.tables.machine.name

    @property
    def autobalancers(self) -> "tuple[Autobalancer, ...]":
        """All races of the machine; one race is a list of one, a file of bearings alone has none."""
        races = getattr(self.tables, "autobalancer", None)
        return races if isinstance(races, tuple) else () if races is None else (races,)

    @property
    def spindle(self) -> "TwoRaceFile | None":
        """The tables of a machine with several races along its spindle; None for any other file."""
        return self.tables if len(self.autobalancers) > 1 else None  # type: ignore[return-value]

    def to_toml(self) -> str:
        """The machine as TOML text: the file as it was read, or, with entries replaced, all entries that are in force.

        `read(machine.to_toml())` gives an equal machine. A text with replaced entries has the keys of the file in
        their order and no comments; values with units stand in the units of the keys.
        """
        if not self.overrides:
            return self.text
        import tomli_w

        from abu_calc.inputs.reading.text import FORMAT, KEY
        from abu_calc.inputs.variation import Variants

        content = Variants.whole(self, type(self.tables)).content
        return tomli_w.dumps({KEY: FORMAT, **content})

    def whole(self, command: str | None = None) -> "MachineFile":
        """The tables of a machine with one race; raises InputError, naming the command, for any other file."""
        if self.spindle is not None:
            raise InputError(
                "this file has two races, and this command knows one", place=Place(self.file, key="autobalancer"),
                remedy=OTHERS,
            )  # fmt: skip
        if not isinstance(self.tables, BearingFile):
            return self.tables  # type: ignore[return-value]
        needs = "and this command needs a whole machine" if command else "not a whole machine"
        raise InputError(
            f"this file holds bearings only, {needs}",
            place=Place(self.file, key="machine"),
            remedy="Use `abu check-fit FILE`, or add [suspension], [wheel] and [autobalancer].",
        )


def read(source: str | os.PathLike[str] | Mapping[str, object]) -> Machine:
    """Reads a machine: a file, a preset by its name, a TOML text, or tables as a dictionary.

        read("my-grinder.toml")        read("avtovaz-707-222")        read("[machine]\\nname = …")
        read({"machine": {"name": …, "mass_kg": 5.6, "speed": "97 Hz"}, "suspension": …, "wheel": …})

    A text with a line break is TOML, any other a name. Raises InputError with file, line, key and remedy.
    """
    with document_from(source) as document:
        return machine_from(document)


def read_machine(source: str, overrides: Sequence[str] = ()) -> Machine:
    """Reads a machine file, or a preset by its name, with entries overridden (`table.key=value`, typed as TOML).

    Raises InputError for whatever is wrong, with file, line, key and remedy; several faults come as SpecErrors.
    """
    return machine_from(open_document(source), parsed_overrides(overrides))


def machine_from(document: Document, overrides: "Sequence[Override]" = ()) -> Machine:
    """The machine of a document that is open already; raises as `read_machine` does."""
    refuse_others(document, "machine")
    # Only overrides ask what keys are known, so that a file of bearings alone loads no more than it needs.
    known = _whole() if overrides else BearingFile
    tables, reading = validate(document, overrides, known, _model)
    return Machine(**vars(reading), tables=tables)


def variant_of(machine: Machine, text: str) -> Machine:
    """The machine with the entries replaced that `--variant "key=value,key=value"` names; raises as `changed` does."""
    from abu_calc.inputs.reading.overrides import following, parse_variant

    return machine_from(machine.document, following(machine.overrides, parse_variant(text), _whole()))


def _model(content: Mapping[str, object]) -> "type[MachineFile] | type[BearingFile] | type[TwoRaceFile]":
    if _bearings_alone(content):
        return BearingFile
    if _has_lists(content):
        from abu_calc.inputs.spindle import TwoRaceFile

        return TwoRaceFile
    return _whole()


def _has_lists(content: Mapping[str, object]) -> bool:
    """True if wheels or autobalancers are lists of several."""
    return any(isinstance(each := content.get(key), list) and len(each) > 1 for key in ("wheel", "autobalancer"))


def _whole() -> "type[MachineFile]":
    from abu_calc.inputs.machine import MachineFile

    return MachineFile


def _bearings_alone(document: Mapping[str, object]) -> bool:
    """True if a file is for bearing seats only.

    Its machine then has no more than a name, and there are bearings.
    """
    head = document.get("machine", {})
    named_only = isinstance(head, dict) and head.keys() <= {"name"}
    return (
        named_only and bool(document.get("bearing")) and not document.keys() & {"suspension", "wheel", "autobalancer"}
    )


MACHINE: Final = """
[machine]
name = "bearing"
"""
BEARING: Final = """
[[bearing]]
name = "bearing"
"""


def machine_of_bearings(bearings: Sequence[Mapping[str, object]], options: Mapping[str, str]) -> Machine:
    """A machine of these bearings and no more; `options`: what gave each key, so that errors can name it.

    Raises InputError as for a file.
    """
    text = MACHINE + BEARING * len(bearings)
    document = Document("", text, "", tomllib.loads(text))
    given = tuple(
        Override(("bearing", index, key), value, options[key])
        for index, keys in enumerate(bearings)
        for key, value in keys.items()
    )
    tables, reading = validate(document, given, BearingFile, lambda _: BearingFile)
    return Machine(**vars(reading), tables=tables)
