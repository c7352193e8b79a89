"""The command line: parse, run one command, render its outcome, end with its exit status."""

import os
import sys
import warnings
from typing import Final

import typer

from abu_calc.cli.help import SectionedGroup
from abu_calc.cli.streams import make_safe
from abu_calc.cli.watch import WatchRequest
from abu_calc.foundation.errors import (
    AbuError,
    InputError,
    NotTrustworthyError,
    OutputError,
    Place,
    escaped,
    escaped_lines,
    shortened,
)
from abu_calc.foundation.parallel import INTERRUPTED, EndedBySignal, leave_signals, raise_pending, status_of
from abu_calc.registry import BY_NAME, FEATURES, imported
from abu_calc.version import __version__

FIRST_STEPS: Final = """\
abu-calc sizes ball autobalancers of hand grinders. Three commands to try:

  abu size avtovaz-707-222            sizes the autobalancer of a preset
  abu init my-grinder.toml            writes a file for a machine of your own
  abu check-fit --designation 6203    recommends tolerance classes for its seats

All commands: abu --help. Completion by the Tab key: abu --install-completion."""
"""Text that `abu` prints without arguments."""

COMPLETION: Final = "_ABU_COMPLETE"
"""Set by shells that ask how a line may go on."""

LONGEST_MESSAGE: Final = 400
"""Characters of what the parser of command lines says, which repeats what it was given."""

BUG: Final = 3
"""Exit status of an error that no part of the program foresees."""

MEANINGS: Final = {
    0: "no check failed",
    1: "a check failed or could not be done",
    2: "the input or the options are wrong",
    3: "no trustworthy number could be computed",
}
"""Meaning of each exit status."""

COMMANDS = tuple(feature.name for feature in FEATURES)
"""Names of the commands in the order of the help."""

NUMERIC: Final = frozenset(feature.name for feature in FEATURES if feature.computes)
"""Commands that load libraries of numbers."""
NEEDED_MB: Final = 760
"""Address space that these libraries reserve, most of which they never use: 700 MB on two processors."""


def build(names: tuple[str, ...] = COMMANDS, *, listed: bool = False) -> typer.Typer:
    """The application with these commands; one alone is the application, so that no other part of it is loaded.

    `listed`: the commands are named, and none is loaded; that is all that the help of the application asks for.
    """
    app = typer.Typer(
        name="abu",
        cls=SectionedGroup,
        help="Design calculator for passive ball autobalancers of hand grinders and machines like them.",
        epilog="List the presets: `abu presets`. Size one: `abu size avtovaz-707-222`. Describe a machine of your own: "
        "`abu init my-grinder.toml`.",
        no_args_is_help=True,
        add_completion=len(names) > 1,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    )
    if not listed:
        from abu_calc.cli.command import add_command
    for name in names:
        feature = BY_NAME[name]
        if listed:
            app.command(name, short_help=feature.about, rich_help_panel=feature.group)(_listed)
        else:
            add_command(app, name, imported(feature.command))
    if len(names) > 1:
        app.callback()(_main)
    return app


def _listed() -> None:
    """A command that is named, not loaded."""


def _print_version(asked: bool) -> None:
    if asked:
        print(f"abu-calc {__version__}")
        raise typer.Exit


def _main(
    version: bool = typer.Option(False, "--version", callback=_print_version, is_eager=True, help="Show the version."),
) -> None:
    """Design calculator for passive ball autobalancers of hand grinders and machines like them."""


def main(arguments: list[str] | None = None) -> None:
    """Run `abu` and leave the process with its exit status."""
    outlet = make_safe()
    warnings.showwarning = _warn
    status = run(sys.argv[1:] if arguments is None else arguments)
    sys.stdout.flush()
    if outlet.fault:
        print(
            f"abu: standard output cannot be written: {outlet.fault}; {MEANINGS.get(status, 'interrupted')}.",
            file=sys.stderr,
        )
        status = OutputError.exit_status
    if (signal_number := leave_signals()) is not None:  # it arrived during the last import
        print("Interrupted at the end; everything was written.", file=sys.stderr)
        status = 128 + signal_number
    sys.exit(status)


