"""Long work shows what it is at, on one line of standard error, where somebody watches."""

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from abu_calc.cli.deliver import Delivery
from abu_calc.escapes import escaped

SOON = 0.7
"""Seconds that pass in silence: most commands are done by then."""


@contextmanager
def progress(how: Delivery) -> Iterator[Callable[[str], None]]:
    """Takes texts and shows the last one with the time since the start; the line goes at the end."""
    if how.quiet or not sys.stderr.isatty():
        yield lambda _: None
        return
    import shutil

    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    from abu_calc.report.text import console

    columns = SpinnerColumn("line"), TextColumn("{task.description}", markup=False), TimeElapsedColumn()
    shown_on = console(shutil.get_terminal_size().columns, stderr=True, no_color=not how.color)
    bar = Progress(*columns, console=shown_on, transient=True)
    task = bar.add_task("", total=None)
    later = threading.Timer(SOON, bar.start)
    later.daemon = True
    later.start()
    try:
        yield lambda text: bar.update(task, description=escaped(text))
    finally:
        later.cancel()
        later.join()
        bar.stop()
