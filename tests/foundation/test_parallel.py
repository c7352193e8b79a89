"""Work side by side: in order, as it is asked for, and no more of it than that."""

import threading
from contextlib import closing
from itertools import islice

import pytest

from abu_calc.foundation.parallel import meanwhile, side_by_side

TASKS = [(k,) for k in range(12)]


@pytest.fixture(autouse=True)
def _every_task_is_long(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("abu_calc.foundation.parallel.LONG", 0.0)


def _nothing(done: int) -> None:
    pass


@pytest.mark.parametrize("workers", [1, 3])
def test_answers_come_in_the_order_of_the_tasks(workers: int) -> None:
    """Whoever is done first; and how many are done never falls and ends at all of them."""
    told: list[int] = []
    gates = [threading.Event() for _ in TASKS]

    def work(k: int) -> int:
        if workers > 1 and 0 < k < 3:
            gates[k + 1].wait(10)  # those behind it are done first
        gates[k].set()
        return k * k

    assert list(side_by_side(work, TASKS, workers, told.append)) == [k * k for (k,) in TASKS]
    assert told == sorted(told) and told[-1] == len(TASKS)


@pytest.mark.parametrize("workers", [1, 2])
def test_what_nobody_asks_for_is_not_begun(workers: int) -> None:
    """Of a dozen tasks, of which two are asked for, the last ones never run."""
    begun, enough = [], threading.Event()

    def work(k: int) -> int:
        begun.append(k)
        if k > 1:
            enough.wait(10)
        return k

    with closing(side_by_side(work, TASKS, workers, _nothing)) as answers:
        assert list(islice(answers, 2)) == [0, 1]
        enough.set()
    assert len(begun) < len(TASKS)


def test_errors_come_where_the_answer_would() -> None:
    """And those before it are there."""

    def work(k: int) -> float:
        return 1 / (k - 2)

    answers = side_by_side(work, TASKS, 2, _nothing)
    assert [next(answers), next(answers)] == [-0.5, -1.0]
    with pytest.raises(ZeroDivisionError):
        next(answers)


def test_short_tasks_are_done_one_after_the_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """By the thread that asks for them."""
    monkeypatch.setattr("abu_calc.foundation.parallel.LONG", 60.0)
    threads = side_by_side(lambda _: threading.get_ident(), TASKS, 3, _nothing)
    assert set(threads) == {threading.get_ident()}


def _broken() -> int:
    raise ZeroDivisionError


def test_a_task_goes_on_while_the_caller_does() -> None:
    """Its outcome is there when it is asked for, twice, too."""
    begun, free = threading.Event(), threading.Event()

    def work(a: int, b: int) -> int:
        begun.set()
        assert free.wait(10)
        return a * b

    product = meanwhile(work, 6, 7, workers=2)
    assert begun.wait(10)
    free.set()
    assert product() == product() == 42


@pytest.mark.parametrize("workers", [1, 2])
def test_the_error_of_a_task_is_that_of_its_outcome(workers: int) -> None:
    outcome = meanwhile(_broken, workers=workers)
    with pytest.raises(ZeroDivisionError):
        outcome()


def test_one_worker_does_a_task_when_its_outcome_is_asked_for() -> None:
    done: list[int] = []
    outcome = meanwhile(done.append, 1, workers=1)
    assert not done
    outcome()
    assert done == [1]
