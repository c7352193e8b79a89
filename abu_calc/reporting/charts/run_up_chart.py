"""Chart of the displacement against speed in a run-up, with balls and without."""

from collections.abc import Sequence

from abu_calc.reporting.charts.chart import Axis, Curve, Plot

Points = Sequence[tuple[float, float]]


def run_up_chart(balls: Points, without: Points, bare: str = "without autobalancers") -> Plot:
    """Displacements [µm] against speed [rpm]; `bare`: name of the curve without balls."""
    lines = [Curve(without, bare)] if without else []
    lines += [Curve(balls, "with balls", 2)] if balls else []
    across = Axis.around("speed [rpm]", (speed for speed, _ in (without or balls)))
    up = Axis.around("displacement, 0–peak [µm]", [0.0, *(value for _, value in (*without, *balls))])
    return Plot("Run-up", _text(balls, without, bare), across, up, lines)


def _text(balls: Points, without: Points, bare: str) -> str:
    named = [(curve, name) for curve, name in ((without, bare), (balls, "with balls")) if curve]
    highest = ", ".join(f"{max(value for _, value in curve):.0f} µm {name}" for curve, name in named)
    at_end = " and ".join(f"{curve[-1][1]:.1f}" for curve, _ in named)
    return f"Largest displacement in the run-up: {highest}; at the end {at_end} µm."
