"""A page that follows its file: in Chromium as a plain file, and its texts without a browser."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from abu_calc.reporting.page.watched import MOST_CHANGES, Shown, WatchedPage, changes
from tests.cli.test_watch import SEAT, awaited, watching
from tests.reporting.page.browser import Browser
from tests.reporting.page.reader import read


def _check(code: str = "ABU401", value: float | None = 1.0, status: str = "pass") -> dict[str, Any]:
    return {"code": code, "name": code.lower(), "status": status, "value": value, "unit": "dB"}


def test_changes_tell_grades_first_and_count_the_rest() -> None:
    codes = [f"ABU{100 + number}" for number in range(1, 8)]
    before = Shown("", "", [_check(code) for code in codes])
    now = Shown("", "", [*(_check(code, 2.0) for code in codes[:-1]), _check(codes[-1], None, "not-done")])
    told = changes(before, now)
    assert told.startswith("Changed: abu107 1.000 → – dB, PASS → NOT EVALUATED; ")
    assert told.endswith(f"; {len(codes) - MOST_CHANGES} more.")
    assert changes(now, now) == "Every check has the same grade and number."


def test_notices_of_every_state_are_whole_pages_in_which_nothing_acts(tmp_path: Path) -> None:
    file = tmp_path / "r.html"
    page = WatchedPage(file)
    result = "<!DOCTYPE html>\n<html><head><title>PASS: a</title></head><body><p>x</p></body></html>"
    steps: list[tuple[Callable[[], object], str]] = [
        (lambda: page.wrong("abu size: a.toml:3: <script>alert(1)</script>\n  Mend it."), "There is no result yet."),
        (page.computing, "being computed"),
        (lambda: page.right(result, {"checks": [], "result": None}), "Result of"),
        (lambda: page.wrong("abu size: a.toml:3: no"), "The result below is old"),
        (lambda: page.right(result, {"checks": [], "result": {"verdict": {"sentence": "Suits."}}}), "Before"),
    ]
    for act, words in steps:
        act()
        page.write()
        text = file.read_text("utf-8")
        seen = read(text)
        assert seen.faults == []
        assert words in " ".join(said for _, said in seen.texts)
        assert "alert(1)</script>" not in text and '"follows":true' in text
    page.end()
    assert '"follows":false' in file.read_text("utf-8") and "<aside" not in file.read_text("utf-8")


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(__import__("os"), "set_inheritable"), reason="the browser's pipes are those of POSIX")
def test_page_in_a_browser_follows_its_file(tmp_path: Path, browser: Browser) -> None:
    """A good change, a wrong one, two quick ones, the file replaced, deleted and restored; the place is kept."""
    file, page, other = tmp_path / "seat.toml", tmp_path / "r.html", tmp_path / "other"
    took: dict[str, float] = {}

    def notice() -> str:
        try:
            return str(browser.value("document.querySelector('.watched').innerText + document.title"))
        except AssertionError:  # the page is being replaced
            return ""

    def follows(name: str, *words: str) -> None:
        begun = time.monotonic()
        awaited(lambda: all(word in notice() for word in words))
        took[name] = time.monotonic() - begun

    file.write_text(SEAT.format(load=1, fit="k5"))
    with watching("check-fit", "seat.toml", "-o", "r.html", folder=tmp_path):
        awaited(page.exists)
        browser.load(page)
        browser.seen(390)
        follows("first result", "Result of")
        browser.value("scrollTo(0, 1500)")

        file.write_text(SEAT.format(load=2, fit="k5"))
        follows("good change", "Result of", "Changed:")
        assert browser.value("scrollY") > 1000
        place = browser.value("document.querySelector('main').getBoundingClientRect().top")

        file.write_text(SEAT.format(load=2, fit="k99"))
        follows("wrong change", "No new result", "seat.toml:10", "The result below is old")
        assert abs(browser.value("document.querySelector('main').getBoundingClientRect().top") - place) < 3
        assert "6203" in browser.value("document.querySelector('main').innerText")

        file.write_text(SEAT.format(load=3, fit="k5"))
        time.sleep(0.5)  # its run has begun, or not
        file.write_text(SEAT.format(load=3, fit="m5"))
        follows("two quick changes", "Result of", "Before")
        awaited(lambda: "m5" in browser.value("document.querySelector('main').innerText"))

        other.write_text(SEAT.format(load=3, fit="n99"))
        other.replace(file)
        follows("replaced", "No new result", "n99")

        file.unlink()
        follows("deleted", "Restore the file")
        assert "m5" in browser.value("document.querySelector('main').innerText")

        file.write_text(SEAT.format(load=4, fit="m5"))
        follows("restored", "Result of")
        assert browser.value("scrollY") > 1000
    print({name: round(seconds, 2) for name, seconds in took.items()})
