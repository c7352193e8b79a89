"""`abu check-fit [MACHINE]`: bearing seats of a file, or of one bearing given by options."""

from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer

from abu_calc.cli.command import Overrides, add_command
from abu_calc.errors import InputError, Place
from abu_calc.report.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.spec.bearing import Bearing
    from abu_calc.spec.read import Loaded

OPTIONS = {
    "name": "--name",
    "designation": "--designation",
    "bore_mm": "--bore",
    "outer_mm": "--outer",
    "width_mm": "--width",
    "chamfer_mm": "--chamfer",
    "radial_load_kN": "--radial-load-kN",
    "series": "--series",
    "inner_ring_load": "--inner-ring-load",
    "outer_ring_load": "--outer-ring-load",
    "bearing_class": "--bearing-class",
    "shaft_fit": "--shaft",
    "housing_fit": "--housing",
    "shaft_rz_um": "--shaft-rz",
    "housing_rz_um": "--housing-rz",
    "ring_temperature_difference_K": "--ring-temperature-difference",
    "speed_rpm": "--speed",
    "shaft_bore_mm": "--shaft-bore",
    "housing_outer_mm": "--housing-outer",
    "housing_material": "--housing-material",
    "internal_clearance": "--internal-clearance",
    "raceway_temperature_difference_K": "--raceway-temperature-difference",
    "starting_torque_N_m": "--starting-torque",
    "seat_friction": "--seat-friction",
    "asked_interference_um": "--asked-interference",
}
"""The option of each key of [[bearing]]."""

Number: TypeAlias = float | None
Word: TypeAlias = str | None


def _option(key: str, told: str, metavar: str | None = None) -> Any:
    return typer.Option(OPTIONS[key], help=told, metavar=metavar)


def check_fit(
    machine: Annotated[
        str | None, typer.Argument(metavar="[MACHINE]", help="A machine file, or a preset's name.")
    ] = None,
    set_: Overrides = None,
    explain: Annotated[bool, typer.Option("--explain", help="Show every formula with its numbers and source.")] = False,
    designation: Annotated[Word, _option("designation", "Such as 6203 or 7516.")] = None,
    bore_mm: Annotated[Number, _option("bore_mm", "Bore of the inner ring, mm.")] = None,
    outer_mm: Annotated[Number, _option("outer_mm", "Outer diameter, mm.")] = None,
    width_mm: Annotated[Number, _option("width_mm", "Width of the ring, mm.")] = None,
    chamfer_mm: Annotated[Number, _option("chamfer_mm", "Chamfer of one edge, mm.")] = None,
    radial_load_kN: Annotated[Number, _option("radial_load_kN", "Radial load, kN.")] = None,
    series: Annotated[Word, _option("series", "light, medium or heavy.")] = None,
    inner_ring_load: Annotated[Word, _option("inner_ring_load", "rotating, stationary or indeterminate.")] = None,
    outer_ring_load: Annotated[Word, _option("outer_ring_load", "rotating, stationary or indeterminate.")] = None,
    bearing_class: Annotated[Word, _option("bearing_class", "0, 6, 5, 4 or 2.")] = None,
    shaft_fit: Annotated[Word, _option("shaft_fit", "Tolerance class of the shaft, such as k6.")] = None,
    housing_fit: Annotated[Word, _option("housing_fit", "Tolerance class of the housing, such as H7.")] = None,
    shaft_rz_um: Annotated[Number, _option("shaft_rz_um", "Roughness Rz of the shaft, µm.")] = None,
    housing_rz_um: Annotated[Number, _option("housing_rz_um", "Roughness Rz of the housing, µm.")] = None,
    ring_temperature_difference_K: Annotated[
        Number, _option("ring_temperature_difference_K", "Inner ring warmer than its shaft, K.")
    ] = None,
    speed_rpm: Annotated[Number, _option("speed_rpm", "Speed of the shaft, rpm.")] = None,
    shaft_bore_mm: Annotated[Number, _option("shaft_bore_mm", "Bore of a hollow shaft, mm.")] = None,
    housing_outer_mm: Annotated[Number, _option("housing_outer_mm", "Outer diameter of the housing, mm.")] = None,
    housing_material: Annotated[Word, _option("housing_material", "steel, cast-iron or aluminium.")] = None,
    internal_clearance: Annotated[Word, _option("internal_clearance", "Group C2, CN, C3 or C4.")] = None,
    raceway_temperature_difference_K: Annotated[
        Number, _option("raceway_temperature_difference_K", "Inner ring warmer than the outer one, K.")
    ] = None,
    starting_torque_N_m: Annotated[Number, _option("starting_torque_N_m", "Torque the seat must pass on, N·m.")] = None,
    seat_friction: Annotated[Number, _option("seat_friction", "Friction coefficient of the seat.")] = None,
    asked_interference_um: Annotated[
        Word, _option("asked_interference_um", "Interference asked of every pair, µm.", "LEAST:MOST")
    ] = None,
    name: Annotated[Word, _option("name", "What to call the bearing.")] = None,
) -> Outcome:
    """Judge bearing seats: interference, probability of clearance, what is required, what is permitted."""
    values = locals()
    given = {key: values[key] for key in OPTIONS if values[key] is not None}
    if machine is not None and given:
        raise InputError("a file and options of one bearing exclude each other", found=OPTIONS[next(iter(given))])
    if machine is not None:
        from abu_calc.cli.load import load

        return fitted(load(machine, set_), explain=explain)
    if set_:
        raise InputError("--set overrides entries of a file, and none is given", found=f"--set {set_[0]}")
    bearing, defaults = _from_options(given)
    return _outcome((bearing,), None, defaults, explain)


