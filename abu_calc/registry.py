"""Registry of the features of abu-calc: one entry registers a command, its result and its figures.

Modules are named here and imported when they are needed, so that a command loads its own feature alone.
"""

import importlib
import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from abu_calc.foundation.errors import InputError, OutputError, Place

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.figure import Figure as Drawn

    from abu_calc.reporting.charts.figure import Extras, Figure
    from abu_calc.reporting.outcome import Outcome
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


class Feature(NamedTuple):
    """One command with all that belongs to it; modules are paths below `abu_calc.features`.

    `name`: of the command; `command`: module whose `register` adds it; `results`: types of its results as
    "module:class"; `makes_figures`: function from a result to its `Extras` as "module:function"; `computes`: whether it
    loads libraries of numbers; `group`: its section of `abu --help`. Its figures stand in `FIGURES`.
    """

    name: str
    command: str
    results: tuple[str, ...] = ()
    makes_figures: str = ""
    computes: bool = True
    group: str = "Design"

    @property
    def figures(self) -> tuple[Known, ...]:
        """Figures of its results."""
        return FIGURES.get(self.name, ())


def group_of(command: str) -> str | None:
    """Section of `abu --help` that lists a command; None for a command without an entry."""
    return BY_NAME[command].group if command in BY_NAME else None


def imported(path: str) -> Any:
    """Object of a path "module:name" below `abu_calc.features`."""
    module, _, name = path.partition(":")
    return getattr(importlib.import_module(f"abu_calc.features.{module}"), name)


SETTLES: Final = "the run was simulated, and held from its beginning"
RUNS_UP: Final = "the rotor runs up in it"
SEVERAL: Final = "more than one machine has the number"

FIGURES: Final[Mapping[str, tuple[Known, ...]]] = {
    "size": (
        Known("section", "", True),
        Known("face", "", True),
        Known("arm", "the machine has a [swing_arm]", True),
        Known("seats-N", "the machine has such a bearing", True),
        Known("levels", "a level is known at a place"),
        Known("speeds", "the machine has a range of speeds at which balls balance"),
        Known("budget", "something keeps the balls from balancing to nothing"),
        Known("motion", SETTLES),
        Known("settling", SETTLES),
        Known("level", SETTLES),
        Known("level-loaded", "the machine grinds, and that was simulated from its beginning"),
        Known("run-up", "a start that runs up was simulated"),
        Known("run-up-amplitude", "a start that runs up was simulated"),
        Known("candidates", "there are runners-up"),
        Known("costs", "the drawing's tolerances cost something"),
    ),
    "check-fit": (
        Known("seats-N", "there is such a bearing", True),
        Known("zones-N", "there is such a bearing", True),
        Known("interference-N", "there is such a bearing"),
        Known("clearance-N", "there is such a bearing, of a type whose clearance is in a table"),
    ),
    "simulate": (
        Known("motion", SETTLES + ", with balls"),
        Known("settling", SETTLES + ", with balls"),
        Known("level", SETTLES),
        Known("run-up", RUNS_UP),
        Known("run-up-amplitude", RUNS_UP),
    ),
    "stability": (
        Known("growth", "growth rates over more than one speed are known"),
        Known("eigenvalues", "there are such"),
        Known("multipliers", "the support is not isotropic"),
        Known("attractors", "attractors were searched"),
    ),
    "grinding": (
        Known("levels", "a level at work is known"),
        Known("orbit"),
        Known("orbit-simulated", "it was simulated"),
        Known("hodograph", "the wheel runs out"),
        Known("response", "amplitudes over the speeds are known"),
        Known("force", "forces over the speeds are known"),
        Known("reaction", "the force round the wheel is known"),
        Known("wear", "wear is known"),
        Known("wear-imbalance", "wear is known"),
    ),
    "balance": (
        Known("planes", "", True),
        Known("residual", "there is imbalance"),
        Known("verification-N", "the readings have so many speeds and quantities"),
        Known("uncertainty", "the readings say how far off they may be"),
        Known("convention", "", True),
    ),
    "accuracy": (Known("precision", "a way to compute gave an error"),),
    "sweep": (
        Known("shares"),
        Known("basins", "starts of several kinds were drawn"),
        Known("percentiles-QUANTITY", "two of its percentiles are known"),
        Known("decides-QUANTITY", "its variance is split"),
        Known("tighten", "prices are known"),
        Known("loosen", "prices are known"),
        Known("cells", "it went over two keys with --grid"),
        Known("cells-meets", "it went over two keys with --grid, with several members in a cell"),
        Known("cells-level", "it went over two keys with --grid"),
    ),
    "optimise": (Known("front"),),
    "identify": (Known("starts", "starts were recorded"),),
    "declare": (
        Known("values", "a type test was simulated"),
        Known("runs", "runs of the simulated type test differ"),
        Known("eccentricity", "a break-even eccentricity was searched"),
        Known("series", "a series of recordings has a mean"),
    ),
    "compare": (
        *(Known(name, SEVERAL) for name in ("levels", "residual", "mass", "quiet")),
        Known("courses", "recorded starts are given with --measured"),
    ),
}
"""Figures of each command; one without a condition stands in every result of its command."""

