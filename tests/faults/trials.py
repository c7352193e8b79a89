"""Trials of a sweep that something goes wrong with: each leaves the members that it should, or says that it cannot.

A trial is drawn by its number alone. It damages, fills, kills or interrupts one sweep, goes on with its store, and
compares the members with those of a sweep that nothing happened to.
"""

import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from abu_calc.features.sweep.store import Store
from tests.cli.runner import Seen, abu
from tests.faults.aim import aimed
from tests.faults.clusters import cluster
from tests.faults.stores import MEMBERS, corrupt, edit, members_of
from tests.inputs.scenes import LIGHT_BALLS

SCENE = (
    LIGHT_BALLS.replace("300.0", "100.0")
    + """\
[sweep]
runs = 16
[sweep.vary]
"start.angle_deg" = "uniform(-90, 90)"
"scene.speed_rpm" = "uniform(6, 24)"
"""
)
MODULES = (
    "sqlite3",
    "numpy",
    "numpy.linalg",
    "numpy.random",
    "scipy",
    "scipy._lib._ccallback",
    "scipy.special",
    "scipy.special._ufuncs",
    "scipy.stats",
    "scipy.stats._qmc",
    "scipy.linalg",
    "scipy.linalg._fblas",
    "scipy.sparse",
    "scipy.optimize",
    "scipy.integrate",
    "scipy.integrate._vode",
    "scipy.spatial",
    "scipy.interpolate",
    "pydantic",
    "pydantic_core",
    "typer",
    "tomllib",
    "uuid",
    "abu_calc.cli.app",
    "abu_calc.features.sweep.command",
    "abu_calc.features.sweep.study",
    "abu_calc.features.sweep.store",
    "abu_calc.features.sweep.answers",
    "abu_calc.simulation.scene_file",
    "abu_calc.dynamics.equations.assemble",
    "abu_calc.dynamics.integrators.choice",
    "abu_calc.features.sweep.view",
    "concurrent.futures",
    "abu_calc.features.sweep.samples",
    "abu_calc.simulation.scene_of_file",
)
"""Modules that a sweep loads, some of them while it computes its first members."""
ENDED = {"SIGINT": {130, -signal.SIGINT}, "SIGTERM": {143, -signal.SIGTERM}}
PATIENCE_S = 300.0
ROOT = Path(__file__).parents[2]
"""Whose package all processes run."""


@dataclass
class Tally:
    """Outcome of trials: rows lost or wrong, errors told as bugs, signals without effect, and each failure."""

    trials: dict[str, int] = field(default_factory=dict)
    statuses: dict[str, int] = field(default_factory=dict)
    lost: int = 0
    wrong: int = 0
    bugs: int = 0
    ignored: int = 0
    failures: list[str] = field(default_factory=list)

    def see(self, what: str, status: int, stderr: str) -> None:
        """One command that ended."""
        self.statuses[str(status)] = self.statuses.get(str(status), 0) + 1
        if "this is a bug" in stderr or "Traceback" in stderr:
            self.bugs += 1
            self.failures.append(f"{what}: told as a bug: {stderr[-300:]}")


