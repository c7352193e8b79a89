"""Requirements of race and balls follow from the permitted displacement."""

import pytest

from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size
from abu_calc.sizing.manufacture.ring_seat import race_quality
from tests.sizing.machines import machine


def test_the_straight_grinder_keeps_the_usual_requirements() -> None:
    """33 µm are permitted: circularity 3 µm, waviness 2.5 µm, Ra 0.16 µm, grade 20."""
    design = size(read_machine("avtovaz-707-222").tables)
    quality = race_quality(design.case, design.autobalancer)
    assert quality.circularity == pytest.approx(3e-6)
    assert quality.waviness == pytest.approx(2.5e-6)
    assert quality.roughness == pytest.approx(0.16e-6)
    assert quality.dent == pytest.approx(1e-6)
    assert quality.ball_grade == 20 and quality.hardness == (60, 63)


@pytest.mark.parametrize("level", [95.0, 105.0, 115.0, 125.0])
def test_each_requirement_is_its_share_of_the_permitted_displacement_or_its_bound(level: float) -> None:
    design = size(machine(limits__vibration_level_db=level))
    quality, permitted = race_quality(design.case, design.autobalancer), design.autobalancer.budget.permitted
    assert quality.circularity <= max(permitted / 10 * 1.0001, 5e-6)
    assert quality.waviness <= max(permitted / 12.5 * 1.0001, 0.5e-6)
    assert 0.05e-6 <= quality.roughness <= max(permitted / 200 * 1.0001, 0.05e-6)
    assert quality.ball_grade <= max(40e6 * permitted / 64 * 1.0001, 5)


@pytest.mark.slow
def test_a_looser_limit_never_asks_for_more() -> None:
    found = []
    for level in (95.0, 105.0, 115.0, 125.0, 135.0):
        design = size(machine(limits__vibration_level_db=level, autobalancer__ball_count=4,
                              autobalancer__ball_diameter_mm=16.0, autobalancer__race_radius_mm=31.0))  # fmt: skip
        quality = race_quality(design.case, design.autobalancer)
        found.append((quality.circularity, quality.waviness, quality.roughness, quality.dent, quality.ball_grade))
    assert found == sorted(found)
