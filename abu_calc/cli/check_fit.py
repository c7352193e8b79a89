"""`abu check-fit [MACHINE]`: bearing seats of a file, or of one bearing given by options."""

from typing import TYPE_CHECKING, Annotated, Any

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
}


def check_fit(
    machine: Annotated[
        str | None, typer.Argument(metavar="[MACHINE]", help="A machine file, or a preset's name.")
    ] = None,
    set_: Overrides = None,
    designation: Annotated[str | None, typer.Option("--designation", help="Such as 6203 or 7516.")] = None,
    bore: Annotated[float | None, typer.Option("--bore", help="Bore of the inner ring, mm.")] = None,
    outer: Annotated[float | None, typer.Option("--outer", help="Outer diameter, mm.")] = None,
    width: Annotated[float | None, typer.Option("--width", help="Width of the ring, mm.")] = None,
    chamfer: Annotated[float | None, typer.Option("--chamfer", help="Chamfer of one edge, mm.")] = None,
    radial_load: Annotated[float | None, typer.Option("--radial-load-kN", help="Radial load, kN.")] = None,
    series: Annotated[str | None, typer.Option("--series", help="light, medium or heavy.")] = None,
    inner_ring_load: Annotated[str | None, typer.Option(help="rotating, stationary or indeterminate.")] = None,
    outer_ring_load: Annotated[str | None, typer.Option(help="rotating, stationary or indeterminate.")] = None,
    bearing_class: Annotated[str | None, typer.Option("--bearing-class", help="0, 6, 5, 4 or 2.")] = None,
    shaft: Annotated[str | None, typer.Option("--shaft", help="Tolerance class of the shaft, such as k6.")] = None,
    housing: Annotated[
        str | None, typer.Option("--housing", help="Tolerance class of the housing, such as H7.")
    ] = None,
    name: Annotated[str | None, typer.Option("--name", help="What to call the bearing.")] = None,
) -> Outcome:
    """Judge bearing seats: interference, probability of clearance, what is required, what is permitted."""
    from abu_calc.cli.load import load

    values = (name, designation, bore, outer, width, chamfer, radial_load, series, inner_ring_load, outer_ring_load,
              bearing_class, shaft, housing)  # fmt: skip
    given = {key: value for key, value in zip(OPTIONS, values, strict=True) if value is not None}
    if machine is not None and given:
        raise InputError("a file and options of one bearing exclude each other", found=OPTIONS[next(iter(given))])
    if machine is not None:
        return fitted(load(machine, set_))
    bearing, defaults = _from_options(given)
    return _outcome((bearing,), None, defaults)


def fitted(loaded: "Loaded") -> Outcome:
    """The outcome for the bearings of a file that is read already."""
    from abu_calc.cli.load import located, source_of

    if not loaded.machine.bearing:
        raise InputError(
            "the file has no bearings", place=Place(loaded.file, key="bearing"), remedy="Add a table [[bearing]]."
        )
    with located(loaded):
        defaults = tuple(default for default in loaded.defaults_used if default[0].startswith("bearing"))
        return _outcome(loaded.machine.bearing, source_of(loaded), defaults)


def _from_options(given: dict[str, Any]) -> tuple["Bearing", tuple[tuple[str, object], ...]]:
    """The bearing that the options describe, and the defaults in force; refused as a file would be, by option."""
    from pydantic import ValidationError

    from abu_calc.spec.errors import Origin, told
    from abu_calc.spec.machine import BearingFile

    missing = [option for key, option in (("shaft_fit", "--shaft"), ("housing_fit", "--housing")) if key not in given]
    if "designation" not in given:
        missing = [OPTIONS[key] for key in ("bore_mm", "outer_mm", "width_mm") if key not in given] + missing
    if missing:
        raise InputError("a file, or the options of one bearing, are needed", found="no " + ", ".join(missing))
    document = {"machine": {"name": "options"}, "bearing": [{"name": "bearing", **given}]}
    try:
        bearing = BearingFile.model_validate(document).bearing[0]
    except ValidationError as error:
        places: dict[tuple[str | int, ...], str] = {("bearing", 0, key): option for key, option in OPTIONS.items()}
        raise told(error, Origin("", document, {}, places, BearingFile)) from None
    return bearing, tuple(bearing.own_defaults().items())


def _outcome(bearings: Any, source: Any, defaults: Any) -> Outcome:
    from abu_calc.checks import overall
    from abu_calc.fits.seats import seat_bearing
    from abu_calc.report.common import check_blocks, default_blocks
    from abu_calc.report.fits import fit_blocks, seats_result

    seats = [seat_bearing(bearing) for bearing in bearings]
    checks = tuple(check for bearing in seats for check in bearing.checks)
    result = [row for bearing in seats for row in seats_result(bearing)]
    blocks = (*fit_blocks(result), *check_blocks(checks), *default_blocks(defaults))
    return Outcome("check-fit", result, blocks, source, checks, status=overall(checks))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "check-fit", check_fit)
