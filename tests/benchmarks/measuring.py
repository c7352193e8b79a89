"""How benchmarks are run, compared and kept: interleaved repeats, medians, times at equal error, records."""

import importlib.metadata
import itertools
import json
import math
import os
import platform
import random
import re
import statistics
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.errors import AbuError

Array = NDArray[np.float64]

RECORDS = Path(__file__).parent / "records"
ROUNDS = 7
LEAST_TIME = 0.01
"""Seconds of work between two looks at the clock; what is quicker is run several times in a row."""
LONGEST = 20.0
"""Seconds of one run above which it is measured once only."""
LIBRARIES = ("abu-calc", "numpy", "scipy", "llvmlite", "heyoka", "diffrax", "jax", "jaxlib", "mujoco")


@dataclass(frozen=True)
class Run:
    """One candidate at one setting (a tolerance, or steps per revolution). `go` gives coordinates and evaluations.

    Coordinates: those of the support and the ball angles, one column for each moment of the common grid.
    """

    candidate: str
    setting: float
    go: Callable[[], tuple[Array, int]]


@dataclass(frozen=True)
class Point:
    """What a run took and how far it was off; times are medians of the repeats [s].

    `error`: the largest over all moments of the errors of the ball angles [rad] and of the support's coordinates in
    units of their scale (m₀e/M for the axis). `first_s`: the very first run, with whatever is compiled or loaded.
    """

    candidate: str
    setting: float
    error: float
    evaluations: int
    cpu_s: float
    wall_s: float
    spread: float
    """Quartile range of the CPU times, relative to their median."""
    first_s: float
    repeats: int


def measure(runs: Sequence[Run], reference: Array, scales: Array, seed: int, rounds: int = ROUNDS) -> list[Point]:
    """Every run once per round, in an order that is shuffled anew each round, so that noise meets all alike."""
    found = []
    for run in runs:
        started = time.perf_counter()
        try:
            states, evaluations = run.go()
        except AbuError as failure:
            print(f"  {run.candidate} {run.setting:g}: {str(failure).splitlines()[0]}")
            found.append((math.inf, 0, math.inf, 1))
            continue
        first = time.perf_counter() - started
        started = time.perf_counter()
        if first < LONGEST:
            run.go()
        warm = time.perf_counter() - started if first < LONGEST else first
        error = float((np.abs(states - reference) / scales[:, None]).max())
        found.append((error, evaluations, first, max(1, math.ceil(LEAST_TIME / warm))))
    times: list[list[tuple[float, float]]] = [[] for _ in runs]
    order, shuffler = list(range(len(runs))), random.Random(seed)
    for _ in range(rounds):
        shuffler.shuffle(order)
        for k in order:
            if found[k][2] < LONGEST or (math.isfinite(found[k][0]) and not times[k]):
                times[k].append(_timed(runs[k].go, found[k][3]))
    points = []
    for run, (error, evaluations, first, _), spent in zip(runs, found, times, strict=True):
        if not spent:  # it failed: an infinite error says so
            points.append(Point(run.candidate, run.setting, error, 0, math.inf, math.inf, math.inf, first, 0))
            continue
        cpu, wall = ([pair[i] for pair in spent] for i in (0, 1))
        middle = statistics.median(cpu)
        low, high = np.quantile(cpu, (0.25, 0.75)).tolist()
        spread = (high - low) / middle
        taken = middle, statistics.median(wall), spread
        points.append(Point(run.candidate, run.setting, error, evaluations, *taken, first, len(cpu)))
    return points


def _timed(go: Callable[[], Any], number: int) -> tuple[float, float]:
    cpu, wall = time.process_time(), time.perf_counter()
    for _ in range(number):
        go()
    return (time.process_time() - cpu) / number, (time.perf_counter() - wall) / number


def names(points: Iterable[Point]) -> list[str]:
    """Of the candidates, in the order in which they were measured."""
    return list(dict.fromkeys(point.candidate for point in points))


def time_at(points: Iterable[Point], candidate: str, error: float) -> float | None:
    """CPU time [s] of a candidate at this error, by its work-precision curve, log over log; None if never so accurate.

    A setting that is more accurate than asked for counts with its own time where it is the cheapest that gets there.
    """
    curve = sorted((p for p in points if p.candidate == candidate and math.isfinite(p.error)), key=lambda p: p.cpu_s)
    reached = [p.cpu_s for p in curve if p.error <= error]
    between = [
        math.exp(
            math.log(a.cpu_s)
            + math.log(a.error / error) / math.log(a.error / b.error) * (math.log(b.cpu_s) - math.log(a.cpu_s))
        )
        for a, b in itertools.pairwise(curve)
        if a.error > error >= b.error > 0
    ]
    return min(reached + between, default=None)


def best(points: Sequence[Point], candidates: Iterable[str], error: float) -> tuple[float, str] | None:
    """The quickest of these candidates at this error, and its name."""
    found = [(spent, name) for name in candidates if (spent := time_at(points, name, error)) is not None]
    return min(found, default=None)


def pin() -> str:
    """Bind this process to one processor, where the system can, so that no candidate gains by threads; says what was
    done. To be called before anything that starts threads is imported.
    """
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[name] = "1"
    os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
    os.environ["JAX_PLATFORMS"] = "cpu"
    if not hasattr(os, "sched_setaffinity"):
        return "not bound: this system cannot"
    chosen = max(os.sched_getaffinity(0))
    os.sched_setaffinity(0, {chosen})
    return "bound to one processor"


def machine(pinned: str) -> dict[str, Any]:
    """What the numbers were measured on."""
    model, cpuinfo = platform.processor(), Path("/proc/cpuinfo")
    if cpuinfo.is_file():
        lines = cpuinfo.read_text(encoding="utf-8").splitlines()
        found = {k.strip(): v.strip() for k, _, v in (line.partition(":") for line in lines)}
        model = " ".join(found.get(key, "?") for key in ("model name",))
        model += f", family {found.get('cpu family', '?')}, model {found.get('model', '?')}"
    load = f"{os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "unknown"
    return {
        "cpu": model,
        "processors": os.cpu_count(),
        "system": platform.platform(),
        "python": platform.python_version(),
        "threads": pinned,
        "load_at_start": load,
    }


def versions() -> dict[str, str]:
    """Of the libraries; those that are not installed are named so."""
    found = {}
    for name in LIBRARIES:
        try:
            found[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            found[name] = "not installed"
    return found


def keep(name: str, what: str, command: str, where: dict[str, Any], seed: int, cases: dict[str, Any]) -> Path:
    """Write a record; an earlier one of this name is replaced."""
    RECORDS.mkdir(exist_ok=True)
    record = {
        "what": what,
        "command": command,
        "date": datetime.now(UTC).strftime("%Y-%m-%d"),
        "machine": where,
        "versions": versions(),
        "seed": seed,
        "rounds": ROUNDS,
        "cases": cases,
    }
    path = RECORDS / f"{name}.json"
    text = json.dumps(_rounded(record), indent=1, ensure_ascii=False)
    # What holds no more braces or brackets stands on one line, so that a point is a line.
    text = re.sub(r"[{\[][^{}\[\]]*[}\]]", lambda found: " ".join(found[0].split()), text)
    path.write_text(text + "\n", encoding="utf-8")
    return path


def _rounded(value: Any) -> Any:
    """Four digits are more than a time is worth."""
    if isinstance(value, Point):
        return _rounded(asdict(value))
    if isinstance(value, float):
        return float(f"{value:.4g}") if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _rounded(one) for key, one in value.items()}
    return [_rounded(one) for one in value] if isinstance(value, list | tuple) else value
