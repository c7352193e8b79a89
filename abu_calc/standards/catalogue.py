"""Rolling bearings of the makers' catalogues: load ratings, fatigue load limit, speeds, factors of the equivalent load.

A bearing that no catalogue here has gets ratings estimated from its dimensions.
"""

from functools import cache
from typing import Final, Literal, NamedTuple

from abu_calc.foundation.formula import formula
from abu_calc.foundation.units import from_si, to_si
from abu_calc.foundation.validity import Range
from abu_calc.standards.tables import csv_rows

Kind = Literal["ball", "angular-contact", "cylindrical", "tapered", "spherical", "needle", "drawn-cup"]
KINDS: Final[tuple[Kind, ...]] = (
    "ball", "angular-contact", "cylindrical", "tapered", "spherical", "needle", "drawn-cup",
)  # fmt: skip
ROLLERS: Final = frozenset({"cylindrical", "tapered", "spherical", "needle", "drawn-cup"})
"""Kinds whose rolling elements are rollers or needles."""
_MAKERS: Final = {
    "SKF": "SKF General Catalogue, 2006",
    "SKF2018": "SKF Rolling bearings, 2018",
    "NSK": "NSK's catalogues",
    "NTN": "NTN's needle roller catalogue",
    "INA": "INA's list of sizes",
}
# NJ, NUP and N bearings have the size and the ratings of the NU bearing of their number.
_LIKE_NU: Final = ("NUP", "NJ", "N")


class Ratings(NamedTuple):
    """Basic dynamic and static load rating [N], and the fatigue load limit [N] where the source has it."""

    dynamic: float
    static: float
    fatigue_limit: float | None = None


class CatalogueBearing(NamedTuple):
    """A row: kind, dimensions [m], ratings (None: no figure), speeds [rad/s], factors, and where it is from.

    `limiting_speed` is the mechanical limit of SKF's rows, that with grease of the others. `f0` belongs to ball
    bearings; `e`, `Y` (above e) and `Y0` to angular contact, tapered and spherical ones.
    """

    designation: str
    kind: Kind
    bore: float
    outer: float
    inner_width: float
    inner_chamfer: float
    outer_width: float
    outer_chamfer: float
    ratings: Ratings | None
    reference_speed: float | None
    limiting_speed: float | None
    f0: float | None
    e: float | None
    Y: float | None
    Y0: float | None
    source: str
    with_grease: bool


CLOSED_SPEED: Final = {"shields": 0.75, "seals": 0.44}
"""Least limiting speed of a closed ball bearing over SKF's mechanical limit of the open one: 143 and 119 rows of its
Rolling bearings, 2018, whose medians are 0.80 and 0.47."""


def closed(row: CatalogueBearing, closure: str) -> CatalogueBearing:
    """The row of a bearing with shields or rubbing seals, whose limiting speed is lower.

    >>> round(closed(catalogue_bearing("6206"), "seals").limiting_speed * 30 / 3.14159265)
    6600
    """
    share = 1.0 if row.with_grease and closure == "shields" else CLOSED_SPEED[closure]
    speed = None if row.limiting_speed is None else share * row.limiting_speed
    return row._replace(
        limiting_speed=speed, reference_speed=None, source=f"{row.source}; {share:g} of it for {closure}"
    )


@cache
def catalogue() -> dict[str, CatalogueBearing]:
    """All rows by designation."""
    return {row[0]: _row(row) for row in csv_rows("catalogue")}


def catalogue_bearing(designation: str) -> CatalogueBearing | None:
    """The row of a designation; NJ, NUP and N as the NU bearing of their number. None where there is none.

    >>> catalogue_bearing("NJ210").outer, catalogue_bearing("6299")
    (0.09, None)
    """
    rows = catalogue()
    if designation in rows:
        return rows[designation]
    prefix = next((prefix for prefix in _LIKE_NU if designation.startswith(prefix)), None)
    like = rows.get(f"NU{designation.removeprefix(prefix)}") if prefix else None
    return None if like is None else like._replace(designation=designation)


