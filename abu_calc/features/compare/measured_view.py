"""The report of recorded starts beside predicted ones."""

from abu_calc.features.compare.measured import CourseNumbers, MeasuredCompareResult
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.chart import Axis, Curve, Plot
from abu_calc.reporting.charts.figure import Extras, Figure
from abu_calc.reporting.parts import notices, provenance_blocks

CAPTION = (
    "Distance of the axis from where it comes to rest, in the frame of the rotor: recorded starts, and the median of "
    "starts simulated with the values of the file. Starts differ by where the balls lie."
)


def measured_blocks(result: MeasuredCompareResult) -> tuple[Block, ...]:
    """Numbers of every recorded start, and the band of the predicted ones."""
    measured = tuple((course.file, *_cells(course.numbers)) for course in result.measured)
    predicted = tuple(
        (f"{course.title}, {name}", *_cells(numbers))
        for course in result.predicted
        for name, numbers in (("5 %", course.low), ("median", course.median), ("95 %", course.high))
    )
    header = ("start", "settling, s", "residual, µm", "level, dB")
    mark = "" if result.mark else " Without a mark distances are those of magnitudes."
    return (
        Heading(f"{result.title}: recorded starts beside predicted ones"),
        Heading("Measured", "measured"),
        Grid(header, measured, frozenset({1, 2, 3})),
        Heading("Predicted with the values of the file", "predicted"),
        Grid(header, predicted, frozenset({1, 2, 3})),
        Paragraph(
            "The settling time counts from full speed until the axis stays within a tenth of the amplitude without "
            f"balls from its end. Residual and level are those of the rotation at the end.{mark}"
        ),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def _cells(numbers: CourseNumbers) -> tuple[str, str, str]:
    time = numbers.settling_time_s
    return "never" if time is None else number(time, 3), number(numbers.residual_um, 3), f"{numbers.level_db:.1f}"


def measured_extras(result: MeasuredCompareResult) -> Extras:
    """The figure of all courses."""
    times = result.times_s
    curves = [
        Curve(tuple(zip(times, course.distance_um, strict=True)), "" if k else "measured")
        for k, course in enumerate(result.measured)
    ]
    curves += [
        Curve(tuple(zip(times, course.distance_um, strict=True)), f"{course.title}, predicted median", 2 + k)
        for k, course in enumerate(result.predicted)
    ]
    across = Axis("time from the switching-on [s]", 0.0, times[-1])
    up = Axis.around("distance from the end [µm]", [0.0, *(y for curve in curves for _, y in curve.points)])
    summary = f"Distance of the axis from its end in {len(result.measured)} recorded starts, and as predicted"
    plot = Plot("Measured and predicted starts", summary, across, up, curves)
    return Extras((Figure("courses", "measured", plot, CAPTION),))
