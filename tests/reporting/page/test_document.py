"""The HTML page: one file, well formed, the same numbers as the JSON document, nothing in names that acts.

Blocks and figures as elements of a page.
"""

import json
import math
import re
from collections.abc import Iterator
from itertools import chain, pairwise
from pathlib import Path
from typing import Any

import pytest

from abu_calc.cli.app import COMMANDS as CALLED
from abu_calc.features.grinding.view import LEFT_OUT as GRINDING_LEFT_OUT
from abu_calc.features.stability.view import FOR_THE_ARM, LEFT_OUT
from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, Picture
from abu_calc.reporting.charts.chart import SUMMARY, Axis, Bar, Bars, Extras, Figure
from abu_calc.reporting.drawings.shapes import Drawing, Line
from abu_calc.reporting.outcome import Outcome
from abu_calc.reporting.page.document import LAST, PIXELS, REPEAT, elements, figure, paragraph
from abu_calc.reporting.page.document import page as page_of
from abu_calc.reporting.screen import ELSEWHERE
from tests.cli.runner import abu, again, once
from tests.reporting.page.pages import ALSO, COMMANDS, PAGES
from tests.reporting.page.reader import read

MOVING = ("motion", "settling", "level", "run-up", "orbit")
"""Figures of motions begin so."""
NUMBER = re.compile(r"(?<![\w.])[+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w])")


@pytest.mark.slow
@pytest.mark.parametrize("name", PAGES)
def test_page_is_well_formed_and_asks_no_network(name: str, written: Any) -> None:
    text, document, _ = written(name)
    page = read(text)
    assert page.faults == []
    assert not re.search(r"https?:|//\w", re.sub(r"<script>.*?</script>", "", text, flags=re.DOTALL))
    assert not any(key in ("src", "srcset", "background") for _, attributes in page.tags for key in attributes)
    ids = [attributes["id"] for _, attributes in page.tags if "id" in attributes]
    links = [attributes["href"] for tag, attributes in page.tags if tag == "a"]
    assert len(ids) == len(set(ids))
    assert {str(link).removeprefix("#") for link in links} <= set(ids)
    assert len(text.encode()) < 2_000_000
    title = next(words for tag, words in page.texts if tag == "title")
    warned = any(check["status"] == "warn" and check.get("requested", True) for check in document["checks"])
    passed = "PASS WITH WARNINGS: " if warned else "PASS: "
    assert title.startswith({"pass": passed, "fail": "FAIL: ", "not-done": "NOT EVALUATED: "}[document["status"]])


@pytest.mark.parametrize("name", PAGES)
@pytest.mark.slow
def test_each_number_in_tables_is_one_of_the_document(name: str, written: Any) -> None:
    text, document, _ = written(name)
    cells = [cell.replace("dB re 5e-8 m/s", "dB") for cell in read(text).cells]  # the reference of levels
    found = [token for cell in cells for token in NUMBER.findall(cell)]
    assert len(found) > 10 or _nothing_measured(document)
    assert _unknown(found, name, document) == []


@pytest.mark.parametrize("name", PAGES)
@pytest.mark.slow
def test_each_number_that_a_figure_tells_is_one_of_the_document(name: str, written: Any) -> None:
    """But of motions: their samples are in no document."""
    text, document, _ = written(name)
    told = re.findall(r'<desc id="chart-([\w-]+)-d">(.*?)</desc>', text)
    assert told or name == "compare-seats" or _nothing_measured(document)
    found = [token for which, words in told if not which.startswith(MOVING) for token in NUMBER.findall(words)]
    assert _unknown(found, name, document, rounded=True) == []


def _nothing_measured(document: dict[str, Any]) -> bool:
    """What a busy computer measures within a budget may be nothing."""
    return document["abu"]["command"] == "accuracy" and not document["result"]["points"]


def _unknown(found: list[str], name: str, document: dict[str, Any], *, rounded: bool = False) -> list[str]:
    """Those that are neither a number of the document nor stand in its words."""
    held = [
        one
        for each in (document, *(once(*of, "--json").document for of in ALSO.get(name, ())))
        for one in _leaves(each)
    ]
    numbers = [float(one) for one in held if isinstance(one, (int, float)) and not isinstance(one, bool)]
    # Of a complex number tables have the angle, the document its parts.
    numbers += [math.degrees(math.atan2(after, before)) for before, after in pairwise(numbers)]
    words = " ".join(one for one in held if isinstance(one, str))
    return [one for one in found if not _known(one, numbers, rounded=rounded) and one not in words]


