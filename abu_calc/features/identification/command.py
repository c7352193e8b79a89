"""`abu identify MACHINE|SCENE RECORDING…`: drag, friction and eccentricity from recorded starts.

`abu measure-plan MACHINE|SCENE`: what to record for it, and what it will tell.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from abu_calc.cli.command import FILE, REQUIRED, SET, Command, FurtherFile, Option

if TYPE_CHECKING:
    from abu_calc.features.identification.results import IdentifyResult

RUN_UP: Final = Option("run_up_s", float, "--run-up S", "Run-up time instead of the file's.")


def _identified(result: "IdentifyResult", given: Mapping[str, Any]) -> str:
    from abu_calc.features.identification.results import identified_text

    return identified_text(given["file"], result)


COMMAND = Command(
    "identification.study:identify",
    (
        FILE,
        Option("recordings", list[str], "RECORDING…", "CSV files, one start each.", default=REQUIRED),
        SET,
        Option("without", str, "--without FILE", "Recording of a run with the balls taken out."),
        Option("bench", str, "--bench FILE", "CSV of a ball let go in the standing race: t_s, angle_deg."),
        Option(
            "mark_angle_deg",
            float,
            "--mark-angle DEG",
            "Angle of the mark from the imbalance, with the rotation.",
            default=0.0,
        ),
        RUN_UP,
        Option(
            "write",
            Path,
            "--write FILE",
            "File to write: this one with the identified values.",
            writes=FurtherFile(".toml", _identified),
        ),
    ),
    "Each recording begins when the machine is switched on and lasts until the balls rest. Its "
    "columns are t_s, vx_mm_per_s (or ax_m_per_s2) and mark, one pulse per revolution.",
)

MEASURE_PLAN = Command(
    "identification.plan:measure_plan",
    (
        *(FILE, SET),
        Option("runs", int, "--runs N", "Starts to record.", default=10),
        Option("noise_um", float, "--noise UM", "Noise of a recorded place over two revolutions, µm.", default=0.3),
        RUN_UP,
    ),
    "Starts of this machine are simulated and identified like recordings: the intervals are those to expect.",
)
