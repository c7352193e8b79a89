"""The band that a verdict covers: what varies and how far, and by what its runs are judged.

The oil's part of a design's result and report.
"""

import math
import shlex
from dataclasses import replace
from itertools import islice
from typing import Any

import numpy as np
import pytest

import abu_calc
from abu_calc.features.design.band import (
    FRICTION,
    NATURAL_FREQUENCY,
    RUN_UPS,
    SPEED,
    OilRecord,
    band,
    corners,
    oil_blocks,
    promised,
    sequence,
    turned_in_use,
    usual,
    worse_wheels,
)  # fmt: skip
from abu_calc.features.design.start_search import SearchResult, fails
from abu_calc.features.design.starts import decisive, repeated
from abu_calc.formulas.oil import GRADES
from abu_calc.foundation.units import from_si
from abu_calc.reporting.blocks import Grid, Heading, Paragraph
from abu_calc.simulation.ensemble import first_tolerance, run_of_start
from abu_calc.simulation.start_cases import ALIKE, Ensemble, Member, StartOutcome, Variation, scene_of_member
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.cli.runner import abu
from tests.sizing.machines import PINNED, machine

AUTOBALANCER = {"max_outer_diameter_mm": 68.0, "max_width_mm": 32.0}


def design_of(**given: Any) -> Design:
    return size(machine(**{"autobalancer": AUTOBALANCER, **given}))


@pytest.fixture(scope="module")
def design() -> Design:
    return design_of()


def starts(design: Design) -> list[Member]:
    return [Member("bunched", design.case.drag)] * 60


def test_a_sequence_leaves_no_large_gap() -> None:
    """Of 64 points each of 16 equal slices of every axis has three to five; no two points are alike."""
    points = np.array(list(islice(sequence(slice(8)), 64)))
    for axis in points.T:
        assert np.histogram(axis, 16, (0, 1))[0].min() >= 3 and np.histogram(axis, 16, (0, 1))[0].max() <= 5
    assert len({tuple(point) for point in points}) == 64 and points.min() >= 0 and points.max() < 1


def test_promised_is_what_the_file_says_at_most(design: Design) -> None:
    members = list(promised(design, starts(design)))
    shares = [member.varied.race_eccentricity for member in members]
    imbalances = [member.varied.imbalance for member in members]
    assert 0 <= min(shares) < 0.05 and 0.95 < max(shares) <= 1
    assert 0.1 <= min(imbalances) < 0.15 and 10 < sum(share == 1 for share in imbalances) < 30 and max(imbalances) == 1
    assert {member.varied.spindle_axis for member in members} == {None, "vertical"}
    assert all(member.promised and member.drag == design.case.drag for member in members)
    assert all(member.varied.friction_arm == member.varied.natural_frequency == 1 for member in members)


def test_usual_stays_within_the_band_and_is_not_promised(design: Design) -> None:
    rows = {row.key: row for row in band(design)}
    assert [row.promised for row in rows.values()] == [True, True, *[False] * 6]
    for member in usual(design, starts(design)):
        assert not member.promised and member.speed is not None
        assert FRICTION[0] <= member.varied.friction_arm <= FRICTION[1]
        assert NATURAL_FREQUENCY[0] <= member.varied.natural_frequency <= NATURAL_FREQUENCY[1]
        assert SPEED[0] <= member.speed / design.case.speed <= SPEED[1]
        assert member.run_up == 0 or RUN_UPS[0] <= member.run_up <= RUN_UPS[1]
        assert 0 <= member.lag < 1 and not (member.lag and member.run_up)
        drag = rows["autobalancer.rolling_drag_per_s"]
        assert drag.low <= member.drag <= drag.high


