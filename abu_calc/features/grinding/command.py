"""`abu grinding MACHINE`: effect of the autobalancer at work, and wear of the wheel."""

from abu_calc.cli.command import ACCURACY, MACHINE, SET, Command, Option

COMMAND = Command(
    "grinding.study:grinding",
    (
        *(MACHINE, SET, ACCURACY),
        Option("wheel", int, "--wheel N", "With two races: only this wheel at work, by its number."),
    ),
    simulates=True,
)
