"""Reading of any file: path or preset → bytes → text → document → overrides → model, every fault with its place.

The module that words faults is imported only if there is one.

A file that reads without error may have warnings: unusual numbers, numbers that do not go together, and defaults that
are another machine's.
"""

import hashlib
import os
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property, reduce
from pathlib import Path
from typing import TYPE_CHECKING, Final, Self, TypeVar, cast

from pydantic import ValidationError

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import bounded
from abu_calc.inputs.reading.sources import LARGEST_FILE, Document, bytes_of
from abu_calc.inputs.reading.table import Table, Usual, numbers_in, usual_of
from abu_calc.inputs.reading.text import KEY, Part, check_format, key_path, unit_suffix, unit_symbol
from abu_calc.inputs.reading.values_with_units import Conversion, check_nesting, convert

if TYPE_CHECKING:
    from abu_calc.inputs.reading.overrides import Override


@dataclass(frozen=True)
class Source:
    """Origin of the entries of a file: its text, or an override."""

    text: str
    overrides: "Sequence[Override]" = ()
    converted: Sequence[Conversion] = ()

    @cached_property
    def _lines(self) -> Mapping[str, int]:
        return lines_of(self.text, self.converted)

    def of(self, path: tuple[Part, ...]) -> str:
        """Line, or option, in brackets; empty where there is neither."""
        given = [override for override in self.overrides if path[: len(override.path)] == override.path]
        if given:
            return f" ({given[-1].option.removesuffix(given[-1].key).strip() or 'changed'})"
        from abu_calc.inputs.reading.toml_text import line_of

        line = line_of(self._lines, path)
        return f" (line {line})" if line else ""


def remarks(root: Table, source: Source) -> Iterator[str]:
    """The warnings of a file, each with its key and where that stands."""
    for path, table in root.tables():
        for name, usual, values in unusual(table):
            yield f"{_entry(table, path, (name,), source)} is unusual, {_asked(root, name, usual, values)}"
    for path, table in root.tables():
        for below, words in table.contradictions():
            yield f"{_entry(table, path, below, source)} {words}"
        if borrowed := table.borrowed():
            yield _borrowed(table, path, borrowed, source)


def unusual(table: Table) -> Iterator[tuple[str, Usual, list[float]]]:
    """Keys of a table with numbers outside their usual range, and these numbers."""
    given = table.model_fields_set - table.unused()
    for key in type(table).model_fields:
        if key not in given or not (usual := usual_of(type(table).model_fields[key])):
            continue
        silent = unit_suffix(key) == "db"  # a level of zero is not none
        odd = [value for value in numbers_in(getattr(table, key)) if not usual.holds(value) or (silent and value == 0)]
        if odd:
            yield key, usual, odd


def _entry(table: Table, path: tuple[Part, ...], below: tuple[str, ...], source: Source) -> str:
    """An entry below a table of the file, and where it stands: "machine.speed_rpm = 97 (line 5)"."""
    whole, value = (*path, *below), reduce(getattr, below, cast("object", table))
    return f"{key_path(whole)} = {said(value)}{source.of(whole)}"


def _asked(root: Table, key: str, usual: Usual, values: list[float]) -> str:
    from abu_calc.inputs.reading.suggestions import guesses, meant_in

    unit, speed = unit_symbol(key), getattr(getattr(root, "machine", None), "speed_rpm", None)
    meant = meant_in(guesses(key, values, usual, speed), unit)
    return f"{usual}{unit} is usual." + (f" M{meant[1:]}?" if meant else "")


def _borrowed(table: Table, path: tuple[Part, ...], keys: Sequence[str], source: Source) -> str:
    taken = ", ".join(f"{key} = {said(getattr(table, key))}" for key in keys)
    return (
        f"[{key_path(path)}]{source.of(path)} takes example data, not your machine's: {taken}. What rests on it holds "
        "for the example: give your own."
    )


def said(value: object) -> str:
    """A number, or a list of numbers, as messages say it.

    >>> said((2.5, 250.0)), said(2e5), said((6.5,))
    ('[2.5, 250]', '200000', '6.5')
    """
    if isinstance(value, tuple):
        inner = [said(each) for each in value]
        return inner[0] if len(inner) == 1 else f"[{', '.join(inner)}]"
    return bounded(value) if isinstance(value, (int, float)) else str(value)


__all__ = ["LARGEST_FILE", "Document", "FileReading", "named", "open_document", "parsed_overrides", "validate"]

Model = TypeVar("Model", bound=Table)


