"""What `abu size` costs as a whole process, against the bare import of the libraries it stands on.

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
LIGHT = (sys.executable, "-c", "import pydantic, typer, rich")
"""Bare import; all three load their parts only when these are used."""
USED = (
    sys.executable,
    "-c",
    "import typer, rich.console, rich.table; from pydantic import BaseModel, TypeAdapter, create_model",
)
"""The parts of the three that any command with an option, a model and a table uses."""
ROUNDS = 15


def seconds(command: tuple[str, ...]) -> float:
    """Wall time of one process from start to end."""
    started = time.perf_counter()
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    return time.perf_counter() - started


def compare(name: str, command: tuple[str, ...], bare: tuple[str, ...]) -> None:
    """Print the medians of both and of their ratio."""
    seconds(command), seconds(bare)  # warm the disk
    pairs = [(seconds(command), seconds(bare)) for _ in range(ROUNDS)]
    ratio = statistics.median(a / b for a, b in pairs)
    mine, other = (statistics.median(column) for column in zip(*pairs, strict=True))
    print(f"{name:10} {1000 * mine:6.0f} ms   bare import {1000 * other:6.0f} ms   ratio {ratio:.2f}")


if __name__ == "__main__":
    compare("size", SIZE, NUMERICS)
    compare("check-fit", CHECK, USED)
    compare("check-fit", CHECK, LIGHT)
    compare("--help", HELP, LIGHT)
