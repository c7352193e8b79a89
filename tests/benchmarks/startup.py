"""What commands cost as whole processes, against the bare start of the libraries they stand on.

    python -m tests.benchmarks.startup

Both are started in turn, so that a change of the machine's speed meets both; the median of the ratios is told.
"""

import statistics
import subprocess
import sys
import time

SIZE = (sys.executable, "-m", "abu_calc", "size", "avtovaz-707-222")
CHECK = (sys.executable, "-m", "abu_calc", "check-fit", "mmg-3200k-knife-shaft")
HELP = (sys.executable, "-m", "abu_calc", "--help")

NUMERICS = (sys.executable, "-c", "import numpy, scipy.integrate, pydantic, typer, rich")
LAZY = (sys.executable, "-c", "import pydantic, typer, rich")
"""The names alone: all three load their parts only when these are used."""
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


def seconds(command: tuple[str, ...]) -> float:
    """Wall time of one process from start to end, its output read through a pipe."""
    started = time.perf_counter()
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    taken = time.perf_counter() - started
    if done.returncode > 1:  # 1: checks of the result that fail
        raise SystemExit(f"{' '.join(command)}: {done.stderr.decode()}")
    return taken


def compare(name: str, command: tuple[str, ...], against: str, bare: tuple[str, ...]) -> None:
    """Print the medians of both and of their ratio."""
    seconds(command), seconds(bare)  # warm the disk
    pairs = [(seconds(command), seconds(bare)) for _ in range(ROUNDS)]
    ratio = statistics.median(a / b for a, b in pairs)
    mine, other = (1000 * statistics.median(column) for column in zip(*pairs, strict=True))
    print(f"{name:10} {mine:5.0f} ms   {against:32} {other:5.0f} ms   ratio {ratio:.2f}")


if __name__ == "__main__":
    compare("size", SIZE, "import of the numerics", NUMERICS)
    compare("check-fit", CHECK, "least program with the three", LEAST)
    compare("check-fit", CHECK, "import of the parts it asks for", PARTS)
    compare("check-fit", CHECK, "import of the three names", LAZY)
    compare("--help", HELP, "import of the three names", LAZY)
