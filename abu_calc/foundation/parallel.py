"""The same work on many things: side by side in threads for compiled code, and pools of processes for any other.

Compiled code lets go of the interpreter, so its runs go side by side in threads. Plain Python gains nothing by them.
The outcome does not depend on the number of threads.

Signals that ask a command to end: it ends in good order, with a line and 128 plus the signal's number.

A signal is never lost. One that arrives during an import waits for its end: extension modules turn whatever is raised
then into ImportError, and are broken for good. One that a library swallows is raised again until the command heeds it.
"""

import _thread
import os
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from functools import cache, partial
from types import FrameType
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from concurrent.futures import ProcessPoolExecutor


T = TypeVar("T")

LONG = 0.01
"""Processor time [s] of a task that is worth threads: most of a shorter one holds the interpreter."""


def processors() -> int:
    """Number of threads of compiled code that run at once."""
    return os.cpu_count() or 1


def side_by_side(
    work: Callable[..., T], tasks: Sequence[tuple[Any, ...]], workers: int, report: Callable[[int], None]
) -> Generator[T, None, None]:
    """Yield the result of the work for each task, in the order of the tasks, as it is asked for.

    `told` is called with the number of tasks done. One worker does the tasks one after the other. A caller that
    asks for no more ends the tasks that have not begun. Threads begin after the first task, so that the data
    all tasks need is made once. They also wait until a task has taken `LONG`: short tasks only wait for each
    other.
    """
    alone, long = 0, False
    while alone < len(tasks) and not (workers > 1 and long):
        begun = time.thread_time()
        outcome = work(*tasks[alone])
        long = time.thread_time() - begun >= LONG
        alone += 1
        report(alone)
        yield outcome
    if alone == len(tasks):
        return
    with ThreadPoolExecutor(workers) as executor:
        futures = [executor.submit(work, *task) for task in tasks[alone:]]
        waiting = set(futures)
        try:
            for future in futures:
                while future in waiting:
                    waiting = wait(waiting, return_when=FIRST_COMPLETED).not_done
                    report(len(tasks) - len(waiting))
                yield future.result()
        finally:
            for future in futures:
                future.cancel()


def meanwhile(work: Callable[..., T], *given: Any, workers: int) -> Callable[[], T]:
    """Begin a task in a thread of its own, and return the function that waits for its outcome, or raises its error.

    One worker: the task is done when its outcome is asked for. An interrupted program does not wait for the thread.
    """
    if workers == 1:
        return cache(partial(work, *given))
    future = Future[T]()

    def run() -> None:
        """Keep the outcome, or the error, for the thread that asks for it."""
        try:
            future.set_result(work(*given))
        except BaseException as error:
            future.set_exception(error)

    threading.Thread(target=run, daemon=True).start()
    return future.result


def process_pool(count: int) -> "ProcessPoolExecutor":
    """Processes started afresh on every system: a copy of this one would have its locks, but not its threads."""
    from concurrent.futures import ProcessPoolExecutor  # here, since their imports take as long as some work
    from multiprocessing import get_context

    return ProcessPoolExecutor(count, mp_context=get_context("spawn"), initializer=begin_worker)


@contextmanager
def interrupts_left_to_parent() -> Iterator[None]:
    """Processes started within never see Ctrl-C, not even while they start; this one sees it afterwards."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows, where they ignore it once they have started
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def end_processes(executor: Executor) -> None:
    """End the processes of a pool at once: nobody wants what they compute."""
    for process in list((getattr(executor, "_processes", None) or {}).values()):
        process.terminate()


def begin_worker() -> None:
    """A worker leaves Ctrl-C to the one who started it, and ends when that one does, however."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # The process that began them says once what there is to say of compiled code.
    warnings.filterwarnings("ignore", message="compiled code")
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    from multiprocessing import parent_process

    parent = parent_process()
    if parent is not None:
        parent.join()
    os._exit(1)


