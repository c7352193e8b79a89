"""Cells of charts about scenes: shares of starts that balance."""

from typing import Final

from abu_calc.features.atlas.charts import AtlasChart
from abu_calc.features.stability.attractor_search import search
from abu_calc.features.stability.attractors import searched_scene
from abu_calc.inputs.scene import read_any
from abu_calc.simulation.subject import subject_of
from tests.studies.atlas.recipe import RPM, CellValue, Recipe, Result


def _balance(chart: AtlasChart, speed: float, drag: float) -> tuple[str, tuple[str, ...]]:
    balls, kind = int(chart.name.split("-")[1]), chart.name.split("-")[2]
    masses = ",".join([f"{40 / balls:g}"] * balls)
    angles = ",".join(f"{360 * k / balls:g}" for k in range(balls))
    return f"{kind}.toml", (
        f"scene.race[0].ball_masses_g=[{masses}]", f"scene.race[0].start_angles_deg=[{angles}]",
        f"scene.race[0].rolling_drag_per_s={drag:g}", f"scene.speed_rpm={speed * RPM:.9g}",
    )  # fmt: skip


def _attractors(file: str, entries: tuple[str, ...], starts: int, seed: int) -> Result:
    """The drawn starts alone: the command follows designed ones, too, which count in no share."""
    found = search(searched_scene(subject_of(read_any(file, list(entries)))), starts, seed, designed=False)
    ends = [{"kind": group.kind, "drawn_starts": group.drawn} for group in found.groups]
    return {
        "attractors": ends,
        "attractor_search": {"drawn_starts": starts, "undecided_share": len(found.undecided) / starts},
    }


def _balanced(result: Result) -> CellValue:
    search = result["attractor_search"]
    met = sum(each["drawn_starts"] for each in result["attractors"] if each["kind"] == "balanced")
    lost = round(search["undecided_share"] * search["drawn_starts"])
    return CellValue.share(met, search["drawn_starts"], lost)


BALANCE: Final = Recipe(
    _balance, lambda starts: ("stability", f"--attractors --starts {starts}"), _attractors, _balanced, 20, True
)
