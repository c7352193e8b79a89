"""Blocks that several reports share: facts of a record, checks, defaults, warnings, where a result comes from."""

from collections.abc import Iterable, Iterator, Sequence

from abu_calc.checks import Check
from abu_calc.report.blocks import Block, Facts, Grid, Heading, Paragraph
from abu_calc.report.numbers import number, shown
from abu_calc.spec.text import key_path
from abu_calc.spec.text import shown as exact
from abu_calc.studies.quantity import Record, quantities
from abu_calc.studies.result import Provenance, Result

BOUND = {"most": "at most", "least": "at least"}


def of_scene(scene: str) -> str:
    """Which scene of a machine; a scene file holds but one."""
    return "" if scene == "scene" else f" of the scene {scene}"


def facts(record: Record, *names: str) -> Facts:
    """Rows for fields of a record, those without a value left out; without names all that say what they are."""
    labels = quantities(type(record))
    rows = []
    for name in names or labels:
        value = getattr(record, name)
        if value is not None:
            rows.append((labels[name].label, labels[name].symbol, shown(type(record), name, value)))
    return Facts(tuple(rows))


def value_of(record: Record, name: str) -> str:
    """One field of a record with its unit, as text."""
    return shown(type(record), name, getattr(record, name))


def check_blocks(checks: Sequence[Check]) -> list[Block]:
    """All checks as a table; what failed or was not done with its reason and remedy below."""
    rows = tuple((check.status, check.code, check.name, _value(check), _limit(check)) for check in checks)
    blocks: list[Block] = [Heading("Checks"), Grid(("", "code", "check", "value", "limit"), rows, frozenset({3}))]
    for check in checks:
        if check.status != "pass":
            remedy = f" {check.remedy}" if check.remedy else ""
            blocks.append(Paragraph(f"{check.code} {check.name}: {check.message}.{remedy}", check.status))
    return blocks


def notices(result: Result) -> list[Block]:
    """Warnings, each a paragraph; defaults that were in force."""
    return [*warning_blocks(result.warnings), *default_blocks(result.provenance.defaults)]


def warning_blocks(warnings: Iterable[str]) -> list[Block]:
    """Warnings, each a paragraph."""
    lines: list[Block] = [Paragraph(f"! {warning}") for warning in warnings]
    return [Heading("Warnings"), *lines] if lines else []


def default_blocks(defaults: Iterable[tuple[str, object]]) -> list[Block]:
    """The defaults that were in force."""
    cells = [f"{path} = {written(value)}" for path, value in defaults]
    if not cells:
        return []
    return [Heading("Defaults used (not in the file)"), *(Paragraph(cell) for cell in cells)]


def provenance_blocks(provenance: Provenance) -> list[Block]:
    """What is needed to repeat a result: version, date, file and its hash, entries replaced."""
    text = f"abu-calc {provenance.version}, {provenance.date}"
    if provenance.file is not None:
        text += f"; {provenance.file}, SHA-256 {(provenance.sha256 or '')[:16]}…"
    blocks: list[Block] = [Heading("Provenance"), Paragraph(text)]
    entries = [entry for key, value in provenance.overrides for entry in _entries(key, value)]
    if entries:
        blocks += [Paragraph("With these entries replaced:"), *(Paragraph(entry, indent=4) for entry in entries)]
    return blocks


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


def _value(check: Check) -> str:
    return "" if check.value is None else f"{number(check.value)} {check.unit or ''}".rstrip()


def _limit(check: Check) -> str:
    return "" if check.limit is None else f"{BOUND[check.bound]} {number(check.limit)}"
