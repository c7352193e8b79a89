"""The hand as a mechanical system, as data; `sizing` says how its elements connect."""

from abu_calc.frozen import dataclass
from abu_calc.standards.tables import toml_table, unknown

_Four = tuple[float, float, float, float]


@dataclass(frozen=True)
class Hand:
    """One hand along one axis: m1 … m4 [kg], k1 … k4 [N/m], c1 … c4 [N·s/m]."""

    masses: _Four
    stiffness: _Four
    damping: _Four


def hand(axis: str) -> Hand:
    """One hand along x, y or z of the hand. Source: ISO 10068:2012, Annex C, model 2, table C.1.

    >>> hand("z").stiffness
    (1000.0, 12000.0, 43635.0, 174542.0)
    """
    table = toml_table("hands")
    if axis not in ("x", "y", "z"):
        raise unknown("axis of the hand", axis, ("x", "y", "z"))
    return Hand(**{key: tuple(values) for key, values in table[axis].items()})
