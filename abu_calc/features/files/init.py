"""`abu init FILE`: write the file of a new machine, or a commented file of another kind, or a copy of a preset.

The short file of a new machine: what its designer gives, and usual values by layout and wheel for the rest.
"""

import math
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any, Final, Literal, NamedTuple, get_args

import typer

from abu_calc.cli.output import Delivery
from abu_calc.formulas.rigid_body import usual_lengths
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.units import from_si, to_si
from abu_calc.inputs.read_machine import read, read_file
from abu_calc.inputs.reading.kinds import BY_NAME, kind_of
from abu_calc.inputs.reading.sources import text_of
from abu_calc.inputs.reading.text import shown
from abu_calc.reporting.blocks import Paragraph
from abu_calc.reporting.outcome import Outcome, Target, check_target
from abu_calc.standards.tables import toml_table

Layout = Literal["straight", "face", "angle"]
DENSITY: Final = 2500.0
"""Of a grinding wheel [kg/m³]; assumed."""
ECCENTRIC: Final = ((9000.0, 0.006), (0.0, 0.010))
"""Eccentricity of a ground race [mm], from a speed [rpm] on; assumed."""
NUMBER: Final = r"(-?\d+(?:\.\d*)?|-?\.\d+)"
ROOM: Final = re.compile(rf"Ø?\s*{NUMBER}\s*[x×X*]\s*{NUMBER}\s*(?:mm)?")
HANDLE: Final = re.compile(rf"([^=]*[^=\s])\s*=\s*{NUMBER}\s*,\s*{NUMBER}\s*,\s*{NUMBER}")
HEAVIEST_HELD: Final = 12.0
"""Mass [kg] above which a grinder is hardly held in the hands (assumed)."""
UNITS: Final = {"wheel": "mm", "mass": "kg", "speed": "rpm", "level": "dB"}
COLUMN: Final = 34
"""Column in which comments begin."""


class Question(NamedTuple):
    """A question in a terminal: the option that answers it, its words, the usual answer of a machine so far."""

    option: str
    words: str
    usual: Callable[[Mapping[str, Any]], str]
    needed: bool = True


def _table(given: Mapping[str, Any]) -> Mapping[str, Any]:
    table: Mapping[str, Any] = toml_table("usual_machines")[given["layout"]]
    return table


def _mass(given: Mapping[str, Any]) -> str:
    """Usual mass [kg] by layout and wheel diameter, between the rows of the table in proportion."""
    rows, wheel = _table(given)["rows"], float(given["wheel"])
    (low, light), (high, heavy) = next((pair for pair in pairwise(rows) if wheel <= pair[1][0]), (rows[-2], rows[-1]))
    return f"{max(light + (heavy - light) * (wheel - low) / (high - low), 0.5 * rows[0][1]):.2g}"


def _speed(given: Mapping[str, Any]) -> str:
    rpm = from_si(_table(given)["peripheral_speed"] / (to_si(float(given["wheel"]), "mm") / 2), "rpm")
    return f"{100 * round(rpm / 100)}"


def _room(given: Mapping[str, Any]) -> str:
    share, width = _table(given)["room"]
    return f"{round(share * float(given['wheel']))}x{width:g}"


QUESTIONS: Final = (
    Question("layout", "Layout: straight, angle or face", lambda _: "straight"),
    Question("wheel", "Diameter of the wheel, mm", lambda given: "125" if given["layout"] == "angle" else "150"),
    Question("mass", "Mass with guard and handles, without wheel and cable, kg", _mass),
    Question("speed", "Rated speed of the spindle, rpm", _speed),
    Question("room", "Room for the autobalancer, outer diameter x width, mm", _room),
    Question("level", "Idle level measured now, dB re 5e-8 m/s (empty: not measured)", lambda _: "", needed=False),
    Question(
        "handle", "Handle name=x,y,z from the centre of mass, mm (empty: no handles)", lambda _: "", needed=False
    ),
)  # fmt: skip
"""What a file needs, in the order in which it is asked for."""


