"""`abu stability MACHINE|SCENE`: is the balanced state stable, and at which speeds does that change?"""

import math
from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.checks import Check, overall, verdict
from abu_calc.cli.command import Overrides, add_command
from abu_calc.cli.subject import File, one_of, subject_of
from abu_calc.errors import InputError, Place
from abu_calc.report.outcome import Outcome
from abu_calc.units import to_si

if TYPE_CHECKING:
    from abu_calc.dynamics.balanced.stability import Stability

FASTEST_RPM = 1e6
SCENES = ("idle", "swing-arm-idle", "swing-arm-cutting")
"""Those with a balanced state; a run-up passes through all speeds, and a wheel at work is held."""


def stability(
    file: File,
    set_: Overrides = None,
    scene: Annotated[
        str | None, typer.Option("--scene", help=f"Of a machine: {', '.join(SCENES)}; default {SCENES[0]}.")
    ] = None,
    speeds: Annotated[
        str | None,
        typer.Option("--speeds", metavar="LOW:HIGH", help="rpm; also find every speed where stability changes."),
    ] = None,
) -> Outcome:
    """Stability of the balanced state: eigenvalues or Floquet multipliers, growth rate, boundaries."""
    from abu_calc.cli.load import source_of
    from abu_calc.dynamics.balanced.stability import boundaries, critical_damping
    from abu_calc.dynamics.balanced.stability import stability as judge
    from abu_calc.report.simulation import scene_model
    from abu_calc.report.stability import stability_blocks, stability_result, stability_warnings

    wanted = None if speeds is None else _range(speeds)
    one_of("--scene", scene, SCENES)
    subject = subject_of(file, set_, scene)
    found = judge(subject.scene, subject.half_angle)
    limits = None
    if wanted is not None and found.reason is None:
        limits = boundaries(subject.scene, *wanted, subject.half_angle)
    result = stability_result(found, limits, critical_damping(subject.scene))
    checks = (_check(found),)
    sizes = [len(race.ball_masses) for race in subject.scene.races]
    warnings = (*subject.warnings, *stability_warnings(found, sizes))
    defaults = subject.source.defaults_used
    blocks = stability_blocks(subject.title, result, speeds, checks, warnings, defaults)
    model = scene_model(subject.scene)
    return Outcome("stability", result, blocks, source_of(subject.source), checks, model, warnings, overall(checks))


def _range(text: str) -> tuple[float, float]:
    """LOW:HIGH in rpm as rad/s."""
    parts = text.split(":")
    try:
        low, high = (float(part) for part in parts)
    except ValueError:
        low = high = math.nan
    if not 0 < low < high <= FASTEST_RPM:
        raise InputError(
            "not a range of speeds",
            place=Place(key="--speeds"),
            found=text,
            allowed=f"LOW:HIGH in rpm, above 0, ascending, up to {FASTEST_RPM:g}",
            remedy="Write --speeds 1000:6000.",
        )
    return to_si(low, "rpm"), to_si(high, "rpm")


def _check(found: "Stability") -> Check:
    name = ("ABU802", "stability of the balanced state")
    if found.reason is not None:
        return Check(*name, "not-done", found.reason, unit="1/s",
                     remedy="A second race in another plane, or bearings alike along x and y.")  # fmt: skip
    if found.angles is None:
        return Check(
            *name, "fail", "there is no balanced state: the balls cannot carry the imbalance", unit="1/s",
            remedy="Heavier or more balls, a larger race, or a better balanced rotor.",
        )  # fmt: skip
    growth = found.growth_rate if found.growth_rate is not None and math.isfinite(found.growth_rate) else None
    message = "every small disturbance dies out"
    if not found.stable:
        message = "not every small disturbance dies out, although the balls could balance here"
    remedy = None if found.stable else "Leave the forbidden speeds (--speeds finds them), or change drag and damping."
    return Check(*name, verdict(bool(found.stable)), message, growth, 0.0, "1/s", remedy)


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "stability", stability)