def _known(token: str, numbers: list[float], *, rounded: bool) -> bool:
    """Whether a number of the document, as it is or in hundredths, is this one to the digits shown.

    `rounded`: to three digits, as figures have it, where it is larger.
    """
    value, digits = float(token), len(token.partition("e")[0].partition(".")[2])
    room = max(0.5 * 10.0**-digits, (5e-3 if rounded else 0.5e-3) * abs(value) if not digits else 0) * 1.000001
    if "e" in token:
        room *= 10.0 ** int(token.partition("e")[2])
    parts = 1.0, 100.0, 1000.0, 1e6
    return any(abs(abs(one) * part - abs(value)) <= room for one in numbers for part in parts)


def _leaves(value: Any) -> Iterator[Any]:
    if isinstance(value, dict):
        yield from chain.from_iterable(map(_leaves, value.values()))
    elif isinstance(value, list):
        yield len(value)
        yield from chain.from_iterable(map(_leaves, value))
    else:
        yield value


@pytest.mark.slow
def test_size_has_its_figures_with_captions_and_alternatives(written: Any) -> None:
    text, document, _ = written("size")
    page = read(text)
    starts = next(attributes for _, attributes in page.tags if attributes.get("id") == "motion-start")
    assert starts["aria-label"] == "Start"
    assert ", the loudest: " in text and ": quiet after " in text
    figures = [attributes for tag, attributes in page.tags if tag == "svg"]
    assert len(figures) >= 6
    ids = {attributes["id"]: tag for tag, attributes in page.tags if "id" in attributes}
    for one in figures:
        assert one["role"] == "img"
        assert [ids[name] for name in str(one["aria-labelledby"]).split()] == ["title", "desc"]
    captions = sum(tag == "figcaption" for tag, _ in page.tags)
    assert captions == sum(tag == "figure" for tag, _ in page.tags) >= len(figures)
    told = " ".join(words for tag, words in page.texts if tag in ("desc", "text"))
    for line in document["result"]["drawing"]:
        assert line["cost_db"] is None or f"{line['cost_db']:.1f} dB" in told
    assert f"{document['result']['measured_after']['measured_level_db']:.1f} dB" in told


@pytest.mark.slow
def test_calculation_note_and_what_is_needed_to_repeat_it(written: Any) -> None:
    text, document, _ = written("size")
    words = " ".join(data for _, data in read(text).texts)
    assert "Calculation note" in words
    assert "Range:" in words
    assert "Source:" in words
    assert document["input"]["sha256"] in words
    assert "autobalancer.capacity_margin = 1.2" in words


@pytest.mark.slow
@pytest.mark.parametrize("name", ["size", "simulate", "stability", "check-fit"])
def test_settings_on_the_page_give_the_same_result(name: str, written: Any) -> None:
    """The command and its options stand there as labels and values, which no reader takes for advice."""
    text, document, _ = written(name)
    command, machine, *options = COMMANDS[name]
    rows = dict(_settings(text))
    assert (rows["command"], rows[next(label for label in rows if label != "command")]) == (command, machine)
    values = [word for word in options if not word.startswith("--")]
    assert all(value in [shown for _, shown in _settings(text)] for value in values)
    assert len(_settings(text)) == 2 + sum(word.startswith("--") for word in options)
    assert document["input"]["sha256"] in text


def _settings(text: str) -> list[tuple[str, str]]:
    """Rows of the table below the last heading."""
    cells = read(text.partition(f"<h2>{REPEAT}</h2>")[2].partition("</table>")[0]).cells
    return list(zip(cells[::3], cells[2::3], strict=True))


ADVICE = re.compile(rf"(?<![-\w])--[a-z]|`|\babu (?:{'|'.join(CALLED)})\b|\bPython: ")
"""Options and commands, which a reader without the program cannot follow."""


def _said(text: str) -> list[str]:
    return [words for tag, words in read(text).texts if tag not in ("script", "style")]


@pytest.mark.few(2)
@pytest.mark.parametrize("name", PAGES)
def test_pages_advise_no_commands_and_no_options(name: str, written: Any) -> None:
    assert [words for words in _said(written(name).text) if ADVICE.search(words)] == []


