"""`abu sweep` of a machine with two races: phases at random, against vectors that are added up here."""

import cmath
import math
from typing import Any

import pytest

import abu_calc
from abu_calc.features.spindle.case import SpindleDesign
from abu_calc.features.sweep.plan import asked, planned
from abu_calc.features.sweep.samples import (
    SpindleBuilds,
    capacity_ratio,
    start_on_spindle,
)
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import Machine, read_machine
from abu_calc.inputs.spindle import TwoRaceFile
from abu_calc.inputs.variation import Variants

RANGE = "machine.mass_kg=uniform(61.99, 62.01)"
"""Next to nothing varies: the phases are drawn anyway."""


SAMPLES = 2000


def study_of(machine: Machine, *vary: str, **options: Any) -> SpindleBuilds:
    study = planned(machine, asked(machine, vary, **options), 0.05).study
    assert isinstance(study, SpindleBuilds)
    return study


def needs_written_out(design: SpindleDesign, phase: float, centre: float) -> tuple[float, float]:
    """Resultants of the pedestal grinder far above resonance: moments about the other race, races off by Δ alike."""
    case = design.case
    wheels = (2500e-6 + 0j, 1800e-6 * cmath.exp(1j * phase))
    off = case.eccentricity * cmath.exp(1j * (cmath.phase(sum(wheels)) + centre))
    k, c, W = 4.4e5, 600.0, case.speed
    # Both races off by the same Δ: the rotor whirls by −Δ without tilt, held by half of the force at each race.
    half = (k - W**2 * case.rotor.mass + 1j * W * c) * -off / W**2 / 2
    first = half - (wheels[0] * 0.56 + wheels[1] * 0.04) / 0.6
    second = half - (wheels[0] * 0.04 + wheels[1] * 0.56) / 0.6
    return abs(first), abs(second)


@pytest.mark.slow
def test_the_share_told_for_the_worst_phase_holds_in_every_sample() -> None:
    study = study_of(read_machine("pedestal-grinder"), RANGE, runs=SAMPLES, seed=41)
    design = study.design
    told = min(race.capacity_ratio for race in design.races)
    names = [factor.key for factor in study.sample.factors]
    assert "start.phase_2_deg" in names
    lowest, phases = math.inf, []
    for member in range(SAMPLES):
        values = dict(zip(names, study.sample.values(member), strict=True))
        start = start_on_spindle(design, values)
        ratio = capacity_ratio(design, start)
        assert ratio >= told * (1 - 1e-9)
        if member % 97 == 0:
            own = needs_written_out(design, start.phases[0], start.eccentricity)
            capacities = [race.autobalancer.capacity for race in design.races]
            assert ratio == pytest.approx(min(c / n for c, n in zip(capacities, own, strict=True)), rel=1e-6)
        lowest = min(lowest, ratio)
        phases.append(start.phases[0])
    # Phases come from the whole circle, and near the worst one; its eccentricities differ from race to race.
    assert max(phases) - min(phases) > 0.998 * 2 * math.pi
    assert lowest < 1.05 * told


@pytest.mark.slow
def test_every_simulated_phase_balances_as_the_worst_was_told() -> None:
    result = abu_calc.sweep(read_machine("pedestal-grinder"), [RANGE], runs=6, seed=3, accuracy=0.1)
    assert result.failed.members == 0
    assert result.meets_limits.each["balances"].met == 6
    assert result.members["capacity_ratio"].min() > 1.2
    assert {"start.phase_2_deg", "start.kind"} <= {factor.key for factor in result.varied}


@pytest.mark.slow
def test_tolerances_go_to_both_races_and_every_wheel() -> None:
    study = study_of(read_machine("pedestal-grinder"), tolerances=True, runs=4)
    keys = {factor.key for factor in study.sample.factors}
    assert {"autobalancer.ball_diameter_mm", "autobalancer.0.race_radius_mm", "autobalancer.1.race_radius_mm"} <= keys
    assert {"wheel.0.imbalance_g_mm", "wheel.1.imbalance_g_mm", "start.temperature_C"} <= keys
    assert "autobalancer.rolling_drag_per_s" not in keys
    table = study.variants.table({("autobalancer", "ball_diameter_mm"): 17.4})
    made = study.design.built(table)
    assert {round(race.autobalancer.ball_diameter, 9) for race in made.races} == {0.0174}
    # The design stays: as many balls, the same races.
    for ours, theirs in zip(made.races, study.design.races, strict=True):
        assert ours.autobalancer.ball_count == theirs.autobalancer.ball_count
        assert ours.autobalancer.race_radius == theirs.autobalancer.race_radius


@pytest.mark.slow
def test_a_known_phase_does_not_vary() -> None:
    machine = read_machine("pedestal-grinder", ["wheel.0.imbalance_angle_deg=0.0", "wheel.1.imbalance_angle_deg=130.0"])
    assert not [factor for factor in study_of(machine, RANGE).sample.factors if "phase" in factor.key]
    with pytest.raises(InputError, match="phase of this imbalance is known"):
        study_of(machine, "start.phase_2_deg=uniform(0, 90)")


@pytest.mark.slow
def test_one_of_two_known_phases_leaves_the_other() -> None:
    machine = read_machine("pedestal-grinder", ["wheel.1.imbalance_angle_deg=130.0"])
    keys = [factor.key for factor in study_of(machine, RANGE).sample.factors if "phase" in factor.key]
    assert keys == ["start.phase_1_deg"]


@pytest.mark.slow
@pytest.mark.parametrize(
    "vary",
    [
        "start.phase_21_deg=uniform(0, 9)",
        "wheel.plane_mm=uniform(1, 2)",
        "autobalancer.nothing=uniform(1, 2)",
        "autobalancer=1,2",
    ],
)  # fmt: skip
def test_what_the_file_does_not_bear_is_refused(vary: str) -> None:
    with pytest.raises(InputError):
        study_of(read_machine("pedestal-grinder"), vary)


def test_a_key_of_one_race_leaves_the_other() -> None:
    machine = read_machine("pedestal-grinder")
    variants = Variants.of(machine, TwoRaceFile)
    table = variants.table({("autobalancer", 1, "rolling_drag_per_s"): 30.0})
    assert [race.rolling_drag_per_s for race in table.autobalancer] == [15.0, 30.0]
    table = variants.table({("autobalancer", "rolling_drag_per_s"): 30.0})
    assert [race.rolling_drag_per_s for race in table.autobalancer] == [30.0, 30.0]
