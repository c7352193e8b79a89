"""Figures of a machine with two races: section of both, displacement against speed in closed form and in a run-up."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from abu_calc.features.design.records import AutobalancerRecord, Section
from abu_calc.features.design.section_drawing import alone, described, section_view
from abu_calc.features.design.solids import design_items
from abu_calc.features.spindle.records import SpindleSizeResult
from abu_calc.foundation.frozen import dataclass
from abu_calc.reporting.charts.chart import Axis, Curve, Plot
from abu_calc.reporting.charts.figure import Extras, Figure
from abu_calc.reporting.charts.run_up_chart import run_up_chart
from abu_calc.reporting.drawings.dimensions import extent, moved
from abu_calc.reporting.drawings.shapes import SCALES, Drawing, Shape, Text, digits, plain
from abu_calc.reporting.solids.assembly import PlacedSolid, SolidAssembly

SECTION = "vibration"


def spindle_extras(result: SpindleSizeResult) -> Extras:
    """Figures of the page."""
    return Extras((*_section(result), *_over_speed(result), *_run_up(result)))


def _section(result: SpindleSizeResult) -> Iterator[Figure]:
    drawing = both_sections(result)
    drawn = f"{drawing.scale:g}:1" if drawing.scale >= 1 else f"1:{1 / drawing.scale:g}"
    yield Figure("section", "make", drawing, f"Sections through the axis, drawn to scale {drawn}, sizes in mm.")


def _run_up(result: SpindleSizeResult) -> Iterator[Figure]:
    """Amplitude against speed of the simulated run-up."""
    points = result.run_up
    if not points:
        return
    without = [(point.speed_rpm, point.without_um) for point in points]
    balls = [(point.speed_rpm, point.with_um) for point in points if point.with_um is not None]
    caption = (
        "Simulated run-up: largest displacement of any place in each revolution against speed, imbalances of unknown "
        "phase in phase, balls together at the start. Balls do not help below the critical speeds. At full speed they "
        "settle: the curve falls there."
    )
    yield Figure("run-up", SECTION, run_up_chart(balls, without), caption)


def _over_speed(result: SpindleSizeResult) -> Iterator[Figure]:
    response = result.response
    without = [(point.speed_rpm, point.without_um) for point in response]
    balanced = [(point.speed_rpm, point.balanced_um) for point in response if point.balanced_um is not None]
    lines = [Curve(without, "without autobalancers")]
    lines += [Curve(balanced, "balanced, closed form", 2)] if balanced else []
    across = Axis.around("speed [rpm]", (speed for speed, _ in without))
    up = Axis.around("displacement, 0–peak [µm]", [0.0, *(value for _, value in (*without, *balanced))])
    speeds = ", ".join(f"{speed:.0f}" for speed in result.frequency.critical_speeds_rpm)
    text = f"Largest displacement of a place against speed; critical speeds {speeds} rpm."
    caption = (
        "Largest displacement of any place against speed, at the worst phase of the imbalances. Balls in two races "
        "balance above both critical speeds only; race eccentricity is what is left there."
    )
    yield Figure("speeds", SECTION, Plot("Displacement against speed", text, across, up, lines), caption)


if TYPE_CHECKING:
    from abu_calc.features.design.study import SizeResult

ROOM: Final = 110.0
"""Outer diameter of the larger autobalancer on paper, at most [mm]."""
GAP: Final = 12.0
"""Distance from one view to the other, on paper [mm]."""


@dataclass(frozen=True)
class OneOfTwo:
    """What the section of a single autobalancer is drawn from."""

    title: str
    autobalancer: AutobalancerRecord
    section: Section


def races_of(result: SpindleSizeResult) -> "tuple[SizeResult, ...]":
    """Each autobalancer as the section view of one takes it."""
    pairs: Any = zip(result.autobalancers, result.sections, strict=True)
    each: Any = tuple(OneOfTwo(result.title, race, section) for race, section in pairs)
    return each  # type: ignore[no-any-return]


def both_sections(result: SpindleSizeResult, room: float = ROOM) -> Drawing:
    """Both sections, the first race left; one scale for both."""
    outer = max(race.outer_diameter_mm for race in result.autobalancers)
    scale = next((ratio for ratio in SCALES if ratio * outer <= room), SCALES[-1])
    shapes: list[Shape] = []
    for index, race in enumerate(races_of(result)):
        place = f"race {index + 1}, z = {digits(result.autobalancers[index].plane_mm, 2)}"
        view = tuple(_titled(section_view(race, scale), place))
        right = 0.0 if not shapes else extent(shapes, scale)[1][0] + GAP / scale - extent(view, scale)[0][0]
        shapes += [moved(shape, (right, 0.0)) for shape in view]
    words = " ".join(f"Race {number}: {described(race)}" for number, race in enumerate(races_of(result), 1))
    return alone("section", f"Section of both autobalancers, {result.title}", words, shapes, scale)


def both_solids(result: SpindleSizeResult) -> SolidAssembly:
    """Both autobalancers on one axis, the middle of each at its plane along the spindle."""
    items = tuple(
        PlacedSolid(
            f"race {number} {item.name}",
            replace(item.solid, name=f"race {number} {item.solid.name}"),
            (*item.shift[:2], item.shift[2] + own.plane_mm - own.width_mm / 2),
        )
        for number, (own, race) in enumerate(zip(result.autobalancers, races_of(result), strict=True), 1)
        for item in design_items(race)
    )
    return SolidAssembly("autobalancers", f"Both autobalancers of {plain(result.title)}, lengths in mm", items)


def _titled(view: Sequence[Shape], title: str) -> Iterator[Shape]:
    """The view with a title for the name of its cutting plane."""
    for shape in view:
        yield replace(shape, text=title) if isinstance(shape, Text) and shape.text == "A–A" else shape
