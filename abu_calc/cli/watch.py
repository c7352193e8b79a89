"""`--watch`: a command runs again whenever a file that it reads is saved, and its page in the browser follows.

The files are compared by content, so that network drives and editors that replace files work. The runs share a process
of their own, which keeps its libraries loaded; a save during a run ends that process and begins another.
"""

import io
import json
import os
import time
from collections.abc import Callable, Iterable, Mapping
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from abu_calc.foundation.call_files import READ
from abu_calc.foundation.errors import AbuError, InputError, Place
from abu_calc.foundation.parallel import EndedBySignal, begin_worker, interrupts_left_to_parent, status_of

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

    from abu_calc.reporting.page.watched import WatchedPage

WATCHED: Final = ("size", "check-fit", "balance", "simulate")
"""Commands that have the option."""
SOURCES: Final = ("machine", "readings", "file")
"""Arguments that name the file, whatever the command."""
OPTION: Final = "--watch"
ABOUT: Final = "Repeat at each save; the .html page follows."
EACH_S: Final = 0.1
"""Seconds between two looks at the files."""
GONE_S: Final = 1.0
"""Seconds after which a missing file counts as deleted: some editors delete a file before they write it again."""
COMPARED: Final = 200_000
"""Bytes of a file that are compared; of a longer one also its size and the time of its last change."""

Run = Callable[[list[str]], int]
Content = tuple[object, ...] | str


def content_of(path: Path) -> Content:
    """What tells one content of a file from another; of a file that cannot be read the reason."""
    try:
        with path.open("rb") as file:
            head, about = file.read(COMPARED), os.fstat(file.fileno())
    except OSError as error:
        return error.strerror or str(error)
    return (head,) if about.st_size <= COMPARED else (head, about.st_size, about.st_mtime_ns)


class Saves:
    """The files of a command, and what they held when they were last read."""

    def __init__(self, path: Path) -> None:
        self._known: dict[Path, Content | None] = {path: None}
        self._seen: dict[Path, Content] = {}
        self._since = 0.0

    def follow(self, paths: Iterable[Path]) -> None:
        """Watch these files, too."""
        for path in paths:
            self._known.setdefault(path, content_of(path))

    def saved(self, now: float) -> bool:
        """True if a file has changed and rests: two looks saw the same; `now`: time of the look [s]."""
        seen = {path: content_of(path) for path in self._known}
        if seen != self._seen:
            self._seen, self._since = seen, now
        changed = {path: content for path, content in seen.items() if content != self._known[path]}
        patience = GONE_S if any(isinstance(content, str) for content in changed.values()) else EACH_S
        if not changed or now - self._since < patience:
            return False
        self._known.update(seen)
        return True


class Answer(NamedTuple):
    """What a run gave: its JSON document, its messages, the files that it read."""

    document: dict[str, Any]
    messages: str
    read: frozenset[Path]


def work(end: "Connection", run: Run) -> None:
    """Run one command after another, as they come."""
    begin_worker()
    while True:
        arguments = end.recv()
        READ.clear()
        out, messages = io.StringIO(), io.StringIO()
        with redirect_stdout(out), redirect_stderr(messages):
            run(arguments)
        end.send(Answer(json.loads(out.getvalue()), messages.getvalue(), frozenset(READ)))


class Worker:
    """The process of the runs."""

    def __init__(self, run: Run, arguments: list[str]) -> None:
        self._run, self._arguments = run, arguments
        self._process: Any = None
        self.busy = False

    def begin(self) -> None:
        """Begin a run; one that goes on is cancelled."""
        if self.busy:
            self.end()
        if self._process is None or not self._process.is_alive():
            from multiprocessing import get_context  # here, since its imports take as long as some commands

            context = get_context("spawn")
            self._end, other = context.Pipe()
            self._process = context.Process(target=work, args=(other, self._run))
            with interrupts_left_to_parent():
                self._process.start()
            other.close()
        self._end.send(self._arguments)
        self.busy = True

    def answer(self, patience: float) -> Answer | None:
        """Answer of the run, within so many seconds; None if there is none yet. Raises EOFError if the process died."""
        if not self.busy:
            time.sleep(patience)
        elif self._end.poll(patience):
            self.busy = False
            answer: Answer = self._end.recv()
            return answer
        return None

    def end(self) -> None:
        """End the process and its run."""
        if self._process is not None:
            self._process.terminate()
            self._process.join()
            self._process = None
        self.busy = False


