"""Common parts of the published cases: what a case shows, its figure, and the commands that it runs."""

import json
import shlex
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import command_output

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

ROOT = Path(__file__).parents[2]

RAN: list[str] = []
"""Commands that the present case ran, in order."""

STUDIES: dict[str, Any] = {}
"""Output of each study that has run."""

SHOWN = 3
"""Most commands that a case shows."""


class Shown(NamedTuple):
    """Table of a case, and a sentence on how far published and own values agree."""

    header: "Sequence[object]"
    rows: "list[Sequence[object]]"
    agreement: str = ""


def run(command: str) -> subprocess.CompletedProcess[str]:
    """Run `abu COMMAND`, and remember it."""
    RAN.append(shlex.join(["abu", *shlex.split(command)]))
    return command_output.run(command)


def study(name: str) -> Any:
    """Numbers that `python -m tests.benchmarks.published NAME` prints."""
    command = ["-m", "tests.benchmarks.published", name]
    RAN.append(shlex.join(["python", *command]))
    if name not in STUDIES:
        seen = subprocess.run([sys.executable, *command], cwd=ROOT, capture_output=True, text=True, check=False)
        if seen.returncode:
            raise RuntimeError(seen.stderr)
        STUDIES[name] = json.loads(seen.stdout)
    return STUDIES[name]


def commands() -> str:
    """Commands of the present case: the first ones, and how many more."""
    unlike = list(dict.fromkeys(RAN))
    more = len(unlike) - SHOWN
    lines = [f"$ {command}" for command in unlike[:SHOWN]]
    return "\n".join([*lines, *([f"# and {more} more with other values"] if more > 0 else [])])


def axes(x: str, y: str) -> "Axes":
    """Empty figure."""
    from matplotlib.figure import Figure

    drawn = Figure(figsize=(7, 3.2), layout="constrained").subplots()
    drawn.set(xlabel=x, ylabel=y)
    return drawn


def save(drawn: "Axes", file: Path) -> None:
    """Write a figure, with a legend if anything in it has a label."""
    if drawn.get_legend_handles_labels()[0]:
        drawn.legend(frameon=False)
    drawn.figure.savefig(file)
