"""Texts about a step's formulas, a check's question, an effect, a key or a table of a machine file."""

from collections.abc import Sequence
from typing import Final

from abu_calc.features.explain.keys import FileKey, keys_with, machine_keys
from abu_calc.features.explain.pictures import PICTURES
from abu_calc.features.explain.steps import STEPS, code_blocks, step_blocks
from abu_calc.foundation.checks import CHECK_CODES, CONDITIONS
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.formula import formula_of
from abu_calc.inputs.reading.suggestions import nearest
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, Picture
from abu_calc.reporting.outcome import Outcome
from abu_calc.reporting.screen import BLANK

CODE_SIGNS: Final = str.maketrans("OILАВО", "011AB0")
"""Signs that are easily taken for those of a code: O for 0, I and l for 1, Cyrillic letters."""


def explain(step: str | None = None) -> Outcome:
    """Text about a step, a check, an effect, or a key or table of a machine file; a list of them without a name."""
    if step is None:
        return _listed()
    if step in STEPS:
        return _step(step)
    if (code := step.upper().translate(CODE_SIGNS)) in CHECK_CODES:
        return _code(code)
    from abu_calc.dynamics.effects.registry import REGISTRY  # loads NumPy

    effects = dict(REGISTRY)
    if step in effects:
        return _effect(step, effects[step].kind, effects[step].about, effects[step].detail)
    if keys := machine_keys(step):
        return _keys(keys)
    near = " or ".join(keys_with(step)) or nearest(step, (*STEPS, *CHECK_CODES, *effects))
    allowed = (
        ", ".join(STEPS) + ", the code of a check, such as ABU201, an effect, such as ball_contact, or a key of a "
        "machine file, such as rolling_drag_per_s"
    )
    raise InputError(
        "no such step, check, effect or key",
        found=step,
        allowed=allowed,
        remedy=f"Did you mean {near}?" if near else None,
    )


def _listed() -> Outcome:
    steps = tuple((name, each.title, ", ".join(entry.name for entry in each.formulas)) for name, each in STEPS.items())
    blocks = (
        Heading("Steps of `abu size`"),
        Grid(("step", "what", "formulas"), steps),
        Heading("Checks"),
        Grid(("code", "check", "step"), tuple((check.code, check.name, check.step) for check in CHECK_CODES.values())),
        Paragraph(
            "`abu explain STEP` and `abu explain CODE` show them, `abu explain EFFECT` one of `abu effects`. `abu size "
            "MACHINE --explain` puts the numbers in."
        ),
    )
    codes: dict[str, list[str]] = {}
    for check in CHECK_CODES.values():
        codes.setdefault(check.step or "other checks", []).append(check.code)
    titles = {name: each.title for name, each in STEPS.items()}
    short = (
        Heading("Steps and their checks"),
        Grid(
            ("step", "what", "checks"),
            tuple((name, titles.get(name, ""), " ".join(codes.get(name, ()))) for name in (*STEPS, "other checks")),
        ),
        BLANK,
        Paragraph(
            "`abu explain capacity` shows the formulas of a step, `abu explain ABU201` the question, the grades and "
            "the action of a check. `abu explain ball_contact` describes an effect, and `abu effects` lists them."
        ),
        Paragraph("More: --full, the names of all formulas and checks; `abu size MACHINE --explain`, with numbers."),
    )
    result = {
        "steps": {name: each.title for name, each in STEPS.items()},
        "checks": {code: check.name for code, check in CHECK_CODES.items()},
    }
    return Outcome("explain", result, blocks, short=lambda: short)


def _step(name: str) -> Outcome:
    step = STEPS[name]
    texts = {formula.name: "\n".join(formula.for_users) for formula in step.formulas}
    return Outcome("explain", {"step": name, "formulas": texts}, tuple(step_blocks(step)))


def _effect(name: str, kind: str, about: str, detail: str) -> Outcome:
    texts = (f"{about}.", detail) if detail else (f"{about}.",)
    blocks: list[Block] = [Heading(f"{name}: {kind}"), *(Paragraph(text) for text in texts)]
    return Outcome("explain", {"effect": name, "kind": kind, "about": about, "detail": detail}, tuple(blocks))


def _keys(keys: Sequence[FileKey]) -> Outcome:
    blocks: list[Block] = []
    for key in keys:
        blocks += [Heading(f"{key.header} {key.name}"), Paragraph(key.meaning or "A table of its own.")]
    drawn, words = next((PICTURES[key.path] for key in keys if key.path in PICTURES), ((), ""))
    for lines in drawn:
        blocks += [Paragraph(""), Picture(lines, "", indent=2)]
    if drawn:
        blocks += [Paragraph(""), Paragraph(words)]
    return Outcome("explain", {"keys": {key.path: key.meaning for key in keys}}, tuple(blocks))


def _code(code: str) -> Outcome:
    check = CHECK_CODES[code]
    result = {
        "check": check.code,
        "name": check.name,
        "asks": check.question,
        "fails": check.fail_if,
        "remedy": check.action,
        "question": check.question,
        **{grade: getattr(check, f"{grade}_if") or None for grade in CONDITIONS},
        "action": check.action,
        "step": check.step or None,
        "formulas": {each.name: "\n".join(each.for_users) for each in map(formula_of, check.formulas)},
    }
    return Outcome("explain", result, tuple(code_blocks(check)))
