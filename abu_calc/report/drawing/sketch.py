"""Common parts of sketches: the line that names the object, and their extent."""

from collections.abc import Sequence

from abu_calc.report.drawing.extent import extent
from abu_calc.report.drawing.shapes import HEIGHT, SMALL, Drawing, Shape, Text, fitted, plain
from abu_calc.studies.result import Result

ROOM = 220.0
"""Room for the object on paper [mm]."""
MARGIN = 8.0


def scale_for(length: float, scales: Sequence[float]) -> float:
    """The largest scale at which a length [mm] has room."""
    return next((scale for scale in scales if scale * length <= ROOM), scales[-1])


def sketch(name: str, title: str, description: str, result: Result, shapes: Sequence[Shape], scale: float) -> Drawing:
    """A drawing without frame: title above, machine, file's hash and date below."""
    unit, source = 1 / scale, result.provenance
    low, high = extent(shapes, scale)
    wide = (high[0] - low[0]) * scale
    imprint = f"{plain(result.title)}, {source.date}, abu-calc {source.version}"
    below = (
        *((f"SHA-256 {source.sha256}",) if source.sha256 else ()),
        "Sketch: what has no dimension is not to scale.",
    )
    lines = [Text((low[0], high[1] + 8 * unit), *fitted(title, wide, 1.4 * HEIGHT))]
    for index, line in enumerate((imprint, *below), 1):
        lines.append(Text((low[0], low[1] - (4 + 4.5 * index) * unit), *fitted(line, wide, SMALL)))
    every = (*shapes, *lines)
    low, high = extent(every, scale)
    margin = MARGIN * unit
    corners = (low[0] - margin, low[1] - margin), (high[0] + margin, high[1] + margin)
    return Drawing(name, title, description, scale, *corners, every)
