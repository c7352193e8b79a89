"""The way of every file: path or preset → bytes → text → document → overrides → model, every fault with its place.

What words faults is imported when there is one.
"""

import hashlib
import os
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from pydantic import ValidationError

from abu_calc.errors import InputError, Place
from abu_calc.frozen import dataclass
from abu_calc.spec.bounds import check_nesting
from abu_calc.spec.remarks import Source, remarks
from abu_calc.spec.source import LARGEST_FILE, bytes_of
from abu_calc.spec.table import Table
from abu_calc.spec.text import Part, key_path

if TYPE_CHECKING:
    from abu_calc.spec.overrides import Override

__all__ = ["LARGEST_FILE", "Document", "Reading", "named", "open_document", "parsed_overrides", "validate"]

Model = TypeVar("Model", bound=Table)


class Document(NamedTuple):
    """A file whose TOML is right; its tables are not looked at yet."""

    file: str
    """Name as it was given: a path, or a preset; empty if there is none."""
    text: str
    sha256: str
    content: dict[str, object]


@dataclass(frozen=True)
class Reading:
    """A file, read and found right, and what there is to know about it."""

    file: str
    text: str
    sha256: str
    overrides: "tuple[Override, ...]"
    """Entries of the file that were replaced, in the order given."""
    defaults_used: tuple[tuple[str, object], ...]
    """Key path and value of each default in force in the tables that are there."""
    warnings: tuple[str, ...]

    @property
    def title(self) -> str:
        """The name of what it is about, as reports print it."""
        return Path(self.file).name

    @property
    def lines(self) -> Mapping[str, int]:
        """Key path → line."""
        from abu_calc.spec.lines import key_lines

        return key_lines(self.text)

    @property
    def document(self) -> Document:
        """The file once more, without its overrides."""
        return Document(self.file, self.text, self.sha256, _parsed(self.text, self.file))

    @contextmanager
    def located(self) -> Iterator[None]:
        """Give errors that know only a key the file and the line they come from."""
        try:
            yield
        except InputError as error:
            key = error.place.key
            if error.place.file is not None or (key or "").startswith("--"):
                raise
            if given := self._override_of(key or ""):
                raise given.blamed(error) from None
            if not self.file:
                raise
            raise error.at(Place(self.file, self.lines.get(key) if key else None, key)) from None

    def _override_of(self, key: str) -> "Override | None":
        """The override that an entry of the file comes from, if any: it, or the last that set a table around it."""
        around = [
            override
            for override in self.overrides
            if key == override.key or key.startswith((f"{override.key}.", f"{override.key}["))
        ]
        return around[-1] if around else None


def named(source: object) -> str:
    """The name of a file, or of a preset, that a script gives as text or as a path; raises InputError for all else."""
    if isinstance(source, (str, os.PathLike)) and isinstance(name := os.fspath(source), str):
        return name
    from abu_calc.spec.plain import found_as

    raise InputError(
        "not the name of a file or a preset",
        place=Place(key="source"),
        found=found_as(source),
        allowed="text or a path",
    )


def open_document(source: str) -> Document:
    """The document of a file, or of a preset by its name. Raises InputError with file, line, key and remedy."""
    raw = bytes_of(source)
    text = _decoded(raw, source)
    content = _parsed(text, source)
    if not content:
        raise InputError(
            "the file holds comments only", place=Place(source), remedy="`abu init FILE` writes a commented one"
        )
    return Document(source, text, hashlib.sha256(raw).hexdigest(), content)


def validate(
    document: Document,
    overrides: "Sequence[Override]",
    known: type[Table],
    choose: Callable[[dict[str, object]], type[Model]],
) -> tuple[Model, Reading]:
    """The table of a document with entries overridden, and what there is to know of it.

    `known` has the keys that overrides may name, `choose` the model of the document as overridden. Raises InputError
    for whatever is wrong; several faults come as SpecErrors.
    """
    content = document.content
    options, notes = _overridden(content, overrides, known)
    model = choose(content)
    try:
        table = model.model_validate(content)
    except ValidationError as error:
        from abu_calc.spec.errors import Origin, input_error
        from abu_calc.spec.lines import key_lines

        raise input_error(error, Origin(document.file, content, key_lines(document.text), options, model)) from None
    defaults = tuple((key_path(path), value) for path, value in table.defaults())
    notes = [*remarks(table, Source(document.text, overrides)), *notes]
    notes += [f"{key_path(path)} plays no part beside the other keys." for path in table.given_in_vain()]
    return table, Reading(document.file, document.text, document.sha256, tuple(overrides), defaults, tuple(notes))


def _overridden(
    content: dict[str, object], overrides: "Sequence[Override]", known: type[Table]
) -> tuple[dict[tuple[Part, ...], str], list[str]]:
    """Puts overrides into the document; the option of each path that one set, and the notes."""
    if not overrides:
        return {}, []
    from abu_calc.spec.overrides import apply

    notes = apply(content, overrides, known)
    return {override.path: override.option for override in overrides}, notes


def parsed_overrides(overrides: Sequence[str]) -> "tuple[Override, ...]":
    """Overrides as written on the command line, `table.key=value`."""
    if not overrides:
        return ()
    from abu_calc.spec.overrides import parse_overrides

    return parse_overrides(overrides)


def _parsed(text: str, source: str) -> dict[str, object]:
    check_nesting(text, source)
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        from abu_calc.spec.syntax import reworded

        raise reworded(text, source, error) from None


def _decoded(raw: bytes, source: str) -> str:
    place = Place(source)
    if raw[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\0" in raw[:4]:
        raise InputError("the text is UTF-16 or UTF-32", place=place, allowed="UTF-8", remedy="save the file as UTF-8")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        bad_byte = f"byte 0x{raw[error.start]:02x}"
        raise InputError(
            "the text is not UTF-8", place=Place(source, line), found=bad_byte, remedy="save the file as UTF-8"
        ) from None
    if not text.strip():
        raise InputError("the file is empty", place=place, remedy="`abu init FILE` writes a commented one")
    return text