_SECTION: Final = Range("section height of a bearing", 0.0005, 0.5, "m")
_WIDTH: Final = Range("width of a bearing", 0.0005, 0.5, "m")
# Coefficient, and exponents of the section height, the mean diameter and the width, of C and of C0 [kN, mm].
_ESTIMATES: Final[dict[Kind, tuple[tuple[float, ...], tuple[float, ...]]]] = {
    "ball": ((0.0315, 0.783, 0.489, 0.661), (0.00561, 0.511, 1.135, 0.522)),
    "angular-contact": ((0.0249, 1.211, 0.620, 0.071), (0.0057, 0.800, 1.259, 0.074)),
    "cylindrical": ((0.0554, 0.330, 0.471, 1.284), (0.0278, -0.132, 0.963, 1.397)),
    "tapered": ((0.0789, 0.245, 0.767, 0.896), (0.0485, -0.368, 1.237, 1.205)),
    "spherical": ((0.0871, -0.100, 0.909, 1.156), (0.0404, -0.043, 1.148, 1.023)),
    "needle": ((0.0795, 0.446, 0.527, 0.875), (0.0400, -0.200, 1.135, 1.123)),
    "drawn-cup": ((0.0694, -0.027, 0.706, 1.087), (0.02195, -0.561, 1.245, 1.389)),
}
ESTIMATE_ERROR: Final = {
    "ball": 0.25, "angular-contact": 0.16, "cylindrical": 0.35, "tapered": 0.2, "spherical": 0.2, "needle": 0.2,
    "drawn-cup": 0.1,
}  # fmt: skip
"""Relative error of an estimated C or C0 that 95 of 100 catalogue rows stay within."""


@formula(
    "Load ratings estimated from the dimensions of a bearing",
    "C = c_C·(D_o − d)^α_C·((d + D_o)/2)^β_C·B^γ_C",
    "kN",
    where=(
        "C and C0 are in kN, lengths in mm. Coefficient and exponents are fitted for each type to the catalogue rows. "
        "95 of 100 rows lie within 10 % (drawn cup) to 35 % (cylindrical) of the estimate."
    ),
    checked=(_SECTION, _WIDTH),
    assumed="usual inner design of the type",
    source="own fit to the catalogues in the data file",
    own_units=True,
)
def estimated_ratings(kind: Kind, bore: float, outer: float, width: float) -> Ratings:
    """
    >>> round(1e-3 * estimated_ratings("ball", 0.025, 0.052, 0.015).dynamic, 1)
    14.9
    """
    section, mean, wide = (
        from_si(length, "mm") for length in (_SECTION.check(outer - bore), (outer + bore) / 2, _WIDTH.check(width))
    )
    dynamic, static = (
        to_si(coefficient * section**alpha * mean**beta * wide**gamma, "kN")
        for coefficient, alpha, beta, gamma in _ESTIMATES[kind]
    )
    return Ratings(dynamic, static)


def fatigue_limit(kind: Kind, static: float, mean_diameter: float) -> float:
    """Fatigue load limit C_u [N] from C0 [N] and the mean diameter [m], where no catalogue gives it.

    C0/22 for balls, C0/8.2 for rollers; above 100 mm times (100/D_m)^0.5, or ^0.3. Source: ISO 281:2007, B.3.3.

    >>> round(fatigue_limit("ball", 7800.0, 0.0385))
    355
    """
    small, exponent = (8.2, 0.3) if kind in ROLLERS else (22.0, 0.5)
    return static / small * min(1.0, float((0.1 / mean_diameter) ** exponent))


def _row(row: tuple[str, ...]) -> CatalogueBearing:
    name, kind, *cells, maker = row
    figures = [float(cell) if cell else None for cell in cells]
    bore, outer, width, chamfer, outer_width, outer_chamfer = (
        round(to_si(size or 0.0, "mm"), 9) for size in figures[:6]
    )
    dynamic, static, fatigue, reference_speed, limiting_speed = (
        None if figure is None else to_si(figure, unit)
        for figure, unit in zip(figures[6:11], ("kN", "kN", "kN", "rpm", "rpm"), strict=True)
    )
    f0, e, Y, Y0 = figures[11:]
    ratings = None if dynamic is None or static is None else Ratings(dynamic, static, fatigue)
    known_kind = next(known for known in KINDS if known == kind)
    return CatalogueBearing(
        name, known_kind, bore, outer, width, chamfer, outer_width, outer_chamfer, ratings, reference_speed,
        limiting_speed, f0, e, Y, Y0, _MAKERS[maker], not maker.startswith("SKF"),
    )  # fmt: skip
