"""The list of all effects."""

from abu_calc.dynamics.effects.registry import EFFECTS, REGISTRY
from abu_calc.simulation.scene_file import Effects


def test_every_effect_of_the_registry_has_its_table() -> None:
    """Its own, or that of the support it comes with."""
    assert [kind.name for kind in EFFECTS if not kind.table] == list(Effects.model_fields)
    assert all((kind.keys is None) == (kind.table == "scene.swing_arm") for kind in EFFECTS)
    assert {kind for _, kind in REGISTRY} == set(EFFECTS)
