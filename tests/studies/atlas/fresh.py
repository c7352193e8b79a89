"""Cells computed again on fresh seeds: do both values agree within their intervals?"""

import csv
import math
import random
import time
from typing import Final

from abu_calc.features.atlas.charts import place
from tests.studies.atlas import records
from tests.studies.atlas.recipe import FOLDER, CellValue
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


def agreement() -> tuple[int, int]:
    """Number of compared cells that agree, and of all compared ones, in the record."""
    with FILE.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return sum(row["agree"] == "1" for row in rows), len(rows)


def compare(number: int, until: float) -> None:
    """Compute cells drawn at random again, with the starts of their records, and write the record of the comparison."""
    seeded = [letter for letter, recipe in RECIPES.items() if recipe.seeded]
    rows = {letter: records.stored(letter) for letter in seeded}
    spots = [
        (letter, chart, across, up)
        for letter in seeded
        for chart, across, up in records.spots(letter)
        if int(rows[letter].get(place(chart.name, across, up), {"starts": "0"})["starts"])
    ]
    lines = []
    for k, (letter, chart, across, up) in enumerate(random.Random(number).sample(spots, number)):
        if time.monotonic() > until:
            break
        at = place(chart.name, across, up)
        known = rows[letter][at]
        cell = RECIPES[letter].computed(chart, across, up, int(known["starts"]), SEED + k)
        same = int(agree(chart.share, known, cell))
        lines.append((*at, SEED + k, cell.starts, known["value"], f"{cell.value:.4f}", same))
    with FILE.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([HEADER, *lines])
    print(f"{sum(line[-1] for line in lines)} of {len(lines)} cells agree")
