"""The oil's part of a design: drag rate cold, at work and hot, its band, and what other oils would give."""

from collections.abc import Iterator
from typing import Annotated, Final, Self

from abu_calc.formulas.oil import GRADES, SLIPS, OilState
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.inputs.oil import oil_name
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.sizing.design import Design
from abu_calc.sizing.oil import FACTOR, drag_source


@record
class OilAtTemperature(Record):
    """The oil at one temperature, and the drag rate of a ball in it."""

    state: Annotated[str, Quantity("state of the oil")]
    temperature_C: Annotated[float, Quantity("temperature", "T_o", 3, "°C")]
    viscosity_mm2_per_s: Annotated[float, Quantity("kinematic viscosity", "ν_o", 3)]
    rolling_drag_per_s: Annotated[float, Quantity("viscous drag rate at the slip of the file", "h₀", 3)]
    low_per_s: Annotated[float, Quantity("low end of its band", "", 3)]
    high_per_s: Annotated[float, Quantity("high end of its band", "", 3)]
    by_slip_per_s: Annotated[tuple[float, ...], Quantity("drag rate at 0.02, 0.5 and 5 m/s", "", 3)]

    @classmethod
    def of(cls, name: str, oil: OilState) -> Self:
        """Record of a state."""
        return cls(
            state=name, temperature_C=oil.temperature, viscosity_mm2_per_s=oil.viscosity, rolling_drag_per_s=oil.drag,
            low_per_s=oil.drag / FACTOR, high_per_s=oil.drag * FACTOR, by_slip_per_s=oil.by_slip,
        )  # fmt: skip


@record
class OilFill(Record):
    """Drag rates with another fill, in oils of ISO VG 10, 22, 46, 100, 220 and 460, at the temperature of work."""

    fill_ml: Annotated[float, Quantity("fill", "V_o", 3)]
    by_grade_per_s: Annotated[tuple[float, ...], Quantity("viscous drag rate", "h₀", 3)]


@record
class OilRecord(Record):
    """Oil of the file, and the drag rate that follows from it."""

    oil: Annotated[str, Quantity("oil")]
    fill_ml: Annotated[float, Quantity("fill", "V_o", 3)]
    depth: Annotated[float, Quantity("depth of the ring of oil", "δ_o", 3, unit="mm")]
    wetted_share: Annotated[float, Quantity("depth over the diameter of a ball", "", 2, percent=True)]
    slip_m_per_s: Annotated[float, Quantity("slip for which the rate is taken", "", 3)]
    uncertainty_factor: Annotated[float, Quantity("factor by which the rate is uncertain", "", 2)]
    overridden: Annotated[bool, Quantity("the file gives rolling_drag_per_s, which overrides the oil")]
    source: Annotated[str, Quantity("source of the drag rate")]
    temperatures: tuple[OilAtTemperature, ...]
    fills: tuple[OilFill, ...]

    @classmethod
    def of(cls, design: Design) -> Self | None:
        """Record of a design; None without [oil]."""
        drag, table = design.case.oil, design.case.table.oil
        if drag is None or table is None:
            return None
        states = (("cold", drag.cold), ("at work", drag.working), ("hot", drag.hot))
        return cls(
            oil=oil_name(table), fill_ml=table.fill_ml, depth=drag.depth,
            wetted_share=drag.wetted_share, slip_m_per_s=table.slip_m_per_s, uncertainty_factor=FACTOR,
            overridden=drag.overridden, source=drag_source(design.case),
            temperatures=tuple(OilAtTemperature.of(name, state) for name, state in states),
            fills=tuple(OilFill(fill_ml=fill * 1e6, by_grade_per_s=rates) for fill, rates in drag.by_fill),
        )  # fmt: skip


METHOD: Final = (
    "Viscosity follows the line of Ubbelohde and Walther through the values at 40 °C and 100 °C. Rotation lays the oil "
    "into an even ring. A ball in it has the drag that Jan and Chen (1997) measured on balls that roll along a wall. "
    "Its coefficients are quoted, not verified in the paper. How much of that drag is left in a shallow ring is "
    "reasoned: no source covers a partly wetted ball."
)


def oil_blocks(oil: OilRecord | None, optimum: float | None) -> Iterator[Block]:
    """The drag rate by the oil, and that of other grades; nothing without [oil]."""
    if oil is None:
        return
    yield Heading("Oil", "oil")
    yield Paragraph(oil.source)
    rows = tuple(
        (
            each.state,
            f"{each.temperature_C:g}",
            number(each.viscosity_mm2_per_s, 3),
            number(each.rolling_drag_per_s, 3),
            f"{number(each.low_per_s, 2)} … {number(each.high_per_s, 2)}",
            *(number(rate, 2) for rate in each.by_slip_per_s),
        )
        for each in oil.temperatures
    )
    slips = (f"{slip:g} m/s" for slip in SLIPS)
    yield Grid(("oil", "°C", "mm²/s", "drag, 1/s", "band", *slips), rows, frozenset(range(1, 8)))
    yield Paragraph(f"Drag rates by grade and fill at {oil.temperatures[1].temperature_C:g} °C, in 1/s:")
    fills = tuple(
        (f"{number(each.fill_ml, 2)} ml", *(number(rate, 2) for rate in each.by_grade_per_s)) for each in oil.fills
    )
    yield Grid(("fill", *(f"VG {grade}" for grade in GRADES)), fills, frozenset(range(1, len(GRADES) + 1)))
    if optimum is not None:
        yield Paragraph(f"Small disturbances die out fastest at {number(optimum, 3)} 1/s; friction asks for less.")
    yield Paragraph(METHOD)
