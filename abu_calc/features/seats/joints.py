"""Joints of a bearing: its inner ring on the shaft, its outer ring in the housing.

A seat at work: its interference cold and hot, the clearance inside the bearing then, and how its ring is mounted.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated, Final

from abu_calc.features.seats.bearing import SEAT_DIAMETER, MatingPart, Ring, SeatedBearing
from abu_calc.features.seats.clearance import states
from abu_calc.features.seats.interference import (
    SERIES_FACTORS,
    Pair,
    SeatRecord,
    centrifugal_loss,
    smoothing_loss,
    temperature_loss,
)
from abu_calc.features.seats.joint import (
    CENTRIFUGAL,
    MEASURED,
    TEMPERATURE,
    Joint,
    Loss,
    ThermalCase,
    Tube,
    contact_pressure,
    inner_ring_diameter,
    inner_ring_stress,
    outer_ring_diameter,
    outer_ring_stress,
    raceway_change,
)
from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.foundation.validity import Range
from abu_calc.standards.balls import seat_material, seat_strength
from abu_calc.standards.tolerance_classes import (
    NORMAL_RATIO,
    DeviationLimits,
    MakerFits,
    Seat,
    maker_fits,
    part_limits,
    ring_limits,
    tolerance_classes,
)

ADVISED: Final = {"shaft": "k6", "housing": "H7"}
"""Classes that stand in until one is advised, where none is given."""
ROOM: Final = 20.0
"""Temperature of mounting [°C]."""
USUAL_RISE: Final = 50.0
"""Temperature of a bearing at work above mounting [K] where none is given: 70 °C, assumed."""
HIGHEST_RATIO: Final = 0.5
"""P/C up to which the catalogue's rows and ISO 281 hold."""
THIN: Final = 0.85
"""Share of the pressure in a thick steel housing below which one counts as thin-walled or of light alloy; assumed.

A thick housing of aluminium keeps 0.74."""
_LIGHT: Final = frozenset({"aluminium", "magnesium"})
_OWN_REFERENCE: Final = frozenset({"cast-iron"})
"""Materials of thick parts that the catalogue's rows are meant for, beside steel."""


def shaft_joint(bearing: SeatedBearing) -> Joint:
    """The inner ring on the shaft; of a bearing without one, the needles on it."""
    part, service, bore = bearing.shaft, bearing.service, bearing.inner.diameter
    steel, own = seat_material("steel"), seat_material(part.material)
    ring_diameter, hollow = inner_ring_diameter(bore, bearing.outer.diameter), part.other or 0.0
    shaft, ring = Tube(hollow / bore, own), Tube(bore / ring_diameter, steel)
    losses = _smoothing(part.roughness)
    losses += _warmth(bore, warm_parts(bearing, "shaft"))
    usual_growth = 0.0
    if service.speed is not None:
        growth = centrifugal_loss(service.speed, bore, ring_diameter, hollow, steel)
        limit = bearing.entry.limiting_speed if bearing.entry else None
        usual_growth = growth if limit is not None and service.speed <= limit * (1 + 1e-9) else 0.0
        losses.append(Loss(name=CENTRIFUGAL, amount=growth, formula="(3+ν)·ρ·Ω²·d·(d₁² − d₀²)/(16·E)"))
    pressure = contact_pressure(1.0, bore, shaft, ring)
    solid = Tube(0.0, own if part.material in _OWN_REFERENCE else steel)
    kept = pressure / contact_pressure(1.0, bore, solid, ring)
    # The core of a solid shaft is under the pressure itself; a hollow one has its hoop stress at the bore.
    stress_rate = inner_ring_stress(1.0, bore, shaft, ring)
    part_rate = pressure * (shaft.hoop_under_pressure_outside if hollow else 1.0)
    rates = (pressure, stress_rate, raceway_change(pressure, bore, ring), part_rate)
    if bearing.no_inner_ring:
        seat = replace(bearing.inner, load="stationary")
        return replace(
            _joint("shaft", bearing, part, seat, (), rates, kept),
            ring_limits=_under_needles(bearing),
            runs_on_needles=True,
        )
    joint = _joint("shaft", bearing, part, bearing.inner, tuple(losses), rates, kept)
    return replace(joint, usual_growth=usual_growth)


