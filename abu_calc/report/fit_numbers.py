"""The formulas of both seats with the numbers of a bearing put in."""

from collections.abc import Sequence

from abu_calc.fits.joint import CENTRIFUGAL
from abu_calc.studies.seat_model import BearingModel, SeatModel
from abu_calc.studies.seat_records import Clearance, SeatResult, um
from abu_calc.units import from_si


def seat_numbers(models: Sequence[BearingModel], seats: Sequence[SeatResult]) -> tuple[str, ...]:
    """A line a formula, bearing after bearing, the shaft's before the housing's, which alternate in `seats`."""
    lines: list[str] = []
    for bearing, shaft, housing in zip(models, seats[::2], seats[1::2], strict=True):
        lines.append(f"{shaft.name}:")
        for seat, model in ((shaft, bearing.shaft), (housing, bearing.housing)):
            lines += [f"{seat.seat}: {line}" for line in _seat(bearing, model, seat)]
        lines += _clearance(bearing, shaft.internal_clearance)
    return tuple(lines)


def _seat(bearing: BearingModel, model: SeatModel, seat: SeatResult) -> tuple[str, ...]:
    """Lines of one seat; those the file has no data for are left out."""
    return (
        *_fit(model, seat),
        *_load(model, seat),
        *_losses(bearing, model, seat),
        _stress(model, seat),
        *_moment(bearing, model, seat),
    )


def _fit(model: SeatModel, seat: SeatResult) -> tuple[str, ...]:
    (ei, es), (EI, ES) = map(_um_pair, (model.male_limits_m, model.female_limits_m))
    mean, sigma = _g(um(model.mean_interference_m)), _g(um(model.sigma_m))
    spread = "√({}² + {}²)".format(*_um_pair(model.half_tolerances_m))
    return (
        f"ei − ES … es − EI = {ei} − ({ES}) … {es} − ({EI}) = {_span(seat.interference_um)} µm",
        f"probable: {mean} ∓ {spread} = {_span(seat.probable_interference_um)} µm, outward",
        f"P(clearance) = Φ(−mean/σ) = Φ(−({mean})/{sigma}) = {_g(seat.clearance_probability)}, "
        f"σ = {spread}/3; truncated {_g(seat.clearance_probability_truncated)}",
    )


def _load(model: SeatModel, seat: SeatResult) -> tuple[str, ...]:
    intensity = seat.load_intensity_kN_per_m
    if model.radial_load_N is None or model.length_m is None or intensity is None:
        return ()
    kilonewtons = _g(from_si(model.radial_load_N, "kN"))
    source, catalogue = (_g(loss.amount_um) for loss in seat.losses if loss.name == "load")
    under = f"{_mm(model.diameter_m)}·{_g(model.radial_load_N)}/{_mm(model.width_m)}"
    return (
        f"13·R·k/b = 13·{kilonewtons}·{_g(model.load_factor)}/{_mm(model.length_m)} = {source} µm",
        f"0.08·√(d·F_r/B) = 0.08·√({under}) = {catalogue} µm",
        f"P_R = k₁·R/b = {model.shock_factor:g}·{kilonewtons}/{_g(model.length_m)} = {_g(intensity)} kN/m",
    )


def _losses(bearing: BearingModel, model: SeatModel, seat: SeatResult) -> tuple[str, ...]:
    bore = _mm(bearing.bore_m)
    numbers = {
        "smoothing": f"0.4·{_g(um(model.roughness_m or 0.0))} µm",
        "temperature": f"{_g(bearing.expansion_per_K)}·{bore} mm·{_g(bearing.ring_temperature_difference_K or 0.0)} K",
        CENTRIFUGAL: f"Ω = {_g(bearing.speed_rad_per_s or 0.0)} rad/s, d = {bore}, d₁ = "
        f"{_mm(bearing.inner_ring_diameter_m)}, d₀ = {_mm(bearing.shaft_bore_m)} mm",
    }
    lines = tuple(
        f"{loss.name}: {loss.formula}: {numbers[loss.name]} = {_g(loss.amount_um)} µm"
        for loss in seat.losses
        if loss.counted and loss.name in numbers
    )
    if seat.required_interference_um is None:
        return lines
    return (*lines, f"required with the losses: {_g(seat.required_interference_um)} µm")


def _stress(model: SeatModel, seat: SeatResult) -> str:
    return (
        f"Lamé at {_g(max(seat.interference_um[1], 0.0))} µm: p = {_g(from_si(model.tightest_pressure_Pa, 'MPa'))} "
        f"MPa, hoop stress of the ring {_g(seat.hoop_stress_MPa)} MPa; permitted "
        f"{_g(seat.permitted_interference_um)} µm by {seat.permitted_by}"
    )


def _moment(bearing: BearingModel, model: SeatModel, seat: SeatResult) -> tuple[str, ...]:
    moments, diameter = seat.creep.friction_moment_N_m, _g(model.diameter_m)
    if model.length_m is None or moments is None:
        return ()
    return (
        f"μ·p·π·d·b·d/2 = {_g(bearing.seat_friction)}·{_g(model.starting_pressure_Pa)}·π·{diameter}·"
        f"{_g(model.length_m)}·{diameter}/2 = {_g(moments[0])} N·m",
    )


def _clearance(bearing: BearingModel, left: Clearance | None) -> tuple[str, ...]:
    if left is None:
        return ()
    rates = f"{_g(bearing.shaft.raceway_rate)} and {_g(bearing.housing.raceway_rate)}"
    return (
        f"clearance of group {left.group}: {_span(left.initial_um)} µm less {rates} of the interferences and "
        f"{_g(left.by_temperature_um)} µm of temperature = {_span(left.mounted_um)} µm",
    )


def _span(interval: tuple[float, float]) -> str:
    return " … ".join(map(_g, interval))


def _um_pair(pair: tuple[float, float]) -> tuple[str, str]:
    return _g(um(pair[0])), _g(um(pair[1]))


def _mm(length: float) -> str:
    return _g(from_si(length, "mm"))


def _g(value: float) -> str:
    return f"{value:.4g}"
