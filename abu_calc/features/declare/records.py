"""Parts of the result of `abu declare MACHINE`, in user units."""

from typing import Annotated, ClassVar

from abu_calc.foundation.quantity import Quantity, Record, record


@record
class WithoutAutobalancer(Record):
    """The type test without the autobalancer, at its highest handle."""

    schema_title = "DeclaredWithout"
    optional: ClassVar[frozenset[str]] = frozenset({"band_m_per_s2"})

    handle: Annotated[str, Quantity("handle")]
    a_hv_m_per_s2: Annotated[float, Quantity("without autobalancer", "a_hv", 4)]
    band_m_per_s2: Annotated[
        tuple[float, float] | None, Quantity("95 % band of an estimated inertia", "a_hv", 3, "calculated")
    ]
    K_m_per_s2: Annotated[float, Quantity("uncertainty", "K_d", 3)]


@record
class WithAutobalancer(Record):
    """The type test with the autobalancer, at its highest handle; percentiles of single runs."""

    schema_title = "DeclaredWith"
    optional: ClassVar[frozenset[str]] = frozenset({"declared_band_m_per_s2"})

    handle: Annotated[str, Quantity("handle")]
    a_hv_m_per_s2: Annotated[float, Quantity("with", "a_hv", 4, "mean over starts and orientations, without factor")]
    standard_error_m_per_s2: Annotated[float, Quantity("standard error of the mean", "", 2)]
    p05: Annotated[float, Quantity("5 % of the runs are below", "", 3, "m/s²")]
    p50: Annotated[float, Quantity("half of the runs are below", "", 3, "m/s²")]
    p95: Annotated[float, Quantity("95 % of the runs are below", "", 3, "m/s²")]
    factor: Annotated[float, Quantity("factor for automatic balancing", "k_d", 2)]
    declared_m_per_s2: Annotated[float, Quantity("declared", "a_hd", 4, "the mean times the factor")]
    K_m_per_s2: Annotated[float, Quantity("uncertainty", "K_d", 3)]
    declared_low_m_per_s2: Annotated[float, Quantity("5 % of type tests declare less than", "", 3)]
    declared_high_m_per_s2: Annotated[float, Quantity("5 % of type tests declare more than", "", 3)]
    declared_band_m_per_s2: Annotated[
        tuple[float, float] | None, Quantity("95 % band of an estimated inertia", "a_hd", 3, "calculated")
    ]
    no_friction_m_per_s2: Annotated[float, Quantity("with, no rolling friction", "a_hv", 4, "without factor")]
    shaken_free: Annotated[
        bool,
        Quantity("gravity shakes the balls free", "", 4, "on a horizontal spindle; friction then leaves nothing"),
    ]
    upright_m_per_s2: Annotated[
        float | None,
        Quantity("with, spindle vertical", "a_hv", 4, "friction holds the balls; without factor; null: as in the file"),
    ]


@record
class HandleValue(Record):
    """One handle: a_hv without and with the autobalancer, the factor not included."""

    schema_title = "DeclaredHandle"

    name: Annotated[str, Quantity("handle")]
    without_m_per_s2: Annotated[float, Quantity("without autobalancer", "a_hv", 4)]
    with_m_per_s2: Annotated[float | None, Quantity("with autobalancer", "a_hv", 4)]


@record
class Cause(Record):
    """One cause alone at the highest handle, and its share of the mean square."""

    schema_title = "DeclaredCause"

    name: Annotated[str, Quantity("cause")]
    a_hv_m_per_s2: Annotated[float, Quantity("alone, rms", "a_hv", 3)]
    share: Annotated[float, Quantity("share of the mean square", "", 3, percent=True)]


@record
class WheelInUse(Record):
    """The wheel in use instead of the test wheel, at the highest handle, the factor not included."""

    imbalance: Annotated[float, Quantity("imbalance", "U", unit="g_mm")]
    without_m_per_s2: Annotated[float, Quantity("without autobalancer", "a_hv", 4)]
    with_m_per_s2: Annotated[float | None, Quantity("with autobalancer", "a_hv", 4)]


@record
class Plan(Record):
    """The type test as simulated."""

    schema_title = "TypeTestPlan"

    orientations: Annotated[tuple[float, ...], Quantity("orientations of the test wheel", unit="deg")]
    runs: Annotated[int, Quantity("starts at each orientation by each operator")]
    operators: Annotated[int, Quantity("operators")]
    starts: Annotated[int, Quantity("starts simulated")]
    seed: Annotated[int, Quantity("seed")]
    moving: Annotated[int, Quantity("starts without an end")]


@record
class DeclaredAt(Record):
    """Declared value with the autobalancer at one race eccentricity."""

    race_eccentricity: Annotated[float, Quantity("race eccentricity", "Δ", 3, unit="mm")]
    declared_m_per_s2: Annotated[float, Quantity("declared", "a_hd", 3)]
