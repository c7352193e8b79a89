"""The report of a sweep: shares as bars and signs, charts, what to tighten and to loosen."""

from dataclasses import replace

import pytest

from abu_calc.features.sweep.result import Chart, Price, Sensitivity
from abu_calc.features.sweep.view import (
    change,
    chart_blocks,
    few,
    percent,
    side_kept,
    sweep_blocks,
    sweep_screen,
    words_of,
)
from abu_calc.reporting.blocks import Grid, Picture
from abu_calc.reporting.screen import as_text
from tests.features.sweep.conftest import Sweeps

CHART = Chart(
    x_key="wheel.mass_kg", y_key="machine.speed_rpm", x=(1.0, 2.0, 3.0), y=(10.0, 20.0), of="balances",
    shares=((0.0, 0.2, None), (0.5, 0.9, 1.0)), meets=((0.0, 0.0, None), (0.0, 0.0, 0.0)), levels_db=None,
)  # fmt: skip


def test_a_chart_has_its_second_key_upward() -> None:
    pictures = [block for block in chart_blocks(CHART) if isinstance(block, Picture)]
    assert len(pictures) == 2
    upper, lower = (line.partition(" ") for line in pictures[0].lines[:2])
    assert (float(upper[0]), float(lower[0])) == (20.0, 10.0)
    wide = len(upper[2]) // 3
    assert upper[2][::wide] == "▒▓█" and lower[2][::wide] == "·░ "
    (short,) = [block for block in chart_blocks(CHART, short=True) if isinstance(block, Picture)]
    assert short == pictures[0]  # the other field is the same everywhere


def test_a_share_is_whole_only_where_it_is() -> None:
    shares = {0.0: "0 %", 0.5: "50 %", 0.9949: "99.5 %", 0.9999: "99.99 %", 1.0: "100 %"}
    assert {share: percent(share) for share in shares} == shares


def test_more_values_than_room_are_thinned_evenly() -> None:
    assert few(5, 60) == [0, 1, 2, 3, 4] and few(7, 3) == [0, 3, 6]
    assert all(len(few(count, 60)) <= 60 for count in range(1, 500))


def test_names_become_words_and_changes_have_signs() -> None:
    assert words_of("worst_quiet_time_s") == "worst quiet time" and words_of("rest_time_s") == "rest time"
    assert words_of("residual_imbalance_g_mm") == "residual imbalance" and words_of("ball_count") == "ball count"
    assert [change(level) for level in (None, -0.04, 0.26, -3.0)] == ["none", "+0.0 dB", "+0.3 dB", "-3.0 dB"]


def test_values_to_tighten_and_to_loosen_stand_in_tables_of_their_own(sweeps: Sweeps) -> None:
    tight = Price(key="wheel.runout_mm", better="lower", median=0.04, gain_db=6.0, cost_db=1.5, within_chance=False,
                  advice="tighten")  # fmt: skip
    loose = Price(key="machine.mass_kg", better="upper", median=5.6, gain_db=0.1, cost_db=0.1, within_chance=True,
                  loosened_to="normal(5.6, 0.2)", loosened_db=0.2, loosened_fail=0, loosened_of=64,
                  advice="may be loosened")  # fmt: skip
    assert side_kept(tight) == "to 0.04000 mm" and side_kept(loose) == "from 5.600 kg"
    result = replace(sweeps.run(), prices=(tight, loose))
    rows = [row for block in sweep_screen(result) if isinstance(block, Grid) for row in block.rows]
    assert ("wheel.runout_mm", "to 0.04000 mm", "-6.0 dB", "+1.5 dB") in rows
    assert ("machine.mass_kg", "normal(5.6, 0.2)", "+0.2 dB", "0") in rows


def test_values_that_decide_little_are_only_counted(sweeps: Sweeps) -> None:
    strong, weak = Sensitivity(key="a", first_order=0.9, total=1.0), Sensitivity(key="b", first_order=0.0, total=0.005)
    result = replace(
        sweeps.run(), sensitivity_of="level_db", sensitivity_by_quantity={"level_db": (strong, weak)},
        unexplained={"level_db": 0.25}, prices=(),
    )  # fmt: skip
    text = " ".join(as_text(sweep_blocks(result), 100).split())
    assert "1 other value has less influence." in text
    assert "25 % of the variance follows from no single value or pair of values." in text
    assert "a █" in text and "b █" not in text


@pytest.mark.slow
def test_one_machine_is_counted_as_one(sweeps: Sweeps) -> None:
    result = sweeps.run(runs=12)
    one = replace(result, meets_limits=replace(result.meets_limits, of=1, share=1.0))
    text = " ".join(as_text(sweep_screen(one), 80).split())
    assert "1 machine built to one design meets the limits" in text and "1 machines" not in text
    none = replace(one, meets_limits=replace(one.meets_limits, share=0.0))
    assert "1 machine built to one design does not meet the limits" in as_text(sweep_screen(none), 200)
