"""`abu stability MACHINE|SCENE`: is the balanced state stable, and at which speeds does that change?"""

from typing import TYPE_CHECKING, Annotated, Final

import typer

from abu_calc.cli.command import File, Overrides, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.foundation.errors import InputError, Place
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.stability.study import StabilityResult

    pass

SCENES: Final = ("idle", "swing-arm-idle", "swing-arm-cutting")


def stability(
    how: Delivery,
    file: File,
    set_: Overrides = None,
    scene: Annotated[
        str | None, option("--scene NAME", f"Scene of a machine: {', '.join(SCENES)}; default {SCENES[0]}.")
    ] = None,
    speeds_rpm: Annotated[
        str | None, option("--speeds LOW:HIGH", "Range of speeds, rpm. Find every speed at which stability changes.")
    ] = None,
    arrangement: Annotated[
        str,
        option(
            "--arrangement NAME",
            "Arrangement of more than two balls: worst (of those that balance), fan (evenly spread) or start.",
        ),
    ] = "worst",
    crossings: Annotated[bool, option("--crossings", "Also list every crossing of an eigenvalue.")] = False,
    attractors: Annotated[
        bool, option("--attractors", "Also simulate many starts, and list every state in which they end.")
    ] = False,
    starts: Annotated[int | None, option("--starts N", "Starts drawn by lot for --attractors; default 64.")] = None,
    seed: Annotated[int, option("--seed N", "Seed of the starts drawn for --attractors.")] = 0,
    only: Annotated[str | None, option("--only START", "Follow this one start of --attractors: drawn-7.")] = None,
) -> Outcome:
    """Find whether the balanced state is stable, and at which speeds.

    The report gives eigenvalues or Floquet multipliers, the growth rate and the stability boundaries.
    """
    from abu_calc.features.stability.study import stability as study
    from abu_calc.simulation.scene_file import read_any

    speeds = None if speeds_rpm is None else _two(speeds_rpm)
    with progress(how) as tell:
        result = study(
            read_any(file, set_ or ()), scene, speeds_rpm=speeds, arrangement=arrangement, crossings=crossings,
            attractors=attractors, starts=starts, seed=seed, only=only, progress=tell,
        )  # fmt: skip
    return outcome_of(result)


def _two(text: str) -> tuple[float, float]:
    """LOW:HIGH as numbers."""
    from abu_calc.features.stability.study import SPEEDS

    try:
        low, high = map(float, text.split(":"))
    except ValueError:
        raise InputError(
            "not a range of speeds", place=Place(key="--speeds"), found=text, allowed=SPEEDS,
            remedy="Write --speeds 1000:6000.",
        ) from None  # fmt: skip
    return low, high


def outcome_of(result: "StabilityResult") -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.stability.view import stability_blocks, stability_screen

    return Outcome.of(result, lambda: stability_blocks(result), lambda: stability_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "stability", stability, simulates=True)
