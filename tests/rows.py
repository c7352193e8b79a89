"""One test for all rows of a table."""

import inspect
from collections.abc import Callable, Iterable
from typing import Any, Final

import pytest

PARAM: Final = type(pytest.param())


def for_each(rows: Iterable[Any]) -> Callable[[Callable[..., None]], Callable[[], None]]:
    """A test that gives each row to the function, as its arguments where it takes several; one that fails is named."""
    table = list(rows)

    def of_all(check: Callable[..., None]) -> Callable[[], None]:
        """The test of all rows."""
        several = len(inspect.signature(check).parameters) > 1

        def test() -> None:
            """Every row holds."""
            assert table
            for row in table:
                try:
                    check(*(row.values if isinstance(row, PARAM) else row if several else (row,)))
                except BaseException as error:
                    error.add_note(f"row: {row}")
                    raise

        test.__name__, test.__qualname__ = check.__name__, check.__qualname__
        test.__doc__, test.__module__ = check.__doc__, check.__module__
        return test

    return of_all
