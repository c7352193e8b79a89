"""The page of a command that runs again and again: the last result, with a notice of what has changed since then."""

import re
from datetime import datetime
from html import escape, unescape
from pathlib import Path
from typing import Any, Final, NamedTuple

from abu_calc.foundation.checks import CHECK_CODES, WORDS
from abu_calc.reporting.blocks import number
from abu_calc.reporting.outcome import Target, write
from abu_calc.reporting.page.card import script, text
from abu_calc.reporting.page.document import MAIN, SAFE, framed

FOLLOWS: Final = SAFE + "; frame-src 'self' file:"
"""Security policy of a page that looks at its own file."""
MAIN_CHECKS: Final = ("idle_level", "quiet_time", "capacity", "mass")
"""Keys of the checks whose numbers stand first."""
MOST_CHANGES: Final = 4
"""Most checks whose change is told."""


class Shown(NamedTuple):
    """A result: the time of its run, its verdict, and its checks as the JSON document has them."""

    clock: str
    verdict: str
    checks: list[dict[str, Any]]

    @property
    def named(self) -> dict[tuple[str, str], dict[str, Any]]:
        """Checks by code and name."""
        return {(check["code"], check["name"]): check for check in self.checks}


class WatchedPage:
    """The file of the page; `write` writes the newest state."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._result = framed("abu-calc", [MAIN, "</main>"])
        self._before: Shown | None = None
        self._now: Shown | None = None
        self._notice, self._wanted, self._written = "", "", ""

    def computing(self) -> None:
        """A file was saved, and the command runs."""
        self._show("warn", f"Saved at {_clock()}. The new result is being computed. {self._older()}")

    def wrong(self, messages: str) -> str:
        """The command gave no result: show why, above the last one; return the line for a terminal."""
        first, *rest = re.sub(r"^abu [a-z-]+: ", "", messages.strip()).splitlines() or ["There is no result."]
        self._show("fail", f"No new result at {_clock()}. {self._older()}", first, *rest)
        return "\n  ".join((f"{_clock()}  {first}", *(line.strip() for line in rest)))

    def right(self, page: str, document: dict[str, Any]) -> str:
        """Show a new result with its page; return the line for a terminal."""
        self._before, self._result = self._now, page
        self._now = Shown(_clock(), verdict_of(page, document), document["checks"])
        if self._before is None:
            self._show("", f"Result of {self._now.clock}.")
        else:
            verdict = "the same verdict." if self._before.verdict == self._now.verdict else self._before.verdict
            earlier = f"Before, {self._before.clock}: {verdict}"
            self._show(
                "", f"Result of {self._now.clock}: {self._now.verdict}", earlier, changes(self._before, self._now)
            )
        return f"{self._now.clock}  {self._now.verdict}"

    def write(self) -> None:
        """Write the file if its content has changed. Raises OutputError if that is not possible now."""
        if self._wanted != self._written:
            write([Target(self._path, self._wanted)], force=True)
            self._written = self._wanted

    def end(self) -> None:
        """Write the last result as a page that no longer follows; a notice that it is old stays."""
        self._compose(follows=False)
        self.write()

    def _older(self) -> str:
        return f"The result below is old, of {self._now.clock}." if self._now else "There is no result yet."

    def _show(self, grade: str, first: str, *lines: str) -> None:
        more = "".join(f"<p>{text(line.strip())}</p>" for line in lines)
        self._notice = (
            f'<aside class="watched {grade}" role="status"><p><strong>{text(first)}</strong></p>{more}</aside>'
        )
        self._compose(follows=True)

    def _compose(self, *, follows: bool) -> None:
        told = self._notice if follows or 'class="watched "' not in self._notice else ""
        version = f"{datetime.now().timestamp()}"
        page = self._result.replace(escape(SAFE), escape(FOLLOWS), 1)
        page = page.replace("</head>", f"{script('watch.js', version=version, follows=follows)}</head>", 1)
        self._wanted = page.replace("<body>", f"<body>{told}", 1)


def verdict_of(page: str, document: dict[str, Any]) -> str:
    """The verdict in a sentence; of a result without one, in the word with which the title of its page begins."""
    result = document["result"]
    verdict = result.get("verdict") if isinstance(result, dict) else None
    if isinstance(verdict, dict) and "sentence" in verdict:
        return str(verdict["sentence"])
    title = re.search(r"<title>(.*?)</title>", page)
    return unescape(title[1]).partition(":")[0] + "." if title else ""


def changes(before: Shown, now: Shown) -> str:
    """Checks whose grades or numbers have changed, in a line: grades first, then the main numbers.

    >>> def shown(level: float, grade: str) -> Shown:
    ...     return Shown("", "", [{"code": "…", "name": "level", "status": grade, "value": level, "unit": "dB"}])
    >>> changes(shown(110.25, "fail"), shown(100.5, "pass"))
    'Changed: level 110.2 → 100.5 dB, FAIL → PASS.'
    """
    earlier = before.named
    pairs = [(earlier[key], check) for key, check in now.named.items() if key in earlier]
    moved = [(old, new) for old, new in pairs if old["status"] != new["status"] or _value(old) != _value(new)]
    moved.sort(key=lambda pair: (pair[0]["status"] == pair[1]["status"], _rank(pair[1]["code"])))
    told = "; ".join(_change(old, new) for old, new in moved[:MOST_CHANGES])
    more = len(moved) - MOST_CHANGES
    return (
        f"Changed: {told}{f'; {more} more' if more > 0 else ''}."
        if moved
        else "Every check has the same grade and number."
    )


def _rank(code: str) -> int:
    kind = CHECK_CODES.get(code)
    return MAIN_CHECKS.index(kind.key) if kind and kind.key in MAIN_CHECKS else len(MAIN_CHECKS)


def _change(old: dict[str, Any], new: dict[str, Any]) -> str:
    unit = f" {new['unit']}" if new["unit"] else ""
    values = [f"{new['name']} {_value(old)} → {_value(new)}{unit}"] if _value(old) != _value(new) else [new["name"]]
    grades = [f"{WORDS[old['status']]} → {WORDS[new['status']]}"] if old["status"] != new["status"] else []
    return ", ".join(values + grades)


def _value(check: dict[str, Any]) -> str:
    value = check["value"]
    return "–" if value is None else number(value, 4 if check["unit"] == "dB" else 3)


def _clock() -> str:
    return f"{datetime.now():%H:%M:%S}"
