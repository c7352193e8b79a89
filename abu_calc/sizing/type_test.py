"""Declared vibration value of a design in closed form, without and with the autobalancer.

`abu declare` simulates the type test; this estimate costs nothing, so that `abu size` can warn.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

from abu_calc.formulas.body_motion import BodyMotion
from abu_calc.formulas.friction_band import remaining_band
from abu_calc.formulas.rigid_body import PlacedBody, Vector
from abu_calc.formulas.suspension import dynamic_stiffness
from abu_calc.formulas.type_test import (
    MANY,
    HandleMotion,
    Motion,
    TypeTestBody,
    acceleration_per_displacement,
    break_even,
    evenly,
    friction_displacement,
    frictionless_break_even,
    mean_motion,
)
from abu_calc.foundation.checks import Action, Check, coded, verdict
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si
from abu_calc.inputs.machine import MachineFile
from abu_calc.sizing.actions import CALCULATED
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.places import body_suspension
from abu_calc.sizing.vibration import truer, truer_races
from abu_calc.standards.vibration import (
    TestWheel,
    balancing_factor,
    declared_uncertainty,
    reproducibility,
    test_wheel,
    third_octaves,
)

IN_FILE = "machine file"
"""Source of a test wheel whose imbalance the file gives."""


def chosen_wheel(table: MachineFile) -> TestWheel | None:
    """The test wheel that the file gives, else the built-in one of its diameter; None if there is none."""
    test = table.type_test
    given = None if test is None else test.test_wheel_diameter
    if test is not None and test.test_wheel_imbalance is not None:
        return TestWheel(
            diameter=given, imbalance=test.test_wheel_imbalance, feed_force=None, source=IN_FILE, status="given"
        )
    return test_wheel(table.wheel.diameter if given is None else given)


def type_test_body(case: Case, candidate: Candidate | None = None) -> TypeTestBody:
    """The machine without or with an autobalancer: race and handles per imbalance, its suspension included."""
    wheel, race = case.body.wheel, case.race_place
    motion = _motion_in_space(case, candidate) if case.body.in_space else _motion_along_spindle(case, candidate)

    def forward(force_at: Vector) -> complex:
        x, y, _ = motion(race, force_at)
        return (x + 1j * y) / 2

    return TypeTestBody(
        forward(wheel), forward(race),
        tuple(HandleMotion(held.name, motion(held.place, wheel), motion(held.place, race)) for held in case.places),
    )  # fmt: skip


Answers = Callable[[Vector, Vector], Motion]
"""Displacement at a place by an imbalance at another, with the sign of accelerations [1/kg]."""


def _motion_in_space(case: Case, candidate: Candidate | None) -> Answers:
    """Six degrees of freedom on their suspension; the balls' own mass is left out, which moves a value by 1 %."""
    body = case.body.body
    if candidate is not None:
        body = replace(body, mass=body.mass + candidate.mass - candidate.balls_mass)
    motion = BodyMotion(body, case.speed, body_suspension(case, carrying=candidate is not None))

    def answer(at: Vector, force_at: Vector) -> Motion:
        x, y, z = motion.response(at, force_at)
        return -x, -y, -z

    return answer


def _motion_along_spindle(case: Case, candidate: Candidate | None) -> Answers:
    """A point mass, or a body whose places lie on its spindle; the suspension acts as at the wheel."""
    added = 0.0 if candidate is None else candidate.mass
    mass = case.body.effective_mass(added)
    factors = [-mass * case.speed**2 / dynamic_stiffness(case.suspension, axis, case.speed, mass) for axis in (0, 1)]

    def answer(at: Vector, force_at: Vector) -> Motion:
        x, y, z = case.body.body.acceleration(at, force_at, added=added)
        return factors[0] * x, factors[1] * y, z

    return answer


@dataclass(frozen=True)
class DeclaredEstimate:
    """Declared values [m/s²] in closed form, at the highest handle of each state; eccentricities [m] or None."""

    without: float
    with_balls: float
    factor: float
    frictionless_break_even: float | None
    break_even: float | None

    @property
    def declared(self) -> float:
        """The value with the autobalancer, times the factor."""
        return self.factor * self.with_balls

    @property
    def uncertainty(self) -> float:
        """K [m/s²] of the value without the autobalancer: a smaller change cannot be told."""
        return declared_uncertainty(reproducibility(self.without))


def background(table: MachineFile) -> float:
    """a_hv of motor and gear [m/s²]; 0 if the file gives none."""
    test = table.type_test
    return 0.0 if test is None or test.background_a_hv_m_per_s2 is None else test.background_a_hv_m_per_s2


