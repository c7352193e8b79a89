"""A Dask cluster behind an executor of its client: who computes there, with which software, and whether it is alive."""

from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from typing import Any, Final

from abu_calc.errors import InputError, Place
from abu_calc.studies.sweeping.software import differences_of_software, software

ANSWER_S: Final = 5.0
"""Seconds in which a scheduler that is alive answers."""
SHOWN: Final = 3
"""Workers that an error names."""
PLACE: Final = Place(key="cluster")


def client_of(executor: Executor) -> Any | None:
    """The client of a Dask cluster whose executor this is; None for any other executor."""
    return getattr(executor, "_client", None)


def threads_of(client: Any) -> int:
    """Number of samples that the cluster's workers compute side by side."""
    return int(sum(client.nthreads().values()))


def is_ours_to_end(executor: Executor) -> bool:
    """Tell whether processes of a Dask cluster compute the members, and are started anew when they end."""
    client = client_of(executor)
    if client is None:
        return False
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    return bool(workers) and all(worker.get("nanny") for worker in workers)


def is_alive(client: Any) -> bool:
    """Tell whether the scheduler answers and has workers."""
    if client.status != "running":
        return False
    try:
        return bool(client.sync(client.scheduler.ncores, callback_timeout=ANSWER_S))
    except Exception:  # of the connection, whichever its protocol raises
        return False


def refuse_other_software(client: Any) -> None:
    """Raise InputError that names the workers whose members would differ from those computed here."""
    refused = list(_refused(client.run(software, on_error="return")))
    if refused:
        more = f"; and {len(refused) - SHOWN} more" if len(refused) > SHOWN else ""
        raise InputError(
            "workers have other software than this process",
            place=PLACE,
            found="; ".join(refused[:SHOWN]) + more,
            remedy=f"Install abu-calc {software()['abu-calc']} with the same libraries on them, and restart them.",
        )


def _refused(answers: Mapping[str, Any]) -> Iterator[str]:
    for address, answer in answers.items():
        if not isinstance(answer, Mapping):
            yield f"{address}: {type(answer).__name__}: {answer}"
        elif different := differences_of_software(software(), answer):
            yield f"{address}: {different}"
