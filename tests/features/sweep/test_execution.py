"""Members go through workers into a store: counted, attributed, and refused from other software.

Clusters: workers with other software are refused by name, and a cluster that goes away ends the sweep.

Here with threads in the place of workers; with Dask in `tests/faults`.
"""

from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

import abu_calc
from abu_calc.features.sweep import batches
from abu_calc.features.sweep import execution as programs
from abu_calc.features.sweep.batches import LEVEL, MEMBER, OUTSIDE, REASON, SEED, Row
from abu_calc.features.sweep.execution import Attributed, Workers, compute, once_more, software, worker_name
from abu_calc.features.sweep.store import Store
from abu_calc.foundation.errors import InputError
from tests.features.sweep.conftest import Sweeps


@dataclass(frozen=True)
class Squares:
    """A study whose level is the square of the number."""

    def rows(self, members: tuple[int, ...], may_end_process: bool = False) -> tuple[list[Row], float]:
        return [(member, 0, float(member**2), None) for member in members], 1e-3 * len(members)

    def lost(self, member: int, reason: str) -> Row:
        return (member, 0, None, reason)


HERE = Workers(None, None, 10.0)


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    made = Store.open(tmp_path / "m.sqlite", {"runs": 9}, (MEMBER, SEED, LEVEL, REASON), frozenset({"reason"}))
    made.begun({})
    yield made
    made.close()


@pytest.mark.parametrize("threads", [False, True])
def test_missing_members_are_computed_and_the_others_stay(store: Store, threads: bool) -> None:
    store.put([(4, 0, 1.5, None)])
    said: list[str] = []
    with ThreadPoolExecutor(2) as pool:
        compute(Squares(), store, Workers(None, pool, 10.0) if threads else HERE, said.append)  # type: ignore[arg-type]
    assert store.column("level_db").tolist() == [0, 1, 4, 9, 1.5, 25, 36, 49, 64]
    assert said[-1].startswith("sweep: 9 of 9 samples, ") and said[-1].endswith(" 0 s left")
    assert {row[0] for row in store.ask("SELECT worker FROM batches")} == {"", worker_name()}


def test_members_once_more_leave_the_store_alone() -> None:
    taken: list[Row] = []
    once_more(Squares(), iter(range(5)), taken.extend, 5, HERE, lambda _: None)
    assert [row[2] for row in taken] == [0.0, 1.0, 4.0, 9.0, 16.0]


def test_a_worker_with_other_software_computes_nothing() -> None:
    with pytest.raises(InputError, match=r"other software") as refused:
        Attributed(Squares(), {**software(), "abu-calc": "0.0.1"}).rows((1,))
    assert "0.0.1" in str(refused.value.remedy)
    assert Attributed(Squares(), software()).lost(3, "gone") == ("", None, [(3, 0, None, OUTSIDE + "gone")])


def test_the_store_is_told_who_computed() -> None:
    assert Workers(3, None, 1.0).described.startswith("3 of this machine; Python ")
    with ThreadPoolExecutor(1) as pool:
        assert Workers(None, pool, 1.0).described.startswith("ThreadPoolExecutor; Python ")


class Scheduler:
    """The calls of a scheduler that a client asks for."""

    ncores = "ncores"


class Client:
    """A client of a cluster that is one thread; `workers`: what each says of its software."""

    def __init__(self, workers: dict[str, Any]) -> None:
        self.workers, self.status, self.scheduler = workers, "running", Scheduler()

    def nthreads(self) -> dict[str, int]:
        """A thread for each worker."""
        return dict.fromkeys(self.workers, 1)

    def scheduler_info(self, n_workers: int) -> dict[str, Any]:
        """No worker has a nanny."""
        return {"workers": {name: {"nanny": None} for name in self.workers}}

    def run(self, function: Any, on_error: str) -> dict[str, Any]:
        """The software of each worker."""
        assert function is software and on_error == "return"
        return self.workers

    def sync(self, call: Any, callback_timeout: float) -> dict[str, int]:
        """The answer of the scheduler."""
        return self.nthreads()


