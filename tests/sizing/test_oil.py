"""The drag of a design by its oil."""

import pytest

from abu_calc.foundation.errors import InputError, RangeError
from abu_calc.simulation.start_cases import members
from abu_calc.sizing import size
from abu_calc.sizing.design import built
from abu_calc.sizing.oil import FACTOR, drag_share, drag_source
from tests.sizing.machines import PINNED, machine

OIL = {"grade": "VG 46", "fill_ml": 2.0}


def oiled(**changes: object):  # type: ignore[no-untyped-def]
    """A design with oil."""
    return size(machine(**{**PINNED, "oil": OIL, "autobalancer__rolling_drag_per_s": None, **changes}))


def test_drag_rates_of_start_cases_are_those_of_working_hot_and_cold_oil() -> None:
    design = oiled()
    oil = design.case.oil
    assert oil is not None and design.case.drag == oil.working.drag
    assert (oil.cold.temperature, oil.working.temperature, oil.hot.temperature) == (5.0, 40.0, 80.0)
    assert oil.hot.drag < oil.working.drag < oil.cold.drag
    rates = {member.drag for member in members(design)}
    assert sorted(rates) == pytest.approx([oil.hot.drag, oil.working.drag, oil.cold.drag])
    assert [drag for drag, _ in design.track.decay_rates] == pytest.approx(
        [oil.working.drag, oil.hot.drag, oil.cold.drag]
    )
    assert f"factor of {FACTOR:g}" in drag_source(design.case)
    assert drag_share(design.case, design.autobalancer, 5.0) == pytest.approx(oil.shares[2])


@pytest.mark.slow
def test_a_given_rate_overrides_the_oil_and_keeps_its_ratios() -> None:
    design = oiled(autobalancer__rolling_drag_per_s=15.0)
    oil = design.case.oil
    assert oil is not None and oil.overridden and design.case.drag == 15.0
    assert "overrides" in drag_source(design.case)
    assert sorted({member.drag for member in members(design)}) == pytest.approx(
        [15 * oil.shares[1], 15.0, 15 * oil.shares[2]]
    )
    assert oil.shares == pytest.approx(oiled().case.oil.shares)


def test_without_oil_nothing_changes() -> None:
    design = size(machine(**PINNED))
    assert design.case.oil is None and design.case.drag_shares == (1.0, 1 / 3, 3.0)
    with pytest.raises(ValueError, match="the file has no"):
        drag_source(design.case)


@pytest.mark.slow
def test_more_viscous_or_more_oil_gives_more_drag_and_one_machine_has_that_of_its_design() -> None:
    drags = [oiled(oil={**OIL, "grade": grade}).case.drag for grade in ("VG 10", "VG 46", "VG 220")]
    assert drags == sorted(drags) and drags[2] > 5 * drags[0]
    more = [oiled(oil={**OIL, "fill_ml": fill}).case.drag for fill in (0.5, 2.0, 8.0)]
    assert more == sorted(more)
    design = oiled()
    assert built(design, design.case.table).case.drag == pytest.approx(design.case.drag)


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"oil": {**OIL, "fill_ml": 500.0}}, "oil.fill_ml"),
        ({"autobalancer__corrector": "roller"}, "oil"),
        ({"oil": {**OIL, "slip_m_per_s": 50.0, "viscosity_mm2_per_s": 5.0, "grade": None}}, None),
        ({"machine__speed_rpm": 300.0, "machine__speed_range_rpm": [300.0, 300.0]}, None),
    ],
)
def test_oil_that_the_race_cannot_hold_or_the_formula_cannot_judge_is_refused(
    changes: dict[str, object], key: str | None
) -> None:
    with pytest.raises((InputError, RangeError)) as found:
        oiled(**changes)
    assert key is None or found.value.place.key == key
