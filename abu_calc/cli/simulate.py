"""`abu simulate MACHINE|SCENE`: integrate one scene to the accuracy asked for."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from abu_calc.checks import Check, overall, verdict
from abu_calc.cli.command import Overrides, add_command
from abu_calc.cli.deliver import Delivery
from abu_calc.cli.progress import progress
from abu_calc.cli.subject import File, WhichScene, WhichStart, one_of, subject_of
from abu_calc.errors import InputError, Place
from abu_calc.report.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.analysis.audit import Audit
    from abu_calc.analysis.simulate import Simulation

INTEGRATORS: Final = ("auto", "scipy", "heyoka")
SAMPLES: Final = 1001
MOST_SAMPLES: Final = 1_000_000

Accuracy = Annotated[float, typer.Option("--accuracy", help="Accuracy asked of the results.")]
With = Annotated[list[str] | None, typer.Option("--with", metavar="EFFECT", help="Take an effect in; repeatable.")]
Without = Annotated[list[str] | None, typer.Option("--without", metavar="EFFECT", help="Leave one out; repeatable.")]


def simulate(
    how: Delivery,
    file: File,
    set_: Overrides = None,
    scene: WhichScene = None,
    start: WhichStart = None,
    accuracy: Accuracy = 0.01,
    integrator: Annotated[str, typer.Option("--integrator", help="auto, scipy or heyoka.")] = "auto",
    duration: Annotated[float | None, typer.Option("--duration", metavar="S", help="Seconds to simulate.")] = None,
    trajectory: Annotated[
        Path | None, typer.Option("--trajectory", metavar="FILE.csv", help="Also write the motion.")
    ] = None,
    samples: Annotated[
        int | None, typer.Option("--samples", metavar="N", help=f"Moments in the trajectory; default {SAMPLES}.")
    ] = None,
    with_: With = None,
    without: Without = None,
    audit: Annotated[
        bool, typer.Option("--audit", help="Run again with every effect in; tell the true difference.")
    ] = False,
) -> Outcome:
    """Integrate one scene: amplitude, level, settling time, where the balls end."""
    from abu_calc.analysis.audit import audit as run_again
    from abu_calc.analysis.ledger import chosen
    from abu_calc.analysis.simulate import ACCURACY
    from abu_calc.analysis.simulate import simulate as integrate
    from abu_calc.cli.load import source_of
    from abu_calc.report.files import write
    from abu_calc.report.simulate_text import simulate_blocks
    from abu_calc.report.simulation import audit_result, scene_model, simulation_result
    from abu_calc.report.trajectory import trajectory_csv, trajectory_moments
    from abu_calc.scenes.from_scene import lasting

    ACCURACY.check(accuracy)
    _check_options(how, integrator, trajectory, samples)
    subject = subject_of(file, set_, scene, start)
    check_effects(subject.scene.effects, with_, without)
    with subject.source.located():
        full = lasting(subject.scene, duration, "scene.duration_s" if duration is None else "--duration")
        ledger = chosen(full, accuracy, with_ or (), without or ())
    moments = trajectory_moments(full, samples or SAMPLES) if trajectory else ()
    with progress(how) as tell:
        run = integrate(ledger.scene, accuracy - ledger.spared, moments, integrator=integrator, tell=tell)
        audited = run_again(full, ledger, run, accuracy, integrator, tell) if audit else None
    result, checks = simulation_result(run, ledger), [_accuracy_check(run, ledger.spared, accuracy)]
    if audited:
        result["audit"] = audit_result(audited)
        checks.append(_audit_check(audited, accuracy))
    if trajectory:  # when nothing can fail or be interrupted for long any more
        write(trajectory, trajectory_csv(run.scene, run.trajectory, moments))
    warnings, defaults = (*subject.warnings, *run.warnings), subject.source.defaults_used
    blocks = simulate_blocks(subject.title, subject.start, result, run.scene, checks, warnings, defaults)
    model = scene_model(run.scene)
    return Outcome(
        "simulate", result, blocks, source_of(subject.source), tuple(checks), model, warnings, overall(checks)
    )


def _check_options(how: Delivery, integrator: str, trajectory: Path | None, samples: int | None) -> None:
    """Refuse what cannot be done before anything is computed."""
    from abu_calc.report.files import check_target

    one_of("--integrator", integrator, INTEGRATORS)
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


def check_effects(present: tuple[object, ...], with_: list[str] | None, without: list[str] | None) -> None:
    """Refuse effects nobody knows, and those the file has no data for."""
    from abu_calc.dynamics.effects.registry import REGISTRY

    data = [getattr(effect, "name", "") for effect in present]
    for option, named in (("--with", with_), ("--without", without)):
        for name in named or ():
            one_of(option, name, [known for known, _ in REGISTRY])
    for name in with_ or ():
        if name not in data:
            raise InputError(
                "the file has no data for this effect",
                place=Place(key="--with"),
                found=name,
                allowed=", ".join(data) or "none",
                remedy="Write its table into the file.",
            )
        if name in (without or ()):
            raise InputError("an effect cannot be both in and out", place=Place(key="--without"), found=name)


def _accuracy_check(run: "Simulation", spared: float, accuracy: float) -> Check:
    message = "two runs, a decade of tolerance apart, agree in amplitude, settling time and ball angles"
    if run.rung == "envelope":
        message = "averages of two orders, and what both leave out, agree in amplitude, settling time and ball angles"
    message += f"; the effects left out may change {spared:.2g} of it" if spared else ""
    error = run.error_estimate + spared
    return Check("ABU801", "accuracy reached", verdict(error <= accuracy), message, error, accuracy, None, None)


def _audit_check(audited: "Audit", accuracy: float) -> Check:
    message = "with every effect in, amplitude, settling time and ball angles differ by no more than the accuracy"
    remedy = "Ask for more accuracy, or take effects in: --with EFFECT."
    held = audited.difference <= accuracy
    return Check("ABU803", "effects left out", verdict(held), message, audited.difference, accuracy, None,
                 None if held else remedy)  # fmt: skip


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "simulate", simulate)
