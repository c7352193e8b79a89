"""The start cases of grinding in a report: the motions that they end with, and the share of each."""

from abu_calc.analysis.loaded_starts import WHEN
from abu_calc.report.blocks import Block, Grid, Heading
from abu_calc.studies.loaded_records import LoadedOutcomeGroup, LoadedStarts


def start_blocks(starts: LoadedStarts | None) -> list[Block]:
    """The motions that the start cases end with, and the share of each."""
    if starts is None:
        return []
    rows = tuple(
        (WHEN[group.pressed], f"{group.count} of {group.total}", group.state + ("" if group.steady else ", still changing"),
         _range(group))
        for group in starts.outcomes
    )  # fmt: skip
    lost = f"; {starts.without_answer} gave no answer" if starts.without_answer else ""
    return [
        Heading(f"Start cases under load: {starts.count} simulated{lost}"),
        Grid(("pressed", "share", "motion", "level"), rows, frozenset({1, 3})),
    ]


def _range(group: LoadedOutcomeGroup) -> str:
    """The level, or the lowest and the highest of several."""
    low, high = f"{group.lowest_db:.1f}", f"{group.highest_db:.1f}"
    return f"{high} dB" if low == high else f"{low} to {high} dB"