class Faults:
    """Trials in one folder; `whole`: the members of a sweep that nothing happened to."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.tally = folder, Tally()
        self.scene = folder / "scene.toml"
        self.scene.write_text(SCENE, encoding="utf-8")
        self.store = folder / "whole.sqlite"
        assert abu(*self.words(self.store)).status == 0
        self.whole = members_of(self.store)
        assert len(self.whole) == MEMBERS

    def words(self, store: Path, *more: str) -> tuple[str, ...]:
        """The sweep into that store."""
        return "sweep", str(self.scene), "--quiet", "--workers", "1", "--store", str(store), *more

    def trial(self, number: int) -> None:
        """The trial of that number."""
        draw = random.Random(number)
        folder = self.folder / str(number)
        folder.mkdir()
        name = draw.choices(list(KINDS), weights=[weight for _, weight in KINDS.values()])[0]
        self.tally.trials[name] = self.tally.trials.get(name, 0) + 1
        try:
            KINDS[name][0](self, folder, draw, f"{number} {name}")
        except Exception as error:  # the harness goes on; the failure is kept
            self.tally.failures.append(f"{number} {name}: {error!r}")
        shutil.rmtree(folder, ignore_errors=True)

    def go_on(self, store: Path, what: str) -> None:
        """Go on with the store: afterwards all members are there, bit for bit."""
        seen = abu(*self.words(store, "--resume"))
        self.tally.see(what, seen.status, seen.err)
        self.compare(store, seen, what)

    def compare(self, store: Path, seen: Seen, what: str) -> None:
        """Count rows that are lost or wrong, of a run that says it has them all."""
        if seen.status not in (0, 1):
            self.tally.lost += MEMBERS
            self.tally.failures.append(f"{what}: status {seen.status}: {seen.err[-300:]}")
            return
        there = {row[0]: row for row in members_of(store)}
        lost = [row for row in self.whole if row[0] not in there]
        wrong = [row for row in self.whole if row[0] in there and there[row[0]] != row]
        wrong += [row for key, row in there.items() if key not in {each[0] for each in self.whole}]
        self.tally.lost += len(lost)
        self.tally.wrong += len(wrong)
        if lost or wrong:
            self.tally.failures.append(f"{what}: {len(lost)} rows lost, {len(wrong)} wrong: {wrong[:1]}")

    def process(self, folder: Path, *words: str, first: Path | None = None) -> subprocess.Popen[str]:
        """A command as a process of its own; `first`: where it looks for modules before anywhere else."""
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (first or ROOT, ROOT)))}
        return subprocess.Popen(
            (sys.executable, "-m", "abu_calc", *words),
            env=environment,
            cwd=folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=_heed_interrupts,
        )


def _heed_interrupts() -> None:
    """Whoever runs the trials in the background may have turned the signal off."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def _damaged(change: Callable[[Path, random.Random], str]) -> Callable[..., None]:
    def trial(faults: Faults, folder: Path, draw: random.Random, what: str) -> None:
        """A store is changed, then gone on with: it is refused by name, or its members are the right ones."""
        store = folder / "members.sqlite"
        shutil.copy(faults.store, store)
        what = f"{what}: {change(store, draw)}"
        explicit = draw.random() < 0.5
        words = faults.words(store, "--resume", *(("--runs", str(MEMBERS)) if explicit else ()))
        if not explicit:  # the study is read from the store
            bare = folder / "bare.toml"
            bare.write_text(SCENE.partition("[sweep]")[0], encoding="utf-8")
            words = ("sweep", str(bare), *words[2:])
        seen = abu(*words)
        faults.tally.see(what, seen.status, seen.err)
        if seen.status != 2:
            faults.compare(store, seen, what)
        elif str(store) not in seen.err and "nothing varies" not in seen.err:  # an emptied store names no study
            faults.tally.failures.append(f"{what}: does not name the store: {seen.err[-300:]}")

    return trial


def _full(faults: Faults, folder: Path, draw: random.Random, what: str) -> None:
    """The disk is full after so many pages; then there is room."""
    store, pages, before = folder / "members.sqlite", draw.randrange(1, 14), Store.begun

    def begun(self: Store, facts: Any) -> int:
        self.ask(f"PRAGMA max_page_count = {pages}")
        return before(self, facts)

    Store.begun = begun  # type: ignore[method-assign]
    try:
        seen = abu(*faults.words(store))
    finally:
        Store.begun = before  # type: ignore[method-assign]
    faults.tally.see(what, seen.status, seen.err)
    if seen.status not in (0, 1) and (seen.status != 2 or "disk is full" not in seen.err):
        faults.tally.failures.append(f"{what}: status {seen.status}: {seen.err[-300:]}")
    faults.go_on(store, what)


def _limited(faults: Faults, folder: Path, draw: random.Random, what: str) -> None:
    """Files may not be larger than so many bytes."""
    import resource

    store, most = folder / "members.sqlite", draw.choice((1_000, 20_000, 33_000, 40_000, 60_000))
    words = (sys.executable, "-m", "abu_calc", *faults.words(store))
    done = subprocess.run(
        words,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)),
        capture_output=True,
        text=True,
        check=False,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    faults.tally.see(what, done.returncode, done.stderr)
    if done.returncode not in (0, 1) and (done.returncode != 2 or str(store) not in done.stderr):
        faults.tally.failures.append(f"{what} {most}: status {done.returncode}: {done.stderr[-300:]}")
    faults.go_on(store, what)


