"""Reading a file of whichever kind."""

from collections.abc import Sequence

from abu_calc.spec.document import Reading, open_document, parsed_overrides
from abu_calc.spec.kinds import kind_of


def read_file(source: str, overrides: Sequence[str] = ()) -> Reading:
    """Reads a file of any kind, or a preset by its name, entries replaced; raises as the reader of its kind."""
    document = open_document(source)
    reading: Reading = kind_of(document.content).call("reads", document, parsed_overrides(overrides))
    return reading
