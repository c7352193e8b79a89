"""Help texts in sections: options stand below the title of their panel, commands below that of their group.

The texts are plain, so that help loads no library that draws frames. Titles are those that Typer calls help panels.
A command with very many options lists those of its seldom panels by name; `--help-all` prints them with their texts.
"""

import re
import textwrap
from typing import Annotated, Any, ClassVar, Final

import typer
import typer.core

OUTPUT: Final = "Output"
"""Panel of the options that all commands share; `--help` stands at its end."""


HELP_ALL: Final = "--help-all"
"""Option that prints the texts of all options, for commands whose `--help` lists some by name."""
WHOLE: Final[dict[str, Any]] = {"break_on_hyphens": False, "break_long_words": False}
WIDTH: Final = 78
"""Letters of a line of names, as of help in a terminal of 80 columns."""


def _show_all(ctx: typer.Context, wanted: bool) -> None:
    if wanted and not ctx.resilient_parsing:
        ctx.meta[HELP_ALL] = True
        typer.echo(ctx.get_help())
        raise typer.Exit


HelpAll = Annotated[
    bool,
    typer.Option(
        HELP_ALL, help="Show every option with its text.", is_eager=True, callback=_show_all, rich_help_panel=OUTPUT
    ),
]


class SectionedCommand(typer.core.TyperCommand):
    """A command whose help groups its options.

    `seldom`: panels, and names of options, that `--help` lists by name.
    """

    seldom: ClassVar[frozenset[str]] = frozenset()

    def format_help_text(self, ctx: Any, formatter: Any) -> None:
        """Write the description: its first paragraph alone if options are listed by name."""
        text = self.help
        if self.seldom and HELP_ALL not in ctx.meta:
            self.help = (text or "").partition("\n\n")[0]
        super().format_help_text(ctx, formatter)
        self.help = text

    def format_options(self, ctx: typer.Context, formatter: Any) -> None:  # type: ignore[override]
        """Write arguments, then options panel by panel, in the order of declaration."""
        sections: dict[str, list[tuple[str, str]]] = {}
        seldom = frozenset() if HELP_ALL in ctx.meta else self.seldom
        names = list[str]()
        for parameter in self.get_params(ctx):
            record = parameter.get_help_record(ctx)
            if record is None:
                continue
            name, text = record
            if parameter.param_type_name == "argument":
                sections.setdefault("Arguments", []).append((name.partition(" <")[0], text))
            else:
                panel = OUTPUT if parameter.name == "help" else getattr(parameter, "rich_help_panel", None)
                if seldom & {panel, *parameter.opts}:
                    names.append(parameter.opts[0])
                    continue
                sections.setdefault(panel or "Options", []).append((name, text))
        output = sections.pop(OUTPUT, None)
        _write_sections(formatter, sections)
        if names:
            with formatter.section(f"More options, explained by {HELP_ALL}"):
                formatter.write(f"{textwrap.indent(textwrap.fill(', '.join(names), WIDTH - 2, **WHOLE), '  ')}\n")
        if output:
            _write_sections(formatter, {OUTPUT: output})

    def collect_usage_pieces(self, ctx: typer.Context) -> list[str]:  # type: ignore[override]
        """Return the words of the usage line, braces only round alternatives."""
        return [re.sub(r"\{([^{}|]+)\}", r"\1", piece) for piece in super().collect_usage_pieces(ctx)]


class SectionedGroup(typer.core.TyperGroup):
    """An application whose help groups its commands."""

    def format_commands(self, ctx: typer.Context, formatter: Any) -> None:  # type: ignore[override]
        """Write the commands group by group, in the order of registration."""
        sections: dict[str, list[tuple[str, str]]] = {}
        for name in self.list_commands(ctx):
            command = self.get_command(ctx, name)
            if command is not None and not command.hidden:
                group = getattr(command, "rich_help_panel", None) or "Commands"
                sections.setdefault(str(group), []).append((name, command.short_help or ""))
        width = max((len(name) for rows in sections.values() for name, _ in rows), default=0)
        _write_sections(
            formatter, {title: [(name.ljust(width), text) for name, text in rows] for title, rows in sections.items()}
        )


def _write_sections(formatter: Any, sections: dict[str, list[tuple[str, str]]]) -> None:
    for title, rows in sections.items():
        with formatter.section(title):
            formatter.write_dl(rows)
