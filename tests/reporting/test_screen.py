"""A report on one screen: verdict, reasons and tables cut to the room there is.

Names, keys and values of files reach terminals and text files harmless, and begin no line of their own.
"""

import re
from dataclasses import replace
from pathlib import Path
from typing import ClassVar

import pytest

from abu_calc.foundation.checks import Check, Grade
from abu_calc.foundation.errors import escaped, escaped_lines
from abu_calc.foundation.quantity import record
from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, Picture
from abu_calc.reporting.screen import (
    LINES,
    as_text,
    cut,
    height,
    many,
    one_screen,
    sections,
    shortened,
    show,
    verdict_line,
)
from abu_calc.simulation.result import Provenance, Result
from tests.cli.runner import abu
from tests.inputs.samples import BASIC, BEARINGS


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


ACTING = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\u2028\u2029]")
"""What acts on a terminal; lines end in \n alone."""
HOSTILE = "\\u001b[2Jx\\u009b31m\\u202ey\\u2066\\t"
FORGED = "\\nPASS: all good"


def named(tmp_path: Path, name: str, text: str = BEARINGS) -> Path:
    """A file of that name for the machine and its bearing."""
    file = tmp_path / "machine.toml"
    file.write_text(text.replace('"fleshing roll"', f'"{name}"').replace('"left"', f'"{name}"'), encoding="utf-8")
    return file


@pytest.mark.few(1)
@pytest.mark.parametrize("more", [(), ("--full",), ("--explain",)])
def test_reports_show_what_acts_on_terminals_escaped(tmp_path: Path, more: tuple[str, ...]) -> None:
    seen = abu("check-fit", str(named(tmp_path, HOSTILE)), *more)
    assert seen.status in (0, 1) and not ACTING.search(seen.out + seen.err)
    assert "\\x1b[2Jx\\x9b31m\\u202ey" in seen.out.replace("\n", "")


ACTS = "\x1b[2J\u202ex\x9b31m"


@pytest.mark.parametrize("block", [
    Heading(ACTS), Paragraph(ACTS, None, 2), Facts(((ACTS, ACTS, ACTS),)), Grid((ACTS, "a"), ((ACTS, "b"),)),
    Picture((ACTS,), ACTS, 2),
], ids=lambda block: type(block).__name__)  # fmt: skip
def test_every_part_of_a_report_is_escaped(block: Block) -> None:
    """Headers of tables and captions, too, where handles' names stand."""
    text = as_text([block], 100)
    assert "\\x1b[2J\\u202ex\\x9b31m" in text and not ACTING.search(text)


@pytest.mark.parametrize("sign", ["\\n", "\\r", "\\u0085", "\\u2028", "\\u000b"])
@pytest.mark.parametrize(("where", "text"), [("machine.name", BEARINGS), ("bearing[0].name", BEARINGS)])
def test_a_name_of_two_lines_is_refused(tmp_path: Path, sign: str, where: str, text: str) -> None:
    old = '"fleshing roll"' if where == "machine.name" else '"left"'
    file = tmp_path / "machine.toml"
    file.write_text(text.replace(old, f'"x{sign}PASS: all good"'), encoding="utf-8")
    seen = abu("check-fit", str(file))
    assert seen.status == 2 and where in seen.err and "one line" in seen.err
    assert not any(line.startswith("PASS") for line in seen.err.splitlines())


@pytest.mark.parametrize("text", [
    BASIC.replace("= 5.6", f'= "{HOSTILE}{FORGED}"'), f'"{HOSTILE}{FORGED}" = 1\n' + BASIC,
    BASIC.replace("[limits]", f'[limits]\n"{HOSTILE}{FORGED}" = 1'),
    BASIC.replace('"straight"', f'"{HOSTILE}{FORGED}"', 1), BASIC + f'[expected]\n"{HOSTILE}{FORGED}" = 1\n',
])  # fmt: skip
@pytest.mark.parametrize("name", ["plain.toml", "a\nPASS: all good\x1b[31m.toml"])
def test_messages_about_files_are_harmless(tmp_path: Path, text: str, name: str) -> None:
    file = tmp_path / name
    file.write_text(text, encoding="utf-8")
    seen = abu("validate", str(file))
    assert seen.status == 2 and not ACTING.search(seen.err)
    assert not any(line.lstrip().startswith("PASS") for line in seen.err.splitlines())


