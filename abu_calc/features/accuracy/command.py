"""`abu accuracy MACHINE|SCENE`: computing time against accuracy."""

from abu_calc.cli.command import ACCURACY, DURATION, FILE, SCENE, SET, START, Command, Option

QUANTITIES = "amplitude, level, quiet, rest, settling, angles"
COMMAND = Command(
    "accuracy.study:accuracy",
    (
        *(FILE, SET, SCENE, START),
        Option("quantity", str, "--quantity NAME", f"Quantity to compare: {QUANTITIES}.", default="amplitude"),
        ACCURACY,
        Option("budget_s", float, "--time-budget --budget S", "Computing time to spend.", default=20.0),
        DURATION,
    ),
    simulates=True,
)
