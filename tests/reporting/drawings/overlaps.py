"""Texts of a drawing that stand over one another, or through which a line runs."""

from itertools import combinations

from abu_calc.reporting.drawings.dimensions import box, primitives
from abu_calc.reporting.drawings.shapes import Drawing, Line, Text


def check_clear(drawing: Drawing) -> None:
    """No text over another, through a line, or off the sheet."""
    shapes = list(primitives(drawing.shapes, drawing.scale))
    texts = [(each.text, each.box(drawing.scale)) for each in shapes if isinstance(each, Text)]
    slack = 1e-6 / drawing.scale
    for (first, a), (second, b) in combinations(texts, 2):
        across = min(a[1][0], b[1][0]) - max(a[0][0], b[0][0])
        up = min(a[1][1], b[1][1]) - max(a[0][1], b[0][1])
        assert min(across, up) < slack, (first, second)
    for each in shapes:
        low, high = box(each, drawing.scale)
        assert drawing.low[0] - slack <= low[0] and high[0] <= drawing.high[0] + slack, each
        assert drawing.low[1] - slack <= low[1] and high[1] <= drawing.high[1] + slack, each
        if isinstance(each, Line) and each.layer in ("dimension", "frame", "outline"):
            for text, (a, b) in texts:
                assert not _crosses(each, a, b, 0.4 / drawing.scale), (text, each)


def _crosses(line: Line, low: tuple[float, float], high: tuple[float, float], inside: float) -> bool:
    """Whether a line runs through a box made smaller on all sides (Liang & Barsky)."""
    first, last = 0.0, 1.0
    for axis in (0, 1):
        start, step = line.start[axis], line.end[axis] - line.start[axis]
        near, far = low[axis] + inside - start, high[axis] - inside - start
        if abs(step) < 1e-12:
            if near > 0 or far < 0:
                return False
            continue
        a, b = sorted((near / step, far / step))
        first, last = max(first, a), min(last, b)
    return first < last
