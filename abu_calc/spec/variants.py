"""The tables of a file with some of its values replaced, again and again: read once, checked each time."""

import copy
from collections.abc import Mapping
from typing import Generic

from pydantic import ValidationError

from abu_calc.errors import InputError
from abu_calc.frozen import dataclass
from abu_calc.spec.document import Document, Model, Reading
from abu_calc.spec.errors import Origin, input_error
from abu_calc.spec.overrides import Override, apply, parse_override
from abu_calc.spec.text import Part

VARIED = "vary {}"
"""Name in messages of a value that a sweep gave."""


@dataclass(frozen=True)
class Variants(Generic[Model]):
    """A file with its overrides put in, as data that processes can hand on; `model`: its tables."""

    content: dict[str, object]
    model: type[Model]

    @classmethod
    def of(cls, reading: Reading, model: type[Model]) -> "Variants[Model]":
        """Variants of a file that was read."""
        content = reading.document.content
        apply(content, reading.overrides, model)
        return cls({name: table for name, table in content.items() if name not in ("sweep", "expected")}, model)

    def table(self, values: Mapping[tuple[Part, ...], object]) -> Model:
        """The tables with these values. Raises InputError that names the key."""
        overrides = tuple(Override(path, value, VARIED) for path, value in values.items())
        content = copy.deepcopy(self.content)
        apply(content, overrides, self.model)
        try:
            return self.model.model_validate(content)
        except ValidationError as error:
            options = {override.path: override.option for override in overrides}
            raise input_error(error, Origin("", content, {}, options, self.model)) from None

    def notes(self, paths: "tuple[tuple[Part, ...], ...]", values: tuple[object, ...]) -> list[str]:
        """Entries of the file whose place the values take, in words."""
        overrides = [Override(path, value, VARIED) for path, value in zip(paths, values, strict=True)]
        return apply(copy.deepcopy(self.content), overrides, self.model)


def path_of(key: str) -> tuple[Part, ...]:
    """The path of a key as TOML writes it. Raises InputError for what is none.

    >>> path_of("suspension.natural_frequencies_hz[0]")
    ('suspension', 'natural_frequencies_hz', 0)
    """
    try:
        return parse_override(f"{key}=0").path
    except InputError as error:
        raise error.at(error.place) from None


__all__ = ["Document", "Variants", "path_of"]
