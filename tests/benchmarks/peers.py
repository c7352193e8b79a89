"""The library against peers on the same planar equations: scripts written by hand for SciPy, diffrax,
heyoka, MuJoCo.

    python -m tests.benchmarks.peers [PRESET …]

All integrate the presets idling (support, imbalance, balls, offset race, gravity), hand over 51 moments, and are held
against one reference. Peers that are not installed are named and left out; ratios are of CPU times on one processor.
"""

import sys

from tests.benchmarks import measuring

PINNED = measuring.pin()

import importlib  # noqa: E402
import importlib.util  # noqa: E402
import json  # noqa: E402
from collections.abc import Callable, Sequence  # noqa: E402
from functools import partial  # noqa: E402
from pathlib import Path  # noqa: E402
from typing import Any, cast  # noqa: E402

import numpy as np  # noqa: E402
from scipy import integrate  # noqa: E402

from tests.benchmarks.by_hand import (  # noqa: E402
    Planar,
    diffrax_solver,
    heyoka_solver,
    in_units,
    mujoco_runner,
    planar,
    with_arrays,
    with_floats,
)
from tests.benchmarks.cases import Case, presets, smooth  # noqa: E402
from tests.benchmarks.measuring import Array, Point, Run, best, measure, names  # noqa: E402

SEED = 20240601
TARGETS = (1e-4, 1e-6, 1e-8)
PICTURED = "avtovaz-707-222"
PICTURE = Path(__file__).parent / "work-precision.png"

TOLERANCES = tuple(10.0**-k for k in range(3, 14))
"""From 1e-3 to 1e-13."""
HEYOKA = TOLERANCES[2:-1:2]
"""Each is compiled anew, for a second or two."""
STEPS = (25, 50, 100, 200, 400, 800)
"""Of MuJoCo per revolution."""

KINDS = {
    "abu-calc": ("#c1272d", "o", 2.2),
    "solve_ivp": ("#4a6fa5", "s", 1.0),
    "ode": ("#2a9d8f", "^", 1.0),
    "arrays": ("#808080", "x", 1.0),
    "diffrax": ("#e08e0b", "D", 1.0),
    "MuJoCo": ("#7b5ea7", "v", 1.0),
    "heyoka": ("#111111", "P", 1.0),
}
"""Color, marker and width in the picture, by what a candidate's name starts with."""
STYLES = ("-", "--", ":", "-.", (0, (5, 1)), (0, (1, 3)))

Rhs = Callable[[Any, Any], Any]


def installed(name: str) -> bool:
    """Whether a library is there."""
    return importlib.util.find_spec(name) is not None


def own_runs(case: Case) -> list[Run]:
    """The library, by its loop and by explicit methods of SciPy."""
    found = [case.run("scipy-dop853", tolerance) for tolerance in TOLERANCES[:-2]]
    found += [case.run(name, tolerance) for name in ("scipy-rk45", "scipy-lsoda") for tolerance in TOLERANCES[:7]]
    # The reference is the loop's at 1e-13: to hold that against itself would tell nothing.
    return found + [case.run(f"compiled-{name}", tol) for name in ("dop853", "rk45") for tol in TOLERANCES[:-1]]


def _rows(case: Case, states: Array) -> Array:
    return np.asarray(states)[case.rows]


def script_runs(case: Case, r: Planar, *, implicit: bool) -> list[Run]:
    """Scripts with each of SciPy's ways in: `solve_ivp`, `odeint`, `ode`; both ways to write the equations."""
    start, moments = np.array(case.equations.initial), case.moments
    end, scales = float(moments[-1]), np.array(case.equations.scales)
    floats, arrays = with_floats(r), with_arrays(r)

    def ivp(rhs: Rhs, method: str, tolerance: float) -> tuple[Array, int]:
        done = integrate.solve_ivp(
            rhs, (0.0, end), start, method=cast(Any, method), t_eval=moments, rtol=tolerance, atol=tolerance * scales
        )
        return _rows(case, done.y), int(done.nfev)

    def odeint(rhs: Rhs, tolerance: float) -> tuple[Array, int]:
        absolute: Any = tolerance * scales  # an array is accepted, though the type stubs know numbers only
        y, info = integrate.odeint(
            rhs, start, moments, rtol=tolerance, atol=absolute, mxstep=10**6, tfirst=True, full_output=True
        )
        return _rows(case, y.T), int(info["nfe"][-1])

    # Its tolerance is one number for all states, so that the equations have to be in units that suit them.
    length, radian = float(scales[0]), 1 / case.scene.speed
    dimensionless = with_floats(in_units(r, length, radian))
    units = np.ones(len(scales))
    units[:2], units[2:4], units[4 + r.n :] = length, length / radian, 1 / radian

    def ode(tolerance: float) -> tuple[Array, int]:
        calls = 0

        def counted(t: float, y: Array) -> list[float]:
            nonlocal calls
            calls += 1
            return dimensionless(t, y)

        solver = integrate.ode(counted)
        solver.set_integrator("dop853", rtol=tolerance, atol=tolerance, nsteps=10**6)
        solver.set_initial_value(start / units, 0.0)
        columns = [start / units, *(solver.integrate(t) for t in (moments[1:] / radian).tolist())]
        return _rows(case, np.array(columns).T * units[:, None]), calls

    found = []
    for tolerance in TOLERANCES[:-1]:
        found.append(Run("solve_ivp DOP853", tolerance, partial(ivp, floats, "DOP853", tolerance)))
        found.append(Run("solve_ivp LSODA", tolerance, partial(ivp, floats, "LSODA", tolerance)))
        found.append(Run("odeint", tolerance, partial(odeint, floats, tolerance)))
        found.append(Run("ode dop853", tolerance, partial(ode, tolerance)))
        found.append(Run("arrays: solve_ivp DOP853", tolerance, partial(ivp, arrays, "DOP853", tolerance)))
        found.append(Run("arrays: odeint", tolerance, partial(odeint, arrays, tolerance)))
    found += [Run("solve_ivp RK45", tol, partial(ivp, floats, "RK45", tol)) for tol in TOLERANCES[:8]]
    for method in ("Radau", "BDF") if implicit else ():
        found += [Run(f"solve_ivp {method}", tol, partial(ivp, floats, method, tol)) for tol in (1e-3, 1e-5, 1e-7)]
    return found