INTERRUPTED = 130
"""The exit status after Ctrl-C."""
ENDING = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
"""Signals that end a command, Ctrl-C first; no system has all of them."""
AGAIN_S = 0.05
"""Seconds between two tries to raise a signal that has not been heeded."""
SAME_S = 1.0
"""Signals that follow the first within this time ask for the same: clean-up goes on."""
IMPORTER = "<frozen importlib"
"""Start of the file names of Python's own import system."""


class EndedBySignal(BaseException):
    """A signal asked the command to end."""

    comes_again = True
    """Mark of an error that is raised again if Python drops it where nothing can be raised."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.exit_status = 128 + number


class _Pending:
    """The signal not yet heeded, when it arrived, whether `_remind` sent it; and the thread that takes signals."""

    number: int | None = None
    since = 0.0
    reminded = False
    thread = 0


def heed_signals() -> None:
    """Make signals raise EndedBySignal from now on; those that are ignored, as under nohup, stay so.

    Ctrl-C, too: a KeyboardInterrupt within code made from text, as dataclasses are made, Python remembers to the end,
    where it kills the process by the signal, whatever its exit status was to be.
    """
    _Pending.thread, sys.unraisablehook = _thread.get_ident(), partial(_silence, sys.unraisablehook)
    for name in ENDING:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) in (signal.SIG_DFL, signal.default_int_handler):
            signal.signal(number, _end)


def leave_signals() -> int | None:
    """Leave signals to the system, which ends the process without a word: the command is over.

    Return the number of a signal that arrived last and was not heeded; None if there was none.
    """
    for name in ENDING:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is _end:
            signal.signal(number, signal.SIG_DFL)
    last, _Pending.number = _Pending.number, None
    return last


def raise_pending() -> None:
    """Raise EndedBySignal if a signal has arrived that something swallowed: an error then says nothing."""
    if _Pending.number is not None:
        raise EndedBySignal(_Pending.number)


def status_of(ended: BaseException) -> int:
    """The exit status of a command that was interrupted. The signal counts as heeded and is not raised again."""
    _Pending.number = None
    return ended.exit_status if isinstance(ended, EndedBySignal) else INTERRUPTED


def importing(frame: FrameType | None) -> bool:
    """Tell whether this frame or a frame that called it is an import."""
    while frame is not None:
        if frame.f_code.co_filename.startswith(IMPORTER):
            return True
        frame = frame.f_back
    return False


def _end(number: int, frame: FrameType | None) -> None:
    reminded, _Pending.reminded = _Pending.reminded, False
    now = time.monotonic()
    if _Pending.number is None:
        if reminded:  # heeded since it was sent
            return
        _Pending.number, _Pending.since = number, now
        _thread.start_new_thread(_remind, ())  # which takes no lock that this thread may hold
    if importing(frame) or (_cleaning_up() and (reminded or now - _Pending.since < SAME_S)):
        return
    raise EndedBySignal(_Pending.number)


def _cleaning_up() -> bool:
    """Tell whether an EndedBySignal is on its way: `finally` and `except` run for it."""
    error = sys.exc_info()[1]
    while error is not None:
        if isinstance(error, EndedBySignal):
            return True
        error = error.__context__
    return False


def _remind() -> None:
    """Send the signal again and again to the thread that takes signals, until it is heeded."""
    while True:
        time.sleep(AGAIN_S)
        number = _Pending.number
        if number is None:
            return
        _Pending.reminded = True
        if hasattr(signal, "pthread_kill"):
            signal.pthread_kill(_Pending.thread, number)
        else:  # Windows: no call of the system is interrupted, the next line of Python is
            _thread.interrupt_main(signal.Signals(number))


def _silence(otherwise: Callable[[Any], Any], unraisable: Any) -> None:
    """A signal that is raised where nothing can be is raised again: the user need not know."""
    if not getattr(unraisable.exc_value, "comes_again", False):
        otherwise(unraisable)
