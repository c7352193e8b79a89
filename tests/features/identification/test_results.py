"""Identified values written into a file whose value has its unit: the value is replaced, not doubled."""

import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import abu_calc
from abu_calc.features.identification.results import identified_text
from abu_calc.inputs.reading.sources import text_of


@pytest.mark.parametrize(
    "entry", ['rolling_drag = "900 1/min"', "rolling_drag = '15 1/s'", "rolling_drag_per_s = 15.0"]
)
def test_a_value_with_its_unit_is_replaced(entry: str, tmp_path: Path) -> None:
    file = tmp_path / "m.toml"
    file.write_text(re.sub(r"(?m)^rolling_drag_per_s = \S+", entry, text_of("avtovaz-707-222"), count=1), "utf-8")
    result: Any = SimpleNamespace(
        rolling_drag_per_s=SimpleNamespace(value=12.345, low=11.0, high=14.0), rolling_friction_mm=None,
        race_eccentricity_mm=None, race_eccentricity_angle_deg=None, starts=10,
    )  # fmt: skip
    written = abu_calc.read(identified_text(str(file), result))
    assert written.whole().autobalancer.rolling_drag_per_s == 12.35  # type: ignore[union-attr]