class Executor(ThreadPoolExecutor):
    """The executor of a client; `lost`: how many batches come back uncomputed at first."""

    def __init__(self, client: Client, lost: int = 0, gone: bool = False) -> None:
        super().__init__(1)
        self._client, self.lost, self.gone = client, lost, gone

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        """A future; one that is cancelled, or never done, where nobody computes."""
        future: Future[Any] = Future()
        if self.gone:
            self._client.workers = {}
            return future
        if self.lost:
            self.lost -= 1
            future.cancel()
            future.set_running_or_notify_cancel()
            return future
        return super().submit(fn, *args, **kwargs)


OTHER = {
    "another version": {**software(), "abu-calc": "0.0.9"},
    "another source": {**software(), "source": "0123456789ab"},
    "another compiler": {**software(), "llvmlite": "0.1"},
    "another library": {**software(), "numpy": "1.26.0"},
    "a version without this check": AttributeError("module has no attribute 'software'"),
    "no abu-calc": ModuleNotFoundError("No module named 'abu_calc'"),
}


@pytest.mark.parametrize("other", OTHER.values(), ids=OTHER)
def test_a_worker_with_other_software_is_refused_by_name(other: object, sweeps: Sweeps) -> None:
    client = Client({"tcp://a:1": dict(software()), "tcp://b:2": other})
    with pytest.raises(abu_calc.InputError, match="tcp://b:2") as refused:
        sweeps.run(executor=Executor(client))
    assert "tcp://a:1" not in str(refused.value) and refused.value.place.key == "cluster"
    assert not sweeps.store.exists()  # the same command goes through once the worker is mended
    client.workers["tcp://b:2"] = dict(software())
    assert sweeps.run(executor=Executor(client)).failed.members == 0


@pytest.mark.slow
def test_a_worker_that_comes_later_refuses_itself(sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch) -> None:
    """No row of it is kept, not even as a failure."""
    taken = list[Any]()
    study = Attributed(taken, {**software(), "scipy": "0.1"})  # type: ignore[arg-type]
    with pytest.raises(abu_calc.InputError, match=rf"scipy {software()['scipy']}, here 0\.1"):
        study.rows((0,))
    members = Attributed.rows

    def later(self: Attributed, numbers: tuple[int, ...], may_end_process: bool = False) -> Any:
        if 6 in numbers:
            return members(Attributed(self.study, {**self.software, "scipy": "0.1"}), numbers, may_end_process)
        return members(self, numbers, may_end_process)

    monkeypatch.setattr(Attributed, "rows", later)
    with pytest.raises(abu_calc.InputError, match="other software"):
        sweeps.run(executor=ThreadPoolExecutor(1))
    monkeypatch.setattr(Attributed, "rows", members)
    assert sweeps.run(resume=True).failed.members == 0


@pytest.mark.slow
def test_another_state_of_the_source_is_another_study(sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch) -> None:
    sweeps.run()
    programs.software.cache_clear()
    monkeypatch.setattr(programs, "_source", lambda: "0123456789ab")
    try:
        with pytest.raises(abu_calc.InputError, match=r"versions\.source is .\w+. there and .0123456789ab. here"):
            sweeps.run(resume=True)
    finally:
        programs.software.cache_clear()


@pytest.mark.slow
def test_batches_that_come_back_are_handed_out_again(sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch) -> None:
    """As after a scheduler was started anew."""
    monkeypatch.setattr(batches, "LOOK_S", 0.01)
    executor = Executor(Client({"tcp://a:1": dict(software())}), lost=2)
    assert sweeps.run(executor=executor).failed.members == 0 and executor.lost == 0


def test_who_cancels_for_ever_ends_the_sweep(sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(batches, "LOOK_S", 0.01)
    with pytest.raises(abu_calc.NotTrustworthyError, match="cancels what it is given"):
        sweeps.run(executor=Executor(Client({"tcp://a:1": dict(software())}), lost=1000))
    closed = ThreadPoolExecutor(1)
    closed.shutdown()
    with pytest.raises(abu_calc.NotTrustworthyError, match="cancels what it is given"):
        sweeps.run(sweeps.folder / "closed.sqlite", executor=closed)


def test_a_cluster_without_workers_is_waited_for_as_long_as_asked(
    sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(batches, "LOOK_S", 0.01)
    executor = Executor(Client({"tcp://a:1": dict(software())}), gone=True)
    with pytest.raises(abu_calc.NotTrustworthyError, match=r"no scheduler or no worker for 0\.2 s") as ended:
        sweeps.run(executor=executor, cluster_wait_s=0.2)
    assert ended.value.__notes__ == ["0 of 12 samples"]
