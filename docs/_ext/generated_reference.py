"""Writes the reference pages from the program itself, before they are read: commands, keys, checks, formulas, results.

Pages are written to reference/generated/, which is not kept under version control.
"""

import importlib
import inspect
import json
import re
from pathlib import Path
from typing import Any

from command_output import run
from sphinx.application import Sphinx

KINDS = {
    "machine": ("Machine files", "`abu init FILE` writes a complete machine file with a comment at each key."),
    "scene": ("Scene files", "`abu init --scene FILE` writes a complete scene file."),
    "readings": ("Readings of a balancing rig", "`abu init --readings FILE` writes a complete file of readings."),
    "recordings": ("Recordings of a type test", "`abu init --recordings FILE` writes a complete list of recordings."),
}

CHECK_LABELS = {
    "question": "Question:",
    "pass_if": "PASS if",
    "warn_if": "WARN if",
    "fail_if": "FAIL if",
    "not_evaluated_if": "NOT EVALUATED if",
    "action": "Action:",
}
"""Labels of the texts of a check, by the fields of `CheckCode`."""


def write(app: Sphinx) -> None:
    """Write all pages whose text has changed."""
    folder = Path(app.srcdir) / "reference" / "generated"
    folder.mkdir(parents=True, exist_ok=True)
    pages = {
        "commands": commands(),
        **{f"{kind}-file": keys(kind) for kind in KINDS},
        "checks": checks(),
        "formulas": formulas(),
        "results": results(),
        "units": units(),
        "python": python(),
    }
    for name, text in pages.items():
        file = folder / f"{name}.md"
        if not file.is_file() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")


def commands() -> str:
    """Help of each command, in the order of `abu --help`."""
    from abu_calc.registry import FEATURES

    helped = ((feature.name, run(f"{feature.name} --help").stdout) for feature in FEATURES)
    # A command that lists some of its options by name explains them on request.
    whole = ((name, run(f"{name} --help-all").stdout if "--help-all" in text else text) for name, text in helped)
    sections = (f"## abu {name}\n\n```text\n{text.rstrip()}\n```\n" for name, text in whole)
    opening = (
        "# Commands\n\nThis page is the output of `abu --help`, and of `abu COMMAND --help` or, if a command has it, "
        "of `--help-all`.\n"
    )
    return "\n".join((opening, f"```text\n{run('--help').stdout.rstrip()}\n```\n", *sections))


def keys(kind: str) -> str:
    """Tables and keys of one kind of file, from its schema."""
    from abu_calc.features.explain.texts import file_tables, meaning

    title, opening = KINDS[kind]
    schema = json.loads(run(f"schema {kind}").stdout)
    lines = [f"# {title}", "", f"{opening} `abu schema {kind}` prints the JSON Schema that this page is made from.", ""]
    for path, table in file_tables(schema):
        lines += [f"## `{path}`", "", _escaped(table.get("description", "")), "", "| key | meaning |", "|---|---|"]
        required = set(table.get("required", ()))
        for key, entry in table["properties"].items():
            if "x-canonical-key" in entry:
                continue  # the page on units lists these
            needed = " (required)" if key in required else ""
            lines.append(f"| `{key}`{needed} | {_cell(meaning(entry, schema))} |")
        lines.append("")
    return "\n".join(lines)


def checks() -> str:
    """Texts of all checks by their codes."""
    from abu_calc.foundation.checks import CHECK_CODES

    lines = [
        "# Checks",
        "",
        "A check ends with PASS, WARN, FAIL or NOT EVALUATED (in JSON `not-done`). `abu explain CODE` prints one.",
        "",
    ]
    for code in sorted(CHECK_CODES, key=lambda code: int(code[3:])):
        check = CHECK_CODES[code]
        lines += [f"({code.lower()})=", f"## {code}: {check.name}", ""]
        for field, label in CHECK_LABELS.items():
            if text := getattr(check, field):
                lines += [f"**{label}** {_escaped(text)}", ""]
        if check.step:
            lines += [f"Formulas: {{ref}}`step-{check.step}`", ""]
    return "\n".join(lines)


