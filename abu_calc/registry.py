"""Registry of the features of abu-calc: one entry registers a command, its result and its figures.

Modules are named here and imported when they are needed, so that a command loads its own feature alone.
"""

import importlib
import re
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from abu_calc.foundation.errors import InputError, OutputError, Place

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.figure import Figure as Drawn

    from abu_calc.reporting.charts.chart import Extras, Figure
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


class Views(NamedTuple):
    """One type of result, and the functions that show it; all paths "module:name" are below `abu_calc.features`.

    `view`: beginning of the names of two functions, …_blocks for the whole report, and …_screen for one screen, which
    `screen` names if it stands elsewhere; `extras`: its `Extras`, figures and the calculation note of a page; `note`:
    the formulas with their numbers, for --explain; `drawings`: sheets of a drawing; `solids`: the parts.
    """

    result: str
    view: str
    extras: str = ""
    screen: str = ""
    note: str = ""
    drawings: str = ""
    solids: str = ""


class Feature(NamedTuple):
    """One command with all that belongs to it; modules are paths below `abu_calc.features`.

    `name`: of the command; `about`: its line of `abu --help`; `command`: its declaration, as "module:name";
    `computes`: whether it loads libraries of numbers; `group`: its section of `abu --help`. Its figures stand in
    `FIGURES`, the views of its results in `VIEWS`.
    """

    name: str
    about: str
    command: str
    computes: bool = True
    group: str = "Design"


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
        Known("oil", "the file has [oil]"),
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

VIEWS: Final[Mapping[str, Views]] = {
    views.result: views
    for views in (
        Views(
            "design.study:SizeResult",
            "design.view:size",
            "design.figures:size_extras",
            screen="design.screen:size_screen",
            note="design.summary:explanation_blocks",
            drawings="design.sheet:size_sheets",
            solids="design.sheet:size_solids",
        ),
        Views(
            "spindle.records:SpindleSizeResult",
            "spindle.view:spindle",
            "spindle.view:spindle_extras",
            drawings="spindle.view:spindle_sheets",
            solids="spindle.view:both_solids",
        ),
        Views(
            "seats.study:CheckFitResult",
            "seats.view:check_fit",
            "seats.figures:check_fit_extras",
            note="seats.figures:seat_note",
            drawings="seats.figures:seat_sheets",
        ),
        Views("simulate.study:SimulateResult", "simulate.view:simulate", "simulate.view:simulate_extras"),
        Views("stability.study:StabilityResult", "stability.view:stability", "stability.view:stability_extras"),
        Views("grinding.study:GrindingResult", "grinding.view:grinding", "grinding.figures:grinding_extras"),
        Views(
            "spindle.records:SpindleGrindingResult",
            "spindle.view:work",
            "spindle.view:work_extras",
        ),
        Views(
            "balancing.study:BalanceResult",
            "balancing.view:balance",
            "balancing.figures:balance_extras",
            note="balancing.figures:balance_note",
        ),
        Views("effects.study:EffectsResult", "effects.study:effects"),
        Views("effects.study:KnownEffectsResult", "effects.study:known", screen="effects.study:known_blocks"),
        Views("accuracy.study:AccuracyResult", "accuracy.view:accuracy", "accuracy.view:accuracy_extras"),
        Views("sweep.result:SweepResult", "sweep.view:sweep", "sweep.figures:sweep_extras"),
        Views("optimise.result:OptimiseResult", "optimise.view:optimise", "optimise.view:optimise_extras"),
        Views("levels.study:LevelsResult", "levels.view:levels"),
        Views(
            "identification.results:IdentifyResult",
            "identification.view:identify",
            "identification.view:identify_extras",
        ),
        Views("identification.plan:MeasurePlanResult", "identification.view:plan"),
        Views("declare.study:DeclareResult", "declare.view:declare", "declare.view:declare_extras"),
        Views(
            "declare.measured:MeasuredDeclareResult",
            "declare.measured_view:measured",
            "declare.measured_view:measured_extras",
        ),
        Views("factory.study:FactoryResult", "factory.view:factory"),
        Views(
            "compare.study:CompareResult",
            "compare.view:compare",
            "compare.view:compare_extras",
            screen="compare.screen:compare_screen",
        ),
        Views(
            "compare.measured:MeasuredCompareResult",
            "compare.measured:measured",
            "compare.measured:measured_extras",
            screen="compare.measured:measured_blocks",
        ),
        Views("verify.study:VerifyResult", "verify.study:verify"),
    )
}
"""Views of each type of result."""

