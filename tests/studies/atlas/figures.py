"""Figures of the atlas: one picture for each letter, a field for each of its charts."""

from pathlib import Path
from textwrap import fill
from typing import Any, Final

from tests.studies.atlas.charts import AtlasChart, place
from tests.studies.atlas.records import family, record, stored

COLUMNS: Final = 4
LABEL: Final = 36
"""Letters in a line of the scale's label."""
DARK: Final = 0.45
"""Share of the scale below which numbers are written in white."""


def figure(letter: str) -> Path:
    """File of a letter's picture."""
    return record(letter).with_suffix(".png")


def draw(letter: str) -> None:
    """Draw the record of a letter: the colour and the number of each cell are its value."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    panels, rows = family(letter), stored(letter)
    across = min(len(panels), COLUMNS)
    down = -(-len(panels) // across)
    values = [float(row["value"]) for row in rows.values()]
    scale = (0.0, 1.0) if panels[0].share else (min(values), max(values))
    size = (5.0 * across + 1.2, 3.9 * down + 0.5)
    picture, fields = plt.subplots(down, across, figsize=size, squeeze=False, layout="constrained")
    # Charts whose panels come in pairs stand above one another.
    order = [panels[k::down] for k in range(down)]
    for line, charts in zip(fields, order, strict=True):
        for field, chart in zip(line, charts, strict=True):
            image = _field(field, chart, rows, scale)
    picture.suptitle(panels[0].title)
    picture.supxlabel(panels[0].across.label)
    picture.supylabel(fill(panels[0].up.label, LABEL) if down == 1 else panels[0].up.label)
    unit = ", %" if panels[0].share else ""
    bar = picture.colorbar(image, ax=fields, label=fill(panels[0].quantity + unit, LABEL))
    if panels[0].share:
        bar.set_ticks([0, 0.25, 0.5, 0.75, 1], labels=["0", "25", "50", "75", "100"])
    picture.savefig(figure(letter), dpi=75)
    plt.close(picture)


def _field(field: Any, chart: AtlasChart, rows: Any, scale: tuple[float, float]) -> Any:
    grid = [[rows.get(place(chart.name, x, y)) for x in chart.across.values] for y in chart.up.values]
    values = [[float("nan") if row is None else float(row["value"]) for row in line] for line in grid]
    image = field.imshow(values, origin="lower", vmin=scale[0], vmax=scale[1], aspect="auto", cmap="viridis")
    for up, line in enumerate(values):
        for across, value in enumerate(line):
            if value == value:
                text = f"{100 * value:.0f}" if chart.share else f"{value:.3g}"
                dark = (value - scale[0]) / (scale[1] - scale[0]) < DARK
                field.text(across, up, text, ha="center", va="center", fontsize=8, color="white" if dark else "black")
    field.set_xticks(range(len(chart.across.values)), [f"{value:g}" for value in chart.across.values])
    field.set_yticks(range(len(chart.up.values)), [f"{value:g}" for value in chart.up.values])
    field.set_title(chart.panel)
    return image
