"""Error against time of the library's own integrators where no peer can follow, and what the envelope saves.

    python -m tests.benchmarks.work_precision [friction] [contact] [resonance] [balls] [envelope]

Balls that stick by dry friction, wheel and work that touch and part, a swing arm in resonance, 2 to 64 balls, and the
envelope against the equations at an error of 1 % on the presets. The presets idling, with peers, are in `peers`.
"""

import sys

from tests.benchmarks import peers  # first: it binds the process before anything starts threads

# isort: split

import statistics
import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from scipy import integrate

from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.scene import Scene, without
from abu_calc.foundation.errors import AbuError
from abu_calc.simulation.model_level import QUANTITIES, Measures, averaged
from abu_calc.simulation.response import evaluate, needed_times
from tests.benchmarks.by_hand import planar, pressed_to_work, with_floats
from tests.benchmarks.cases import BALLS, Case, contact, friction, many_balls, presets, resonance, smooth
from tests.benchmarks.measuring import ROUNDS, Array, Run, keep, machine, measure, names, time_at

SEED = 20240602
TARGETS = (1e-3, 1e-4, 1e-6, 1e-8)
EXPLICIT = tuple(10.0**-k for k in range(3, 11))
COSTLY = {"scipy-rk45": 5, "scipy-lsoda": 5, "scipy-radau": 3, "scipy-bdf": 3}
"""Of these methods only every second tolerance, and only so many decades."""
FEW = (1e-4, 1e-6, 1e-8, 1e-10)
SCRIPTS = ("solve_ivp DOP853", "odeint", "ode dop853", "arrays: solve_ivp DOP853", "diffrax Dopri8")
"""Peers that are worth their time for many balls."""
ACCURACY = 0.01
LOOSE = (0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6)


def every_integrator(case: Case) -> list[Run]:
    """All that the library has for a case; slow ones at few tolerances."""
    found = []
    for name in choice.available(case.equations):
        settings = EXPLICIT[: COSTLY[name] : 2] if name in COSTLY else EXPLICIT
        found += [case.run(name, tolerance) for tolerance in settings]
    return found


def contact_scripts(case: Case) -> list[Run]:
    """What a script does about the contact: max(0, …) in the equations, and the step size control finds out."""
    pressing = case.scene.effect("grinding_contact")
    r = planar(without(case.scene, ["grinding_contact"]))
    if r is None or not isinstance(pressing, GrindingContactEffect):
        return []
    rhs, scales = with_floats(r, pressed_to_work(pressing)), np.array(case.equations.scales)

    def go(tolerance: float) -> tuple[Array, int]:
        done = integrate.solve_ivp(
            rhs, (0.0, float(case.moments[-1])), np.array(case.equations.initial), method="DOP853",
            t_eval=case.moments, rtol=tolerance, atol=tolerance * scales,
        )  # fmt: skip
        return np.asarray(done.y[case.rows]), int(done.nfev)

    return [Run("script, max(0, N)", tolerance, partial(go, tolerance)) for tolerance in EXPLICIT]


def ball_runs(case: Case) -> list[Run]:
    """The library and the peers, at few tolerances."""
    r = planar(case.scene)
    runs = peers.own_runs(case) + (peers.script_runs(case, r, implicit=False) if r else [])
    runs += peers.diffrax_runs(case, r) if r and peers.installed("diffrax") else []
    return [run for run in runs if run.setting in FEW and run.candidate.startswith(("abu-calc", *SCRIPTS))]


def study(case: Case, runs: Sequence[Run]) -> dict[str, Any]:
    """Measure one case and tell it."""
    reference, apart = case.reference()
    points = measure(runs, reference, case.scales, SEED)
    turns = case.scene.duration / case.scene.revolution
    events = _events(case)
    print(f"\n{case.name}: {turns:.0f} revolutions, {events} events, reference good to {apart:.0e}", flush=True)
    print(f"  {'ms at an error of':28}" + "".join(f"{target:>9.0e}" for target in TARGETS))
    table = {name: [time_at(points, name, target) for target in TARGETS] for name in names(points)}
    for name, row in table.items():
        print(f"  {name:28}" + "".join(f"{1e3 * t:9.1f}" if t is not None else f"{'—':>9}" for t in row))
    return {
        "revolutions": turns,
        "events": events,
        "reference_agrees_to": apart,
        "errors": TARGETS,
        "seconds_at_errors": table,
        "points": points,
    }