FEATURES: Final[tuple[Feature, ...]] = (
    Feature("size", "Size the autobalancer of a machine and simulate it.", "design.command:COMMAND"),
    Feature(
        "check-fit",
        "Check bearing seats, or recommend their tolerance classes.",
        "seats.command:COMMAND",
        computes=False,
    ),
    Feature(
        "simulate",
        "Simulate one scene: amplitude, level, quiet and rest time, ball angles.",
        "simulate.command:COMMAND",
        group="Simulate",
    ),
    Feature(
        "stability",
        "Find whether the balanced state is stable, and at which speeds.",
        "stability.command:COMMAND",
        group="Simulate",
    ),
    Feature(
        "grinding",
        "Calculate vibration, contact force and wheel wear while grinding.",
        "grinding.command:COMMAND",
        group="Simulate",
    ),
    Feature(
        "balance",
        "Balance a rotor in one plane or two from runs on a rig or in the field.",
        "balancing.command:COMMAND",
        group="Measure",
    ),
    Feature(
        "effects",
        "List the effects; for a file, show which are simulated and why.",
        "effects.command:COMMAND",
        group="Simulate",
    ),
    Feature(
        "accuracy",
        "Compare methods of simulation by error and computing time.",
        "accuracy.command:COMMAND",
        group="Simulate",
    ),
    Feature("sweep", "Vary values over many samples: share that passes, deciding values.", "sweep.command:COMMAND"),
    Feature(
        "optimise", "Find the cheapest design of which a wanted share meets the limits.", "optimise.command:COMMAND"
    ),
    Feature(
        "levels",
        "Calculate octave-band levels, weighted acceleration, daily exposure.",
        "levels.command:COMMAND",
        group="Measure",
    ),
    Feature(
        "identify",
        "Identify viscous drag rate, rolling friction and race eccentricity.",
        "identification.command:COMMAND",
        group="Measure",
    ),
    Feature(
        "measure-plan",
        "Plan the recordings for `abu identify`.",
        "identification.command:MEASURE_PLAN",
        group="Measure",
    ),
    Feature("declare", "Give the declared vibration value of a type test.", "declare.command:COMMAND", group="Measure"),
    Feature("factory", "Compare predicted levels with measured ones.", "factory.command:COMMAND", group="Measure"),
    Feature("compare", "Compare machines or variants of one machine side by side.", "compare.command:COMMAND"),
    Feature(
        "verify", "Recompute files and compare with their [expected] values.", "verify.command:COMMAND", group="Files"
    ),
    Feature(
        "validate",
        "Check files without simulating: keys, types, ranges, rules.",
        "files.command:VALIDATE",
        computes=False,
        group="Files",
    ),
    Feature(
        "init",
        "Write the short file of a new machine from a few answers.",
        "files.command:INIT",
        computes=False,
        group="Files",
    ),
    Feature("presets", "List the preset files, or print one.", "files.command:PRESETS", computes=False, group="Files"),
    Feature(
        "schema",
        "Print the JSON Schema of a kind of files or of results.",
        "files.command:SCHEMA",
        computes=False,
        group="Files",
    ),
    Feature(
        "explain",
        "Explain a sizing step, a check, an effect or a key of a machine file.",
        "explain.command:COMMAND",
        computes=False,
    ),
)
"""Features in the order of the help."""

BY_NAME: Final = {feature.name: feature for feature in FEATURES}


def names_of(command: str) -> str:
    """All figure names of a command, as help texts list them."""
    return ", ".join(entry.name for entry in FIGURES.get(command, ()))


def known(command: str, name: str) -> Known:
    """Figure that a name stands for; raises InputError for one that no result of the command has."""
    entry = next((candidate for candidate in FIGURES.get(command, ()) if candidate.fits(name)), None)
    if entry is None:
        raise InputError("no such figure", place=Place(key="--figure"), found=name, allowed=names_of(command))
    return entry


def absent(command: str, name: str, there: Iterable[str]) -> InputError:
    """The error about a name that this result does not have, with the reason."""
    when = next((entry.when for entry in FIGURES.get(command, ()) if entry.fits(name)), "")
    reason = f"; one is there where {when}" if when else ""
    return InputError(f"this result has no figure {name}{reason}", allowed=", ".join(there) or "none")


def _views(result: "Result") -> Views | None:
    kind = type(result)
    return VIEWS.get(f"{kind.__module__.removeprefix('abu_calc.features.')}:{kind.__qualname__}")


def extras_of(result: "Result") -> "Extras":
    """Figures of a result and the calculation note of its page; none if its feature makes none."""
    from abu_calc.reporting.charts.chart import Extras

    views = _views(result)
    extras: Extras = imported(views.extras)(result) if views and views.extras else Extras()
    return extras


def outcome_of(result: "Result", *, explain: bool = False) -> "Outcome":
    """A result as its command shows and writes it, figures of a page included; `explain`: with every formula."""
    from abu_calc.reporting.outcome import Outcome

    views = _views(result)
    if views is None:
        raise TypeError(f"{type(result).__name__} stands not in VIEWS")

    def made(path: str) -> "Callable[[], Any] | None":
        return (lambda: imported(path)(result)) if path else None

    noted = explain and views.note
    return Outcome(
        result.command,
        result,
        lambda: (*imported(f"{views.view}_blocks")(result), *(imported(views.note)(result) if noted else ())),
        short=None if noted else made(views.screen or f"{views.view}_screen"),
        drawings=made(views.drawings),
        solids=made(views.solids),
        settings=(("command", result.command),),
        extras=lambda: extras_of(result),
    )


def save(result: "Result", path: "Path", *, force: bool) -> None:
    """Write a result as --output does; the suffix chooses the format. Raises OutputError, naming file and remedy."""
    from abu_calc.reporting.files import DRAWN, FORMATS, as_file, check_extra, further_sheets
    from abu_calc.reporting.outcome import Target, check_target, write

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
    from abu_calc.reporting.screen import as_text

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
