"""The two joints of a bearing: the inner ring on the shaft, the outer ring in the housing."""

from abu_calc.fits.bearing import Bearing
from abu_calc.fits.joint import CENTRIFUGAL, Joint, Loss
from abu_calc.fits.requirement import SERIES_FACTORS, centrifugal_loss, smoothing_loss, temperature_loss
from abu_calc.fits.stress import Tube, contact_pressure, inner_ring_diameter, outer_ring_diameter, raceway_change
from abu_calc.standards.balls import seat_material
from abu_calc.standards.limits import ring_limits


def shaft_joint(bearing: Bearing) -> Joint:
    """The inner ring on the shaft."""
    steel = seat_material("steel")
    ring_diameter = inner_ring_diameter(bearing.bore, bearing.outer)
    shaft, ring = Tube(bearing.shaft_bore / bearing.bore, steel), Tube(bearing.bore / ring_diameter, steel)
    losses = _smoothing(bearing.shaft_roughness)
    if bearing.temperature_difference is not None:
        difference = bearing.temperature_difference
        losses.append(Loss("temperature", temperature_loss(steel.expansion, bearing.bore, difference), "α·d·ΔT"))
    if bearing.speed is not None:
        growth = centrifugal_loss(bearing.speed, bearing.bore, ring_diameter, bearing.shaft_bore, steel)
        losses.append(Loss(CENTRIFUGAL, growth, "(3+ν)·ρ·Ω²·d·(d₁² − d₀²)/(16·E)"))
    pressure = contact_pressure(1.0, bearing.bore, shaft, ring)
    return Joint(
        seat="shaft",
        tolerance_class=bearing.shaft_fit,
        diameter=bearing.bore,
        width=bearing.inner_width,
        length=_length(bearing.inner_width, bearing.inner_chamfer),
        ring=ring_limits(bearing.type, "inner", bearing.bearing_class, bearing.bore),
        ring_load=bearing.inner_ring_load,
        radial_load=bearing.radial_load,
        factor=SERIES_FACTORS[bearing.series],
        losses=tuple(losses),
        pressure_rate=pressure,
        stress_rate=pressure * ring.hoop_at_bore,
        raceway_rate=raceway_change(pressure, bearing.bore, ring),
    )


def housing_joint(bearing: Bearing) -> Joint:
    """The outer ring in the housing. A ring warmer than its housing sits tighter, so that is no loss here."""
    ring_ratio = outer_ring_diameter(bearing.bore, bearing.outer) / bearing.outer
    ratio = 0.0 if bearing.housing_outer is None else bearing.outer / bearing.housing_outer
    ring, housing = Tube(ring_ratio, seat_material("steel")), Tube(ratio, seat_material(bearing.housing_material))
    pressure = contact_pressure(1.0, bearing.outer, ring, housing)
    return Joint(
        seat="housing",
        tolerance_class=bearing.housing_fit,
        diameter=bearing.outer,
        width=bearing.outer_width,
        length=_length(bearing.outer_width, bearing.outer_chamfer),
        ring=ring_limits(bearing.type, "outer", bearing.bearing_class, bearing.outer),
        ring_load=bearing.outer_ring_load,
        radial_load=bearing.radial_load,
        factor=SERIES_FACTORS[bearing.series],
        losses=tuple(_smoothing(bearing.housing_roughness)),
        pressure_rate=pressure,
        stress_rate=pressure * ring.hoop_under_pressure_outside,
        raceway_rate=raceway_change(pressure, bearing.outer, ring),
    )


def _smoothing(roughness: float | None) -> list[Loss]:
    return [] if roughness is None else [Loss("smoothing", smoothing_loss(roughness), "0.4·Rz (DIN 7190-1:2017)")]


def _length(width: float, chamfer: float | None) -> float | None:
    return None if chamfer is None else width - 2 * chamfer
