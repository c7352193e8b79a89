"""Cells computed again on fresh seeds: do both values agree within their intervals?"""

import csv
import math
import random
import time
from typing import Final

from tests.studies.atlas import records
from tests.studies.atlas.charts import AtlasChart, CellPlace, place
from tests.studies.atlas.recipe import FOLDER, CellValue, Recipe
from tests.studies.atlas.recipes import RECIPES

FILE: Final = FOLDER / "fresh.csv"
HEADER: Final = ("chart", "across", "up", "seed", "starts", "value", "again", "agree")
SEED: Final = 1000
"""First fresh seed; the charts have the seed 0."""
ROUNDED: Final = 1e-4
"""Rounding of values in the records."""


def agree(share: bool, stored: records.Row, again: CellValue) -> bool:
    """True if the difference of two values is one that chance alone gives in 95 of 100 cases.

    Of shares by Fisher's exact test, of means by the widths of their intervals.
    """
    if not share:
        half = (float(stored["high"]) - float(stored["low"])) / 2, (again.high - again.low) / 2
        return abs(float(stored["value"]) - again.value) <= math.hypot(*half) + ROUNDED
    from scipy.stats import fisher_exact

    starts = int(stored["starts"])
    met, met_again = round(float(stored["value"]) * starts), round(again.value * again.starts)
    return bool(fisher_exact([[met, starts - met], [met_again, again.starts - met_again]]).pvalue >= 0.05)


def compared() -> dict[str, dict[str, str]]:
    """Cells of the record by their seeds."""
    if not FILE.exists():
        return {}
    with FILE.open(encoding="utf-8", newline="") as file:
        return {row["seed"]: row for row in csv.DictReader(file)}


def agreement() -> tuple[int, int]:
    """Number of compared cells that agree, and of all compared ones, in the record."""
    rows = compared().values()
    return sum(row["agree"] == "1" for row in rows), len(rows)


def compare(number: int, until: float) -> None:
    """Compute cells drawn at random again, with the starts of their records; those in the record are left alone."""
    rows = {letter: records.stored(letter) for letter, recipe in RECIPES.items() if recipe.seeded}
    spots = [
        (letter, chart, across, up)
        for letter in rows
        for chart, across, up in records.spots(letter)
        if int(rows[letter].get(place(chart.name, across, up), {"starts": "0"})["starts"])
    ]
    lines = compared()
    try:
        for seed, (letter, chart, across, up) in enumerate(random.Random(number).sample(spots, number), SEED):
            if time.monotonic() > until:
                break
            at = place(chart.name, across, up)
            known = lines.get(str(seed), {})
            if tuple(known.get(key) for key in HEADER[:3]) != at:
                lines[str(seed)] = _compared(chart, at, rows[letter][at], RECIPES[letter], seed)
    finally:
        with FILE.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, HEADER, lineterminator="\n")
            writer.writeheader()
            writer.writerows(lines.values())
    print("{} of {} cells agree".format(*agreement()))


def _compared(chart: AtlasChart, at: CellPlace, known: records.Row, recipe: Recipe, seed: int) -> dict[str, str]:
    """Row of a cell that is computed again."""
    cell = recipe.computed(chart, float(at[1]), float(at[2]), int(known["starts"]), seed)
    same = str(int(agree(chart.share, known, cell)))
    return dict(zip(HEADER, (*at, str(seed), str(cell.starts), known["value"], f"{cell.value:.4f}", same), strict=True))