def fitted(loaded: "Loaded", *, explain: bool = False) -> Outcome:
    """The outcome for the bearings of a file that is read already."""
    from abu_calc.cli.load import located, source_of

    if not loaded.machine.bearing:
        raise InputError(
            "the file has no bearings", place=Place(loaded.file, key="bearing"), remedy="Add a table [[bearing]]."
        )
    with located(loaded):
        defaults = tuple(default for default in loaded.defaults_used if default[0].startswith("bearing"))
        return _outcome(loaded.machine.bearing, source_of(loaded), defaults, explain)


def _from_options(given: dict[str, Any]) -> tuple["Bearing", tuple[tuple[str, object], ...]]:
    """The bearing that the options describe, and the defaults in force; refused as a file would be, by option."""
    from pydantic import ValidationError

    from abu_calc.spec.bearing_file import BearingFile
    from abu_calc.spec.errors import Origin, input_error

    missing = [option for key, option in (("shaft_fit", "--shaft"), ("housing_fit", "--housing")) if key not in given]
    if "designation" not in given:
        missing = [OPTIONS[key] for key in ("bore_mm", "outer_mm", "width_mm") if key not in given] + missing
    if missing:
        raise InputError("a file, or the options of one bearing, are needed", found="no " + ", ".join(missing))
    if "asked_interference_um" in given:
        given = given | {"asked_interference_um": _band(given["asked_interference_um"])}
    document = {"machine": {"name": "options"}, "bearing": [{"name": "bearing", **given}]}
    try:
        bearing = BearingFile.model_validate(document).bearing[0]
    except ValidationError as error:
        places: dict[tuple[str | int, ...], str] = {("bearing", 0, key): option for key, option in OPTIONS.items()}
        raise input_error(error, Origin("", document, {}, places, BearingFile)) from None
    return bearing, tuple(bearing.own_defaults().items())


def _band(text: str) -> list[float]:
    """The two numbers of LEAST:MOST."""
    try:
        least, most = (float(part) for part in text.split(":"))
    except ValueError:
        option = Place(key=OPTIONS["asked_interference_um"])
        raise InputError("two numbers are expected", place=option, found=text, allowed="LEAST:MOST, 10:28") from None
    return [least, most]


def _outcome(bearings: Any, source: Any, defaults: Any, explain: bool) -> Outcome:
    from abu_calc.checks import overall
    from abu_calc.fits.seats import seat_bearing
    from abu_calc.report.common import check_blocks, default_blocks
    from abu_calc.report.fit_report import report_blocks
    from abu_calc.report.fits import seats_result

    seats = [seat_bearing(bearing) for bearing in bearings]
    checks = tuple(check for bearing in seats for check in bearing.checks)
    result = [row for bearing in seats for row in seats_result(bearing)]
    blocks = (*report_blocks(result), *check_blocks(checks), *default_blocks(defaults))
    if explain:
        from abu_calc.report.explain import STEPS, step_blocks
        from abu_calc.report.fit_numbers import seat_numbers

        blocks += tuple(step_blocks(STEPS["seats"], tuple(line for one in seats for line in seat_numbers(one))))
    return Outcome("check-fit", result, blocks, source, checks, status=overall(checks))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "check-fit", check_fit)
