"""Arrays with names and units for xarray, which is imported when somebody asks for that."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from abu_calc.foundation.errors import OutputError
from abu_calc.foundation.units import unit_of

if TYPE_CHECKING:
    from xarray import Dataset


def dataset(
    coordinates: Mapping[str, Any],
    variables: Mapping[str, tuple[tuple[str, ...], Any]],
    units: Mapping[str, str] | None = None,
    **attributes: object,
) -> "Dataset":
    """An xarray.Dataset: `coordinates` by dimension, `variables` by name with their dimensions and values.

    Each array has its unit among its attributes, that of its name unless `units` says another. Raises OutputError if
    xarray is not installed.
    """
    try:
        from xarray import Dataset
    except ImportError:
        raise OutputError(
            "a Dataset needs the package xarray, which is not installed", remedy="Install it: pip install xarray"
        ) from None
    made = Dataset(dict(variables), dict(coordinates), attributes)
    for name in [*coordinates, *variables]:
        if unit := (units or {}).get(name) or unit_of(name):
            made[name].attrs["units"] = unit
    return made
