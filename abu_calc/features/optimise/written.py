"""Text of a machine file with the values of a design; comments stay where the text can be edited line by line."""

import copy
import re
import tomllib
from collections.abc import Mapping
from typing import Any, Final

from abu_calc.features.optimise.result import OptimiseResult
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading.overrides import Override, apply, overrides_of
from abu_calc.inputs.reading.table import table_at
from abu_calc.inputs.reading.text import shown
from abu_calc.inputs.reading.values_with_units import canonical_keys

HEADER: Final = r"(?m)^\[{}\][^\n]*$"
DROPPED: Final = ("expected",)
"""Tables that hold for the old design alone."""


def written_text(machine: Machine, values: Mapping[str, Any], result: OptimiseResult) -> str:
    """The file with these values, scattering as the samples of the race did."""
    scatter = dict(values)
    if result.written_tolerances:
        scatter["sweep.tolerances"] = True
    content = copy.deepcopy(machine.document.content)
    for name in DROPPED:
        content.pop(name, None)
    overrides = (*machine.overrides, *overrides_of(scatter))
    for override in overrides:
        if len(override.path) == 2 and isinstance(held := content.get(str(override.path[0])), dict):
            held.pop(_without_unit(override), None)
    apply(content, overrides, MachineFile)
    text = machine.document.text
    for name in DROPPED:
        text = re.sub(rf"(?ms)^\[{name}[.\]].*?(?=^\[|\Z)", "", text)
    for override in overrides:
        text = _put(text, override)
    try:
        same = tomllib.loads(text) == content
    except ValueError:
        same = False
    if same:
        return text
    import tomli_w

    return tomli_w.dumps(content)


def _without_unit(override: Override) -> str:
    """The key of an override as it stands beside a value with its unit."""
    *above, key = override.path
    table = table_at(MachineFile, tuple(above))
    written = {} if table is None else {own: stem for stem, own in canonical_keys(table).items()}
    return written.get(str(key), str(key))


def _put(text: str, override: Override) -> str:
    """The text with one entry of a table set."""
    if len(override.path) != 2 or not all(isinstance(part, str) for part in override.path):
        return text
    table, key = map(str, override.path)
    line = f"{key} = {shown(override.value)}"
    header = re.search(HEADER.format(re.escape(table)), text)
    if header is None:
        return f"{text.rstrip()}\n\n[{table}]\n{line}\n"
    following = re.search(r"(?m)^\[", text[header.end() :])
    end = header.end() + following.start() if following else len(text)
    body = text[header.end() : end]
    replaced, count = re.subn(
        rf"(?m)^(?:{key}|{_without_unit(override)})\s*=[^#\n]*?(?=\s*(#|$))", lambda _: line, body, count=1
    )
    if not count:
        replaced = f"\n{line}{body}"
    else:
        replaced = re.sub(rf"(?m)^({re.escape(line)})\s+#.*$", r"\1  # chosen by abu optimise", replaced)
    return text[: header.end()] + replaced + text[end:]
