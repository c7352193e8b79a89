"""Reading of a file of readings and of the records that it names."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from abu_calc.features.balancing.tables import ReadingsFile
from abu_calc.foundation.errors import InputError, Place, shortened
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading import sources as presets
from abu_calc.inputs.reading.document import Document, FileReading, document_from, parsed_overrides, validate
from abu_calc.inputs.reading.kinds import refuse_others

if TYPE_CHECKING:
    from abu_calc.inputs.reading.overrides import Override


@dataclass(frozen=True)
class Readings(FileReading):
    """A file of readings; `tables` are what stands in it, in the units people wrote."""

    __repr__ = FileReading.__repr__

    tables: ReadingsFile

    @property
    def title(self) -> str:
        """The roll's name."""
        return self.tables.rotor.name

    def beside(self, name: str) -> Path:
        """A file that this one names: by its whole path, or beside it."""
        if not self.file:
            return Path.cwd() / name
        own_path = Path(self.file) if Path(self.file).exists() else presets.find(self.file) or Path(self.file)
        return own_path.absolute().parent / name


def read_readings(source: str | os.PathLike[str] | Mapping[str, object], overrides: Sequence[str] = ()) -> Readings:
    """Reads readings (a file, a TOML text, tables as a dictionary) with entries overridden (`rig.key=value`).

    Raises InputError for whatever is wrong, with file, line, key and remedy; several faults come as SpecErrors.
    """
    with document_from(source) as document:
        return readings_from(document, parsed_overrides(overrides))


def readings_from(document: Document, overrides: "Sequence[Override]" = ()) -> Readings:
    """The readings of a document that is open already; raises as `read_readings` does."""
    refuse_others(document, "readings")
    if "coefficients" in document.content:
        raise InputError(
            "this file holds influence coefficients, not readings", place=Place(document.file, key="coefficients"),
            remedy="`abu balance READINGS --coefficients FILE` takes it",
        )  # fmt: skip
    tables, reading = validate(document, overrides, ReadingsFile, lambda _: ReadingsFile)
    readings = Readings(**vars(reading), tables=tables)
    with readings.located():
        for index, run in enumerate(tables.run):
            if run.file is not None and not _is_file(path := readings.beside(run.file)):
                raise InputError(
                    "the record is not there", place=Place(key=f"run[{index}].file"), found=shortened(str(path)),
                    remedy="put the file beside this one, or write its whole path",
                )  # fmt: skip
    return readings


METHODS: Final = ("rig-data", "trials", "single-plane", "four-runs", "least-squares", "coefficients")
"""Methods of balancing that a new file can be for."""


def readings_template(method: str | None = None) -> str:
    """Text of a file of readings; it reads back without error. Without a method, and for rig data, it has every key.

    Raises InputError for an unknown method.
    """
    from abu_calc.inputs.reading.schema import template_of

    if method is not None and method not in METHODS:
        raise InputError(
            "unknown method of balancing", place=Place(key="method"), found=method, allowed=", ".join(METHODS),
            remedy="name one of them",
        )  # fmt: skip
    if method is None or method == "rig-data":
        return template_of("readings")
    return Path(__file__).parent.joinpath("templates", f"{method}.toml").read_text(encoding="utf-8")


def _is_file(path: Path) -> bool:
    """Tell whether a file is there; a name that is too long for the system is none."""
    try:
        return path.is_file()
    except OSError:
        return False