def _events(case: Case) -> int:
    return scipy_.integrate(case.equations, 1e-8, case.moments).events


def envelope_study(scene: Scene, name: str) -> dict[str, Any]:
    """For each quantity the loosest envelope (by LSODA) and the loosest equations (by DOP853) that reach 1 %.

    Times include evaluation, alike for both; where no envelope gets there, its loosest one of nearly its best error
    is told instead.
    """
    moments, equations = needed_times(scene), assemble(scene)

    def integrated(tolerance: float) -> Measures:
        return evaluate(scene, scipy_.integrate(equations, tolerance, moments))

    def slow(tolerance: float) -> Measures:
        return averaged(scene, tolerance)

    truth = integrated(1e-10)
    told = {way: {tolerance: way(tolerance) for tolerance in LOOSE} for way in (slow, integrated)}
    found = {}
    for quantity, off in QUANTITIES.items():
        errors = {way: {t: off(scene, one, truth) for t, one in ways.items()} for way, ways in told.items()}
        one, other = _loosest(errors[slow]), _loosest(errors[integrated])
        times = [(_cpu(partial(slow, one)), _cpu(partial(integrated, other))) for _ in range(ROUNDS)]
        quick, full = (statistics.median(column) for column in zip(*times, strict=True))
        error = errors[slow][one]
        found[quantity] = {
            "envelope": {"tolerance": one, "error": error, "cpu_s": quick},
            "equations": {"tolerance": other, "error": errors[integrated][other], "cpu_s": full},
            "reaches_1_percent": error <= ACCURACY,
            "ratio": full / quick,
        }
        verdict = "" if error <= ACCURACY else "   envelope does not reach 1 %"
        print(f"  {name:20} {quantity:10} envelope {1e3 * quick:6.1f} ms, off by {error:7.2g}, "
              f"equations {1e3 * full:6.1f} ms; ratio {full / quick:5.1f}{verdict}", flush=True)  # fmt: skip
    return found


def _loosest(errors: dict[float, float]) -> float:
    """The loosest tolerance from which on all errors are below 1 %, or else not far above the last."""
    most, chosen = max(ACCURACY, 1.1 * errors[min(errors)]), min(errors)
    for tolerance in sorted(errors):
        if errors[tolerance] > most:
            break
        chosen = tolerance
    return chosen


def _cpu(work: Callable[[], Any]) -> float:
    started = time.process_time()
    work()
    return time.process_time() - started


def envelopes() -> dict[str, Any]:
    """Of all presets."""
    print("\nat an error of 1 %")
    found = {}
    for name in presets():
        try:
            found[name] = envelope_study(smooth(name).scene, name)
        except AbuError as failure:
            found[name] = {"not_averaged": str(failure)}
            print(f"  {name}: {failure}")
    return found


def main(wanted: Sequence[str]) -> None:
    """Measure what is asked for, or all, and keep it; each part has a record of its own."""
    where = machine(peers.PINNED)
    parts: dict[str, Callable[[], dict[str, Any]]] = {
        "friction": lambda: {"friction": study(one := friction(), every_integrator(one))},
        "contact": lambda: {"contact": study(one := contact(), every_integrator(one) + contact_scripts(one))},
        "resonance": lambda: {"resonance": study(one := resonance(), every_integrator(one))},
        "balls": lambda: {str(n): study(one := many_balls(n), ball_runs(one)) for n in BALLS},
        "envelope": envelopes,
    }
    for name in wanted or parts:
        cases = parts[name]()
        command = f"python -m tests.benchmarks.work_precision {name}"
        print(f"kept in {keep(name, 'error against CPU time, medians', command, where, SEED, cases)}")


if __name__ == "__main__":
    main(sys.argv[1:])
