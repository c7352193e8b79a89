"""`abu check-fit [MACHINE]`: bearing seats of a file, or of one bearing given by options.

The options of one bearing are one for each key of [[bearing]]. They are typed here and not read from the model, which
takes longer to load than the help of all commands.
"""

import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Final

from abu_calc.cli.command import EXPLAIN, MACHINE, SET, Answer, Command, Option, Study
from abu_calc.foundation.errors import InputError, Place

if TYPE_CHECKING:
    from abu_calc.inputs.read_machine import Machine

BEARING: Final = "Bearing"
LOADS: Final = "Loads and speed"
LIFE: Final = "Rating life"
SEATS: Final = "Fits"
PARTS: Final = "Shaft and housing"
THERMAL: Final = "Temperatures and clearance"
KINDS: Final = "rotating, stationary or indeterminate."
MATERIALS: Final = "steel, stainless-steel, cast-iron, aluminium or magnesium."
OPTIONS: Final = (
    Option("designation", str, "--designation NAME", "Designation, such as 6203 or 7516.", BEARING),
    Option("bore_mm", float, "--bore MM", "Bore of the inner ring.", BEARING),
    Option("outer_mm", float, "--outer MM", "Outer diameter.", BEARING),
    Option("width_mm", float, "--width MM", "Width of the ring.", BEARING),
    Option("chamfer_mm", float, "--chamfer MM", "Chamfer of one edge.", BEARING),
    Option("bearing_type", str, "--bearing-type NAME", "Type if sizes are given: ball, cylindrical, needle …", BEARING),
    Option("bearing_class", str, "--bearing-class NAME", "Normal, P6, P5, P4 or P2.", BEARING),
    Option("series", str, "--series NAME", "light, medium or heavy.", BEARING),
    Option("dynamic_load_rating_kN", float, "--dynamic-load-rating KN", "Basic dynamic load rating C.", BEARING),
    Option("static_load_rating_kN", float, "--static-load-rating KN", "Basic static load rating C0.", BEARING),
    Option("name", str, "--name NAME", "Name of the bearing in the report.", BEARING),
    Option("radial_load_kN", float, "--radial-load-kN KN", "Radial load.", LOADS),
    Option("cutting_force_N", float, "--cutting-force N", "Cutting force, in place of the radial load.", LOADS),
    Option(
        "normal_to_cutting_ratio", float, "--normal-to-cutting RATIO", "Normal force over cutting force (2.8).", LOADS
    ),
    Option("bearings_sharing", int, "--bearings-sharing N", "Bearings that share this load (1).", LOADS),
    Option("axial_load_kN", float, "--axial-load-kN KN", "Axial load.", LOADS),
    Option("load_kind", str, "--load-kind NAME", "moderate (to 150 %) or shock (to 300 %).", LOADS),
    Option("inner_ring_load", str, "--inner-ring-load NAME", f"Inner ring: {KINDS}", LOADS),
    Option("outer_ring_load", str, "--outer-ring-load NAME", f"Outer ring: {KINDS}", LOADS),
    Option("speed_rpm", float, "--speed RPM", "Speed of the shaft.", LOADS),
    Option("starting_torque_N_m", float, "--starting-torque NM", "Torque that the seat must transmit.", LOADS),
    Option(
        "lubricant_viscosity_mm2_per_s", float, "--lubricant-viscosity MM2/S", "Viscosity at its temperature.", LIFE
    ),
    Option("contamination_factor", float, "--contamination-factor RATIO", "e_C of ISO 281: 1 clean … 0 dirty.", LIFE),
    Option("required_life_h", float, "--required-life H", "Rating life that is required.", LIFE),
    Option("position_mm", float, "--position MM", "Place along the spindle from the wheel's centre.", LIFE),
    Option("shaft_fit", str, "--shaft CLASS", "Class of the shaft: k6, or several: j5,k5.", SEATS),
    Option("housing_fit", str, "--housing CLASS", "Class of the housing: H7, or several.", SEATS),
    Option("shaft_limits_um", str, "--shaft-limits LOW:HIGH", "Measured limits of the shaft, µm.", SEATS),
    Option("housing_limits_um", str, "--housing-limits LOW:HIGH", "Measured limits of the housing, µm.", SEATS),
    Option("ring_bore_limits_um", str, "--ring-bore-limits LOW:HIGH", "Measured bore of the ring, µm.", SEATS),
    Option("ring_outer_limits_um", str, "--ring-outer-limits LOW:HIGH", "Measured outer diameter, µm.", SEATS),
    Option("mounting_clearance_um", float, "--mounting-clearance UM", "Clearance of a heated ring.", SEATS),
    Option(
        "asked_interference_um", str, "--asked-interference LOW:HIGH", "Interference required of every pair, µm.", SEATS
    ),
    Option("short_pairs_warn_percent", float, "--short-pairs-warn PERCENT", "Share of short pairs that warns.", SEATS),
    Option("short_pairs_fail_percent", float, "--short-pairs-fail PERCENT", "Share of short pairs that fails.", SEATS),
    Option("seat_friction", float, "--seat-friction RATIO", "Friction coefficient of the seat.", SEATS),
    Option("shaft_rz_um", float, "--shaft-rz UM", "Roughness Rz of the shaft.", PARTS),
    Option("shaft_bore_mm", float, "--shaft-bore MM", "Bore of a hollow shaft.", PARTS),
    Option("shaft_material", str, "--shaft-material NAME", MATERIALS, PARTS),
    Option("shaft_strength_MPa", float, "--shaft-strength MPA", "Allowable hoop stress of the shaft.", PARTS),
    Option("housing_rz_um", float, "--housing-rz UM", "Roughness Rz of the housing.", PARTS),
    Option("housing_outer_mm", float, "--housing-outer MM", "Outer diameter of the housing.", PARTS),
    Option("housing_material", str, "--housing-material NAME", MATERIALS, PARTS),
    Option("housing_strength_MPa", float, "--housing-strength MPA", "Allowable hoop stress of the housing.", PARTS),
    Option("housing_split", bool, "--housing-split", "The housing is split in two halves.", PARTS),
    Option("internal_clearance", str, "--internal-clearance GROUP", "C2, CN, C3, C4 or C5.", THERMAL),
    Option("temperature_rise_K", float, "--temperature-rise K", "Bearing warmer than at mounting.", THERMAL),
    Option("temperature_range_K", str, "--temperature-range LOW:HIGH", "Lowest, highest: K above mounting.", THERMAL),
    Option(
        "ring_temperature_difference_K",
        float,
        "--ring-temperature-difference K",
        "Inner ring warmer than its shaft.",
        THERMAL,
    ),
    Option(
        "housing_temperature_difference_K",
        float,
        "--housing-temperature-difference K",
        "Housing warmer than the outer ring.",
        THERMAL,
    ),
    Option(
        "raceway_temperature_difference_K",
        float,
        "--raceway-temperature-difference K",
        "Inner ring warmer than the outer ring.",
        THERMAL,
    ),
)
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