def test_a_motor_runs_up_in_its_own_way() -> None:
    """So neither speeds nor run-ups nor restarts are varied, and no row says so."""
    motor = {"stall_torque_N_m": 3.0, "no_load_speed_rpm": 6200.0, "rotor_inertia_kg_m2": 1e-3}
    driven = design_of(motor=motor, run_up={"time_s": 1.0})
    keys = {"machine.speed_rpm", "run_up.time_s", "start.speeds_rpm"}
    assert keys <= {row.key for row in band(design_of())} and not keys & {row.key for row in band(driven)}
    placed = Member("placed", driven.case.drag, angles=(0.1, 1.3, 2.6, 4.0))
    members = list(usual(driven, [placed] * 6))
    assert len(members) == 6
    assert all(not member.lag and not member.run_up and member.speed is None for member in members)


def test_a_measured_imbalance_is_no_maximum(design: Design) -> None:
    """The usual band has wheels as bad as the margin of the capacity allows for; a given one is the worst."""
    found = design_of(wheel__imbalance_g_mm=None, wheel__measured_level_db=111.0)
    margin = found.case.autobalancer.capacity_margin
    assert margin > 1 and max(member.varied.imbalance for member in usual(found, starts(found))) == margin
    assert max(member.varied.imbalance for member in promised(found, starts(found))) == 1
    assert max(member.varied.imbalance for member in usual(design, starts(design))) == 1
    own = [row for row in band(found) if row.key == "wheel.imbalance_g_mm"]
    assert [row.promised for row in own] == [True, False] and own[1].high == pytest.approx(margin * own[0].high)


@pytest.mark.parametrize("interval", [None, [0.0015, 0.003], [0.002, 0.002]])
def test_worse_wheels_have_all_that_the_margin_allows_and_no_less_friction(interval: list[float] | None) -> None:
    """Only of a measured imbalance. The friction of an identified arm stays in its interval, be it a single value."""
    known = {} if interval is None else {"identified": {"rolling_friction_mm": interval}}
    of_level = design_of(wheel__imbalance_g_mm=None, wheel__measured_level_db=111.0, **known)
    members = list(worse_wheels(of_level, starts(of_level)))
    most = 2.0 if interval is None else interval[1] / 0.002
    assert len(members) == 60 and not any(member.promised for member in members)
    assert {member.varied.imbalance for member in members} == {of_level.case.autobalancer.capacity_margin}
    frictions = [member.varied.friction_arm for member in members]
    assert 1 <= min(frictions) <= 1 + 0.05 * (most - 1) and most - 0.05 * (most - 1) <= max(frictions) <= most
    assert not list(worse_wheels(design_of(), starts(design_of())))


@pytest.mark.parametrize(
    ("given", "any_position"),
    [
        ({}, True),
        ({"machine__held": "as-given"}, False),
        ({"suspension__natural_frequencies_hz": [8.5, 2.5]}, False),
        ({"suspension__natural_frequencies_hz": [8.5, 2.5], "machine__held": "any"}, True),
        ({"suspension": {"model": "hands"}}, True),
    ],
)
def test_what_is_held_in_the_hands_is_turned_in_use(given: dict[str, Any], any_position: bool) -> None:
    design = design_of(**given)
    assert turned_in_use(design) is any_position
    axes = {member.varied.spindle_axis for member in promised(design, starts(design))}
    assert axes == ({None, "vertical"} if any_position else {None})


def test_a_vertical_spindle_that_stays_so_has_no_corners() -> None:
    """Corners are those of gravity."""
    four = {**AUTOBALANCER, "ball_count": 4}
    assert not list(corners(design_of(machine__spindle_axis="vertical", machine__held="as-given", autobalancer=four)))
    turned = list(corners(design_of(machine__spindle_axis="vertical", autobalancer=four)))
    assert turned and all(member.varied.spindle_axis == "horizontal" for member in turned)
    assert not list(corners(design_of(autobalancer={**AUTOBALANCER, "ball_count": 5})))


