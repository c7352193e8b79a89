"""Labels of results by their paths."""

import pytest

from abu_calc.features.compare.labels import label_of


@pytest.mark.parametrize(
    ("path", "unit", "label"),
    [
        ("autobalancer.ball_diameter_mm", "mm", "autobalancer: ball diameter, mm"),
        ("imbalance_g_mm", "g·mm", "imbalance, g·mm"),
        ("drawing.12.requirement", "", "drawing 13: requirement"),
        ("frequency.modes.1.damping_ratio", "", "frequency, modes 2: damping ratio"),
        ("no_such.entry_mm", "mm", "no such: entry, mm"),
    ],
)
def test_a_path_has_the_label_of_its_record(path: str, unit: str, label: str) -> None:
    assert label_of(path, unit) == label
