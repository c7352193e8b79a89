"""The figures of a result, whichever study it comes from.

Names of figures by command: what can be asked for before anything is computed, and when a result has it.
"""

import importlib
import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Final, NamedTuple

from abu_calc.foundation.errors import InputError, Place
from abu_calc.reporting.charts.figure import Extras, Figure
from abu_calc.reporting.charts.matplotlib_draw import drawn

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

    from abu_calc.simulation.result import Result


class Known(NamedTuple):
    """A figure's name, N standing for a number and QUANTITY for a word; `when` a result has it; `drawn` to scale."""

    name: str
    when: str = ""
    drawn: bool = False

    def fits(self, name: str) -> bool:
        """True if a name matches this one."""
        pattern = re.escape(self.name).replace("QUANTITY", r"[\w.\[\]-]+").replace(r"\-N", r"\-[1-9]\d*")
        return re.fullmatch(pattern, name) is not None


SETTLES: Final = "the run was simulated, and held from its beginning"
RUNS_UP: Final = "the rotor runs up in it"
SEVERAL: Final = "more than one machine has the number"

KNOWN: Final[dict[str, tuple[Known, ...]]] = {
    "size": (
        Known("section", "", True), Known("face", "", True),
        Known("arm", "the machine has a [swing_arm]", True), Known("seats-N", "the machine has such a bearing", True),
        Known("levels", "a level is known at a place"),
        Known("speeds", "the machine has a range of speeds at which balls balance"),
        Known("budget", "something keeps the balls from balancing to nothing"), Known("motion", SETTLES),
        Known("settling", SETTLES), Known("level", SETTLES),
        Known("level-loaded", "the machine grinds, and that was simulated from its beginning"),
        Known("run-up", "a start that runs up was simulated"), Known("candidates", "there are runners-up"),
        Known("costs", "the drawing's tolerances cost something"),
    ),
    "simulate": (
        Known("motion", SETTLES + ", with balls"), Known("settling", SETTLES + ", with balls"), Known("level", SETTLES),
        Known("run-up", RUNS_UP),
    ),
    "check-fit": (
        Known("seats-N", "there is such a bearing", True), Known("zones-N", "there is such a bearing", True),
        Known("interference-N", "there is such a bearing"),
        Known("clearance-N", "there is such a bearing, of a type whose clearance is in a table"),
    ),
    "grinding": (
        Known("levels", "a level at work is known"), Known("orbit"), Known("orbit-simulated", "it was simulated"),
        Known("hodograph", "the wheel runs out"), Known("response", "amplitudes over the speeds are known"),
        Known("force", "forces over the speeds are known"), Known("reaction", "the force round the wheel is known"),
        Known("wear", "wear is known"), Known("wear-imbalance", "wear is known"),
    ),
    "stability": (
        Known("growth", "growth rates over more than one speed are known"), Known("eigenvalues", "there are such"),
        Known("multipliers", "the support is not isotropic"),
    ),
    "accuracy": (Known("precision", "a way to compute gave an error"),),
    "balance": (
        Known("planes", "", True), Known("residual", "there is imbalance"),
        Known("verification-N", "the readings have so many speeds and quantities"),
        Known("uncertainty", "the readings say how far off they may be"),
    ),
    "compare": tuple(Known(name, SEVERAL) for name in ("levels", "residual", "mass", "settling")),
    "sweep": (
        Known("shares"), Known("basins", "starts of several kinds were drawn"),
        Known("percentiles-QUANTITY", "two of its percentiles are known"),
        Known("decides-QUANTITY", "its variance is split"), Known("tighten", "prices are known"),
        Known("loosen", "prices are known"), Known("cells", "it went over two keys with --grid"),
        Known("cells-meets", "it went over two keys with --grid, with several members in a cell"),
        Known("cells-level", "it went over two keys with --grid"),
    ),
}  # fmt: skip
"""Figures of the commands that have some.

A name without a condition stands in every result of its command.
"""


def names_of(command: str) -> str:
    """All figure names of a command, as help texts list them."""
    return ", ".join(entry.name for entry in KNOWN[command])


def known(command: str, name: str) -> Known:
    """Figure that a name stands for; raises InputError for one that no result of the command has."""
    entry = next((candidate for candidate in KNOWN.get(command, ()) if candidate.fits(name)), None)
    if entry is None:
        raise InputError("no such figure", place=Place(key="--figure"), found=name, allowed=names_of(command))
    return entry


def absent(command: str, name: str, there: Iterable[str]) -> InputError:
    """The error about a name that this result does not have, with the reason."""
    when = next((entry.when for entry in KNOWN.get(command, ()) if entry.fits(name)), "")
    reason = f"; one is there where {when}" if when else ""
    return InputError(f"this result has no figure {name}{reason}", allowed=", ".join(there) or "none")


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
    module = importlib.import_module(f"abu_calc.reporting.charts.{result.command.replace('-', '_')}")
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
