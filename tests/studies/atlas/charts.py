"""Charts of the atlas as data: axes, fixed numbers, definition, and the cells that were computed."""

import tomllib
from collections.abc import Sequence
from functools import cache
from importlib.resources import files
from typing import Any, Final

from abu_calc.foundation.frozen import dataclass

PLACE: Final = "tests.studies.atlas"
TIE: Final = "\u00a0"
"""Space at which no line breaks."""


@dataclass(frozen=True)
class ChartAxis:
    """Axis of a chart: a dimensionless number of machines, and the values of the cells."""

    name: str
    symbol: str
    number: str
    values: tuple[float, ...]

    @property
    def label(self) -> str:
        """Name with symbol, as figures show it; the unit is 1."""
        return f"{self.name}, {self.symbol} [1]"


@dataclass(frozen=True)
class FixedNumber:
    """A number that is the same in all cells; a machine has it within the relative tolerance, a text exactly."""

    name: str
    number: str
    value: float | str
    tolerance: float = 0.0

    @property
    def text(self) -> str:
        """Name, value and tolerance in words."""
        value = self.value if isinstance(self.value, str) else f"{self.value:g}"
        tolerance = f" (±{TIE}{100 * self.tolerance:g}{TIE}%)" if self.tolerance else ""
        return f"{self.name} {value}{tolerance}"


@dataclass(frozen=True)
class AtlasChart:
    """One chart; `share`: its values are shares of starts, `bounds`: edges of the five classes of values."""

    name: str
    letter: str
    file: str
    title: str
    panel: str
    quantity: str
    definition: str
    confidence: str
    across: ChartAxis
    up: ChartAxis
    fixed: tuple[FixedNumber, ...]
    bounds: tuple[float, ...]
    share: bool


@cache
def charts() -> tuple[AtlasChart, ...]:
    """All charts of the atlas, in the order of their letters."""
    content = tomllib.loads(files(PLACE).joinpath("charts.toml").read_text("utf-8"))
    return tuple(_chart(family, panel) for family in content["chart"] for panel in family["panel"])


def _chart(family: dict[str, Any], panel: dict[str, Any]) -> AtlasChart:
    """Chart of a family's entries and its panel's."""
    texts = {key: family[key] for key in ("letter", "file", "title", "quantity", "definition", "confidence")}
    return AtlasChart(
        name=panel["name"],
        panel=panel["title"],
        across=_axis(**family["across"]),
        up=_axis(**family["up"]),
        fixed=tuple(FixedNumber(**each) for each in (*family.get("fixed", ()), *panel.get("fixed", ()))),
        bounds=tuple(family["bounds"]),
        share=family.get("share", False),
        **texts,
    )


def _axis(name: str, symbol: str, number: str, values: Sequence[float]) -> ChartAxis:
    return ChartAxis(name, symbol, number, tuple(values))


CellPlace = tuple[str, str, str]
"""Chart, and the values across and up as the cells' file writes them."""


def place(chart: str, across: float, up: float) -> CellPlace:
    """The place of a cell."""
    return chart, f"{across:g}", f"{up:g}"
