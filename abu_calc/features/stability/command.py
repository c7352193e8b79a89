"""`abu stability MACHINE|SCENE`: is the balanced state stable, and at which speeds does that change?"""

from typing import Final

from abu_calc.cli.command import FILE, SET, Command, Option
from abu_calc.foundation.errors import InputError, Place

SCENES: Final = ("idle", "swing-arm-idle", "swing-arm-cutting")


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


COMMAND = Command(
    "stability.study:stability",
    (
        *(FILE, SET),
        Option("scene", str, "--scene NAME", f"Scene of a machine: {', '.join(SCENES)}; default {SCENES[0]}."),
        Option(
            "speeds_rpm",
            str,
            "--speeds LOW:HIGH",
            "Range of speeds, rpm. Find every speed at which stability changes.",
            converts=_two,
        ),
        Option(
            "arrangement",
            str,
            "--arrangement NAME",
            "Arrangement of more than two balls: worst (of those that balance), fan (evenly spread) or start.",
            default="worst",
        ),
        Option("crossings", bool, "--crossings", "Also list every crossing of an eigenvalue."),
        Option(
            "attractors", bool, "--attractors", "Also simulate many starts, and list every state in which they end."
        ),
        Option("starts", int, "--starts N", "Starts drawn by lot for --attractors; default 64."),
        Option("seed", int, "--seed N", "Seed of the starts drawn for --attractors.", default=0),
        Option("only", str, "--only START", "Follow this one start of --attractors: drawn-7."),
    ),
    "The report gives eigenvalues or Floquet multipliers, the growth rate and the stability boundaries.",
    simulates=True,
)
