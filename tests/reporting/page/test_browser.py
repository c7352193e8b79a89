"""Every page in Chromium: silent, at home, readable at every width and on paper, and its motion moves and stops."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.cli.runner import again
from tests.reporting.page.browser import Browser
from tests.reporting.page.pages import COMMANDS

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not hasattr(__import__("os"), "set_inheritable"), reason="its pipes are those of POSIX"),
]
WIDTHS = (360, 800, 1600)
PATIENCE = 60.0
"""Seconds that a browser under load may take."""
PAPER = 688
"""Pixels between the margins of A4."""
MOVES = [name for name, command in COMMANDS.items() if command[0] in ("size", "simulate") and name != "arm-size"]


@pytest.mark.parametrize("name", COMMANDS)
def test_page_is_silent_and_asks_for_nothing(name: str, written: Any, browser: Browser) -> None:
    file = written(name).file
    browser.load(file)
    time.sleep(0.1)
    browser.value("1")
    assert browser.errors == []
    assert [one for one in browser.requests if one != file.as_uri() and not one.startswith("data:")] == []
    assert file.as_uri() in browser.requests


@pytest.mark.parametrize("name", COMMANDS)
def test_no_writing_overlaps_or_is_cut(name: str, written: Any, browser: Browser) -> None:
    """On paper every table has all its columns: none scrolls there."""
    browser.load(written(name).file)
    for width, paper in (*((width, False) for width in WIDTHS), (PAPER, True)):
        browser.seen(width, paper=paper)
        for what in ("overlaps", "cut"):
            assert browser.value(f"examine.{what}()") == [], (what, width, paper)
    browser.seen(360)
    assert browser.value("examine.small(7)") == []


@pytest.mark.parametrize("name", COMMANDS)
def test_writing_and_lines_have_contrast_in_both_themes_and_on_paper(
    name: str, written: Any, browser: Browser
) -> None:  # fmt: skip
    browser.load(written(name).file)
    for theme in ({}, {"dark": True}, {"paper": True}):
        browser.seen(800, **theme)
        assert browser.value("examine.contrast()") == [], theme
    browser.seen(800, dark=True)
    assert browser.value("getComputedStyle(document.body).backgroundColor") == "rgb(20, 24, 29)"


@pytest.mark.parametrize("name", ["size", "check-fit"])
def test_paper_has_pages_of_a4(name: str, written: Any, browser: Browser) -> None:
    browser.load(written(name).file)
    pdf = browser.pdf()
    assert pdf.count(b"/Type /Page\n") >= 5
    assert b"/MediaBox [0 0 594.95996 841.91998]" in pdf or b"/MediaBox [0 0 595" in pdf


@pytest.mark.parametrize("preset", ["avtovaz-707-222", "avtovaz-707-305", "avtovaz-707-370", "msh-230"])
def test_page_of_a_factory_machine_takes_six_sheets_and_fits_a_telephone(
    preset: str, tmp_path: Path, browser: Browser
) -> None:
    """Formulas are closed at first; bars without and with the autobalancer are the first picture."""
    file = tmp_path / "page.html"
    assert again("size", preset, "--output", str(file), "--quiet").status in (0, 1)
    browser.load(file)
    assert 3 <= browser.pdf().count(b"/Type /Page\n") <= 6
    browser.seen(390)
    assert browser.value("examine.cut()") == []
    wide = "[...document.querySelectorAll('.wide')].filter((each) => each.scrollWidth > each.clientWidth + 1)"
    assert browser.value(f"{wide}.map((each) => each.ariaLabel)") == []
    assert browser.value("document.querySelector('svg title').textContent").startswith("Vibration without and with")


@pytest.mark.parametrize("name", ["size", "arm-size"])
def test_summary_takes_two_sheets_of_its_own(name: str, written: Any, browser: Browser) -> None:
    """The details begin on a new sheet; without them the paper has at most two."""
    browser.load(written(name).file)
    browser.seen(PAPER, paper=True)
    assert browser.value("getComputedStyle(document.querySelector('header.summary')).breakAfter") == "page"
    whole = browser.pdf().count(b"/Type /Page\n")
    browser.value("document.getElementById('main').remove()")
    summary = browser.pdf().count(b"/Type /Page\n")
    assert 1 <= summary <= 2 < whole


@pytest.mark.parametrize("name", MOVES)
def test_motion_moves_and_stops_by_keys(name: str, written: Any, browser: Browser) -> None:
    browser.load(written(name).file)
    browser.value("document.getElementById('main').focus()")
    passed = []
    while not passed or passed[-1] != "motion":
        browser.press("Tab")
        passed.append(browser.value("document.activeElement.id || document.activeElement.tagName"))
        assert len(passed) < 60, passed
    before = _drawn(browser)
    browser.press(" ")
    assert _label(browser) == "Pause"
    assert _until(browser, lambda: _drawn(browser) != before)
    if _label(browser) == "Pause":  # a loaded computer may reach the end of the motion first
        browser.press(" ")
    stopped = _drawn(browser)
    time.sleep(0.3)
    assert _drawn(browser) == stopped
    browser.press("End")
    told = browser.value("document.getElementById('motion-told').textContent")
    last = float(browser.value("document.getElementById('motion-time').max"))
    assert float(told.split()[0]) == pytest.approx(last, abs=1e-3)
    # From shortly before its end it plays to it, and stops there by itself.
    browser.value(
        f"var slider = document.getElementById('motion-time'); slider.value = {last - 0.02};"
        "slider.dispatchEvent(new Event('input')); document.getElementById('motion-play').click()"
    )
    assert _until(browser, lambda: _label(browser) == "Play")
    assert float(browser.value("slider.value")) == pytest.approx(last, abs=1e-3)
    browser.press("Tab")
    assert browser.value("document.activeElement.id") == "motion-play"


def test_another_start_can_be_chosen(written: Any, browser: Browser) -> None:
    browser.load(written("size").file)
    count = int(browser.value("document.getElementById('motion-start').options.length"))
    assert 5 <= count <= 13
    seen = set()
    for index in range(count):
        browser.value(
            f"var start = document.getElementById('motion-start'); start.value = {index};"
            "start.dispatchEvent(new Event('change')); document.getElementById('motion').focus()"
        )
        assert float(browser.value("document.getElementById('motion-time').value")) < 0.2
        browser.press("End")
        seen.add(_drawn(browser))
    assert len(seen) >= count - 1
    assert browser.errors == []


def _drawn(browser: Browser) -> tuple[str, str]:
    """What the canvas shows, and what is told below it."""
    words = "document.getElementById('motion-told').textContent"
    return browser.value("document.getElementById('motion').toDataURL()"), browser.value(words)


def _label(browser: Browser) -> str:
    """What the button does when it is pressed."""
    return str(browser.value("document.getElementById('motion-play').textContent"))


def _until(browser: Browser, state: Callable[[], bool]) -> bool:
    """Whether a state is reached, however slow the computer is."""
    end = time.monotonic() + PATIENCE
    while not state():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
        browser.value("1")
    return True


FAULTY = """<!DOCTYPE html><html lang="en"><head><title>x</title><link rel="icon" href="data:,"></head>
<body style="background: #fff"><main id="main"></main>
<p style="position: absolute; top: 10px; left: 10px; color: #777">the first of both</p>
<p style="position: absolute; top: 14px; left: 30px; color: #aaa">the second of both</p>
<p style="position: absolute; top: 90px; left: 780px; width: 300px; white-space: nowrap">leaves the page</p>
<svg class="chart" width="100" height="50"><text x="80" y="20">leaves it</text></svg>
<script>console.error("said"); fetch("http://127.0.0.1:9/").catch(() => 0); nothing.here;</script></body></html>"""


def test_what_tests_ask_finds_faults(tmp_path: Path, browser: Browser) -> None:
    file = tmp_path / "faulty.html"
    file.write_text(FAULTY, "utf-8")
    browser.load(file)
    browser.seen(800)
    assert any("first" in one and "second" in one for one in browser.value("examine.overlaps()"))
    cut = browser.value("examine.cut()")
    assert any("leaves the page" in one for one in cut)
    assert any("leaves its figure" in one for one in cut)
    assert any("second" in one for one in browser.value("examine.contrast()"))
    assert _until(browser, lambda: any("127.0.0.1" in one for one in browser.requests))
    assert any("said" in one for one in browser.errors)
    assert any("nothing is not defined" in one for one in browser.errors)
