"""The two joints of a bearing: the inner ring on the shaft, the outer ring in the housing."""

from typing import Final

from abu_calc.fits.bearing import Bearing, Part, Ring
from abu_calc.fits.joint import CENTRIFUGAL, MEASURED, WARMTH, Joint, Loss
from abu_calc.fits.requirement import SERIES_FACTORS, centrifugal_loss, smoothing_loss, temperature_loss
from abu_calc.fits.stress import (
    Tube,
    contact_pressure,
    inner_ring_diameter,
    inner_ring_stress,
    outer_ring_diameter,
    outer_ring_stress,
    raceway_change,
)
from abu_calc.standards.balls import seat_material, seat_strength
from abu_calc.standards.limits import Seat, ring_limits
from abu_calc.standards.maker_fits import NORMAL_RATIO, MakerFits, maker_fits

ADVISED: Final = {"shaft": "k6", "housing": "H7"}
"""Classes that stand in until one is advised, where none is given."""


def shaft_joint(bearing: Bearing) -> Joint:
    """The inner ring on the shaft."""
    part, service, bore = bearing.shaft, bearing.service, bearing.inner.diameter
    steel, own = seat_material("steel"), seat_material(part.material)
    ring_diameter, hollow = inner_ring_diameter(bore, bearing.outer.diameter), part.other or 0.0
    shaft, ring = Tube(hollow / bore, own), Tube(bore / ring_diameter, steel)
    losses = _smoothing(part.roughness)
    losses += _warmth(bore, warm_parts(bearing, "shaft"))
    if service.speed is not None:
        growth = centrifugal_loss(service.speed, bore, ring_diameter, hollow, steel)
        losses.append(Loss(CENTRIFUGAL, growth, "(3+ν)·ρ·Ω²·d·(d₁² − d₀²)/(16·E)"))
    pressure = contact_pressure(1.0, bore, shaft, ring)
    # The core of a solid shaft is under the pressure itself; a hollow one has its hoop stress at the bore.
    stress_rate = inner_ring_stress(1.0, bore, shaft, ring)
    part_rate = pressure * (shaft.hoop_under_pressure_outside if hollow else 1.0)
    rates = (pressure, stress_rate, raceway_change(pressure, bore, ring), part_rate)
    return _joint("shaft", bearing, part, bearing.inner, tuple(losses), rates)


def housing_joint(bearing: Bearing) -> Joint:
    """The outer ring in the housing."""
    part, outer = bearing.housing, bearing.outer.diameter
    steel, own = seat_material("steel"), seat_material(part.material)
    ring = Tube(outer_ring_diameter(bearing.inner.diameter, outer) / outer, steel)
    housing = Tube(0.0 if part.other is None else outer / part.other, own)
    losses = _smoothing(part.roughness)
    losses += _warmth(outer, warm_parts(bearing, "housing"))
    pressure = contact_pressure(1.0, outer, ring, housing)
    stress_rate = outer_ring_stress(1.0, outer, ring, housing)
    rates = (pressure, stress_rate, raceway_change(pressure, outer, ring), pressure * housing.hoop_at_bore)
    return _joint("housing", bearing, part, bearing.outer, tuple(losses), rates)


def makers_classes(bearing: Bearing, seat: Seat) -> MakerFits | None:
    """The catalogue's classes of a seat; a type that is not told is taken as ball, a ratio not known as normal load."""
    ring, split = (bearing.inner, False) if seat == "shaft" else (bearing.outer, bearing.housing.split)
    ratio = NORMAL_RATIO if bearing.load_ratio is None else bearing.load_ratio
    return maker_fits(seat, bearing.kind or "ball", ring.load, ratio, ring.diameter, bearing.bearing_class, split)


def warm_parts(bearing: Bearing, seat: Seat) -> tuple[tuple[float, float], tuple[float, float]] | None:
    """Expansion [1/K] and warmth above mounting [K] of the part around and of the part inside; None where no
    temperature is given. What is not told of the bearing's own warmth is taken as none."""
    service, steel = bearing.service, seat_material("steel").expansion
    other = service.ring_over_shaft if seat == "shaft" else service.housing_over_ring
    if other is None and service.over_mounting is None:
        return None
    rise = service.over_mounting or 0.0
    if seat == "shaft":
        return (steel, rise), (seat_material(bearing.shaft.material).expansion, rise - (other or 0.0))
    return (seat_material(bearing.housing.material).expansion, rise + (other or 0.0)), (steel, rise)


def _warmth(diameter: float, parts: tuple[tuple[float, float], tuple[float, float]] | None) -> list[Loss]:
    return [] if parts is None else [Loss(WARMTH, temperature_loss(diameter, *parts), "d·(α₂·ΔT₂ − α₁·ΔT₁)")]


def _joint(
    seat: Seat,
    bearing: Bearing,
    part: Part,
    ring: Ring,
    losses: tuple[Loss, ...],
    rates: tuple[float, float, float, float],
) -> Joint:
    pressure, stress, raceway, own = rates
    return Joint(
        seat=seat,
        tolerance_class=part.fit or (MEASURED if part.measured else ADVISED[seat]),
        ring=ring,
        ring_limits=ring_limits(
            bearing.type, "inner" if seat == "shaft" else "outer", bearing.bearing_class, ring.diameter
        ),
        radial_load=bearing.service.radial_load,
        factor=SERIES_FACTORS[bearing.series],
        losses=losses,
        pressure_rate=pressure,
        stress_rate=stress,
        raceway_rate=raceway,
        part_rate=own,
        part_strength=part.strength or seat_strength(part.material),
        measured=part.measured,
        split=part.split,
        maker=makers_classes(bearing, seat) if bearing.load_ratio is not None and bearing.kind else None,
    )


def _smoothing(roughness: float | None) -> list[Loss]:
    return [] if roughness is None else [Loss("smoothing", smoothing_loss(roughness), "0.4·Rz (DIN 7190-1:2017)")]
