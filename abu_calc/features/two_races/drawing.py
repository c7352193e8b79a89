"""Section through the axis of both autobalancers, side by side in one scale, from the one of a single race."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from abu_calc.features.design.records import AutobalancerRecord, Section
from abu_calc.features.design.section_drawing import described, section_view
from abu_calc.features.design.solids import design_items
from abu_calc.features.two_races.records import TwoRaceSizeResult
from abu_calc.foundation.frozen import dataclass
from abu_calc.reporting.drawings.dimensions import extent, moved
from abu_calc.reporting.drawings.shapes import SCALES, Drawing, Shape, Text, digits, plain
from abu_calc.reporting.solids.assembly import PlacedSolid, SolidAssembly

if TYPE_CHECKING:
    from abu_calc.features.design.study import SizeResult

ROOM: Final = 110.0
"""Outer diameter of the larger autobalancer on paper, at most [mm]."""
GAP: Final = 12.0
"""Distance from one view to the other, on paper [mm]."""
MARGIN: Final = 3.0


@dataclass(frozen=True)
class OneOfTwo:
    """What the section of a single autobalancer is drawn from."""

    title: str
    autobalancer: AutobalancerRecord
    section: Section


def races_of(result: TwoRaceSizeResult) -> "tuple[SizeResult, ...]":
    """Each autobalancer as the section view of one takes it."""
    pairs: Any = zip(result.autobalancers, result.sections, strict=True)
    each: Any = tuple(OneOfTwo(result.title, race, section) for race, section in pairs)
    return each  # type: ignore[no-any-return]


def both_sections(result: TwoRaceSizeResult, room: float = ROOM) -> Drawing:
    """Both sections, the first race left; one scale for both."""
    outer = max(race.outer_diameter_mm for race in result.autobalancers)
    scale = next((ratio for ratio in SCALES if ratio * outer <= room), SCALES[-1])
    shapes: list[Shape] = []
    for index, race in enumerate(races_of(result)):
        place = f"race {index + 1}, z = {digits(result.autobalancers[index].plane_mm, 2)}"
        view = tuple(_titled(section_view(race, scale), place))
        right = 0.0 if not shapes else extent(shapes, scale)[1][0] + GAP / scale - extent(view, scale)[0][0]
        shapes += [moved(shape, (right, 0.0)) for shape in view]
    low, high = extent(shapes, scale)
    margin = MARGIN / scale
    words = " ".join(f"Race {number}: {described(race)}" for number, race in enumerate(races_of(result), 1))
    return Drawing(
        "section", f"Section of both autobalancers, {result.title}", words, scale,
        (low[0] - margin, low[1] - margin), (high[0] + margin, high[1] + margin), tuple(shapes),
    )  # fmt: skip


def both_solids(result: TwoRaceSizeResult) -> SolidAssembly:
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
