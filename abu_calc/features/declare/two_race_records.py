"""Result of `abu declare` for a machine with two races, in user units."""

from typing import Annotated, ClassVar

from abu_calc.features.declare.records import (
    DeclaredAt,
    HandleValue,
    Plan,
    TestWheelRecord,
    WithAutobalancer,
    WithoutAutobalancer,
)
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.simulation.result import Result


@record
class TestWheelPlace(Record):
    """The test wheel on one wheel place: values at its highest handle, the factor not included."""

    __test__ = False

    wheel: Annotated[str, Quantity("wheel place")]
    plane_mm: Annotated[float, Quantity("place along the spindle", "z_j")]
    diameter_mm: Annotated[float | None, Quantity("diameter of the test wheel", "", 4)]
    imbalance_g_mm: Annotated[float, Quantity("imbalance of the test wheel", "U")]
    required_g_mm: Annotated[tuple[float, ...], Quantity("required capacity of each race, worst angles", "V_i")]
    without_m_per_s2: Annotated[float, Quantity("without autobalancers", "a_hv", 4)]
    with_m_per_s2: Annotated[float | None, Quantity("with autobalancers", "a_hv", 4)]


@record
class WheelsInUse(Record):
    """The wheels in use instead of the test wheel, at the highest handle, the factor not included."""

    imbalances_g_mm: Annotated[tuple[float, ...], Quantity("imbalances", "U_j")]
    without_m_per_s2: Annotated[float, Quantity("without autobalancers, worst phase", "a_hv", 4)]
    with_m_per_s2: Annotated[float | None, Quantity("with autobalancers", "a_hv", 4)]


@record
class TwoRaceDeclareModel(Record):
    """SI numbers behind a simulated type test of two races."""

    speed_rad_per_s: float
    weighting: float
    mass_without_autobalancers_kg: float
    mass_kg: float
    friction_bands_m: tuple[float, ...]
    race_eccentricity_m: float
    races_m: tuple[float, ...]
    handles: tuple[str, ...]
    transmission: tuple[tuple[float, ...], ...]
    """Motion of each handle per motion of each race."""


@record
class TwoRaceDeclareResult(Result):
    """A type test of a machine with two races, simulated without and with both autobalancers.

    Values are null if no handle is given or the balls cannot balance the test wheel.
    """

    command: ClassVar[str] = "declare"

    model: TwoRaceDeclareModel
    test_wheel: TestWheelRecord | None
    test_wheels: tuple[TestWheelPlace, ...]
    handle: Annotated[str | None, Quantity("highest handle", "", 4, "with the autobalancers, if that is known")]
    without: WithoutAutobalancer | None
    with_: WithAutobalancer | None
    handles: tuple[HandleValue, ...]
    break_even_eccentricity_mm: Annotated[
        float | None, Quantity("break-even race eccentricity", "Δ*", 3, "null: the declared value is lower at none")
    ]
    break_even_frictionless_mm: Annotated[float | None, Quantity("the same without friction", "Δ₀", 4)]
    friction_rms_mm: Annotated[float | None, Quantity("displacement that friction leaves, rms", "c_f", 3)]
    lowers: Annotated[bool, Quantity("the autobalancers lower the declared value")]
    background_a_hv_m_per_s2: Annotated[float, Quantity("background", "a_hv", 3)]
    wheel_in_use: WheelsInUse | None
    plan: Plan
    by_eccentricity: tuple[DeclaredAt, ...]
    distribution_m_per_s2: Annotated[tuple[float, ...], Quantity("percentiles 0, 2, … 100 of single runs")]
