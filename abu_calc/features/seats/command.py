"""`abu check-fit [MACHINE]`: bearing seats of a file, or of one bearing given by options.

The options of one bearing are one for each key of [[bearing]]. They are typed here and not read from the model, which
takes longer to load than the help of all commands.
"""

import inspect
import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Final, NamedTuple

import typer

from abu_calc.cli.command import Overrides, add_command
from abu_calc.foundation.errors import InputError, Place
from abu_calc.reporting.blocks import Block
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.seats.study import CheckFitResult
    from abu_calc.inputs.read_machine import Machine
    from abu_calc.reporting.drawings.shapes import Drawing


class BearingOption(NamedTuple):
    """One option: the key it gives, its name, the type of its value, and what helps say of it."""

    key: str
    name: str
    type: type[float] | type[str] | type[bool]
    help: str
    metavar: str | None = None

    @property
    def parameter(self) -> inspect.Parameter:
        """The option as a parameter of a command, None when it is not given."""
        option = typer.Option(self.name, help=self.help, metavar=self.metavar)
        return inspect.Parameter(
            self.key, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=Annotated[self.type | None, option]
        )


LOADS: Final = "rotating, stationary or indeterminate."
MATERIALS: Final = "steel, stainless-steel, cast-iron, aluminium or magnesium."
OPTIONS: Final = (
    BearingOption("designation", "--designation", str, "Such as 6203 or 7516."),
    BearingOption("bore_mm", "--bore", float, "Bore of the inner ring, mm."),
    BearingOption("outer_mm", "--outer", float, "Outer diameter, mm."),
    BearingOption("width_mm", "--width", float, "Width of the ring, mm."),
    BearingOption("chamfer_mm", "--chamfer", float, "Chamfer of one edge, mm."),
    BearingOption("bearing_type", "--bearing-type", str, "Of a bearing given by sizes: ball, cylindrical, tapered …"),
    BearingOption("dynamic_load_rating_kN", "--dynamic-load-rating", float, "C, kN."),
    BearingOption("static_load_rating_kN", "--static-load-rating", float, "C0, kN."),
    BearingOption("radial_load_kN", "--radial-load-kN", float, "Radial load, kN."),
    BearingOption("series", "--series", str, "light, medium or heavy."),
    BearingOption("inner_ring_load", "--inner-ring-load", str, LOADS),
    BearingOption("outer_ring_load", "--outer-ring-load", str, LOADS),
    BearingOption("bearing_class", "--bearing-class", str, "Normal, P6, P5, P4 or P2."),
    BearingOption("shaft_fit", "--shaft", str, "Tolerance class of the shaft, such as k6, or several: j5,k5,m5."),
    BearingOption("housing_fit", "--housing", str, "Tolerance class of the housing, such as H7, or several."),
    BearingOption("shaft_limits_um", "--shaft-limits", str, "Limits of the shaft as measured, µm.", "LEAST:MOST"),
    BearingOption("housing_limits_um", "--housing-limits", str, "Limits of the housing as measured, µm.", "LEAST:MOST"),
    BearingOption("shaft_rz_um", "--shaft-rz", float, "Roughness Rz of the shaft, µm."),
    BearingOption("housing_rz_um", "--housing-rz", float, "Roughness Rz of the housing, µm."),
    BearingOption(
        "ring_temperature_difference_K",
        "--ring-temperature-difference",
        float,
        "Inner ring warmer than its shaft, K.",
    ),
    BearingOption(
        "housing_temperature_difference_K",
        "--housing-temperature-difference",
        float,
        "Housing warmer than the outer ring, K.",
    ),
    BearingOption("temperature_rise_K", "--temperature-rise", float, "Bearing warmer than at mounting, K."),
    BearingOption("speed_rpm", "--speed", float, "Speed of the shaft, rpm."),
    BearingOption("shaft_bore_mm", "--shaft-bore", float, "Bore of a hollow shaft, mm."),
    BearingOption("housing_outer_mm", "--housing-outer", float, "Outer diameter of the housing, mm."),
    BearingOption("shaft_material", "--shaft-material", str, MATERIALS),
    BearingOption("housing_material", "--housing-material", str, MATERIALS),
    BearingOption("shaft_strength_MPa", "--shaft-strength", float, "Hoop stress that the shaft bears, MPa."),
    BearingOption("housing_strength_MPa", "--housing-strength", float, "Hoop stress that the housing bears, MPa."),
    BearingOption("housing_split", "--housing-split", bool, "The housing is in halves."),
    BearingOption("internal_clearance", "--internal-clearance", str, "Group C2, CN, C3 or C4."),
    BearingOption(
        "raceway_temperature_difference_K",
        "--raceway-temperature-difference",
        float,
        "Inner ring warmer than the outer one, K.",
    ),
    BearingOption("starting_torque_N_m", "--starting-torque", float, "Torque the seat must pass on, N·m."),
    BearingOption("seat_friction", "--seat-friction", float, "Friction coefficient of the seat."),
    BearingOption(
        "asked_interference_um", "--asked-interference", str, "Interference asked of every pair, µm.", "LEAST:MOST"
    ),
    BearingOption("name", "--name", str, "What to call the bearing."),
)
NAMES: Final = {option.key: option.name for option in OPTIONS}
"""The option of each key."""