def completed(
    answers: Mapping[str, Any], ask: Callable[[str, str], str] | None
) -> tuple[dict[str, Any], frozenset[str]]:
    """All answers by option, and those that are usual values.

    `answers`: what options give, as texts; None: not given. `ask`: asks in a terminal; None: nobody is there.

    Raises InputError for what is needed and not given, or is none of what is allowed.
    """
    given: dict[str, Any] = {name: value for name, value in answers.items() if value not in (None, (), [])}
    missing = [question.option for question in QUESTIONS if question.needed and question.option not in given]
    if missing and ask is None:
        example = " --layout angle --wheel 125 --mass 2.2 --speed 11000 --room 52x16"
        raise InputError(
            f"missing: {', '.join(f'--{name}' for name in missing)}",
            remedy=f"Give them, for example:{example}. In a terminal the command asks. --all-keys writes the complete "
            "file, --preset NAME copies one.",
        )  # fmt: skip
    usual = set[str]()
    for question in QUESTIONS:
        option = question.option
        if option in given:
            given[option] = _checked(option, given[option])
        elif ask is not None and missing:
            given |= _asked(question, given, ask, usual)
    return given, frozenset(usual)


def _asked(
    question: Question, given: Mapping[str, Any], ask: Callable[[str, str], str], usual: set[str]
) -> dict[str, Any]:
    """The answer to a question, asked again until it is one; an empty one is the usual one, or none."""
    proposed, words = question.usual(given), question.words
    while True:
        typed = ask(words, proposed).strip()
        if not (typed or proposed):
            return {}
        answer: Any = typed or proposed
        try:
            checked = _checked(question.option, [answer] if question.option == "handle" else answer)
        except InputError as error:
            words = f"{str(error).splitlines()[0]}. {question.words}"
            continue
        if not typed:
            usual.add(question.option)
        return {question.option: checked}


def _checked(option: str, value: Any) -> Any:
    """The answer as the file takes it. Raises InputError."""
    place = Place(key=f"--{option}")
    if option == "layout":
        if value not in get_args(Layout):
            raise InputError("no such layout", place=place, found=str(value), allowed=", ".join(get_args(Layout)))
        return value
    if option == "room":
        match = ROOM.fullmatch(str(value).strip())
        if match is None:
            raise InputError(
                "outer diameter and width are needed", place=place, found=str(value), allowed="Ø×WIDTH in mm, as 52x16"
            )
        return float(match[1]), float(match[2])
    if option == "handle":
        handles = [HANDLE.fullmatch(text.strip()) for text in value]
        wrong = next((text for text, match in zip(value, handles, strict=True) if match is None), None)
        if wrong is not None:
            raise InputError("a name and three lengths are needed", place=place, found=wrong,
                             allowed="NAME=x,y,z in mm, as side=62,120,-8")  # fmt: skip
        return [(match[1], [float(match[k]) for k in (2, 3, 4)]) for match in handles if match is not None]
    unit = UNITS[option]
    match = re.fullmatch(rf"{NUMBER}\s*(?:{unit})?", str(value).strip(), re.IGNORECASE)
    number = math.nan if match is None else float(match[1])
    if not number > 0:
        raise InputError("a number above zero is needed", place=place, found=str(value), allowed=f"a number in {unit}")
    return number


def machine_text(given: Mapping[str, Any], usual: frozenset[str]) -> str:
    """The file: at most 30 lines without handles, each assumed value with what to do about it."""
    return "\n".join(_lines(given, usual)) + "\n"