REPEATED: Final = ("wheel", "autobalancer")
"""Tables of a machine that may be lists."""


@dataclass(frozen=True)
class FileReading:
    """A file, read and found right, and what there is to know about it."""

    file: str
    text: str
    sha256: str
    overrides: "tuple[Override, ...]"
    """Entries of the file that were replaced, in the order given."""
    defaults_used: tuple[tuple[str, object], ...]
    """Key path and value of each default in force in the tables that are there."""
    warnings: tuple[str, ...]
    converted: tuple[Conversion, ...]
    """Values in force that were written with their units."""

    @property
    def title(self) -> str:
        """The name of what it is about, as reports print it."""
        return Path(self.file).name

    def __repr__(self) -> str:
        count = len(self.overrides)
        changed = f", {count} {'entry' if count == 1 else 'entries'} replaced" if count else ""
        return f"<{type(self).__name__} {self.title!r} from {self.file or 'text'}{changed}>"

    @property
    def lines(self) -> Mapping[str, int]:
        """Key path → line."""
        return lines_of(self.text, self.converted)

    @property
    def document(self) -> Document:
        """The file once more, without its overrides."""
        return Document(self.file, self.text, self.sha256, parsed(self.text, self.file))

    def changed(self, values: Mapping[str, object]) -> Self:
        """The same with entries of its file replaced, by key path: `changed({"wheel.mass_kg": 0.5})`.

        Checked as if the file said so; raises InputError with key, what was found, and what is allowed.
        """
        from abu_calc.inputs.reading.kinds import kind_of
        from abu_calc.inputs.reading.overrides import following, overrides_of

        document = self.document
        kind = kind_of(document.content)
        changed: Self = kind.read(document, following(self.overrides, overrides_of(values), kind.model))
        return changed

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


@contextmanager
def document_from(source: object) -> Iterator[Document]:
    """The document of what a script gives: tables as a dictionary, a TOML text, or the name of a file or a preset.

    A text with a line break is TOML. Errors about tables from a dictionary name the key and no line.
    """
    if not isinstance(source, Mapping):
        name = named(source)
        yield document_of_text(name) if isinstance(source, str) and LINE_BREAK in name else open_document(name)
        return
    try:
        yield document_of_tables(source)
    except InputError as error:
        raise _without_line(error) from None


def _without_line(error: InputError) -> InputError:
    from abu_calc.inputs.reading.errors import SpecErrors

    if isinstance(error, SpecErrors):
        return SpecErrors([_without_line(each) for each in error.errors])
    return error.at(Place(key=error.place.key))


def named(source: object) -> str:
    """The name of a file, or of a preset, that a script gives as text or as a path; raises InputError for all else."""
    if isinstance(source, (str, os.PathLike)) and isinstance(name := os.fspath(source), str):
        return name
    from abu_calc.inputs.reading.values_with_units import found_as

    raise InputError(
        "not the name of a file or a preset",
        place=Place(key="source"),
        found=found_as(source),
        allowed="a path, the name of a preset, TOML text of several lines, or a dictionary of tables",
    )


def open_document(source: str) -> Document:
    """The document of a file, or of a preset by its name. Raises InputError with file, line, key and remedy."""
    raw = bytes_of(source)
    return _opened(raw, _decoded(raw, source), source)


LINE_BREAK: Final = "\n"
"""What a TOML text has and no name of a file."""


def document_of_text(text: str) -> Document:
    """The document of a TOML text; places in errors have its lines and no file."""
    if len(text) > LARGEST_FILE:
        raise InputError("the text is too large", allowed=f"at most {LARGEST_FILE} characters")
    raw = text.encode("utf-8", "surrogatepass")
    return _opened(raw, _decoded(raw, ""), "")


def document_of_tables(tables: Mapping[str, object]) -> Document:
    """The document of tables that a script gives, as a file would hold them."""
    import tomli_w

    from abu_calc.inputs.reading.values_with_units import plain_value

    plain = plain_value(tables, "source")
    return document_of_text(tomli_w.dumps(plain) or LINE_BREAK)


def _opened(raw: bytes, text: str, source: str) -> Document:
    content = parsed(text, source)
    if not content:
        raise InputError(
            "the file holds comments only", place=Place(source), remedy="`abu init FILE` writes a commented one"
        )
    if content.keys() >= {"abu", "result", "checks"}:
        raise InputError(
            "this file holds a result that --output wrote", place=Place(source),
            remedy="Specify the file that it is from: its table [input] names it.",
        )  # fmt: skip
    return Document(source, text, hashlib.sha256(raw).hexdigest(), content)