def formulas() -> str:
    """Formulas of all steps, with range, source and misprints."""
    from abu_calc.features.explain.steps import STEPS

    lines = [
        "# Formulas",
        "",
        "Equations take SI units; the units in brackets are those of files and reports. `abu explain STEP` prints a "
        "section, and `abu size MACHINE --explain` puts the numbers of a machine into it.",
        "",
    ]
    for name, step in STEPS.items():
        lines += [f"(step-{name})=", f"## {step.title}", ""]
        for formula in step.formulas:
            lines += [f"### {formula.name.capitalize()}", "", "```text", *formula.for_users, "```", ""]
    return "\n".join(lines)


def results() -> str:
    """Keys of results, from their schema."""
    schema = json.loads(run("schema result").stdout)
    lines = [
        "# Results",
        "",
        "Keys of `result` in the JSON of each command. `abu schema result` prints the JSON Schema.",
        "Units stand in the names. A value that could not be computed is null; a check or a warning names the reason.",
        "",
    ]
    for name, entry in schema["$defs"].items():
        if "properties" not in entry:
            continue
        lines += [f"## {name}", "", _escaped(entry.get("description", "")), "", "| key | meaning |", "|---|---|"]
        for key, value in entry["properties"].items():
            found = re.search(r"#/\$defs/(\w+)", json.dumps(value))
            text = value.get("description", "")
            lines.append(f"| `{key}` | {_cell(text or (f'see {found[1]}' if found else ''))} |")
        lines.append("")
    return "\n".join(lines)


def units() -> str:
    """Units that values in files may have."""
    from abu_calc.units import allowed_units

    lines = [
        "# Values with units",
        "",
        'The unit of a number stands in its key, `mass_kg = 5.6`, or behind the number: `mass = "5.6 kg"`. The key is '
        "then written without its unit. This holds for every key of machine, scene, readings and recordings files that "
        'ends in a unit, for lists (`natural_frequencies = ["12 Hz", "15 Hz"]`) and for `--set`. A file gives each '
        "value in one form. Reports list the conversions; results and JSON have the keys with units.",
        "",
        "Products may be written with `·`, `*` or a blank, powers as `²`, `2` or `^2`, micro as `µ` or `u`. Other "
        "units are refused. A runout by total indicator reading has a key of its own, `runout_tir`; a temperature "
        "difference is given in K.",
        "",
        "| quantity | keys end in | units |",
        "|---|---|---|",
    ]
    for quantity, suffixes, names in allowed_units():
        endings = ", ".join(f"`_{suffix}`" for suffix in suffixes)
        lines.append(f"| {quantity} | {endings} | {', '.join(names)} |")
    return "\n".join(lines) + "\n"


def python() -> str:
    """Public names of the package, with signatures and docstrings."""
    import abu_calc

    lines = [
        "# Python",
        "",
        "All public names of `abu_calc`. Results are frozen, typed, and in the units of their names.",
        "",
    ]
    for name in sorted(abu_calc.__all__, key=str.lower):
        value = getattr(abu_calc, name)
        if inspect.ismodule(value):
            lines += [f"## {name}", "", "```text", inspect.getdoc(value) or "", "```", ""]
        if not callable(value):
            continue
        lines += [f"## {name}", ""]
        if not inspect.isclass(value):
            lines += ["```python", _signature(name, value), "```", ""]
        lines += ["```text", inspect.getdoc(value) or "", "```", ""]
    return "\n".join(lines)


def _signature(name: str, value: Any) -> str:
    unwrapped = inspect.unwrap(value)
    module = importlib.import_module(unwrapped.__module__)
    entries = []
    for parameter in inspect.signature(unwrapped).parameters.values():
        text = str(parameter)
        entries.append(re.sub(r"\babu_calc(?:\.\w+)+\.(\w+)", r"\1", text.replace(f"{module.__name__}.", "")))
    shown = f"{name}({', '.join(entries)})"
    return shown if len(shown) <= 100 else f"{name}(\n    " + ",\n    ".join(entries) + ",\n)"


def _escaped(text: str) -> str:
    """Text whose signs Markdown leaves alone."""
    return re.sub(r"([\\*_<>\[\]|$])", r"\\\1", text)


def _cell(text: str) -> str:
    return _escaped(" ".join(text.split()))


def setup(app: Sphinx) -> dict[str, bool]:
    """Write the pages when the builder is ready."""
    app.connect("builder-inited", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
