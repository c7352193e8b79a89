"""`abu simulate MACHINE|SCENE`: integrate one scene to the accuracy asked for."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from abu_calc.checks import Check, overall, verdict
from abu_calc.cli.command import Overrides, add_command
from abu_calc.cli.deliver import Delivery
from abu_calc.cli.subject import SCENES, File, one_of, subject_of
from abu_calc.errors import InputError, Place
from abu_calc.report.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.analysis.simulate import Simulation

INTEGRATORS: Final = ("auto", "scipy")
SAMPLES: Final = 1001
MOST_SAMPLES: Final = 1_000_000


def simulate(
    how: Delivery,
    file: File,
    set_: Overrides = None,
    scene: Annotated[str | None, typer.Option("--scene", help=f"Of a machine: {', '.join(SCENES)}.")] = None,
    start: Annotated[
        str | None, typer.Option("--start", help="Balls of a machine: bunched (default), spread, standstill.")
    ] = None,
    accuracy: Annotated[float, typer.Option("--accuracy", help="Accuracy asked of the results.")] = 0.01,
    integrator: Annotated[str, typer.Option("--integrator", help="auto, scipy or heyoka.")] = "auto",
    duration: Annotated[float | None, typer.Option("--duration", metavar="S", help="Seconds to simulate.")] = None,
    trajectory: Annotated[
        Path | None, typer.Option("--trajectory", metavar="FILE.csv", help="Also write the motion.")
    ] = None,
    samples: Annotated[
        int | None, typer.Option("--samples", metavar="N", help=f"Moments in the trajectory; default {SAMPLES}.")
    ] = None,
    with_: Annotated[list[str] | None, typer.Option("--with", metavar="EFFECT", help="Add an effect.")] = None,
    without: Annotated[list[str] | None, typer.Option("--without", metavar="EFFECT", help="Leave one out.")] = None,
) -> Outcome:
    """Integrate one scene: amplitude, level, settling time, where the balls end."""
    from abu_calc.analysis.simulate import ACCURACY
    from abu_calc.analysis.simulate import simulate as integrate
    from abu_calc.cli.load import located, source_of
    from abu_calc.dynamics.from_scene import lasting
    from abu_calc.dynamics.scene import with_parted_balls
    from abu_calc.report.files import write
    from abu_calc.report.simulate_text import simulate_blocks
    from abu_calc.report.simulation import scene_model, simulation_result
    from abu_calc.report.trajectory import trajectory_csv, trajectory_moments
    from abu_calc.units import from_si

    ACCURACY.check(accuracy)
    _check_options(how, integrator, trajectory, samples, (("--with", with_), ("--without", without)))
    subject = subject_of(file, set_, scene, start)
    if duration is not None:
        wanted = lasting(subject.scene, duration, "--duration")
    else:
        with located(subject.source):
            wanted = lasting(subject.scene, None, "scene.duration_s")
    moments = trajectory_moments(wanted, samples or SAMPLES) if trajectory else ()
    run = integrate(wanted, accuracy, moments)
    if trajectory:
        write(trajectory, trajectory_csv(wanted, run.trajectory, moments))
    result = simulation_result(run, subject.left_out(run.response))
    result["unbalanced_amplitude_mm"] = from_si(run.response.unbalanced_amplitude, "mm")
    checks, warnings = (_accuracy_check(run, accuracy),), (*subject.warnings, *run.warnings)
    defaults = subject.source.defaults_used
    blocks = simulate_blocks(subject.title, subject.start, result, checks, warnings, defaults)
    model = scene_model(with_parted_balls(wanted)[0])
    return Outcome("simulate", result, blocks, source_of(subject.source), checks, model, warnings, overall(checks))


def _check_options(
    how: Delivery,
    integrator: str,
    trajectory: Path | None,
    samples: int | None,
    effects: tuple[tuple[str, list[str] | None], ...],
) -> None:
    """Refuse what cannot be done before anything is computed."""
    from abu_calc.report.files import check_target
    from abu_calc.spec.scene_effects import Effects

    if integrator == "heyoka":
        raise InputError(
            "this version integrates with SciPy",
            place=Place(key="--integrator"),
            found=integrator,
            allowed="auto, scipy",
        )
    one_of("--integrator", integrator, INTEGRATORS)
    for option, named in effects:
        for name in named or ():
            one_of(option, name, (), tuple(Effects.model_fields))
    if samples is not None and trajectory is None:
        raise InputError("--samples goes with --trajectory", remedy="Add --trajectory FILE.csv.")
    if samples is not None and not 2 <= samples <= MOST_SAMPLES:
        raise InputError(
            "out of range", place=Place(key="--samples"), found=str(samples), allowed=f"2 … {MOST_SAMPLES}"
        )
    if trajectory is not None:
        check_target(trajectory, force=how.force, suffixes=(".csv",))
        if how.output is not None and how.output.resolve() == trajectory.resolve():
            raise InputError("--output and --trajectory name the same file", found=str(trajectory))


def _accuracy_check(run: "Simulation", accuracy: float) -> Check:
    message = "two runs, a decade of tolerance apart, agree in amplitude, settling time and ball angles"
    return Check("ABU801", "accuracy reached", verdict(run.error_estimate <= accuracy), message, run.error_estimate,
                 accuracy, None, None)  # fmt: skip


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "simulate", simulate)