def _lines(given: Mapping[str, Any], usual: frozenset[str]) -> Iterator[str]:
    def row(key: str, value: object, comment: str = "") -> str:
        text = f"{key} = {shown(value)}"
        return f"{text:<{COLUMN}}# {comment}" if comment else text

    def said(option: str, todo: str) -> str:
        return f"assumed: usual; {todo}" if option in usual else ""

    table, layout, wheel = _table(given), given["layout"], given["wheel"]
    lengths = usual_lengths(layout, given["mass"])
    yield "# Keys, units and ranges: `abu init --all-keys FILE`, `abu explain KEY`. Replace what is assumed."
    yield "[machine]"
    yield row("name", f"{layout} grinder {wheel:g} mm")
    yield row("layout", layout)
    yield row("mass_kg", given["mass"], said("mass", "weigh it"))
    yield row("speed_rpm", given["speed"], said("speed", "see the data sheet"))
    yield row("spindle_axis", table["spindle_axis"])
    for key, length in lengths.items():
        yield row(key.partition(".")[2], length, "assumed: usual for this mass; measure it")
    for name, position in given.get("handle", ()):
        yield "[[machine.handle]]"
        yield row("name", name)
        yield row("position_mm", position)
    yield "\n[suspension]"
    stands = "" if given["mass"] <= HEAVIEST_HELD else "assumed: if it stands or is bolted, measure; "
    yield row("model", "springs", f"{stands}held in two hands (ISO 10068:2012)")
    yield row("natural_frequencies_hz", [2.5, 2.5])
    yield row("damping_ratios", [0.5, 0.5])
    yield "\n[wheel]"
    volume = math.pi / 4 * to_si(wheel, "mm") ** 2 * to_si(table["wheel_thickness"], "mm")
    yield row("diameter_mm", wheel, said("wheel", "correct it"))
    yield row("mass_kg", float(f"{DENSITY * volume:.2g}"), "assumed: by its size; weigh it")
    if "level" in given:
        yield row("measured_level_db", given["level"])
    else:
        worst = float(f"{toml_table('test_wheels')['rule']['factor'] * wheel**2:.2g}")
        yield row("imbalance_g_mm", worst, "assumed: worn, as the test wheel of ISO 28927-4")
    yield "\n[autobalancer]"
    outer, width = given["room"]
    yield row("max_outer_diameter_mm", outer, said("room", "measure it"))
    yield row("max_width_mm", width)
    yield row("bore_diameter_mm", min(table["bore"], round(outer / 3, 1)), "assumed: the spindle; measure it")
    eccentricity = next(value for speed, value in ECCENTRIC if given["speed"] >= speed)
    yield row("race_eccentricity_mm", eccentricity, "assumed: ground in one set-up; ask the shop")


def init(
    how: Delivery,
    file: Path,
    preset: str | None = None,
    method: str | None = None,
    *,
    scene: bool = False,
    readings: bool = False,
    recordings: bool = False,
    all_keys: bool = False,
    **answers: Any,
) -> Outcome:
    """Write the short file of a machine from the answers to questions about it, or a file of another kind."""
    check_target(file, force=how.force, suffixes=(".toml",))
    kinds = (("scene", scene), ("readings", readings), ("recordings", recordings), ("all-keys", all_keys))
    asked = [name for name, wanted in kinds if wanted]
    if len(asked) + (preset is not None) > 1:
        options = [f"--{name}" for name in asked] + (["--preset"] if preset is not None else [])
        raise InputError(
            f"{' and '.join(options)} exclude each other", remedy="Specify one of them: a preset has its own kind."
        )
    if method is not None and not readings:
        raise InputError("--method goes with --readings", remedy="Add --readings, or leave --method out.")
    if asked or preset is not None:
        if answers:
            raise InputError(
                f"--{next(iter(answers))} describes a machine of a short file",
                remedy="Leave it out here, or the other option.",
            )
        text, command = _whole(preset, "machine" if all_keys else asked[0] if asked else "", method)
    else:
        text, command = _short(answers), "size"
    said = [Paragraph(f"{file} is written. Edit it, then: abu {command} {file}", "pass")]
    if any(line.startswith("[expected]") for line in text.splitlines()):
        said.append(Paragraph(f"[expected] holds the preset's results. After an edit: abu verify --update {file}"))
    return Outcome("init", {"file": str(file), "preset": preset}, tuple(said), further=(Target(file, text),))


def _whole(preset: str | None, kind: str, method: str | None) -> tuple[str, str]:
    """A preset, or the commented file of a kind, and the command for it."""
    if preset is not None:
        return text_of(preset), kind_of(read_file(preset).document.content).command
    if method is not None:
        from abu_calc.registry import imported

        return imported("balancing.read:readings_template")(method), BY_NAME[kind].command
    from abu_calc.inputs.reading.schema import template_of

    return template_of(kind), BY_NAME[kind].command


def _short(answers: Mapping[str, Any]) -> str:
    """The short file of a machine, read as a check before it is written."""

    def ask(words: str, usual: str) -> str:
        """An answer from the terminal; the usual one where none is given."""
        return str(typer.prompt(f"{words} [{usual}]" if usual else words, default="", show_default=False, err=True))

    text = machine_text(*completed(answers, ask if sys.stdin.isatty() else None))
    read(text)
    return text