def housing_joint(bearing: SeatedBearing) -> Joint:
    """The outer ring in the housing."""
    part, outer = bearing.housing, bearing.outer.diameter
    steel, own = seat_material("steel"), seat_material(part.material)
    ring = Tube(outer_ring_diameter(bearing.inner.diameter, outer) / outer, steel)
    housing = Tube(0.0 if part.other is None else outer / part.other, own)
    losses = _smoothing(part.roughness)
    losses += _warmth(outer, warm_parts(bearing, "housing"))
    pressure = contact_pressure(1.0, outer, ring, housing)
    thick = Tube(0.0, own if part.material in _OWN_REFERENCE else steel)
    kept = pressure / contact_pressure(1.0, outer, ring, thick)
    stress_rate = outer_ring_stress(1.0, outer, ring, housing)
    rates = (pressure, stress_rate, raceway_change(pressure, outer, ring), pressure * housing.hoop_at_bore)
    return _joint("housing", bearing, part, bearing.outer, tuple(losses), rates, kept)


def makers_classes(bearing: SeatedBearing, seat: Seat, thin: bool = False) -> MakerFits | None:
    """The catalogue's classes of a seat; a type that is not told is taken as ball, a ratio not known as normal load.

    None above half of C if the ring's load rotates: no row is meant for that.
    """
    ring, split = (bearing.inner, False) if seat == "shaft" else (bearing.outer, bearing.housing.split)
    ratio = NORMAL_RATIO if bearing.load_ratio is None else bearing.load_ratio
    if ratio > HIGHEST_RATIO and ring.load != "stationary":
        return None
    thin = bearing.housing.material in _LIGHT if bearing.kind == "drawn-cup" else thin
    kind = bearing.kind or "ball"
    if bearing.no_inner_ring and seat == "shaft":
        kind = "drawn-cup"  # the shaft is the raceway of machined rings, too
    row = maker_fits(seat, kind, ring.load, ratio, ring.diameter, bearing.bearing_class, split, thin)
    light = seat == "housing" and bearing.housing.material in _LIGHT and kind != "drawn-cup"
    return row if row is None or not light or split or ring.load == "rotating" else _for_light_alloy(row)


TIGHTER: Final = {"G": "H", "H": "J", "J": "K", "JS": "K", "K": "M", "M": "N"}
"""The next tighter letter of a hole."""


def _for_light_alloy(row: MakerFits) -> MakerFits:
    """The row's class a step tighter, since the housing grows twice as much as the ring when both are warm.

    Source: SKF, Rolling bearings and seals in electric motors and generators (J7 where H7 stands for iron).
    """
    letter, grade = row.classes[0].rstrip("0123456789"), row.classes[0].lstrip("ABCDEFGHIJKLMNOPQRSTUVWXYZ")
    next_class = f"{TIGHTER.get(letter, letter)}{grade}"
    tighter = next_class if next_class in tolerance_classes("housing") else f"JS{grade}"
    others = tuple(name for name in row.classes if name != tighter and name[0] >= tighter[0])
    return MakerFits((tighter, *others), row.special, "a step tighter in light alloy")


def expansions(bearing: SeatedBearing, seat: Seat) -> tuple[float, float]:
    """Expansion [1/K] of the part around and of the part inside."""
    ring = seat_material("steel").expansion
    part = seat_material((bearing.shaft if seat == "shaft" else bearing.housing).material).expansion
    return (ring, part) if seat == "shaft" else (part, ring)


def assumes_warmth(bearing: SeatedBearing) -> bool:
    """True if nothing is told of temperatures, so that the usual one at work is assumed."""
    service = bearing.service
    rings = service.ring_temperature_difference, service.housing_temperature_difference
    return all(each is None for each in (service.temperature_rise, service.temperature_range, *rings))


def warm_parts(
    bearing: SeatedBearing, seat: Seat, rise: float | None = None
) -> tuple[tuple[float, float], tuple[float, float]] | None:
    """Expansion [1/K] and warmth above mounting [K] of the part around and of the part inside; None where no
    temperature is given. What is not told of the bearing's own warmth is taken as none.

    `rise`: all parts at this temperature above that of mounting, whatever is given.
    """
    service, (around, inside) = bearing.service, expansions(bearing, seat)
    other = service.ring_temperature_difference if seat == "shaft" else service.housing_temperature_difference
    if rise is None and other is None and service.temperature_rise is None:
        return None
    warmth = (service.temperature_rise or 0.0) if rise is None else rise
    difference = (other or 0.0) if rise is None else 0.0
    if seat == "shaft":
        return (around, warmth), (inside, warmth - difference)
    return (around, warmth + difference), (inside, warmth)


