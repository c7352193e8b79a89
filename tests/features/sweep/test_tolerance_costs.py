"""Values to tighten or to loosen, by closed forms in the place of runs."""

from typing import Any

import pytest

import abu_calc
from abu_calc.features.sweep.samples import Builds
from tests.features.sweep.conftest import ECCENTRICITY


@pytest.mark.slow
def test_only_what_was_tried_with_twice_its_scatter_may_be_loosened(
    machine: abu_calc.Machine, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Four values decide nothing as they scatter; of three the level or a limit suffers from twice as much."""
    calm, loud, heavy, cold = (
        "autobalancer.rolling_friction_mm", "wheel.imbalance_g_mm", "machine.mass_kg", "wheel.mass_kg",
    )  # fmt: skip

    def closed_form(self: Builds, values: Any, seed: int) -> Any:
        if values[cold] > 0.65:
            raise abu_calc.NotTrustworthyError("no number")
        level = 80 + 1e3 * values[ECCENTRICITY] + (20 if abs(values[loud] - 250) > 44 else 0) + 0.01 * values[calm]
        fine = values[heavy] < 6.0
        return level, 0.1, 0.2, 0.3, 1.0, 1.0, 1.2, True, True, True, True, fine

    monkeypatch.setattr(Builds, "numbers", closed_form)
    ways = {
        ECCENTRICITY: "uniform(0.004, 0.016)", calm: "lognormal(0.002, 0.5)", loud: "normal(250, 12)",
        heavy: "uniform(5.2, 5.9)", cold: "triangular(0.55, 0.6, 0.64)",
    }  # fmt: skip
    prices = {price.key: price for price in abu_calc.sweep(machine, ways, 800).prices}
    assert prices[ECCENTRICITY].advice == "tighten" and prices[ECCENTRICITY].gain_db == pytest.approx(6, abs=0.5)
    assert prices[ECCENTRICITY].loosened_of is None
    assert prices[calm].advice == "may be loosened" and prices[calm].loosened_db == pytest.approx(0, abs=0.01)
    assert prices[calm].loosened_to == "lognormal(0.002, 1)" and prices[calm].loosened_of == 80
    assert prices[loud].advice == "" and prices[loud].loosened_db > 0.5
    assert prices[heavy].advice == "" and prices[heavy].loosened_fail > 5
    assert prices[cold].advice == "" and prices[cold].loosened_fail > 5


def test_few_members_are_not_tried_with_more_scatter(
    machine: abu_calc.Machine, monkeypatch: pytest.MonkeyPatch
) -> None:
    numbers = 90.0, 0.1, 0.2, 0.3, 1.0, 1.0, 1.2, True, True, True, True, True
    monkeypatch.setattr(Builds, "numbers", lambda self, values, seed: numbers)
    result = abu_calc.sweep(machine, {ECCENTRICITY: "uniform(0.004, 0.016)"}, 100)
    assert result.prices and not any(price.advice or price.loosened_of for price in result.prices)
