"""Wright and Peng 2019: run-up and the chance to balance. Their numbers could not be had; these are numbers of ours.

Two balls on a grid of start angles, at rest in their race. Without a run-up the rotor turns at full speed at once.
"""

from typing import Final, NamedTuple

from abu_calc.dynamics.effects.run_up import RunUpEffect
from tests.benchmarks.published.runs import left_over, pairs, rotor

GRID: Final = 10
SETTLES: Final = 300.0
"""Time at full speed, over that of the natural frequency's radian."""

LEFT, STILL = 0.1, 0.05
"""A start balances if it leaves at most this share of the imbalance, at rates below this share of the speed."""

RUN_UPS: Final = (0.0, 5.0, 10.0, 20.0, 30.0, 60.0)
SETS: Final = {
    "the run-up decides": (3.0, 0.05, 0.05, 0.05, 0.05),
    "the run-up may be ignored": (3.0, 0.02, 0.02, 0.05, 0.4),
}
"""Speed, ball mass, imbalance, damping ratio and drag rate."""


class Share(NamedTuple):
    """Share of starts that balance after a run-up of some length."""

    name: str
    run_up: float
    share: float


def share(numbers: tuple[float, float, float, float, float], run_up: float) -> float:
    """Share of the starts that balance."""
    effects = (RunUpEffect(run_up),) if run_up else ()
    starts = [left_over(rotor(*numbers, start, SETTLES + run_up, effects), 1e-5) for start in pairs(GRID)]
    return sum(left <= LEFT and rate <= STILL for left, rate in starts) / len(starts)


def shares() -> list[Share]:
    """All shares."""
    return [Share(name, run_up, share(numbers, run_up)) for name, numbers in SETS.items() for run_up in RUN_UPS]
