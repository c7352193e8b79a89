"""The figures of a result, whichever study it comes from."""

import importlib
from collections.abc import Iterable
from typing import TYPE_CHECKING, Final

from abu_calc.report.figures.figure import Extras, Figure
from abu_calc.report.figures.names import absent
from abu_calc.report.plotting.draw import drawn

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

    from abu_calc.studies.result import Result

MAKERS: Final = {
    "accuracy": "accuracy_extras",
    "balance": "balance_extras",
    "check-fit": "check_fit_figures",
    "compare": "compare_extras",
    "grinding": "grinding_extras",
    "simulate": "simulate_extras",
    "size": "size_extras",
    "stability": "stability_extras",
    "sweep": "sweep_extras",
}
"""Functions that make the figures, by command, each in the module of its command's name."""


def figures_of(result: "Result") -> tuple[Figure, ...]:
    """All figures of a result; none if its command shows none."""
    maker = MAKERS.get(result.command)
    if maker is None:
        return ()
    module = importlib.import_module(f"abu_calc.report.figures.{result.command.replace('-', '_')}")
    made: Extras | Iterable[Figure] = getattr(module, maker)(result)
    return made.figures if isinstance(made, Extras) else tuple(made)


def names(result: "Result") -> tuple[str, ...]:
    """Names of a result's figures."""
    return tuple(entry.name for entry in figures_of(result))


def figure(result: "Result", name: str) -> "Drawn":
    """One of them, drawn; raises InputError for a name that it does not have."""
    return drawn(named(result.command, figures_of(result), name))


def named(command: str, figures: Iterable[Figure], name: str) -> Figure:
    """Figure of a name; raises InputError if there is none."""
    there = {entry.name: entry for entry in figures}
    if name not in there:
        raise absent(command, name, there)
    return there[name]
