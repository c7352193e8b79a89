"""Members go through workers into a store: counted, attributed, and refused from other software."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import pytest

from abu_calc.features.sweep.batches import LEVEL, MEMBER, OUTSIDE, REASON, SEED, Row
from abu_calc.features.sweep.execution import Attributed, Workers, compute, once_more, software, worker_name
from abu_calc.features.sweep.store import Store
from abu_calc.foundation.errors import InputError


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