def _warn(message: Warning | str, *_: object, **__: object) -> None:
    """Print a warning as one line, without the line of code that raised it."""
    print(f"warning: {escaped(str(message))}", file=sys.stderr)


def run(arguments: list[str]) -> int:
    """Run `abu` with these arguments and return its exit status; every error is printed in a line or two."""
    if not arguments and COMPLETION not in os.environ:
        print(FIRST_STEPS)
        return 0
    command = next((word for word in arguments if not word.startswith("-")), "")
    as_json = "--json" in arguments
    if command in NUMERIC and not {"--help", "-h"} & set(arguments) and (short := _memory()) is not None:
        return fail(command, short, as_json)
    try:
        try:
            alone = command in COMMANDS and command == arguments[0]
            # Options of the application end it: a command that is not the first word follows "--".
            listed = not alone and "--" not in arguments and COMPLETION not in os.environ
            app = build((command,) if alone else COMMANDS, listed=listed)
            given, name = (arguments[1:], f"abu {command}") if alone else (arguments, "abu")
            status = typer.main.get_command(app).main(given, prog_name=name, standalone_mode=False)
        except Exception:
            raise_pending()
            raise
    except WatchRequest as watch:
        return watch.follow(run, arguments)
    except AbuError as error:
        return fail(command, error, as_json)
    except (KeyboardInterrupt, EndedBySignal) as ended:
        status = status_of(ended)
    except typer.Abort:
        status = INTERRUPTED
    except (ImportError, MemoryError) as error:
        return fail(command, _starved(error), as_json)
    except OSError as error:
        place = Place(str(error.filename)) if error.filename else Place()
        return fail(command, OutputError(f"refused by the system: {error.strerror or error}", place=place), as_json)
    except Exception as error:
        # Errors of the parser of command lines, whichever Typer brings along, word themselves so.
        if worded := getattr(error, "format_message", None):
            asked = f"Try `abu {command} --help`." if command in COMMANDS else "Try `abu --help`."
            return fail(command, InputError(shortened(escaped(worded()), LONGEST_MESSAGE), remedy=asked), as_json)
        if os.environ.get("ABU_DEBUG"):
            raise
        return fail(command, error, as_json)
    if isinstance(status, int) and status >= INTERRUPTED - 2:
        print("Interrupted; nothing was written.", file=sys.stderr)
    return status if isinstance(status, int) else 0


def _starved(error: BaseException) -> NotTrustworthyError:
    """The error of a process without memory, or with half a library."""
    if isinstance(error, ImportError):
        text = f"a library cannot be loaded: {shortened(escaped(str(error)))}"
        return NotTrustworthyError(f"{text}; install abu-calc again, or give the process more memory")
    return NotTrustworthyError("the memory is exhausted; give the process more memory, or request less at once")


def _memory() -> NotTrustworthyError | None:
    """The error of a process that may have too little memory: libraries of C then end it, or wait for ever."""
    try:
        import resource
    except ImportError:  # Windows
        return None
    most = resource.getrlimit(resource.RLIMIT_AS)[0]
    if most == resource.RLIM_INFINITY or most >= NEEDED_MB << 20:
        return None
    return NotTrustworthyError(
        f"the process may have {most >> 20} MB of address space and needs {NEEDED_MB} MB: raise `ulimit -v`"
    )


def fail(command: str, error: BaseException, as_json: bool) -> int:
    """Tell an error: a line or two on standard error, the envelope on standard output if JSON was asked for."""
    if as_json:
        from abu_calc.reporting.outcome import error_document, to_json

        print(to_json(error_document(command, error)))
    head = " ".join(part for part in ("abu", shortened(escaped(command))) if part)
    if isinstance(error, AbuError):
        print(f"{head}: {escaped_lines(str(error))}", file=sys.stderr)
        return error.exit_status
    print(
        f"{head}: this is a bug in abu-calc: {type(error).__name__}: {shortened(escaped(str(error)))}\n"
        "  Set ABU_DEBUG=1 to see where, and report it with your file.",
        file=sys.stderr,
    )
    return BUG
