"""A recipe: how a chart's cells are made, the command that makes one, and its value in the command's result."""

import json
import math
import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from abu_calc.features.stability.attractors import interval
from tests.studies.atlas.charts import AtlasChart

FOLDER: Final = Path(__file__).parent
SHOWN: Final = "tests/studies/atlas"
RPM: Final = 30 / math.pi
Result = Mapping[str, Any]


@dataclass(frozen=True)
class CellValue:
    """Value of a cell with its interval; `starts` that were simulated for it, `lost` those without a decided end."""

    value: float
    low: float
    high: float
    starts: int = 0
    lost: int = 0

    @classmethod
    def share(cls, met: int, starts: int, lost: int = 0) -> "CellValue":
        """A share of starts with its exact interval."""
        return cls(met / starts, *interval(met, starts), starts, lost)

    @classmethod
    def exact(cls, value: float, starts: int = 0) -> "CellValue":
        """A number without an interval."""
        return cls(value, value, value, starts)


@dataclass(frozen=True)
class Recipe:
    """How cells of a chart are made.

    `entries`: file and entries of a cell, by across and up; `words`: the command and its options, by the number of
    starts; `run`: its result as the command gives it in JSON, by file, entries, starts and seed; `read`: the value in
    it; `starts`: as many without another number; `seeded`: other seeds give other starts.
    """

    entries: Callable[[AtlasChart, float, float], tuple[str, tuple[str, ...]]]
    words: Callable[[AtlasChart, int], tuple[str, str]]
    run: Callable[[AtlasChart, str, tuple[str, ...], int, int], Result]
    read: Callable[[AtlasChart, Result], CellValue]
    starts: int = 0
    seeded: bool = False

    def command(self, chart: AtlasChart, across: float, up: float, starts: int) -> str:
        """Command that gives the value of a cell again."""
        file, entries = self.entries(chart, across, up)
        name, options = self.words(chart, starts)
        sets = " ".join(f"--set {shlex.quote(each)}" for each in entries)
        return f"abu {name} {SHOWN}/{file} {sets} {options}".strip()

    def computed(self, chart: AtlasChart, across: float, up: float, starts: int, seed: int = 0) -> CellValue:
        """A cell, computed in this process by the function that the command calls."""
        file, entries = self.entries(chart, across, up)
        return self.read(chart, self.run(chart, str(FOLDER / file), entries, starts, seed))


def plain(result: Any) -> Result:
    """Result as JSON has it."""
    plain: Result = json.loads(json.dumps(result.to_dict(), default=str))
    return plain
