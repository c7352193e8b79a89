"""A machine file as a whole, and the rules between its tables."""

from typing import Annotated, ClassVar, Self

from pydantic import AfterValidator, Field, WithJsonSchema, model_validator

from abu_calc.spec.autobalancer import Autobalancer
from abu_calc.spec.bearing import Bearing
from abu_calc.spec.body import Limits, MachineName, MachineTable, Suspension
from abu_calc.spec.duty import Grinding, Motor, RunUp, SwingArm
from abu_calc.spec.table import Table, problem
from abu_calc.spec.text import is_number, shown_short
from abu_calc.spec.wheel import Wheel

__all__ = [
    "Autobalancer",
    "Bearing",
    "BearingFile",
    "Grinding",
    "Limits",
    "Machine",
    "MachineName",
    "MachineTable",
    "Motor",
    "RunUp",
    "Suspension",
    "SwingArm",
    "Wheel",
    "expected_tolerances",
    "expected_values",
]

TOLERANCE = "tolerance"


def _checked_expectations(expected: dict[str, object]) -> dict[str, object]:
    for path, value in expected.items():
        if path == TOLERANCE and isinstance(value, dict):
            _check_tolerances(value, expected)
        elif isinstance(value, dict):
            raise problem(
                "an expected value is a number, text, true, false or a list",
                path,
                found="a table",
                remedy=f'put the whole path in quotes: "{path}.…" = …',
            )
        elif isinstance(value, (int, float)) and not isinstance(value, bool) and not is_number(value):
            raise problem("a finite number is expected", path, found=shown_short(value))
    return expected


def _check_tolerances(tolerances: dict[str, object], expected: dict[str, object]) -> None:
    for path, value in tolerances.items():
        if not is_number(value) or not isinstance(value, (int, float)) or value < 0:
            raise problem(
                "a tolerance is a relative difference", TOLERANCE, path, found=shown_short(value), allowed="at least 0"
            )
        if path == TOLERANCE or path not in expected:
            raise problem(
                "a tolerance of nothing expected", TOLERANCE, path, remedy=f'add "{path}" = … to [expected], or drop it'
            )


_SCALARS = [{"type": kind} for kind in ("number", "string", "boolean", "array")]
Expected = Annotated[
    dict[str, object],
    AfterValidator(_checked_expectations),
    WithJsonSchema(
        {
            "type": "object",
            "properties": {
                TOLERANCE: {
                    "anyOf": [{"type": "object", "additionalProperties": {"type": "number", "minimum": 0}}, *_SCALARS],
                    "description": "Relative tolerance per path of [expected].",
                }
            },
            "additionalProperties": {"anyOf": _SCALARS},
        }
    ),
]

EXPECTED = (
    'What `abu verify` holds the file to: "quoted.path.in.result" = value; relative tolerances per path stand in '
    "[expected.tolerance]."
)


class Machine(Table):
    """A machine and the autobalancer wanted for it."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"autobalancer"})

    machine: MachineTable
    suspension: Suspension
    wheel: Wheel
    autobalancer: Autobalancer | None = None
    grinding: Grinding | None = None
    run_up: RunUp | None = None
    motor: Motor | None = None
    swing_arm: SwingArm | None = None
    bearing: Annotated[tuple[Bearing, ...], Field(strict=False)] = Field(
        default=(), description="Bearings and their seats: [[bearing]], any number."
    )
    limits: Limits = Field(default_factory=Limits)
    expected: Expected = Field(default_factory=dict, description=EXPECTED)

    @model_validator(mode="after")
    def _measured_at_a_handle(self) -> Self:
        names = [handle.name for handle in self.machine.handle]
        if self.wheel.measured_at is not None and self.wheel.measured_at not in names:
            raise problem(
                "no handle has this name",
                "wheel",
                "measured_at",
                found=shown_short(self.wheel.measured_at),
                allowed=", ".join(map(shown_short, names)) or "none, the file has no [[machine.handle]]",
                remedy="name a handle, or leave measured_at out (the wheel plane)",
            )
        return self

    @model_validator(mode="after")
    def _motor_reaches_speed(self) -> Self:
        if self.motor is not None and self.motor.no_load_speed_rpm < self.machine.speed_rpm:
            raise problem(
                "the motor cannot reach machine.speed_rpm",
                "motor",
                "no_load_speed_rpm",
                found=f"{self.motor.no_load_speed_rpm:g} rpm",
                allowed=f"at least {self.machine.speed_rpm:g} rpm",
                remedy="give the no-load speed at the spindle",
            )
        return self


class BearingFile(Table):
    """Bearings alone, for `abu check-fit`."""

    machine: MachineName
    bearing: Annotated[tuple[Bearing, ...], Field(strict=False, min_length=1)] = Field(
        description="Bearings and their seats: [[bearing]], at least one."
    )
    limits: Limits = Field(default_factory=Limits)
    expected: Expected = Field(default_factory=dict, description=EXPECTED)


def expected_values(file: Machine | BearingFile) -> dict[str, object]:
    """What `abu verify` compares: path in the result → value."""
    return {path: value for path, value in file.expected.items() if not isinstance(value, dict)}


def expected_tolerances(file: Machine | BearingFile) -> dict[str, float]:
    """Path in the result → relative tolerance, where one is given."""
    given = file.expected.get(TOLERANCE)
    return dict(given) if isinstance(given, dict) else {}
