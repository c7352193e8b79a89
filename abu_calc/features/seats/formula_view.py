"""Formulas of both seats with the numbers of a bearing put in."""

from collections.abc import Sequence

from abu_calc.features.seats.joint import CENTRIFUGAL, WARMTH
from abu_calc.features.seats.records import Clearance, SeatResult
from abu_calc.features.seats.study import BearingModel, SeatModel
from abu_calc.foundation.units import from_si


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
    (ei, es), (EI, ES) = map(_both, (model.male_limits_um, model.female_limits_um))
    mean, sigma = _g(model.mean_interference_um), _g(model.sigma_um)
    spread = "√({}² + {}²)".format(*_both(model.half_tolerances_um))
    return (
        f"ei − ES … es − EI = {ei} − ({ES}) … {es} − ({EI}) = {_span(seat.interference_um)} µm",
        f"probable: {mean} ∓ {spread} = {_span(seat.probable_interference_um)} µm, outward",
        f"P(clearance) = Φ(−mean/σ) = Φ(−({mean})/{sigma}) = {_g(seat.clearance_probability)}, "
        f"σ = {spread}/3; truncated {_g(seat.clearance_probability_truncated)}",
    )


def _load(model: SeatModel, seat: SeatResult) -> tuple[str, ...]:
    intensity = None if seat.needs_no_grip else seat.load_intensity_kN_per_m
    load, length = model.load_in_kilonewtons, model.length_mm
    if model.radial_load_N is None or load is None or length is None or model.length_m is None or intensity is None:
        return ()
    source, catalogue = (_g(loss.amount_um) for loss in seat.losses if loss.name == "load")
    under = f"{_g(model.diameter_mm)}·{_g(model.radial_load_N)}/{_g(model.width_mm)}"
    return (
        f"13·F_r·k_B/b_s = 13·{_g(load)}·{_g(model.load_factor)}/{_g(length)} = {source} µm",
        f"0.08·√(d·F_r/B) = 0.08·√({under}) = {catalogue} µm",
        f"P_R = k₁·F_r/b_s = {model.shock_factor:g}·{_g(load)}/{_g(model.length_m)} = {_g(intensity)} kN/m",
    )


def _losses(bearing: BearingModel, model: SeatModel, seat: SeatResult) -> tuple[str, ...]:
    bore = _g(bearing.bore_mm)
    numbers = {
        "smoothing": f"0.4·{_g(model.roughness_um)} µm",
        WARMTH: f"{_g(model.diameter_mm)} mm·({_warm(model)})",
        CENTRIFUGAL: f"Ω = {_g(from_si(bearing.speed_rad_per_s or 0.0, 'rpm'))} rpm, d = {bore}, d₁ = "
        f"{_g(bearing.inner_ring_diameter_mm)}, d₀ = {_g(bearing.shaft_bore_mm)} mm",
    }
    lines = tuple(
        f"{loss.name}: {loss.formula}: {numbers[loss.name]} = {_g(loss.amount_um)} µm"
        for loss in seat.losses
        if loss.name in numbers and "unverified" not in loss.formula
    )
    if seat.needed_um is None:
        return lines
    return (*lines, f"required with the losses: {_g(seat.needed_um)} µm")


def _warm(model: SeatModel) -> str:
    around = f"{_g(model.around_expansion_per_K or 0.0)}·{_g(model.around_rise_K or 0.0)}"
    return f"{around} − {_g(model.inside_expansion_per_K or 0.0)}·{_g(model.inside_rise_K or 0.0)}"


def _stress(model: SeatModel, seat: SeatResult) -> str:
    return (
        f"Lamé at {_g(seat.tightest_um)} µm: p = {_g(model.tightest_pressure_in_megapascals)} "
        f"MPa, hoop stress of the ring {_g(seat.hoop_stress_MPa)} MPa; permitted "
        f"{_g(seat.permitted_interference_um)} µm by {seat.permitted_by}"
    )


def _moment(bearing: BearingModel, model: SeatModel, seat: SeatResult) -> tuple[str, ...]:
    moments, diameter = seat.creep.friction_moment_N_m, _g(model.diameter_m)
    if model.length_m is None or moments is None:
        return ()
    return (
        f"μ_s·p·π·d·b_s·d/2 = {_g(bearing.seat_friction)}·{_g(model.starting_pressure_Pa)}·π·{diameter}·"
        f"{_g(model.length_m)}·{diameter}/2 = {_g(moments[0])} N·m",
    )


def _clearance(bearing: BearingModel, left: Clearance | None) -> tuple[str, ...]:
    if left is None:
        return ()
    rates = f"{_g(bearing.shaft.raceway_rate)} and {_g(bearing.housing.raceway_rate)}"
    return (
        f"clearance of group {left.group}: {_span(left.initial_um)} µm less {rates} of the interferences and "
        f"{_g(left.by_temperature_um)} µm of temperature = {_span(left.mounted_um)} µm, mean {_g(left.mean_um)}",
    )


def _span(interval: tuple[float, float]) -> str:
    return " … ".join(map(_g, interval))


def _both(pair: tuple[float, float]) -> tuple[str, str]:
    return _g(pair[0]), _g(pair[1])


def _g(value: float) -> str:
    return f"{value:.4g}"
