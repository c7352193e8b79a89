"""Help texts in sections: options stand below the title of their panel, commands below that of their group.

The texts are plain, so that help loads no library that draws frames. Titles are those that Typer calls help panels.
"""

import re
from typing import Any, Final

import typer
import typer.core

OUTPUT: Final = "Output"
"""Panel of the options that all commands share; `--help` stands at its end."""


class SectionedCommand(typer.core.TyperCommand):
    """A command whose help groups its options."""

    def format_options(self, ctx: typer.Context, formatter: Any) -> None:  # type: ignore[override]
        """Write arguments, then options panel by panel, in the order of declaration."""
        sections: dict[str, list[tuple[str, str]]] = {}
        for parameter in self.get_params(ctx):
            record = parameter.get_help_record(ctx)
            if record is None:
                continue
            name, text = record
            if parameter.param_type_name == "argument":
                sections.setdefault("Arguments", []).append((name.partition(" <")[0], text))
            else:
                panel = OUTPUT if parameter.name == "help" else getattr(parameter, "rich_help_panel", None)
                sections.setdefault(panel or "Options", []).append((name, text))
        _write_sections(formatter, sections)

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
