"""Rigid body of a machine of which nobody knows the inertias: an estimate from mass, layout and lengths, with a band.

The estimate is an assumption of this program, not a measurement. Its band holds what the shapes of such machines differ
by; every number that follows from the body has a band of its own, found by `BodyEstimate.band`.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final, Literal

from abu_calc.formulas.rigid_body import Inertia, RigidBody, Vector
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.standards.tables import toml_table

Layout = Literal["straight", "face", "angle"]
LENGTHS: Final[Mapping[Layout, tuple[str, ...]]] = {"straight": ("L",), "angle": ("L", "H"), "face": ("H",)}
"""Lengths that the estimate of a layout needs: L machine.length_mm, H machine.height_mm."""
KEYS: Final = {"L": "machine.length_mm", "H": "machine.height_mm"}
HEIGHT: Final = Range("height over length of an angle grinder", 0.02, 0.5, key="machine.height_mm")
_SHAPE: Final = ("k_x", "k_y", "k_z", "product")
_PLACE: Final = ("across", "along")


@dataclass(frozen=True)
class PlacedBody:
    """A body and the place of its wheel's centre from the centre of mass [m]."""

    body: RigidBody
    wheel: Vector


@dataclass(frozen=True)
class BodyEstimate:
    """The nominal body, and for each uncertain parameter the bodies at the ends of its 95 % band."""

    nominal: PlacedBody
    ends: tuple[tuple[PlacedBody, PlacedBody], ...]

    @formula(
        "Band of a quantity of an estimated body, 95 %",
        where=(
            "Each uncertain parameter is set to both ends of its band in turn. The deviations of the quantity from its "
            "nominal value are combined as the root of the sum of squares, upward and downward apart."
        ),
        assumed="independent parameters",
        source="propagation of uncertainty by finite changes, JCGM 100:2008, 5.1.3",
    )
    def band(self, quantity: Callable[[PlacedBody], float]) -> tuple[float, float]:
        """
        >>> estimate = estimated_body("straight", 6.2, {"L": 0.45})
        >>> low, high = estimate.band(lambda placed: placed.body.effective_mass(placed.wheel) / 6.2)
        >>> round(low, 2), round(high, 2)
        (0.23, 0.36)
        """
        return self.bands(lambda placed: (quantity(placed),))[0]

    def bands(self, quantities: Callable[[PlacedBody], Sequence[float]]) -> tuple[tuple[float, float], ...]:
        """Bands of several quantities, each as `band` finds it."""
        nominal = quantities(self.nominal)
        down, up = [0.0] * len(nominal), [0.0] * len(nominal)
        for pair in self.ends:
            for place, values in enumerate(zip(*map(quantities, pair), strict=True)):
                changes = [value - nominal[place] for value in values]
                down[place] = math.hypot(down[place], min(*changes, 0.0))
                up[place] = math.hypot(up[place], max(*changes, 0.0))
        return tuple((value - low, value + high) for value, low, high in zip(nominal, down, up, strict=True))


HAND_GRINDERS: Final = (0.5, 15.0)
"""Masses [kg] of hand grinders, for which usual lengths are assumed."""


def usual_lengths(layout: Layout, mass: float) -> dict[str, float]:
    """Lengths [mm] by their keys that a hand grinder of this mass [kg] usually has; nothing for other machines.

    >>> usual_lengths("straight", 5.6), usual_lengths("angle", 2.2), usual_lengths("face", 400.0)
    ({'machine.length_mm': 440.0}, {'machine.length_mm': 330.0, 'machine.height_mm': 75.0}, {})
    """
    low, high = HAND_GRINDERS
    if not low <= mass <= high:
        return {}
    table, grid = toml_table("body_estimates")[layout], {"L": ("usual_length", 10), "H": ("usual_height", 5)}
    return {
        KEYS[length]: float(step * round(table[usual] * mass ** (1 / 3) / step))
        for length, (usual, step) in grid.items() if length in LENGTHS[layout]
    }  # fmt: skip


def estimate_source() -> str:
    """Source of the shapes, in words."""
    table = toml_table("body_estimates")
    return f"{table['source']}; {table['edition']}, not measured"


