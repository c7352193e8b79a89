"""`--figure NAME=FILE`: figures as files of their own, refused early where they could not be written."""

import inspect
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Final

import typer

from abu_calc.errors import InputError, OutputError, Place
from abu_calc.report.figures.names import KNOWN, known, names_of

OPTION: Final = "--figure"
PLACE: Final = Place(key=OPTION)


def figure_option(command: str) -> inspect.Parameter | None:
    """The option, with the names that a command knows; None for commands without figures."""
    if command not in KNOWN:
        return None
    help_ = f"Also write one figure as FILE.svg, .png or .pdf; repeatable. NAME: {names_of(command)}."
    option = typer.Option(OPTION, metavar="NAME=FILE", help=help_)
    return inspect.Parameter(
        "figure", inspect.Parameter.KEYWORD_ONLY, default=None, annotation=Annotated[list[str] | None, option]
    )


def asked_figures(given: Iterable[str]) -> tuple[tuple[str, Path], ...]:
    """Names and files."""
    return tuple(_pair(argument) for argument in given)


def _pair(text: str) -> tuple[str, Path]:
    name, sign, file = text.partition("=")
    if not (name.strip() and sign and file.strip()):
        raise InputError(
            "not a figure and its file", place=PLACE, found=text, allowed="NAME=FILE, as levels=levels.svg"
        )
    return name.strip(), Path(file.strip())


def check_figures(command: str, figures: Iterable[tuple[str, Path]], output: Path | None, *, force: bool) -> None:
    """Refuse unknown names, files that could not be written, and what is not installed."""
    from abu_calc.report.plotting.draw import SUFFIXES, check_matplotlib
    from abu_calc.report.write import check_target

    taken = set() if output is None else {os.path.realpath(output)}
    for name, path in figures:
        figure = known(command, name)
        check_target(path, force=force, suffixes=SUFFIXES, option=OPTION)
        if os.path.realpath(path) in taken:
            raise OutputError("two outputs name the same file", place=Place(str(path)), remedy="Give another name.")
        taken.add(os.path.realpath(path))
        if not (figure.drawn and path.suffix.lower() == ".svg"):
            check_matplotlib(f"{path.suffix.lower()} files of {name}")
