"""Descriptions of keys are made of their fields: bounds and defaults stand once."""

import importlib
from collections.abc import Iterator

from abu_calc.foundation.validity import bounded
from abu_calc.inputs.reading.table import Table, in_si

UNSAID = {("Bearing", "shaft_bore_mm", "le"), ("SceneTable", "duration_s", "gt"), ("_Scene", "duration_s", "gt"),
          ("_SceneKeys", "duration_s", "gt")}  # fmt: skip
"""Bounds that another key draws closer."""


def _tables(above: type[Table] = Table) -> Iterator[type[Table]]:
    for name in ("inputs.machine", "simulation.scene_file", "features.balancing.tables"):
        importlib.import_module(f"abu_calc.{name}")
    for table in above.__subclasses__():
        if table.__module__.startswith("abu_calc."):
            yield table
            yield from _tables(table)


def test_every_number_says_the_bounds_and_the_default_that_hold() -> None:
    seen = 0
    for table in _tables():
        for key, field in table.model_fields.items():
            text = field.description or ""
            assert "{" not in text
            bounds = {name: value for one in field.metadata for name, value in vars_of(one)}
            for name, value in bounds.items():
                assert bounded(value) in text or (table.__name__, key, name) in UNSAID, (table, key, text)
            if bounds and field.default is not None and not field.is_required():
                assert f"Default: {bounded(field.default)}" in text, (table, key, text)
            seen += bool(bounds)
    assert seen > 80


def vars_of(limit: object) -> list[tuple[str, float]]:
    """Bounds of a number that a constraint sets."""
    return [(name, getattr(limit, name)) for name in ("ge", "gt", "le") if getattr(limit, name, None) is not None]


TAKEN = {"Handle.position", "Wheel.runout"}
"""Properties, whichever key gives them: places and runouts in SI, too, ranges of speed in rpm."""


def test_a_quantity_in_si_has_a_name_of_its_own() -> None:
    """`wheel.diameter` is `wheel.diameter_mm` in metres: no other key or property is called so, or it would win."""
    for table in _tables():
        quantities = in_si(table)
        assert len(quantities) == len(table.model_fields), table
        for name, (key, _) in quantities.items():
            clash = name != key and (name in table.model_fields or any(name in vars(base) for base in table.__mro__))
            owners = {f"{base.__name__}.{name}" for base in table.__mro__}
            assert not clash or owners & TAKEN, (table, name)
