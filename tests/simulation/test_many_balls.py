"""A drum with forty balls: every check of `abu size` is evaluated, the quiet time of its long run-up too."""

from pathlib import Path

import pytest

import abu_calc
from abu_calc.dynamics.integrators.compiled.code import installed
from abu_calc.dynamics.integrators.run import IntegrationRun
from abu_calc.dynamics.trajectory import Trajectory

DRUM = Path(__file__).parents[1] / "machines" / "washing-machine.toml"

MOST = 32e6
"""Evaluations of all runs together, of 86 states, 2 µs each in compiled code; 26.1 million were counted."""


@pytest.mark.hard
@pytest.mark.skipif(not installed(), reason="without a compiler it takes long")
def test_every_check_of_a_drum_is_evaluated(monkeypatch: pytest.MonkeyPatch) -> None:
    evaluations: list[int] = []
    trajectory = IntegrationRun.trajectory

    def counted(self: IntegrationRun) -> Trajectory:
        try:
            return trajectory(self)
        finally:
            evaluations.append(self.evaluations)

    monkeypatch.setattr(IntegrationRun, "trajectory", counted)
    result = abu_calc.size(abu_calc.read(DRUM))
    assert not [check.code for check in result.checks if check.status == "not-done"]
    assert {"ABU103", "ABU401", "ABU701", "ABU702", "ABU704"} <= {check.code for check in result.checks}
    assert result.autobalancer.ball_count > 30
    assert result.ensemble is not None and result.ensemble.quiet_time_s.worst is not None
    run_ups = [row for row in result.ensemble.settling_by_start if "run-up" in row.start]
    assert run_ups and all(row.quiet_time_s is not None for row in run_ups)
    assert sum(evaluations) < MOST
