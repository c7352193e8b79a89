"""Formulas of both seats with the numbers of a bearing put in."""

import math
from collections.abc import Sequence

from abu_calc.features.seats.bearing import SeatedBearing
from abu_calc.features.seats.clearance import Clearance
from abu_calc.features.seats.interference import um, um_pair
from abu_calc.features.seats.joint import CENTRIFUGAL, TEMPERATURE, Joint, inner_ring_diameter
from abu_calc.features.seats.joints import warm_parts
from abu_calc.features.seats.notes import intensity_factors
from abu_calc.features.seats.rating_life import exponent
from abu_calc.features.seats.seats import BearingSeats, SeatResult
from abu_calc.foundation.units import from_si


def seat_numbers(bearings: Sequence[BearingSeats]) -> tuple[str, ...]:
    """A line a formula, bearing after bearing, the shaft's before the housing's."""
    lines: list[str] = []
    for bearing in bearings:
        lines.append(f"{bearing.shaft.name}:")
        for seat in bearing.seats:
            lines += [f"{seat.seat}: {line}" for line in _seat(bearing.bearing, seat.joint, seat)]
        lines += _clearance(bearing, bearing.clearance)
        lines += _life(bearing, bearing.shaft)
    return tuple(lines)


def _seat(bearing: SeatedBearing, joint: Joint, seat: SeatResult) -> tuple[str, ...]:
    """Lines of one seat; those the file has no data for are left out."""
    return (
        *_fit(joint, seat),
        *_load(bearing, joint, seat),
        *_losses(bearing, joint, seat),
        _stress(joint, seat),
        *_moment(bearing, joint, seat),
    )


def _fit(joint: Joint, seat: SeatResult) -> tuple[str, ...]:
    male, female = joint.male_and_female
    halves = male.tolerance / 2, female.tolerance / 2
    (ei, es), (EI, ES) = _both(um_pair(male)), _both(um_pair(female))
    mean, sigma = _g(um(male.middle - female.middle)), _g(um(math.hypot(*halves) / 3))
    spread = "√({}² + {}²)".format(*_both(um_pair(halves)))
    return (
        f"ei − ES … es − EI = {ei} − ({ES}) … {es} − ({EI}) = {_span(seat.interference_um)} µm",
        f"probable: {mean} ∓ {spread} = {_span(seat.probable_interference_um)} µm, outward",
        f"P(clearance) = Φ(−mean/σ) = Φ(−({mean})/{sigma}) = {_g(seat.clearance_probability)}, "
        f"σ = {spread}/3; truncated {_g(seat.clearance_probability_truncated)}",
    )


def _load(bearing: SeatedBearing, joint: Joint, seat: SeatResult) -> tuple[str, ...]:
    intensity = None if seat.needs_no_grip else seat.load_intensity_kN_per_m
    if joint.radial_load is None or joint.length is None or intensity is None:
        return ()
    load, length = _g(joint.radial_load, "kN"), _mm(joint.length)
    source, catalogue = (_g(loss.amount_um) for loss in seat.losses if loss.name == "load")
    factors = "·".join(map(_g, intensity_factors(bearing, joint)))
    under = f"{_mm(joint.diameter)}·{_g(joint.radial_load)}/{_mm(joint.ring.width)}"
    return (
        f"13·F_r·k_B/b_s = 13·{load}·{_g(joint.factor)}/{length} = {source} µm",
        f"0.08·√(d·F_r/B) = 0.08·√({under}) = {catalogue} µm",
        f"P_R = k₁·k₂·k₃·F_r/b_s = {factors}·{load}/{_g(joint.length)} = {_g(intensity)} kN/m",
    )


def _losses(bearing: SeatedBearing, joint: Joint, seat: SeatResult) -> tuple[str, ...]:
    part, bore = bearing.shaft if joint.seat == "shaft" else bearing.housing, bearing.inner.diameter
    numbers = {
        "smoothing": f"0.4·{_g(um(part.roughness or 0.0))} µm",
        TEMPERATURE: f"{_mm(joint.diameter)} mm·({_warm(bearing, joint)})",
        CENTRIFUGAL: f"Ω = {_g(bearing.service.speed or 0.0, 'rpm')} rpm, d = {_mm(bore)}, d₁ = "
        f"{_mm(inner_ring_diameter(bore, bearing.outer.diameter))}, d₀ = {_mm(bearing.shaft.other or 0.0)} mm",
    }
    lines = tuple(
        f"{loss.name}: {loss.formula}: {numbers[loss.name]} = {_g(loss.amount_um)} µm"
        for loss in seat.losses
        if loss.name in numbers and "unverified" not in loss.formula
    )
    if seat.needed_um is None or not joint.criteria:
        return lines
    larger = um(max(bound.value for bound in joint.criteria))
    kept = f"/{_g(joint.pressure_kept)}" if joint.pressure_kept < 1 else ""
    losses = f" + {_g(um(joint.counted_losses))}" if joint.counted_losses else ""
    return (*lines, f"required: {_g(larger)}{kept}{losses} = {_g(seat.needed_um)} µm, losses included")