def _thermal_cases(bearing: SeatedBearing, seat: Seat, diameter: float) -> tuple[ThermalCase, ...]:
    """Losses at mounting, at work and at the lowest and highest temperature, as far as they are given."""
    service = bearing.service
    assumed = USUAL_RISE if assumes_warmth(bearing) else None
    working = warm_parts(bearing, seat, assumed)
    cases = [ThermalCase("mounting", 0.0, 0.0)]
    if working is not None:
        rise = service.temperature_rise if assumed is None else assumed
        cases.append(ThermalCase("working", rise, temperature_loss(diameter, *working)))
    for name, rise in zip(("lowest", "highest"), service.temperature_range or (), strict=False):
        parts = warm_parts(bearing, seat, rise)
        assert parts is not None
        cases.append(ThermalCase(name, rise, temperature_loss(diameter, *parts)))
    return tuple(cases)


def _under_needles(bearing: SeatedBearing) -> DeviationLimits:
    """Limits of the diameter under the needles after mounting: F8 of drawn-cup bearings, F6 of machined ones.

    Source: NTN's needle roller catalogue (HK, BK in a stiff housing), ISO 1206 (RNA); not verified.
    """
    diameter = bearing.inner.diameter
    if bearing.kind == "drawn-cup":
        return part_limits("housing", "F8", diameter)
    lower = part_limits("housing", "F7", diameter).lower
    return DeviationLimits(lower, lower + part_limits("shaft", "h6", diameter).tolerance)


def _warmth(diameter: float, parts: tuple[tuple[float, float], tuple[float, float]] | None) -> list[Loss]:
    return (
        []
        if parts is None
        else [Loss(name=TEMPERATURE, amount=temperature_loss(diameter, *parts), formula="d·(α₂·ΔT₂ − α₁·ΔT₁)")]
    )


def _joint(
    seat: Seat,
    bearing: SeatedBearing,
    part: MatingPart,
    ring: Ring,
    losses: tuple[Loss, ...],
    rates: tuple[float, float, float, float],
    kept: float,
) -> Joint:
    pressure, stress, raceway, own = rates
    normal = bearing.normal_load
    known = bearing.kind is not None and (bearing.load_ratio is not None or normal is not None)
    thin = seat == "housing" and kept < THIN
    return Joint(
        seat=seat,
        tolerance_class=part.fit or (MEASURED if part.measured else ADVISED[seat]),
        ring=ring,
        ring_limits=ring.measured
        or ring_limits(bearing.type, "inner" if seat == "shaft" else "outer", bearing.bearing_class, ring.diameter),
        radial_load=bearing.service.radial_load if normal is None else normal,
        load_assumed=normal is not None,
        warmth_assumed=assumes_warmth(bearing),
        light_alloy=seat == "housing" and part.material in _LIGHT,
        factor=SERIES_FACTORS[bearing.series],
        losses=losses,
        pressure_rate=pressure,
        stress_rate=stress,
        raceway_rate=raceway,
        part_rate=own,
        part_strength=part.strength or seat_strength(part.material),
        measured=part.measured,
        split=part.split,
        maker=makers_classes(bearing, seat, thin) if known else None,
        pressure_kept=kept,
        thermal_cases=_thermal_cases(bearing, seat, ring.diameter),
        short_shares=bearing.short_shares,
        cup_classes=_cup_classes(bearing) if seat == "housing" and bearing.drawn_cup else (),
    )


def _cup_classes(bearing: SeatedBearing) -> tuple[str, ...]:
    row = makers_classes(bearing, "housing")
    return row.classes[:2] if row else ()


def _smoothing(roughness: float | None) -> list[Loss]:
    return (
        []
        if roughness is None
        else [Loss(name="smoothing", amount=smoothing_loss(roughness), formula="0.4·Rz (DIN 7190-1:2017)")]
    )


HOTTEST_RING: Final = 120.0
"""Temperature [°C] that the steel of a ring keeps its size up to (bearing makers' mounting handbooks)."""
HOTTEST_CLOSED: Final = 80.0
"""The same of a bearing with seals or grease [°C]."""
LEAST_CLEARANCE: Final = 5e-6
CLEARANCE_SHARE: Final = 1 / 2000
"""Clearance [m] wanted of a heated ring, and its share of the diameter, where none is given; assumed."""
INTERFERENCE: Final = Range("interference", -1e-2, 1e-2, "m")


