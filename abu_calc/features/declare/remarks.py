"""Remarks on a simulated type test: what the declared value leaves out, and where its facts are from."""

from collections.abc import Iterator
from typing import Final

from abu_calc.features.declare.records import WithAutobalancer
from abu_calc.features.declare.type_test_simulation import SimulatedTest, Spindle
from abu_calc.formulas.shaken_friction import friction_number
from abu_calc.foundation.units import shown
from abu_calc.sizing.design import Design
from abu_calc.sizing.handles import body_advice
from abu_calc.sizing.type_test import required
from abu_calc.standards.type_test import TestWheel, uncertainty_source

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
