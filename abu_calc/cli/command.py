"""Registration of commands: functions that return an Outcome, with the options that all share.

A parameter of a command is called like the argument of the study it asks, so that an error about an argument names the
option.

    option             one option, as its help shows it
    SCENES, File, …    types of options that several commands about scenes share
    settings           the command and its options, which give a result again
    write_files        the files that a command was asked for, written when all is computed
    add_command        a function made a command
"""

import inspect
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sized
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from inspect import Parameter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final, get_args

import typer

from abu_calc.cli.help import OUTPUT, HelpAll, SectionedCommand
from abu_calc.cli.output import Delivery, asked_figures, deliver, figure_option
from abu_calc.cli.progress import progress
from abu_calc.foundation.call_files import one_call
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.patience import limited
from abu_calc.foundation.progress import Progress, Stage
from abu_calc.registry import BY_NAME, extras_of
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.reporting.charts.figure import Figure, MakesExtras

SCENES: Final = ("idle", "grinding", "run-up", "swing-arm-idle", "swing-arm-cutting")
"""Scenes of a machine; written out here so that `--help` loads no numerics."""


def option(usage: str, text: str, panel: str | None = None) -> Any:
    """An option as its help shows it: its names, each with its dashes, then what stands for its value.

    >>> option("--output -o FILE", "File to write.").metavar
    'FILE'
    """
    names, _, value = re.sub(" (?!-)", "\n", usage, count=1).partition("\n")
    return typer.Option(*names.split(), metavar=value or None, help=text, rich_help_panel=panel)


File = Annotated[str, typer.Argument(metavar="MACHINE|SCENE", help="Machine file, scene file or name of a preset.")]
WhichScene = Annotated[str | None, option("--scene NAME", f"Scene of a machine: {', '.join(SCENES)}.")]
WhichStart = Annotated[
    str | None,
    option(
        "--start NAME",
        "Balls at the start: bunched (together, the default), behind, spread (evenly), standstill or settled.",
    ),
]
Accuracy = Annotated[float, option("--accuracy RATIO", "Relative error allowed in the results.")]
Duration = Annotated[float | None, option("--duration S", "Simulate this many seconds.")]
With = Annotated[list[str] | None, option("--with EFFECT", "Add an effect; repeatable.")]
Without = Annotated[list[str] | None, option("--without EFFECT", "Remove an effect; repeatable.")]