def upright_band(case: Case, candidate: Candidate) -> float:
    """Friction band b = k_r·R_p/r [m] of a vertical spindle."""
    return case.friction_arm * candidate.pitch_radius / (candidate.ball_diameter / 2)


def band(case: Case, candidate: Candidate) -> float:
    """Friction band [m] by which friction holds the balls: on a horizontal spindle what gravity leaves of it."""
    whole = upright_band(case, candidate)
    return remaining_band(whole, case.speed) if case.table.machine.spindle_axis == "horizontal" else whole


def declared_estimate(case: Case, candidate: Candidate, imbalance: float) -> DeclaredEstimate:
    """The type test with a test wheel of this imbalance [kg m], as mean over starts and orientations."""
    gain = acceleration_per_displacement(case.speed)
    noise = background(case.table) / gain
    bare, gains = type_test_body(case).gains, type_test_body(case, candidate).gains
    friction = friction_displacement(candidate.ball_count, band(case, candidate))
    without = max(math.hypot(each.without(imbalance), noise) for each in bare)
    with_balls = max(mean_motion(each, imbalance, case.race_eccentricity, friction, noise) for each in gains)
    factor = balancing_factor()
    ideal = frictionless_break_even(gains, imbalance, without / factor, evenly(MANY), noise)
    return DeclaredEstimate(
        gain * without, gain * with_balls, factor, ideal, None if ideal is None else break_even(ideal, friction)
    )


def weighted_speed(speed: float) -> bool:
    """True if W_h is defined at a speed [rad/s]."""
    bands, half = third_octaves(), 10**0.05
    return bands[0].centre / half <= speed <= bands[-1].centre * half


def declared_checks(case: Case, candidate: Candidate, possible: bool) -> Iterator[Check]:
    """The check for a rigid body in the hands; a point mass would be judged too hard, so nothing is said of one."""
    wheel = chosen_wheel(case.table)
    if wheel is None or not case.body.is_rigid or case.table.swing_arm is not None or not weighted_speed(case.speed):
        return
    if not possible or not carried(case, candidate, wheel.imbalance):
        return  # other checks say so, and `abu declare`
    estimate = declared_estimate(case, candidate, wheel.imbalance)
    yield declared_check(estimate.without, estimate.declared, CALCULATED)


def carried(case: Case, candidate: Candidate, imbalance: float) -> bool:
    """True if the balls can balance a test wheel with the race eccentricity at its worst angle."""
    return required(case, candidate, imbalance) <= candidate.capacity


def required(case: Case, candidate: Candidate, imbalance: float, eccentricity: float | None = None) -> float:
    """Capacity [kg m] that a test wheel requires: |g_rw/g_rr|·U + m_F·Δ; `eccentricity`: another Δ than the file's."""
    body = type_test_body(case, candidate)
    delta = case.race_eccentricity if eccentricity is None else eccentricity
    return abs(body.race_by_wheel / body.race_by_race) * imbalance + body.effective_mass * delta


def declared_check(
    without: float, declared: float, how: str, action: Callable[[], Action | str | None] = lambda: None
) -> Check:
    """Passes if the declared value [m/s²] falls; `how` it is known, `action`: asked for if it does not."""
    message = (
        f"Type test, highest handle ({how}): {without:.3g} m/s² without the autobalancer, {declared:.3g} m/s² with it, "
        f"the factor {balancing_factor():g} included"
    )
    lower = declared < without
    return coded("ABU431", verdict(True, lower), message, declared, without, None if lower else action())


def more_easily(case: Case, estimate: DeclaredEstimate, least: float) -> Iterator[dict[str, object]]:
    """Entries of a race that runs truer, to below the break-even eccentricity, or rolls more easily."""
    own, limit = case.autobalancer.race_eccentricity_mm, estimate.break_even
    for value in () if limit is None else truer(min(own, from_si(limit, "mm")), least):
        yield {"autobalancer.race_eccentricity_mm": value}
    yield from truer_races(case, least)


def declared_bands(case: Case, candidate: Candidate, imbalance: float) -> tuple[tuple[float, float], ...] | None:
    """Bands of the values without and with the autobalancer, over the nominal ones; None if nothing is estimated."""
    estimate = case.body.estimate
    if estimate is None:
        return None
    nominal = declared_estimate(case, candidate, imbalance)

    def values(placed: PlacedBody) -> tuple[float, float]:
        other = declared_estimate(case.with_body(placed), candidate, imbalance)
        return other.without / nominal.without, other.declared / nominal.declared

    return estimate.bands(values)
