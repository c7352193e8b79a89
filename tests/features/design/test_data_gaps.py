"""Assumed values of a file: which are listed, and that following one end gives the numbers told."""

from dataclasses import replace

import pytest

from abu_calc.features.design.changes import RANGES, SLOWEST, DataGap, assumed_values, data_gaps
from abu_calc.features.design.study import SizeResult, size
from abu_calc.features.design.tables import gap_table
from abu_calc.inputs.autobalancer import Autobalancer
from abu_calc.inputs.read_machine import Machine, read_machine
from abu_calc.reporting.blocks import Grid
from abu_calc.simulation.start_cases import StartOutcome
from abu_calc.sizing import size as size_design
from tests.remembered import recalled


@pytest.fixture(scope="module")
def machine() -> Machine:
    return read_machine("avtovaz-707-222")


@pytest.fixture(scope="module")
def sized(machine: Machine) -> SizeResult:
    found: SizeResult = recalled("size", machine)
    return found


def gap_of(sized: SizeResult, name: str) -> DataGap:
    return next(gap for gap in sized.data_gaps if gap.key == f"autobalancer.{name}")


def changed(machine: Machine, sized: SizeResult, **entries: object) -> SizeResult:
    abu = sized.autobalancer
    pinned = {"ball_count": abu.ball_count, "ball_diameter_mm": abu.ball_diameter_mm, "race_radius_mm": 31.0, **entries}
    return size(machine.changed({f"autobalancer.{key}": value for key, value in pinned.items()}))


def promised(result: SizeResult) -> list[StartOutcome]:
    """All start cases that the machine promises."""
    assert result.starts.of is not None and result.starts.searched is not None
    return [*result.starts.of[1].given, *(each for each in result.starts.searched.outcomes if each.member.promised)]


@pytest.mark.few(0, 1)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "end"),
    [
        ("race_eccentricity_mm", 1),
        pytest.param("race_eccentricity_mm", 0, marks=pytest.mark.hard),
        pytest.param("rolling_friction_mm", 0, marks=pytest.mark.hard),
        ("rolling_friction_mm", 1),
    ],
)
def test_following_one_end_gives_the_numbers_told(machine: Machine, sized: SizeResult, name: str, end: int) -> None:
    gap = gap_of(sized, name)
    other = changed(machine, sized, **{name: gap.usual_range[end]})
    assert other.ensemble is not None and gap.quiet_time_s is not None
    assert gap.level_db[end] == pytest.approx(other.vibration.level_after_db, abs=1e-9)
    # The start cases that are slowest as the file stands; ensembles confirm such ones at a tighter tolerance.
    slowest = sorted(promised(sized), key=lambda outcome: -outcome.quiet_time_or_inf)[:SLOWEST]
    members = [outcome.member for outcome in slowest]
    same = [outcome.quiet_time_or_inf for outcome in promised(other) if outcome.member in members]
    assert len(same) == SLOWEST and gap.quiet_time_s[end] == pytest.approx(max(same), rel=0.02)


def test_drag_rates_are_those_of_usual_oils(machine: Machine, sized: SizeResult) -> None:
    """From a quarter to ten times; the same start cases, with the oil so hot as the given one of another machine."""
    gap = gap_of(sized, "rolling_drag_per_s")
    assert gap.usual_range == (3.75, 150.0) and gap.level_db[0] == gap.level_db[1] == sized.vibration.level_after_db
    for end, rate in enumerate(gap.usual_range):
        thin = changed(machine.changed({"autobalancer.rolling_drag_per_s": rate}), sized)
        assert thin.ensemble is not None and gap.quiet_time_s is not None
        at_rate = [row.quiet_time_s for row in thin.ensemble.settling_by_start if row.drag_per_s == rate]
        assert gap.quiet_time_s[end] == pytest.approx(max(map(float, filter(None, at_rate))), rel=0.02)


@pytest.mark.hard
def test_the_value_that_decides_the_verdict_is_first(machine: Machine, sized: SizeResult) -> None:
    """Hot oil is quiet within the limit of the file, but not within 0.6 s: there the drag rate decides, too.

    The eccentricity decides in both: balls of this capacity do not carry twice as much of it. Friction decides in none.
    """
    strict = changed(machine.changed({"limits.quiet_time_s": 0.6}), sized).data_gaps
    drag = next(gap for gap in strict if gap.key == "autobalancer.rolling_drag_per_s")
    low, high = drag.quiet_time_s or (None, None)
    assert low is not None and high is not None and low > 0.6 > high
    decide = [{gap.key.partition(".")[2] for gap in gaps if gap.decides} for gaps in (sized.data_gaps, strict)]
    assert decide == [{"race_eccentricity_mm"}, {"race_eccentricity_mm", "rolling_drag_per_s"}]
    for gaps in (sized.data_gaps, strict):
        ranks = [(gap.decides, gap.movement) for gap in gaps]
        assert ranks == sorted(ranks, reverse=True)


def test_defaults_are_the_assumed_figures() -> None:
    for key, usual in RANGES.items():
        place, name = key.split(".")
        assert usual.low < usual.assumed < usual.high
        if place == "autobalancer":
            assert Autobalancer.model_fields[name].default == usual.assumed


def test_what_a_file_leaves_out_counts_as_assumed(machine: Machine) -> None:
    tables = machine.whole("size")
    listed = dict(assumed_values(tables))
    plain = tables.model_copy(update={"autobalancer": tables.autobalancer.model_copy(
        update={"rolling_drag_per_s": 16.0, "rolling_friction_mm": 0.003})})  # fmt: skip
    assert set(listed) - set(dict(assumed_values(plain))) == {
        "autobalancer.rolling_drag_per_s", "autobalancer.rolling_friction_mm"
    }  # fmt: skip


def test_there_are_no_gaps_without_start_cases(machine: Machine) -> None:
    assert data_gaps(size_design(machine.whole("size")), None, (), 0.01) == ()


@pytest.mark.slow
def test_balls_that_cannot_carry_the_imbalance_have_no_gaps(machine: Machine) -> None:
    assert size(machine.changed({"wheel.measured_level_db": 128.0})).data_gaps == ()


def test_the_table_says_never_and_leaves_out_what_was_not_simulated(sized: SizeResult) -> None:
    gap = sized.data_gaps[0]
    never, unknown = replace(gap, quiet_time_s=(0.5, None)), replace(gap, quiet_time_s=None)
    (table,) = gap_table((never, unknown))
    assert isinstance(table, Grid) and [row[-1] for row in table.rows] == ["0.50 … never", ""]
    assert gap_table(()) == []
