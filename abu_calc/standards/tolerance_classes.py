"""Limits of size (ISO 286-2 for shafts and housings, ISO 492 for bearing rings) and makers' tolerance classes.

A bearing maker's catalogue recommends the classes of shafts and housings.
"""

from functools import cache, lru_cache
from typing import Final, Literal, NamedTuple

from abu_calc.foundation.validity import Range
from abu_calc.standards.catalogue import KINDS, Kind
from abu_calc.standards.tables import csv_rows, lengths_for_size, micrometres, millimetres, row_of_size, unknown

Seat = Literal["shaft", "housing"]
Ring = Literal["inner", "outer"]
BearingType = Literal["radial", "tapered"]
_Row = tuple[float, float, float, float]

_FILES = {"shaft": "iso286_shafts", "housing": "iso286_holes"}
_SIZES = Range("size", 0.6, 500.0, "mm", remedy="The tables hold ISO 286-2 from 0.6 to 500 mm.")


class DeviationLimits(NamedTuple):
    """Lower and upper limit deviation [m] from the nominal size."""

    lower: float
    upper: float

    @property
    def middle(self) -> float:
        """Deviation [m] of the middle of the field."""
        return (self.lower + self.upper) / 2

    @property
    def tolerance(self) -> float:
        """Width [m] of the field."""
        return self.upper - self.lower


@cache
def tolerance_classes(seat: Seat) -> tuple[str, ...]:
    """The tolerance classes that are tabulated for shafts or for housings.

    >>> tolerance_classes("housing")[:4]
    ('F7', 'G6', 'G7', 'H6')
    """
    return tuple(_rows(seat))


@lru_cache(maxsize=4096)
def part_limits(seat: Seat, tolerance_class: str, size: float) -> DeviationLimits:
    """Limit deviations of a shaft or housing of nominal size [m], by the row of the standard's table.

    Range: 0.6 … 500 mm (RangeError); a tabulated class (InputError). Source: ISO 286-2:2010.

    >>> part_limits("shaft", "k6", 0.080)
    DeviationLimits(lower=2e-06, upper=2.1e-05)
    """
    rows = _rows(seat)
    if tolerance_class not in rows:
        raise unknown(f"tolerance class of a {seat}", tolerance_class, rows)
    _SIZES.check(millimetres(size))
    return _look_up(rows[tolerance_class], size, f"size for {tolerance_class}", "Choose another tolerance class.")


@lru_cache(maxsize=4096)
def grade_tolerance(grade: int, size: float) -> float:
    """Standard tolerance [m] of grade IT1 … IT9 for a size [m]; sizes above the table get its last row.

    Range: 0 … 3150 mm and beyond (the last row, which is then less than the rule would give). Source: ISO 286-1:2010.

    >>> round(1e6 * grade_tolerance(6, 0.020), 1), round(1e6 * grade_tolerance(4, 0.062), 1)
    (13.0, 8.0)
    """
    rows = [tuple(map(float, row)) for row in csv_rows("it_grades")]
    return micrometres((row_of_size(rows, size) or rows[-1])[1 + grade])


def ring_limits(bearing_type: BearingType, ring: Ring, bearing_class: str, size: float) -> DeviationLimits:
    """Limit deviations of a ring's single-plane mean diameter, bore (inner) or outside (outer), nominal size [m].

    Range: the rows of the table, which are fewer for the finer classes (RangeError); a tabulated class (InputError): 0
    (Normal), 6, 5, 4, 2, for tapered bearings also 6X. Tapered 6 is GOST's class, not ISO's.
    Source: ISO 492:2014, GOST 520-2011. The edition of 2023 could not be read; no row is verified against it.

    >>> ring_limits("radial", "outer", "0", 0.140)
    DeviationLimits(lower=-1.8e-05, upper=0.0)
    """
    rows = [row[2:] for row in csv_rows("iso492") if row[:2] == (bearing_type, ring)]
    classes = tuple(dict.fromkeys(row[0] for row in rows))
    if bearing_class not in classes:
        raise unknown(f"accuracy class of a {bearing_type} bearing", bearing_class, classes)
    class_rows = [_numbers((over, to, "0", lower)) for name, over, to, lower in rows if name == bearing_class]
    what = f"{'bore' if ring == 'inner' else 'outside diameter'} of a {bearing_type} bearing of class {bearing_class}"
    return _look_up(class_rows, size, what, "Choose a coarser class, or a bearing in this range.")


@cache
def _rows(seat: Seat) -> dict[str, list[_Row]]:
    """The rows of each tolerance class, without its name."""
    rows_by_class: dict[str, list[_Row]] = {}
    for name, *row in csv_rows(_FILES[seat]):
        rows_by_class.setdefault(name, []).append(_numbers(tuple(row)))
    return rows_by_class


