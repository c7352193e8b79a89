"""The kinds of files there are: what a right one looks like, and which commands take it, by cheap settings."""

import math
from typing import Final, NamedTuple

from abu_calc.inputs.reading.sources import text_of
from tests.inputs.samples import BEARINGS
from tests.inputs.scenes import ARM, JOINT_AND_CONTACT, PLANAR, SCENE, TILTING

FILE: Final = "@"
"""Stands for the file in a command."""
NAME: Final = "machine.toml"
RECORDED: Final = "@csv"
"""Stands for it by a name of its own."""
RECORDING_NAME: Final = "signal.csv"
"""What they are called: who reads a recording looks at the ending."""


class Kind(NamedTuple):
    """Texts that are right, from which others are made, and commands for them.

    `plain`: no TOML, so that texts alone are damaged.
    """

    name: str
    texts: tuple[str, ...]
    commands: tuple[tuple[str, ...], ...]
    plain: bool = False


# One ball size and one count, so that sizing has little to choose from.
MACHINE: Final = """\
[machine]
name = "straight grinder"
layout = "straight"
mass_kg = 5.6
speed_rpm = 5800
speed_range_rpm = [5000, 5800]
spindle_axis = "horizontal"
transverse_inertia_kg_m2 = 0.1
center_of_mass_to_wheel_mm = 200.0
power_W = 1000.0
[[machine.handle]]
name = "front"
from_center_of_mass_mm = 100.0
[[machine.handle]]
name = "rear"
from_center_of_mass_mm = -150.0
[suspension]
model = "springs"
natural_frequencies_hz = [2.5, 2.5]
damping_ratios = [0.5, 0.5]
[wheel]
mass_kg = 0.6
diameter_mm = 150.0
runout_mm = 0.04
imbalance_g_mm = 150.0
[autobalancer]
max_outer_diameter_mm = 68.0
max_width_mm = 32.0
ball_count = 2
ball_diameter_mm = 12.0
race_radius_mm = 26.0
[grinding]
press_force_N = 45.0
cutting_coefficient = 0.35
[run_up]
time_s = 1.0
[[bearing]]
name = "drive end"
designation = "6203"
radial_load_kN = 0.8
shaft_fit = "k6"
[limits]
vibration_level_db = 109.0
settling_time_s = 1.0
"""

ON_ARM: Final = f"""\
[swing_arm]
arm_length_mm = 350.0
moment_of_inertia_kg_m2 = 0.62
{JOINT_AND_CONTACT}"""

EXPECTATIONS: Final = """\
[expected]
status = "fail"
"fits.0.fit" = "k6"
"fits.0.interference_um" = [2.0, 31.0]
"fits.1.clearance_probability" = 0.5
[expected.tolerance]
"fits.0.interference_um" = 0.01
"""

RECORDING: Final = "t_s,x_m_per_s2,y_m_per_s2\n" + "".join(
    f"{k / 2000:.4f},{3 * math.sin(k / 3):.4f},{2 * math.cos(k / 3):.4f}\n" for k in range(1000)
)
"""Half a second, so that one octave is enough."""

SHORT: Final = ("--duration", "0.05")
VARIED: Final = ("--vary", "wheel.mass_kg=0.5:0.7:2", "--runs", "2", "--seed", "1")
TURNED: Final = ("--vary", "scene.speed_rpm=1000:2000:2", "--runs", "2", "--seed", "1")

FAST: Final = (
    SCENE.replace("19.0985931710274", "3000").replace("700.0", "0.5").replace("[1.0, 1.0]", "[2e3, 2e3]")
    + "[scene.effects]\ngravity = { }\n"
)

KINDS: Final = (
    Kind("machine", (MACHINE,), (("validate", FILE), ("check-fit", FILE), ("validate", FILE, FILE, "--json"))),
    Kind("bearings", (BEARINGS,), (("validate", FILE), ("check-fit", FILE), ("check-fit", FILE, "--json"))),
    Kind("scene", (SCENE, PLANAR, TILTING, ARM), (("validate", FILE), ("validate", FILE, "--json"), ("effects", FILE))),
    Kind(
        "readings",
        (text_of("sapropel-screw-rig"),),
        (("validate", FILE), ("balance", FILE), ("balance", FILE, "--json")),
    ),
    Kind("expected", (BEARINGS + EXPECTATIONS,), (("verify", FILE), ("verify", FILE, "--json"), ("verify", "."))),
    Kind(
        "recording",
        (RECORDING, RECORDING.replace(",", ";").replace(".", ",")),
        (
            ("levels", RECORDED),
            ("levels", RECORDED, "--quantity", "acceleration", "--minutes", "60"),
            ("levels", RECORDED, "--scale", "9.81", "--json"),
        ),
        plain=True,
    ),
    Kind(
        "computed machine",
        (MACHINE,),
        (
            ("size", FILE),
            ("size", FILE, "--json"),
            ("simulate", FILE, *SHORT),
            ("simulate", FILE, "--scene", "grinding", *SHORT, "--json"),
            ("simulate", FILE, *SHORT, "--trajectory", "motion.csv", "--samples", "50"),
            ("stability", FILE),
            ("stability", FILE, "--speeds", "1000:6000", "--json"),
            ("accuracy", FILE, "--time-budget", "0.2"),
            ("grinding", FILE),
            ("levels", FILE, "--duration", "0.1"),
            ("effects", FILE, "--json"),
            ("compare", FILE, "--variant", "wheel.imbalance_g_mm=140"),
            ("sweep", FILE, *VARIED),
            ("sweep", FILE, *VARIED, "--json"),
        ),
    ),
    Kind(
        "computed arm",
        (MACHINE + ON_ARM,),
        (
            ("simulate", FILE, "--scene", "swing-arm-cutting", *SHORT),
            ("simulate", FILE, "--scene", "swing-arm-idle", *SHORT, "--json"),
            ("stability", FILE, "--json"),
        ),
    ),
    Kind(
        "computed scene",
        # Short: a motion that no tolerance settles is tried at all of them.
        (
            TILTING.replace("duration_s = 1\n", "duration_s = 0.2\n"),
            ARM.replace("duration_s = 12", "duration_s = 0.2"),
            FAST,
        ),
        (
            ("simulate", FILE),
            ("simulate", FILE, "--json"),
            ("stability", FILE, "--json"),
            ("stability", FILE, "--speeds", "500:5000"),
            ("accuracy", FILE, "--time-budget", "0.2"),
            ("levels", FILE, "--duration", "0.3"),
            ("effects", FILE),
            ("sweep", FILE, *TURNED),
        ),
    ),
)
"""All kinds of files."""
