"""`abu check-fit [MACHINE]`: bearing seats of a file, or of one bearing given by options.

The options of one bearing are one for each key of [[bearing]]. They are typed here and not read from the model, which
takes longer to load than the help of all commands.
"""

import inspect
import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Final, NamedTuple

import typer

from abu_calc.cli.command import Overrides, add_command, option
from abu_calc.foundation.errors import InputError, Place
from abu_calc.reporting.blocks import Block
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.seats.study import CheckFitResult
    from abu_calc.inputs.read_machine import Machine
    from abu_calc.reporting.drawings.shapes import Drawing


class BearingOption(NamedTuple):
    """One option: the key it gives, its name and value as help shows them, its panel, type and text."""

    key: str
    usage: str
    panel: str
    type: type[float] | type[int] | type[str] | type[bool]
    help: str

    @property
    def name(self) -> str:
        """Name of the option, with its dashes."""
        return self.usage.split(" ")[0]

    @property
    def parameter(self) -> inspect.Parameter:
        """The option as a parameter of a command, None when it is not given."""
        shown = option(self.usage, self.help, self.panel)
        return inspect.Parameter(
            self.key, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=Annotated[self.type | None, shown]
        )


BEARING: Final = "Bearing"
LOADS: Final = "Loads and speed"
LIFE: Final = "Rating life"
SEATS: Final = "Fits"
PARTS: Final = "Shaft and housing"
THERMAL: Final = "Temperatures and clearance"
KINDS: Final = "rotating, stationary or indeterminate."
MATERIALS: Final = "steel, stainless-steel, cast-iron, aluminium or magnesium."
OPTIONS: Final = (
    BearingOption("designation", "--designation NAME", BEARING, str, "Designation, such as 6203 or 7516."),
    BearingOption("bore_mm", "--bore MM", BEARING, float, "Bore of the inner ring."),
    BearingOption("outer_mm", "--outer MM", BEARING, float, "Outer diameter."),
    BearingOption("width_mm", "--width MM", BEARING, float, "Width of the ring."),
    BearingOption("chamfer_mm", "--chamfer MM", BEARING, float, "Chamfer of one edge."),
    BearingOption(
        "bearing_type", "--bearing-type NAME", BEARING, str, "Type if sizes are given: ball, cylindrical, needle …"
    ),
    BearingOption("bearing_class", "--bearing-class NAME", BEARING, str, "Normal, P6, P5, P4 or P2."),
    BearingOption("series", "--series NAME", BEARING, str, "light, medium or heavy."),
    BearingOption("dynamic_load_rating_kN", "--dynamic-load-rating KN", BEARING, float, "Basic dynamic load rating C."),
    BearingOption("static_load_rating_kN", "--static-load-rating KN", BEARING, float, "Basic static load rating C0."),
    BearingOption("name", "--name NAME", BEARING, str, "Name of the bearing in the report."),
    BearingOption("radial_load_kN", "--radial-load-kN KN", LOADS, float, "Radial load."),
    BearingOption("cutting_force_N", "--cutting-force N", LOADS, float, "Cutting force, in place of the radial load."),
    BearingOption(
        "normal_to_cutting_ratio", "--normal-to-cutting RATIO", LOADS, float, "Normal force over cutting force (2.8)."
    ),
    BearingOption("bearings_sharing", "--bearings-sharing N", LOADS, int, "Bearings that share this load (1)."),
    BearingOption("axial_load_kN", "--axial-load-kN KN", LOADS, float, "Axial load."),
    BearingOption("load_kind", "--load-kind NAME", LOADS, str, "moderate (to 150 %) or shock (to 300 %)."),
    BearingOption("inner_ring_load", "--inner-ring-load NAME", LOADS, str, f"Inner ring: {KINDS}"),
    BearingOption("outer_ring_load", "--outer-ring-load NAME", LOADS, str, f"Outer ring: {KINDS}"),
    BearingOption("speed_rpm", "--speed RPM", LOADS, float, "Speed of the shaft."),
    BearingOption("starting_torque_N_m", "--starting-torque NM", LOADS, float, "Torque that the seat must transmit."),
    BearingOption(
        "lubricant_viscosity_mm2_per_s", "--lubricant-viscosity MM2/S", LIFE, float, "Viscosity at its temperature."
    ),
    BearingOption(
        "contamination_factor", "--contamination-factor RATIO", LIFE, float, "e_C of ISO 281: 1 clean … 0 dirty."
    ),
    BearingOption("required_life_h", "--required-life H", LIFE, float, "Rating life that is required."),
    BearingOption("position_mm", "--position MM", LIFE, float, "Place along the spindle from the wheel's centre."),
    BearingOption("shaft_fit", "--shaft CLASS", SEATS, str, "Class of the shaft: k6, or several: j5,k5."),
    BearingOption("housing_fit", "--housing CLASS", SEATS, str, "Class of the housing: H7, or several."),
    BearingOption("shaft_limits_um", "--shaft-limits LOW:HIGH", SEATS, str, "Measured limits of the shaft, µm."),
    BearingOption("housing_limits_um", "--housing-limits LOW:HIGH", SEATS, str, "Measured limits of the housing, µm."),
    BearingOption("ring_bore_limits_um", "--ring-bore-limits LOW:HIGH", SEATS, str, "Measured bore of the ring, µm."),
    BearingOption("ring_outer_limits_um", "--ring-outer-limits LOW:HIGH", SEATS, str, "Measured outer diameter, µm."),
    BearingOption("mounting_clearance_um", "--mounting-clearance UM", SEATS, float, "Clearance of a heated ring."),
    BearingOption(
        "asked_interference_um", "--asked-interference LOW:HIGH", SEATS, str, "Interference required of every pair, µm."
    ),
    BearingOption(
        "short_pairs_warn_percent", "--short-pairs-warn PERCENT", SEATS, float, "Share of short pairs that warns."
    ),
    BearingOption(
        "short_pairs_fail_percent", "--short-pairs-fail PERCENT", SEATS, float, "Share of short pairs that fails."
    ),
    BearingOption("seat_friction", "--seat-friction RATIO", SEATS, float, "Friction coefficient of the seat."),
    BearingOption("shaft_rz_um", "--shaft-rz UM", PARTS, float, "Roughness Rz of the shaft."),
    BearingOption("shaft_bore_mm", "--shaft-bore MM", PARTS, float, "Bore of a hollow shaft."),
    BearingOption("shaft_material", "--shaft-material NAME", PARTS, str, MATERIALS),
    BearingOption("shaft_strength_MPa", "--shaft-strength MPA", PARTS, float, "Allowable hoop stress of the shaft."),
    BearingOption("housing_rz_um", "--housing-rz UM", PARTS, float, "Roughness Rz of the housing."),
    BearingOption("housing_outer_mm", "--housing-outer MM", PARTS, float, "Outer diameter of the housing."),
    BearingOption("housing_material", "--housing-material NAME", PARTS, str, MATERIALS),
    BearingOption(
        "housing_strength_MPa", "--housing-strength MPA", PARTS, float, "Allowable hoop stress of the housing."
    ),
    BearingOption("housing_split", "--housing-split", PARTS, bool, "The housing is split in two halves."),
    BearingOption("internal_clearance", "--internal-clearance GROUP", THERMAL, str, "C2, CN, C3, C4 or C5."),
    BearingOption("temperature_rise_K", "--temperature-rise K", THERMAL, float, "Bearing warmer than at mounting."),
    BearingOption(
        "temperature_range_K", "--temperature-range LOW:HIGH", THERMAL, str, "Lowest and highest above mounting."
    ),
    BearingOption(
        "ring_temperature_difference_K",
        "--ring-temperature-difference K",
        THERMAL,
        float,
        "Inner ring warmer than its shaft.",
    ),
    BearingOption(
        "housing_temperature_difference_K",
        "--housing-temperature-difference K",
        THERMAL,
        float,
        "Housing warmer than the outer ring.",
    ),
    BearingOption(
        "raceway_temperature_difference_K",
        "--raceway-temperature-difference K",
        THERMAL,
        float,
        "Inner ring warmer than the outer ring.",
    ),
)
SELDOM: Final = (
    *(LIFE, PARTS, THERMAL),
    *("--chamfer", "--bearing-class", "--series", "--dynamic-load-rating", "--static-load-rating", "--name"),
    *("--load-kind", "--starting-torque", "--shaft-limits", "--housing-limits", "--asked-interference"),
    *("--cutting-force", "--normal-to-cutting", "--bearings-sharing", "--mounting-clearance"),
    *("--ring-bore-limits", "--ring-outer-limits", "--bearing-type", "--explain"),
    *("--seat-friction", "--short-pairs-warn", "--short-pairs-fail", "--figure", "--force", "--quiet", "--no-color"),
)
"""Panels and options that `--help` lists by name, so that it fits on a screen."""
NAMES: Final = {option.key: option.name for option in OPTIONS}
"""The option of each key."""