ALSO_WRITTEN = (
    *(("size", preset) for preset in ("avtovaz-707-305", "avtovaz-707-370", "msh-230")),
    *((command, preset) for command in ("effects", "levels") for preset in ("avtovaz-707-222", "swing-arm-grinder")),
    ("stability", "swing-arm-grinder", "--scene", "swing-arm-cutting"),
    ("simulate", "swing-arm-grinder", "--scene", "swing-arm-cutting"),
    ("check-fit", "--designation", "6203"),
    ("explain", "ABU702"), ("explain", "capacity"), ("effects",), ("presets",), ("validate", "msh-230"),
)  # fmt: skip


@pytest.mark.few(1)
@pytest.mark.parametrize("words", ALSO_WRITTEN, ids=" ".join)
@pytest.mark.slow
def test_further_pages_advise_no_commands_and_no_options(words: tuple[str, ...], tmp_path: Path) -> None:
    target = tmp_path / "page.html"
    assert again(*words, "--output", str(target), "--quiet").status in (0, 1)
    assert [said for said in _said(target.read_text("utf-8")) if ADVICE.search(said)] == []


def test_summary_stands_first_with_the_numbers_of_the_screen(written: Any) -> None:
    text, document, _ = written("size")
    summary, _, details = text.partition("</header>")
    words = [said for _, said in read(summary.partition("<body>")[2]).texts]
    joined = " ".join(words)
    assert "5800 rpm" in words[1] and "SUITS, BUT" in joined and "Section through the axis" in joined
    order = [joined.index(part) for part in ("SUITS, BUT", "Section through", "Make", "Idle, without", "Median of")]
    assert order == sorted(order)
    for level in (document["result"]["vibration"][key] for key in ("level_before_db",)):
        assert f"{level:.1f}" in words
    assert "<h2>Actions</h2>" in summary and "<h2>Notes</h2>" in summary
    assert "<nav" in details and "<h2>Checks</h2>" in details and "<h2>Warnings</h2>" not in details
    assert "Idle, without autobalancer" not in details


def test_actions_on_the_page_give_entries_of_the_file(written: Any) -> None:
    text, document, _ = written("size")
    entries = re.findall(r'<p class="entries"><code>(.*?)</code></p>', text)
    overrides = {entry for check in document["checks"] for entry in check["overrides"]}
    # On the page the table stands before its key as a machine file writes it.
    rewritten = {re.sub(r"^\[(\S+)\] +(\S+) = ", r"\1.\2=", entry).replace("&quot;", "") for entry in entries}
    assert overrides and rewritten == overrides


GRINDERS = ("avtovaz-707-222", "avtovaz-707-305", "avtovaz-707-370", "msh-230")
REPORTS = {
    **{f"{name}-{preset}": (name, preset)
       for name in ("size", "simulate", "stability") for preset in (*GRINDERS, "swing-arm-grinder")},
    **{f"grinding-{preset}": ("grinding", preset) for preset in GRINDERS},
    "namesakes": ("check-fit", "mmg-3200k-knife-shaft", "--set", "bearing[1].name=7516 as built"),
    "tongue": ("stability", "swing-arm-grinder", "--scene", "swing-arm-cutting"),
    **COMMANDS,
}  # fmt: skip
"""Command lines of reports: each command with the presets that it takes, and those whose pages are looked at."""
AT_THE_END = {"size": {"seats-1", "seats-2"}, "sweep": {"shares"}}
"""Figures without an id, by commands: the seats of a design, and the share of a sweep with one limit."""