def _judged(study: Study, machine: object = None, set_: Sequence[str] = (), **bearing: object) -> Answer:
    if machine is None:
        return study(_of_options(bearing, set_))
    if bearing:
        raise InputError(
            "a file and options of one bearing exclude each other",
            found=NAMES[next(iter(bearing))],
            remedy="Remove the file or the options.",
        )
    return study(machine)


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


COMMAND = Command(
    "seats.study:check_fit",
    (MACHINE._replace(default=None), SET, EXPLAIN._replace(text="Print the report with every formula."), *OPTIONS),
    "Specify a machine file, or one bearing by options. The checks cover interference, creep, stress and clearance.",
    around=_judged,
    drawn=(".svg",),
    seldom=(
        *(LIFE, PARTS, THERMAL),
        *("--chamfer", "--bearing-class", "--series", "--dynamic-load-rating", "--static-load-rating", "--name"),
        *("--load-kind", "--starting-torque", "--shaft-limits", "--housing-limits", "--asked-interference"),
        *("--cutting-force", "--normal-to-cutting", "--bearings-sharing", "--mounting-clearance"),
        *("--ring-bore-limits", "--ring-outer-limits", "--bearing-type", "--explain"),
        *("--seat-friction", "--short-pairs-warn", "--short-pairs-fail", "--figure", "--force", "--quiet"),
        *("--no-color", "--watch", "--json"),
    ),
)
