"""No random arrangement grows above the highest boundary of abu-calc, on a few anisotropic scenes of the study."""

import pytest

from tests.studies.arrangements import ALLOWED, compared

QUICK = (5, 9, 23)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [*QUICK, *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(30, 36))])
def test_no_arrangement_is_missed(seed: int) -> None:
    comparison = compared(seed, 60)
    assert comparison.tried > 20 and comparison.missed <= ALLOWED and comparison.speeds_missed == 0
