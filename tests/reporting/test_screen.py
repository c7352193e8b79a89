"""A report on one screen: verdict, reasons and tables cut to the room there is."""

import re
from dataclasses import replace
from typing import ClassVar

import pytest

from abu_calc.foundation.checks import Check, Grade
from abu_calc.foundation.quantity import record
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph
from abu_calc.reporting.screen import LINES, as_text, cut, height, many, one_screen, sections, shortened, verdict_line
from abu_calc.simulation.result import Provenance, Result


@pytest.mark.parametrize("room", range(1, 30))
def test_tables_are_cut_to_the_room_there_is(room: int) -> None:
    rows = tuple((str(number), "x") for number in range(12))
    blocks: list[Block] = [
        Paragraph("first"),
        Heading("Table"),
        Grid(("a", "b"), rows),
        Heading("End"),
        Paragraph("last"),
    ]
    shown = cut(blocks, room)
    text = as_text(shown)
    assert height(shown) <= room and not isinstance(shown[-1], Heading)
    whole = room >= height(blocks)
    assert ("--full" in text) is not whole
    counted = re.search(r"And (\d+) more row", text)
    if counted:
        assert len(re.findall(r"x$", text, re.MULTILINE)) + int(counted[1]) == 12


@record
class Sample(Result):
    """A result without numbers of its own."""

    command: ClassVar[str] = "sample"


def sample(*grades: Grade, warnings: tuple[str, ...] = ()) -> Sample:
    checks = tuple(Check(f"ABU40{k}", f"thing {k}", grade, f"reason {k}") for k, grade in enumerate(grades, 1))
    return Sample(title="sample", checks=checks, warnings=warnings, provenance=Provenance.today())


def test_the_verdict_counts_checks_and_warnings() -> None:
    assert verdict_line(sample("pass", "pass")).text == "PASS: 2 of 2 checks pass"
    warned = verdict_line(sample("pass", "warn", warnings=("a",)))
    assert warned.text == "PASS WITH WARNINGS: 1 of 2 checks passes, 1 warns, 0 fail" and warned.mark == "warn"
    several = verdict_line(sample("fail", "not-done", "pass"))
    assert several.text == "FAIL: 1 of 3 checks passes, 0 warn, 1 fails, 1 not evaluated"
    assert verdict_line(sample()).text == "NOT EVALUATED: there are no checks"
    assert verdict_line(sample("pass"), "Nothing was judged").text == "Nothing was judged"


def test_the_verdict_stands_at_the_top_and_at_the_end_and_the_first_open_check_is_explained() -> None:
    result = sample("pass", "fail", "pass")
    text = as_text(one_screen(result, [Heading("sample"), verdict_line(result)]))
    assert text.count("FAIL: 2 of 3 checks pass") == 2 and "`abu explain ABU402`" in text
    assert "FAIL" not in as_text(one_screen(sample(), [Heading("sample")]))


def test_reasons_that_fill_the_screen_leave_their_entries_to_the_report() -> None:
    """Thirty reasons with entries to paste: a screen is a screen, and one action stands in it once."""
    checks = tuple(
        Check(f"ABU4{k:02}", f"thing {k}", "warn", f"reason {k}", remedy="Set it.", overrides=(f"machine.a={k}",))
        for k in range(30)
    )
    blocks = one_screen(replace(sample(), checks=checks), [Heading("sample")])
    text = as_text(blocks)
    assert height(blocks) <= LINES and "--set" not in text
    assert text.count("Action: Set it.") == 1 and "Action: See the action of ABU400." in text


def test_a_picture_takes_the_lines_that_are_left() -> None:
    given: list[int] = []

    def picture(room: int) -> list[Block]:
        given.append(room)
        return [Paragraph("drawn")]

    about: list[Block] = [Heading("sample")]
    bare = one_screen(sample("pass"), about)
    assert "drawn" in as_text(one_screen(sample("pass"), about, picture=picture))
    assert given == [LINES - height(bare) - 1]


def test_sections_that_a_screen_words_itself_are_left_out() -> None:
    whole: list[Block] = [
        Heading("Title"),
        Paragraph("verdict"),
        Heading("Numbers"),
        Paragraph("1"),
        Heading("Checks", "checks"),
        Paragraph("2"),
        Heading("Details", "details"),
        Paragraph("3"),
    ]
    assert [len(part) for part in sections(whole)] == [2, 2, 2, 2]
    text = as_text(shortened(sample("pass"), whole, "details"))
    assert "Numbers" in text and "Details" not in text and "Checks" not in text


def test_a_count_has_its_noun() -> None:
    assert [many(count, "row") for count in (0, 1, 2)] == ["0 rows", "1 row", "2 rows"]
