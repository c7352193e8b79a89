"""Figures of the study of known machines: differences, intervals, summaries."""

import math

import pytest

from tests.studies.identification import NAMES, holds, known_machine, off, summary


def row(drag: float) -> dict[str, object]:
    values = dict.fromkeys(NAMES) | {NAMES[0]: {"value": drag, "low": 9.0, "high": 13.0}}
    return {"truth": dict.fromkeys(NAMES, 10.0), "values": values, "checks": {}}


def test_differences_and_intervals_by_hand() -> None:
    assert off(NAMES[0], 11.0, 10.0) == pytest.approx(math.log(1.1))
    assert off(NAMES[2], 0.012, 0.010) == pytest.approx(2.0)
    assert off(NAMES[3], -179.0, 179.0) == pytest.approx(2.0)
    around = {"value": 179.0, "low": 175.0, "high": 183.0}
    assert holds(NAMES[3], around, -178.0) and not holds(NAMES[3], around, -170.0)
    assert not holds(NAMES[0], {"value": 11.0, "low": 10.5, "high": 12.0}, 10.0)


def test_a_summary_counts_what_was_given() -> None:
    told = summary([row(11.0), row(14.0)])
    assert told[NAMES[0]]["given"] == 2 and told["intervals"] == 2 and told["held"] == 2
    assert told[NAMES[0]]["rms"] == pytest.approx(math.hypot(math.log(1.1), math.log(1.4)) / math.sqrt(2), abs=1e-3)
    assert NAMES[1] not in told


def test_every_fourth_machine_is_vertical_and_all_lie_in_the_range_of_the_study() -> None:
    machines = [known_machine(seed) for seed in range(40)]
    assert [not each.horizontal for each in machines] == [seed % 4 == 3 for seed in range(40)]
    assert all(5 <= each.truth[NAMES[0]] <= 60 and 0.0007 <= each.truth[NAMES[1]] <= 0.015 for each in machines)
