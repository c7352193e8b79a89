"""The two joints of a bearing: the inner ring on the shaft, the outer ring in the housing."""

from abu_calc.fits.bearing import Bearing
from abu_calc.fits.joint import CENTRIFUGAL, Joint, Loss
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
from abu_calc.standards.balls import seat_material
from abu_calc.standards.limits import ring_limits


def shaft_joint(bearing: Bearing) -> Joint:
    """The inner ring on the shaft."""
    steel, service, bore = seat_material("steel"), bearing.service, bearing.inner.diameter
    ring_diameter = inner_ring_diameter(bore, bearing.outer.diameter)
    shaft, ring = Tube(bearing.shaft.bore / bore, steel), Tube(bore / ring_diameter, steel)
    losses = _smoothing(bearing.shaft.roughness)
    if service.ring_over_shaft is not None:
        warmth = temperature_loss(steel.expansion, bore, service.ring_over_shaft)
        losses.append(Loss("temperature", warmth, "α·d·ΔT"))
    if service.speed is not None:
        growth = centrifugal_loss(service.speed, bore, ring_diameter, bearing.shaft.bore, steel)
        losses.append(Loss(CENTRIFUGAL, growth, "(3+ν)·ρ·Ω²·d·(d₁² − d₀²)/(16·E)"))
    pressure = contact_pressure(1.0, bore, shaft, ring)
    return Joint(
        seat="shaft",
        tolerance_class=bearing.shaft.fit,
        ring=bearing.inner,
        ring_limits=ring_limits(bearing.type, "inner", bearing.bearing_class, bore),
        radial_load=service.radial_load,
        factor=SERIES_FACTORS[bearing.series],
        losses=tuple(losses),
        pressure_rate=pressure,
        stress_rate=inner_ring_stress(1.0, bore, shaft, ring),
        raceway_rate=raceway_change(pressure, bore, ring),
    )


def housing_joint(bearing: Bearing) -> Joint:
    """The outer ring in the housing. A ring warmer than its housing sits tighter, so that is no loss here."""
    part, outer = bearing.housing, bearing.outer.diameter
    ring = Tube(outer_ring_diameter(bearing.inner.diameter, outer) / outer, seat_material("steel"))
    housing = Tube(0.0 if part.outer is None else outer / part.outer, seat_material(part.material))
    pressure = contact_pressure(1.0, outer, ring, housing)
    return Joint(
        seat="housing",
        tolerance_class=part.fit,
        ring=bearing.outer,
        ring_limits=ring_limits(bearing.type, "outer", bearing.bearing_class, outer),
        radial_load=bearing.service.radial_load,
        factor=SERIES_FACTORS[bearing.series],
        losses=tuple(_smoothing(part.roughness)),
        pressure_rate=pressure,
        stress_rate=outer_ring_stress(1.0, outer, ring, housing),
        raceway_rate=raceway_change(pressure, outer, ring),
    )


def _smoothing(roughness: float | None) -> list[Loss]:
    return [] if roughness is None else [Loss("smoothing", smoothing_loss(roughness), "0.4·Rz (DIN 7190-1:2017)")]