@formula(
    "Rigid body of a hand grinder by its layout, mass and lengths",
    "J_i = M·k_i²",
    "kg m²",
    where=(
        "L is machine.length_mm, H is machine.height_mm. Straight: L runs from the wheel plane to the rear end; a "
        "is 0.44 L (0.39 … 0.50), k_x = k_y = 0.284 L (0.26 … 0.31), k_z = 0.06 L (0.05 … 0.07). Angle: L runs "
        "from the spindle axis to the rear end, H from the body's axis to the wheel plane; b is 0.29 L (0.25 … "
        "0.34), a is 0.80 H (0.70 … 0.90), without H 0.176 L (0.137 … 0.229), k_x = 0.136 L (0.12 … 0.15), k_y = "
        "0.29 L (0.265 … 0.315), k_z = 0.295 L (0.27 … 0.32), J_xz is −0.2 (−0.30 … −0.13) times M·a·b. Face: H "
        "runs from the wheel plane to the top; a is 0.43 H (0.38 … 0.49), b is 0 (±0.03 H), k_x = 0.37 H (0.33 … "
        "0.42), k_y = 0.285 H (0.255 … 0.315), k_z = 0.29 H (0.25 … 0.35). "
        "a is the distance from the centre of mass to the wheel plane, b that to the spindle axis. In brackets: 95 % "
        "of such assemblies. The rotor's polar inertia is ½·m·R_w² of the wheel unless the file gives it."
    ),
    signs="M",
    checked=(HEIGHT,),
    assumed="usual shares of mass of wheel, motor, gear and handles",
    source="4000 random assemblies of cylinders per layout; assumed, not measured",
)
def estimated_body(
    layout: Layout,
    mass: float,
    lengths: Mapping[str, float],
    polar: float = 0.0,
    center_of_mass_to_wheel: Vector | None = None,
) -> BodyEstimate:
    """`lengths` [m] by their names L and H; a known place of the wheel leaves the moments alone uncertain.

    >>> estimated_body("straight", 6.2, {"L": 0.45}).nominal.wheel
    (0.0, 0.0, 0.198)
    """
    table: dict[str, Any] = dict(toml_table("body_estimates")[layout])
    if not lengths.get("H") and "along_without_height" in table:
        table["along"] = table["along_without_height"]
    needed = {row[0] for name, row in table.items() if name in (*_SHAPE, *_PLACE) and name != "product"}
    if center_of_mass_to_wheel is not None:
        needed = {table[name][0] for name in _SHAPE[:3] if name in table}
    for length in sorted(needed):
        if not lengths.get(length, 0.0) > 0:
            raise InputError(
                f'layout = "{layout}" is estimated from this length too, which is missing',
                place=Place(key=KEYS[length]),
                remedy=f"add {KEYS[length].partition('.')[2]}, or give the inertia itself",
            )
    if layout == "angle" and "H" in needed:
        HEIGHT.check(lengths["H"] / lengths["L"])
    uncertain = {name: row for name, row in table.items() if name in (*_SHAPE, *_PLACE) and row[-1] != row[-2]}
    if center_of_mass_to_wheel is not None:
        uncertain = {name: row for name, row in uncertain.items() if name not in _PLACE}

    def body(changed: str = "", end: int = -3) -> PlacedBody:
        def value(name: str) -> float:
            row = table[name]
            ratio = float(row[end if name == changed else -3])
            return ratio * lengths[row[0]] if isinstance(row[0], str) else ratio

        wheel = center_of_mass_to_wheel or (value("across"), 0.0, value("along"))
        kx = value("k_x")
        ky = value("k_y") if "k_y" in table else kx
        product = value("product") * mass * math.hypot(wheel[0], wheel[1]) * wheel[2]
        inertia = Inertia(mass * kx**2, mass * ky**2, mass * value("k_z") ** 2, product)
        return PlacedBody(RigidBody(mass, inertia, polar), wheel)

    return BodyEstimate(body(), tuple((body(name, -2), body(name, -1)) for name in uncertain))
