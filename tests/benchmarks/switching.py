"""What scenes that switch cost, by each integrator there is, beside an older version, at equal error.

    python -m tests.benchmarks.switching [PYTHON OF AN ENVIRONMENT WITH THE OLDER VERSION]

Both versions run in turn, each in processes of its own, with all effects. Times are CPU times of the integration alone,
the best of a few; errors are `difference` from compiled code of order 8 at its tightest.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.simulation.model_level import difference
from abu_calc.simulation.response import evaluate, needed_times
from tests.benchmarks.measuring import keep, machine
from tests.benchmarks.switching_run import MOST, equations_of

CASES = (
    ("avtovaz-707-222", "idle"),
    ("avtovaz-707-222", "grinding"),
    ("swing-arm-grinder", "idle"),
    ("msh-230", "idle"),
    ("avtovaz-707-305", "idle"),
)
OLD_WAYS = ("compiled-rk45", "plain-rk45")
WAYS = (*OLD_WAYS, "compiled-dop853", "scipy-dop853")
TOLERANCES = ("1e-3", "5e-4", "2e-4", "1e-4", "1e-5", "1e-6", "1e-8")
FEWER = ("1e-2", "1e-3", "1e-4")
ERRORS = (1e-2, 1e-3, 1e-4, 1e-5)
ROUNDS = 3
RUN = Path(__file__).with_name("switching_run.py")


def main() -> None:
    """Print the table, and keep the record."""
    older, cases = sys.argv[1:2], {}
    for preset, which in CASES:
        equations = equations_of(preset, which)
        scene, moments = equations.scene, needed_times(equations.scene)
        run = choice.integrate_with("compiled-dop853", equations, 1e-11, moments, MOST)
        true, rows = evaluate(scene, run), {}
        for way in WAYS:
            both = [*older, sys.executable] if way in OLD_WAYS else [sys.executable]
            # In turn, a few times: the pace of a machine that others use changes within minutes.
            for python in both * (ROUNDS if len(both) > 1 else 1):
                name = way if python == sys.executable else f"older {way}"
                few = TOLERANCES if way in choice.LOOP else FEWER
                rows[name] = quicker(rows.get(name), measured(python, preset, which, way, few, scene, moments, true))
            for name in sorted(name for name in rows if name.endswith(way)):
                report(preset, which, name, rows[name])
        cases[f"{preset} {which}"] = {"runs": rows, "older_over_this": compared(rows)}
        print(f"  older over this: {cases[f'{preset} {which}']['older_over_this']}", flush=True)
    command = "python -m tests.benchmarks.switching" + (" PYTHON" if older else "")
    what = "CPU time of the integration alone, best of a few, with all effects; the older version is commit c4c95f6"
    print(keep("switching", what, command, machine("not bound"), 0, cases))


def measured(
    python: str, preset: str, which: str, way: str, tolerances: tuple[str, ...], scene: Scene, moments: np.ndarray,
    true: Any,
) -> list[dict[str, Any]]:  # fmt: skip
    """Runs at each tolerance by a process of their own, with their errors."""
    with tempfile.TemporaryDirectory() as folder:
        words = [python, str(RUN), preset, which, way, folder, *tolerances]
        lines = subprocess.run(words, capture_output=True, text=True, check=True).stdout.splitlines()
        rows = [json.loads(line) for line in lines]
        for row in rows:
            counted = row["evaluations"], row["steps"], row["events"]
            found = Trajectory(moments, np.load(row.pop("states")), way, row["tolerance"], *counted)
            row["error"] = difference(scene, evaluate(scene, found), true)
    return rows


def quicker(rows: list[dict[str, Any]] | None, again: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The quicker of two runs at each tolerance."""
    return [min(pair, key=lambda row: row["cpu_s"]) for pair in zip(rows or again, again, strict=True)]


def at_error(rows: list[dict[str, Any]], error: float) -> dict[str, Any] | None:
    """The quickest run that is as accurate as asked for."""
    return min((row for row in rows if row["error"] <= error), key=lambda row: row["cpu_s"], default=None)


def compared(rows: dict[str, list[dict[str, Any]]]) -> dict[str, dict[str, tuple[float, float]]]:
    """The older version's time and evaluations over those of this one, each way, at each error that both reach."""
    found: dict[str, dict[str, tuple[float, float]]] = {}
    for way in OLD_WAYS:
        for error in ERRORS:
            ours, theirs = (at_error(rows.get(name, []), error) for name in (way, f"older {way}"))
            if ours and theirs:
                time, evaluations = (round(theirs[key] / ours[key], 2) for key in ("cpu_s", "evaluations"))
                found.setdefault(way, {})[f"{error:g}"] = time, evaluations
    return found


def report(preset: str, which: str, name: str, rows: list[dict[str, Any]]) -> None:
    """A line for each run."""
    for row in rows:
        counts = f"{row['events']} events, {row['steps']} steps, {row['evaluations']} evaluations"
        print(f"{preset} {which}  {name:18} {row['tolerance']:6g} {1e3 * row['cpu_s']:9.2f} ms  "
              f"error {row['error']:8.1e}  {counts}", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
