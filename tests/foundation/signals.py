"""Signals that a process sends itself, and what becomes of each: one JSON object on the last line of output.

    python -m tests.foundation.signals FOLDER

A process of its own, since a signal that comes late, or again, must not meet whatever tests run next.
"""

import contextlib
import importlib
import io
import json
import signal
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest import mock

from abu_calc.cli import app
from abu_calc.features.sweep.samples import Overtime, limited
from abu_calc.foundation import parallel as interruption
from abu_calc.foundation.parallel import EndedBySignal, heed_signals, raise_pending, status_of

MODULES = {
    # Modules of C turn what is raised in them into ImportError, and are broken for good: this one does the same.
    "converting": """
import signal
try:
    signal.raise_signal(signal.SIGTERM)
    sum(range(1000))
except BaseException:
    raise ImportError("multiarray failed to import") from None
whole = True
""",
    "last": "import signal\nsignal.raise_signal(signal.SIGTERM)\n",
    "slowly": "import time\ntime.sleep(0.4)\nwhole = True\n",
}


def waiting() -> None:
    """Until a signal arrives, or for so long that none comes any more."""
    until = time.monotonic() + 60
    while time.monotonic() < until:
        time.sleep(0.01)


def status(work: Callable[[], object]) -> int | None:
    """Exit status of the signal that ends the work, which is heeded thereby; None if none does."""
    try:
        work()
    except EndedBySignal as ended:
        return status_of(ended)
    return None


def importing() -> object:
    """A signal during an import; the module is whole, whether or not the import is repeated."""

    def work() -> None:
        importlib.import_module("converting")
        waiting()

    return status(work), hasattr(sys.modules.get("converting"), "whole")


def swallowed() -> object:
    """A signal that somebody swallows."""

    def work() -> None:
        with contextlib.suppress(BaseException):
            signal.raise_signal(signal.SIGINT)
            waiting()
        waiting()

    return status(work)


def swallowed_on_windows() -> object:
    """There a signal is sent to no thread: Python is asked to raise it at its next line."""
    kill = getattr(signal, "pthread_kill", None)
    if kill:
        del signal.pthread_kill
    try:
        return swallowed()
    finally:
        if kill:
            signal.pthread_kill = kill


def unraisable() -> object:
    """A signal where nothing can be raised; and what is said of it, which is nothing."""

    class Deleted:
        def __del__(self) -> None:
            signal.raise_signal(signal.SIGINT)
            sum(range(1000))

    def work() -> None:
        Deleted()
        waiting()

    with contextlib.redirect_stderr(io.StringIO()) as said:
        return status(work), said.getvalue()


def _cleaning(same_s: float) -> tuple[int | None, bool]:
    cleaned = False

    def work() -> None:
        nonlocal cleaned
        try:
            signal.raise_signal(signal.SIGTERM)
            waiting()
        finally:
            time.sleep(0.3)  # reminders come
            signal.raise_signal(signal.SIGTERM)
            cleaned = True

    with mock.patch.object(interruption, "SAME_S", same_s):
        return status(work), cleaned


def clean_up() -> object:
    """Another signal during clean-up, soon; a heeded one does not come again."""
    found = _cleaning(600.0)
    again = status(lambda: time.sleep(0.3))
    raise_pending()
    return *found, again


def clean_up_for_long() -> object:
    """Another signal, when clean-up has gone on for long."""
    return _cleaning(0.1)


def error_afterwards() -> object:
    """A library without half of its modules fails at whatever it does next."""

    def build(*_: object, **__: object) -> None:
        try:
            signal.raise_signal(signal.SIGTERM)
            waiting()
        except BaseException:
            raise AttributeError("module has no attribute") from None

    with mock.patch.object(app, "build", build), contextlib.redirect_stderr(io.StringIO()) as said:
        return app.run(["presets"]), said.getvalue()


def time_limit() -> object:
    """A module whose import is broken off half-way would be broken for all samples that follow."""
    try:
        with limited(0.05):
            importlib.import_module("slowly")
            waiting()
    except Overtime:
        return hasattr(sys.modules["slowly"], "whole")
    return None


def last_import() -> object:
    """The command is over before the signal is raised again. Signals are left to the system then: nothing follows."""
    patches = (
        mock.patch.object(interruption, "AGAIN_S", 600.0),
        mock.patch.object(app, "make_safe", lambda: SimpleNamespace(fault=None)),
        mock.patch.object(app, "run", lambda _: 0 if importlib.import_module("last") else 1),
    )
    with contextlib.ExitStack() as stack, contextlib.redirect_stderr(io.StringIO()) as said:
        for each in patches:
            stack.enter_context(each)
        try:
            app.main(["presets"])
        except SystemExit as ended:
            return ended.code, said.getvalue()
    return None


SCENES: tuple[Callable[[], object], ...] = (
    importing, swallowed, swallowed_on_windows, unraisable, clean_up, clean_up_for_long, error_afterwards, time_limit,
    last_import,
)  # fmt: skip


def main(folder: Path) -> None:
    """Play all scenes."""
    for name, text in MODULES.items():
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    sys.path.insert(0, str(folder))
    for number in (signal.SIGINT, signal.SIGTERM):  # what runs in the background may have them ignored
        signal.signal(number, signal.SIG_DFL)
    heed_signals()
    found: dict[str, Any] = {scene.__name__: scene() for scene in SCENES}
    print(json.dumps(found))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