SIZES: Final = ("bore_mm", "outer_mm", "width_mm")
FITS: Final = ("shaft_fit", "housing_fit")
BANDS: Final = ("asked_interference_um", "shaft_limits_um", "housing_limits_um")
"""Keys that an option gives as LEAST:MOST."""


def missing(given: Iterable[str]) -> list[str]:
    """The options that a bearing cannot do without beside the keys given."""
    needed = () if "designation" in given else SIZES
    return [NAMES[key] for key in needed if key not in given]


def listed(names: Sequence[str]) -> str:
    """Names as a sentence lists them.

    >>> listed(["--bore"]), listed(["--bore", "--outer", "--width"])
    ('--bore', '--bore, --outer and --width')
    """
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


def several(given: Mapping[str, object]) -> list[dict[str, object]]:
    """One bearing for each pair of the fits that are listed (j5,k5,m5), named after them where there are several."""
    lists = {key: [fit.strip() for fit in str(given[key]).strip(", ").split(",")] for key in FITS if key in given}
    pairs = [dict(zip(lists, fits, strict=True)) for fits in itertools.product(*lists.values())]
    if len(pairs) == 1:
        return [{**given, **pairs[0]}]
    varied = [key for key in lists if len(lists[key]) > 1]
    before = f"{given['name']}, " if "name" in given else ""
    return [{**given, **pair, "name": before + "/".join(pair[key] for key in varied)} for pair in pairs]


def band(key: str, text: str) -> list[float]:
    """The two numbers of LEAST:MOST."""
    try:
        least, most = (float(part) for part in text.split(":"))
    except ValueError:
        option = Place(key=NAMES[key])
        raise InputError("two numbers are expected", place=option, found=text, allowed="LEAST:MOST, 10:28") from None
    return [least, most]


def check_fit(
    machine: Annotated[
        str | None, typer.Argument(metavar="[MACHINE]", help="A machine file, or a preset's name.")
    ] = None,
    set_: Overrides = None,
    explain: Annotated[bool, typer.Option("--explain", help="The whole report, every formula with numbers.")] = False,
    **bearing: object,
) -> Outcome:
    """Judge bearing seats, or say which fits to write: interference, creep, stress, clearance left."""
    from abu_calc.features.seats.study import check_fit as study

    given = {key: value for key, value in bearing.items() if value is not None}
    source = _of_options(given, set_ or ()) if machine is None else _of_file(machine, set_ or (), given)
    result = study(source)
    short = None if explain else lambda: _screen(result)
    return Outcome.of(
        result,
        lambda: _blocks(result, explain),
        short,
        lambda: _drawings(result),
    )


def _screen(result: "CheckFitResult") -> tuple[Block, ...]:
    from abu_calc.features.seats.view import check_fit_screen

    return check_fit_screen(result)


def _blocks(result: "CheckFitResult", explain: bool) -> tuple[Block, ...]:
    from abu_calc.features.seats.figures import seat_note
    from abu_calc.features.seats.view import check_fit_blocks

    return (*check_fit_blocks(result), *(seat_note(result) if explain else ()))


def _drawings(result: "CheckFitResult") -> "tuple[Drawing, ...]":
    from abu_calc.features.seats.figures import seat_sheets

    return seat_sheets(result)


def _of_file(machine: str, overrides: Sequence[str], given: Mapping[str, object]) -> "Machine":
    from abu_calc.inputs.read_machine import read_machine

    if given:
        raise InputError("a file and options of one bearing exclude each other", found=NAMES[next(iter(given))])
    return read_machine(machine, overrides)


def _of_options(given: dict[str, object], overrides: Sequence[str]) -> "Machine":
    from abu_calc.inputs.read_machine import machine_of_bearings

    if overrides:
        raise InputError("--set overrides entries of a file, and none is given", found=f"--set {overrides[0]}")
    if absent := missing(given):
        raise InputError(
            "the bearing is not known" if given else "neither a machine file nor a bearing is given",
            remedy=f"Add {listed(absent)}, or --designation{'' if given else ', or name a machine file'}.",
        )
    bands = {key: band(key, str(given[key])) for key in BANDS if key in given}
    return machine_of_bearings(several(given | bands), NAMES)


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "check-fit", check_fit, (option.parameter for option in OPTIONS), drawn=(".svg",))