def _outcome(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> Outcome:
    """Outcome of a command, before it is delivered."""
    seen: list[Outcome] = []

    def deliver(outcome: Outcome, how: object, *, wrote: bool) -> int:
        seen.append(outcome)
        return outcome.exit_status

    monkeypatch.setattr("abu_calc.cli.command.deliver", deliver)
    assert again(*arguments).err == ""
    (outcome,) = seen
    return outcome


def _ids(outcome: Outcome) -> list[str]:
    return [block.id for block in outcome.blocks if isinstance(block, Heading) and block.id]


@pytest.mark.few(1)
@pytest.mark.parametrize(
    "name",
    [
        *(name for name in REPORTS if name not in COMMANDS),
        *(page for page in PAGES if "sweep-many" not in getattr(page, "values", ())),
        pytest.param("sweep-many", marks=pytest.mark.hard),  # once more, and "sweep" has the same headings
    ],
)
@pytest.mark.slow
def test_each_figure_of_a_report_has_the_id_of_one_heading(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    outcome = _outcome(monkeypatch, *REPORTS[name])
    ids = _ids(outcome)
    figures = outcome.extras().figures if outcome.extras else ()
    assert len(ids) == len(set(ids)) and "provenance" in ids
    assert [(figure.name, figure.section) for figure in figures if figure.section not in {"", SUMMARY, *ids}] == []
    last = {figure.name for figure in figures if not figure.section}
    assert last <= AT_THE_END.get(outcome.command, set())
    assert figures or name == "compare-seats"


@pytest.mark.slow
def test_sections_that_screens_leave_out_are_in_reports(monkeypatch: pytest.MonkeyPatch) -> None:
    stiffness, works = "grinding.contact_stiffness_N_per_m", ("grinding", "avtovaz-707-222", "--set")
    grinding = {one for value in ("2e4", "5e6") for one in _ids(_outcome(monkeypatch, *works, f"{stiffness}={value}"))}
    stability = {one for name in ("arm", "tongue") for one in _ids(_outcome(monkeypatch, *REPORTS[name]))}
    sized = {*_ids(_outcome(monkeypatch, *REPORTS["size-avtovaz-707-222"]))}
    assert {*GRINDING_LEFT_OUT} <= grinding
    assert {*LEFT_OUT, *FOR_THE_ARM} <= stability
    assert sized >= ELSEWHERE >= LAST


@pytest.mark.parametrize("title", ["Levels", "Conventions", "Provenance", "others", ""])
def test_sections_are_found_by_their_ids_whatever_their_titles_say(title: str) -> None:
    """A figure below the heading of its id; conventions behind figures without one; the source of the result last."""
    chart = Bars("A", "told", Axis("x [dB]", 0.0, 1.0), [Bar("a", 1.0, "1")])
    blocks: tuple[Block, ...] = (
        Heading("Report"), Paragraph("in the head"),
        Heading(title, "provenance"), Paragraph("in the source"),
        Heading(title, "conventions"), Paragraph("in the conventions"),
        Heading("levels", "others"), Paragraph("in the others"),
        Heading(title, "levels"), Paragraph("in the levels"),
        Heading("Provenance"), Paragraph("in the last"),
    )  # fmt: skip
    figures = Figure("one", "levels", chart, "of the levels"), Figure("two", "", chart, "of no section")
    text = page_of(Outcome("test", {}, blocks, extras=lambda: Extras(figures)))
    parts = [
        re.findall(r"\b(?:in the|of the|of no) \w+", part) for part in text.partition("<main")[2].split("<section")
    ]
    words = [list(dict.fromkeys(part)) for part in parts if part]
    assert words == [
        ["in the others"], ["of the levels", "in the levels"], ["in the last"], ["of no section"],
        ["in the conventions"], ["in the source"],
    ]  # fmt: skip


HOSTILE = "</title></pre><script>alert(1)</script>&\"'<b>\x1b[31m\u202e"


@pytest.mark.slow
def test_nothing_in_a_name_acts(tmp_path: Path) -> None:
    target = tmp_path / "fit.html"
    seen = abu("check-fit", "mmg-3200k-knife-shaft", "--set", f"machine.name={json.dumps(HOSTILE)}", "-o", str(target))
    assert seen.status == 1, seen.err
    text = target.read_text(encoding="utf-8")
    page = read(text)
    assert page.faults == []
    assert "alert(1)" in text
    assert not {tag for tag, _ in page.tags} & {"script", "b"}
    assert not set("\x1b\u202e") & set(text)


@pytest.mark.slow
def test_options_of_a_command_stand_on_its_page(tmp_path: Path) -> None:
    target = tmp_path / "my page.html"
    asked = ("stability", "avtovaz-707-222", "--speeds", "1000:6000", "--crossings")
    assert abu(*asked, "-o", str(target), "--quiet", "--no-color").status in (0, 1)
    command, (_, file), *options = _settings(target.read_text("utf-8"))
    assert (command, file, options) == (
        ("command", "stability"), "avtovaz-707-222", [("speeds", "1000:6000"), ("crossings", "yes")],
    )  # fmt: skip


@pytest.mark.parametrize(("low", "high"), [(0.0, 23.2), (98.0, 111.0), (-3e-7, 5e-7), (1.0, 1e6), (0.0, 1.0)])
def test_ticks_are_round_within_the_axis_and_evenly_spaced(low: float, high: float) -> None:
    ticks = Axis("x [mm]", low, high).ticks
    steps = {round((after - before) / (high - low), 9) for before, after in pairwise(ticks)}
    assert 3 <= len(ticks) <= 12
    assert len(steps) == 1
    assert low - 1e-9 * (high - low) <= ticks[0] <= ticks[-1] <= high * (1 + 1e-9)


def _luminance(colour: str) -> float:
    def part(value: float) -> float:
        return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4

    digits = colour if len(colour) == 6 else "".join(2 * one for one in colour)
    red, green, blue = (part(int(digits[k : k + 2], 16) / 255) for k in (0, 2, 4))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def test_colours_have_the_contrast_that_wcag_asks_for() -> None:
    """4.5 for text, 3 for what figures draw (WCAG 2.2, 1.4.3 and 1.4.11), in every theme."""
    css = (Path(__file__).parents[3] / "abu_calc/reporting/page/page.css").read_text("utf-8")
    themes = [
        dict(re.findall(r"--([\w]+): #([0-9a-f]{3,6})\b", block))
        for block in re.findall(r":root \{(.*?)\}", css, re.DOTALL)
    ]
    assert len(themes) == 3
    for theme in themes:
        colours = themes[0] | theme
        for name, wanted in {"ink": 7, "soft": 4.5, "link": 4.5, "pass": 4.5, "warn": 4.5, "fail": 4.5, "undone": 4.5,
                             "c1": 3, "c2": 3, "c3": 3, "c4": 3}.items():  # fmt: skip
            for ground in ("paper", "shade"):
                light, dark = sorted((_luminance(colours[name]), _luminance(colours[ground])), reverse=True)
                assert (light + 0.05) / (dark + 0.05) >= wanted, (name, ground, colours[name])


def test_headings_that_are_indented_stand_one_level_deeper() -> None:
    page = read("".join(elements([Heading("Balls"), Heading("  Capacity")], "", 2)))
    assert [tag for tag, _ in page.tags] == ["h2", "h3"] and page.faults == []
    assert [words for _, words in page.texts] == ["Balls", "Capacity"]


def test_a_mark_is_a_class_and_commands_are_code() -> None:
    assert paragraph("Run `abu size`.", "warn") == '<p class="warn">Run <code>abu size</code>.</p>'
    assert paragraph("words", "unknown mark") == "<p>words</p>"
    assert list(elements([Paragraph("")], "")) == []


def test_a_number_is_tied_to_its_unit() -> None:
    assert paragraph("settled in 0.14 s") == "<p>settled in 0.14\u00a0s</p>"


def test_tables_are_called_by_the_heading_above_them() -> None:
    grid = Grid(("check", "value"), (("capacity", "1080"), ("mass", "FAIL")), frozenset({1}))
    page = read("".join(elements([Heading("Checks"), grid], "")))
    assert page.faults == []
    (region,) = (attributes for tag, attributes in page.tags if tag == "div")
    assert region["aria-label"] == "Checks"
    classes = [attributes.get("class") for tag, attributes in page.tags if tag == "td"]
    assert classes == [None, "number", None, "fail"]


def test_facts_without_rows_are_nothing() -> None:
    assert "".join(elements([Facts(())], "Title")) == ""
    page = read("".join(elements([Facts((("mass", "m", "240 g"),))], "Title")))
    assert page.cells == ["mass", "m", "240\u00a0g"]


def test_a_picture_has_its_caption_as_alternative() -> None:
    page = read("".join(elements([Picture(("/\\", "##"), "zones <x>")], "")))
    assert page.faults == [] and ("pre", "/\\\n##") in page.texts
    assert next(attributes["aria-label"] for tag, attributes in page.tags if tag == "pre") == "zones <x>"


def test_a_chart_stands_in_its_figure_with_caption() -> None:
    chart = Bars("Masses", "a 240 g", Axis("mass [g]", 0, 300), [Bar("a", 240.0, "240 g")])
    page = read(figure(Figure("mass", "", chart, "What each adds.")))
    assert page.faults == [] and ("figcaption", "What each adds.") in page.texts
    assert page.tags[0] == ("figure", {"style": "max-width:520px"})


def test_a_drawing_is_as_wide_as_on_paper() -> None:
    drawing = Drawing("a", "A", "told", 2.0, (0.0, 0.0), (50.0, 30.0), (Line("outline", (0.0, 0.0), (50.0, 30.0)),))
    style = read(figure(Figure("a", "", drawing, "Caption."))).tags[0][1]["style"]
    assert style == f"max-width:{PIXELS * 100:.0f}px"
    assert pytest.approx(96 / 25.4, abs=5e-3) == PIXELS  # a pixel of CSS is 1/96 inch
