"""`abu identify MACHINE|SCENE RECORDING…`: drag, friction and eccentricity from recorded starts."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import File, Overrides, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.reporting.outcome import Outcome
from abu_calc.reporting.write import Target, check_target

if TYPE_CHECKING:
    from abu_calc.features.identification.results import IdentifyResult


def identify(
    how: Delivery,
    file: File,
    recordings: Annotated[list[str], typer.Argument(metavar="RECORDING…", help="CSV files, one start each.")],
    set_: Overrides = None,
    without: Annotated[str | None, option("--without FILE", "Recording of a run with the balls taken out.")] = None,
    bench: Annotated[
        str | None, option("--bench FILE", "CSV of a ball let go in the standing race: t_s, angle_deg.")
    ] = None,
    mark_angle: Annotated[
        float, option("--mark-angle DEG", "Angle of the mark from the imbalance, with the rotation.")
    ] = 0.0,
    run_up: Annotated[float | None, option("--run-up S", "Run-up time instead of the file's.")] = None,
    write: Annotated[Path | None, option("--write FILE", "File to write: this one with the identified values.")] = None,
) -> Outcome:
    """Identify viscous drag rate, rolling friction and race eccentricity.

    Each recording begins when the machine is switched on and lasts until the balls rest. Its
    columns are t_s, vx_mm_per_s (or ax_m_per_s2) and mark, one pulse per revolution.
    """
    from abu_calc.features.identification.study import identify as study
    from abu_calc.simulation.scene_file import read_any

    if write is not None:
        check_target(write, force=how.force, suffixes=(".toml",), option="--write")
    with progress(how) as tell:
        result = study(
            read_any(file, set_ or ()), recordings, without=without, bench=bench, mark_angle_deg=mark_angle,
            run_up_s=run_up, progress=tell,
        )  # fmt: skip
    outcome = outcome_of(result)
    if write is None:
        return outcome
    from abu_calc.features.identification.results import identified_text

    return replace(outcome, further=(Target(write, identified_text(file, result)),))


def outcome_of(result: "IdentifyResult") -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.identification.view import identify_blocks, identify_screen

    return Outcome.of(result, lambda: identify_blocks(result), lambda: identify_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "identify", identify)
