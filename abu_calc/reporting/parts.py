"""Blocks that several reports share: facts of a record, checks, defaults, warnings, provenance, levels.

Levels stand as instruments show them, and measured ones beside predicted ones.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Final

from abu_calc.foundation.checks import RANK, Check, Grade
from abu_calc.foundation.errors import shell_word
from abu_calc.foundation.quantity import Record, quantities
from abu_calc.inputs.reading.text import key_path
from abu_calc.inputs.reading.text import shown as exact
from abu_calc.reporting.blocks import (
    Block,
    Facts,
    Grid,
    Heading,
    Paragraph,
    level_text,
    number,
    or_dash,
    shown,
    with_unit,
)
from abu_calc.simulation.result import Provenance, Result

if TYPE_CHECKING:  # the seats of bearings are reported without a design
    from abu_calc.simulation.vibration_records import MeasuredAfterRecord
    from abu_calc.sizing.imbalance import InstrumentReadings

NOISE: Final = 1e-9
"""Values below which no digits are printed beside a limit of zero."""
BOUND: Final = {"most": "at most", "least": "at least"}
WORD: Final[dict[Grade, str]] = {"pass": "pass", "warn": "WARN", "fail": "FAIL", "not-done": "NOT EVALUATED"}
"""Word before a check of each grade: no grade is shown by its colour alone."""

MARGIN: Final = 2
DIGITS: Final = range(4, 9)
"""Numbers of significant digits for a value and its limit."""
MOST_ALIKE: Final = 3
"""Checks that are named with the reason they share; the table of checks has all."""


def of_scene(scene: str) -> str:
    """Scene of a machine, as words; empty for a scene file, which holds but one."""
    return "" if scene == "scene" else f" of the scene {scene}"


def file_of(result: Result) -> str:
    """File or preset of a result as a command line names it; FILE if there is none."""
    return shell_word(result.provenance.file) if result.provenance.file else "FILE"


def facts(record: Record, *names: str) -> Facts:
    """Rows for fields of a record, those without a value or an uncertainty left out; without names all of them."""
    labels = quantities(type(record))
    rows = []
    for name in names or labels:
        value = getattr(record, name)
        if value is not None and value != () and not (labels[name].symbol == "±" and not value):
            rows.append((labels[name].label, labels[name].symbol, shown(type(record), name, value)))
    return Facts(tuple(rows))


def value_of(record: Record, name: str) -> str:
    """One field of a record with its unit, as text."""
    return shown(type(record), name, getattr(record, name))


def check_blocks(checks: Sequence[Check], *, with_reasons: bool = True) -> list[Block]:
    """All checks as a table; `with_reasons`: those that did not simply pass with reasons and remedies below."""
    rows = tuple((WORD[check.status], check.code, check.name, _value(check), limit_of(check)) for check in checks)
    table = Grid(("", "code", "check", "value", "limit"), rows, frozenset({3}))
    below = [*reasons(checks), *not_requested(checks)] if with_reasons else []
    return [Heading("Checks", "checks"), table, *below]


def reasons(checks: Iterable[Check]) -> list[Paragraph]:
    """Checks that did not simply pass, the worst first, each with its grade, reason and remedy; alike ones together."""
    return told(unlike(checks))


def told(groups: Sequence[Sequence[Check]]) -> list[Paragraph]:
    """Each group with its grade, reason and action, and below it the entries of its action.

    Entries that stand above are not repeated.
    """
    lines, printed = list[Paragraph](), set[tuple[str, ...]]()
    for alike, line in zip(groups, without_entries(groups), strict=True):
        lines.append(line)
        if alike[0].overrides not in printed:
            lines += paste_lines(alike[0].overrides)
            printed.add(alike[0].overrides)
    return lines


def without_entries(groups: Sequence[Sequence[Check]]) -> list[Paragraph]:
    """Each group with its grade, reason and action; an action that stands above is referred to."""
    lines, code_of, said = list[Paragraph](), dict[str, str](), SaidSentences()
    for alike in groups:
        action, code = alike[0].remedy or "", alike[0].code
        first = code_of.setdefault(action, code)
        if action and first != code:
            lines.append(_reason(alike, f"See the action of {first}."))
        else:
            lines.append(_reason(alike, said.unsaid(action, alike[0].overrides)))
    return lines


_NEXT_SENTENCE: Final = re.compile(r"(?<=[.!?]) (?=[A-Z])")


class SaidSentences:
    """Sentences of the actions that stand on a screen, by their entries: another action with them repeats none, and not
    the change.
    """

    def __init__(self) -> None:
        self._said = dict[tuple[str, ...], list[str]]()

    def unsaid(self, action: str, entries: tuple[str, ...]) -> str:
        """The action without the sentences that an action with the same entries has said."""
        if not entries:
            return action
        said = self._said.setdefault(entries, [])
        new = [sentence for sentence in _NEXT_SENTENCE.split(action) if sentence not in said]
        change = f"{said[0].partition(': ')[0]}: " if said else None
        said += new
        return " ".join(new) if change is None else " ".join(new).replace(change, "The same change: ", 1)


def paste_lines(overrides: Sequence[str]) -> list[Paragraph]:
    """Entries as options of a command line, on one line that every shell takes, however long it is."""
    options = " ".join(f"--set {shell_word(entry)}" for entry in overrides)
    return [Paragraph(options, indent=4, whole=True)] if options else []


def unlike(checks: Iterable[Check]) -> list[list[Check]]:
    """Checks that did not simply pass, the worst first; those of one grade, reason and remedy together.

    Checks that nobody requested are left to `not_requested`.
    """
    groups: dict[tuple[str, ...], list[Check]] = {}
    judged = (item for item in checks if item.status != "pass" and item.requested)
    for check in sorted(judged, key=lambda item: RANK.index(item.status)):
        groups.setdefault((check.status, check.message, check.remedy or ""), []).append(check)
    return list(groups.values())


def not_requested(checks: Iterable[Check]) -> list[Paragraph]:
    """A line on the checks that optional data would allow, with what each wants; empty if there are none."""
    wanted: dict[str, list[str]] = {}
    for check in checks:
        if not check.requested:
            wanted.setdefault((check.remedy or "").removesuffix("."), []).append(check.code)
    if not wanted:
        return []
    texts = (
        f"{', '.join(dict.fromkeys(codes))} ({action[:1].lower()}{action[1:]})" for action, codes in wanted.items()
    )
    return [Paragraph(f"Not evaluated for lack of optional data: {'; '.join(texts)}.", hang=MARGIN)]


def _reason(alike: Sequence[Check], action: str) -> Paragraph:
    """Checks of one grade, one reason and one action."""
    first, more = alike[0], len(alike) - MOST_ALIKE
    names = ", ".join(f"{check.code} {check.name}{value_and_limit(check)}" for check in alike[:MOST_ALIKE])
    others = f" and {more} more" if more > 0 else ""
    action = f" Action: {action}" if action else ""
    return Paragraph(f"{WORD[first.status]} {names}{others}: {first.message}.{action}", first.status, hang=MARGIN)


def value_and_limit(check: Check) -> str:
    """The value beside its limit."""
    parts = [part for part in (_value(check), limit_of(check)) if part and check.value is not None]
    return f" ({', '.join(parts)})" if parts else ""


def notices(result: Result) -> list[Block]:
    """Warnings, each a paragraph; defaults that were in force."""
    return [*warning_blocks(result.warnings), *default_blocks(result.provenance.defaults)]


def warning_blocks(warnings: Iterable[str]) -> list[Block]:
    """Warnings, each a paragraph."""
    lines = warning_lines(warnings)
    return [Heading("Notes", "warnings"), *lines] if lines else []


def warning_lines(warnings: Iterable[str]) -> list[Paragraph]:
    """Each with its mark."""
    return [Paragraph(f"! {warning}", hang=MARGIN) for warning in warnings]


def default_blocks(defaults: Iterable[tuple[str, object]]) -> list[Block]:
    """The defaults that were in force."""
    cells = [f"{path} = {written(value)}" for path, value in defaults]
    if not cells:
        return []
    return [Heading("Defaults used (not in the file)", "defaults"), *(Paragraph(cell) for cell in cells)]


def provenance_blocks(provenance: Provenance) -> list[Block]:
    """Data needed to repeat a result: version, date, file and its hash, replaced entries."""
    text = f"abu-calc {provenance.version}, {provenance.date}"
    if provenance.file is not None:
        text += f"; {provenance.file}, SHA-256 {(provenance.sha256 or '')[:16]}…"
    blocks: list[Block] = [Heading("Provenance", "provenance"), Paragraph(text)]
    entries = replaced_entries(provenance)
    if entries:
        blocks += [Paragraph("With these entries replaced:"), *(Paragraph(entry, indent=4) for entry in entries)]
    if provenance.converted:
        values = [f"{entry}: {key} = {written(value)}" for key, entry, value in provenance.converted]
        blocks += [Paragraph("Values written with a unit:"), *(Paragraph(value, indent=4) for value in values)]
    return blocks


def contents(blocks: Iterable[Block]) -> list[Block]:
    """Headings of a whole report, at its head."""
    named = " · ".join(block.text for block in blocks if isinstance(block, Heading))
    return [Heading("Contents", "contents"), Paragraph(named)]


def options_of(provenance: Provenance) -> str:
    """The replaced entries of a result as options of a command, each after a space."""
    return "".join(f" --set {shell_word(entry.replace(' = ', '=', 1))}" for entry in replaced_entries(provenance))


def next_command(start: str, provenance: Provenance, entries: Sequence[str], *options: str) -> str:
    """A whole command on the file of a result: with the entries it replaced, then further options, then `entries`.

    `start`: its first words. An entry takes the place of a replaced one with its key.
    """
    changed = {entry.partition("=")[0] for entry in entries}
    given = (entry.replace(" = ", "=", 1) for entry in replaced_entries(provenance))
    kept = (entry for entry in given if entry.partition("=")[0] not in changed)
    before, after = ([f"--set {shell_word(entry)}" for entry in each] for each in (kept, entries))
    return " ".join([start, shell_word(provenance.file or "FILE"), *before, *options, *after])


def replaced_entries(provenance: Provenance) -> list[str]:
    """The replaced entries of a result as a file would have them."""
    return [entry for key, value in provenance.overrides for entry in _entries(key, value)]


def _entries(path: str, value: object) -> Iterator[str]:
    """An entry that was replaced as a file would have it, exactly; of a table each key on a line of its own."""
    if isinstance(value, dict) and value:
        for key, inner in value.items():
            yield from _entries(f"{path}.{key_path((key,))}", inner)
    elif isinstance(value, (list, tuple)) and any(isinstance(inner, dict) for inner in value):
        for index, inner in enumerate(value):
            yield from _entries(f"{path}[{index}]", inner)
    else:
        yield f"{path} = {'{}' if value == {} else exact(value)}"


def written(value: object) -> str:
    """A value as a file would have it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(written, value))}]"
    return f"{value:g}" if isinstance(value, float) else f"{value}"


