"""Registration of commands: functions that return an Outcome, with the options that all share.

A parameter of a command is called like the argument of the study it asks, so that an error about an argument names the
option.

    SCENES, File, …    types of options that several commands about scenes share
    asked              the command line that gives a result again
    write_files        the files that a command was asked for, written when all is computed
    add_command        a function made a command
"""

import inspect
import os
import shlex
import subprocess
from collections.abc import Callable, Iterable, Iterator, Mapping, Sized
from contextlib import contextmanager
from dataclasses import replace
from inspect import Parameter
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final, get_args

import typer

from abu_calc.cli.output import Delivery, asked_figures, deliver, figure_option
from abu_calc.cli.progress import progress
from abu_calc.foundation.errors import InputError, OutputError, Place
from abu_calc.foundation.patience import limited
from abu_calc.foundation.progress import Progress, Stage
from abu_calc.registry import extras_of
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.reporting.charts.figure import Figure, MakesExtras

SCENES: Final = ("idle", "grinding", "run-up", "swing-arm-idle", "swing-arm-cutting")
"""Scenes of a machine; written out here so that `--help` loads no numerics."""

File = Annotated[
    str, typer.Argument(metavar="MACHINE|SCENE", help="A machine file, the name of a preset, or a scene file.")
]
WhichScene = Annotated[str | None, typer.Option("--scene", help=f"Of a machine: {', '.join(SCENES)}.")]
WhichStart = Annotated[
    str | None, typer.Option("--start", help="Balls: bunched (default), behind, spread, standstill, settled.")
]
Accuracy = Annotated[float, typer.Option("--accuracy", help="Accuracy asked of the results.")]
Duration = Annotated[float | None, typer.Option("--duration", metavar="S", help="Seconds to simulate.")]
With = Annotated[list[str] | None, typer.Option("--with", metavar="EFFECT", help="Take an effect in; repeatable.")]
Without = Annotated[list[str] | None, typer.Option("--without", metavar="EFFECT", help="Leave one out; repeatable.")]


def asked(name: str, parameters: Mapping[str, Parameter], given: Mapping[str, Any]) -> str:
    """The command with its arguments, and those options that are not as they are anyway; quoted for a shell."""
    words = [
        "abu",
        name,
        *(word for key, parameter in parameters.items() if key != "how" for word in _words(parameter, given[key])),
    ]
    return subprocess.list2cmdline(words) if os.name == "nt" else shlex.join(words)


def _words(parameter: Parameter, value: Any) -> Iterator[str]:
    """Command-line words of one parameter; none if its default is in force."""
    if value is None or value == parameter.default:
        return
    option = _option(parameter)
    for each in value if isinstance(value, (list, tuple)) else [value]:
        if option is None:
            yield str(each)
        elif isinstance(each, bool):
            yield option if each else option.replace("--", "--no-", 1)
        else:
            yield from (option, str(each))


def _option(parameter: Parameter) -> str | None:
    """Name of a parameter's option; None for an argument."""
    for extra in get_args(parameter.annotation)[1:]:
        # What is declared first stands where typer puts a default, as long as it has not looked at it.
        declared = (getattr(extra, "default", None), *(getattr(extra, "param_decls", None) or ()))
        flags = [each for each in declared if isinstance(each, str) and each.startswith("--")]
        if flags:
            return flags[0]
    return None


def write_files(outcome: Outcome, how: Delivery) -> bool:
    """Write all of them; False: there are none. Where one cannot be written, what was computed is told all the same."""
    if how.output is None and not outcome.further and not how.figures:
        return False
    from abu_calc.reporting.files import as_file
    from abu_calc.reporting.write import Target, write

    own = () if how.output is None else (Target(how.output, as_file(outcome, how.output.suffix.lower())),)
    try:
        with progress(how) as tell:
            named = _figures(outcome, how)
            files = chain(outcome.further, own, (Target(path, _drawn(figure, path)) for figure, path in named))
            targets = (Target(path, _told(text, f"writing {path}", tell)) for path, text in files)
            write(targets, force=how.force)
    except (InputError, OutputError) as error:
        computed = f"What was computed: {outcome.status}, exit status {outcome.exit_status} without the file."
        error.remedy = " ".join(part for part in (error.remedy, computed) if part)
        raise
    return True


def _figures(outcome: Outcome, how: Delivery) -> "list[tuple[Figure, Path]]":
    """Requested figures; raises InputError for one that this result does not have."""
    if not how.figures:
        return []
    from abu_calc.registry import named

    there = outcome.extras().figures if outcome.extras else ()
    return [(named(outcome.command, there, name), path) for name, path in how.figures]


def _drawn(figure: "Figure", path: Path) -> Iterator[str | bytes]:
    from abu_calc.reporting.charts.matplotlib_draw import figure_file

    yield figure_file(figure, path.suffix.lower())


