"""After the optimum, sweeps of the written file confirm its share: 20 seeds.

A sweep confirms the share if its own 95 % interval holds it. The reverse is no test: a sweep without a failure has the
share 1, which lies outside the interval of any fresh samples of which one failed.
"""

from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.optimise.result import written_text


@pytest.mark.hard
def test_sweeps_of_the_written_file_confirm_the_share_in_19_of_20_seeds(tmp_path: Path) -> None:
    machine = abu_calc.read("avtovaz-707-222")
    result = abu_calc.optimise(machine, share=0.99)
    fresh = result.recommended.fresh_share
    assert fresh is not None and fresh.value >= 0.99
    file = tmp_path / "best.toml"
    file.write_text(written_text(machine, result.recommended.set_, result), encoding="utf-8")
    best = abu_calc.read(file)
    sweeps = [abu_calc.sweep(best, None, 1000, seed=seed).meets_limits for seed in range(100, 120)]
    holding = [low <= fresh.value <= high for low, high in (each.confidence_interval for each in sweeps)]
    assert sum(holding) >= 19, [each.share for each in sweeps]
