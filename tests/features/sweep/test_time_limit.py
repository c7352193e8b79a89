"""Work that takes too long is given up in any thread."""

import contextlib
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from abu_calc.features.sweep.samples import Overtime, limited


def test_work_without_end_is_given_up() -> None:
    begun = time.perf_counter()
    with pytest.raises(Overtime), limited(0.1):
        while True:
            pass
    assert time.perf_counter() - begun < 60
    with limited(0.05):
        pass
    time.sleep(0.1)  # nothing arrives afterwards


@pytest.mark.slow
def test_the_end_of_the_time_is_told_again_if_something_swallows_it() -> None:
    """As callbacks of the garbage collector do."""
    begun = time.perf_counter()
    with pytest.raises(Overtime), limited(0.05):
        with contextlib.suppress(BaseException):
            while time.perf_counter() - begun < 60:
                pass
        while time.perf_counter() - begun < 60:
            pass


def test_time_is_limited_in_other_threads_too() -> None:
    def endless() -> str:
        try:
            with limited(0.1):
                while True:
                    pass
        except Overtime:
            return "given up"

    with ThreadPoolExecutor(1) as pool:
        assert pool.submit(endless).result(timeout=60) == "given up"
