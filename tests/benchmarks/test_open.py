"""The open benchmark: references, error measure, entries, runner."""

import math
import shlex
import sys
from pathlib import Path

import pytest

from tests.benchmarks.open import abu_entry
from tests.benchmarks.open.__main__ import held, main
from tests.benchmarks.open.files import case_of, case_path, names, reference_of
from tests.benchmarks.open.measure import errors


def test_errors_are_relative_of_the_axis_and_round_the_circle_of_the_balls() -> None:
    reference = [[3.0, 4.0, 1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 2.0, 0.0, 0.0, 0.0]]
    moved = [[3.0, 4.5, 1.0 + math.tau, 0.0, 0.0, 0.0], [0.0, 1.0, 2.25, 0.0, 0.0, 0.0]]
    assert errors(moved, reference, 1) == pytest.approx((0.1, 0.25))
    assert errors([[math.nan] * 6] * 2, reference, 1) == (math.inf, math.inf)
    with pytest.raises(ValueError, match="shape"):
        errors(reference[:1], reference, 1)


@pytest.mark.parametrize("name", names())
def test_abu_calc_comes_within_eight_digits_of_each_reference(name: str) -> None:
    case, reference = case_of(case_path(name)), reference_of(name)
    assert max(reference["differ_axis"], reference["differ_balls_rad"]) <= 1e-10
    states = abu_entry.solved(case, 1e-11)
    assert max(errors(states, reference["states"], len(case["ball_masses_kg"]))) < 1e-8


def test_a_program_of_anyone_is_held_against_the_reference(tmp_path: Path) -> None:
    script = tmp_path / "mine.py"
    script.write_text(
        "import json, sys\ncase = json.load(open(sys.argv[1]))\n"
        "start = [*case['start_place_m'], *case['start_angles_rad'], 0, 0, *case['start_rates_rad_per_s']]\n"
        "print(json.dumps({'states': [start] * len(case['times_s'])}))\n",
        encoding="utf-8",
    )
    axis, balls, _ = held("stuck", f"{shlex.quote(sys.executable)} {shlex.quote(str(script))}")
    # It never moves: the axis is off by all of its way.
    assert axis == pytest.approx(1.0) and balls > 1


@pytest.mark.parametrize("arguments", [[], ["nothing", "abu"], ["stuck", f"{shlex.quote(sys.executable)} -c 1/0"]])
def test_the_runner_says_what_is_wrong(arguments: list[str]) -> None:
    with pytest.raises(SystemExit, match=r"Cases:|ended with"):
        main(arguments)


@pytest.mark.slow
def test_the_script_of_scipy_is_an_entry() -> None:
    axis, balls, _ = held("hand-grinder", "scipy")
    assert max(axis, balls) < 1e-7
