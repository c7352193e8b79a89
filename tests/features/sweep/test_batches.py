"""Batches by any executor: all members come, whoever fails on the way.

Columns of a sample: units by their names, flags that end in all together, and the drag of oil.
"""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import pytest

from abu_calc.features.sweep.batches import (
    DECIDING,
    ENDED,
    FLAGS,
    LEVEL,
    MEETS,
    QUANTITIES,
    QUIET,
    Here,
    RenewableExecutor,
    Row,
    drag_ratio,
    given,
    here,
    in_batches,
    processes,
)
from abu_calc.foundation.errors import InputError, NotTrustworthyError


@dataclass(frozen=True)
class Squares:
    """A study; `deadly`: members that end their process."""

    deadly: frozenset[int] = frozenset()
    wrong: frozenset[int] = frozenset()

    def rows(self, members: tuple[int, ...], may_end_process: bool = False) -> tuple[list[Row], float]:
        if self.deadly & set(members):
            os._exit(7)
        if self.wrong & set(members):
            raise ZeroDivisionError("no such member")
        return [(member, member**2) for member in members], 1e-3 * len(members)

    def lost(self, member: int, reason: str) -> Row:
        return (member, reason)


def done(study: Squares, members: Iterator[int], workers: RenewableExecutor) -> dict[int, object]:
    found: list[Row] = []
    try:
        in_batches(study, members, workers, found.extend)
    finally:
        workers.close()
    assert len(found) == len(dict(found))  # type: ignore[arg-type]
    return dict(found)  # type: ignore[arg-type]


@pytest.mark.parametrize("make", [here, lambda: given(ThreadPoolExecutor(3), 3)], ids=["here", "threads"])
def test_every_member_comes_once(make: Callable[[], RenewableExecutor]) -> None:
    assert done(Squares(), iter(range(3000)), make()) == {k: k**2 for k in range(3000)}


def test_little_is_in_flight_and_batches_stay_short() -> None:
    asked: list[int] = []

    def members() -> Iterator[int]:
        for member in range(10_000):
            asked.append(member)
            yield member

    taken: list[int] = []

    def take(rows: list[Row]) -> None:
        assert len(rows) <= 512
        taken.extend(row[0] for row in rows)
        assert len(asked) - len(taken) <= 5 * 512

    in_batches(Squares(), members(), given(ThreadPoolExecutor(2), 2), take)
    assert sorted(taken) == list(range(10_000))


@pytest.mark.parametrize(("each", "workers"), [(0.02, 1), (0.5, 1), (1e-3, 1), (0.02, 200), (0.1, 600)])
def test_handing_out_stays_below_a_tenth_of_the_work(each: float, workers: int) -> None:
    """Counted, not timed: so many batches for so much work. A batch costs whoever hands it out half a millisecond on
    processes and 8 ms on a local cluster; with many workers, so many at a time, it must still find the time.
    """
    batches: list[int] = []

    class Timed(Squares):
        def rows(self, members: tuple[int, ...], may_end_process: bool = False) -> tuple[list[Row], float]:
            batches.append(len(members))
            return [(member, 0) for member in members], each * len(members)

    in_batches(Timed(), iter(range(20_000)), RenewableExecutor(Here, workers), lambda rows: None)
    handing = 8e-3 if each >= 0.02 else 0.5e-3
    assert sum(batches) == 20_000
    assert handing * len(batches) < 0.1 * each * 20_000
    later = batches[12:-1]  # once it is known what one takes
    assert not later or each * sum(later) / len(later) > workers * handing


def test_a_batch_that_fails_on_anothers_executor_is_recorded_member_by_member() -> None:
    found = done(Squares(wrong=frozenset({5})), iter(range(20)), given(ThreadPoolExecutor(2), 2))
    assert found[5] == "ZeroDivisionError: no such member"
    assert {k: v for k, v in found.items() if k != 5} == {k: k**2 for k in range(20) if k != 5}


def test_anothers_broken_executor_is_not_made_anew() -> None:
    with pytest.raises(NotTrustworthyError):
        given(ThreadPoolExecutor(1), 1).renew()


@pytest.mark.slow
def test_a_member_that_ends_its_process_is_passed_over() -> None:
    found = done(Squares(deadly=frozenset({7})), iter(range(40)), processes(2))
    assert found.pop(7) == ENDED
    assert found == {k: k**2 for k in range(40) if k != 7}


def test_oil_has_the_viscosities_of_its_table_and_thins_with_warmth() -> None:
    """ISO VG 46: 46 mm²/s at 40 °C and 6.8 at 100 °C; some 68 at 31.5 °C by the charts of ASTM D341."""
    assert drag_ratio(40.0) == pytest.approx(1.0) and drag_ratio(100.0) == pytest.approx(6.8 / 46)
    ratios = [drag_ratio(temperature) for temperature in range(-20, 121, 10)]
    assert ratios == sorted(ratios, reverse=True)
    assert 46 * drag_ratio(31.5) == pytest.approx(68, rel=0.05)


@pytest.mark.parametrize("temperature", [-20.5, 120.5])
def test_a_temperature_beyond_the_range_is_refused(temperature: float) -> None:
    with pytest.raises(InputError) as refused:
        drag_ratio(temperature)
    assert refused.value.place.key == "start.temperature_C"


def test_each_kind_has_a_deciding_number_and_ends_in_all_limits() -> None:
    assert (LEVEL.unit, QUIET.unit, MEETS.unit) == ("dB", "s", "")
    for what, columns in QUANTITIES.items():
        names = [column.name for column in columns] + [column.name for column in FLAGS[what]]
        assert DECIDING[what] in names and len(set(names)) == len(names)
        assert FLAGS[what][-1] == MEETS
