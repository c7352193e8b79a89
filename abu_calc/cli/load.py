"""Files for commands, with their overrides."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from abu_calc.spec.document import Reading
from abu_calc.spec.read import Machine, read_machine
from abu_calc.studies.result import Provenance

if TYPE_CHECKING:
    from abu_calc.spec.read_scene import SceneDescription


def load(source: str, overrides: Sequence[str] | None = None) -> Machine:
    """Read a machine file or preset with its overrides."""
    return read_machine(source, overrides or ())


def load_any(source: str, overrides: Sequence[str] | None = None) -> "Machine | SceneDescription":
    """Read a scene file, or a machine file or preset, with its overrides."""
    from abu_calc.spec.read_scene import read_any

    return read_any(source, overrides or ())


def source_of(loaded: Reading) -> Provenance:
    """What the envelope tells of the input."""
    return Provenance.of(loaded)
