"""`abu init`, `abu presets`, `abu schema`, `abu validate`: files that people write, and their schemas."""

from pathlib import Path
from typing import Final

from abu_calc.cli.command import REQUIRED, SET, Command, Option

MACHINE_PANEL: Final = "The machine"

INIT = Command(
    "files.init:init",
    (
        Option("file", Path, "FILE", "New file, ending in .toml.", default=REQUIRED),
        Option("layout", str, "--layout NAME", "straight, angle or face.", MACHINE_PANEL),
        Option("wheel", str, "--wheel MM", "Diameter of the wheel.", MACHINE_PANEL),
        Option("mass", str, "--mass KG", "Mass without wheel and cable.", MACHINE_PANEL),
        Option("speed", str, "--speed RPM", "Rated speed of the spindle.", MACHINE_PANEL),
        Option("room", str, "--room ØxWIDTH", "Room for the autobalancer, mm.", MACHINE_PANEL),
        Option("level", str, "--level DB", "Idle level measured without it.", MACHINE_PANEL),
        Option(
            "handle",
            list[str],
            "--handle NAME=x,y,z",
            "Handle, mm from the centre of mass: x to the spindle, y across, z to the wheel; repeatable.",
            MACHINE_PANEL,
        ),
        Option("all_keys", bool, "--all-keys", "Write every key with a comment instead."),
        Option("preset", str, "--preset NAME", "Copy this preset."),
        Option("scene", bool, "--scene", "Write a scene file for `abu simulate`."),
        Option("readings", bool, "--readings", "Write a file of readings for `abu balance`."),
        Option(
            "method",
            str,
            "--method NAME",
            "With --readings, the method: rig-data, trials, single-plane, four-runs, least-squares or coefficients.",
        ),
        Option("recordings", bool, "--recordings", "Write a list of recordings for `abu declare --recordings`."),
    ),
    "In a terminal the command asks for what the options do not give, with usual values. The file is for `abu size`.",
)

PRESETS = Command(
    "files.printed:presets",
    (Option("name", str, "NAME", "Print this preset."),),
    formats=(".toml", ".json", ".txt", ".csv and .html (list only)"),
)

SCHEMA = Command(
    "files.printed:schema",
    (
        Option(
            "kind",
            str,
            "machine|scene|readings|recordings|result",
            "Kind of file, or result for the output of --json.",
            default="machine",
        ),
    ),
    "Schemas of files are of draft 4, which editors read; that of results is of 2020-12.",
    formats=(".json", ".txt"),
)

VALIDATE = Command(
    "files.validate:validate",
    (
        Option("files", list[str], "FILE", "Files of any kind that abu reads, or names of presets.", default=REQUIRED),
        SET,
    ),
)
