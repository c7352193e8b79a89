"""Compute the atlas: python -m tests.studies.atlas SECONDS [--chart LETTER] [--starts N] [--fresh N].

Cells that are in the records with as many starts are left alone, and those that need none. Then the figures of the
charts are drawn anew, the package gets their cells, and the page is written. With --fresh N, so many cells are computed
again on fresh seeds instead, and compared.
"""

import argparse
import time
from collections.abc import Sequence

from tests.studies.atlas import figures, fresh, page, records
from tests.studies.atlas.charts import place
from tests.studies.atlas.recipes import RECIPES


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute cells until the time is up, then write and draw."""
    asked = _parser().parse_args(arguments)
    until = time.monotonic() + asked.seconds
    if asked.fresh:
        fresh.compare(asked.fresh, until)
        page.write()
        return
    for letter in asked.chart or records.letters():
        if _computed(letter, asked.starts, until):
            figures.draw(letter)
    page.write()
    rows = [row for letter in records.letters() for row in records.stored(letter).values()]
    print(f"{len(rows)} cells, {sum(int(row['starts']) for row in rows)} starts")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tests.studies.atlas")
    parser.add_argument("seconds", type=float)
    parser.add_argument("--chart", nargs="*", choices=records.letters())
    parser.add_argument("--starts", type=int)
    parser.add_argument("--fresh", type=int, default=0)
    return parser


def _computed(letter: str, starts: int | None, until: float) -> bool:
    """Compute what a record lacks; False if it has all."""
    recipe, rows, begun = RECIPES[letter], records.stored(letter), time.monotonic()
    wanted, new = recipe.starts if starts is None else starts, 0
    try:
        for chart, across, up in records.spots(letter):
            if time.monotonic() > until:
                break
            at = place(chart.name, across, up)
            if at in rows and (rows[at]["starts"] == "0" or int(rows[at]["starts"]) >= wanted):
                continue
            cell = recipe.computed(chart, across, up, wanted)
            rows[at] = records.row(at, cell, recipe.command(chart, across, up, wanted))
            new += 1
    finally:
        if new:
            records.write(letter, rows)
    missing = len(records.spots(letter)) - len(rows)
    print(f"{letter}: {new} cells in {time.monotonic() - begun:.0f} s, {missing} missing", flush=True)
    return bool(new)


if __name__ == "__main__":
    main()