def _numbers(row: tuple[str, ...]) -> _Row:
    over, to, upper, lower = map(float, row)
    return over, to, upper, lower


def _look_up(rows: list[_Row], size: float, what: str, remedy: str) -> DeviationLimits:
    upper, lower = lengths_for_size(rows, size, f"{what} is outside the table", remedy)
    return DeviationLimits(lower, upper)


RingLoad = Literal["rotating", "stationary", "indeterminate"]

SOURCE: Final = "SKF General Catalogue 2006"
_CUPS: Final = "NTN's needle roller catalogue"
NORMAL_RATIO: Final = 0.08
"""P/C that stands in where the load or C is not known: the table's row for normal loads (over 0.05 up to 0.1)."""

_FINE: Final = frozenset({"5", "4", "2"})
_FOR_SPLIT: Final = ("G", "H", "JS", "J")
_ANY: Final = tuple(kind for kind in KINDS if kind != "drawn-cup")
"""Types that the rows for any type mean: a drawn-cup bearing has no inner ring."""


class MakerFits(NamedTuple):
    """The class to write first, then others that serve as well; those for special demands; a remark on them."""

    classes: tuple[str, ...]
    special: tuple[str, ...]
    note: str


class _MakerRow(NamedTuple):
    above: float
    to: float
    over: float
    to_mm: float
    fits: MakerFits


def maker_fits(
    seat: Seat,
    kind: Kind,
    load: RingLoad,
    ratio: float,
    diameter: float,
    bearing_class: str,
    split: bool = False,
    thin: bool = False,
) -> MakerFits | None:
    """The classes of a seat by type, kind of load, load ratio P/C and diameter [m]; None where the table has none.

    A shaft under an indeterminate load is as under a rotating one. `bearing_class`: 5, 4 and 2 have rows of their own.
    `split`: classes tighter than J pinch the ring of a split housing and are left out. `thin`: a thin-walled or
    light-alloy housing takes the tighter class that the row names for it.
    Source: SKF General Catalogue, 2006 (drawn-cup bearings: NTN); range: P up to C/2, solid steel shafts and cast iron
    or steel housings up to 500 mm.

    >>> maker_fits("shaft", "ball", "rotating", 0.08, 0.025, "0").classes
    ('k5',)
    >>> maker_fits("housing", "ball", "rotating", 0.08, 0.052, "0", thin=True).classes[0]
    'P7'
    """
    size = millimetres(diameter)
    asked: RingLoad = "rotating" if seat == "shaft" and load == "indeterminate" else load
    accuracy = "fine" if bearing_class in _FINE and kind != "drawn-cup" else "normal"
    for like in _same_rows(kind):
        for row in _maker_rows().get((seat, accuracy, like, asked), ()):
            if row.over < size <= row.to_mm and (row.above < ratio <= row.to or ratio <= row.above == 0):
                fits = _for_thin(row.fits) if thin and (load != "stationary" or kind == "drawn-cup") else row.fits
                return _for_split(fits) if split else fits
    return None


def _same_rows(kind: Kind) -> tuple[Kind, ...]:
    """The type, then the one whose rows hold for it, too."""
    if kind == "angular-contact":
        return kind, "ball"
    return (kind, "cylindrical") if kind == "needle" else (kind,)


def _for_thin(fits: MakerFits) -> MakerFits:
    """The tighter classes first: the letters of holes ascend as they get tighter."""
    tighter = tuple(name for name in fits.special if name[0] > fits.classes[0][0])
    rest = tuple(name for name in fits.special if name not in tighter)
    return MakerFits((*tighter, *fits.classes), rest, fits.note)


def _for_split(fits: MakerFits) -> MakerFits | None:
    kept = [name for name in (*fits.classes, *fits.special) if name.rstrip("0123456789") in _FOR_SPLIT]
    return MakerFits(tuple(kept), (), fits.note) if kept else None


def source_of(kind: Kind | None) -> str:
    """Catalogue whose rows `maker_fits` has for a type; a type that is not told is taken as ball."""
    return _CUPS if kind == "drawn-cup" else SOURCE


@cache
def _maker_rows() -> dict[tuple[str, str, str, str], list[_MakerRow]]:
    rows_by_key: dict[tuple[str, str, str, str], list[_MakerRow]] = {}
    for seat, accuracy, kind, load, *band, classes, note in csv_rows("maker_fits"):
        above, to, over, to_mm = map(float, band)
        at_hand, _, special = classes.partition("|")
        names = tuple(at_hand.split("/")), tuple(filter(None, special.split("/")))
        row = _MakerRow(above, to, over, to_mm, MakerFits(*names, note))
        for bearing_kind in _ANY if kind == "any" else (kind,):
            rows_by_key.setdefault((seat, accuracy, bearing_kind, load), []).append(row)
    return rows_by_key