COUNTED: Final = "start cases"
"""Unit of values that are counts."""


def _value(check: Check) -> str:
    if check.value is None:
        return ""
    if check.unit == COUNTED:
        return f"{check.value:g} {COUNTED}"
    if check.unit == "dB":
        return level_text(check.value, _digits(check))
    if check.limit == 0 and 0 < check.value < NOISE:
        return f"< {NOISE:g} {check.unit or ''}".rstrip()
    return with_unit(check.value, check.unit or "", _digits(check))


def limit_of(check: Check) -> str:
    """The most or the least that is permitted, in words."""
    return "" if check.limit is None else f"{BOUND[check.bound]} {number(check.limit, _digits(check))}"


def _digits(check: Check) -> int:
    """Number of digits with which a value beyond its limit is not shown as that limit."""
    value, limit = check.value, check.limit
    if value is None or limit is None:
        return DIGITS[0]
    return next((digits for digits in DIGITS if number(value, digits) != number(limit, digits)), DIGITS[0])


def limit_in_file(check: Check | None) -> str:
    """A limit that a file gives, as it gives it, with its unit; nothing without one."""
    return (
        ""
        if check is None or check.limit is None
        else f"{BOUND[check.bound]} {check.limit:g} {check.unit or ''}".strip()
    )


def readings_grid(rows: Sequence[tuple[str, "InstrumentReadings"]]) -> Grid:
    """Places and states against what instruments show of them."""
    header = ("", "mm/s", "µm", "m/s²", "a_h W_h", "a_hv W_h")
    cells = tuple(
        (name, *map(or_dash, (reading.velocity_mm_per_s, reading.displacement_um, reading.acceleration_m_per_s2,
                             reading.weighted_m_per_s2, reading.total_m_per_s2)))
        for name, reading in rows
    )  # fmt: skip
    return Grid(header, cells, frozenset(range(1, 6)))


