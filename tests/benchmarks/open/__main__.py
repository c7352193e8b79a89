"""Hold a simulator against a reference motion: python -m tests.benchmarks.open CASE PROGRAM.

CASE: a name of the folder `cases`, or "all". PROGRAM: abu, scipy, mujoco, or a command in quotes, to which the case's
file is appended. It prints {"states": [[x, y, angles …, velocities …, rates …] for each of times_s]} in SI, and if it
likes "events": [[time, kind, ball] …].
"""

import json
import shlex
import subprocess
import sys
import time
from collections.abc import Sequence
from typing import Any, Final, NamedTuple

from tests.benchmarks.open.files import case_of, case_path, names, reference_of
from tests.benchmarks.open.measure import errors, event_errors, followed

ENTRIES: Final = {
    name: f"{shlex.quote(sys.executable)} -m tests.benchmarks.open.{name}_entry" for name in ("abu", "scipy", "mujoco")
}


class Held(NamedTuple):
    """Errors of the axis and of the balls [rad], time of the whole process [s], and until when it followed [s].

    `missed` events and their largest error in time [revolutions]: None if the program or the reference lists none.
    """

    axis: float
    balls: float
    spent: float
    until: float
    missed: int | None = None
    late: float = 0.0


def held(name: str, program: str) -> Held:
    """Errors of a program in a case."""
    begun = time.perf_counter()
    command = [*shlex.split(ENTRIES.get(program, program)), str(case_path(name))]
    seen = subprocess.run(command, capture_output=True, text=True, check=False)
    spent = time.perf_counter() - begun
    if seen.returncode:
        raise SystemExit(f"{program} ended with {seen.returncode}: {seen.stderr.strip()[-500:]}")
    try:
        return _compared(json.loads(seen.stdout), case_of(case_path(name)), reference_of(name), spent)
    except (ValueError, KeyError, TypeError, IndexError) as error:
        raise SystemExit(f"{program} gave no states of {name}: {error}") from None


def _compared(output: dict[str, Any], case: dict[str, Any], reference: dict[str, Any], spent: float) -> Held:
    states, wanted, balls = output["states"], reference["states"], len(case["ball_masses_kg"])
    until = followed(states, wanted, case["times_s"], balls)
    errors_ = errors(states, wanted, balls)
    if "events" not in output or "events" not in reference:
        return Held(*errors_, spent, until)
    return Held(*errors_, spent, until, *event_errors(output["events"], reference["events"], case["speed_rad_per_s"]))


def main(arguments: Sequence[str]) -> None:
    """Print a line for each case."""
    if len(arguments) != 2 or arguments[0] not in (*names(), "all"):
        raise SystemExit(f"{__doc__}\nCases: {', '.join(names())}")
    for name in names() if arguments[0] == "all" else arguments[:1]:
        seen = held(name, arguments[1])
        print(f"{name:16} {arguments[1]:8} {told(name, seen)}")


def told(name: str, seen: Held) -> str:
    """The errors in words."""
    end = case_of(case_path(name))["times_s"][-1]
    lost = "" if seen.until == end else f", lost after {seen.until:.3g} of {end:g} s"
    events = "" if seen.missed is None else f", {seen.missed} events wrong, times {seen.late:.1e} revolutions"
    return f"axis {seen.axis:.1e}, balls {seen.balls:.1e} rad, {seen.spent:.2f} s with start{events}{lost}"


if __name__ == "__main__":
    main(sys.argv[1:])
