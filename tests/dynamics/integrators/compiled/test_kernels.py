"""Steps of the loop's two methods against SciPy's, which have the same coefficients from a second hand."""

import math
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from scipy.integrate import DOP853, RK45

from abu_calc.dynamics.integrators.compiled.arrays import Step
from abu_calc.dynamics.integrators.compiled.kernels import METHODS

SOLVERS: dict[str, Any] = {"rk45": RK45, "dop853": DOP853}
START = np.array([1.0, 0.5, -0.2])


def rates(t: float, y: Any) -> list[float]:
    """Nothing of it is linear, and time is in it."""
    return [y[1] * y[2], -y[0] * y[2] + math.sin(3.0 * t), 0.3 * y[0] * y[1] - 0.1 * y[2]]


@pytest.fixture(params=METHODS)
def name(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """Of a method whose equations are those above."""

    def put(t: float, y: Any, par: Any, dy: Any, *_: Any) -> None:
        dy[:3] = rates(t, y)

    for function in ("rates", "watched"):
        monkeypatch.setattr(METHODS[request.param], function, put, raising=False)
    return str(request.param)


def step(method: ModuleType, t: float, h: float) -> Any:
    """A step with its end, the rates within it, and what its dense output needs."""
    made = standing(method, START, t, h)
    made.k[:3] = rates(t, START)
    method.stages(made, np.zeros(0))
    method.prepared(made)
    return made


def standing(method: ModuleType, y: np.ndarray, t: float, h: float) -> Any:
    """A step at whose stages all rates are zero, and that ends at the origin."""
    rows: tuple[Any, ...] = (np.zeros(3), np.zeros(3 * method.KEPT), np.zeros(3 * method.BETWEEN), np.zeros(3))
    nothing: Any = np.zeros(0)
    return Step(t, h, 3, y, nothing, *rows)  # type: ignore[arg-type]


def test_a_step_is_that_of_scipy(name: str) -> None:
    """End, error in units of what is allowed, and the motion within: to rounding."""
    method, t, h, tolerance = METHODS[name], 0.4, 0.3, 1e-3
    made = step(method, t, h)
    end = made.end
    solver = SOLVERS[name](rates, t, START, 10.0, first_step=h, max_step=h, rtol=tolerance, atol=tolerance)
    solver.step()
    assert solver.t == t + h
    np.testing.assert_allclose(end, solver.y, rtol=1e-14)
    within, found = solver.dense_output(), np.zeros(3)
    for share in (0.0, 0.1, 0.37, 0.5, 0.9, 1.0):
        method.dense(share, 3, START, made.between, found)
        np.testing.assert_allclose(found, within(t + share * h), rtol=1e-13)
        alone = [method.within(i, share, 3, START, made.between) for i in range(3)]
        np.testing.assert_array_equal(alone, found)
    allowed = tolerance + tolerance * np.maximum(np.abs(START), np.abs(end))
    own = method.error(made, np.full(3, tolerance), np.full(3, tolerance))
    assert own == pytest.approx(solver._estimate_error_norm(solver.K, h, allowed), rel=1e-9)


def test_errors_fall_by_the_order(name: str) -> None:
    """Of one step by its order and one more; of the motion within it at least by that of the dense output."""
    method, errors, inner = METHODS[name], [], []
    steps = np.geomspace(0.05, 0.2, 5) if name == "rk45" else np.geomspace(0.2, 0.7, 5)
    for h in steps.tolist():
        exact = DOP853(rates, 0.0, START, h, rtol=1e-13, atol=1e-15)
        halfway = START
        while exact.status == "running":
            exact.step()
            if exact.t_old < h / 2 <= exact.t:
                halfway = exact.dense_output()(h / 2)
        made = step(method, 0.0, h)
        found = np.zeros(3)
        method.dense(0.5, 3, START, made.between, found)
        errors.append(np.abs(made.end - exact.y).max())
        inner.append(np.abs(found - halfway).max())
    order = {"rk45": (5, 4), "dop853": (8, 7)}[name]
    assert order[0] == method.METHOD_ORDER
    slopes = [np.polyfit(np.log(steps), np.log(each), 1)[0] for each in (errors, inner)]
    assert slopes[0] == pytest.approx(order[0] + 1, abs=0.8)
    assert slopes[1] > order[1] + 0.3


def test_a_motion_that_stands_has_no_error(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is divided by nothing."""
    method, zero = METHODS[name], np.zeros(3)
    assert method.error(standing(method, zero, 0.0, 0.1), np.ones(3), zero) == 0.0
