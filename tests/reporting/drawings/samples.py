"""Results to draw: one whole study, and the same with the autobalancers of other machines."""

from dataclasses import replace
from functools import cache

from abu_calc.features.design.records import AutobalancerRecord, Eccentricity, Section
from abu_calc.features.design.study import SizeResult
from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size as size_design
from tests.remembered import recalled

HOSTILE = '<script>alert("1")</script> & Schleifer ÄÖÜß ]]> %%c ^J \\U+0041 шлиф ' + "long " * 30
MACHINES: dict[str, tuple[str, ...]] = {
    "one-piece": (),
    "light": ("autobalancer.design=light",),
    "bearing-ring": ("autobalancer.design=bearing-ring",),
    "rollers": ("autobalancer.corrector=roller",),
    "light rollers": ("autobalancer.corrector=roller", "autobalancer.design=light"),
    "two balls": ("autobalancer.ball_count=2",),
    "sixteen balls": ("autobalancer.ball_count=16", "autobalancer.ball_diameter_mm=6",
                      "autobalancer.max_outer_diameter_mm=120"),
    "tiny": ("autobalancer.max_outer_diameter_mm=20", "autobalancer.bore_diameter_mm=4", "autobalancer.min_wall_mm=1",
             "autobalancer.max_width_mm=8"),
    "huge": ("autobalancer.max_outer_diameter_mm=2000", "autobalancer.max_width_mm=300",
             "autobalancer.bore_diameter_mm=900", "autobalancer.ball_diameter_mm=100", "autobalancer.ball_count=5",
             "autobalancer.race_radius_mm=990"),
    "wide": ("autobalancer.max_outer_diameter_mm=300", "autobalancer.max_width_mm=120",
             "autobalancer.bore_diameter_mm=10", "autobalancer.ball_diameter_mm=100", "autobalancer.ball_count=2"),
    "large bore": ("autobalancer.max_outer_diameter_mm=100", "autobalancer.bore_diameter_mm=80",
                   "autobalancer.min_wall_mm=1", "autobalancer.ball_count=7", "autobalancer.ball_diameter_mm=3"),
    "thick wall": ("autobalancer.max_outer_diameter_mm=120", "autobalancer.min_wall_mm=25"),
    "narrow": ("autobalancer.max_outer_diameter_mm=56.5", "autobalancer.bore_diameter_mm=28.4",
               "autobalancer.ball_diameter_mm=2", "autobalancer.ball_count=7", "autobalancer.design=light"),
    "small scale": ("autobalancer.max_outer_diameter_mm=378.8", "autobalancer.bore_diameter_mm=296.2",
                    "autobalancer.ball_diameter_mm=20", "autobalancer.ball_count=9",
                    "autobalancer.design=light"),
    "screwed": ("autobalancer.closure=screwed",),
    "hostile name": (f"machine.name='{HOSTILE}'",),
}  # fmt: skip


@cache
def whole() -> SizeResult:
    """The straight grinder, sized and simulated."""
    found: SizeResult = recalled("size", read_machine("avtovaz-707-222"))
    return found


@cache
def result(name: str) -> SizeResult:
    """The drawn parts belong to the machine, the rest to the straight grinder; no drawing shows remedies of checks."""
    machine = read_machine("avtovaz-707-222", MACHINES[name])
    design = size_design(machine.tables)
    table, one = design.case.autobalancer, design.autobalancer
    return replace(
        whole(),
        title=machine.tables.machine.name,
        autobalancer=AutobalancerRecord.of(table, one, design.track),
        section=Section.of(design),
        parts=design.construction.parts,
        eccentricity=Eccentricity.of(design.eccentricity),
        drawing=design.drawing,
    )
