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
    highest = max((value for _, value in balls), default=0.0)
    if not without:
        return f"Largest displacement in the run-up: {highest:.0f} µm with balls; at the end {balls[-1][1]:.1f} µm."
    return (
        f"Largest displacement in the run-up: {max(value for _, value in without):.0f} µm {bare}, "
        f"{highest:.0f} µm with balls; at the end {without[-1][1]:.1f} and {balls[-1][1] if balls else 0.0:.1f} µm."
    )