def validate(
    document: Document,
    overrides: "Sequence[Override]",
    known: type[Table],
    choose: Callable[[dict[str, object]], type[Model]],
) -> tuple[Model, FileReading]:
    """The table of a document with entries overridden, and what there is to know of it.

    `known` has the keys that overrides may name, `choose` the model of the document as overridden. Raises InputError
    for whatever is wrong; several faults come as SpecErrors.
    """
    content = document.content
    converted = convert(content, choose(content), _places(document))
    overrides = _in_key_units(overrides, known)
    options, notes = _overridden(content, overrides, known)
    converted = _in_force(converted, overrides)
    model = choose(content)
    try:
        table = model.model_validate(content)
    except ValidationError as error:
        from abu_calc.inputs.reading.errors import Origin, input_error

        lines, written = lines_of(document.text, converted), {each.path: each.entry for each in converted}
        raise input_error(error, Origin(document.file, content, lines, options, model, written)) from None
    defaults = tuple((key_path(path), value) for path, value in table.defaults())
    notes = [*remarks(table, Source(document.text, overrides, converted)), *notes]
    # A key of the file is not given in vain where an entry that replaces another of its table made it idle.
    changed = {override.path[:-1] for override in overrides}
    replaced = {override.path for override in overrides}
    idle = (path for path in table.given_in_vain() if path[:-1] not in changed or path in replaced)
    notes += [f"{key_path(path)} plays no part beside the other keys." for path in idle]
    return table, FileReading(
        document.file, document.text, document.sha256, tuple(overrides), defaults, tuple(notes), tuple(converted)
    )


def lines_of(text: str, converted: Sequence[Conversion] = ()) -> dict[str, int]:
    """Key path → line, of keys of the model that were written without their unit, too."""
    from abu_calc.inputs.reading.toml_text import key_lines

    lines = key_lines(text)
    for conversion in converted:
        if line := lines.get(key_path(conversion.written)):
            lines.setdefault(conversion.key, line)
    return lines


def _places(document: Document) -> Callable[[tuple[Part, ...]], Place]:
    def place(path: tuple[Part, ...]) -> Place:
        from abu_calc.inputs.reading.toml_text import key_lines, line_of

        return Place(document.file, line_of(key_lines(document.text), path), key_path(path))

    return place


def _in_key_units(overrides: "Sequence[Override]", known: type[Table]) -> "Sequence[Override]":
    if not overrides:
        return overrides
    from abu_calc.inputs.reading.overrides import in_key_units

    return in_key_units(overrides, known)


def _in_force(converted: Sequence[Conversion], overrides: "Sequence[Override]") -> list[Conversion]:
    """Conversions of the file that no override replaces, then those of the overrides."""
    kept = [each for each in converted
            if not any(each.path[: len(override.path)] == override.path for override in overrides)]  # fmt: skip
    return [*kept, *(each for override in overrides for each in override.converted)]


def _overridden(
    content: dict[str, object], overrides: "Sequence[Override]", known: type[Table]
) -> tuple[dict[tuple[Part, ...], str], list[str]]:
    """Puts overrides into the document; the option of each path that one set, and the notes."""
    if not overrides:
        return {}, []
    from abu_calc.inputs.reading.overrides import apply

    notes = apply(content, overrides, known)
    return {override.path: override.option for override in overrides}, notes


def parsed_overrides(overrides: Sequence[str]) -> "tuple[Override, ...]":
    """Overrides as written on the command line, `table.key=value`."""
    if not overrides:
        return ()
    from abu_calc.inputs.reading.overrides import parse_overrides

    return parse_overrides(overrides)


def parsed(text: str, source: str) -> dict[str, object]:
    """The tables of a TOML text, without its format. Raises InputError with line and remedy."""
    check_nesting(text, source)
    try:
        content = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        from abu_calc.inputs.reading.toml_text import reworded

        raise reworded(text, source, error) from None
    if KEY in content:
        from abu_calc.inputs.reading.toml_text import key_lines

        check_format(content.pop(KEY), Place(source, key_lines(text).get(KEY), KEY))
    return _one_of_each(content)


def _one_of_each(content: dict[str, object]) -> dict[str, object]:
    """A machine's [[wheel]] and [[autobalancer]], one of each at most, as the single tables [wheel], [autobalancer]."""
    lists = {key: each for key in REPEATED if isinstance(each := content.get(key), list)}
    if "machine" in content and all(len(each) == 1 and isinstance(each[0], dict) for each in lists.values()):
        content |= {key: each[0] for key, each in lists.items()}
    return content


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
