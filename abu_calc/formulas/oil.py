"""Oil in a race: viscosity over temperature, depth of the ring that rotation makes of a fill, drag of a ball in it."""

import math
from collections.abc import Callable
from typing import Final

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import GRAVITY, to_si
from abu_calc.foundation.validity import Range

ADDED: Final = 0.7
"""mm²/s, of the double logarithm."""
KELVIN: Final = 273.15
VISCOSITY: Final = Range(
    "kinematic viscosity of the oil", 2.0, 1e5, "mm²/s", remedy="Specify another oil or other temperatures.", key="oil"
)
AT_40: Final = Range("viscosity at 40 °C", 5.0, 2000.0, "mm²/s", key="oil.viscosity_mm2_per_s")
INDEX: Final = Range("viscosity index", 0.0, 250.0, key="oil.viscosity_index")
TEMPERATURE: Final = Range("temperature of the oil", -20.0, 120.0, "°C", key="oil.temperature_C")
REYNOLDS: Final = Range(
    "Reynolds number of a ball in oil", 0.0, 1e5, open_low=True, remedy="Reduce slip_m_per_s.", key="oil.slip_m_per_s"
)
THROWN: Final = Range(
    "acceleration of the race over gravity", 10.0, math.inf,
    remedy="Below it the oil does not lie in an even ring: leave [oil] out and give rolling_drag_per_s.", key="oil",
)  # fmt: skip
CREEPING: Final = 10.0
ROUGH: Final = 20_000.0
"""Reynolds numbers at which the branches of the drag coefficient meet."""
GAP: Final = 0.3e-6
"""Least gap between ball and race: the roughness of both (assumed)."""
INDEX_CURVES: Final = (
    (2.0, 1.14673, 1.7576, -0.109, 0.84155, 1.5521, -0.077),
    (3.8, 3.38095, -15.4952, 33.196, 0.78571, 1.7929, -0.183),
    (4.4, 2.5, -7.2143, 13.812, 0.82143, 1.5679, 0.119),
    (5.0, 0.101, 16.635, -45.469, 0.04985, 9.1613, -18.557),
    (6.4, 3.35714, -23.5643, 78.466, 0.22619, 7.7369, -16.656),
    (7.0, 0.01191, 21.475, -72.87, 0.79762, -0.7321, 14.61),
    (7.7, 0.41858, 16.1558, -56.04, 0.05794, 10.5156, -28.24),
    (9.0, 0.88779, 7.5527, -16.6, 0.26665, 6.7015, -10.81),
    (12.0, 0.7672, 10.7972, -38.18, 0.20073, 8.4658, -22.49),
    (15.0, 0.97305, 5.3135, -2.2, 0.28889, 5.9741, -4.93),
    (18.0, 0.97256, 5.25, -0.98, 0.24504, 7.416, -16.73),
    (22.0, 0.91413, 7.4759, -21.82, 0.20323, 9.1267, -34.23),
    (28.0, 0.87031, 9.7157, -50.77, 0.18411, 10.1015, -46.75),
    (40.0, 0.84703, 12.6752, -133.31, 0.17029, 11.4866, -80.62),
    (55.0, 0.85921, 11.1009, -83.19, 0.1713, 11.368, -76.94),
    (70.0, 0.83531, 14.6731, -216.246, 0.16841, 11.8493, -96.947),
)
"""ASTM D2270: from this viscosity at 100 °C on, coefficients of L and of H. The open packages lubepy 1.0a0 (all
16 rows) and chemicals (table of L and H) give the same; the standard itself was not at hand."""


@formula(
    "Viscosity index of an oil by its viscosities at 40 °C and 100 °C",
    "VI = 100·(L_v − ν_40)/(L_v − H_v); above 100: 100 + (10^N_v − 1)/0.00715, N_v = lg(H_v/ν_40)/lg ν_100",
    "1",
    where="L_v and H_v are the viscosities at 40 °C of reference oils of index 0 and 100 with the same ν_100.",
    source="ISO 2909, ASTM D2270 (polynomials of its appendix)",
)
def viscosity_index(at_40: float, at_100: float) -> float:
    """Viscosities in mm²/s.

    >>> round(viscosity_index(73.30, 8.86), 1), round(viscosity_index(22.83, 5.05))
    (92.4, 156)
    """
    curve = next(curve for curve in reversed(INDEX_CURVES) if at_100 >= curve[0])
    low = curve[1] * at_100**2 + curve[2] * at_100 + curve[3]
    high = curve[4] * at_100**2 + curve[5] * at_100 + curve[6]
    if at_40 >= high:
        return 100 * (low - at_40) / (low - high)
    exponent = (math.log10(high) - math.log10(at_40)) / math.log10(at_100)
    return 100 + (10**exponent - 1) / 0.00715


