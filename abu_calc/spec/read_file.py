"""Reading a file of whichever kind."""

from abu_calc.spec.document import Reading, open_document
from abu_calc.spec.kinds import kind_of


def read_file(source: str) -> Reading:
    """Reads a file of any kind, or a preset by its name; raises as the reader of its kind does."""
    document = open_document(source)
    found: Reading = kind_of(document.content).call("reads", document)
    return found
