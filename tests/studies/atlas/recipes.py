"""Recipe of each chart of the atlas, by its letter."""

from typing import Final

from tests.studies.atlas.machine_cells import BREAK_EVEN, CONTACT, OVALITY, RESIDUAL, USEFUL
from tests.studies.atlas.recipe import Recipe
from tests.studies.atlas.scene_cells import BALANCE, MOTOR, RUN_UP

RECIPES: Final[dict[str, Recipe]] = {
    "a": BALANCE, "b": RUN_UP, "c": RESIDUAL, "d": CONTACT, "e": OVALITY, "f": BREAK_EVEN, "g": USEFUL, "h": MOTOR
}  # fmt: skip
