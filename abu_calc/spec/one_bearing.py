"""One bearing given key by key, with no file: read as a file of that bearing would be."""

import tomllib
from collections.abc import Mapping
from typing import Final

from abu_calc.spec.bearing_file import BearingFile
from abu_calc.spec.document import Document, validate
from abu_calc.spec.overrides import Override
from abu_calc.spec.read import Machine

EMPTY: Final = """
[machine]
name = "bearing"

[[bearing]]
name = "bearing"
"""


def machine_of_bearing(keys: Mapping[str, object], options: Mapping[str, str]) -> Machine:
    """A machine of one bearing and no more; `options`: what gave each key, so that errors can name it.

    Raises InputError as for a file.
    """
    document = Document("", EMPTY, "", tomllib.loads(EMPTY))
    given = tuple(Override(("bearing", 0, key), value, options[key]) for key, value in keys.items())
    tables, reading = validate(document, given, BearingFile, lambda _: BearingFile)
    return Machine(**vars(reading), tables=tables)
