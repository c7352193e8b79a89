"""Compute the atlas: python -m tests.studies.atlas SECONDS [STARTS]. It goes on where it stopped.

Each cell gets STARTS starts (20 without it) before the seconds are over. Cells of the CSV that have them are left
alone. Then the figure is drawn anew.
"""

import csv
import sys
import time
from collections.abc import Sequence
from typing import Final

from abu_calc.features.stability.attractor_search import search
from abu_calc.features.stability.attractors import interval, searched_scene
from abu_calc.inputs.scene import read_any
from abu_calc.simulation.subject import subject_of
from tests.studies.atlas.charts import CHARTS, DRAGS, FOLDER, SPEEDS, Cell

FILE: Final = FOLDER / "balance.csv"
FIGURE: Final = FOLDER / "balance.png"
HEADER: Final = ("chart", "speed_ratio", "drag", "starts", "balanced", "undecided", "share", "low", "high", "command")
Key = tuple[str, str, str]


def computed(cell: Cell, starts: int) -> tuple[int, int]:
    """Number of starts of a cell that balance, and of those without a decided end."""
    scene = searched_scene(subject_of(read_any(str(FOLDER / cell.file), cell.sets)))
    found = search(scene, starts, 0, designed=False)
    return sum(len(group.ends) for group in found.groups if group.kind == "balanced"), len(found.undecided)


def stored() -> dict[Key, dict[str, str]]:
    """Rows of the CSV by cell."""
    if not FILE.exists():
        return {}
    with FILE.open(encoding="utf-8", newline="") as file:
        return {(row["chart"], row["speed_ratio"], row["drag"]): row for row in csv.DictReader(file)}


def main(arguments: Sequence[str]) -> None:
    """Compute cells until the time is up, then write and draw."""
    until, starts = time.monotonic() + float(arguments[0]), int(arguments[1]) if len(arguments) > 1 else 20
    rows = stored()
    cells = [cell for chart in CHARTS for cell in chart.cells()]
    try:
        for cell in cells:
            if time.monotonic() > until:
                break
            if cell.key in rows and int(rows[cell.key]["starts"]) >= starts:
                continue
            balanced, undecided = computed(cell, starts)
            low, high = interval(balanced, starts)
            values = (*cell.key, starts, balanced, undecided, f"{balanced / starts:.4f}", f"{low:.4f}", f"{high:.4f}",
                      cell.command(starts))  # fmt: skip
            rows[cell.key] = dict(zip(HEADER, map(str, values), strict=True))
    finally:
        _write([rows[cell.key] for cell in cells if cell.key in rows])
    total = sum(int(row["starts"]) for row in rows.values())
    print(f"{len(rows)} of {len(cells)} cells, {total} starts")
    _draw(rows)


def _write(rows: Sequence[dict[str, str]]) -> None:
    whole = FILE.with_suffix(".new")
    with whole.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, HEADER, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    whole.replace(FILE)


def _draw(rows: dict[Key, dict[str, str]]) -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, fields = plt.subplots(2, 4, figsize=(13, 6), sharex=True, sharey=True, layout="constrained")
    for chart in CHARTS:
        field = fields[int(chart.contact)][(2, 3, 4, 8).index(chart.balls)]
        keys = [[(chart.name, f"{speed:g}", f"{drag:g}") for speed in SPEEDS] for drag in DRAGS]
        shares = [[100 * float(rows[key]["share"]) if key in rows else float("nan") for key in line] for line in keys]
        image = field.imshow(shares, origin="lower", vmin=0, vmax=100, aspect="auto", cmap="viridis")
        field.set_xticks(range(len(SPEEDS)), [f"{speed:g}" for speed in SPEEDS])
        field.set_yticks(range(len(DRAGS)), [f"{drag:g}" for drag in DRAGS])
        field.set_title(f"{chart.balls} balls, {'friction and contact' if chart.contact else 'without friction'}")
    figure.supxlabel("speed / natural frequency")
    figure.supylabel("viscous drag rate / natural frequency")
    figure.colorbar(image, ax=fields, label="starts that balance, %")
    figure.savefig(FIGURE, dpi=80)


if __name__ == "__main__":
    main(sys.argv[1:])