def viscosity_at_100(at_40: float, index: float) -> float:
    """Viscosity at 100 °C [mm²/s] of an oil by its viscosity at 40 °C [mm²/s] and its index.

    >>> round(viscosity_at_100(46.0, 95.0), 2)
    6.64
    """
    AT_40.check(at_40)
    INDEX.check(index)
    return _root(lambda at_100: viscosity_index(at_40, at_100) - index, INDEX_CURVES[0][0], at_40)


def _root(excess: Callable[[float], float], low: float, high: float) -> float:
    """Place where a rising function is zero, by halving; an end of the range if it is not inside."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if excess(middle) > 0 else (middle, high)
    return (low + high) / 2


@formula(
    "Kinematic viscosity of an oil at a temperature",
    "lg lg(ν_o + 0.7) = A_o − B_o·lg T_o",
    "mm²/s",
    where="The equation takes ν_o in mm²/s. A_o and B_o follow from the viscosities at 40 °C and 100 °C.",
    checked=(TEMPERATURE, VISCOSITY),
    assumed="a mineral oil above its pour point",
    source="ASTM D341, Ubbelohde and Walther 1931",
)
def oil_viscosity(temperature: float, at_40: float, at_100: float) -> float:
    """Temperature in °C, viscosities in mm²/s.

    >>> round(oil_viscosity(40.0, 46.0, 6.6), 9), round(oil_viscosity(5.0, 46.0, 6.6)), round(
    ...     oil_viscosity(80.0, 46.0, 6.6), 1)
    (46.0, 404, 10.8)
    """
    TEMPERATURE.check(temperature)
    (t1, v1), (t2, v2) = (
        (math.log10(t + KELVIN), math.log10(math.log10(v + ADDED))) for t, v in ((40.0, at_40), (100.0, at_100))
    )
    line = v1 + (v2 - v1) / (t2 - t1) * (math.log10(temperature + KELVIN) - t1)
    return VISCOSITY.check(10 ** (10**line) - ADDED)


@dataclass(frozen=True)
class OilRace:
    """Race that holds the oil [m]: radius and groove radius, inner width, hub radius, number of balls, their radius."""

    race_radius: float
    groove_radius: float
    width: float
    hub_radius: float
    count: int
    ball_radius: float

    def volume(self, depth: float) -> float:
        """Oil [m³] that fills the race to a depth, the balls taken off."""
        layers, total = 200, 0.0
        for k in range(layers):
            h = depth * (k + 0.5) / layers
            chord = 2 * math.sqrt(max(2 * self.groove_radius * h - h * h, 0.0)) if h < self.groove_radius else math.inf
            total += min(chord, self.width) * 2 * math.pi * (self.race_radius - h) * depth / layers
        wet = min(depth, 2 * self.ball_radius)
        return total - self.count * math.pi * wet**2 * (3 * self.ball_radius - wet) / 3

    @property
    def most(self) -> float:
        """Depth down to the hub [m]."""
        return self.race_radius - self.hub_radius


@formula(
    "Depth of the ring of oil that rotation lays into the race",
    "V_o = ∫ 2π·(R − z_o)·w_o(z_o) dz_o − n·π·δ_o²·(3·r − δ_o)/3, z_o from 0 to δ_o",
    "m",
    shown="mm",
    where="w_o is the chord of the groove at the depth z_o, at most the inner width. Balls displace oil.",
    checked=(THROWN,),
    assumed="the free surface is a cylinder about the spindle; no oil leaks or clings to the walls",
    source="geometry, derived",
)
def oil_depth(fill: float, race: OilRace, speed: float) -> float:
    """Fill in m³, speed in rad/s. The depth of a race that is full is that down to its hub.

    >>> race = OilRace(31e-3, 24.4e-3, 17e-3, 12.5e-3, 4, 8e-3)
    >>> round(1e3 * oil_depth(2e-6, race, 607.0), 2)
    1.13
    """
    THROWN.check(speed**2 * race.race_radius / GRAVITY)
    return _root(lambda depth: race.volume(depth) - fill, 0.0, race.most)


@formula(
    "Drag coefficient of a ball that rolls along a wall in a liquid",
    "C_D = 322/Re_b below 10; lg C_D = 3.02 − 1.89·lg Re_b + 0.411·lg² Re_b − 0.033·lg³ Re_b; 0.74 above 20000",
    "1",
    where="Re_b = 2·r·u_b/ν_o. The branches meet at 32.2 and 0.74.",
    checked=(REYNOLDS,),
    assumed="a smooth wall; the ball is wholly under the surface",
    source="Jan and Chen 1997, Movements of a sphere rolling down an inclined plane, J. Hydraulic Research 35(5), "
    "689–706, measured; the coefficients are not verified: no public text of the paper was found",
)
def rolling_drag_coefficient(reynolds: float) -> float:
    """
    >>> [round(rolling_drag_coefficient(re), 3) for re in (1.0, 10.0, 100.0, 1e3, 5e4)]
    [322.0, 32.2, 4.169, 1.439, 0.74]
    """
    REYNOLDS.check(reynolds)
    if reynolds <= CREEPING:
        return 322 / reynolds
    if reynolds >= ROUGH:
        return 0.74
    lg = math.log10(reynolds)
    return float(10 ** (3.02 - 1.89 * lg + 0.411 * lg**2 - 0.033 * lg**3))


@formula(
    "Viscous drag rate of a ball in a ring of oil",
    "h₀ = ρ_o·π·r²·u_b·[C_v·S_v + (C_D − C_v)·S_f]/(2·m), C_v = min(C_D, 322/Re_b)",
    "1/s",
    where="S_v = [24·δ_o/(2·r) + 298·ln(δ_o/z_s)/ln(2·r/z_s)]/322: of the 322, 24 are those of a free ball, the rest "
    "arises in the narrow gap at the wall, by its logarithm. The least gap z_s is 0.3 µm, the roughness. S_f is the "
    "share of the ball's cross-section below the surface. A wholly wetted ball has shares of 1.",
    checked=(REYNOLDS,),
    assumed="the shares of a partly wetted ball are reasoned, not measured: the rate is uncertain by a factor of 3",
    source="derived from the drag coefficient of Jan and Chen 1997 and the logarithm of Goldman, Cox and Brenner 1967",
)
def oil_drag_rate(
    slip: float, viscosity: float, density: float, depth: float, ball_radius: float, ball_mass: float
) -> float:
    """Slip in m/s, viscosity in mm²/s; density in kg/m³.

    >>> [round(oil_drag_rate(u, 46.0, 870.0, 16e-3, 8e-3, 16.7e-3), 1) for u in (0.02, 1.0, 5.0)]
    [4.8, 11.2, 32.1]
    """
    reynolds = 2 * ball_radius * slip / to_si(viscosity, "mm2_per_s")
    whole = rolling_drag_coefficient(reynolds)
    viscous = min(whole, 322 / reynolds)
    wet = min(depth, 2 * ball_radius)
    cap = math.acos(1 - wet / ball_radius) - (1 - wet / ball_radius) * math.sqrt(
        max(2 * wet / ball_radius - (wet / ball_radius) ** 2, 0.0)
    )
    at_wall = max(math.log(wet / GAP) / math.log(2 * ball_radius / GAP), 0.0) if wet > GAP else 0.0
    share = (24 * wet / (2 * ball_radius) + 298 * at_wall) / 322
    shared = viscous * share + (whole - viscous) * cap / math.pi
    return density * math.pi * ball_radius**2 * slip * shared / (2 * ball_mass)


GRADES: Final = (10, 22, 46, 100, 220, 460)
"""ISO viscosity grades (ISO 3448) that are listed: kinematic viscosity at 40 °C [mm²/s], within 10 %."""
SLIPS: Final = (0.02, 0.5, 5.0)
"""Speeds along the race [m/s] for which the drag rate is listed."""


@dataclass(frozen=True)
class OilState:
    """The oil at one temperature [°C]: viscosity [mm²/s], drag rate [1/s] at the slip of the file and at `SLIPS`."""

    temperature: float
    viscosity: float
    drag: float
    by_slip: tuple[float, ...]


@dataclass(frozen=True)
class OilDrag:
    """Drag of the balls in the oil [1/s]; `depth`: of the ring of oil [m]; `overridden`: the file gives the rate."""

    depth: float
    wetted_share: float
    """Depth over the diameter of a ball."""
    working: OilState
    cold: OilState
    hot: OilState
    by_fill: tuple[tuple[float, tuple[float, ...]], ...]
    """Other fills [m³], each with the drag rates at work in oils of `GRADES`."""
    overridden: bool

    @property
    def temperatures(self) -> tuple[float, float, float]:
        """At work, hot and cold [°C]."""
        return self.working.temperature, self.hot.temperature, self.cold.temperature

    @property
    def shares(self) -> tuple[float, float, float]:
        """Drag rates at work, hot and cold over that at work."""
        return 1.0, self.hot.drag / self.working.drag, self.cold.drag / self.working.drag
