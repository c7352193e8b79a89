"""The list of all effects."""

from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.inputs.scene_effects import Effects


def test_every_effect_of_the_registry_has_its_table():
    """Its own, or that of the support it comes with."""
    names = [name for name, _ in REGISTRY]
    assert sorted(name for name, kind in REGISTRY if not kind.table) == sorted(Effects.model_fields)
    assert {kind.table for _, kind in REGISTRY} == {"", "scene.swing_arm"}
    assert [kind.name for _, kind in REGISTRY] == names