def _told(text: str | bytes | Iterable[str | bytes], what: str, tell: Progress) -> Iterator[str | bytes]:
    """The pieces of a text, each told before it is written."""
    pieces = [text] if isinstance(text, (str, bytes)) else text
    total = len(pieces) if isinstance(pieces, Sized) else 0
    for done, piece in enumerate(pieces):
        tell(Stage(what, done / total) if total else what)
        yield piece


Machine = Annotated[str, typer.Argument(metavar="MACHINE", help="A machine file, or the name of a preset.")]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="TABLE.KEY=VALUE", help="Override one entry of the file, typed as TOML; repeatable."),
]


def _shared(
    *,
    json: Annotated[bool, typer.Option("--json", help="One JSON document on standard output.")] = False,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            help="Also write a file; its suffix says as what (.json, .toml, .csv; .txt: the whole report; "
            ".html: a page with figures; drawings: size .dxf and .svg, check-fit .svg).",
        ),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite files that exist.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print no report; the exit status tells.")] = False,
    no_color: Annotated[bool, typer.Option("--no-color", help="No colors (also: NO_COLOR).")] = False,
    full: Annotated[bool, typer.Option("--full", help="Print the whole report, not one screen of it.")] = False,
    figure: list[str] | None = None,
) -> Delivery:
    return Delivery(json, output, force, quiet, not no_color, full, asked_figures(figure or ()))


def _walled(
    *,
    patience: Annotated[
        float | None,
        typer.Option(
            "--patience",
            metavar="SECONDS",
            help="Simulate for at most so many seconds, however many evaluations; what has no answer then is not done.",
        ),
    ] = None,
) -> None:
    """The option of all commands that simulate."""


def add_command(
    app: typer.Typer,
    name: str,
    function: Callable[..., Outcome],
    more: Iterable[inspect.Parameter] = (),
    drawn: tuple[str, ...] = (),
    *,
    simulates: bool = False,
) -> None:
    """Register a command whose function returns an Outcome, with the shared options behind its own.

    `more`: options from a table, which the function takes as `**` keywords; `drawn`: suffixes of its drawing's files;
    `simulates`: whether its patience can be told.
    """
    named = inspect.signature(function, eval_str=True).parameters.values()
    own = {each.name: each for each in (*named, *more) if each.kind is not each.VAR_KEYWORD}
    walled = dict(inspect.signature(_walled, eval_str=True).parameters) if simulates else {}
    shared = _shared_by(name)
    options = dict(_options(own | walled))

    def run(**given: Any) -> None:
        how = _shared(**{key: given[key] for key in shared})
        how.check(name, drawn)
        wanted = {"how": how} if "how" in own else {}
        with _naming_options(options), limited(given.get("patience")):
            outcome = function(**{key: given[key] for key in own if key != "how"}, **wanted)
        outcome = replace(outcome, asked=asked(name, own, given), extras=_extras(outcome))
        status = deliver(outcome, how, wrote=write_files(outcome, how))
        if status:
            raise typer.Exit(status)

    parameters = [
        parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY)
        for parameter in (*own.values(), *walled.values(), *shared.values())
        if parameter.name != "how"
    ]
    run.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    run.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    run.__doc__ = function.__doc__
    # Given by itself it is wrapped, not cut.
    app.command(name, short_help=inspect.cleandoc(run.__doc__ or "").partition("\n\n")[0])(run)


def _extras(outcome: Outcome) -> "MakesExtras | None":
    """Function that makes the figures and the note of a page, as the registry names it; None without a study."""
    result = outcome.content
    return None if isinstance(result, dict) else lambda: extras_of(result)


def _shared_by(command: str) -> dict[str, inspect.Parameter]:
    """The shared options; that of figures tells a command's own, and stands behind --output."""
    shared = dict(inspect.signature(_shared, eval_str=True).parameters)
    del shared["figure"]
    option = figure_option(command)
    if option is None:
        return shared
    rest = {name: shared.pop(name) for name in list(shared) if name not in ("json", "output")}
    return {**shared, "figure": option, **rest}


def _options(parameters: Mapping[str, inspect.Parameter]) -> Iterator[tuple[str, str]]:
    """Parameters, and the options that set them."""
    for name, parameter in parameters.items():
        for extra in get_args(parameter.annotation)[1:]:
            # What is declared first stands where typer puts a default, as long as it has not looked at it.
            declared = (getattr(extra, "default", None), *(getattr(extra, "param_decls", None) or ()))
            yield from ((name, each) for each in declared if isinstance(each, str) and each.startswith("--"))


@contextmanager
def _naming_options(options: Mapping[str, str]) -> Iterator[None]:
    """Errors about an argument name its option; those about entries of a file stay as they are."""
    try:
        yield
    except InputError as error:
        option = options.get(error.place.key or "")
        if option is None or error.place.file is not None:
            raise
        raise error.at(Place(key=option)) from None
