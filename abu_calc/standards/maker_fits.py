"""Tolerance classes that a bearing maker's catalogue recommends for shafts and housings; basic load ratings."""

from functools import cache
from typing import Final, Literal, NamedTuple

from abu_calc.standards.limits import Seat
from abu_calc.standards.tables import csv_rows
from abu_calc.units import from_si, to_si

Kind = Literal["ball", "angular-contact", "cylindrical", "tapered", "spherical"]
KINDS: Final[tuple[Kind, ...]] = ("ball", "angular-contact", "cylindrical", "tapered", "spherical")
RingLoad = Literal["rotating", "stationary", "indeterminate"]

SOURCE: Final = "SKF General Catalogue 2006"
NORMAL_RATIO: Final = 0.08
"""P/C that stands in where the load or C is not known: the table's row for normal loads (over 0.05 up to 0.1)."""

_FINE: Final = frozenset({"5", "4", "2"})
_FOR_SPLIT: Final = ("G", "H", "JS", "J")


class Ratings(NamedTuple):
    """Basic dynamic and static load rating [N]."""

    dynamic: float
    static: float


class MakerFits(NamedTuple):
    """The class to write first, then others that serve as well; those for special demands; a remark on them."""

    classes: tuple[str, ...]
    special: tuple[str, ...]
    note: str


class _Row(NamedTuple):
    above: float
    to: float
    over: float
    to_mm: float
    found: MakerFits


def load_ratings(designation: str) -> Ratings | None:
    """Ratings of a bearing by its ISO designation; None where they are not known.

    Source: SKF General Catalogue, 2006. Other makers' differ by some per cent.

    >>> load_ratings("6203")
    Ratings(dynamic=9950.0, static=4750.0)
    """
    return _ratings().get(designation)


def maker_fits(
    seat: Seat, kind: Kind, load: RingLoad, ratio: float, diameter: float, bearing_class: str, split: bool = False
) -> MakerFits | None:
    """The classes of a seat by type, kind of load, load ratio P/C and diameter [m]; None where the table has none.

    A shaft under an indeterminate load is as under a rotating one. `bearing_class`: 5, 4 and 2 have rows of their own.
    `split`: classes tighter than J pinch the ring of a split housing and are left out.
    Source: SKF General Catalogue, 2006; range: solid steel shafts and cast iron or steel housings up to 500 mm.

    >>> maker_fits("shaft", "ball", "rotating", 0.08, 0.025, "0").classes
    ('k5',)
    """
    size = round(from_si(diameter, "mm"), 6)
    ball: Kind = "ball" if kind == "angular-contact" else kind
    asked: RingLoad = "rotating" if seat == "shaft" and load == "indeterminate" else load
    accuracy = "fine" if bearing_class in _FINE else "normal"
    for row in _rows().get((seat, accuracy, ball, asked), ()):
        if row.over < size <= row.to_mm and (row.above < ratio <= row.to or ratio <= row.above == 0):
            return _for_split(row.found) if split else row.found
    return None


def _for_split(fits: MakerFits) -> MakerFits | None:
    kept = [name for name in (*fits.classes, *fits.special) if name.rstrip("0123456789") in _FOR_SPLIT]
    return MakerFits(tuple(kept), (), fits.note) if kept else None


@cache
def _ratings() -> dict[str, Ratings]:
    rows = csv_rows("load_ratings")
    return {name: Ratings(to_si(float(C), "kN"), to_si(float(C0), "kN")) for name, C, C0 in rows}


@cache
def _rows() -> dict[tuple[str, str, str, str], list[_Row]]:
    rows_by_key: dict[tuple[str, str, str, str], list[_Row]] = {}
    for seat, accuracy, kind, load, *band, classes, note in csv_rows("maker_fits"):
        above, to, over, to_mm = map(float, band)
        at_hand, _, special = classes.partition("|")
        names = tuple(at_hand.split("/")), tuple(filter(None, special.split("/")))
        row = _Row(above, to, over, to_mm, MakerFits(*names, note))
        for bearing_kind in KINDS if kind == "any" else (kind,):
            rows_by_key.setdefault((seat, accuracy, bearing_kind, load), []).append(row)
    return rows_by_key
