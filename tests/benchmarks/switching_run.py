"""One integrator on one machine's scene at several tolerances, in whichever abu-calc this Python has; JSON lines.

    python switching_run.py PRESET SCENE INTEGRATOR FOLDER TOLERANCE ...

It is run as a file, so that the tests' own package is not needed; older versions have other names for the same things.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.scene import with_parted_balls
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation import response
from abu_calc.simulation.scene_of_design import scene_of_design
from abu_calc.sizing import size

MOST, LONG, REPEATS = 12_000_000, 1.0, 3
"""Evaluations of a run, seconds beyond which it is not repeated, and how often others are."""


def equations_of(preset: str, which: str):  # type: ignore[no-untyped-def]
    """A machine's scene with all its effects."""
    read = read_machine(preset)
    tables = read.whole("simulate") if hasattr(read, "whole") else read.machine
    return assemble(with_parted_balls(scene_of_design(size(tables), which))[0])


def main() -> None:
    """A line for each tolerance; states at the moments that a response needs go to files."""
    preset, which, way, folder, *tolerances = sys.argv[1:]
    equations = equations_of(preset, which)
    times = getattr(response, "needed_times", None) or response.needed_moments  # type: ignore[attr-defined]
    moments = times(equations.scene)
    for tolerance in map(float, tolerances):
        spent = []
        while len(spent) < REPEATS and (not spent or spent[-1] < LONG):
            begun = time.process_time()
            found = choice.integrate_with(way, equations, tolerance, moments, MOST)
            spent.append(time.process_time() - begun)
        file = Path(folder) / f"{preset}-{which}-{way}-{tolerance:g}.npy"
        np.save(file, found.y)
        line = {
            "tolerance": tolerance, "cpu_s": min(spent), "first_s": spent[0], "repeats": len(spent),
            "evaluations": found.evaluations, "steps": found.steps, "events": found.events, "states": str(file),
        }  # fmt: skip
        print(json.dumps(line), flush=True)


if __name__ == "__main__":
    main()
