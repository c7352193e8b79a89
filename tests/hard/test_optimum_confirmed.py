"""After the optimum, sweeps of the written file confirm its share: 20 seeds."""

from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.optimise.written import written_text


@pytest.mark.hard
def test_sweeps_of_the_written_file_confirm_the_share_in_19_of_20_seeds(tmp_path: Path) -> None:
    machine = abu_calc.read("avtovaz-707-222")
    result = abu_calc.optimise(machine, share=0.99)
    fresh = result.recommended.fresh_share
    assert fresh is not None and fresh.value >= 0.99
    file = tmp_path / "best.toml"
    file.write_text(written_text(machine, result.recommended.set_, result), encoding="utf-8")
    best = abu_calc.read(file)
    shares = [abu_calc.sweep(best, None, 1000, seed=seed).meets_limits.share for seed in range(100, 120)]
    assert sum(fresh.low <= share <= fresh.high for share in shares) >= 19, shares
