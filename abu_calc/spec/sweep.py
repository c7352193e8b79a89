"""[sweep]: a study of many machines like this one, as a table of its file."""

from typing import Annotated, Final, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema

from abu_calc.spec.plain import plain_number
from abu_calc.spec.table import Table, problem

MOST_RUNS: Final = 100_000_000
RUNS: Final = 100
"""Members where nothing says how many."""


def _by_key(value: object) -> object:
    """KEY=… as on the command line, a list of them, as a table by key."""
    if not isinstance(value, list) or not all(isinstance(entry, str) for entry in value):
        return value
    variations = {}
    for assignment in value:
        key, equals, how = assignment.partition("=")
        if not equals:
            raise problem("not KEY=…", found=assignment, allowed='"wheel.imbalance_g_mm=normal(265, 40)"')
        variations[key.strip()] = how.strip()
    return variations


def _texts(value: object) -> object:
    """Ways to vary are texts or lists of values; what each says is read where it is used."""
    for key, how in value.items() if isinstance(value, dict) else ():
        if not isinstance(how, (str, list)) or plain_number(how) is not None:
            raise problem("text or a list of values is expected", key, found=str(how), allowed='"normal(265, 40)"')
    return value


Vary = Annotated[
    dict[str, str | list[object]],
    BeforeValidator(_texts),
    BeforeValidator(_by_key),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "object", "additionalProperties": {"anyOf": [{"type": "string"}, {"type": "array"}]}},
                {"type": "array", "items": {"type": "string"}},
            ]
        }
    ),
]


class Sweep(Table):
    """Many machines like this one, for `abu sweep`: what varies among them, and how many there are."""

    vary: Vary | None = Field(
        default=None,
        description="What varies, as on the command line: KEY=LOW:HIGH:N, A,B,…, uniform(LOW, HIGH), normal(MEAN, SD), "
        "lognormal(MEDIAN, SIGMA), triangular(LOW, MODE, HIGH) or choice(A, B, …). KEY is one of this file, or "
        "start.kind, start.angle_deg, start.eccentricity_deg, start.temperature_C. Or a table by key.",
        examples=[["autobalancer.race_eccentricity_mm=triangular(0, 0.005, 0.015)"]],
    )
    runs: int | None = Field(
        default=None,
        description="How many members; {range}. Without it as many as there are combinations of listed values, or "
        f"{RUNS}.",
        examples=[1000],
        ge=1,
        le=MOST_RUNS,
    )
    what: Literal["build", "design"] = Field(
        default="build",
        description="build: the design is fixed, each member is one machine built and switched on once; design: it is "
        "sized anew for each. Default: {default}.",
    )
    tolerances: bool = Field(
        default=False,
        description="true: also the drawing's own tolerances and the usual scatter of use. Default: {default}.",
    )
    grid: Annotated[tuple[str, ...], Field(strict=False, min_length=2, max_length=2)] | None = Field(
        default=None,
        description="Two of the keys with listed values, for a chart over them: across and upward.",
        examples=[["wheel.imbalance_g_mm", "machine.speed_rpm"]],
    )
    sensitivity: bool = Field(
        default=False,
        description="true: spend the runs that a Saltelli design needs on sensitivities. Default: {default}.",
    )
    sampling: Literal["latin-hypercube", "sobol"] = Field(
        default="latin-hypercube", description="How values are drawn: latin-hypercube or sobol. Default: {default}."
    )
    seed: int = Field(default=0, description="Of all that is drawn; {range}. Default: {default}.", ge=0, le=2**31 - 1)
    time_limit_s: float = Field(
        default=60.0,
        description="Longest time for one member [s]; {range}. Default: {default}; the next one follows.",
        gt=0,
        le=1e6,
    )
    least_share: float | None = Field(
        default=None,
        description="Share of members that must meet the limits; {range}. Without it nothing is asked.",
        examples=[0.95],
        ge=0,
        le=1,
    )
