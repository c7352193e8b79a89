"""Amplitude against speed of a simulated run-up of two races, with balls and without autobalancers."""

from dataclasses import replace

from abu_calc.features.two_races.choice import TwoRaceDesign
from abu_calc.features.two_races.start_cases import scene_of, start
from abu_calc.foundation.frozen import dataclass
from abu_calc.simulation.run_up_amplitude import course, until_shortly_after, without_balls


@dataclass(frozen=True)
class RunUpAmplitude:
    """Largest displacement of any place [m] about its mean in a revolution, at a speed [rad/s]; None: not simulated."""

    speed: float
    with_balls: float | None
    without: float


def run_up_amplitudes(design: TwoRaceDesign, accuracy: float) -> tuple[RunUpAmplitude, ...]:
    """The run-up with the balls together, imbalances of unknown phase in phase; both machines run up alike."""
    run_up = start(design, "run-up")
    scene = until_shortly_after(scene_of(design, run_up))
    bare = replace(without_balls(scene_of(replace(design, case=design.bare), run_up)), duration=scene.duration)
    planes = [held.place for held in design.case.places]
    with_balls, empty = course(scene, planes, accuracy), course(bare, planes, accuracy)
    if empty is None:
        return ()
    return tuple(
        RunUpAmplitude(speed, None if with_balls is None else with_balls[index][1], amplitude)
        for index, (speed, amplitude) in enumerate(empty)
    )
