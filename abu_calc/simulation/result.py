"""Common parts of all results: the verdict, the warnings, and the data needed to repeat them."""

import datetime
import importlib
import os
import re
import shlex
from dataclasses import field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Final

from abu_calc.foundation.checks import Check, Status, number_of, overall, verdict_words
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Record, as_plain, record
from abu_calc.foundation.rows import Rows
from abu_calc.version import __version__

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from abu_calc.inputs.reading.document import FileReading


FIGURES: Final = "abu_calc.registry"
"""Module that draws, prints and writes results, in a layer above this one.

It is imported by its name when somebody wants that, as a plugin is.
"""

COMMAND: Final = re.compile(r"(`abu [a-z-]+ )FILE\b")
"""Command whose placeholder gives way to the file of the result."""
NOTHING: Final = Record()
"""A model of results that stand on no equations."""


@dataclass(frozen=True)
class Provenance:
    """Provenance of a result: file as named, its hash, entries replaced, defaults in force, version, date.

    `file` None: the input was no file; of a text or a dictionary there is a hash all the same. `converted`: keys whose
    values were written with a unit, what was written, and the value in the unit of the key.
    """

    file: str | None
    sha256: str | None
    overrides: tuple[tuple[str, object], ...]
    defaults: tuple[tuple[str, object], ...]
    version: str
    date: str = field(compare=False)
    """The day of the run: the same machine gives an equal result on the next."""
    converted: tuple[tuple[str, str, object], ...] = ()

    @classmethod
    def of(cls, reading: "FileReading") -> "Provenance":
        """Provenance of a file that was read."""
        replaced = {override.key: override.value for override in reading.overrides}
        converted = tuple((each.key, each.entry, each.rounded) for each in reading.converted)
        return cls.today(
            reading.file or None, reading.sha256 or None, tuple(replaced.items()), reading.defaults_used, converted
        )

    @classmethod
    def today(
        cls, file: str | None = None, sha256: str | None = None, overrides: tuple[tuple[str, object], ...] = (),
        defaults: tuple[tuple[str, object], ...] = (), converted: tuple[tuple[str, str, object], ...] = (),
    ) -> "Provenance":  # fmt: skip
        """Provenance of this day and this version."""
        return cls(file, sha256, overrides, defaults, __version__, datetime.date.today().isoformat(), converted)

    @property
    def input(self) -> dict[str, Any] | None:
        """Input as the JSON document has it; null if there was none, its file null if that was a text."""
        if self.file is None and self.sha256 is None:
            return None
        return {
            "file": self.file,
            "sha256": self.sha256,
            "overrides": as_plain(dict(self.overrides)),
            "defaults": as_plain(dict(self.defaults)),
            **({"converted": self._conversions} if self.converted else {}),
        }

    @property
    def _conversions(self) -> dict[str, Any]:
        return {key: {"written": written, "value": as_plain(value)} for key, written, value in self.converted}


@record
class Result(Record):
    """Answer of a study: its own fields, in user units, the checks that judge them, and their provenance."""

    command: ClassVar[str]
    left_out: ClassVar[frozenset[str]] = frozenset({"title", "checks", "warnings", "model", "provenance"})

    title: str
    """The machine's name, or the file's."""
    checks: tuple[Check, ...] = ()
    warnings: tuple[str, ...] = ()
    model: Record = NOTHING
    """The SI numbers behind the result, for those who check it by hand."""
    provenance: Provenance

    def __init__(self, **values: object) -> None:
        super().__init__(**values)
        # Checks stand in the order of their codes; several of one code keep theirs.
        self.__dict__["checks"] = Rows(
            replace(check, message=self._named(check.message), remedy=check.remedy and self._named(check.remedy))
            for check in sorted(self.checks, key=lambda check: number_of(check.code))
        )
        self.__dict__["warnings"] = tuple(map(self._named, self.warnings))

    def _named(self, text: str) -> str:
        """A text whose commands name the file of this result."""
        file = self.provenance.file
        return text if file is None else COMMAND.sub(lambda match: match[1] + shlex.quote(file), text)

    @property
    def status(self) -> Status:
        """The worst of the checks."""
        return overall(self.checks)

    def __repr__(self) -> str:
        return f"<{self.title_in_schema()} {verdict_words(self.status, self.checks)}; {self.title}>"

    def _repr_html_(self) -> str:
        html: str = importlib.import_module(FIGURES).html(self)
        return html

    def text(self, full: bool = False) -> str:
        """The report as the command prints it, on one screen of 80 columns; `full`: the whole of it, as --full."""
        text: str = importlib.import_module(FIGURES).text(self, full=full)
        return text

    def save(self, path: str | os.PathLike[str], force: bool = False) -> Path:
        """Write the result as --output does, whole or not at all, and return the path; the ending is the format.

        .html page with figures · .json, .toml, .csv all numbers · .txt the whole report · of results with a drawing
        also .svg, .pdf and .dxf (further sheets beside it), of those with solids .step. `force`: over files that are
        there. Raises OutputError, with the remedy, for an unknown
        ending, a file that exists, a folder that does not, and a package that is not installed.
        """
        target = Path(path)
        importlib.import_module(FIGURES).save(self, target, force=force)
        return target

    @property
    def figures(self) -> tuple[str, ...]:
        """Names of the figures that this result has, for `figure`."""
        names: tuple[str, ...] = importlib.import_module(FIGURES).names(self)
        return names

    def figure(self, name: str) -> "Figure":
        """A figure of this result as one of matplotlib, to be shown, changed or saved; units stand on its axes.

        Charts have axes with the numbers of the result, drawings are to scale in mm of paper. Raises InputError, with
        the names there are, for another name, and OutputError where matplotlib (extra `report`) is not installed.
        """
        drawn: Figure = importlib.import_module(FIGURES).figure(self, name)
        return drawn

    @classmethod
    def json_type(cls) -> Any:
        """The type of what `to_dict` returns, the JSON document's `result`."""
        return cls
