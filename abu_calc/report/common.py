"""Blocks that several commands share: verdict, checks, facts of a result, defaults, warnings."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from abu_calc.checks import Check
from abu_calc.report.blocks import Block, Facts, Grid, Heading, Paragraph
from abu_calc.report.quantities import QUANTITIES, Quantity, number, shown

BOUND = {"most": "at most", "least": "at least"}


def of_scene(scene: str) -> str:
    """Which scene of a machine; a scene file holds but one."""
    return "" if scene == "scene" else f" of the scene {scene}"


def facts(result: Mapping[str, Any], *keys: str) -> Facts:
    """Rows for keys of a result, labelled by the table of quantities; keys without a value are left out."""
    rows = []
    for key in keys:
        if result.get(key) is None:
            continue
        quantity = QUANTITIES.get(key, Quantity(key))
        rows.append((quantity.label, quantity.symbol, shown(key, result[key])))
    return Facts(tuple(rows))


def check_blocks(checks: Sequence[Check]) -> list[Block]:
    """All checks as a table; what failed or was not done with its reason and remedy below."""
    rows = tuple((check.status, check.code, check.name, _value(check), _limit(check)) for check in checks)
    blocks: list[Block] = [Heading("Checks"), Grid(("", "code", "check", "value", "limit"), rows, frozenset({3}))]
    for check in checks:
        if check.status != "pass":
            remedy = f" {check.remedy}" if check.remedy else ""
            blocks.append(Paragraph(f"{check.code} {check.name}: {check.message}.{remedy}", check.status))
    return blocks


def warning_blocks(warnings: Iterable[str]) -> list[Block]:
    """Warnings, each a paragraph."""
    told: list[Block] = [Paragraph(f"! {warning}") for warning in warnings]
    return [Heading("Warnings"), *told] if told else []


def default_blocks(defaults: Iterable[tuple[str, object]]) -> list[Block]:
    """The defaults that were in force, two to a line where they fit."""
    cells = [f"{path} = {_written(value)}" for path, value in defaults]
    if not cells:
        return []
    return [Heading("Defaults used (not in the file)"), *(Paragraph(cell) for cell in cells)]


def _written(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(_written, value))}]"
    return f"{value:g}" if isinstance(value, float) else f"{value}"


def _value(check: Check) -> str:
    return "" if check.value is None else f"{number(check.value)} {check.unit or ''}".rstrip()


def _limit(check: Check) -> str:
    return "" if check.limit is None else f"{BOUND[check.bound]} {number(check.limit)}"