def measured_after_line(comparison: "MeasuredAfterRecord") -> str:
    """Measured, predicted, the difference in words."""
    measured = f"Measured with the autobalancer, idle, {comparison.place}: {comparison.measured}"
    if comparison.unit != "dB":
        measured += f", that is {comparison.measured_level_db:.1f} dB"
    others = [
        f"{name}: {level:.1f} dB."
        for name, level in (("This run", comparison.this_run_db), ("Under load", comparison.predicted_loaded_db))
        if level is not None
    ]
    if comparison.predicted_level_db is None or comparison.difference_db is None:
        return " ".join([f"{measured}. No idle level is predicted.", *others])
    predicted = f"{comparison.predicted_level_db:.1f} dB"
    if comparison.unit != "dB" and comparison.predicted_value is not None:
        predicted += f" ({number(comparison.predicted_value, 3)} {comparison.unit} on that instrument)"
    word = "above" if comparison.difference_db >= 0 else "below"
    distance = f"The measurement is {abs(comparison.difference_db):.1f} dB {word} it."
    return " ".join([f"{measured}. Predicted, median of the start cases: {predicted}. {distance}", *others])


def measured_after_blocks(comparison: "MeasuredAfterRecord | None") -> list[Block]:
    """A line, where something was measured."""
    return [] if comparison is None else [Paragraph(measured_after_line(comparison))]


def shown_blocks(rows: Sequence[tuple[str, "InstrumentReadings"]]) -> list[Block]:
    """The table with its heading, where there is a level."""
    return [Heading("As instruments show it, rms"), readings_grid(rows)] if rows else []