class WatchRequest(Exception):  # noqa: N818 (a request, not an error)
    """A command is to be run again and again: raised once its options are known to be right."""

    def __init__(self, given: Mapping[str, Any], outputs: Iterable[Path], *, quiet: bool) -> None:
        super().__init__(OPTION)
        file = next((given[key] for key in SOURCES if key in given), None)
        page = next((path for path in outputs if path.suffix.lower() == ".html"), None)
        if page is None:
            raise InputError("a page is written again and again", place=Place(key=OPTION), remedy="Add -o report.html.")
        if file is None or not Path(file).is_file():
            raise InputError(
                "a file is watched while it is edited", place=Place(key=OPTION), found=file,
                remedy="Name a file of your own. `abu presets NAME -o FILE.toml` copies a preset.",
            )  # fmt: skip
        self.file, self.page, self.quiet = Path(file), page, quiet

    def follow(self, run: Run, arguments: list[str]) -> int:
        """Run the command again and again until a signal ends it; return the exit status."""
        from tempfile import TemporaryDirectory

        from abu_calc.reporting.page.watched import WatchedPage

        with TemporaryDirectory(prefix="abu-") as folder:
            made = Path(folder) / "page.html"
            page, saves = WatchedPage(self.page), Saves(self.file)
            worker = Worker(run, child_arguments(arguments, self.page, made))
            self._tell(f"Watching {self.file}. Open {self.page} in a browser. Ctrl-C ends.")
            try:
                while True:
                    self._step(worker, saves, page, made)
            except (KeyboardInterrupt, EndedBySignal) as ended:
                status = status_of(ended)
            finally:
                worker.end()
            page.end()
            self._tell(f"Ended; {self.page} holds the last result.")
            return status

    def _step(self, worker: Worker, saves: Saves, page: "WatchedPage", made: Path) -> None:
        """Look at the files and at the run once."""
        if saves.saved(time.monotonic()):
            if isinstance(reason := content_of(self.file), str):
                worker.end()
                self._tell(page.wrong(f"{self.file}: {reason}\n  Restore the file, or end with Ctrl-C."))
            else:
                page.computing()
                worker.begin()
        try:
            answer = worker.answer(EACH_S)
        except (EOFError, OSError):
            worker.end()
            self._tell(page.wrong("The calculation ended without a result.\n  Save the file again."))
            answer = None
        if answer is not None:
            saves.follow(answer.read)
            wrong = answer.document.get("error") or not made.exists()
            self._tell(page.wrong(answer.messages) if wrong else page.right(made.read_text("utf-8"), answer.document))
        try:
            page.write()
        except AbuError as error:  # another program reads it at the moment: the next look tries again
            self._tell(str(error))

    def _tell(self, text: str) -> None:
        if not self.quiet:
            print(text, flush=True)


def child_arguments(arguments: Iterable[str], page: Path, made: Path) -> list[str]:
    """Arguments of one run, whose page is written to another place.

    >>> child_arguments(["size", "a.toml", "--watch", "-o", "r.html"], Path("r.html"), Path("t.html"))
    ['size', 'a.toml', '-o', 't.html', '--json', '--quiet', '--force']
    """
    rest = [word for word in arguments if word not in (OPTION, "--json", "--quiet", "-q", "--force")]
    names = [str(page), *(f"{option}{page}" for option in ("-o", "--output=", "-o="))]
    moved = [word.removesuffix(str(page)) + str(made) if word in names else word for word in rest]
    return [*moved, "--json", "--quiet", "--force"]