def test_a_scene_has_what_varies_and_is_judged_by_the_file(design: Design) -> None:
    """Small motions, gravity and friction are those of the variation; quiet and at rest are judged as ever."""
    nominal = scene_of_member(design, Member("bunched", design.case.drag))
    varied = Variation(0.5, 0.25, 2.0, 1.2, "vertical")
    scene = scene_of_member(design, Member("bunched", design.case.drag, varied=varied))
    assert scene.imbalance == 0.25 * nominal.imbalance and scene.largest_imbalance == nominal.imbalance
    assert nominal.effect("gravity") is not None and scene.effect("gravity") is None
    true, smooth = (scene.effect(name) for name in ("race_eccentricity", "dry_rolling_friction"))
    assert getattr(true, "magnitude", None) == pytest.approx(0.5 * design.case.race_eccentricity)
    assert getattr(smooth, "lever_arm", None) == pytest.approx(2 * design.case.friction_arm)
    stiffness, before = (np.array(getattr(each.support, "stiffness")) for each in (scene, nominal))  # noqa: B009
    assert stiffness == pytest.approx(1.44 * before)
    new = scene_of_member(design, Member("bunched", design.case.drag, varied=Variation(imbalance=0.25)))
    assert new.quiet_velocity == nominal.quiet_velocity


def test_a_new_wheel_is_not_late_for_being_light(design: Design) -> None:
    """At a tenth of the imbalance balls cannot better it much; all the same the machine is quiet and balanced."""
    member = Member("behind", design.case.drag, 0.0, ALIKE, varied=Variation(imbalance=0.1))
    outcome = run_of_start(design, member, 0.01, first_tolerance(design)).outcome
    assert outcome.holds(design.case.table.limits, design.case.level_limit)


def outcome_of(member: Member, quiet: float, *, confirmed: bool = True) -> StartOutcome:
    return StartOutcome(member, quiet, quiet, quiet, False, 1e-6, 90.0, 0.0, 0.1, 1.0, confirmed=confirmed)


def test_the_decisive_run_is_the_worst_that_was_promised(design: Design) -> None:
    within, beyond = Member("bunched", design.case.drag), Member("spread", design.case.drag, promised=False)
    listed = Ensemble(design.case.drag, (outcome_of(within, 0.2),), ())
    late, later = outcome_of(within, 1.5), outcome_of(beyond, math.inf)
    assert decisive(design, listed, SearchResult((late, later))) is late
    assert decisive(design, listed, SearchResult((outcome_of(within, 0.3), later))) is later
    creeping = replace(outcome_of(within, 0.1), creeping=True)
    assert decisive(design, listed, SearchResult((creeping, later))) is later, "a limit is broken, not only feared for"
    assert decisive(design, listed, None) is listed.outcomes[0]
    assert fails(design, late) and not fails(design, later)
    assert not fails(design, outcome_of(within, 1.5, confirmed=False))


def test_the_printed_options_repeat_a_varied_run() -> None:
    """All that differs from the file stands in them, so that the same machine runs."""
    file = abu_calc.read("avtovaz-707-222")
    design = size(file.whole("size"))
    varied = Variation(0.3, 1.0, 0.7, 1.2, "vertical")
    member = Member("placed", 1.5 * design.case.drag, 0.0, 2.0, 0.97 * design.case.speed, angles=(0.1, 1.3, 2.6, 4.0),
                    varied=varied, promised=False)  # fmt: skip
    outcome = run_of_start(design, member, 0.01, first_tolerance(design)).outcome
    seen = abu("simulate", "avtovaz-707-222", *shlex.split(repeated(outcome, design)), "--json")
    assert seen.status == 0, seen.err
    result = seen.document["result"]
    assert result["quiet_time_s"] == pytest.approx(outcome.quiet_time, rel=0.02, abs=0.002)
    assert result["residual_imbalance_g_mm"] == pytest.approx(from_si(outcome.imbalance, "g_mm"), abs=1.0)


