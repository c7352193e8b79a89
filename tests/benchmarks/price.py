"""What each digit costs in a scene that switches, with and without its events, and what compiling costs.

    python -m tests.benchmarks.price

The first two parts are CPU time of the integration alone, in compiled code, the best of 25, with all effects and with
the smooth ones; evaluations explain their number times what one costs by itself. The third runs whole processes with an
empty folder for compiled code, then again.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from typing import Any

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.choice import loop_method
from abu_calc.dynamics.integrators.compiled.kernels import METHODS
from abu_calc.dynamics.integrators.compiled.program import in_order
from abu_calc.dynamics.integrators.compiled.run import _CompiledRun
from abu_calc.simulation.response import needed_times
from tests.benchmarks.bare import evaluation_times
from tests.benchmarks.cases import smooth
from tests.benchmarks.measuring import keep, machine
from tests.benchmarks.switching_run import MOST, equations_of

PRESET, SCENE = "avtovaz-707-222", "idle"
TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10)
REPEATS, ROUNDS = 25, 5

FIRST = """
import json, sys, time
from tests.benchmarks.events import scene
from abu_calc.dynamics.equations.assemble import assemble
begun = time.perf_counter()
import llvmlite.binding
imported = time.perf_counter()
from abu_calc.dynamics.integrators.compiled.order import in_order
from abu_calc.dynamics.integrators.compiled.run import prepared
equations, _ = in_order(assemble(scene(4)))
ready = time.perf_counter()
prepared(equations, "rk45")
print(json.dumps([imported - begun, time.perf_counter() - ready]))
"""
"""Seconds that the library's import takes, then those until code for four balls with friction and contact is ready."""


def prices(equations: Equations) -> list[dict[str, Any]]:
    """A line for each tolerance."""
    moments, (ordered, places) = needed_times(equations.scene), in_order(equations)
    rates, watched = evaluation_times(equations)
    rows = []
    for tolerance in TOLERANCES:
        spent = []
        for _ in range(REPEATS):
            begun = time.process_time()
            method = loop_method(equations, tolerance)
            run = _CompiledRun(
                ordered, tolerance, moments, MOST, given=np.argsort(places), compiled=True, method=method
            )
            found = run.trajectory()
            spent.append(time.process_time() - begun)
        own = (METHODS[method].STAGES - 1) * found.steps
        explained = own * rates + (found.evaluations - own) * watched
        rows.append({
            "tolerance": tolerance, "cpu_s": min(spent), "evaluations": found.evaluations, "steps": found.steps,
            "events": found.events, "integrator": found.integrator, "explained": explained / min(spent),
        })  # fmt: skip
        print(f"{tolerance:7g} {1e3 * min(spent):7.2f} ms  {found.evaluations} evaluations, {found.events} events; "
              f"evaluations alone {100 * explained / min(spent):.0f} %", flush=True)  # fmt: skip
    return rows


def compiling() -> list[dict[str, float]]:
    """Of several first runs and what follows each."""
    rows = []
    for _ in range(ROUNDS):
        with tempfile.TemporaryDirectory() as folder:
            own = {**os.environ, "ABU_CALC_CACHE": folder}
            (library, first), (_, later) = (
                json.loads(
                    subprocess.run([sys.executable, "-c", FIRST], env=own, capture_output=True, check=True).stdout
                )
                for _ in range(2)
            )
        rows.append({"import_s": library, "compile_s": first, "load_s": later})
        print(f"import {library:.3f} s, compile {first:.2f} s, load {later:.3f} s", flush=True)
    return rows


def main() -> None:
    """Print both, and keep the record."""
    equations = equations_of(PRESET, SCENE)
    cases = {
        f"{PRESET} {SCENE}": prices(equations), f"{PRESET} {SCENE}, smooth": prices(smooth(PRESET).equations),
        "compiling for four balls with friction and contact": compiling(),
    }  # fmt: skip
    what = "what each digit costs in a scene that switches and in a smooth one, and what compiling costs"
    print(keep("price", what, "python -m tests.benchmarks.price", machine("not bound"), 0, cases))


if __name__ == "__main__":
    main()
