"""Work out a published statement: python -m tests.benchmarks.published routh|stuck|ramps|stiction|two-planes.

It prints the numbers as JSON; the validation page shows them.
"""

import json
import sys
from collections.abc import Callable
from typing import Any, Final

from tests.benchmarks.published import ramps, routh, stiction, stuck, two_planes

MASSES: Final = (0.01, 0.02, 0.03, 0.04, 0.05, 0.06)
GREEN: Final = (2.0, 0.05, 0.01, 0.01, 0.01)


def by_routh() -> dict[str, Any]:
    """Speeds at which stability changes, and the eigenvalues of Green's numbers."""
    values = [[value.real, value.imag] for value in routh.eigenvalues(*GREEN)]
    return {"changes": {mass: routh.changes(mass) for mass in MASSES}, "eigenvalues": values}


def stuck_balls() -> dict[str, Any]:
    """Curve, ranges and deviations."""
    at = stuck.speeds()
    found = stuck.curve(at)
    return {"speeds": at, "stuck": found, "ranges": stuck.ranges(at, found), "deviations": stuck.deviations()}


CASES: Final[dict[str, Callable[[], Any]]] = {
    "routh": by_routh,
    "stuck": stuck_balls,
    "ramps": ramps.shares,
    "stiction": stiction.scatter,
    "two-planes": lambda: json.loads(two_planes.RECORD.read_text(encoding="utf-8")),
}

if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] not in CASES:
        raise SystemExit(f"{__doc__}")
    print(json.dumps(CASES[sys.argv[1]]()))
