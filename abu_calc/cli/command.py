"""Commands as features declare them: a study, and the options that give its arguments.

    Option             one option or argument, as its help shows it
    MACHINE, FILE, …   options that several commands share
    Command            a study with its options
    settings           the command and its options, which give a result again
    add_command        a command that Typer runs

An option is called like the argument of the study that it gives, so that an error about an argument names the option.
What is not given is left to the study. Studies are named by their paths, so that help loads none of them.
"""

import inspect
import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import replace
from functools import partial
from inspect import Parameter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final, NamedTuple, TypeAlias

import typer

from abu_calc.cli import watch
from abu_calc.cli.help import OUTPUT, HelpAll, SectionedCommand
from abu_calc.cli.output import Delivery, asked_figures, deliver, progress, write_files
from abu_calc.foundation.call_files import one_call
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.patience import limited
from abu_calc.foundation.progress import silent
from abu_calc.registry import BY_NAME, imported, names_of, outcome_of

if TYPE_CHECKING:
    from abu_calc.inputs.reading.document import FileReading
    from abu_calc.reporting.outcome import Outcome
    from abu_calc.simulation.result import Result

REQUIRED: Final = Parameter.empty
Answer: TypeAlias = "Result | Outcome"
Study: TypeAlias = "Callable[..., Result]"


class FurtherFile(NamedTuple):
    """A file that an option asks for: its suffix, and its text of the result and the options that were given."""

    suffix: str
    text: Callable[[Any, Mapping[str, Any]], "str | Iterable[str] | None"]


class Option(NamedTuple):
    """One option of a command, or one of its arguments by place.

    `key`: the argument of the study; `usage`: the names with their dashes and what stands for the value, of an argument
    by place this alone; `default`: a value that help shows, `REQUIRED`, or None for one that only the study knows;
    `converts`: function from the text that is given to the argument; `reads`: function from the name of a file, and the
    entries that --set replaces, to what the study takes first; `writes`: the file that the value names.
    """

    key: str
    type: Any
    usage: str
    text: str
    panel: str | None = None
    default: Any = None
    converts: Callable[[Any], Any] | None = None
    reads: Callable[[Any, Sequence[str]], Any] | None = None
    writes: FurtherFile | None = None

    @property
    def name(self) -> str:
        """Name of the option, with its dashes; of an argument by place the key.

        >>> Option("outputs", str, "-o --output FILE", "File to write.").name
        '--output'
        """
        return next((word for word in self.usage.split() if word.startswith("--")), self.key)

    @property
    def usual(self) -> Any:
        """The value that stands for an option which is not given: None, of flags False."""
        return False if self.type is bool else self.default

    @property
    def parameter(self) -> Parameter:
        """The option as Typer reads it from the signature of a function."""
        how: dict[str, Any] = {"help": self.text, "rich_help_panel": self.panel}
        if self.usage.startswith("-"):
            names, _, value = re.sub(" (?!-)", "\n", self.usage, count=1).partition("\n")
            shown = typer.Option(*names.split(), metavar=value or None, **how)
        else:
            shown = typer.Argument(metavar=self.usage, **how)
        kind = self.type | None if self.usual is None else self.type
        return Parameter(self.key, Parameter.KEYWORD_ONLY, default=self.usual, annotation=Annotated[kind, shown])


