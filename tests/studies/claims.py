"""Whether the errors that `simulate` claims hold: scenes at random, at five accuracies, against a reference.

    python -m tests.studies.claims [scenes] [first]

The reference is two integrators of different kinds at tight tolerances; an error is only as sure as they agree. What a
scene costs beyond `MOST_EVALUATIONS` or `SECONDS` is not measured, and counted apart from what the product refuses.
"""

import math
import signal
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np

from abu_calc.dynamics.averaging.envelope import ball_rate
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.scene import Race, Scene, only, with_parted_balls
from abu_calc.dynamics.supports.planar import planar
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.simulation.model_level import WIDEST, difference, offer
from abu_calc.simulation.response import Response, evaluate, needed_times
from abu_calc.simulation.simulate import run_difference, simulate
from abu_calc.simulation.subject import chosen, simulate_chosen
from tests.dynamics.random_scenes import Dice, random_scene

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


def fast_transient(seed: int) -> Scene:
    """Balls far from rest on a fast hand-held rotor, for some tens of turns, with what is light at steady state.

    That is gravity, a race hardly eccentric, next to no friction.
    """
    dice = Dice(np.random.default_rng((seed, 801)))
    count, speed = int(dice.rng.integers(2, 6)), dice.log(5e3, 1e5) * math.tau / 60
    mass, pitch = dice.even(2, 10), dice.even(0.02, 0.04)
    race = Race(
        pitch, (dice.log(1e-3, 0.02),) * count, dice.log(3, 60), 1.4,
        tuple(dice.rng.uniform(-math.pi, math.pi, count).tolist()),
        (-speed if dice.often(0.2) else 0.0,) * count, 0.0, 0.005,
    )  # fmt: skip
    stiffness = mass * (math.tau * dice.log(2, 20)) ** 2
    support = planar(mass, (stiffness,) * 2, (2 * dice.log(0.02, 0.5) * math.sqrt(stiffness * mass),) * 2)
    effects = [RaceEccentricityEffect(dice.log(1e-11, 1e-6), dice.even(-3, 3))] if dice.often(0.6) else []
    effects += [GravityEffect()] if dice.often(0.7) or not effects else []
    effects += [DryRollingFrictionEffect(dice.log(1e-11, 1e-7), 0.005)] if dice.often(0.4) else []
    duration = dice.log(20, 300) * math.tau / speed
    return Scene(
        f"transient {seed}", support, speed, race.static_moment * dice.even(0.05, 0.9), 0.0, (race,), duration,
        (0.0, 0.0), (0.0, 0.0), effects=tuple(effects),
    )  # fmt: skip


def transient_judged(seed: int) -> list[Verdict]:
    """A fast transient at each accuracy that drops effects, with the effects it calls for, against all of them."""
    scene, _ = with_parted_balls(fast_transient(seed))
    verdicts, reference_run = [], None
    for accuracy in ACCURACIES[:3]:
        try:
            with limited(SECONDS):
                ledger, run = simulate_chosen(chosen(scene, accuracy), accuracy, most_evaluations=MOST_EVALUATIONS)
        except NotTrustworthyError as error:
            verdicts.append(Verdict(seed, accuracy, refused=str(error)))
            continue
        if reference_run is None:
            with limited(SECONDS):
                reference_run = reference(scene)
        true, unsure = reference_run
        left_out = sum(not entry.included for entry in ledger.entries)
        claim, error = run.error_estimate + ledger.spared, run_difference(scene, run.response, true)
        verdicts.append(Verdict(seed, accuracy, claim, error, unsure, f"{run.rung}, {left_out} left out"))
    return verdicts


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
    fast, lost = study(range(first, first + 2 * count // 3), transient_judged)
    left_out = sum("0 left out" not in one.by for one in fast if not one.refused)
    print(f"fast transients {summary(fast)}   with effects left out: {left_out}   not measured: {lost}")
    for one in fast:
        if one.broken > 1:
            print(f"  broken: {one}")
    print(f"envelope {summary(slow)}   not measured: {missed}")
    for one in slow:
        if one.broken > 1:
            print(f"  broken: {one}")


if __name__ == "__main__":
    main()
