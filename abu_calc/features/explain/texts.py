"""Texts about a step's formulas, a check's question, an effect, a key or a table of a machine file.

Pictures in characters of what a key's coordinates mean: axes, handles, signs, the place of the autobalancer.

Keys of machine files with their meaning, read from the schema of the file.
"""

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final, NamedTuple

from abu_calc.features.explain.steps import STEPS, code_blocks, step_blocks
from abu_calc.foundation.checks import CHECK_CODES, CONDITIONS
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.formula import formula_of
from abu_calc.inputs.reading.suggestions import nearest
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, Picture
from abu_calc.reporting.outcome import Outcome
from abu_calc.reporting.screen import BLANK

STRAIGHT: Final = (
    "straight: the spindle runs along the body",
    "",
    " rear handle         body         front handle    ABU  wheel",
    "   ______________________________________________  _   _",
    "  |                     +                        || |=| |   --> z",
    "  |______________________________________________||_| |_|",
    "   z < 0                                  z > 0",
)
ANGLE: Final = (
    "angle: the spindle runs across the body, seen from the side, the wheel below",
    "",
    " rear handle          body                 gear head",
    "   ______________________________________ ________",
    "  |                      +               |        |   --> x",
    "  |______________________________________|________|",
    "   x < 0                                     ||       |",
    "                                           [ABU]      v z",
    "                                         ====||====",
    "                                            wheel",
    " y points at you. A side handle at the head: x > 0; y > 0 right, y < 0 left",
    " of who holds the rear handle.",
)
FACE: Final = (
    "face: the machine stands above its wheel, whose face works",
    "",
    "                     ________",
    "  left handle ------|        |------ right handle   --> x",
    "    x < 0           |   +    |          x > 0",
    "                    |________|       |",
    "                        ||           v z",
    "                       [ABU]",
    "                 ========||========",
    "                       wheel",
)
ORIGIN: Final = (
    "+ is the centre of mass. Handles are counted from it. z runs along the spindle toward the wheel, x from the body "
    "toward the spindle, y so that x, y, z are right-handed. A side handle 85 mm in front of +, 120 mm to the left and "
    "10 mm above it, wheel below: position_mm = [85, -120, -10]. center_of_mass_from_wheel_mm, in [machine], has the "
    "same axes and counts from the wheel's centre to +: [-90, 0, -45] is 90 mm behind the spindle and 45 mm above the "
    "wheel."
)
CHAIN: Final = (
    "from the axis of rotation to the middle of the race, each part at its worst",
    "",
    "  axis of rotation                                  middle of the race",
    "  |-- spindle --|------ fit ------|-- housing --|------ race ------|",
    "   half the TIR   half the largest   imbalance    half the TIR",
    "   of its seat    clearance in the   without      of race to bore",
    "                  bore               balls",
    "  |<----------------- race_eccentricity_mm ----------------------->|",
)
BODY: Final = (STRAIGHT, ANGLE, FACE)
PICTURES: Final = dict.fromkeys(
    (
        "machine.handle.position_mm",
        "machine.handle.from_center_of_mass_mm",
        "machine.center_of_mass_from_wheel_mm",
        "machine.layout",
    ),
    (BODY, ORIGIN),
) | {
    "autobalancer.race_eccentricity_mm": (
        (CHAIN,),
        "`abu size` says what each part may be, and the drawing asks for it.",
    )
}
"""Pictures of the keys that need one."""


_DEFINITION: Final = re.compile(r"#/definitions/(\w+)")


class FileKey(NamedTuple):
    """A key of a file: the header of its table as TOML writes it, its name, its meaning with unit and range."""

    header: str
    name: str
    meaning: str

    @property
    def path(self) -> str:
        """Table and key with a point between, as `--set` takes them; "" stands for no table."""
        return f"{self.header.strip('[]')}.{self.name}".strip(".")


def file_tables(schema: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Tables of a schema in the order of a file, with their headers as TOML writes them."""
    entries = schema.get("anyOf") or schema["allOf"]
    seen = set[str]()

    def below(name: str, header: str) -> Iterator[tuple[str, Mapping[str, Any]]]:
        table = schema["definitions"][name]
        if header and header not in seen:
            seen.add(header)
            yield header, table
        for key, entry in table["properties"].items():
            if inner := definition_of(entry):
                path = f"{header.strip('[]')}.{key}".strip(".")
                yield from below(inner, f"[[{path}]]" if '"array"' in json.dumps(entry) else f"[{path}]")

    for entry in entries:
        yield from below(entry["$ref"].rsplit("/", 1)[1], "")


def definition_of(entry: Mapping[str, Any]) -> str | None:
    """Name of the definition to which an entry of a schema refers; None: to none."""
    reference = _DEFINITION.search(json.dumps(entry))
    return reference[1] if reference else None


def meaning(entry: Mapping[str, Any], schema: Mapping[str, Any]) -> str:
    """Description of an entry, or of the table that it holds, with the values that it may have."""
    text: str = entry.get("description", "")
    if not text and (inner := definition_of(entry)):
        text = schema["definitions"][inner].get("description", "")
    if "enum" in entry and not all(str(value) in text for value in entry["enum"]):
        text += " One of: " + ", ".join(map(str, entry["enum"])) + "."
    return text


def machine_keys(asked: str) -> list[FileKey]:
    """Keys of machine files by name, by table and name, or by a name without its unit; all keys of a table by its name.

    None if there is no such key. A table that may stand once or several times counts once.

    >>> [key.path for key in machine_keys("ball_diameter")]
    ['autobalancer.ball_diameter_mm']
    """
    from abu_calc.inputs.reading.schema import schema_of

    schema = schema_of("machine")
    keys = dict[str, FileKey]()
    for header, table in file_tables(schema):
        for name, entry in table["properties"].items():
            whole = entry.get("x-canonical-key", name)
            prefix = header.strip("[]")
            if asked in (name, f"{prefix}.{name}", prefix):
                key = FileKey(header, whole, meaning(table["properties"][whole], schema))
                keys.setdefault(key.path, key)
    return list(keys.values()) or list(_outside_tables(asked, schema))


def _outside_tables(asked: str, schema: Mapping[str, Any]) -> Iterator[FileKey]:
    """A key of the whole file that no table of keys with fixed names holds, such as `costs`."""
    for entry in schema["anyOf"][:1]:
        keys = schema["definitions"][entry["$ref"].rsplit("/", 1)[1]]["properties"]
        if asked in keys:
            yield FileKey("", asked, meaning(keys[asked], schema))


MOST_LIKE: Final = 3
"""Most keys that are named to who asks for a word of theirs."""


def keys_with(word: str) -> list[str]:
    """Names of keys that have a word in them, the first few."""
    from abu_calc.inputs.reading.schema import schema_of

    tables = (table["properties"] for _, table in file_tables(schema_of("machine")))
    names = (name for table in tables for name, entry in table.items() if "x-canonical-key" not in entry)
    return list(dict.fromkeys(name for name in names if word.lower() in name.lower().split("_")))[:MOST_LIKE]


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
