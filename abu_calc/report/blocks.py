"""What a report is made of: a few kinds of blocks, the same for every command and every format of text."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Heading:
    """Starts a section."""

    text: str


@dataclass(frozen=True)
class Paragraph:
    """Running text, wrapped to the width there is; `mark` sets it off (pass, fail, not-done, warning)."""

    text: str
    mark: str | None = None
    indent: int = 2


@dataclass(frozen=True)
class Facts:
    """Rows of label, symbol, value with unit."""

    rows: tuple[tuple[str, str, str], ...]


@dataclass(frozen=True)
class Grid:
    """A table with a header; `right` names the columns with numbers."""

    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    right: frozenset[int] = frozenset()


Block = Heading | Paragraph | Facts | Grid
