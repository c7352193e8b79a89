"""Sweeps that are killed, again and again, and go on to the same members."""

import ctypes
import importlib.util
import os
import random
import signal
import sqlite3
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

import abu_calc
from abu_calc.features.sweep.batches import ENDED, Row, given, in_batches
from abu_calc.features.sweep.samples import limited

RUNS, FEW = 60, 24
SWEEP = [sys.executable, "-m", "abu_calc", "sweep", "avtovaz-707-222", "--tolerances", "--runs", str(RUNS), "--quiet"]


def rows(store: Path) -> list[Any]:
    database = sqlite3.connect(store)
    try:
        return database.execute("SELECT * FROM members ORDER BY member").fetchall()
    except sqlite3.OperationalError:  # killed before there were tables
        return []
    finally:
        database.close()


def members(runs: int, store: Path) -> list[Any]:
    """Of a sweep that nobody interrupts."""
    abu_calc.sweep(abu_calc.read("avtovaz-707-222"), runs=runs, tolerances=True, store=store)
    return rows(store)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> list[Any]:
    return members(RUNS, tmp_path_factory.mktemp("whole") / "members.sqlite")


@pytest.mark.hard
@pytest.mark.parametrize("workers", [1, 2])
def test_twenty_kills_leave_the_same_members(whole: list[Any], tmp_path: Path, workers: int) -> None:
    store, draw, kept = tmp_path / "members.sqlite", random.Random(workers), 0
    command = [*SWEEP, "--store", str(store), "--resume", "--workers", str(workers)]
    for _ in range(10):
        process = subprocess.Popen(command)
        before, until = kept, time.monotonic() + draw.uniform(0.5, 12)
        # At any moment; but where nothing has come yet, only every other time.
        patient = draw.random() < 0.5
        while process.poll() is None and (time.monotonic() < until or (patient and kept == before)):
            time.sleep(0.05)
            kept = len(rows(store)) if store.exists() else 0
        process.kill()
        process.wait()
        there = rows(store) if store.exists() else []
        assert there == [row for row in whole if row[0] in {one[0] for one in there}]
        assert len(there) >= before
        kept = len(there)
    assert subprocess.run(command, check=False).returncode == 0
    assert rows(store) == whole


@pytest.mark.slow
def test_ctrl_c_leaves_a_store_to_go_on_with(tmp_path: Path) -> None:
    store, whole = tmp_path / "members.sqlite", members(FEW, tmp_path / "whole.sqlite")
    command = [*SWEEP, "--runs", str(FEW), "--store", str(store), "--workers", "2"]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    while not store.exists() or not rows(store):
        time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=120)
    if process.returncode == 130:  # it may have been done already
        assert "--resume" in told and "Traceback" not in told
    assert subprocess.run([*command, "--resume"], check=False).returncode == 0
    assert rows(store) == whole


@pytest.mark.slow
@pytest.mark.skipif(importlib.util.find_spec("distributed") is None, reason="the extra `cluster` is not installed")
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_whose_worker_is_killed_gives_the_same_members(whole: list[Any], tmp_path: Path) -> None:
    from distributed import Client, LocalCluster

    store, killed = tmp_path / "members.sqlite", []
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        processes = list(client.run(os.getpid).values())

        def kill(text: str) -> None:
            if not killed and "samples" in text:
                killed.append(processes[0])
                os.kill(processes[0], signal.SIGKILL)

        abu_calc.sweep(
            abu_calc.read("avtovaz-707-222"), runs=RUNS, tolerances=True, store=store,
            executor=client.get_executor(pure=False), progress=kill,
        )  # fmt: skip
    assert killed and rows(store) == whole


@dataclass(frozen=True)
class Stuck:
    """A study with a member whose code never returns to Python, nor lets other threads run."""

    member: int

    def rows(self, members: tuple[int, ...], may_end_process: bool = False) -> tuple[list[Row], float]:
        for member in members:
            with limited(0.5, may_end_process=may_end_process):
                if member == self.member:
                    ctypes.PyDLL(None).pause()
        return [(member, member**2) for member in members], 0.01 * len(members)

    def lost(self, member: int, reason: str) -> Row:
        return (member, reason)


@pytest.mark.slow
@pytest.mark.skipif(importlib.util.find_spec("distributed") is None, reason="the extra `cluster` is not installed")
@pytest.mark.skipif(os.name == "nt", reason="no such call there")
@pytest.mark.filterwarnings("ignore")
def test_a_member_that_never_returns_is_passed_over_on_a_cluster() -> None:
    """Its worker ends, the cluster starts another, and after some of them the member is recorded."""
    from distributed import Client, LocalCluster

    from abu_calc.features.sweep.execution import is_ours_to_end

    found: list[Row] = []
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        executor = client.get_executor(pure=False)
        assert is_ours_to_end(executor)
        in_batches(Stuck(7), iter(range(20)), given(executor, 2, ends=True), found.extend, size=4)
    assert dict(found) == {k: k**2 if k != 7 else ENDED for k in range(20)}  # type: ignore[arg-type]