def _signalled(faults: Faults, folder: Path, draw: random.Random, what: str) -> None:
    """A signal during an import, or at any moment."""
    store, name = folder / "members.sqlite", draw.choice(list(ENDED))
    if draw.random() < 0.7:
        module = draw.choice(MODULES)
        what = f"{what} {name} at {module}"
        aimed(folder / "hook", module, name, before=draw.random() < 0.5)
        process = faults.process(folder, *faults.words(store), first=folder / "hook")
    else:
        process = faults.process(folder, *faults.words(store))
        time.sleep(draw.uniform(0.3, 4.0))
        process.send_signal(getattr(signal, name))
    _, stderr = process.communicate(timeout=PATIENCE_S)
    faults.tally.see(what, process.returncode, stderr)
    # One at any moment may come when all is done; one at an import never does, if the sweep loads that module.
    done = process.returncode in (0, 1) and len(members_of_existing(store)) == MEMBERS
    sent = (folder / "sent").exists()
    if process.returncode not in ENDED[name] and (sent or not done):
        faults.tally.ignored += 1
        faults.tally.failures.append(f"{what}: status {process.returncode}: {stderr[-300:]}")
    faults.go_on(store, what)


def _killed(faults: Faults, folder: Path, draw: random.Random, what: str) -> None:
    """Killed at any moment, once or twice."""
    store = folder / "members.sqlite"
    for _ in range(draw.choice((1, 2))):
        process = faults.process(folder, *faults.words(store, "--resume"))
        time.sleep(draw.uniform(0.5, 4.0))
        process.kill()
        process.communicate()
    faults.go_on(store, what)


def _together(faults: Faults, folder: Path, draw: random.Random, what: str) -> None:
    """Several processes at once; one of them may be killed, or want to begin anew."""
    store = folder / "members.sqlite"
    begun = [faults.process(folder, *faults.words(store, "--resume")) for _ in range(2)]
    time.sleep(draw.uniform(0.0, 4.0))
    last = draw.choice(("--force", "kill"))
    if last == "--force":
        begun.append(faults.process(folder, *faults.words(store, "--force")))
    else:
        begun[0].kill()
    for process in begun:
        _, stderr = process.communicate(timeout=PATIENCE_S)
        faults.tally.see(what, process.returncode, stderr)
        if process.returncode not in (0, 1, -signal.SIGKILL) and "another process has it open" not in stderr:
            faults.tally.failures.append(f"{what}: status {process.returncode}: {stderr[-300:]}")
    faults.go_on(store, what)


def _clustered(faults: Faults, folder: Path, draw: random.Random, what: str) -> None:
    """A cluster of which a worker or the scheduler is killed, or a worker has another version."""
    store, fault = folder / "members.sqlite", draw.choice(("worker", "scheduler", "version", "none"))
    what = f"{what} {fault}"
    with cluster(folder / "cluster") as running:
        workers = [running.start_worker() for _ in range(2)]
        if fault == "version":
            shutil.copytree(ROOT / "abu_calc", folder / "other" / "abu_calc")
            with (folder / "other" / "abu_calc" / "version.py").open("a", encoding="utf-8") as text:
                text.write("# another state\n")
            running.start_worker(folder / "other")
        words = faults.words(store, "--cluster", running.address, "--cluster-wait", "8")
        process = faults.process(folder, *words)
        until = time.monotonic() + 60
        while not members_of_existing(store) and time.monotonic() < until and process.poll() is None:
            time.sleep(0.05)
        if fault in ("worker", "scheduler"):
            (workers[0] if fault == "worker" else running.scheduler).kill()
        _, stderr = process.communicate(timeout=PATIENCE_S)
    faults.tally.see(what, process.returncode, stderr)
    allowed = {"worker": {0, 1}, "scheduler": {0, 1, 3}, "version": {0, 1, 2}, "none": {0, 1}}[fault]
    if process.returncode not in allowed:
        faults.tally.failures.append(f"{what}: status {process.returncode}: {stderr[-300:]}")
    faults.go_on(store, what)


def members_of_existing(store: Path) -> list[tuple[object, ...]]:
    """The rows of a store that may not be there yet; looking at it must not make it."""
    return members_of(store) if store.exists() and sqlite3.sqlite_version else []


KINDS: dict[str, tuple[Callable[..., None], float]] = {
    "edited": (_damaged(edit), 40.0),
    "corrupted": (_damaged(corrupt), 34.0),
    "disk full": (_full, 10.0),
    "file size": (_limited, 1.5),
    "signal": (_signalled, 10.0),
    "killed": (_killed, 2.5),
    "together": (_together, 1.5),
    "cluster": (_clustered, 0.5),
}
"""Kinds of trials with how often they come; those that start processes take seconds each."""
