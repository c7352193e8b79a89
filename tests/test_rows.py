"""A test of many rows names the one that fails."""

import pytest

from tests.rows import for_each


def test_the_row_that_fails_is_named() -> None:
    tried: list[int] = []

    def below(number: int, limit: int) -> None:
        tried.append(number)
        assert number < limit

    with pytest.raises(AssertionError) as failed:
        for_each([(1, 2), pytest.param(3, 2), (0, 1)])(below)()
    assert tried == [1, 3] and any("3, 2" in note for note in failed.value.__notes__)
    with pytest.raises(AssertionError):
        for_each([])(below)()