@pytest.mark.slow
def test_a_restart_begins_with_balls_that_turn_more_slowly() -> None:
    """Every third usual start; in the room balls turn at 1 − lag times the speed. The printed options repeat it."""
    design = size(abu_calc.read("avtovaz-707-222").whole("size"))
    placed = Member("placed", design.case.drag, angles=(0.1, 1.3, 2.6, 4.0))
    restarts = [member for member in islice(usual(design, [placed] * 30), 30) if member.lag]
    assert len(restarts) == 10 and max(member.lag for member in restarts) > 0.8
    member = replace(restarts[0], drag=design.case.drag, speed=None, varied=Variation(), lag=0.4)
    assert member.name == "restart, balls at 60 % of the speed"
    scene = scene_of_member(design, member)
    assert scene.races[0].start_speeds == pytest.approx([-0.4 * scene.speed] * 4)
    outcome = run_of_start(design, member, 0.01, first_tolerance(design)).outcome
    seen = abu("simulate", "avtovaz-707-222", *shlex.split(repeated(outcome, design)), "--json")
    assert seen.status == 0, seen.err
    assert seen.document["result"]["quiet_time_s"] == pytest.approx(outcome.quiet_time, rel=0.02, abs=0.002)


def test_identified_values_vary_within_their_intervals() -> None:
    """Friction from 1.5 to 3 µm where 2 µm are in force; an eccentricity up to 12 µm where 10 are."""
    identified = {"rolling_friction_mm": [0.0015, 0.003], "race_eccentricity_mm": [0.008, 0.012]}
    design = design_of(identified=identified)
    rows = {(row.key, row.promised): (row.low, row.high) for row in band(design)}
    assert rows["autobalancer.rolling_friction_mm", False] == pytest.approx((0.0015, 0.003))
    assert rows["autobalancer.race_eccentricity_mm", False] == pytest.approx((0.0, 0.012))
    assert rows["autobalancer.race_eccentricity_mm", True] == pytest.approx((0.0, 0.010))
    start = Member("bunched", design.case.drag)
    varied = [member.varied for member in islice(usual(design, [start] * 200), 200)]
    assert 0.75 <= min(each.friction_arm for each in varied) < 0.8 and 1.4 < max(e.friction_arm for e in varied) <= 1.5
    assert 1.0 < max(each.race_eccentricity for each in varied) <= 1.2


OIL = {"grade": "VG 46", "fill_ml": 2.0}


def test_the_record_gives_three_temperatures_with_bands_and_the_working_grade_again() -> None:
    design = size(machine(**{**PINNED, "oil": OIL, "autobalancer__rolling_drag_per_s": None}))
    record = OilRecord.of(design)
    assert record is not None and not record.overridden
    assert [each.state for each in record.temperatures] == ["cold", "at work", "hot"]
    work = record.temperatures[1]
    assert work.rolling_drag_per_s == design.case.drag
    assert (work.low_per_s * 3, work.high_per_s / 3) == pytest.approx((design.case.drag, design.case.drag))
    # The list of grades holds the oil itself, at the fill of the file.
    (fill,) = (each for each in record.fills if each.fill_ml == pytest.approx(2.0))
    assert fill.by_grade_per_s[GRADES.index(46)] == pytest.approx(design.case.drag)
    assert work.by_slip_per_s[1] == pytest.approx(design.case.drag)  # 0.5 m/s
    blocks = list(oil_blocks(record, 40.0))
    assert isinstance(blocks[0], Heading) and sum(isinstance(block, Grid) for block in blocks) == 2
    texts = [block.text for block in blocks if isinstance(block, Paragraph)]
    assert any("factor of 3" in text for text in texts) and any("die out fastest" in text for text in texts)


def test_without_oil_there_is_nothing() -> None:
    assert OilRecord.of(size(machine(**PINNED))) is None and list(oil_blocks(None, 40.0)) == []
