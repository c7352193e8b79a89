"""Text made safe for people to read.

Whatever prints text for people, or writes it to a file, sends it through `escaped` or its kin: nothing in it then acts
on a terminal, or breaks a line.
"""

import re
from typing import Final

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
