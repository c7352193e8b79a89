"""Progress of long work: reports of the current stage and of the share done."""

from collections.abc import Callable
from typing import Final, Self


class Stage(str):
    """Description of the current work, in a few words; `share`: part of it that is done, 0 … 1."""

    __slots__ = ("share",)
    share: float

    def __new__(cls, text: str, share: float) -> Self:
        """A text that knows its share."""
        stage = super().__new__(cls, text)
        stage.share = share
        return stage


Progress = Callable[[str], None]
"""Gets what is being done, in a few words; a Stage where it is known how far that has come."""

Share = Callable[[float], None]
"""Gets how much is done, 0 … 1."""

STEP: Final = 0.01
"""Step of the share between two reports."""


def silent(_: str) -> None:
    """Ignore the progress: the callback of a caller that does not watch."""


def share_of(progress: Progress, text: str) -> Share | None:
    """Reports a text with how much of it is done, each hundredth once; None for whom does not watch."""
    if progress is silent:
        return None
    shown = -1.0

    def tell(share: float) -> None:
        """Report the share if it is a hundredth more than the one reported last."""
        nonlocal shown
        if share >= shown + STEP:
            shown = share
            progress(Stage(text, share))

    return tell


def counted(progress: Progress, text: str, total: int) -> Callable[[int], None]:
    """Callback that gets how many of a total are done; `text` has two places for these numbers: "{} of {} starts"."""
    return lambda done: progress(Stage(text.format(done, total), done / total))


def within(progress: Progress, what: str) -> Progress:
    """Progress callback for a part of the work: its texts follow the name of the whole."""
    if progress is silent:
        return silent

    def tell(text: str) -> None:
        named = f"{what}: {text}"
        progress(Stage(named, text.share) if isinstance(text, Stage) else named)

    return tell
