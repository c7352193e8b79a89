"""The worst arrangement on an anisotropic support is searched: a case that a list missed, and others."""

import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import abu_calc
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.boundaries import boundaries, crossings_of, growth_over
from abu_calc.dynamics.stability.family import Family, closed, likeness
from abu_calc.dynamics.stability.linearised import BalancedMotion
from abu_calc.dynamics.stability.resting import resting_angles
from abu_calc.dynamics.stability.two_modes import two_modes
from abu_calc.dynamics.stability.verdict import Search, judged, searched, stability
from abu_calc.features.stability.disturbed import consequence
from abu_calc.simulation.subject import subject_of
from tests.cli.runner import abu
from tests.dynamics.scenes import dimensionless
from tests.studies.arrangements import arrangements, case_of, growth

REFUTED = Path(__file__).parents[2] / "machines" / "stability-worst-arrangement.toml"


@pytest.fixture(scope="module")
def refuted() -> Scene:
    return subject_of(abu_calc.read_scene(REFUTED), command="stability").scene


@pytest.mark.slow
def test_the_arrangement_that_a_list_missed(refuted: Scene) -> None:
    """+2.534e-4 1/s and 2.7432 rad/s at the start angles of the file; the worst arrangement is worse than these."""
    start, worst = stability(refuted, 0.0, "start"), stability(refuted)
    assert start.growth_rate == pytest.approx(2.534e-4, rel=1e-3) and start.stable is False
    assert boundaries(refuted, 0.5, 6.0, 0.0, "start")[-1].speed == pytest.approx(2.7432, rel=2e-4)
    assert worst.stable is False and worst.growth_rate is not None and worst.growth_rate > 2.53e-4
    assert worst.angles is not None and likeness(refuted.ball_masses, worst.angles) == pytest.approx(0, abs=1e-9)
    (limit,) = boundaries(refuted, 0.5, 6.0)
    assert limit.stable_above and limit.speed == pytest.approx(2.96415, rel=1e-5)


@pytest.mark.slow
def test_the_growth_told_is_that_of_the_arrangement_told(refuted: Scene) -> None:
    worst = stability(refuted)
    assert worst.angles is not None
    total = sum(m * np.exp(1j * a) for m, a in zip(refuted.ball_masses, worst.angles, strict=True))
    assert abs(total + refuted.imbalance / refuted.races[0].pitch_radius) < 1e-9 * refuted.imbalance
    assert BalancedMotion(refuted, worst.angles).growth(refuted.speed) == pytest.approx(worst.growth_rate, rel=1e-6)
    ((_, rate),) = growth_over(refuted, [refuted.speed])
    assert rate == pytest.approx(worst.growth_rate, rel=1e-3)
    assert any(change.growing_below for change in crossings_of(refuted, 2.0, 4.0))


@pytest.mark.slow
def test_balls_drift_from_it_to_a_stable_neighbour(refuted: Scene) -> None:
    end = consequence(refuted, stability(refuted))
    assert end is not None and end.kind == "drift" and end.resting_angles is not None and end.growth_rate is not None
    assert end.growth_rate < 0 and end.residual_ratio is not None and end.residual_ratio < 1e-3
    assert BalancedMotion(refuted, end.resting_angles).growth(refuted.speed) == pytest.approx(end.growth_rate, rel=1e-6)
    stiff = replace(refuted, speed=3.5)
    assert consequence(stiff, stability(stiff)) is None


@pytest.mark.slow
def test_the_command_tells_the_worst_and_its_consequence() -> None:
    result = abu("stability", str(REFUTED), "--json").document["result"]
    assert result["stable"] is False and result["growth_rate_per_s"] > 2.53e-4
    assert result["consequence"]["kind"] == "drift"
    screen = " ".join(abu("stability", str(REFUTED)).out.split())
    assert "NOT STABLE" in screen and "the balls drift to a stable arrangement nearby" in screen
    other = abu("stability", str(REFUTED), "--arrangement", "start", "--json").document["result"]
    assert "consequence" not in other


@pytest.mark.parametrize(
    ("balls", "share", "gap", "least"),
    [(3, 0.5, 0.0, 0.25), (4, 1.2, 0.0, 0.0), (4, 1.2, 0.4, 0.0), (5, 3.0, 0.2, 0.0), (6, 4.5, 0.0, 0.125)],
)
def test_a_family_reaches_every_likeness(balls: int, share: float, gap: float, least: float) -> None:
    """Least χ by a general search (SLSQP) from twelve starts."""
    scene = dimensionless(2.0, 1e-3, 1e-3 * share, 0.1, 0.1, tuple(map(float, range(balls))), 100.0)
    fan = resting_angles(scene, gap / 2)
    assert fan is not None
    family = Family.of((1.0,) * balls, fan, gap)
    assert family.chi[0] == pytest.approx(least, abs=1e-6)
    for chi in np.linspace(family.chi[0], family.chi[-1], 7):
        angles = family.nearest(float(chi))
        assert abs(np.exp(1j * angles).sum() + share) < 1e-11
        assert likeness((1.0,) * balls, angles.tolist()) == pytest.approx(chi, abs=0.02)
        places = sorted(angles % (2 * math.pi))
        assert min(b - a for a, b in pairwise([*places, places[0] + 2 * math.pi])) >= gap - 1e-8


@pytest.mark.parametrize("seed", [1, 3, 8])
def test_likeness_alone_decides(seed: int) -> None:
    """For random arrangements, of unequal balls too: the equations of the study, all balls, and two modes agree."""
    case = case_of(seed)
    rows, scene = arrangements(case, 6), case.scene
    for speed in (1.2, 2.5):
        rates = growth(case, rows, speed) * speed
        for angles, rate in zip(rows, rates, strict=True):
            motion = BalancedMotion(scene, tuple(angles.tolist()))
            two = two_modes(motion)
            assert two is not None and not two.isotropic
            assert motion.growth(speed) == pytest.approx(rate, abs=1e-7)
            assert two.growth(speed) == pytest.approx(rate, abs=1e-7)


@pytest.mark.slow
def test_balls_of_several_races_are_moved() -> None:
    """No random arrangement is worse than the one found, but for the last steps of the search."""
    scene = case_of(7).scene
    (race,) = scene.races
    races = tuple(
        replace(
            race, ball_masses=(mass,) * count, start_angles=tuple(map(float, range(count))), start_speeds=(0.0,) * count
        )
        for mass, count in ((0.004, 4), (0.003, 3))
    )
    scene = replace(scene, races=races, imbalance=0.006, speed=1.5)
    listed = judged(scene)[1]
    search = searched(listed, 0.0)
    assert search is not None and not search.in_plane
    searched_growth = search.worst(1.5).growth(1.5)
    rng, rates = np.random.default_rng(0), []
    for _ in range(60):
        angles = closed(search.races, rng.uniform(0, 2 * math.pi, 7))
        if angles is not None:
            rates.append(BalancedMotion(scene, tuple(angles.tolist())).growth(1.5))
    assert searched_growth > max(motion.growth(1.5) for motion in listed) + 1e-3
    assert searched_growth > max(rates) - 1e-4


def test_isotropic_supports_keep_their_list() -> None:
    case = replace(case_of(1), stiffness=1.0, damping=(0.02, 0.02))
    listed = judged(case.scene)[1]
    assert len(listed) > 2 and searched(listed, 0.0) is None
    assert stability(case.scene).arrangements == len(listed)
    assert consequence(case.scene, stability(case.scene)) is None
    assert isinstance(searched(judged(case_of(1).scene)[1], 0.0), Search)
