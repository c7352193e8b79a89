"""Recipe of each chart of the atlas, by its letter."""

from typing import Final

from tests.studies.atlas import machine_cells, scene_cells
from tests.studies.atlas.recipe import Recipe

RECIPES: Final[dict[str, Recipe]] = {
    "a": scene_cells.BALANCE,
    "c": machine_cells.RESIDUAL,
    "e": machine_cells.OVALITY,
    "f": machine_cells.BREAK_EVEN,
    "g": machine_cells.USEFUL,
}
