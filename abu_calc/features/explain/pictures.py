"""Pictures in characters of what a key's coordinates mean: axes, handles, signs, the place of the autobalancer."""

from typing import Final

STRAIGHT: Final = (
    "straight: the spindle runs along the body",
    "",
    " rear handle         body         front handle    ABU  wheel",
    "   ______________________________________________  _   _",
    "  |                     +                        || |=| |   --> z",
    "  |______________________________________________||_| |_|",
    "   z < 0                                  z > 0",
)
ANGLE: Final = (
    "angle: the spindle runs across the body, seen from the side, the wheel below",
    "",
    " rear handle          body                 gear head",
    "   ______________________________________ ________",
    "  |                      +               |        |   --> x",
    "  |______________________________________|________|",
    "   x < 0                                     ||       |",
    "                                           [ABU]      v z",
    "                                         ====||====",
    "                                            wheel",
    " y points at you. A side handle at the head: x > 0; y > 0 right, y < 0 left",
    " of who holds the rear handle.",
)
FACE: Final = (
    "face: the machine stands above its wheel, whose face works",
    "",
    "                     ________",
    "  left handle ------|        |------ right handle   --> x",
    "    x < 0           |   +    |          x > 0",
    "                    |________|       |",
    "                        ||           v z",
    "                       [ABU]",
    "                 ========||========",
    "                       wheel",
)
ORIGIN: Final = (
    "+ is the centre of mass. Handles are counted from it. z runs along the spindle toward the wheel, x from the body "
    "toward the spindle, y so that x, y, z are right-handed. A side handle 85 mm in front of +, 120 mm to the left and "
    "10 mm above it, wheel below: position_mm = [85, -120, -10]. center_of_mass_from_wheel_mm, in [machine], has the "
    "same axes and counts from the wheel's centre to +: [-90, 0, -45] is 90 mm behind the spindle and 45 mm above the "
    "wheel."
)
CHAIN: Final = (
    "from the axis of rotation to the middle of the race, each part at its worst",
    "",
    "  axis of rotation                                  middle of the race",
    "  |-- spindle --|------ fit ------|-- housing --|------ race ------|",
    "   half the TIR   half the largest   imbalance    half the TIR",
    "   of its seat    clearance in the   without      of race to bore",
    "                  bore               balls",
    "  |<----------------- race_eccentricity_mm ----------------------->|",
)
BODY: Final = (STRAIGHT, ANGLE, FACE)
PICTURES: Final = dict.fromkeys(
    (
        "machine.handle.position_mm",
        "machine.handle.from_center_of_mass_mm",
        "machine.center_of_mass_from_wheel_mm",
        "machine.layout",
    ),
    (BODY, ORIGIN),
) | {
    "autobalancer.race_eccentricity_mm": (
        (CHAIN,),
        "`abu size` says what each part may be, and the drawing asks for it.",
    )
}
"""Pictures of the keys that need one."""