@record
class SeatMounting(SeatRecord):
    """How a ring gets onto its seat: by heat, or by a press. None: it needs none."""

    heat_ring_C: Annotated[
        float | None, Quantity("temperature of the heated ring", "", 3, "with the clearance wanted, tightest pair")
    ]
    heat_housing_C: Annotated[
        float | None, Quantity("temperature of the heated housing", "", 3, "with the clearance wanted, tightest pair")
    ]
    cool_part_C: Annotated[
        float | None,
        Quantity("temperature of the cooled shaft or ring", "", 3, "beside the hottest that is permitted, if needed"),
    ]
    hottest_C: Annotated[float, Quantity("hottest that the ring may be", "", 3)]
    mounting_clearance: Annotated[float, Quantity("clearance wanted when mounting", "", 3, unit="um")]
    press_force_N: Annotated[
        Pair | None, Quantity("mounting force", "F", 3, "cold, of the loosest and the tightest pair; μ as given")
    ]
    lets_go_at_C: Annotated[
        Pair | None,
        Quantity("temperature that lets the ring go", "", 3, "ring and part alike; the loosest, the tightest pair"),
    ]


@formula(
    "Temperature at which a heated part slides over the other",
    "T = T₀ + (δ + c)/(α·d)",
    "°C",
    where="c is the clearance wanted. The other part stays at T₀ = 20 °C.",
    checked=(INTERFERENCE, SEAT_DIAMETER),
    source="linear expansion",
    own_units=True,
)
def heated(interference: float, clearance: float, expansion: float, diameter: float) -> float:
    """
    >>> round(heated(45e-6, 40e-6, 12e-6, 0.080), 1)
    108.5
    """
    return ROOM + (INTERFERENCE.check(interference) + clearance) / (expansion * SEAT_DIAMETER.check(diameter))


@formula(
    "Force that presses a ring onto its seat",
    "F = μ·p·π·d·b_s",
    "N",
    where="p is the pressure of the joint (Lamé).",
    checked=(SEAT_DIAMETER,),
    assumed="cold, pressure even along the seat",
    source="DIN 7190-1:2017",
)
def mounting_force(pressure: float, diameter: float, length: float, friction: float) -> float:
    """
    >>> round(mounting_force(20e6, 0.080, 0.029, 0.12))
    17492
    """
    return friction * pressure * math.pi * SEAT_DIAMETER.check(diameter) * length


def seat_mounting(bearing: SeatedBearing, joint: Joint) -> SeatMounting:
    """Heat, force of the press, and the temperature that lets the ring go; without a chamfer its width is the length.

    A ring is heated for its shaft, a housing for its ring. A ring that would be hotter than it may be goes with a
    cooled shaft. The force is that of the apparent interference.
    """
    d, (around, inside) = joint.diameter, expansions(bearing, joint.seat)
    least, most = (max(end, 0.0) for end in joint.interference)
    wanted = bearing.service.mounting_clearance
    clearance = max(LEAST_CLEARANCE, CLEARANCE_SHARE * d) if wanted is None else wanted
    tight = most > 0
    hot = heated(most, clearance, around, d) if tight else None
    top, on_shaft = HOTTEST_CLOSED if bearing.closed else HOTTEST_RING, joint.seat == "shaft"
    cool = None
    if hot is not None and hot > top and on_shaft:
        kept = (top - ROOM) * around * d - most
        if wanted is None and kept >= LEAST_CLEARANCE:
            hot, clearance = top, kept  # as hot as it may be leaves enough
    if hot is not None and hot > top and on_shaft:
        cool = ROOM - ((hot - top) * around) / inside
    length = joint.length or joint.ring.width
    forces = tuple(
        mounting_force(joint.pressure_rate * end, d, length, bearing.service.seat_friction) for end in (least, most)
    )
    apart = (around - inside) * d
    return SeatMounting(
        heat_ring_C=hot if on_shaft else None,
        heat_housing_C=None if on_shaft else hot,
        cool_part_C=cool,
        hottest_C=top,
        mounting_clearance=clearance,
        press_force_N=(forces[0], forces[1]) if tight else None,
        lets_go_at_C=(ROOM + least / apart, ROOM + most / apart) if tight and apart > 1e-12 else None,
    )


def at_work(joint: Joint) -> Mapping[str, Pair]:
    """Interference [m] cold and hot, from the loosest to the tightest pair."""
    low, high = joint.interference
    cases = {"cold": joint.coldest, "hot": joint.hottest}
    return {name: (low - case.loss, high - case.loss) for name, case in cases.items()}


def clearance_at_work(
    bearing: SeatedBearing, shaft: Joint, housing: Joint, group: str, few: float
) -> Mapping[str, Pair]:
    """Clearance [m] inside the bearing cold, as mounted and hot, which all but a `few` at either end have.

    The inner ring is warmer than the outer one when hot alone.
    """
    return {
        name: (mounting.end(group, few), mounting.end(group, 1 - few))
        for name, mounting in zip(("cold", "mounted", "hot"), states(bearing, shaft, housing), strict=True)
    }