SIZES: Final = ("bore_mm", "outer_mm", "width_mm")
FITS: Final = ("shaft_fit", "housing_fit")
BANDS: Final = (
    *("asked_interference_um", "shaft_limits_um", "housing_limits_um", "temperature_range_K"),
    *("ring_bore_limits_um", "ring_outer_limits_um"),
)
"""Keys that an option gives as LOW:HIGH."""


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
    """The two numbers of LOW:HIGH."""
    try:
        least, most = (float(part) for part in text.split(":"))
    except ValueError:
        option = Place(key=NAMES[key])
        raise InputError(
            "two numbers are expected", place=option, found=text, allowed="LOW:HIGH, such as 10:28"
        ) from None
    return [least, most]


def check_fit(
    machine: Annotated[str | None, typer.Argument(metavar="MACHINE", help="Machine file or name of a preset.")] = None,
    set_: Overrides = None,
    explain: Annotated[bool, option("--explain", "Print the report with every formula.")] = False,
    **bearing: object,
) -> Outcome:
    """Check bearing seats, or recommend their tolerance classes.

    Specify a machine file, or one bearing by options. The checks cover interference, creep, stress and clearance.
    """
    from abu_calc.features.seats.study import check_fit as study

    given = {key: value for key, value in bearing.items() if value is not None}
    source = _of_options(given, set_ or ()) if machine is None else _of_file(machine, set_ or (), given)
    return outcome_of(study(source), explain=explain)


def outcome_of(result: "CheckFitResult", *, explain: bool = False) -> Outcome:
    """Outcome of a result: how it is shown and written; `explain`: with every formula."""
    short = None if explain else lambda: _screen(result)
    return Outcome.of(result, lambda: _blocks(result, explain), short, lambda: _drawings(result))


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
        raise InputError(
            "a file and options of one bearing exclude each other",
            found=NAMES[next(iter(given))],
            remedy="Remove the file or the options.",
        )
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
    add_command(app, "check-fit", check_fit, (option.parameter for option in OPTIONS), drawn=(".svg",), seldom=SELDOM)
