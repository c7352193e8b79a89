"""What an event costs in compiled code, in evaluations of the same equations, from 2 to 32 balls.

    python -m tests.benchmarks.events

A horizontal grinder at a tolerance of 1e-4, its balls sticking, slipping and touching, beside the same scene without
friction and contact; what the events cost is the time of the one less that of the other. Times are CPU times of the
integration alone, the best of many; an evaluation's, that of rates and watched numbers by themselves.
"""

import math
import time
from dataclasses import replace

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators.compiled.run import integrate
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.simulation.response import needed_times
from tests.benchmarks.bare import evaluation_times
from tests.benchmarks.measuring import keep, machine
from tests.dynamics.scenes import straight_grinder, with_effects

BALLS = 2, 4, 8, 16, 32
TOLERANCE = 1e-4
ROUNDS = 5


def scene(balls: int) -> Scene:
    """The straight grinder with as many balls of together the same mass, side by side."""
    base, radius, pitch = straight_grinder(), 0.008 * math.sqrt(2 / balls) / 1.5, 0.023
    step = 2.02 * math.asin(radius / pitch)
    angles = tuple(0.35 + step * (k - (balls - 1) / 2) for k in range(balls))
    race = replace(
        base.races[0], ball_masses=(0.067 / balls,) * balls, start_angles=angles, start_speeds=(0.0,) * balls
    )
    bare = replace(base, races=(race,), duration=0.5)
    return with_effects(bare, GravityEffect(), BallContactEffect(radius, 0.5), DryRollingFrictionEffect(4e-6, radius))


def timed(equations: Equations) -> tuple[Trajectory, float]:
    """A run and its time [s]."""
    times, spent = needed_times(equations.scene), []
    for _ in range(10):
        begun = time.process_time()
        found = integrate(equations, TOLERANCE, times)
        spent.append(time.process_time() - begun)
    return found, min(spent[1:])


def main() -> None:
    """Print the table, and keep the record."""
    rows = []
    for balls in BALLS:
        switching = scene(balls)
        smooth = replace(switching, effects=switching.effects[:1])
        both = assemble(switching), assemble(smooth)
        # In turn, so that all meet the machine's best moments.
        rounds = [(timed(both[0]), timed(both[1]), evaluation_times(both[0])[1]) for _ in range(ROUNDS)]
        (run, _), (calm, _), _ = rounds[0]
        spent, idle = (min(one[k][1] for one in rounds) for k in (0, 1))
        evaluation = min(one[2] for one in rounds)
        event = (spent - idle) / run.events
        rows.append({
            "balls": balls, "events": run.events, "evaluations": run.evaluations, "cpu_s": spent,
            "smooth_evaluations": calm.evaluations, "smooth_cpu_s": idle, "evaluation_s": evaluation, "event_s": event,
            "evaluations_per_event": event / evaluation,
        })  # fmt: skip
        print(f"{balls:3} balls: {run.events} events, {1e6 * evaluation:.2f} µs an evaluation, {1e6 * event:.1f} µs an "
              f"event, {event / evaluation:.1f} evaluations", flush=True)  # fmt: skip
    first, last = rows[0], rows[-1]
    order = math.log(last["event_s"] / first["event_s"]) / math.log(last["balls"] / first["balls"])
    print(f"an event costs balls^{order:.2f}")
    cases = {"rows": rows, "order": order}
    print(keep("events", "cost of an event", "python -m tests.benchmarks.events", machine("not bound"), 0, cases))


if __name__ == "__main__":
    main()
