"""Scatter in every case: start-up of a machine; and scatter by the drawing's tolerances and in use."""

from collections.abc import Iterator
from typing import Final

from abu_calc.errors import Place
from abu_calc.scenes.switched_on import KINDS
from abu_calc.sizing.design import Design
from abu_calc.spec.machine import MachineFile
from abu_calc.spec.variation import Variation, variation
from abu_calc.units import from_si

DRAG, WARMTH = "autobalancer.rolling_drag_per_s", "start.temperature_C"
WARM: Final = 0.55
"""ln 3 / 2: drags of a third and of three times the one given, oil hot and cold, are two standard deviations off."""

GAUGE, BOTTOM = 0.010, 0.05
"""Half the spread [mm] of diameters in which balls are stocked (assumed), and of the race radius on the drawing."""
ROUGH, WORN, HELD = 0.5, 0.2, 0.2
"""Standard deviation of the logarithm (assumed): of the lever arm, which is 0.5 to 5 µm on hard races; of the imbalance
from wheel to wheel; of the frequencies of hands."""


def of_starts(tables: MachineFile, varied: frozenset[str]) -> Iterator[tuple[str, Variation]]:
    """Start, drag and the side to which the race stands off, unless these vary as asked."""
    abu = tables.autobalancer
    ways = {
        "start.kind": f"choice({','.join(KINDS)})",
        "start.angle_deg": "uniform(-180, 180)",
        "start.eccentricity_deg": "uniform(-180, 180)",
    }
    if abu is not None and abu.race_eccentricity_mm == 0 and "autobalancer.race_eccentricity_mm" not in varied:
        del ways["start.eccentricity_deg"]
    if abu is not None and abu.rolling_drag_per_s > 0 and not varied & {DRAG, WARMTH}:
        ways[DRAG] = f"lognormal({abu.rolling_drag_per_s!r}, {WARM})"
    yield from _ways({key: way for key, way in ways.items() if key not in varied})


def of_tolerances(design: Design, *, building: bool) -> Iterator[tuple[str, Variation]]:
    """Balls and race as the drawing permits them; eccentricity, friction, wheels, hands and oil as is usual.

    `building`: the design is fixed; one that is made anew has no balls or race yet that could be off, and no start.
    """
    case, autobalancer, tables = design.case, design.autobalancer, design.case.table
    ways: dict[str, str] = {}
    if building:
        diameter, radius = from_si(autobalancer.ball_diameter, "mm"), from_si(autobalancer.race_radius, "mm")
        ways["autobalancer.ball_diameter_mm"] = f"uniform({diameter - GAUGE!r}, {diameter + GAUGE!r})"
        ways["autobalancer.race_radius_mm"] = f"uniform({radius - BOTTOM!r}, {radius + BOTTOM!r})"
        ways[WARMTH] = "triangular(15, 40, 70)"
    if (off := case.autobalancer.race_eccentricity_mm) > 0:
        ways["autobalancer.race_eccentricity_mm"] = f"triangular(0, {off / 3!r}, {off!r})"
    if (arm := case.autobalancer.rolling_friction_mm) > 0:
        ways["autobalancer.rolling_friction_mm"] = f"lognormal({arm!r}, {ROUGH})"
    if (imbalance := from_si(design.imbalance.value, "g_mm")) > 0:
        ways["wheel.imbalance_g_mm"] = f"lognormal({imbalance:.6g}, {WORN})"
    ways |= _hands(tables)
    low, high = tables.machine.speed_range
    if low < high:
        ways["machine.speed_rpm"] = f"uniform({low!r}, {high!r})"
    yield from _ways(ways)


def _hands(tables: MachineFile) -> dict[str, str]:
    """The natural frequencies of springs that stand for hands; both alike where the file has both alike."""
    frequencies, key = tables.suspension.frequencies, "suspension.natural_frequencies_hz"
    if frequencies is None:
        return {}
    if frequencies[0] == frequencies[1]:
        return {key: f"lognormal({frequencies[0]!r}, {HELD})"}
    return {f"{key}[{k}]": f"lognormal({frequency!r}, {HELD})" for k, frequency in enumerate(frequencies)}


def _ways(ways: dict[str, str]) -> Iterator[tuple[str, Variation]]:
    for key, text in ways.items():
        yield key, variation(text, Place(key=f"vary {key}"))
