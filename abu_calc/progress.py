"""Long work reports what it is at."""

from collections.abc import Callable

Progress = Callable[[str], None]
"""Gets what is being done, in a few words."""


def silent(_: str) -> None:
    """For whom does not watch."""
