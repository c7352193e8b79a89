"""Dask clusters of whole processes, to be killed: a scheduler and workers, each started from the command line."""

import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

DASK = (sys.executable, "-m", "dask")


class Cluster:
    """A scheduler at a port of its own, and its workers; each a process."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.processes = folder, list[subprocess.Popen[bytes]]()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
        self.scheduler = self.start_scheduler()

    def start_scheduler(self) -> subprocess.Popen[bytes]:
        """At the address of the cluster, anew after it was killed."""
        port = self.address.rsplit(":", 1)[1]
        self.scheduler = self._started("scheduler", "--host", "127.0.0.1", "--port", port, "--no-dashboard")
        return self.scheduler

    def start_worker(self, path: Path | None = None, nanny: bool = False) -> subprocess.Popen[bytes]:
        """One thread; `path`: where it finds abu_calc before anywhere else."""
        more = ("--nanny" if nanny else "--no-nanny", "--nthreads", "1", "--no-dashboard", "--death-timeout", "60")
        folder = ("--local-directory", str(self.folder))
        first = {"PYTHONPATH": str(path or Path(__file__).parents[2])}
        return self._started("worker", self.address, *more, *folder, environment=first)

    def close(self) -> None:
        """Kill all that is left."""
        for process in reversed(self.processes):
            process.kill()
            process.wait()

    def _started(self, *words: str, environment: dict[str, str] | None = None) -> subprocess.Popen[bytes]:
        log = (self.folder / f"{len(self.processes)}.log").open("wb")
        process = subprocess.Popen(
            (*DASK, *words), env={**os.environ, **(environment or {})}, stdout=log, stderr=log, cwd=self.folder
        )
        self.processes.append(process)
        return process


@contextmanager
def cluster(folder: Path) -> Iterator[Cluster]:
    """A cluster that is gone afterwards."""
    folder.mkdir(parents=True, exist_ok=True)
    running = Cluster(folder)
    try:
        wait_for_port(running.address)
        yield running
    finally:
        running.close()


def wait_for_port(address: str) -> None:
    """Wait until somebody listens there."""
    host, port = address.removeprefix("tcp://").split(":")
    until = time.monotonic() + 60
    while time.monotonic() < until:
        try:
            socket.create_connection((host, int(port)), timeout=1).close()
        except OSError:
            time.sleep(0.1)
        else:
            return
    raise TimeoutError(address)