class Command(NamedTuple):
    """A study with the options that give its arguments.

    `study`: its path "module:name" below `abu_calc.features`; `options` in the order of help; `text`: what help says
    below the command's line; `around`: function that is given the study and calls it; `drawn`: suffixes of its
    drawing's files; `formats`: those of --output, for commands whose result is a text of its own; `simulates`: whether
    the command has the option --patience; `seldom`: panels and options that `--help` lists by name and `--help-all`
    explains.
    """

    study: str
    options: tuple[Option, ...]
    text: str = ""
    around: Callable[..., Answer] | None = None
    drawn: tuple[str, ...] = ()
    formats: tuple[str, ...] = ()
    simulates: bool = False
    seldom: tuple[str, ...] = ()

    def files(self, given: Mapping[str, Any]) -> Iterator[tuple[Option, FurtherFile]]:
        """Options that ask for a file, each with the file."""
        return ((each, each.writes) for each in self.options if each.writes and given[each.key] is not None)

    def ask(self, given: Mapping[str, Any], how: Delivery) -> Answer:
        """Read the files that are named, and run the study with the arguments that are given.

        A study that takes them is also told `how` the outcome is delivered, how many `workers` there may be, and a
        function to tell its `progress`.
        """
        study = imported(self.study)
        run = partial(self.around, study) if self.around else study
        takes = inspect.signature(study).parameters | inspect.signature(self.around or study).parameters
        own = {option.key: option for option in self.options}
        arguments = {
            key: option.converts(given[key]) if option.converts else given[key]
            for key, option in own.items()
            if given[key] not in (None, option.usual) and (key in takes or not option.writes)
        }
        arguments.pop("explain", None)
        read = [(each.key, each.reads) for each in self.options if each.reads and each.key in arguments]
        overrides = arguments.pop("set_", ()) if read else ()
        with progress(quiet=how.quiet) if "progress" in takes else nullcontext(silent) as tell:
            sources = [reads(arguments.pop(key), overrides) for key, reads in read]
            offered = {"how": how, "progress": tell, "workers": os.cpu_count() or 1}
            arguments |= {key: value for key, value in offered.items() if key in takes and key not in own}
            return run(*sources, **arguments)


def _machine(file: str, overrides: Sequence[str]) -> "FileReading":
    from abu_calc.inputs.read_machine import read_machine

    return read_machine(file, overrides)


def _any(file: str, overrides: Sequence[str]) -> "FileReading":
    from abu_calc.simulation.scene_file import read_any

    return read_any(file, overrides)


SCENES: Final = ("idle", "grinding", "run-up", "swing-arm-idle", "swing-arm-cutting")
"""Scenes of a machine; written out here so that `--help` loads no numerics."""

MACHINE: Final = Option(
    "machine", str, "MACHINE", "Machine file or name of a preset.", default=REQUIRED, reads=_machine
)
FILE: Final = Option(
    "file", str, "MACHINE|SCENE", "Machine file, scene file or name of a preset.", default=REQUIRED, reads=_any
)
SET: Final = Option("set_", list[str], "--set TABLE.KEY=VALUE", "Replace one entry by a TOML value; repeatable.")
SCENE: Final = Option("scene", str, "--scene NAME", f"Scene of a machine: {', '.join(SCENES)}.")
START: Final = Option(
    "start",
    str,
    "--start NAME",
    "Balls at the start: bunched (together, the default), behind, spread (evenly), standstill or settled.",
)
ACCURACY: Final = Option("accuracy", float, "--accuracy RATIO", "Relative error allowed in the results.", default=0.01)
IN_SIMULATIONS: Final = ACCURACY._replace(text="Relative error allowed in simulations.")
DURATION: Final = Option("duration_s", float, "--duration S", "Simulate this many seconds.")
WITH: Final = Option("with_effects", list[str], "--with EFFECT", "Add an effect; repeatable.")
WITHOUT: Final = Option("without_effects", list[str], "--without EFFECT", "Remove an effect; repeatable.")
EXPLAIN: Final = Option("explain", bool, "--explain", "Print the whole report and every formula with its numbers.")
PATIENCE: Final = Option("patience", float, "--patience S", "Longest simulation; open checks are NOT EVALUATED.")


