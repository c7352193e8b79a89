"""The study over the band: decisive starts from their options, coarse runs as fine ones, counts."""

import json
import math
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import abu_calc
from tests.studies.decisive_runs import NEIGHBOURS, decisive_starts
from tests.studies.hand_held import summary
from tests.studies.outside_equations import COMPILED
from tests.studies.outside_runs import band_starts, broken, coarse_run, fine_run, machine_of, near, quiet_limit
from tests.studies.random_machines import held_text

RESULT: dict[str, Any] = {
    "autobalancer": {
        "ball_count": 4, "ball_mass_g": 3.0, "mass_g": 150.0, "pitch_radius_mm": 30.0, "ball_diameter_mm": 9.0,
    },
    "imbalance_g_mm": 200.0,
}  # fmt: skip


def decided(options: str, *, promised: bool = True) -> list[Any]:
    """Starts of the machine of seed 11 that these options decide."""
    file = tomllib.loads(held_text(11))
    result = RESULT | {"ensemble": {"worst_run": {"options": options, "promised": promised}}}
    return list(decisive_starts(file, result, 1))


def test_a_decisive_start_is_read_from_its_options() -> None:
    file = tomllib.loads(held_text(11))
    first, *others = decided(
        "--race-centre 90 --set wheel.imbalance_g_mm=100 --set autobalancer.race_eccentricity_mm=0.002 "
        "--set 'machine.spindle_axis=\"vertical\"' --set machine.speed_rpm=3000 "
        "--set 'start.angles_deg=[0, 90, 200, 300]' --set 'start.speeds_rpm=[-1500, -1500, -1500, -1500]'"
    )
    p, of_file = first.machine, machine_of(file, RESULT)
    assert (p.offset_angle, p.offset, p.gravity) == pytest.approx((math.pi / 2, 2e-6, 0.0))
    assert p.imbalance == pytest.approx(of_file.imbalance / 2) and first.of_file.imbalance == of_file.imbalance
    assert np.degrees(first.angles) == pytest.approx((0, 90, 200, 300))
    assert first.speeds == pytest.approx([1500 * math.tau / 60] * 4)
    assert len(others) == NEIGHBOURS
    for other in others:
        assert np.abs(np.degrees(other.angles) - (0, 90, 200, 300)).max() < 3.1
        assert 0.9 * p.offset < other.machine.offset <= p.offset and other.machine.drag == p.drag
    assert decided("--race-centre 0 --start spread", promised=False)[1].machine.drag != p.drag


def test_named_starts_stand_where_their_names_say() -> None:
    """Balls touch round 20° ahead of the imbalance or behind it; neighbours of such a start do not overlap."""
    (behind, *others), (still, *_) = (decided(f"--start {name} --race-centre 0") for name in ("behind", "standstill"))
    assert np.degrees(np.mean(behind.angles)) == pytest.approx(-20, abs=0.1)
    assert np.degrees(np.mean(still.angles)) == pytest.approx(20, abs=0.1) and not any(still.speeds)
    for start in (behind, *others):
        assert np.diff(start.angles).min() > 0.9999 * start.machine.gap
    run_up = decided("--scene run-up --race-centre 0 --set run_up.time_s=0.5")[0]
    assert (run_up.full, run_up.machine.ramp, run_up.speeds) == (0.5, 0.5, (0.0,) * 4)


def test_counts() -> None:
    broken_run = {"band": "usual", "worse wheel": True, "why": "late", "quiet": 1.2, "level": -9.0}
    passing = {
        "status": "pass", "axis": "horizontal", "balls": 4, "checks": [], "broken": [broken_run], "repeated": 4,
        "runs": {"promised": 267, "usual": 133, "fine": 2, "worse wheel": 50}, "otherwise": 0, "unconfirmed": 1,
    }  # fmt: skip
    other = {"status": "by dynamics", "checks": [], "holds": True}
    found = summary([passing, passing | {"balls": 5, "broken": []}, other, {"status": "left out"}])
    assert (found["sized"], found["pass"], found["horizontal_with_four_balls"]) == (3, 2, 1)
    counts = {"runs": 266, "broken": 1, "share": 1 / 266, "machines": 1}
    assert found["usual"] == counts | {"never quiet": 0, "slowest": 1.2, "loudest": -9.0}
    assert (found["worse wheel"]["runs"], found["worse wheel"]["broken"]) == (100, 1)
    assert found["promised"]["broken"] == 0 and found["decisive"] == {"machines": 1, "hold": 1}


@pytest.mark.slow
@pytest.mark.skipif(not COMPILED, reason="plain Python would take hours; pip install numba")
@pytest.mark.parametrize("seed", [6, 33, 38])
def test_coarse_runs_come_to_the_same(seed: int, tmp_path: Path) -> None:
    """Far from the limits. Friction makes ends differ, quiet times by 15 % of the limit at most."""
    path = tmp_path / "machine.toml"
    path.write_text(held_text(seed), encoding="utf-8")
    result = json.loads(json.dumps(abu_calc.size(abu_calc.read(str(path)), workers=1).to_dict()))
    file = tomllib.loads(held_text(seed))
    limits = file["limits"]
    for start, _ in band_starts(file, result, seed, 10, 5):
        coarse, fine = coarse_run(start, result, limits), fine_run(start, result, limits)
        assert near(start, coarse, limits) or not broken(fine, limits)
        assert coarse.quiet == pytest.approx(fine.quiet, abs=0.15 * quiet_limit(limits))
