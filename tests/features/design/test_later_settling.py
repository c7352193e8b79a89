"""The action on the idle level names the settling limit that it breaks, and no other."""

import math

import pytest

from abu_calc.features.design import later_settling
from abu_calc.features.design.later_settling import with_later_settling
from abu_calc.features.design.verification import Proven
from abu_calc.foundation.checks import Check
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.ensemble import simulate_members
from abu_calc.sizing import size
from abu_calc.sizing.design import Design

ENTRIES = ("autobalancer.race_eccentricity_mm=0.005", "autobalancer.ball_count=5")


def design(name: str) -> Design:
    return size(read_machine(name).whole("size"))


@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("time", "said"),
    [
        (0.9, ""),
        (math.nan, ""),
        (1.31, ' ABU702 then fails: start case "{}" settles in 1.31 s (limit 1 s, simulated).'),
        (math.inf, ' ABU701 then fails: start case "{}" does not balance (simulated).'),
    ],
)
def test_the_action_says_which_limit_it_breaks(time: float, said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    sized = design("msh-230")
    tried = Proven(sized, simulate_members(sized))
    asked = list[object]()

    def settles(_: object, start: object, entries: object, __: float) -> float:
        asked.append((start, entries))
        return time

    monkeypatch.setattr(later_settling, "settling_time_with", settles)
    check = Check("ABU401", "level", "warn", "loud", 113.0, 109.0, "dB", "Set it.", overrides=ENTRIES)
    assert tried.ensemble is not None
    slowest = max(tried.ensemble.given, key=lambda outcome: outcome.settling_time_or_inf)
    assert with_later_settling(check, tried, 0.01).remedy == "Set it." + said.format(slowest.member.name)
    assert asked[0] == (slowest, {"autobalancer.race_eccentricity_mm": 0.005})


def test_an_action_without_entries_stays() -> None:
    sized = design("msh-230")
    check = Check("ABU401", "level", "fail", "loud", 113.0, 109.0, "dB", "Use a heavier machine.")
    assert with_later_settling(check, Proven(sized, simulate_members(sized)), 0.01) is check
