"""`abu measure-plan MACHINE|SCENE`: what to record for `abu identify`, and what it will tell."""

from abu_calc.cli.command import FILE, SET, Command, Option
from abu_calc.features.identification.command import RUN_UP

COMMAND = Command(
    "identification.plan:measure_plan",
    (
        *(FILE, SET),
        Option("runs", int, "--runs N", "Starts to record.", default=10),
        Option("noise_um", float, "--noise UM", "Noise of a recorded place over two revolutions, µm.", default=0.3),
        RUN_UP,
    ),
    "Starts of this machine are simulated and identified like recordings: the intervals are those to expect.",
)
