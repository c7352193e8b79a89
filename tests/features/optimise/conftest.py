"""One small optimisation that several tests look at."""

from typing import Any

import pytest

import abu_calc
from abu_calc.features.optimise import racing
from abu_calc.features.optimise.result import OptimiseResult

CHOICES = {
    "autobalancer.race_eccentricity_mm": "choice(0.005, 0.03)",
    "autobalancer.rolling_drag_per_s": "choice(4, 20)",
}
OPTIONS: dict[str, Any] = {"share": 0.9, "runs": 100, "samples": 600}


@pytest.fixture(scope="session")
def small() -> OptimiseResult:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(racing, "ENOUGH", 32)
        return abu_calc.optimise(abu_calc.read("avtovaz-707-222"), CHOICES, **OPTIONS)
