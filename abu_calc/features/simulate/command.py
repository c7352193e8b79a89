"""`abu simulate MACHINE|SCENE`: integrate one scene to a requested accuracy."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from abu_calc.cli.command import (
    Accuracy,
    Duration,
    File,
    Overrides,
    WhichScene,
    WhichStart,
    With,
    Without,
    add_command,
    option,
)
from abu_calc.cli.help import OUTPUT
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.foundation.errors import InputError
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.simulate.study import SimulateResult

    pass

SAMPLES: Final = 1001
METHOD: Final = "Method"
"""Panel of the options about the integration."""


RaceCentre = Annotated[
    float | None,
    option("--race-centre DEG", "Angle from the imbalance to the centre of the race; default 180, of two races 0."),
]
Integrator = Annotated[str, option("--integrator NAME", "auto, scipy, plain or compiled.", METHOD)]
TrajectoryFile = Annotated[Path | None, option("--trajectory FILE.csv", "Also write the motion.", OUTPUT)]
Samples = Annotated[int | None, option("--samples N", f"Times in the trajectory; default {SAMPLES}.", OUTPUT)]
MostEvaluations = Annotated[
    int | None,
    option("--most-evaluations N", "Most evaluations of the equations; default ten million, a minute or two.", METHOD),
]
Audit = Annotated[bool, option("--audit", "Repeat the run with every effect and report the difference.", METHOD)]


def simulate(
    how: Delivery,
    file: File,
    set_: Overrides = None,
    scene: WhichScene = None,
    start: WhichStart = None,
    race_centre_deg: RaceCentre = None,
    accuracy: Accuracy = 0.01,
    integrator: Integrator = "auto",
    duration_s: Duration = None,
    trajectory: TrajectoryFile = None,
    samples: Samples = None,
    with_effects: With = None,
    without_effects: Without = None,
    most_evaluations: MostEvaluations = None,
    audit: Audit = False,
) -> Outcome:
    """Simulate one scene: amplitude, level, quiet and rest time, ball angles."""
    from abu_calc.features.simulate.study import simulate as study
    from abu_calc.features.simulate.view import TrajectoryCsv
    from abu_calc.reporting.write import Target
    from abu_calc.simulation.scene_file import read_any

    _check_files(how, trajectory, samples)
    with progress(how) as tell:
        result = study(
            read_any(file, set_ or ()),
            scene,
            start,
            race_centre_deg=race_centre_deg,
            accuracy=accuracy,
            duration_s=duration_s,
            with_effects=with_effects or (),
            without_effects=without_effects or (),
            integrator=integrator,
            audit=audit,
            most_evaluations=most_evaluations,
            samples=(SAMPLES if samples is None else samples) if trajectory else None,
            progress=tell,
        )
    outcome = outcome_of(result)
    moved = (Target(trajectory, TrajectoryCsv(result.motion)),) if trajectory and result.motion else ()
    return replace(outcome, further=moved)


def _check_files(how: Delivery, trajectory: Path | None, samples: int | None) -> None:
    """Refuse what cannot be written before anything is computed."""
    from abu_calc.reporting.write import check_target

    if trajectory is None:
        if samples is not None:
            raise InputError("--samples goes with --trajectory", remedy="Add --trajectory FILE.csv.")
        return
    check_target(trajectory, force=how.force, suffixes=(".csv",), option="--trajectory")


def outcome_of(result: "SimulateResult") -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.simulate.view import simulate_blocks, simulate_screen

    return Outcome.of(result, lambda: simulate_blocks(result), lambda: simulate_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "simulate", simulate, simulates=True)
