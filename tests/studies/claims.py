"""Whether the errors that `simulate` claims hold: scenes at random, at five accuracies, against a reference.

    python -m tests.studies.claims [scenes] [first]

The reference is two integrators of different kinds at tight tolerances; an error is only as sure as they agree. What a
scene costs beyond `MOST_EVALUATIONS` or `SECONDS` is not measured, and counted apart from what the product refuses.
"""

import signal
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

from abu_calc.dynamics.averaging.envelope import ball_rate
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.scene import Scene, only, with_parted_balls
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.simulation.model_level import WIDEST, offer
from abu_calc.simulation.nonconvergence import difference
from abu_calc.simulation.response import Response, evaluate, needed_times
from abu_calc.simulation.simulate import simulate
from tests.dynamics.random_scenes import random_scene

ACCURACIES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
TIGHT = 2e-6
"""Accuracy for which two integrators are asked for, as tight as they go: 2e-11 and 2e-13."""
MOST_EVALUATIONS = 400_000
SECONDS = 15
SLOW_TIMES, MOST_TURNS = 12, 150
"""How long the envelope is followed: in times of the balls' own rate, and at most in revolutions."""


class TooLongError(Exception):
    """More than the study has time for."""


@dataclass(frozen=True)
class Verdict:
    """One simulation: what it claims, how far it is off, how sure that is; or why there is none."""

    seed: int
    accuracy: float
    claim: float = 0.0
    error: float = 0.0
    unsure: float = 0.0
    by: str = ""
    refused: str = ""

    @property
    def broken(self) -> float:
        """By how many times the error exceeds the claim, as far as the reference can tell; below 1 where it holds."""
        return max(self.error - self.unsure, 0.0) / self.claim if self.claim else 0.0


@contextmanager
def limited(seconds: int) -> Iterator[None]:
    """Raise TooLongError after so many seconds."""

    def stop(*_: object) -> None:
        raise TooLongError

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def reference(scene: Scene) -> tuple[Response, float]:
    """The better of two runs, and how far they are apart."""
    equations, moments = assemble(scene), needed_times(scene)
    runs = [
        evaluate(scene, choice.integrate_with(name, equations, tolerance, moments, MOST_EVALUATIONS))
        for name, tolerance in choice.verifiers(equations, TIGHT)
    ]
    return runs[1], difference(scene, runs[0], runs[1])


def judged(seed: int, accuracies: tuple[float, ...] = ACCURACIES) -> list[Verdict]:
    """A random scene at each accuracy. Raises TooLongError, or NotTrustworthyError where there is no reference."""
    scene, _ = with_parted_balls(random_scene(seed))
    refused, runs = {}, {}
    for accuracy in accuracies:
        try:
            with limited(SECONDS):
                runs[accuracy] = simulate(scene, accuracy, most_evaluations=MOST_EVALUATIONS)
        except NotTrustworthyError as error:
            refused[accuracy] = str(error)
    found = [Verdict(seed, accuracy, refused=reason) for accuracy, reason in refused.items()]
    if not runs:
        return found
    with limited(SECONDS):
        true, unsure = reference(scene)
    return found + [
        Verdict(seed, accuracy, run.error_estimate, difference(scene, run.response, true), unsure,
                f"{run.rung} {run.cost.integrator}")
        for accuracy, run in runs.items()
    ]  # fmt: skip


def averaged_and_judged(seed: int) -> list[Verdict]:
    """The smooth part of a random scene, followed for longer, by the envelope alone where it may be taken."""
    scene = random_scene(seed)
    scene, _ = with_parted_balls(only(scene, [one.name for one in scene.effects if one.name == "race_eccentricity"]))
    turns = min(SLOW_TIMES / (ball_rate(scene) * scene.revolution), MOST_TURNS)
    scene = replace(scene, duration=max(turns, 10) * scene.revolution)
    slow = offer(scene, WIDEST, needed_times(scene))
    if slow.trajectory is None or slow.error is None:
        return []
    with limited(SECONDS):
        true, unsure = reference(scene)
    return [Verdict(seed, WIDEST, slow.error, difference(scene, evaluate(scene, slow.trajectory), true), unsure)]


def study(seeds: Iterable[int], judge: Callable[[int], list[Verdict]]) -> tuple[list[Verdict], list[int]]:
    """All verdicts, and the scenes that were not measured."""
    verdicts: list[Verdict] = []
    unmeasured = []
    for seed in seeds:
        try:
            verdicts += judge(seed)
        except (TooLongError, NotTrustworthyError):
            unmeasured.append(seed)
    return verdicts, unmeasured


def summary(verdicts: list[Verdict]) -> str:
    """Claims that hold, the worst, and how large they are beside the errors."""
    claims = sorted(one.claim / max(one.error, 1e-300) for one in verdicts if not one.refused)
    broken = [one for one in verdicts if one.broken > 1]
    worst = max((one.broken for one in verdicts), default=0.0)
    middle = f"{claims[len(claims) // 2]:.0f}" if claims else "-"
    refused = sum(bool(one.refused) for one in verdicts)
    return f"{len(claims):5} {len(broken):7} {worst:6.2g} {middle:>8} {refused:8}"


def main() -> None:
    """Print the tables."""
    count, first = (int(sys.argv[k]) if len(sys.argv) > k else value for k, value in ((1, 300), (2, 0)))
    seeds = range(first, first + count)
    verdicts, unmeasured = study(seeds, judged)
    print("accuracy  runs  broken  worst  claim/error (median)  refused")
    for accuracy in ACCURACIES:
        print(f"{accuracy:8g} {summary([one for one in verdicts if one.accuracy == accuracy])}")
    for one in verdicts:
        if one.broken > 1:
            print(f"  broken: {one}")
        if one.refused:
            print(f"  refused: {one.accuracy:g} {one.refused.splitlines()[0]}")
    print(f"not measured, more than {SECONDS} s or no reference: {unmeasured}")
    slow, missed = study(seeds, averaged_and_judged)
    print(f"envelope {summary(slow)}   not measured: {missed}")
    for one in slow:
        if one.broken > 1:
            print(f"  broken: {one}")


if __name__ == "__main__":
    main()
