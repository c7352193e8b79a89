"""What a report is made of: a few kinds of blocks, the same for every command and every format of text."""

from typing import NamedTuple


class Heading(NamedTuple):
    """Starts a section."""

    text: str


class Paragraph(NamedTuple):
    """Running text, wrapped to the width there is; `mark` sets it off (pass, warn, fail, not-done, warning).

    `hang`: by how much lines but the first are indented more.
    """

    text: str
    mark: str | None = None
    indent: int = 2
    hang: int = 0


class Facts(NamedTuple):
    """Rows of label, symbol, value with unit."""

    rows: tuple[tuple[str, str, str], ...]


class Grid(NamedTuple):
    """A table with a header; `right` names the columns with numbers."""

    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    right: frozenset[int] = frozenset()


class Picture(NamedTuple):
    """Drawn in characters, with a caption that says what to see; left out where lines are shorter than it is wide."""

    lines: tuple[str, ...]
    caption: str
    indent: int = 8


Block = Heading | Paragraph | Facts | Grid | Picture