def _warm(bearing: SeatedBearing, joint: Joint) -> str:
    parts = warm_parts(bearing, joint.seat) or ((0.0, 0.0), (0.0, 0.0))
    return " − ".join(f"{_g(expansion)}·{_g(rise)}" for expansion, rise in parts)


def _stress(joint: Joint, seat: SeatResult) -> str:
    pressure = _g(joint.pressure_rate * max(joint.tightest, 0.0), "MPa")
    return (
        f"Lamé at {_g(seat.tightest_um)} µm: p = {pressure} "
        f"MPa, hoop stress of the ring {_g(seat.hoop_stress_MPa)} MPa; permitted "
        f"{_g(seat.permitted_interference_um)} µm by {seat.permitted_by}"
    )


def _moment(bearing: SeatedBearing, joint: Joint, seat: SeatResult) -> tuple[str, ...]:
    """Friction moment at the least interference, less the losses before the shaft turns."""
    moments, diameter = seat.creep.friction_moment_N_m, _g(joint.diameter)
    if joint.length is None or moments is None:
        return ()
    pressure = joint.pressure_rate * max(joint.interference.smallest - joint.lasting_losses, 0.0)
    return (
        f"μ_s·p·π·d·b_s·d/2 = {_g(bearing.service.seat_friction)}·{_g(pressure)}·π·{diameter}·"
        f"{_g(joint.length)}·{diameter}/2 = {_g(moments[0])} N·m",
    )


def _clearance(bearing: BearingSeats, left: Clearance | None) -> tuple[str, ...]:
    if left is None:
        return ()
    rates = f"{_g(bearing.shaft.joint.raceway_rate)} and {_g(bearing.housing.joint.raceway_rate)}"
    return (
        f"clearance of group {left.group}: {_span(left.initial_um)} µm less {rates} of the interferences and "
        f"{_g(left.by_temperature_um)} µm of temperature = {_span(left.mounted_um)} µm, mean {_g(left.mean_um)}",
    )


def _life(bearing: BearingSeats, seat: SeatResult) -> tuple[str, ...]:
    """Lines of the bearing itself, as far as its data go."""
    life, service = bearing.life, bearing.bearing.service
    if life.static_safety is None or seat.static_load_kN is None or seat.equivalent_load_kN is None:
        return ()
    C, P = seat.dynamic_load_rating_kN or 0.0, seat.equivalent_load_kN
    lines = [f"C0/P0 = {_g(seat.static_load_rating_kN or 0.0)}/{_g(seat.static_load_kN)} = {_g(life.static_safety)}"]
    if seat.basic_rating_life_h is not None and service.speed and bearing.bearing.kind is not None:
        turns, power = _g(service.speed, "rpm"), _g(exponent(bearing.bearing.kind))
        lines.append(f"10⁶/(60·{turns})·({_g(C)}/{_g(P)})^{power} = {_g(seat.basic_rating_life_h)} h")
    modified, viscosity = seat.modified_rating_life_h, service.lubricant_viscosity
    if life.kappa is not None and life.a_iso is not None and viscosity is not None and modified is not None:
        needed = _g(viscosity / life.kappa, "mm2_per_s")
        ratio = f"{_g(viscosity, 'mm2_per_s')}/{needed} = {_g(life.kappa)}"
        lines.append(f"κ_v = {ratio}, a_ISO = {_g(life.a_iso)}, modified life {_g(modified)} h")
    return tuple(lines)


def _mm(length: float) -> str:
    return _g(length, "mm")


def _span(interval: tuple[float, float]) -> str:
    return " … ".join(map(_g, interval))


def _both(pair: tuple[float, float]) -> tuple[str, str]:
    return _g(pair[0]), _g(pair[1])


def _g(value: float, unit: str = "") -> str:
    """A number; with a unit, of an SI value."""
    return f"{from_si(value, unit) if unit else value:.4g}"
