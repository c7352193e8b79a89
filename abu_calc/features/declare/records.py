"""Parts of the result of `abu declare MACHINE`, in user units.

Remarks on a simulated type test: what the declared value leaves out, and where its facts are from.
"""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Final

from abu_calc.features.declare.type_test_simulation import SimulatedTest, Spindle
from abu_calc.formulas.friction_band import friction_number
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import shown
from abu_calc.sizing.design import Design
from abu_calc.sizing.handles import body_advice
from abu_calc.sizing.type_test import required
from abu_calc.standards.vibration import TestWheel, uncertainty_source


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


DOUBTFUL: Final = 0.01
"""Share of starts without an end that calls for a remark."""
STRAIGHT: Final = "straight"


def remarks(
    design: Design, wheel: TestWheel, spindle: Spindle, limit: float, test: SimulatedTest | None,
    with_: WithAutobalancer | None,
) -> Iterator[str]:  # fmt: skip
    """Remarks, those that move the value most first. `limit`: background that no autobalancer makes up for [m/s²]."""
    case = design.case
    if not case.body.is_rigid:
        yield (
            "The machine is a point mass here, which judges the autobalancer too hard: a rigid body has up to 3.4 "
            f"times the break-even eccentricity. {body_advice(case)}"
        )
    if not case.handles:
        yield "The file gives no handle: values are those of the wheel plane. Add a [[machine.handle]] for each hand."
    if with_ is not None and with_.upright_m_per_s2 is not None:
        number = friction_number(
            case.friction_arm, design.autobalancer.pitch_radius, design.autobalancer.ball_diameter / 2, case.speed
        )
        left = "nothing" if with_.shaken_free else "a part of itself"
        upright = with_.upright_m_per_s2
        yield (
            f"On the horizontal spindle gravity shakes the balls (friction over gravity: {number:.2g}), and "
            f"friction leaves {left}. With the spindle vertical friction holds them: {upright:.3g} m/s², declared "
            f"{with_.factor * upright:.3g} m/s²."
        )
    yield from _background(spindle, limit)
    yield from _sources(design, wheel)
    if test is not None and test.ends.moving > DOUBTFUL * len(test.turns):
        yield f"In {test.ends.moving} of {len(test.turns)} starts the balls had not come to rest."
    if test is not None and test.spindle.balls.band:
        yield (
            "Balls start at rest in the race at random places, and pass each other as points. `abu size` judges "
            "whether they stall and how soon they settle."
        )


def beyond_capacity(design: Design, wheel: TestWheel, even: float | None) -> Iterator[str]:
    """Remark on a break-even eccentricity [m] at which the balls no longer carry the test wheel at every angle."""
    if even is None:
        return
    case, candidate = design.case, design.autobalancer
    need = required(case, candidate, wheel.imbalance, even)
    if need > candidate.capacity:
        yield (
            f"At the break-even eccentricity the test wheel would require {shown(need, 'g_mm')}, and the "
            f"balls carry {shown(candidate.capacity, 'g_mm')}: such a race needs larger balls."
        )


def _background(spindle: Spindle, limit: float) -> Iterator[str]:
    if spindle.background > limit:
        yield (
            f"The background of {spindle.background:.3g} m/s² exceeds {limit:.3g} m/s²: no autobalancer, however "
            "perfect, lowers this declared value. Compare the values without the factor."
        )
    elif not spindle.background:
        yield (
            f"The background of motor and gear is left out. Above {limit:.3g} m/s² of it no autobalancer lowers the "
            "declared value. Measure it with a balanced wheel: type_test.background_a_hv_m_per_s2."
        )


def _sources(design: Design, wheel: TestWheel) -> Iterator[str]:
    layout = design.case.table.machine.layout
    if layout != STRAIGHT and wheel.status == "secondary":
        yield (
            f'The layout is "{layout}", and ISO 28927-4 is for straight grinders. Angle and vertical grinders have '
            "their own test wheels (ISO 28927-1), which are not built in: set type_test.test_wheel_imbalance_g_mm."
        )
    source, status = uncertainty_source()
    if wheel.status == "secondary":
        yield f"Test wheels and the factor are from {wheel.source}. K is by {source}: {status}."
    else:
        yield f"K is by {source}: {status}."
