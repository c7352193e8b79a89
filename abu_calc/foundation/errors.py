"""Errors of abu-calc, and the exit status each ends a command with.

    AbuError                         3   no trustworthy number could be computed
    ├── InputError                   2   the file or the options are wrong, nothing was computed
    │   ├── RangeError               2   a value outside the range a formula or a table is valid in
    │   └── OutputError              2   a result cannot be written where it was asked for
    ├── NotTrustworthyError          3   integration failed, or did not converge to the accuracy asked for
    └── StoppedError               130   somebody interrupted long work; what there is of it is kept

Statuses 0 and 1 are no errors: they tell whether every check of a result passed.

Text made safe for people to read.

Whatever prints text for people, or writes it to a file, sends it through `escaped` or its kin: nothing in it then acts
on a terminal, or breaks a line.
"""

import re
from typing import Any, ClassVar, Final

from abu_calc.foundation.frozen import dataclass

LONGEST_FOUND: Final = 200
"""Characters of a value that messages show."""

LINE_BREAKS: Final = "\n\r\v\f\x1c\x1d\x1e\x85\u2028\u2029"

_ACTING: Final = "\x00-\x1f\x7f-\x9f\xad\u061c\u200b\u200e\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb"
_REST: Final = "\ud800-\udfff\U000e0000-\U000e007f"
# Control characters, those that turn the direction of writing or take no room, and what no encoding knows.
_UNSAFE: Final = re.compile(f"[{_ACTING}{_REST}]")
_UNSAFE_IN_LINES: Final = re.compile(f"(?!\n)[{_ACTING}{_REST}]")


def escaped(text: str) -> str:
    r"""Text on one line, every character that acts on a terminal spelled out.

    >>> escaped("x\nPASS\x1b[31m \u202e")
    'x\\nPASS\\x1b[31m \\u202e'
    """
    return _UNSAFE.sub(_spelled, text)


def escaped_lines(text: str) -> str:
    """Text whose line breaks are meant."""
    return _UNSAFE_IN_LINES.sub(_spelled, text)


def escaped_toml(text: str) -> str:
    """TOML whose texts are all basic strings of one line, with the escapes that these know."""
    return _UNSAFE_IN_LINES.sub(lambda match: _toml_escape(ord(match[0])), text)


def shortened(text: str, most: int = LONGEST_FOUND) -> str:
    """Text cut where it is long."""
    return text if len(text) <= most else text[: most - 1] + "…"


def _spelled(match: re.Match[str]) -> str:
    return {"\n": "\\n", "\r": "\\r", "\t": "\\t"}.get(match[0]) or _python_escape(ord(match[0]))


def _python_escape(code: int) -> str:
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def _toml_escape(code: int) -> str:
    if 0xD800 <= code < 0xE000:  # half a character: TOML has no word for it
        return "?"
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def shell_word(text: str) -> str:
    """A text as one word of a command line, for bash, PowerShell and the Windows prompt alike: in double quotes.

    >>> shell_word("machine.toml"), shell_word("oil.grade=VG 100")
    ('machine.toml', '"oil.grade=VG 100"')

    A text with signs that double quotes do not protect in bash gets single ones.
    """
    if text and not _NEEDS_QUOTES.search(text):
        return text
    import shlex

    return shlex.quote(text) if any(sign in text for sign in '"$`\\!') else f'"{text}"'


_NEEDS_QUOTES: Final = re.compile(r"[^\w@%+=:,./-]")


LONGEST_FILE_NAME: Final = 1000
"""Characters of it that messages show."""


_LONG_WORD: Final = re.compile(rf"\S{{{LONGEST_FOUND + 1},}}")
_PROSE: Final = re.compile(r"(?!abu )[a-z](?=[a-z]*[ ,:](?!=))")
"""First letter of advice that begins with a word, not with a key or a command."""


@dataclass(frozen=True)
class Place:
    """Position of a wrong input: file, line (1-based) and key path as written in TOML, as far as known."""

    file: str | None = None
    line: int | None = None
    key: str | None = None

    def __str__(self) -> str:
        where = shortened(escaped(self.file or ""), LONGEST_FILE_NAME)
        if self.line is not None:
            where += f":{self.line}" if where else f"line {self.line}"
        return ": ".join(part for part in (where, shortened(escaped(self.key or ""))) if part)


class AbuError(Exception):
    """Base of all errors raised on purpose; `kind` names it in JSON."""

    kind: ClassVar[str] = "error"
    exit_status: int = 3


class InputError(AbuError):
    """A wrong input: what was found, what is allowed, and the remedy, in one or two lines."""

    kind: ClassVar[str] = "input"
    exit_status: int = 2

    def __init__(
        self,
        message: str,
        *,
        place: Place = Place(),
        found: str | None = None,
        allowed: str | None = None,
        remedy: str | None = None,
    ) -> None:
        super().__init__(message)
        self.message, self.place, self.allowed = message, place, allowed
        self.remedy = None if remedy is None else _readable(remedy)
        self.found = None if found is None else shortened(found)

    def at(self, place: Place, more: str = "") -> "InputError":
        """The same error at another place (a reader knows file and line, a formula only the quantity).

        `more`: what that place adds to the message.
        """
        message = self.message + more
        return type(self)(message, place=place, found=self.found, allowed=self.allowed, remedy=self.remedy)

    def __str__(self) -> str:
        head = f"{self.place}: {self.message}" if str(self.place) else self.message
        facts = [f"found {escaped(self.found)}"] if self.found is not None else []
        facts += [f"allowed: {escaped(self.allowed)}"] if self.allowed is not None else []
        text = head + (f" ({'; '.join(facts)})" if facts else "")
        return text + (f"\n  {escaped(self.remedy)}" if self.remedy else "")


def _readable(text: str) -> str:
    """Advice as a sentence; what it repeats of a file is cut where that is long.

    >>> _readable("add mass_kg = 5.6"), _readable("mass_kg = 5.6 is meant"), _readable("abu init FILE writes one")
    ('Add mass_kg = 5.6', 'mass_kg = 5.6 is meant', 'abu init FILE writes one')
    """
    sentence = _PROSE.sub(lambda match: match[0].upper(), text, count=1) if _PROSE.match(text) else text
    return shortened(_LONG_WORD.sub(lambda match: shortened(match[0]), sentence), LONGEST_FILE_NAME)


class RangeError(InputError):
    """A value outside the range in which a formula or a table holds."""

    kind: ClassVar[str] = "range"


class OutputError(InputError):
    """A result cannot be written: the file exists, its suffix is unknown, its folder is missing."""

    kind: ClassVar[str] = "output"


class NotTrustworthyError(AbuError):
    """No number that can be trusted: names the quantity, the moment, and what to change."""

    kind: ClassVar[str] = "not-trustworthy"


class ChaoticError(NotTrustworthyError):
    """The motion amplifies errors, so that two runs never agree.

    `ended`: one run of several whose balls all came to rest where they balance, so that the end is known but for its
    numbers; None where the end is not known either.
    """

    ended: Any = None


class StoppedError(AbuError):
    """Somebody interrupted long work; says what is kept, and how to go on."""

    kind: ClassVar[str] = "interrupted"

    def __init__(self, message: str, exit_status: int = 130) -> None:
        super().__init__(message)
        self.exit_status = exit_status
