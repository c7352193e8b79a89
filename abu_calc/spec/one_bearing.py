"""Bearings given key by key, with no file: read as a file of those bearings would be."""

import tomllib
from collections.abc import Mapping, Sequence
from typing import Final

from abu_calc.spec.bearing_file import BearingFile
from abu_calc.spec.document import Document, validate
from abu_calc.spec.overrides import Override
from abu_calc.spec.read import Machine

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