def settings(name: str, parameters: Mapping[str, Parameter], given: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    """The command with its arguments, and those options that are not as they are anyway, each with its value."""
    values = [row for key, parameter in parameters.items() if key != "how" for row in _set(parameter, given[key])]
    return (("command", name), *values)


def _set(parameter: Parameter, value: Any) -> Iterator[tuple[str, str]]:
    """Name and value of one parameter, once for each of several values; none if its default is in force."""
    if value is None or value == parameter.default:
        return
    label = (_option(parameter) or parameter.name).strip("-_").replace("-", " ").replace("_", " ")
    for each in value if isinstance(value, (list, tuple)) else [value]:
        yield label, {True: "yes", False: "no"}[each] if isinstance(each, bool) else str(each)


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
    """Write all that can be written; False: there are none. For a file that cannot, the computed result is told."""
    if not how.outputs and not outcome.further and not how.figures:
        return False
    from abu_calc.reporting.files import as_file, further_sheets
    from abu_calc.reporting.write import Target, write

    sheets = [sheet for path in how.outputs for sheet in further_sheets(outcome, path)]
    figures = cache(lambda: outcome.extras().figures if outcome.extras else ())
    files = (
        *outcome.further,
        *(Target(path, _made(as_file, outcome, path.suffix.lower())) for path in how.outputs),
        *(Target(path, _made(_sheet, path, text, how.force)) for path, text in sheets),
        *(Target(path, _made(_drawn, outcome.command, figures, name, path)) for name, path in how.figures),
    )
    try:
        with progress(how) as tell:
            write((Target(path, _told(text, f"writing {path}", tell)) for path, text in files), force=how.force)
    except InputError as error:
        computed = (
            f"The computed result is {outcome.status}; without the file, the exit status is {outcome.exit_status}."
        )
        error.remedy = " ".join(part for part in (error.remedy, computed) if part)
        raise
    return True


def _made(make: "Callable[..., str | bytes]", *arguments: Any) -> Iterator[str | bytes]:
    """The text of a file, made when it is written."""
    yield make(*arguments)


def _sheet(path: Path, text: str, force: bool) -> str:
    """The text of a further sheet, whose file was not asked for by name."""
    from abu_calc.reporting.write import check_target

    check_target(path, force=force)
    return text


def _drawn(command: str, figures: "Callable[[], tuple[Figure, ...]]", name: str, path: Path) -> bytes | str:
    """File of a figure; raises InputError for one that the result does not have."""
    from abu_calc.registry import named
    from abu_calc.reporting.charts.matplotlib_draw import figure_file

    return figure_file(named(command, figures(), name), path.suffix.lower())


def _told(text: str | bytes | Iterable[str | bytes], what: str, tell: Progress) -> Iterator[str | bytes]:
    """The pieces of a text, each told before it is written."""
    pieces = [text] if isinstance(text, (str, bytes)) else text
    total = len(pieces) if isinstance(pieces, Sized) else 0
    for done, piece in enumerate(pieces):
        tell(Stage(what, done / total) if total else what)
        yield piece


Machine = Annotated[str, typer.Argument(metavar="MACHINE", help="Machine file or name of a preset.")]
Overrides = Annotated[
    list[str] | None, option("--set TABLE.KEY=VALUE", "Replace one entry by a TOML value; repeatable.")
]


def _output_option(formats: Iterable[str]) -> Any:
    """The option --output with the formats that one command writes."""
    *others, last = formats
    text = f"Also write as {', '.join(others)}{' or ' if others else ''}{last}; repeatable."
    return Annotated[list[Path] | None, option("--output -o FILE", text, OUTPUT)]


def _formats(drawn: tuple[str, ...], figures: bool) -> Iterator[str]:
    yield from (".json", ".toml", ".csv", ".txt (whole report)", ".html (page with figures)" if figures else ".html")
    yield from (f"{suffix} ({'solids' if suffix in ('.step', '.stp') else 'drawing'})" for suffix in drawn)


def _shared(
    *,
    json: Annotated[bool, option("--json", "Print one JSON document on standard output.", OUTPUT)] = False,
    output: list[Path] | None = None,
    figure: list[str] | None = None,
    force: Annotated[bool, option("--force", "Overwrite existing files.", OUTPUT)] = False,
    quiet: Annotated[bool, option("--quiet -q", "Print no report; use the exit status.", OUTPUT)] = False,
    no_color: Annotated[bool, option("--no-color", "Print without colours, as NO_COLOR does.", OUTPUT)] = False,
    full: Annotated[bool, option("--full", "Print the whole report.", OUTPUT)] = False,
) -> Delivery:
    return Delivery(json, tuple(output or ()), force, quiet, not no_color, full, asked_figures(figure or ()))


def _walled(
    *,
    patience: Annotated[
        float | None, option("--patience S", "Longest simulation; open checks are NOT EVALUATED.")
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
    formats: tuple[str, ...] = (),
    simulates: bool = False,
    seldom: Iterable[str] = (),
) -> None:
    """Register a command whose function returns an Outcome, with the shared options behind its own.

    `more`: options from a table, which the function takes as `**` keywords; `drawn`: suffixes of its drawing's files;
    `formats`: those of --output, for commands whose result is a text of its own; `simulates`: whether the command has
    the option --patience; `seldom`: panels and options that `--help` lists by name and `--help-all` explains.
    """
    named = inspect.signature(function, eval_str=True).parameters.values()
    own = {each.name: each for each in (*named, *more) if each.kind is not each.VAR_KEYWORD}
    listed = frozenset(seldom)
    helped = [Parameter("help_all", Parameter.KEYWORD_ONLY, default=False, annotation=HelpAll)] if listed else []
    walled = dict(inspect.signature(_walled, eval_str=True).parameters) if simulates else {}
    shared = _shared_by(name, drawn, formats)
    options = {key: option for key, each in (own | walled).items() if (option := _option(each))}

    def run(**given: Any) -> None:
        how = _shared(**{key: given[key] for key in shared})
        wanted = {"how": how} if "how" in own else {}
        with one_call():
            how.check(name, drawn)
            with _naming_options(options), limited(given.get("patience")):
                outcome = function(**{key: given[key] for key in own if key != "how"}, **wanted)
            outcome = replace(outcome, settings=settings(name, own, given), extras=_extras(outcome))
            status = deliver(outcome, how, wrote=write_files(outcome, how))
        if status:
            raise typer.Exit(status)

    parameters = [
        parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY)
        for parameter in (*own.values(), *walled.values(), *shared.values(), *helped)
        if parameter.name != "how"
    ]
    run.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    run.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    app.command(
        name,
        cls=type("Command", (SectionedCommand,), {"seldom": listed}),
        help=function.__doc__,
        short_help=BY_NAME[name].about,
    )(run)


def _extras(outcome: Outcome) -> "MakesExtras | None":
    """Function that makes the figures and the note of a page, as the registry names it; None without a study."""
    result = outcome.content
    return None if isinstance(result, dict) else lambda: extras_of(result)


def _shared_by(command: str, drawn: tuple[str, ...], formats: tuple[str, ...]) -> dict[str, inspect.Parameter]:
    """The shared options; --output lists the command's own formats, --figure its own figures."""
    shared = dict(inspect.signature(_shared, eval_str=True).parameters)
    figure = figure_option(command)
    shared["output"] = shared["output"].replace(
        annotation=_output_option(formats or _formats(drawn, figure is not None))
    )
    if figure is None:
        del shared["figure"]
        return shared
    return {**shared, "figure": figure}


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