def diffrax_runs(case: Case, r: Planar) -> list[Run]:
    """Two methods of diffrax in float64, compiled as a whole; the first run of each has the compilation in it."""
    start, scales, found = np.array(case.equations.initial), np.array(case.equations.scales), []
    for solver in ("Dopri8", "Tsit5"):
        solve = diffrax_solver(r, solver, case.moments)

        def go(tolerance: float, solve: Any = solve) -> tuple[Array, int]:
            states, evaluations = solve(start, tolerance, tolerance * scales)
            return _rows(case, states), evaluations

        settings = TOLERANCES[: 10 if solver == "Dopri8" else 8]
        found += [Run(f"diffrax {solver}", tolerance, partial(go, tolerance)) for tolerance in settings]
    return found


def heyoka_runs(case: Case, r: Planar) -> list[Run]:
    """Taylor series of high order, compiled for each tolerance."""
    length, radian = float(case.scales[0]), 1 / case.scene.speed
    units, found = np.ones(4 + 2 * r.n), []
    units[:2], units[2:4], units[4 + r.n :] = length, length / radian, 1 / radian
    start = np.array(case.equations.initial) / units

    for tolerance in HEYOKA:
        solve = heyoka_solver(in_units(r, length, radian), tolerance, case.moments / radian)

        def go(solve: Any = solve) -> tuple[Array, int]:
            states, evaluations = solve(start)
            return _rows(case, states * units[:, None]), evaluations

        found.append(Run("heyoka", tolerance, go))
    return found


def mujoco_runs(case: Case, r: Planar) -> list[Run]:
    """Two integrators of MuJoCo at constant steps; `setting` is steps per revolution."""
    turns = case.scene.duration / case.scene.revolution / (len(case.moments) - 1)
    found = []
    for integrator in ("RK4", "implicitfast"):
        for steps in STEPS:
            per_interval = max(1, round(steps * turns))
            go = mujoco_runner(r, integrator, per_interval, case.moments, case.equations.initial)
            found.append(Run(f"MuJoCo {integrator}", per_interval / turns, go))
    return found


def study(case: Case) -> dict[str, Any] | None:
    """All candidates on one case; None where the equations by hand are not for it."""
    r = planar(case.scene)
    if r is None:
        return None
    runs = own_runs(case) + script_runs(case, r, implicit=case.name == PICTURED)
    runs += diffrax_runs(case, r) if installed("diffrax") else []
    runs += heyoka_runs(case, r) if installed("heyoka") else []
    runs += mujoco_runs(case, r) if installed("mujoco") else []
    reference, apart = case.reference()
    points = measure(runs, reference, case.scales, SEED)
    return {
        "revolutions": case.scene.duration / case.scene.revolution,
        "balls": r.n,
        "reference_agrees_to": apart,
        "at_equal_error": [verdict(points, target) for target in TARGETS],
        "points": points,
    }


