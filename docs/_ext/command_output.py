"""Directives that run a command while the documentation is built: its output, or a figure that it makes.

    ```{abu} size grinder.toml            the command, and the output at 80 columns
    :status: 1                            the exit status it must end with; default 0
    :until: Vibration                     show the output up to this line
    ```
    ```{abu-figure} settling              the figure that `--figure settling=FILE` writes
    :command: size avtovaz-707-222
    :alt: what is to be seen
    ```
    ```{abu-file} grinder.toml            a file of docs/examples, as it stands when the directive is read
    ```

Commands run in a copy of docs/examples, so that a page may write a file and use it later. An unexpected exit status is
an error, which ends a build with warnings as errors.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

FOLDER = Path(tempfile.mkdtemp(prefix="abu-docs-"))
"""Working folder of all commands of one build."""

OUTPUTS: dict[tuple[str, str], subprocess.CompletedProcess[str]] = {}
"""Outputs of the commands that ran already, by document and command."""


def run(command: str, document: str = "") -> subprocess.CompletedProcess[str]:
    """Run `abu COMMAND` in the working folder, once for each document that shows it."""
    if (document, command) not in OUTPUTS:
        environment = {**os.environ, "COLUMNS": "80", "NO_COLOR": "1", "TERM": "dumb"}
        arguments = [sys.executable, "-m", "abu_calc", *shlex.split(command)]
        OUTPUTS[document, command] = subprocess.run(
            arguments, cwd=FOLDER, env=environment, capture_output=True, text=True, encoding="utf-8", check=False
        )
    return OUTPUTS[document, command]


class CommandOutput(SphinxDirective):
    """A command and what it prints."""

    required_arguments = 1
    final_argument_whitespace = True
    option_spec: ClassVar[dict[str, Any]] = {"status": directives.nonnegative_int, "until": directives.unchanged}

    def run(self) -> list[nodes.Node]:
        """Run the command and show it."""
        command = " ".join(self.arguments[0].split())
        seen = run(command, self.env.docname)
        expected = self.options.get("status", 0)
        if seen.returncode != expected:
            raise self.error(f"`abu {command}` ended with {seen.returncode}, not {expected}:\n{seen.stderr}")
        # What a command says on standard error belongs to what people see, if it says nothing else.
        text = (seen.stdout or seen.stderr).rstrip()
        if until := self.options.get("until"):
            if until not in text:
                raise self.error(f"`abu {command}` prints no {until!r}")
            text = text[: text.index(until)].rstrip() + "\n…"
        block = nodes.literal_block(text="", language="console")
        shown = f"$ abu {command}\n{text}"
        block = nodes.literal_block(shown, shown)
        block["language"] = "console"
        return [block]


class CommandFigure(SphinxDirective):
    """A figure that a command makes."""

    required_arguments = 1
    option_spec: ClassVar[dict[str, Any]] = {
        "command": directives.unchanged_required,
        "alt": directives.unchanged_required,
        "status": directives.nonnegative_int,
    }

    def run(self) -> list[nodes.Node]:
        """Make the figure, and show it with its description."""
        name, command = self.arguments[0], self.options["command"]
        folder = Path(self.env.srcdir) / "_generated"
        folder.mkdir(exist_ok=True)
        file = folder / f"{re.sub(r'[^a-z0-9]+', '-', f'{command} {name}'.lower())}.svg"
        seen = run(f"{command} --quiet --force --figure {name}={shlex.quote(str(file))}")
        if seen.returncode != self.options.get("status", 0):
            raise self.error(f"`abu {command} --figure {name}` ended with {seen.returncode}:\n{seen.stderr}")
        figure = nodes.figure()
        figure += nodes.image(uri=f"/_generated/{file.name}", alt=self.options["alt"])
        figure += nodes.caption("", self.options["alt"])
        return [figure]


class ExampleFile(SphinxDirective):
    """A file of the working folder."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Show the file."""
        text = (FOLDER / self.arguments[0]).read_text(encoding="utf-8")
        block = nodes.literal_block(text, text)
        block["language"] = "toml"
        return [block]


def _prepare(app: Sphinx) -> None:
    shutil.copytree(Path(app.srcdir) / "examples", FOLDER, dirs_exist_ok=True)


def _clean(app: Sphinx, failure: Exception | None) -> None:
    shutil.rmtree(FOLDER, ignore_errors=True)


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directives."""
    app.add_directive("abu", CommandOutput)
    app.add_directive("abu-figure", CommandFigure)
    app.add_directive("abu-file", ExampleFile)
    app.connect("builder-inited", _prepare)
    app.connect("build-finished", _clean)
    # One process reads all documents: the working folder is shared.
    return {"parallel_read_safe": False, "parallel_write_safe": True}