FEATURES: Final[tuple[Feature, ...]] = (
    Feature(
        "size",
        "design.command",
        ("design.study:SizeResult", "spindle.records:SpindleSizeResult"),
        "design.figures:size_extras",
    ),
    Feature(
        "check-fit", "seats.command", ("seats.study:CheckFitResult",), "seats.figures:check_fit_extras", computes=False
    ),
    Feature(
        "simulate",
        "simulate.command",
        ("simulate.study:SimulateResult",),
        "simulate.view:simulate_extras",
        group="Simulate",
    ),
    Feature(
        "stability",
        "stability.command",
        ("stability.study:StabilityResult",),
        "stability.view:stability_extras",
        group="Simulate",
    ),
    Feature(
        "grinding",
        "grinding.command",
        ("grinding.study:GrindingResult", "spindle.records:SpindleGrindingResult"),
        "grinding.figures:grinding_extras",
        group="Simulate",
    ),
    Feature(
        "balance",
        "balancing.command",
        ("balancing.study:BalanceResult",),
        "balancing.figures:balance_extras",
        group="Measure",
    ),
    Feature(
        "effects",
        "effects.command",
        ("effects.study:EffectsResult", "effects.study:KnownEffectsResult"),
        group="Simulate",
    ),
    Feature(
        "accuracy",
        "accuracy.command",
        ("accuracy.study:AccuracyResult",),
        "accuracy.view:accuracy_extras",
        group="Simulate",
    ),
    Feature("sweep", "sweep.command", ("sweep.result:SweepResult",), "sweep.figures:sweep_extras"),
    Feature("optimise", "optimise.command", ("optimise.result:OptimiseResult",), "optimise.view:optimise_extras"),
    Feature("levels", "levels.command", ("levels.study:LevelsResult",), group="Measure"),
    Feature(
        "identify",
        "identification.command",
        ("identification.results:IdentifyResult",),
        "identification.view:identify_extras",
        group="Measure",
    ),
    Feature("measure-plan", "identification.plan_command", ("identification.plan:MeasurePlanResult",), group="Measure"),
    Feature(
        "declare",
        "declare.command",
        ("declare.study:DeclareResult", "declare.measured:MeasuredDeclareResult"),
        "declare.view:declare_extras",
        group="Measure",
    ),
    Feature("factory", "factory.command", ("factory.study:FactoryResult",), group="Measure"),
    Feature(
        "compare",
        "compare.command",
        ("compare.study:CompareResult", "compare.measured:MeasuredCompareResult"),
        "compare.measured_view:any_extras",
    ),
    Feature("verify", "verify.command", ("verify.study:VerifyResult",), group="Files"),
    Feature("validate", "files.validate", computes=False, group="Files"),
    Feature("migrate", "files.migrate", computes=False, group="Files"),
    Feature("init", "files.init", computes=False, group="Files"),
    Feature("presets", "files.presets", computes=False, group="Files"),
    Feature("schema", "files.schema", computes=False, group="Files"),
    Feature("explain", "explain.command", computes=False),
)
"""Features in the order of the help."""

