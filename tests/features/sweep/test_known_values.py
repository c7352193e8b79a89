"""Scatter of machines whose values are identified, or whose drag follows from their oil."""

import math
from typing import Any

import pytest

from abu_calc.features.sweep.plan import DRAG, WARMTH, of_starts, of_tolerances
from abu_calc.inputs.read_machine import Machine, read
from abu_calc.sizing import size
from tests.sizing.machines import PINNED, machine

KNOWN = {"starts": 10, "rolling_drag_per_s": [12.0, 18.75], "rolling_friction_mm": [0.001, 0.004]}


def _read(**given: Any) -> Machine:
    return read(machine(**given).model_dump(exclude_unset=True))


@pytest.mark.slow
def test_tolerances_draw_from_identified_intervals() -> None:
    plain = dict(of_tolerances(size(machine(**PINNED)), building=True))
    tables = machine(**PINNED, identified=KNOWN)
    known = dict(of_tolerances(size(tables), building=True))
    assert DRAG not in plain and WARMTH in known
    for key, (low, high) in ((DRAG, (12.0, 18.75)), ("autobalancer.rolling_friction_mm", (0.001, 0.004))):
        # 95 % of a lognormal lie within 1.96 standard deviations: the interval is as wide as that of identify.
        kind, (median, spread) = known[key].kind, known[key].numbers
        assert kind == "lognormal" and low < median < high
        assert math.exp(2 * 1.96 * spread) == pytest.approx(high / low, rel=1e-4)
    assert known["autobalancer.race_eccentricity_mm"] == plain["autobalancer.race_eccentricity_mm"]
    assert DRAG not in dict(of_tolerances(size(tables), building=False))


def test_the_oil_of_the_file_gives_the_temperatures_of_starts() -> None:
    oil = {"grade": "VG 46", "fill_ml": 2.0, "cold_temperature_C": 10.0, "hot_temperature_C": 70.0}
    ways = dict(of_starts(_read(**PINNED, oil=oil), frozenset()))
    assert DRAG not in ways
    assert ways[WARMTH].numbers == pytest.approx((10.0, 40.0, 70.0))
    assert DRAG in dict(of_starts(_read(**PINNED), frozenset()))
