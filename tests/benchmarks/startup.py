"""Cost of commands as whole processes, against the bare import of the libraries they stand on.

    python -m tests.benchmarks.startup

A command and its bare import are started in turn, so that a change of the machine's speed meets both; processor time of
a process includes that of its children. The medians and the median ratios are printed. Run it where Python may write
byte code: without that every start compiles the package anew.
"""

import resource
import statistics
import subprocess
import sys
import time
from typing import NamedTuple

PRESETS = ("avtovaz-707-222", "avtovaz-707-305", "avtovaz-707-370", "msh-230", "swing-arm-grinder")
"""Machines among the presets."""
CHECK = (sys.executable, "-m", "abu_calc", "check-fit", "mmg-3200k-knife-shaft")
HELP = (sys.executable, "-m", "abu_calc", "--help")
SIZE_HELP = (sys.executable, "-m", "abu_calc", "size", "--help")

NUMERICS = (sys.executable, "-c", "import numpy, scipy.integrate, pydantic, typer, rich")
LAZY = (sys.executable, "-c", "import pydantic, typer, rich")
"""The names alone: all three load their parts only when these are used."""
SHOWING = (sys.executable, "-c", "import typer, rich")
"""The names of the two that show help: Typer loads itself, rich its parts when these are used."""
PARTS = (
    sys.executable,
    "-c",
    "import typer, rich.console, rich.table; from pydantic import BaseModel, TypeAdapter, create_model",
)
"""The parts of the three that a command asks for itself, not yet what these load when they are used."""
LEAST = (
    sys.executable,
    "-c",
    """
from typing import Annotated
import typer
from pydantic import BaseModel
from rich.console import Console
from rich.table import Table

class Part(BaseModel):
    bore: float

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)

@app.command()
def show(bore: Annotated[float, typer.Option()]) -> None:
    table = Table("bore")
    table.add_row(str(Part(bore=bore).bore))
    Console().print(table)

app()
""",
    "--bore",
    "80",
)
"""The least program that uses the three: one option, one model, one table."""
ROUNDS = 15


class Spent(NamedTuple):
    """Time [s] of one process from start to end."""

    processor: float
    wall: float


def spent(command: tuple[str, ...]) -> Spent:
    """Time of a process, its output read through a pipe."""
    before, started = _children(), time.perf_counter()
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    taken = Spent(_children() - before, time.perf_counter() - started)
    if done.returncode > 1:  # 1: checks of the result that fail
        raise SystemExit(f"{' '.join(command)}: {done.stderr.decode()}")
    return taken


def _children() -> float:
    """Processor time of all processes that were waited for [s]."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def compare(name: str, command: tuple[str, ...], against: str, bare: tuple[str, ...]) -> None:
    """Print the medians of both and of their ratios."""
    spent(command), spent(bare)  # warm the disk and what the command keeps there
    pairs = [(spent(command), spent(bare)) for _ in range(ROUNDS)]
    print(f"{name:24} against the {against}")
    for which in Spent._fields:
        both = [(getattr(mine, which), getattr(other, which)) for mine, other in pairs]
        ratio = statistics.median(mine / other for mine, other in both)
        mine, other = (1000 * statistics.median(column) for column in zip(*both, strict=True))
        print(f"  {which:22} {mine:6.0f} ms   {other:6.0f} ms   ratio {ratio:.2f}", flush=True)


if __name__ == "__main__":
    for preset in PRESETS:
        command = (sys.executable, "-m", "abu_calc", "size", preset)
        compare(f"size {preset}", command, "import of the numerics", NUMERICS)
    compare("check-fit", CHECK, "least program with the three", LEAST)
    compare("check-fit", CHECK, "import of the parts it asks for", PARTS)
    compare("check-fit", CHECK, "import of the three names", LAZY)
    compare("--help", HELP, "import of typer and rich", SHOWING)
    compare("size --help", SIZE_HELP, "import of typer and rich", SHOWING)
