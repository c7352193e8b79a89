"""The formulas of both seats with the numbers of a bearing put in."""

from abu_calc.fits.advice import SHOCK_FACTOR
from abu_calc.fits.bearing import Bearing
from abu_calc.fits.joint import CENTRIFUGAL
from abu_calc.fits.seats import BearingSeats, SeatFit
from abu_calc.fits.stress import inner_ring_diameter
from abu_calc.report.fits import um
from abu_calc.standards.balls import seat_material
from abu_calc.units import from_si


def seat_numbers(found: BearingSeats) -> tuple[str, ...]:
    """A line a formula, the shaft's before the housing's; those the file has no data for are left out."""
    lines = [f"{found.bearing.name}:"]
    for seat in found.seats:
        lines += [
            f"{seat.seat}: {line}" for line in (*_fit(seat), *_load(found.bearing, seat), *_losses(found.bearing, seat))
        ]
        lines += [f"{seat.seat}: {line}" for line in (*_stress(seat), *_torque(found.bearing, seat))]
    return (*lines, *_clearance(found))


def _fit(seat: SeatFit) -> tuple[str, ...]:
    male, female = seat.joint.male_and_female
    mean, halves = um(male.middle - female.middle), (um(male.tolerance) / 2, um(female.tolerance) / 2)
    sigma = (halves[0] ** 2 + halves[1] ** 2) ** 0.5 / 3
    spread = f"√({_g(halves[0])}² + {_g(halves[1])}²)"
    extreme, probable = seat.interference, seat.probable_interference
    return (
        f"ei − ES … es − EI = {_g(um(male.lower))} − ({_g(um(female.upper))}) … {_g(um(male.upper))} − "
        f"({_g(um(female.lower))}) = {_g(um(extreme.smallest))} … {_g(um(extreme.largest))} µm",
        f"probable: {_g(mean)} ∓ {spread} = {_g(um(probable.smallest))} … {_g(um(probable.largest))} µm, outward",
        f"P(clearance) = Φ(−mean/σ) = Φ(−({_g(mean)})/{_g(sigma)}) = {_g(seat.clearance_probability)}, "
        f"σ = {spread}/3; truncated {_g(seat.truncated_probability)}",
    )


def _load(bearing: Bearing, seat: SeatFit) -> tuple[str, ...]:
    joint = seat.joint
    if joint.radial_load is None or joint.length is None or seat.load_intensity is None:
        return ()
    kilonewtons, length = _g(from_si(joint.radial_load, "kN")), _mm(joint.length)
    source, catalogue = (_g(um(bound.value)) for bound in joint.criteria)
    under = f"{_mm(joint.diameter)}·{_g(joint.radial_load)}/{_mm(joint.ring.width)}"
    return (
        f"13·R·k/b = 13·{kilonewtons}·{_g(joint.factor)}/{length} = {source} µm",
        f"0.08·√(d·F_r/B) = 0.08·√({under}) = {catalogue} µm",
        f"P_R = k₁·R/b = {SHOCK_FACTOR:g}·{kilonewtons}/{_g(joint.length)} = "
        f"{_g(from_si(seat.load_intensity, 'kN_per_m'))} kN/m",
    )


def _losses(bearing: Bearing, seat: SeatFit) -> tuple[str, ...]:
    steel = seat_material("steel")
    rough = bearing.shaft.roughness if seat.seat == "shaft" else bearing.housing.roughness
    service, bore, outer = bearing.service, bearing.inner.diameter, bearing.outer.diameter
    numbers = {
        "smoothing": f"0.4·{_g(um(rough or 0.0))} µm",
        "temperature": f"{_g(steel.expansion)}·{_mm(bore)} mm·{_g(service.ring_over_shaft or 0.0)} K",
        CENTRIFUGAL: f"Ω = {_g(service.speed or 0.0)} rad/s, d = {_mm(bore)}, d₁ = "
        f"{_mm(inner_ring_diameter(bore, outer))}, d₀ = {_mm(bearing.shaft.bore)} mm",
    }
    told = tuple(f"{loss.name}: {loss.formula}: {numbers[loss.name]} = {_g(um(loss.value))} µm" for loss in seat.losses)
    if seat.required_interference is None:
        return told
    return (*told, f"required with the losses: {_g(um(seat.required_interference))} µm")


def _stress(seat: SeatFit) -> tuple[str, ...]:
    largest, rate = max(seat.interference.largest, 0.0), seat.joint.pressure_rate
    return (
        f"Lamé at {_g(um(largest))} µm: p = {_g(from_si(rate * largest, 'MPa'))} MPa, hoop stress of the ring "
        f"{_g(from_si(seat.hoop_stress, 'MPa'))} MPa; permitted {_g(um(seat.permitted_interference))} µm by "
        f"{seat.permitted_by}",
    )


def _torque(bearing: Bearing, seat: SeatFit) -> tuple[str, ...]:
    joint, torque = seat.joint, seat.creep.least_torque
    if joint.length is None or torque is None:
        return ()
    pressure = joint.pressure_rate * max(seat.interference.smallest - joint.lasting_losses, 0.0)
    friction, diameter = _g(bearing.service.seat_friction), _g(joint.diameter)
    return (
        f"μ·p·π·d·b·d/2 = {friction}·{_g(pressure)}·π·{diameter}·{_g(joint.length)}·{diameter}/2 = {_g(torque)} N·m",
    )


def _clearance(found: BearingSeats) -> tuple[str, ...]:
    left = found.clearance
    if left is None:
        return ()
    rates = " and ".join(_g(seat.joint.raceway_rate) for seat in found.seats)
    return (
        f"clearance of group {left.group}: {_g(um(left.initial.smallest))} … {_g(um(left.initial.largest))} µm less "
        f"{rates} of the interferences and {_g(um(left.warmth))} µm of temperature = {_g(um(left.mounted.smallest))} … "
        f"{_g(um(left.mounted.largest))} µm",
    )


def _mm(length: float) -> str:
    return _g(from_si(length, "mm"))


def _g(value: float) -> str:
    return f"{value:.4g}"