BY_NAME: Final = {feature.name: feature for feature in FEATURES}


def names_of(command: str) -> str:
    """All figure names of a command, as help texts list them."""
    return ", ".join(entry.name for entry in BY_NAME[command].figures)


def _figures(command: str) -> tuple[Known, ...]:
    return BY_NAME[command].figures if command in BY_NAME else ()


def known(command: str, name: str) -> Known:
    """Figure that a name stands for; raises InputError for one that no result of the command has."""
    entry = next((candidate for candidate in _figures(command) if candidate.fits(name)), None)
    if entry is None:
        raise InputError("no such figure", place=Place(key="--figure"), found=name, allowed=names_of(command))
    return entry


def absent(command: str, name: str, there: Iterable[str]) -> InputError:
    """The error about a name that this result does not have, with the reason."""
    when = next((entry.when for entry in _figures(command) if entry.fits(name)), "")
    reason = f"; one is there where {when}" if when else ""
    return InputError(f"this result has no figure {name}{reason}", allowed=", ".join(there) or "none")


def extras_of(result: "Result") -> "Extras":
    """Figures of a result and the calculation note of its page; none if its feature makes none."""
    from abu_calc.reporting.charts.figure import Extras

    maker = BY_NAME[result.command].makes_figures if result.command in BY_NAME else ""
    extras: Extras = imported(maker)(result) if maker else Extras()
    return extras


def outcome_of(result: "Result") -> "Outcome":
    """A result as its command shows and writes it, figures of a page included."""
    outcome: Outcome = imported(f"{BY_NAME[result.command].command}:outcome_of")(result)
    return replace(outcome, settings=(("command", result.command),), extras=lambda: extras_of(result))


def save(result: "Result", path: "Path", *, force: bool) -> None:
    """Write a result as --output does; the suffix chooses the format. Raises OutputError, naming file and remedy."""
    from abu_calc.reporting.files import DRAWN, FORMATS, as_file, check_extra, further_sheets
    from abu_calc.reporting.write import Target, check_target, write

    outcome, suffix = outcome_of(result), path.suffix.lower()
    try:
        check_target(path, force=force, suffixes=(*FORMATS, *(DRAWN if outcome.drawings else ())))
        check_extra(suffix)
        write((Target(path, as_file(outcome, suffix)), *further_sheets(outcome, path)), force=force)
    except OutputError as error:
        error.remedy = error.remedy and error.remedy.replace("--force", "force=True")
        raise


def text(result: "Result", *, full: bool) -> str:
    """The report of a result as the command prints it: on one screen, or whole."""
    from abu_calc.reporting.text import as_text

    outcome = outcome_of(result)
    return as_text(outcome.blocks if full else outcome.screen)


def html(result: "Result") -> str:
    """A result in a notebook: verdict, drawing of the section, checks."""
    from abu_calc.reporting.page.card import card

    return card(outcome_of(result))


def figures_of(result: "Result") -> "tuple[Figure, ...]":
    """All figures of a result; none if its command shows none."""
    return extras_of(result).figures


def names(result: "Result") -> tuple[str, ...]:
    """Names of a result's figures."""
    return tuple(entry.name for entry in figures_of(result))


def figure(result: "Result", name: str) -> "Drawn":
    """One of them, drawn; raises InputError for a name that it does not have."""
    from abu_calc.reporting.charts.matplotlib_draw import drawn

    return drawn(named(result.command, figures_of(result), name))


def named(command: str, figures: "Iterable[Figure]", name: str) -> "Figure":
    """Figure of a name; raises InputError if there is none."""
    there = {entry.name: entry for entry in figures}
    if name not in there:
        raise absent(command, name, there)
    return there[name]