def verdict(points: Sequence[Point], target: float) -> dict[str, Any]:
    """Times [s] of everybody at one error, the best of each library, and the ratios that are asked for."""
    everybody = names(points)

    def quickest(*starts: str) -> tuple[float, str] | None:
        return best(points, [name for name in everybody if name.startswith(starts)], target)

    loop, ours = quickest("abu-calc compiled"), quickest("abu-calc scipy")
    scripts, arrays = quickest("solve_ivp", "odeint", "ode "), quickest("arrays")

    def over(one: tuple[float, str] | None, other: tuple[float, str] | None) -> float | None:
        return one[0] / other[0] if one and other else None

    return {
        "error": target,
        "seconds": {name: measuring.time_at(points, name, target) for name in everybody},
        "best_script": scripts and scripts[1],
        "the loop is quicker than": {
            "the best script": over(scripts, loop),
            "the best script by arrays": over(arrays, loop),
            "abu-calc with SciPy": over(ours, loop),
            "diffrax": over(quickest("diffrax"), loop),
            "MuJoCo": over(quickest("MuJoCo"), loop),
            "heyoka": over(quickest("heyoka"), loop),
        },
        "abu-calc with SciPy is slower than": {
            "the best script": over(ours, scripts),
            "DOP853 by plain floats": over(ours, quickest("solve_ivp DOP853")),
            "DOP853 by arrays": over(ours, quickest("arrays: solve_ivp DOP853")),
        },
    }


def tell(name: str, found: dict[str, Any]) -> None:
    """The verdicts of a case as a table."""
    print(f"\n{name}: {found['balls']} balls, {found['revolutions']:.0f} revolutions, "
          f"reference good to {found['reference_agrees_to']:.0e}")  # fmt: skip
    columns = [row["seconds"] for row in found["at_equal_error"]]
    print(f"  {'ms at an error of':28}" + "".join(f"{target:>9.0e}" for target in TARGETS))
    for candidate in columns[0]:
        times = [column[candidate] for column in columns]
        cells = [f"{1e3 * value:9.1f}" if value is not None else f"{'—':>9}" for value in times]
        print(f"  {candidate:28}" + "".join(cells))
    for key in (key for key in found["at_equal_error"][0] if " than" in key):
        print(f"  {key}")
        for other in found["at_equal_error"][0][key]:
            ratios = [row[key][other] for row in found["at_equal_error"]]
            print(f"    {other:26}" + "".join(f"{ratio:9.2f}" if ratio else f"{'—':>9}" for ratio in ratios))


def picture(found: dict[str, Any], points: Sequence[Point], name: str) -> None:
    """Error against time, one curve for each candidate, down to where the reference is not sure itself."""
    if not installed("matplotlib"):
        print("no picture: matplotlib is not installed")
        return
    matplotlib = importlib.import_module("matplotlib")
    matplotlib.use("Agg")
    pyplot = importlib.import_module("matplotlib.pyplot")
    figure, axes = pyplot.subplots(figsize=(8.4, 4.4))
    seen: dict[str, int] = {}
    for candidate in names(points):
        curve = sorted((p for p in points if p.candidate == candidate and p.error < 1), key=lambda p: p.cpu_s)
        color, marker, width = next(kind for start, kind in KINDS.items() if candidate.startswith(start))
        style = STYLES[seen.setdefault(color, 0)]
        seen[color] += 1
        times, errors = [1e3 * p.cpu_s for p in curve], [p.error for p in curve]
        axes.loglog(times, errors, color=color, marker=marker, ms=3, lw=width, linestyle=style, label=candidate)
    axes.set(xlabel="CPU time on one processor, warm [ms]", ylabel="largest error [rad, m₀e/M]")
    axes.set_ylim(found["reference_agrees_to"], 1)
    axes.set_title(f"{name} idling, {found['revolutions']:.0f} revolutions: lower left is better", fontsize=10)
    axes.grid(True, which="major", alpha=0.3)
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.01, 0.5))
    figure.tight_layout()
    figure.savefig(PICTURE, dpi=90)


def again() -> None:
    """Tables and picture from the record, without measuring."""
    record = json.loads((measuring.RECORDS / "peers.json").read_text(encoding="utf-8"))
    for name, found in record["cases"].items():
        tell(name, found)
        if name == PICTURED:
            points = [Point(**point) for point in found["points"]]
            picture(found, points, name)


def main(wanted: Sequence[str]) -> None:
    """Measure, tell, and keep."""
    for name in ("heyoka", "diffrax", "mujoco"):
        if not installed(name):
            print(f"left out: {name} is not installed")
    cases, where = {}, measuring.machine(PINNED)
    for name in wanted or presets():
        found = study(smooth(name))
        if found is None:
            print(f"left out: {name} is not a planar mass on springs")
            continue
        cases[name] = found
        tell(name, found)
    what = "whole runs at equal error, library and peers on the same planar equations; seconds of CPU, medians"
    command = "python -m tests.benchmarks.peers"
    print(f"\nkept in {measuring.keep('peers', what, command, where, SEED, cases)}")
    if PICTURED in cases:
        picture(cases[PICTURED], cases[PICTURED]["points"], PICTURED)


if __name__ == "__main__":
    again() if sys.argv[1:] == ["--again"] else main(sys.argv[1:])
