"""Records what many machines cost: `python -m tests.benchmarks.sweep` (10 000 members; a quarter of an hour or so).

`--members N` for fewer, `--others N` for the ways beside two processes; `--cluster` also by a local Dask cluster. Of
each way the time of the clock and of all processors together: other work on the machine lengthens the first only.
"""

import argparse
import json
import os
import platform
import sqlite3
import tempfile
import time
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from typing import Any

import abu_calc
from abu_calc.features.sweep.execution import versions

RECORD = Path(__file__).parent / "records" / "sweep.json"
PRESET = "avtovaz-707-222"


def measured(members: int, folder: Path, **how: Any) -> dict[str, Any]:
    """One sweep: members a second, and the store's size."""
    store = folder / f"{time.monotonic_ns()}.sqlite"
    begun, used = time.perf_counter(), _used()
    found = abu_calc.sweep(abu_calc.read(PRESET), runs=members, tolerances=True, store=store, **how)
    wall, processors = time.perf_counter() - begun, _used() - used
    database = sqlite3.connect(store)
    rows = database.execute("SELECT * FROM members ORDER BY member").fetchall()
    database.close()
    return {
        "members": members,
        "wall_s": round(wall, 1),
        "processor_s": round(processors, 1),
        "processor_ms_per_member": round(1e3 * processors / members, 2),
        "failed": found.failed.members,
        "store_bytes_per_member": round(store.stat().st_size / members),
        "share_that_meets_the_limits": found.meets_limits.share,
        "digest": sha256(repr(rows).encode()).hexdigest()[:16],
    }


def _used() -> float:
    """Time of all processors, that of processes which ended among it [s]."""
    return sum(os.times()[:4])


def main() -> None:
    """Measure and write the record."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--members", type=int, default=10_000)
    parser.add_argument("--others", type=int, default=2_000)
    parser.add_argument("--cluster", action="store_true")
    parser.add_argument("--record", type=Path, default=RECORD)
    asked = parser.parse_args()
    ways: dict[str, Callable[[Path], dict[str, Any]]] = {
        "warm-up, one process": lambda folder: measured(20, folder),
        "two processes": lambda folder: measured(asked.members, folder, workers=2),
        "one process, fewer": lambda folder: measured(asked.others, folder),
        "two processes, fewer": lambda folder: measured(asked.others, folder, workers=2),
    }
    if asked.cluster:
        ways["Dask, two workers, fewer"] = lambda folder: _dask(asked.others, folder)
    found: dict[str, Any] = {"machine": _machine(), "versions": versions("llvmlite", "distributed")}
    for name, way in ways.items():
        with tempfile.TemporaryDirectory() as folder:
            load = os.getloadavg()[0]
            found[name] = {**way(Path(folder)), "load_before": round(load, 1)}
        print(name, found[name], flush=True)
        asked.record.write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")


def _dask(members: int, folder: Path) -> dict[str, Any]:
    from distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        return measured(members, folder, executor=client.get_executor(pure=False))


def _machine() -> str:
    return f"{os.cpu_count()} processors, {platform.system()} {platform.machine()}, Python {platform.python_version()}"


if __name__ == "__main__":
    main()
