"""Charts as data: axes with units, lines, points, bars, limits, forbidden bands.

A figure of a result: its name, its content and its place in a report; and the figure of a run in the rotor.

The figure of a run shows the balls on their way from start to rest, with imbalance, level and speed meanwhile.

Chart of the displacement against speed in a run-up, with balls and without.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Final, NamedTuple

from abu_calc.reporting.blocks import Block, number
from abu_calc.reporting.drawings.shapes import Drawing

if TYPE_CHECKING:
    from abu_calc.simulation.rotor_view import Array, RotorView


FIELD: Final = 354 / 204
"""Width over height of a plot's field."""


class Axis(NamedTuple):
    """Axis of a chart: its quantity with the unit, and its range; `log`: in decades."""

    name: str
    low: float
    high: float
    log: bool = False

    @classmethod
    def around(cls, name: str, values: Iterable[float], *, zero: bool = False) -> "Axis":
        """An axis with room beside all values; `zero`: from zero."""
        numbers = list(values)
        low, high = min(numbers), max(numbers)
        margin = 0.08 * ((high - low) or abs(high) or 1.0)
        return cls(name, 0.0 if zero else low - margin, high + margin)

    @classmethod
    def decades(cls, name: str, values: Iterable[float]) -> "Axis":
        """A logarithmic axis over whole decades that hold all values, which are above zero."""
        numbers = list(values)
        low, high = math.floor(math.log10(min(numbers))), math.ceil(math.log10(max(numbers)))
        return cls(name, 10.0**low, 10.0 ** max(high, low + 1), log=True)

    @property
    def ticks(self) -> list[float]:
        """Some five round numbers; decades, of many every second or third."""
        if self.log:
            first, last = round(math.log10(self.low)), round(math.log10(self.high))
            return [10.0**power for power in range(first, last + 1, -(-(last - first) // 7))]
        rough = (self.high - self.low) / 5
        power = 10.0 ** math.floor(math.log10(rough))
        step = next(power * part for part in (1, 2, 5, 10) if power * part >= rough)
        return [step * k for k in range(math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9) + 1)]

    def share(self, value: float) -> float:
        """Share of the axis at which a value lies."""
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


def alike(across: str, up: str, values: Iterable[tuple[float, float]]) -> tuple[Axis, Axis]:
    """Two axes of one scale, the origin in their middle."""
    reach = 1.1 * max(max(abs(x) / FIELD, abs(y)) for x, y in values) or 1.0
    return Axis(across, -FIELD * reach, FIELD * reach), Axis(up, -reach, reach)


class MarkedPoint(NamedTuple):
    """A point with a word beside it; `series` (1 to 8) chooses color and shape: 1 round, 2 hollow square, 3 hollow
    lozenge, 4 hollow triangle, 5 to 8 the same shapes and colors, filled where those are hollow.
    """

    x: float
    y: float
    word: str = ""
    series: int = 1


class Curve(NamedTuple):
    """A course; `name` stands in the legend where there are several, `series` (1 to 8) chooses color and dashes."""

    points: Sequence[tuple[float, float]]
    name: str = ""
    series: int = 1


class Bar(NamedTuple):
    """A length from `start`, its name and its value as text; `series` as of points, `span`: where its end may lie."""

    name: str
    value: float
    text: str
    series: int = 1
    start: float = 0.0
    span: tuple[float, float] | None = None


class Plot(NamedTuple):
    """Contents of a field between two axes.

    `summary`: its text alternative, `limit`: of y, `bands`: forbidden x.
    """

    title: str
    summary: str
    across: Axis
    up: Axis
    lines: Sequence[Curve] = ()
    points: Sequence[MarkedPoint] = ()
    limit: tuple[float, str] | None = None
    bands: Sequence[tuple[float, float]] = ()

    @property
    def legend(self) -> Sequence[Curve]:
        """Lines that need their names told, one for each name: there is more than one name."""
        named = {line.name: line for line in self.lines if line.name}
        return tuple(named.values()) if len(named) > 1 else ()


class Bars(NamedTuple):
    """Lengths below one another, each under its name, with the limit across them all.

    On an axis that does not begin at zero, as levels have it, points stand instead of lengths.
    """

    title: str
    summary: str
    axis: Axis
    rows: Sequence[Bar]
    limit: tuple[float, str] | None = None


class Cells(NamedTuple):
    """A field of cells over two lists of values, the first row lowest; a cell grows with its class, 0 to 4.

    `classes[row][column]`: None where nothing is known; `words`: what each class means.
    """

    title: str
    summary: str
    across: str
    up: str
    columns: Sequence[str]
    rows: Sequence[str]
    classes: Sequence[Sequence[int | None]]
    words: Sequence[tuple[int | None, str]]


def db(value: float) -> str:
    """A level as tables show it."""
    return f"{value:.1f} dB"


def micrometres(value: float) -> str:
    """A displacement as tables show it."""
    return f"{number(value, 3)} µm"


SMALLEST: Final = 0.05
"""Radius of a ball as drawn, over that of its circle: of smaller ones, and of those whose size is not known."""
SERIES: Final = 8
"""Looks of lines; those of further balls begin again."""


class RotorMotionFigure(NamedTuple):
    """A run as seen in the rotor; races of several planes lie over one another. `others`: by what they are called."""

    view: "RotorView"
    name: str = ""
    others: Sequence[tuple[str, "RotorView"]] = ()

    @property
    def balls_mm(self) -> tuple[float, ...]:
        """Radii of the balls as they are drawn."""
        view = self.view
        both = zip(view.ball_radii_mm, view.pitch_radii_mm, strict=True)
        return tuple(max(ball, SMALLEST * pitch) for ball, pitch in both)

    @property
    def race_mm(self) -> float:
        """The radius of the largest race as it is drawn."""
        return max((sum(radii) for radii in zip(self.balls_mm, self.view.pitch_radii_mm, strict=True)), default=1.0)


def settling(view: "RotorView", limit: float | None) -> Plot:
    """Imbalance left against time."""
    bound = None if limit is None else (limit, f"permitted {_g_mm(limit)}")
    course, text = _course(view, view.residual_g_mm, _g_mm)
    up = Axis.around("imbalance left [g·mm]", [*(rest for _, rest in course), limit or 0.0], zero=True)
    return Plot("Imbalance left against time", text, _time(view), up, (Curve(course),), (), bound)


def level(view: "RotorView", limit: float | None, measured: float | None = None) -> Plot:
    """Level against time, and what was measured in the end."""
    bound = None if limit is None else (limit, f"limit {db(limit)}")
    course, text = _course(view, view.level_db, db)
    up = Axis.around(
        "velocity level [dB]",
        [*(decibels for _, decibels in course), *(mark for mark in (limit, measured) if mark is not None)],
    )
    points = () if measured is None else (MarkedPoint(course[-1][0], measured, "measured", 3),)
    text += "" if measured is None else f"; measured {db(measured)}"
    return Plot("Level against time", text, _time(view), up, (Curve(course),), points, bound)


def angles(view: "RotorView") -> Plot:
    """Angles of the balls from the imbalance, against time: the still picture of a motion.

    The angles run from 0 to 360°. Balls about the place opposite the imbalance, where they gather, then do not
    jump.
    """
    turned = (view.ball_angles_deg - view.imbalance_angle_deg) % 360.0
    lines = [line for index, row in enumerate(turned) for line in _without_jumps(view, row, index + 1)]
    last = ", ".join(f"{value:.0f}°" for value in turned[:, -1])
    text = f"The balls end at {last} from the imbalance" if len(turned) else "There are no balls"
    up = Axis("angle of the balls from the imbalance [°]", 0.0, 360.0)
    return Plot("Angles of the balls", text, _time(view), up, lines)


def _without_jumps(view: "RotorView", angle: "Array", index: int) -> Iterator[Curve]:
    """A course in pieces: behind 360° it goes on at 0°."""
    points = list(zip(view.t_s.tolist(), angle.tolist(), strict=True))
    jumps = [k for k in range(1, len(points)) if abs(points[k][1] - points[k - 1][1]) > 180.0]
    for start, end in pairwise((0, *jumps, len(points))):
        yield Curve(points[start:end], f"ball {index}", (index - 1) % SERIES + 1)


def caught(view: "RotorView", speed: "Array") -> Plot:
    """Speed of the rotor and imbalance left against time, both of their largest."""
    courses = ((speed, "speed", _rpm), (view.residual_g_mm, "imbalance left", _g_mm))
    lines, texts = [], []
    for series, (values, name, form) in enumerate(courses, 1):
        most = float(values.max()) or 1.0
        lines.append(Curve(_course(view, 100 * values / most, form)[0], f"{name}, of {form(most)}", series))
        texts.append(f"{name}: {_course(view, values, form)[1]}")
    return Plot("Run-up", "; ".join(texts), _time(view), Axis("share of the largest [%]", 0.0, 105.0), lines)


def run_up(view: "RotorView", speed: "Array") -> Plot:
    """Speed of the rotor against time."""
    course, text = _course(view, speed, _rpm)
    up = Axis.around("speed of the rotor [rpm]", (speed_rpm for _, speed_rpm in course), zero=True)
    return Plot("Run-up", text, _time(view), up, (Curve(course),))


def _time(view: "RotorView") -> Axis:
    return Axis("time [s]", 0.0, float(view.t_s[-1]))


def _g_mm(value: float) -> str:
    return f"{number(value)} g·mm"


def _rpm(value: float) -> str:
    return f"{value:.0f} rpm"


def _course(view: "RotorView", values: "Array", form: Callable[[float], str]) -> tuple[list[tuple[float, float]], str]:
    """Points, and how it begins and ends in words."""
    course = list(zip(view.t_s.tolist(), values.tolist(), strict=True))
    first, last = (form(value) for value in (course[0][1], course[-1][1]))
    return course, f"From {first} at the start to {last} at {course[-1][0]:.3g} s"


SUMMARY: Final = "summary"
"""Section of figures that stand in the summary of a page."""

Shown = Plot | Bars | Cells | Drawing | RotorMotionFigure


class Figure(NamedTuple):
    """Figure with a caption that says what to see.

    `name`: unique among a result's figures; `section`: the id of the heading it stands below; if empty, the figure
    stands at the end of the page.
    """

    name: str
    section: str
    shown: Shown
    caption: str


class Extras(NamedTuple):
    """Parts of a page beyond the blocks of a report: figures, formulas with numbers put in, and the summary.

    `summary`: begins with the title; it stands on sheets of its own, before the details, and takes the place of the
    report's first section. Figures of the section `SUMMARY` belong to it. `held`: ids of sections of the report whose
    contents it holds.
    """

    figures: tuple[Figure, ...] = ()
    note: tuple[Block, ...] = ()
    summary: tuple[Block, ...] = ()
    held: frozenset[str] = frozenset()


MakesExtras = Callable[[], Extras]


Points = Sequence[tuple[float, float]]


def run_up_chart(balls: Points, without: Points, bare: str = "without autobalancers") -> Plot:
    """Displacements [µm] against speed [rpm]; `bare`: name of the curve without balls."""
    lines = [Curve(without, bare)] if without else []
    lines += [Curve(balls, "with balls", 2)] if balls else []
    across = Axis.around("speed [rpm]", (speed for speed, _ in (without or balls)))
    up = Axis.around("displacement, 0–peak [µm]", [0.0, *(value for _, value in (*without, *balls))])
    return Plot("Run-up", _text(balls, without, bare), across, up, lines)


def _text(balls: Points, without: Points, bare: str) -> str:
    named = [(curve, name) for curve, name in ((without, bare), (balls, "with balls")) if curve]
    highest = ", ".join(f"{max(value for _, value in curve):.0f} µm {name}" for curve, name in named)
    at_end = " and ".join(f"{curve[-1][1]:.1f}" for curve, _ in named)
    return f"Largest displacement in the run-up: {highest}; at the end {at_end} µm."
