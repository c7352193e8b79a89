"""What scenes that switch cost, by each integrator there is, beside how far off it is.

    python -m tests.benchmarks.switching [folder of references to write or read]

Times are CPU times of the integration alone, the best of a few; errors are `difference` from heyoka (where there is
none, DOP853) at its tightest.
"""

import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

from abu_calc.analysis.differences import difference
from abu_calc.analysis.response import evaluate, needed_times
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.integrators.compiled import waiting
from abu_calc.dynamics.scene import with_parted_balls
from abu_calc.scenes.from_design import scene_of_design
from abu_calc.sizing import size
from abu_calc.spec.read import read_machine

CASES = (
    ("avtovaz-707-222", "idle"),
    ("avtovaz-707-222", "grinding"),
    ("swing-arm-grinder", "swing-arm-idle"),
    ("msh-230", "idle"),
    ("avtovaz-707-370", "idle"),
)
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-8)
MOST = 12_000_000
LONG = 3.0
"""Seconds beyond which a run is not repeated."""


def equations_of(preset: str, which: str) -> Equations:
    """A machine's scene with all its effects."""
    design: Any = size(read_machine(preset).whole("simulate"))
    return assemble(with_parted_balls(scene_of_design(design, which))[0])


def ways(equations: Equations) -> tuple[str, ...]:
    """Integrators there are."""
    found = [] if waiting.unfit(equations) else ["compiled-rk45"]
    return (*found, *(() if choice.unfit(equations) else ("heyoka",)), "scipy-dop853")


def timed(way: str, equations: Equations, tolerance: float, moments: np.ndarray) -> tuple[Any, float]:
    """A run and its time, the best of three unless it is long."""
    best = np.inf
    for _ in range(4):
        begun = time.process_time()
        found = choice.integrate_with(way, equations, tolerance, moments, MOST)
        best = min(best, time.process_time() - begun)
        if best > LONG:
            break
    return found, best


def main() -> None:
    """Print the table."""
    for preset, which in CASES:
        equations = equations_of(preset, which)
        scene, moments = equations.scene, needed_times(equations.scene)
        kept = Path(sys.argv[1]) / f"{preset}-{which}.npz" if len(sys.argv) > 1 else None
        if kept and kept.exists():
            true = evaluate(scene, _Kept(moments, np.load(kept)["y"]))  # type: ignore[arg-type]
        else:
            run = choice.integrate_with(ways(equations)[-2], equations, 1e-12, moments, MOST)
            true = evaluate(scene, run)
            if kept:
                np.savez(kept, y=run.y)
        print(f"{preset} {which}")
        for way in ways(equations):
            for tolerance in TOLERANCES:
                run, spent = timed(way, equations, tolerance, moments)
                error = difference(scene, evaluate(scene, run), true)
                counts = f"{run.events} events, {run.steps} steps, {run.evaluations} evaluations"
                print(f"  {way:13} {tolerance:6g} {1e3 * spent:9.2f} ms  error {error:8.1e}  {counts}", flush=True)


class _Kept:
    """A reference read back."""

    def __init__(self, t: np.ndarray, y: np.ndarray) -> None:
        self.t, self.y = t, y

    def at(self, times: np.ndarray) -> np.ndarray:
        """At moments of its own."""
        return np.asarray(self.y[:, np.searchsorted(self.t, times)])


if __name__ == "__main__":
    main()
