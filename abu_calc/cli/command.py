"""A command is a function that returns an Outcome; this adds the options that all commands share.

Its parameters are called like the arguments of the study it asks, so that an error about an argument names the option.
"""

import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, get_args

import typer

from abu_calc.cli.asked import asked
from abu_calc.cli.deliver import Delivery, deliver
from abu_calc.cli.figures import asked_figures, figure_option
from abu_calc.cli.filing import write_files
from abu_calc.errors import InputError, Place
from abu_calc.patience import limited
from abu_calc.report.outcome import Outcome

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
        outcome = replace(outcome, asked=asked(name, own, given))
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