def settings(name: str, options: Iterable[Option], given: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    """The command with its arguments, and those options that are not as they are anyway, each with its value."""
    return (("command", name), *(row for option in options for row in _set(option, given[option.key])))


def _set(option: Option, value: Any) -> Iterator[tuple[str, str]]:
    """Name and value of one option, once for each of several values; none if its default is in force."""
    if value is None or value == option.usual:
        return
    label = option.name.strip("-_").replace("-", " ").replace("_", " ")
    for each in value if isinstance(value, (list, tuple)) else [value]:
        yield label, {True: "yes", False: "no"}[each] if isinstance(each, bool) else str(each)


def _shared(name: str, command: Command) -> Iterator[Option]:
    """Options behind those of a command: --output lists its formats, --figure its figures."""
    if command.simulates:
        yield PATIENCE
    figures = names_of(name)
    *others, last = command.formats or _formats(command.drawn, bool(figures))
    formats = f"Also write as {', '.join(others)}{' or ' if others else ''}{last}; repeatable."
    yield Option("json", bool, "--json", "Print one JSON document on standard output.", OUTPUT)
    yield Option("output", list[Path], "--output -o FILE", formats, OUTPUT)
    if figures:
        text = f"Also write one figure (.svg, .png or .pdf); repeatable. NAME: {figures}."
        yield Option("figure", list[str], "--figure NAME=FILE", text, OUTPUT)
    if name in watch.WATCHED:
        yield Option("watch", bool, watch.OPTION, watch.ABOUT, OUTPUT)
    yield Option("force", bool, "--force", "Overwrite existing files.", OUTPUT)
    yield Option("quiet", bool, "--quiet -q", "Print no report; use the exit status.", OUTPUT)
    yield Option("no_color", bool, "--no-color", "Print without colours, as NO_COLOR does.", OUTPUT)
    yield Option("full", bool, "--full", "Print the whole report.", OUTPUT)


def _formats(drawn: tuple[str, ...], figures: bool) -> Iterator[str]:
    yield from (".json", ".toml", ".csv", ".txt (whole report)", ".html (page with figures)" if figures else ".html")
    yield from (f"{suffix} ({'solids' if suffix in ('.step', '.stp') else 'drawing'})" for suffix in drawn)


def add_command(app: typer.Typer, name: str, command: Command) -> None:
    """Register a command, with the options that all share behind its own."""
    options = (*command.options, *_shared(name, command))

    def run(**given: Any) -> None:
        from abu_calc.reporting.outcome import Outcome, Target, check_target

        how = Delivery(
            given["json"], tuple(given["output"] or ()), given["force"], given["quiet"], not given["no_color"],
            given["full"], asked_figures(given.get("figure") or ()),
        )  # fmt: skip
        with one_call():
            how.check(name, command.drawn)
            if given.get("watch"):
                raise watch.WatchRequest(given, how.outputs, quiet=how.quiet)
            for option, file in command.files(given):
                check_target(given[option.key], force=how.force, suffixes=(file.suffix,), option=option.name)
            with _naming_options(options), limited(given.get("patience")):
                answer = command.ask(given, how)
                texts = [(given[option.key], file.text(answer, given)) for option, file in command.files(given)]
            outcome = answer if isinstance(answer, Outcome) else outcome_of(answer, explain=given.get("explain", False))
            further = (*outcome.further, *(Target(path, text) for path, text in texts if text is not None))
            outcome = replace(outcome, further=further, settings=settings(name, command.options, given))
            status = deliver(outcome, how, wrote=write_files(outcome, how))
        if status:
            raise typer.Exit(status)

    helped = [Parameter("help_all", Parameter.KEYWORD_ONLY, default=False, annotation=HelpAll)] * bool(command.seldom)
    run.__signature__ = inspect.Signature([*(option.parameter for option in options), *helped])  # type: ignore[attr-defined]
    run.__annotations__ = {each.name: each.annotation for each in run.__signature__.parameters.values()}  # type: ignore[attr-defined]
    feature = BY_NAME[name]
    app.command(
        name,
        cls=type("Command", (SectionedCommand,), {"seldom": frozenset(command.seldom)}),
        help=f"{feature.about}\n\n{command.text}",
        short_help=feature.about,
        rich_help_panel=feature.group,
    )(run)


@contextmanager
def _naming_options(options: Iterable[Option]) -> Iterator[None]:
    """Errors about an argument, or a key within it, name its option; those about entries of a file stay as they are."""
    try:
        yield
    except InputError as error:
        names = {option.key: option.name for option in options if option.usage.startswith("-")}
        argument, *within = (error.place.key or "").split(" ", 1)
        if error.place.file is not None or argument not in names:
            raise
        raise error.at(Place(key=" ".join((names[argument], *within)))) from None
