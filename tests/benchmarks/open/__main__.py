"""Hold a simulator against a reference motion: python -m tests.benchmarks.open CASE PROGRAM.

CASE: a name of the folder `cases`, or "all". PROGRAM: abu, scipy, or a command in quotes, to which the case's file is
appended. It prints {"states": [[x, y, angles …, velocities …, rates …] for each of times_s]} in SI.
"""

import json
import shlex
import subprocess
import sys
import time
from collections.abc import Sequence
from typing import Final

from tests.benchmarks.open.files import case_of, case_path, names, reference_of
from tests.benchmarks.open.measure import errors

ENTRIES: Final = {
    name: f"{shlex.quote(sys.executable)} -m tests.benchmarks.open.{name}_entry" for name in ("abu", "scipy")
}


def held(name: str, program: str) -> tuple[float, float, float]:
    """Errors of the axis and of the balls [rad], and the time of the whole process [s]."""
    begun = time.perf_counter()
    command = [*shlex.split(ENTRIES.get(program, program)), str(case_path(name))]
    seen = subprocess.run(command, capture_output=True, text=True, check=False)
    spent = time.perf_counter() - begun
    if seen.returncode:
        raise SystemExit(f"{program} ended with {seen.returncode}: {seen.stderr.strip()[-500:]}")
    try:
        states = json.loads(seen.stdout)["states"]
        balls = len(case_of(case_path(name))["ball_masses_kg"])
        return (*errors(states, reference_of(name)["states"], balls), spent)
    except (ValueError, KeyError, TypeError) as error:
        raise SystemExit(f"{program} gave no states of {name}: {error}") from None


def main(arguments: Sequence[str]) -> None:
    """Print a line for each case."""
    if len(arguments) != 2 or arguments[0] not in (*names(), "all"):
        raise SystemExit(f"{__doc__}\nCases: {', '.join(names())}")
    for name in names() if arguments[0] == "all" else arguments[:1]:
        axis, balls, spent = held(name, arguments[1])
        print(f"{name:16} {arguments[1]:8} axis {axis:.1e}, balls {balls:.1e} rad, {spent:.2f} s with start")


if __name__ == "__main__":
    main(sys.argv[1:])
