"""Order 8 by what defines it: powers of time, the exponential, and an error that sees the first power it misses."""

import math

import numpy as np
import pytest

from abu_calc.dynamics.integrators.compiled import dop853 as method
from tests.dynamics.integrators.compiled.method_steps import Stepping


@pytest.mark.parametrize("power", range(8))
def test_powers_of_time_below_the_order_are_integrated_exactly(power: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """y' = t^p gives (t^{p+1} − t₀^{p+1})/(p + 1); within the step up to the order of the dense output, 7."""
    step = Stepping(method, lambda t, y: t**power, 0.0, 0.5, 0.8, monkeypatch)

    def exact(t: float) -> float:
        return (t ** (power + 1) - 0.5 ** (power + 1)) / (power + 1)

    assert step.end[0] == pytest.approx(exact(1.3), rel=1e-13)
    for share in (0.0, 0.3, 0.77, 1.0) if power < 7 else (0.0, 1.0):
        assert step.at(share)[0] == pytest.approx(exact(0.5 + 0.8 * share), rel=1e-11, abs=1e-14)


def test_the_exponential_is_its_series_up_to_the_order(monkeypatch: pytest.MonkeyPatch) -> None:
    """Σ z^k/k! with k up to 8 is what is left of e^z; the next term is another."""
    steps = np.array((0.2, 0.4))
    missed = [Stepping(method, lambda t, y: y, 1.0, 0.0, h, monkeypatch).end[0] - math.exp(h) for h in steps]
    slope = math.log(missed[1] / missed[0]) / math.log(2)
    assert slope == pytest.approx(8 + 1, abs=0.3) and method.METHOD_ORDER == 8
    assert pytest.approx(-1 / method.EXPONENT) == 8


def test_the_error_sees_what_the_weaker_method_misses(monkeypatch: pytest.MonkeyPatch) -> None:
    """Powers that both methods integrate have none, those that only the stronger one does have some."""
    errors = [
        Stepping(method, lambda t, y, p=p: t**p, 0.0, 0.5, 0.8, monkeypatch).error(1e-6)  # type: ignore[misc]
        for p in range(8)
    ]
    assert max(errors[: 5 - 1]) < 1e-6 and errors[-1] > 1e-3


def test_the_motion_within_a_step_leaves_and_arrives_with_its_rates(monkeypatch: pytest.MonkeyPatch) -> None:
    def rates(t: float, y: np.ndarray) -> list[float]:
        return [float(y[1]), -float(y[0]) + t]

    step = Stepping(method, rates, (1.0, 0.3), 0.0, 0.2, monkeypatch)
    for share, place, t in ((0.0, step.start, 0.0), (1.0, step.end, 0.2)):
        np.testing.assert_allclose(step.at(share), place, rtol=1e-14)
        slope = (step.at(share + 1e-6) - step.at(share - 1e-6)) / (2e-6 * 0.2)
        np.testing.assert_allclose(slope, rates(t, place), rtol=1e-7)
