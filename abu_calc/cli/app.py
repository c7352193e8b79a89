"""The command line: parse, run one command, render its outcome, end with its exit status."""

import codecs
import importlib
import os
import sys
import warnings

import typer

from abu_calc.cli.deliver import fail
from abu_calc.cli.start import INTERRUPTED
from abu_calc.errors import AbuError, InputError, OutputError
from abu_calc.version import __version__

COMMANDS = (
    "size",
    "check-fit",
    "simulate",
    "stability",
    "effects",
    "accuracy",
    "sweep",
    "verify",
    "validate",
    "init",
    "presets",
    "schema",
    "explain",
)
"""In the order of the help; each has its module."""


def build(names: tuple[str, ...] = COMMANDS) -> typer.Typer:
    """The application with these commands: who calls one need not load the others."""
    app = typer.Typer(
        name="abu",
        help="Design calculator for passive ball autobalancers of hand grinders and machines like them.",
        epilog="Start with `abu presets`, then `abu size avtovaz-707-222`, then `abu init FILE` for a machine of your "
        "own.",
        no_args_is_help=True,
        add_completion=False,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    )
    for name in names:
        importlib.import_module(f"abu_calc.cli.{name.replace('-', '_')}").register(app)
    app.callback()(_main)
    return app


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
    _make_streams_safe()
    warnings.showwarning = _warn
    given = sys.argv[1:] if arguments is None else arguments
    status = run(given)
    try:
        sys.stdout.flush()
    except OSError:  # nobody reads on, or the disk is full: what could be printed is printed
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    sys.exit(status)


def _warn(message: Warning | str, *_: object, **__: object) -> None:
    """What goes wrong and is done without: a line, not a line of code."""
    print(f"warning: {message}", file=sys.stderr)


def run(arguments: list[str]) -> int:
    """Run `abu` with these arguments and return its exit status; every error is printed in a line or two."""
    command = next((word for word in arguments if not word.startswith("-")), "")
    as_json = "--json" in arguments
    try:
        names = (command,) if command in COMMANDS else COMMANDS
        status = typer.main.get_command(build(names)).main(arguments, prog_name="abu", standalone_mode=False)
    except AbuError as error:
        return fail(command, error, as_json)
    except (KeyboardInterrupt, typer.Abort):
        status = INTERRUPTED
    except BrokenPipeError:
        return 0
    except OSError as error:
        return fail(command, OutputError(f"cannot be written: {error.strerror}"), as_json=False)
    except Exception as error:
        # Errors of the parser of command lines, whichever Typer brings along, word themselves so.
        if worded := getattr(error, "format_message", None):
            asked = f"Try `abu {command} --help`." if command in COMMANDS else "Try `abu --help`."
            return fail(command, InputError(worded(), remedy=asked), as_json)
        if os.environ.get("ABU_DEBUG"):
            raise
        return fail(command, error, as_json)
    if status == INTERRUPTED:
        print("Interrupted; nothing was written.", file=sys.stderr)
    return status if isinstance(status, int) else 0


PLAIN = str.maketrans(
    {"µ": "u", "×": "x", "·": "*", "Ø": "dia ", "√": "sqrt", "…": "...", "→": "->", "−": "-", "–": "-", "±": "+-",
     "≤": "<=", "≥": ">=", "°": " deg", "²": "^2", "³": "^3", "Ω": "Omega", "ω": "omega", "Δ": "Delta", "ε": "eps",
     "█": "#", "▓": "+", "▒": "=", "░": "-",
     "β": "beta", "ρ": "rho", "σ": "sigma", "κ": "kappa", "θ": "theta", "γ": "gamma", "π": "pi", "₀": "0"}
)  # fmt: skip


def _spelled(error: UnicodeError) -> tuple[str, int]:
    """What a console without a sign gets instead of it, "?" where there is nothing better."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    text = error.object[error.start : error.end].translate(PLAIN)
    return "".join(sign if sign.isascii() else "?" for sign in text), error.end


def _make_streams_safe() -> None:
    """A character that a console cannot show must not end a calculation; pipes on Windows get UTF-8."""
    codecs.register_error("spelled", _spelled)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            if os.name == "nt" and not stream.isatty():
                stream.reconfigure(encoding="utf-8")
            stream.reconfigure(errors="spelled")