@pytest.mark.parametrize("name", ["a\nPASS: all good\x1b[31m.toml", "a\n  PASS: all good.toml"])
@pytest.mark.slow
def test_names_of_files_are_harmless_in_reports(tmp_path: Path, name: str) -> None:
    file = tmp_path / name
    file.write_text(BEARINGS + '[expected]\nstatus = "fail"\n', encoding="utf-8")
    for command in ("validate", "check-fit", "verify"):
        for more in ((), ("--full",)):
            seen = abu(command, str(file), *more)
            assert seen.status in (0, 1) and not ACTING.search(seen.out)
            assert "\\n" in seen.out.replace("\n", "") or command == "check-fit"
            assert not any(line.startswith("PASS: all good") for line in seen.out.splitlines())


def test_a_long_name_forges_no_verdict(tmp_path: Path) -> None:
    """Lines of a name that is wrapped stand deeper than verdicts."""
    seen = abu("check-fit", str(named(tmp_path, "x" * 76 + " PASS: all good")))
    assert "PASS: all good" in seen.out
    assert not [line for line in seen.out.splitlines() if re.match(r" {0,2}PASS: all", line)]


@pytest.mark.few(2)
@pytest.mark.parametrize("arguments", [
    ("\x1b[2J\nPASS: x",), ("presets", "\x1b[2J\nPASS: x"), ("schema", "\x1b[2J\nPASS: x"),
    ("explain", "\x1b[2J\nPASS: x"), ("check-fit", "--designation", "\x1b[2J\nPASS: x", "--shaft", "k6", "--housing",
                                      "H7"), ("validate", "--\x1b[2J\nPASS: x"),
    ("check-fit", "mmg-3200k-knife-shaft", "--set", "\x1b[2J\nPASS: x"),
    ("check-fit", "mmg-3200k-knife-shaft", "--set", "machine.name='\x1b[2J\nPASS: x'"),
    ("check-fit", "mmg-3200k-knife-shaft", "--output", "\x1b[2J\nPASS: x"),
    ("check-fit", "mmg-3200k-knife-shaft", "--output", "no\x1b[2J\nPASS: x/a.json"),
])  # fmt: skip
def test_command_lines_are_harmless(arguments: tuple[str, ...]) -> None:
    seen = abu(*arguments)
    assert seen.status == 2 and not ACTING.search(seen.err)
    assert not any(line.startswith("PASS") for line in seen.err.splitlines())


@pytest.mark.slow
def test_found_values_are_cut(tmp_path: Path) -> None:
    long = "y" * 5000
    for arguments in (("explain", long), ("schema", long), (long,), ("validate", long), ("validate", f"--{long}")):
        seen = abu(*arguments)
        assert seen.status == 2 and len(seen.err) < 2000, arguments
    file = tmp_path / "machine.toml"
    file.write_text(BASIC.replace("5.6", f'"{long}"').replace("[limits]", f"[limits]\n{long} = 1"), encoding="utf-8")
    seen = abu("validate", str(file), "--json")
    assert len(seen.err) < 2000 and len(seen.document["error"]["found"]) <= 200


def test_a_command_stays_on_one_line_in_colour(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Pasted, a line that a report ends would be another command."""
    monkeypatch.setenv("FORCE_COLOR", "1")
    command = "abu size machine.toml " + 10 * "--set autobalancer.rolling_drag_per_s=18 "
    show([Paragraph(command.rstrip(), whole=True)])
    assert command.rstrip() in capsys.readouterr().out


def test_what_is_escaped() -> None:
    assert escaped("Ø 5 µm – Жук 車\u200d") == "Ø 5 µm – Жук 車\u200d"
    assert escaped("a\nb\tc\r\x00\x7f\x85\udcff\U000e0041") == "a\\nb\\tc\\r\\x00\\x7f\\x85\\udcff\\U000e0041"
    assert escaped_lines("a\nb\x1b") == "a\nb\\x1b"


def test_advice_that_repeats_a_long_value_is_cut(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(f'[machine]\nname = "x"\nmass_kg = "{"1" * 5000}"\n', encoding="utf-8")
    told = abu("validate", str(file)).err
    assert "without quotes" in told and max(map(len, told.splitlines())) < 1200
