"""Elements of a drawing: lines, arcs, regions, texts and dimensions on layers.

Places and lengths are in mm of the object, y upwards; heights of texts are in mm on paper.
"""

import math
from typing import Final, Literal, NamedTuple

from abu_calc.foundation.frozen import dataclass

Point = tuple[float, float]
Corner = tuple[float, float, float]
"""Place, and bulge of the edge that leaves it."""
Layer = Literal["outline", "hidden", "centre", "hatch", "dimension", "text", "frame"]
Align = Literal["left", "centre", "right"]

SCALES: Final = (20.0, 10.0, 5.0, 4.0, 2.5, 2.0, 1.0, 0.5, 0.4, 0.25, 0.2, 0.1, 0.05, 0.04, 0.025, 0.02, 0.01)
"""ISO 5455 with those between of GOST 2.302-68."""
HEIGHT: Final = 3.5
"""Height of most texts, on paper [mm]."""
SMALL: Final = 2.5
SIGN_WIDTH: Final = 0.62
"""Width of an average character on the line, as a share of its height."""
TALL: Final = 1.35
"""Size of a font whose capitals have height 1."""


class Pen(NamedTuple):
    """Style of a layer's lines: width, dashes and gaps on paper [mm] (no dashes: continuous)."""

    width: float
    dashes: tuple[float, ...] = ()


PENS: Final[dict[Layer, Pen]] = {
    "outline": Pen(0.5),
    "hidden": Pen(0.25, (3.0, 1.5)),
    "centre": Pen(0.25, (9.0, 1.5, 1.0, 1.5)),
    "hatch": Pen(0.18),
    "dimension": Pen(0.25),
    "text": Pen(0.25),
    "frame": Pen(0.35),
}
"""Widths and kinds of lines after ISO 128."""


@dataclass(frozen=True)
class Line:
    """Straight line from one point to another."""

    layer: Layer
    start: Point
    end: Point


@dataclass(frozen=True)
class Arc:
    """Counter-clockwise between two angles [degrees]; without them a circle."""

    layer: Layer
    centre: Point
    radius: float
    start: float = 0.0
    end: float = 360.0


@dataclass(frozen=True)
class Region:
    """A part that is cut: its closed outline, hatched at an angle [degrees] in lines so far apart on paper [mm].

    `outlined` False: hatch alone, whose edges are drawn by themselves.
    """

    corners: tuple[Corner, ...]
    name: str
    angle: float = 45.0
    spacing: float = 2.5
    outlined: bool = True


@dataclass(frozen=True)
class Solid:
    """A filled triangle."""

    corners: tuple[Point, Point, Point]


@dataclass(frozen=True)
class Text:
    """One line of writing; `at` its left end, middle or right end on the line, turned by an angle [degrees]."""

    at: Point
    text: str
    height: float = HEIGHT
    align: Align = "left"
    angle: float = 0.0

    def box(self, scale: float) -> tuple[Point, Point]:
        """Lower left and upper right corner, about."""
        wide, high = text_width(self.text, self.height) / scale, self.height / scale
        left = {"left": 0.0, "centre": -wide / 2, "right": -wide}[self.align]
        x, y = self.at
        if self.angle:
            return (x - high, y + left), (x, y + left + wide)
        return (x + left, y), (x + left + wide, y + high)


@dataclass(frozen=True)
class Length:
    """A dimension along x or y between two points, its line at `at` on the other axis; `text` holds its value.

    `beyond`: where the text stands if it has no room between the arrows, `clear` how much farther off than others;
    `below`: what stands below the line; `along`: share of the line at which the text's middle stands.
    """

    start: Point
    end: Point
    at: float
    text: str
    upright: bool = False
    beyond: Literal["start", "end"] = "end"
    below: str = ""
    clear: float = 0.0
    along: float = 0.5

    @property
    def value(self) -> float:
        """Length that the dimension measures [mm]."""
        axis = 1 if self.upright else 0
        return abs(self.end[axis] - self.start[axis])


@dataclass(frozen=True)
class Radius:
    """A dimension of a circle's radius: its arrow touches at an angle [degrees] from outside, its text stands on a
    shelf at `shelf`. `full`: a full circle, whose text and measure are its diameter."""

    centre: Point
    value: float
    angle: float
    shelf: Point
    text: str
    full: bool = False

    @property
    def touch(self) -> Point:
        """The point of the arrow."""
        turn = math.radians(self.angle)
        return self.centre[0] + self.value * math.cos(turn), self.centre[1] + self.value * math.sin(turn)


@dataclass(frozen=True)
class ToleranceFrame:
    """A frame of geometrical tolerance: its upper left corner, the characteristic, its value, letters of datums."""

    corner: Point
    cells: tuple[str, ...]


Primitive = Line | Arc | Region | Solid | Text
Shape = Primitive | Length | Radius | ToleranceFrame


@dataclass(frozen=True)
class Drawing:
    """Shapes between two corners, and how many mm on paper are one mm of the thing; what it shows, in words."""

    name: str
    title: str
    description: str
    scale: float
    low: Point
    high: Point
    shapes: tuple[Shape, ...]

    @property
    def size(self) -> tuple[float, float]:
        """Width and height on paper [mm]."""
        return self.scale * (self.high[0] - self.low[0]), self.scale * (self.high[1] - self.low[1])


def text_width(text: str, height: float) -> float:
    """About how long a text is on paper [mm]."""
    return SIGN_WIDTH * TALL * height * len(text)


def fitting_height(text: str, width: float, height: float) -> float:
    """Height [mm], at most the one given, at which the whole text fits a width on paper."""
    return min(height, height * width / max(text_width(text, height), 1e-9))


def fitted(text: str, width: float, height: float) -> tuple[str, float]:
    """A text and its height [mm] that fit a width on paper: smaller writing first, then dots in place of its middle."""
    wanted = max(SMALL * 0.8, fitting_height(text, width, height))
    most = max(int(width / text_width("0", wanted) + 1e-9), 5)
    if len(text) <= most:
        return text, wanted
    head = (most - 1) // 2
    return f"{text[:head]}…{text[len(text) - (most - 1 - head) :]}", wanted


def plain(text: str) -> str:
    """A text on one line without signs that no drawing can show."""
    return " ".join("".join(sign if sign.isprintable() else " " for sign in text).split())


def toleranced(value: float, either_way: float) -> str:
    """A size [mm] with its tolerance either way, both to the same decimals (ISO 129-1), two at least.

    >>> toleranced(6.959, 0.05), toleranced(62.4, 0.1), toleranced(4.8125, 0.005)
    ('6.96 ±0.05', '62.40 ±0.10', '4.813 ±0.005')
    """
    decimals = max(2, len(digits(either_way).partition(".")[2]))
    size, limit = (f"{number + math.copysign(1e-9, number):.{decimals}f}" for number in (value, either_way))
    return f"{size} ±{limit}"


def digits(value: float, most: int = 3) -> str:
    """A number as drawings write it: no zeros at its end.

    Halves round away from zero, whatever the last digit of their binary form.

    >>> digits(67.0), digits(15.875), digits(-0.0), digits(19.474999999999998, 2)
    ('67', '15.875', '0', '19.48')
    """
    text = f"{value + math.copysign(1e-9, value):.{most}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
