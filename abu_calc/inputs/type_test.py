"""Table of the type test that gives the declared vibration value of a hand-held grinder."""

from typing import Annotated, ClassVar

from pydantic import BeforeValidator, Field

from abu_calc.inputs.reading.table import Table, entry

Angle = Annotated[float, Field(ge=-360, le=360)]


def _even(value: object) -> object:
    """A number of orientations as their angles, evenly spaced from 0."""
    if isinstance(value, int) and not isinstance(value, bool) and 1 <= value <= 360:
        return tuple(360.0 * k / value for k in range(value))
    return value


class TypeTest(Table):
    """Type test of `abu declare`: test wheel, orientations, runs, operators."""

    __test__: ClassVar[bool] = False  # not a test of pytest

    test_wheel_diameter_mm: float | None = entry(None, gt=0, le=1000, usual=(20, 300), example=150.0).means(
        "Diameter of the test wheel [mm]; {range}. The imbalance is built in for 25, 50, 80, 100, 125, 150 and 200 mm, "
        "and by a rule for 115, 180 and 230 mm. Without it: the diameter of the wheel."
    )
    test_wheel_imbalance_g_mm: float | None = entry(None, gt=0, le=1e6, usual=(2, 1000), example=65.0).means(
        "Imbalance of the test wheel [g·mm]; {range}. Without it: that of the test wheel of this diameter."
    )
    orientations: (
        Annotated[
            tuple[Angle, ...],
            Field(strict=False, min_length=1, max_length=360),
            BeforeValidator(
                _even,
                json_schema_input_type=Annotated[int, Field(ge=1, le=360)]
                | Annotated[tuple[Angle, ...], Field(min_length=1, max_length=360)],
            ),
        ]
        | None
    ) = entry(None, example=5).means(
        "Orientations of the test wheel on the spindle: their number, evenly spaced, or a list of angles [degrees]. "
        "Without it: 5."
    )
    runs: Annotated[int, Field(ge=1, le=1000)] = entry(1).means(
        "Starts at each orientation by each operator; 1 … 1000. Default: {default}."
    )
    operators: Annotated[int, Field(ge=1, le=100)] = entry(3).means("Operators; 1 … 100. Default: {default}.")
    background_a_hv_m_per_s2: float | None = entry(None, ge=0, le=1000, usual=(0.05, 20), example=1.0).means(
        "Weighted acceleration a_hv with a balanced wheel, of motor and gear [m/s²]; {range}. It is added to every "
        "value as energy. Without it: 0."
    )
