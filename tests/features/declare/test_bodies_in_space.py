"""Declared values of a body in space, whose handles move along three axes by an imbalance beside the centre of mass."""

import math
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.declare.study import DeclareResult, declare
from abu_calc.standards.vibration import hand_arm_weight
from tests.features.declare.machines import G125, S150, written

VELOCITIES = {"rear": (12.5264, 2.93740, 8.17211), "side": (19.7999, 18.3292, 39.0305)}
"""Rms velocities along x, y, z [mm/s] without balls, from integration of six degrees of freedom."""
SPEED = 11_000 * math.pi / 30
MASS_FELT = 1.08336
"""m_F [kg] without the autobalancer."""


@pytest.fixture(scope="module")
def angle(tmp_path_factory: pytest.TempPathFactory) -> DeclareResult:
    return declare(abu_calc.read(written(tmp_path_factory.mktemp("space"), G125)))


@pytest.mark.slow
def test_three_axes_without_autobalancer(angle: DeclareResult) -> None:
    gain = hand_arm_weight(SPEED) * SPEED / 1000
    values = {name: gain * math.hypot(*axes) for name, axes in VELOCITIES.items()}
    assert {each.name: each.without_m_per_s2 for each in angle.handles} == pytest.approx(values, rel=1e-5)
    assert angle.handle == angle.without.handle == "side"


def test_a_race_in_the_wheel_plane_leaves_its_eccentricity(angle: DeclareResult) -> None:
    """Every place moves as by the imbalance m_F·Δ; the autobalancer's mass adds 3 % to m_F at most."""
    added = angle.model.mass_kg - angle.model.mass_without_autobalancer_kg
    share = 1e-5 * MASS_FELT / 38e-6
    for each in angle.handles:
        assert each.with_m_per_s2 is not None
        assert each.with_m_per_s2 / each.without_m_per_s2 == pytest.approx(share, rel=0.5 * added)


def test_break_even_by_the_mass_that_balls_feel(angle: DeclareResult) -> None:
    """U/(1.3·m_F) = 27.0 µm; with M for m_F it would be 12.2 µm."""
    assert angle.break_even_frictionless_mm == pytest.approx(38e-3 / 1.3 / MASS_FELT, rel=0.01)
    assert angle.break_even_eccentricity_mm == angle.break_even_frictionless_mm


@pytest.mark.slow
def test_an_estimated_body_has_bands(tmp_path: Path) -> None:
    text = G125.replace("inertia_kg_m2 = [0.0040, 0.0200, 0.0190]\ninertia_xz_kg_m2 = -0.0015\n", "")
    text = text.replace(
        'spindle_axis = "vertical"\n', 'spindle_axis = "vertical"\nlength_mm = 330.0\nheight_mm = 70.0\n'
    )
    result = declare(abu_calc.read(written(tmp_path, text)), 500)
    assert "estimated" in result.body
    low, high = result.without.band_m_per_s2 or (math.nan, math.nan)
    assert low < result.without.a_hv_m_per_s2 < high
    assert result.with_ is not None and result.with_.declared_band_m_per_s2 is not None
    low, high = result.with_.declared_band_m_per_s2
    assert low < result.with_.declared_m_per_s2 < high


@pytest.mark.slow
def test_a_body_in_space_on_its_spindle_is_that_of_one_axis(tmp_path: Path) -> None:
    """The rigid machine along its spindle, written in space: the same values but for the suspension's turns."""
    old = "transverse_inertia_kg_m2 = 0.10\ncenter_of_mass_to_wheel_mm = 200.0\n"
    new = "center_of_mass_from_wheel_mm = [0.0, 0.0, -200.0]\ninertia_kg_m2 = [0.10, 0.10, 0.02]\n"
    text = S150.replace(old, new).replace("from_center_of_mass_mm = 100.0", "position_mm = [0.0, 0.0, 100.0]")
    text = text.replace("from_center_of_mass_mm = -200.0", "position_mm = [0.0, 0.0, -200.0]")
    plane, space = (
        declare(abu_calc.read(written(tmp_path, each, f"{k}.toml")), 1000) for k, each in enumerate((S150, text))
    )
    assert space.without.a_hv_m_per_s2 == pytest.approx(plane.without.a_hv_m_per_s2, rel=1e-3)
    assert space.with_ is not None and plane.with_ is not None
    assert space.with_.no_friction_m_per_s2 == pytest.approx(plane.with_.no_friction_m_per_s2, rel=2e-3)
    assert space.with_.a_hv_m_per_s2 == pytest.approx(plane.with_.a_hv_m_per_s2, rel=0.03)
