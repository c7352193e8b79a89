"""Methods of orders 8 and 5 by what defines them: powers of time, the exponential, the first power the error sees."""

import math
from types import ModuleType

import numpy as np
import pytest

from abu_calc.dynamics.integrators.compiled import dop853, dopri5
from tests.dynamics.integrators.compiled.method_steps import Stepping

METHODS = pytest.mark.parametrize(
    ("method", "order", "dense", "weaker"), [(dop853, 8, 7, 5), (dopri5, 5, 4, 4)], ids=["dop853", "dopri5"]
)
"""Their orders, those of the dense output and of the method that the error compares with."""


@METHODS
def test_powers_of_time_below_the_order_are_integrated_exactly(
    method: ModuleType, order: int, dense: int, weaker: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """y' = t^p gives (t^{p+1} − t₀^{p+1})/(p + 1); within the step up to the order of the dense output."""
    for power in range(order):
        step = Stepping(method, lambda t, y, power=power: t**power, 0.0, 0.5, 0.8, monkeypatch)  # type: ignore[misc]
        for share in (0.0, 0.3, 0.77, 1.0) if power < dense else (0.0, 1.0):
            exact = ((0.5 + 0.8 * share) ** (power + 1) - 0.5 ** (power + 1)) / (power + 1)
            assert step.at(share)[0] == pytest.approx(exact, rel=1e-11, abs=1e-14), power
        assert step.end[0] == pytest.approx(exact, rel=1e-13), power


@METHODS
def test_the_exponential_is_its_series_up_to_the_order(
    method: ModuleType, order: int, dense: int, weaker: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Σ z^k/k! with k up to the order is what is left of e^z; the next term is another."""
    steps = np.array((0.2, 0.4))
    missed = [Stepping(method, lambda t, y: y, 1.0, 0.0, h, monkeypatch).end[0] - math.exp(h) for h in steps]
    slope = math.log(missed[1] / missed[0]) / math.log(2)
    assert slope == pytest.approx(order + 1, abs=0.3) and order == method.METHOD_ORDER
    assert pytest.approx(-1 / method.EXPONENT) == order


@METHODS
def test_the_error_sees_what_the_weaker_method_misses(
    method: ModuleType, order: int, dense: int, weaker: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Powers that both methods integrate have none, those that only the stronger one does have some."""
    errors = [
        Stepping(method, lambda t, y, p=p: t**p, 0.0, 0.5, 0.8, monkeypatch).error(1e-6)  # type: ignore[misc]
        for p in range(order)
    ]
    assert max(errors[: weaker - 1]) < 1e-6 and errors[-1] > 1e-3


@METHODS
def test_the_motion_within_a_step_leaves_and_arrives_with_its_rates(
    method: ModuleType, order: int, dense: int, weaker: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    def rates(t: float, y: np.ndarray) -> list[float]:
        return [float(y[1]), -float(y[0]) + t]

    step = Stepping(method, rates, (1.0, 0.3), 0.0, 0.2, monkeypatch)
    for share, place, t in ((0.0, step.start, 0.0), (1.0, step.end, 0.2)):
        np.testing.assert_allclose(step.at(share), place, rtol=1e-14)
        slope = (step.at(share + 1e-6) - step.at(share - 1e-6)) / (2e-6 * 0.2)
        np.testing.assert_allclose(slope, rates(t, place), rtol=1e-7)
