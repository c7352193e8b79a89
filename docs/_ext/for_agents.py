"""Writes llms.txt and the bundle of schemas into the site: what editors and agents read instead of pages.

`llms.txt` has the form of llmstxt.org: a title, a summary, then lists of links. `schemas/` holds the JSON Schema of
each kind of file and of results, under the names of the public schema store, and `catalog.json` with its entries.
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from command_output import run
from sphinx.application import Sphinx

KINDS = ("machine", "scene", "readings", "recordings", "result")

FACTS = """\
> Design calculator for passive ball autobalancers of hand grinders and machines like them: a command line, `abu`, and
> a Python package, `abu_calc`. An engineer writes one TOML file about a machine; `abu size FILE` returns a design that
> can be made, its checks and a simulation.

- Keys end in their unit: `mass_kg = 5.6`, or `mass = "5.6 kg"`. Results and JSON have the keys with units.
- `abu COMMAND … --json` prints one JSON document on standard output: `status`, `checks`, `result`, `warnings`, `error`.
- Exit status: 0 no check failed, 1 a check failed or was not evaluated, 2 the input is wrong, 3 no trustworthy number.
- A check is pass, warn, fail or not-done. not-done is never a pass.
- Errors name file, line, key, what was found, what is allowed, and the action.
- `abu init FILE` writes a commented file, `abu validate FILE` checks one, `--set table.key=value` replaces an entry.
- `abu explain CODE` gives the criterion of a check, `abu explain STEP` the formulas with their sources.
"""

SECTIONS = (
    ("Tutorials", "tutorials/"),
    ("How-to guides", "how-to/"),
    ("Reference", "reference/"),
    ("Explanation", "explanation/"),
)


def write(app: Sphinx, failure: Exception | None) -> None:
    """Write both into the site, if it was built."""
    if failure is not None or app.builder.format != "html":
        return
    folder = Path(app.outdir)
    (folder / "schemas").mkdir(exist_ok=True)
    schemas = {kind: json.loads(run(f"schema {kind}").stdout) for kind in KINDS}
    for kind, schema in schemas.items():
        (folder / "schemas" / file_of(kind)).write_text(json.dumps(schema, indent=2) + "\n", encoding="utf-8")
    catalog = json.dumps({"schemas": [entry(kind, schemas[kind]) for kind in KINDS[:-1]]}, indent=2)
    (folder / "schemas" / "catalog.json").write_text(catalog + "\n", encoding="utf-8")
    (folder / "llms.txt").write_text(llms(app), encoding="utf-8")


def file_of(kind: str) -> str:
    """Name of a schema's file, as the schema store has it."""
    return f"abu-calc-{kind}.json"


def entry(kind: str, schema: dict[str, Any]) -> dict[str, Any]:
    """Entry of the schema store's catalogue."""
    return {
        "name": schema["title"],
        "description": schema["description"],
        "fileMatch": [f"*.abu-{kind}.toml"],
        "url": schema["id"],
    }


def llms(app: Sphinx) -> str:
    """The text of llms.txt."""
    lines = [f"# {app.config.project}", "", FACTS]
    documents = sorted(app.env.found_docs)
    for title, folder in SECTIONS:
        lines += [f"## {title}", "", *links(app, [name for name in documents if name.startswith(folder)]), ""]
    lines += ["## Commands", "", *commands(), "", "## Schemas", ""]
    lines += [
        f"- [{file_of(kind)}](schemas/{file_of(kind)}): JSON Schema, as `abu schema {kind}` prints it" for kind in KINDS
    ]
    return "\n".join(lines) + "\n"


def links(app: Sphinx, documents: list[str]) -> Iterator[str]:
    """A link to each document with its title and first sentence."""
    for name in documents:
        title = app.env.titles[name].astext()
        paragraph = next((node for node in app.env.get_doctree(name).findall() if node.tagname == "paragraph"), None)
        text = "" if paragraph is None else re.split(r"(?<=\.)\s", " ".join(paragraph.astext().split()))[0]
        yield f"- [{title}]({app.builder.get_target_uri(name)}){f': {text}' if text else ''}"


def commands() -> Iterator[str]:
    """Each command with its line of help."""
    from abu_calc.registry import FEATURES

    yield from (f"- `abu {feature.name}`: {feature.about}" for feature in FEATURES)


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the writing at the end of a build."""
    # Before the working folder of the commands is removed.
    app.connect("build-finished", write, priority=100)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
