"""Makers' measurements of machines with autobalancers."""

from abu_calc.frozen import dataclass
from abu_calc.standards.tables import toml_table

Span = tuple[float, float]


@dataclass(frozen=True)
class FactoryRow:
    """One measurement: levels [dB], lowest and highest, in an octave [Hz]; None: not published.

    `machine`: the preset, `short`: its name in a table; `state`: idle, loaded or not said; `word`: on how it differs
    from what the model predicts.
    """

    machine: str
    short: str
    state: str
    octave: float
    without: Span | None
    fitted: Span | None
    lowered: Span | None
    word: str
    peak: str | None = None


def factory_rows() -> tuple[FactoryRow, ...]:
    """All measurements published with numbers, and the peaks named without. Source: Kladiev 1996."""
    return tuple(
        FactoryRow(
            row["machine"], row["short"], row["state"], float(row["octave"]), _span(row, "without"),
            _span(row, "with"), _span(row, "lowered"), row["word"], row.get("peak"),
        )
        for row in toml_table("factory_machines")["row"]
    )  # fmt: skip


def factory_source() -> tuple[str, str]:
    """The source, and what it says of backgrounds."""
    table = toml_table("factory_machines")
    return table["source"], table["background"]


def _span(row: dict[str, list[float]], key: str) -> Span | None:
    if key not in row:
        return None
    low, high = row[key]
    return float(low), float(high)
