"""The two reference machines of the type test, whole tables, with bodies exactly as the reference has them.

The reference is a Monte Carlo simulation of 20 000 runs by another program, its means with one standard error. Ours
has 100 000 runs. Means must agree within three standard errors of both together, percentiles within 5 %.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from abu_calc.dynamics.averaging.resting_places import SlowBalls
from abu_calc.features.declare.type_test_simulation import SimulatedTest, Spindle, search_break_even, simulated_test
from abu_calc.formulas.type_test import TypeTestBody, acceleration_per_displacement
from abu_calc.foundation.progress import silent
from abu_calc.standards.vibration import declared_uncertainty, reproducibility
from tests.dynamics.averaging.test_resting_places import S100, S150
from tests.formulas.test_type_test import POINT, RIGID

RUNS = 100_000


@dataclass(frozen=True)
class Reference:
    """Test wheel [kg m], race eccentricity [m]; mean, its standard error, percentiles, deviation of five, by handle."""

    body: TypeTestBody
    balls: SlowBalls
    imbalance: float
    eccentricity: float
    values: dict[str, tuple[float, float, tuple[float, float, float], float]]
    displacements: tuple[float, float, float, float]
    """Mean, rms, 50 %, 95 % [µm]."""
    declared: tuple[float, float]
    """Without, and with times 1.3 [m/s²]."""
    uncertainty: tuple[float, float]
    break_even: tuple[float, float, float]
    """Without friction, simulated, and its uncertainty [µm]."""


MACHINES = {
    "S100": Reference(
        POINT, S100, 29e-6, 5e-6, {"wheel plane": (0.6629, 0.0024, (0.197, 0.628, 1.185), 0.153)},
        (4.33, 5.22, 3.93, 8.95), (0.951, 0.862), (0.589, 0.580), (6.9712, 5.88, 0.1),
    ),
    "S150": Reference(
        RIGID, S150, 65e-6, 10e-6,
        {
            "front": (0.5515, 0.0020, (0.148, 0.532, 1.035), 0.124),
            "rear": (0.3360, 0.0013, (0.090, 0.316, 0.669), 0.072),
        },
        (8.84, 10.50, 8.12, 19.6), (1.458, 0.717), (0.639, 0.566), (25.946, 25.0, 0.2),
    ),
}  # fmt: skip


@pytest.fixture(scope="module", params=["S100", pytest.param("S150", marks=pytest.mark.slow)])
def pair(request: pytest.FixtureRequest) -> tuple[Reference, SimulatedTest]:
    reference = MACHINES[request.param]
    spindle = Spindle(
        reference.body, reference.body, reference.balls, tuple(math.radians(72 * k) for k in range(5)),
        acceleration_per_displacement(reference.balls.speed), 0.0, 1.3,
    )  # fmt: skip
    return reference, simulated_test(spindle, reference.imbalance, reference.eccentricity, RUNS)


@pytest.mark.slow
def test_values_of_the_handles(pair: tuple[Reference, SimulatedTest]) -> None:
    reference, test = pair
    for name, (mean, error, percentiles, deviation) in reference.values.items():
        values = test.values[name]
        assert test.means[name] == pytest.approx(mean, abs=3 * math.hypot(error, values.std() / math.sqrt(RUNS)))
        assert np.quantile(values, (0.05, 0.5, 0.95)) == pytest.approx(percentiles, rel=0.05)
        assert test.deviation_of_series(name) == pytest.approx(deviation, rel=0.05)


@pytest.mark.slow
def test_displacements_that_friction_leaves(pair: tuple[Reference, SimulatedTest]) -> None:
    reference, test = pair
    sizes = 1e6 * np.abs(test.ends.displacements)
    found = sizes.mean(), test.friction_rms * 1e6, *np.quantile(sizes, (0.5, 0.95))
    assert found == pytest.approx(reference.displacements, rel=0.03)
    assert test.ends.moving == 0


@pytest.mark.slow
def test_declared_values_and_their_uncertainty(pair: tuple[Reference, SimulatedTest]) -> None:
    reference, test = pair
    without = max(test.spindle.without(reference.imbalance).values())
    assert (without, test.declared) == pytest.approx(reference.declared, rel=8e-3)
    assert without == pytest.approx(reference.declared[0], abs=5e-4)
    found = tuple(declared_uncertainty(reproducibility(value)) for value in (without, test.declared))
    assert found == pytest.approx(reference.uncertainty, abs=1.2e-3)


@pytest.mark.slow
def test_break_even_eccentricities(pair: tuple[Reference, SimulatedTest]) -> None:
    reference, test = pair
    even = search_break_even(test, 20_000, silent)
    ideal, simulated, error = reference.break_even
    assert even.frictionless is not None and even.simulated is not None
    assert 1e6 * even.frictionless == pytest.approx(ideal, rel=2e-5)
    assert 1e6 * even.simulated == pytest.approx(simulated, abs=2 * error)
