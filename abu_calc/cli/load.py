"""Files for commands: read, and errors of later steps told of the line they come from."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from abu_calc.errors import InputError, Place
from abu_calc.report.outcome import Source
from abu_calc.spec.bearing_file import BearingFile
from abu_calc.spec.document import Reading
from abu_calc.spec.read import Loaded, read_machine

if TYPE_CHECKING:
    from abu_calc.spec.machine import Machine
    from abu_calc.spec.read_scene import LoadedScene


def load(source: str, overrides: Sequence[str] | None = None) -> Loaded:
    """Read a machine file or preset with its overrides."""
    return read_machine(source, overrides or ())


def load_any(source: str, overrides: Sequence[str] | None = None) -> "Loaded | LoadedScene":
    """Read a scene file, or a machine file or preset, with its overrides."""
    from abu_calc.spec.read_scene import read_any

    return read_any(source, overrides or ())


def machine_of(loaded: Loaded, command: str) -> "Machine":
    """The machine of a file; one that holds bearings alone is refused."""
    if not isinstance(loaded.machine, BearingFile):
        return loaded.machine
    raise InputError(
        f"this file holds bearings only, `abu {command}` needs a whole machine",
        place=Place(loaded.file, key="machine"),
        remedy="Use `abu check-fit`, or add [suspension], [wheel] and [autobalancer].",
    )


def source_of(loaded: Reading) -> Source:
    """What the envelope tells of the input."""
    return Source(loaded.file, loaded.sha256)


@contextmanager
def located(loaded: Reading) -> Iterator[None]:
    """Give errors that know only a key the file and the line they come from."""
    try:
        yield
    except InputError as error:
        key = error.place.key
        if error.place.file is not None or (key or "").startswith("--"):
            raise
        raise error.at(Place(loaded.file, loaded.lines.get(key) if key else None, key)) from None
