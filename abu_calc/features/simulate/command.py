"""`abu simulate MACHINE|SCENE`: integrate one scene to a requested accuracy."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from abu_calc.cli.command import (
    ACCURACY,
    DURATION,
    FILE,
    SCENE,
    SET,
    START,
    WITH,
    WITHOUT,
    Answer,
    Command,
    FurtherFile,
    Option,
    Study,
)
from abu_calc.cli.help import OUTPUT
from abu_calc.foundation.errors import InputError

if TYPE_CHECKING:
    from abu_calc.features.simulate.study import SimulateResult
    from abu_calc.features.simulate.view import TrajectoryCsv

SAMPLES: Final = 1001
METHOD: Final = "Method"
"""Panel of the options about the integration."""


def _sampled(
    study: Study, source: object, trajectory: Path | None = None, samples: int | None = None, **given: Any
) -> Answer:
    """Result of the scene, with the samples of a trajectory that is to be written."""
    if trajectory is None and samples is not None:
        raise InputError("--samples goes with --trajectory", remedy="Add --trajectory FILE.csv.")
    return study(source, samples=SAMPLES if trajectory and samples is None else samples, **given)


def _trajectory(result: "SimulateResult", _: Mapping[str, Any]) -> "TrajectoryCsv | None":
    from abu_calc.features.simulate.view import TrajectoryCsv

    return TrajectoryCsv(result.motion) if result.motion else None


COMMAND = Command(
    "simulate.study:simulate",
    (
        *(FILE, SET, SCENE, START),
        Option(
            "race_centre_deg",
            float,
            "--race-centre DEG",
            "Angle from the imbalance to the centre of the race; default 180, of two races 0.",
        ),
        ACCURACY,
        Option("integrator", str, "--integrator NAME", "auto, scipy, plain or compiled.", METHOD, default="auto"),
        DURATION,
        Option(
            "trajectory",
            Path,
            "--trajectory FILE.csv",
            "Also write the motion.",
            OUTPUT,
            writes=FurtherFile(".csv", _trajectory),
        ),
        Option("samples", int, "--samples N", f"Times in the trajectory; default {SAMPLES}.", OUTPUT),
        *(WITH, WITHOUT),
        Option(
            "most_evaluations",
            int,
            "--most-evaluations N",
            "Most evaluations of the equations; default ten million, a minute or two.",
            METHOD,
        ),
        Option("audit", bool, "--audit", "Repeat the run with every effect and report the difference.", METHOD),
    ),
    around=_sampled,
    simulates=True,
)
