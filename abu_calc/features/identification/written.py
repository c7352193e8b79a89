"""The text of a machine or scene file with the identified values in the place of the assumed ones."""

import re
from typing import Final

from abu_calc.features.identification.results import IdentifyResult, interval_lines
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.written_units import written_unit
from abu_calc.inputs.reading.document import open_document

NUMBER: Final = r"[-+]?[\d_.]+(?:[eE][-+]?\d+)?"
SCENE_KEYS: Final = {"rolling_friction_mm": "lever_arm_mm", "race_eccentricity_mm": "magnitude_mm"}
"""Keys of a scene file that have other names than those of a machine file."""


def identified_text(source: str, result: IdentifyResult) -> str:
    """The file's text with the values that are known. Raises InputError if none is, or if a key has no place."""
    document = open_document(source)
    scene = "scene" in document.content
    values = {
        key: value.value
        for key in ("rolling_drag_per_s", "rolling_friction_mm", "race_eccentricity_mm")
        if (value := getattr(result, key)) is not None
    }
    if not values:
        raise InputError(
            "no value was identified, so there is nothing to write", place=Place(source),
            remedy="Follow the actions of the checks, or leave --write out.",
        )  # fmt: skip
    text = document.text
    for key, value in values.items():
        name = SCENE_KEYS.get(key, key) if scene else key
        text, count = re.subn(rf"(?m)^([^#\n]*\b{name}\s*=\s*){NUMBER}", rf"\g<1>{value:.4g}", text)
        if not count and (unit := written_unit(name)):  # the value stands there with its unit
            pattern = rf"(?m)^([^#\n]*\b){unit.stem}\s*=\s*(?:\"[^\"\n]*\"|'[^'\n]*')"
            text, count = re.subn(pattern, rf"\g<1>{name} = {value:.4g}", text)
        if not count and scene:
            raise InputError(
                "the scene has no place for a value",
                place=Place(source, key=name),
                remedy="Add the key, or its effect.",
            )
        if not count:
            text, count = re.subn(r"(?m)^(\[autobalancer\][^\n]*)$", rf"\g<1>\n{name} = {value:.4g}", text, count=1)
        if not count:
            text = f"{text.rstrip()}\n\n[autobalancer]\n{name} = {value:.4g}\n"
    if not scene:
        text = _with_intervals(text, interval_lines(result.starts, {key: getattr(result, key) for key in values}))
    angle = result.race_eccentricity_angle_deg
    if scene and angle is not None:
        pattern = rf"(?m)^(\s*race_eccentricity\s*=\s*\{{[^}}\n]*angle_deg\s*=\s*){NUMBER}"
        text = re.sub(pattern, rf"\g<1>{angle.value:.1f}", text)
    return text


def _with_intervals(text: str, lines: list[str]) -> str:
    """The text with the table [identified] anew, in the place of an earlier one."""
    kept = re.sub(r"(?ms)^\[identified\][^\n]*\n.*?(?=^\[|\Z)", "", text)
    return f"{kept.rstrip()}\n\n{chr(10).join(lines)}\n"
