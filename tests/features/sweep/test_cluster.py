"""Clusters: workers with other software are refused by name, and a cluster that goes away ends the sweep.

Here with threads in the place of workers; with Dask in `tests/faults`.
"""

from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any

import pytest

import abu_calc
from abu_calc.features.sweep import batches
from abu_calc.features.sweep import execution as programs
from abu_calc.features.sweep.execution import Attributed, software
from tests.features.sweep.conftest import Sweeps


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
