"""Permissible residual imbalance of a rotor, shared to its tolerance planes, and imbalances transformed to them.

The tolerance planes are the bearing planes. If the lengths of the rotor are not known, the correction planes serve.
"""

from collections.abc import Iterable, Sequence
from typing import Annotated, ClassVar, Final, Literal

from abu_calc.features.balancing.errors import size
from abu_calc.features.balancing.formulas import Vector
from abu_calc.features.balancing.tables import ReadingsFile
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.validity import Range
from abu_calc.standards.vibration import permissible_imbalance

Planes = Literal["bearing planes", "correction planes"]

INBOARD: Final = (0.3, 0.7)
"""Limits of a share if the centre of mass is between the bearings."""
OUTBOARD: Final = (0.3, 1.3)
"""Limits of a share if the centre of mass is outside the bearings; from a secondary source, unverified."""
_SPAN = Range("distance of the bearings", 0.0, 1e3, "m", open_low=True)


@formula(
    "Permissible residual imbalance of the bearing planes",
    "U_A = U_per·L_B/L_AB, U_B = U_per·L_A/L_AB",
    "kg m",
    where=(
        "With the centre of mass between the bearings each share is held within 0.3 … 0.7 of U_per. If it is outside, "
        "as in many overhung rotors, each share is held within 0.3 … 1.3 of U_per. The bearing next to it then carries "
        "more than the whole weight."
    ),
    checked=(_SPAN,),
    source="ISO 21940-11:2016, allocation to tolerance planes; limits of overhung rotors: ISO 1940-1:2003, unverified",
)
def tolerance_shares(permitted: float, left: float, right: float) -> tuple[float, float]:
    """Shares of the left and the right bearing; `left`, `right`: from each bearing to the centre of mass, negative if
    it is outside.

    >>> [round(share, 1) for share in tolerance_shares(238.7, 0.12, 0.68)]
    [167.1, 71.6]
    >>> [round(share, 2) for share in tolerance_shares(1.0, 0.5, -0.1)]
    [0.3, 1.25]
    """
    span = _SPAN.check(left + right)
    low, high = INBOARD if left >= 0 and right >= 0 else OUTBOARD
    first, second = (min(max(abs(arm) / span, low), high) * permitted for arm in (right, left))
    return first, second


@record
class ToleranceResult(Record):
    """Permitted residual imbalance and the imbalance of each tolerance plane; null for the planes there are not."""

    optional: ClassVar[frozenset[str]] = frozenset(
        {"left_g_mm", "right_g_mm", "left_now_g_mm", "right_now_g_mm", "left_rest_g_mm", "right_rest_g_mm",
         "single_plane_g_mm", "single_plane_now_g_mm", "single_plane_rest_g_mm"}
    )  # fmt: skip

    planes: Annotated[str, Quantity("tolerance planes", "", 4, "bearing planes, or correction planes")]
    rule: Annotated[str, Quantity("rule")]
    whole: Annotated[float, Quantity("permitted imbalance of the rotor", "U_per", unit="g_mm")]
    left: Annotated[float | None, Quantity("left, permitted", "U_A", unit="g_mm")] = None
    right: Annotated[float | None, Quantity("right, permitted", "U_B", unit="g_mm")] = None
    left_now: Annotated[float | None, Quantity("left, now", unit="g_mm")] = None
    right_now: Annotated[float | None, Quantity("right, now", unit="g_mm")] = None
    left_rest: Annotated[float | None, Quantity("left, expected", "", 2, "rms over the errors", unit="g_mm")] = None
    right_rest: Annotated[float | None, Quantity("right, expected", "", 2, "rms over the errors", unit="g_mm")] = None
    single_plane: Annotated[float | None, Quantity("permitted", "U_per", unit="g_mm")] = None
    single_plane_now: Annotated[float | None, Quantity("now", unit="g_mm")] = None
    single_plane_rest: Annotated[float | None, Quantity("expected", "", 2, "rms over the errors", unit="g_mm")] = None


@dataclass(frozen=True)
class TolerancePlanes:
    """Permitted imbalance in all and of each tolerance plane [kg m]; `levers`: rows by which imbalances of the
    correction planes act in the tolerance planes.
    """

    whole: float
    permitted: tuple[float, ...]
    planes: Planes
    levers: tuple[tuple[float, ...], ...]
    overhung: bool = False

    def transformed(self, imbalance: Vector) -> Vector:
        """Imbalances of the correction planes as those of the tolerance planes [kg m]."""
        return tuple(sum((lever * q for lever, q in zip(row, imbalance, strict=True)), 0j) for row in self.levers)

    def result(self, names: Sequence[str], imbalance: Vector, rest: Sequence[float]) -> ToleranceResult:
        """Permitted imbalance, that now and that expected in the tolerance planes, by the names of the planes."""
        parts = {"": self.permitted, "_now": map(abs, self.transformed(imbalance)), "_rest": rest}
        values = {
            f"{'single_plane' if name == 'single' else name}{what}": value
            for what, planes in parts.items()
            for name, value in zip(names, planes, strict=True)
        }
        if self.planes == "correction planes":
            single = len(names) == 1
            rule = "all in the single plane" if single else "half in each plane, since the lengths are not known"
        elif self.overhung:
            rule = "lever rule, centre of mass outside the bearings, each share within 0.3 … 1.3 (unverified)"
        else:
            rule = "lever rule, each share within 0.3 … 0.7"
        return ToleranceResult(planes=self.planes, rule=rule, whole=self.whole, **values)

    def sizes(self, deltas: Iterable[Vector]) -> tuple[float, ...]:
        """Imbalances of the tolerance planes, rms over independent changes [kg m]."""
        moved = [self.transformed(delta) for delta in deltas]
        return tuple(size(each[plane] for each in moved) for plane in range(len(self.levers)))


def bearing_levers(lengths: tuple[float, float, float, float]) -> tuple[tuple[float, float], tuple[float, float]]:
    """Part of a force in the left and the right correction plane that each bearing carries.

    >>> bearing_levers((0.0, 0.5, 0.5, 0.0))
    ((1.0, 0.0), (0.0, 1.0))
    """
    a, b, c, d = lengths
    whole = a + b + c + d
    return (1 - a / whole, d / whole), (a / whole, 1 - d / whole)


def tolerance_of(file: ReadingsFile, speed: float) -> TolerancePlanes | None:
    """Tolerance planes of a file at the speed in service [rad/s]; None without a grade."""
    grade, rotor = file.tolerance.balance_grade, file.rotor
    if grade is None or rotor.mass_kg is None:
        return None
    whole = permissible_imbalance(grade, rotor.mass_kg, speed)
    if file.single_plane is not None:
        return TolerancePlanes(whole, (whole,), "correction planes", ((1.0,),))
    if rotor.lengths is None:
        return TolerancePlanes(whole, (whole / 2, whole / 2), "correction planes", ((1.0, 0.0), (0.0, 1.0)))
    a, b, c, d = rotor.lengths
    shares = tolerance_shares(whole, a + b, c + d)
    return TolerancePlanes(whole, shares, "bearing planes", bearing_levers(rotor.lengths), min(a + b, c + d) < 0)
