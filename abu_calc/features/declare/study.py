"""The declared vibration value of a machine, without and with the autobalancer: the type test simulated."""

import math
from collections.abc import Iterator
from typing import Annotated, ClassVar, Final

import numpy as np

from abu_calc.dynamics.averaging.resting_places import SEED
from abu_calc.features.declare.records import (
    Cause,
    DeclaredAt,
    HandleValue,
    Plan,
    WheelInUse,
    WithAutobalancer,
    WithoutAutobalancer,
    beyond_capacity,
    remarks,
)
from abu_calc.features.declare.type_test_simulation import (
    STARTS,
    BreakEven,
    SimulatedTest,
    Spindle,
    search_break_even,
    simulated_test,
)
from abu_calc.features.design.judgement import judge
from abu_calc.features.design.next_step import harmless
from abu_calc.formulas.type_test import MANY, evenly, mean_over_orientations
from abu_calc.foundation.checks import Action, Check, coded, verdict
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.moved import Moved
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import shown
from abu_calc.foundation.validity import Range
from abu_calc.inputs.machine import MachineFile, TypeTest
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.result import Provenance, Result
from abu_calc.sizing import size as size_design
from abu_calc.sizing.actions import SIMULATED, followed, overrides, pins, words
from abu_calc.sizing.case import Case
from abu_calc.sizing.design import Design
from abu_calc.sizing.proposals import easier
from abu_calc.sizing.type_test import (
    carried,
    chosen_wheel,
    declared_bands,
    declared_check,
    required,
    weighted_speed,
)
from abu_calc.standards.vibration import TestWheel, declared_uncertainty, reproducibility, test_wheels

NUMBER: Final = Range("number of starts", 100, 1_000_000, key="starts")
NORMAL_95: Final = 1.6449
"""Standard deviations that 5 % of a normal distribution lie beyond."""


@record
class DeclareModel(Record):
    """SI numbers behind a simulated type test."""

    speed_rad_per_s: float
    weighting: float
    mass_without_autobalancer_kg: float
    mass_kg: float
    effective_mass_kg: float
    friction_band_m: float
    race_eccentricity_m: float
    handles: tuple[str, ...]
    transmission: tuple[float, ...]
    """Motion of each handle per motion of the race."""
    rest: tuple[float, ...]
    """Motion of each handle per imbalance at the wheel that balls in the race's plane leave [1/kg]."""


@record
class DeclareResult(Result):
    """A type test, simulated without and with the autobalancer."""

    command: ClassVar[str] = "declare"

    model: DeclareModel
    test_wheel: TestWheel
    handle: Annotated[str, Quantity("highest handle", "", 4, "with the autobalancer, if that is known")]
    body: Annotated[str, Quantity("machine", "", 4, "point mass, rigid body, or rigid body of estimated inertia")]
    without: WithoutAutobalancer
    with_: WithAutobalancer | None
    handles: tuple[HandleValue, ...]
    break_even_eccentricity: Annotated[
        float | None,
        Quantity("break-even race eccentricity", "Δ*", 3, "null: the declared value is lower at none", unit="mm"),
    ]
    break_even_frictionless: Annotated[float | None, Quantity("the same without friction", "Δ₀", unit="mm")]
    break_even_reason: Annotated[str | None, Quantity("why there is no break-even eccentricity")]
    friction_rms: Annotated[float | None, Quantity("displacement that friction leaves, rms", "c_f", 3, unit="mm")]
    lowers: Annotated[bool, Quantity("the autobalancer lowers the declared value")]
    causes: tuple[Cause, ...]
    background_a_hv_m_per_s2: Annotated[float, Quantity("background", "a_hv", 3)]
    background_limit_m_per_s2: Annotated[
        float, Quantity("background above which no autobalancer lowers the value", "a_hv", 3)
    ]
    wheel_in_use: WheelInUse
    plan: Plan
    by_eccentricity: tuple[DeclaredAt, ...]
    distribution_m_per_s2: Annotated[tuple[float, ...], Quantity("percentiles 0, 2, … 100 of single runs")]


@dataclass(frozen=True)
class _Tested:
    """Simulations of one design: with the test wheel, with the wheel in use, and the break-even search.

    `upright`: the spindle held vertical, if gravity shakes friction out of the horizontal one.
    """

    test: SimulatedTest
    in_use: SimulatedTest | None
    upright: SimulatedTest | None
    even: BreakEven


@checked
def declare(machine: Machine, starts: int = STARTS, progress: Progress = silent) -> DeclareResult:
    """Simulate the type test of a machine without and with its autobalancer.

    `starts`: how many starts are simulated; the seed is fixed. Raises InputError with file, line, key and action for
    what is wrong in the file, among it two races or a wheel diameter without a built-in test wheel.
    """
    NUMBER.check(starts)
    with machine.located():
        if machine.spindle is not None:
            raise InputError(
                "the declared value is that of a hand-held machine, which has one wheel",
                place=Place(key="autobalancer"),
                found="two [[autobalancer]]",
                allowed="one [wheel], one [autobalancer]",
                remedy="`abu size FILE` and `abu grinding FILE` judge machines with two races.",
            )
        tables = machine.whole("declare")
        wheel = _wheel(tables)
        design = size_design(tables)
        if not weighted_speed(design.case.speed):
            raise InputError(
                "W_h is not defined at this speed", place=Place(key="machine.speed_rpm"),
                found=f"{tables.machine.speed_rpm:g} rpm", allowed="337 … 84600 rpm",
            )  # fmt: skip
    spindle = Spindle.of(design.case, design.autobalancer)
    balancing = _balancing(design, wheel)
    tested = _tested(design, spindle, wheel, starts, progress) if balancing.status == "pass" else None
    return _result(machine, design, spindle, wheel, balancing, tested)


def _wheel(tables: MachineFile) -> TestWheel:
    """The test wheel; refused for a diameter that has none."""
    wheel = chosen_wheel(tables)
    if wheel is not None:
        return wheel
    given = tables.type_test and tables.type_test.test_wheel_diameter_mm
    raise InputError(
        "there is no built-in test wheel of this diameter",
        place=Place(key="wheel.diameter_mm" if given is None else "type_test.test_wheel_diameter_mm"),
        found=f"{tables.wheel.diameter_mm if given is None else given:g} mm",
        allowed=", ".join(f"{each.diameter_mm:g}" for each in test_wheels()),
        remedy="Set type_test.test_wheel_imbalance_g_mm, or type_test.test_wheel_diameter_mm to one of these.",
    )


def _balancing(design: Design, wheel: TestWheel) -> Check:
    """The region of the speed, and the capacity."""
    case, candidate = design.case, design.autobalancer
    need, capacity = required(case, candidate, wheel.imbalance), candidate.capacity
    if not design.frequency.balancing_possible:
        message = "Balls do not balance at the rated speed: it is not above the natural frequencies of the suspension"
        return coded("ABU433", "fail", message, capacity, need, "See ABU101 of `abu size`.")
    enough = carried(case, candidate, wheel.imbalance)
    requires, carry = shown(need, "g_mm", ".4g"), shown(capacity, "g_mm", ".4g")
    message = f"The test wheel requires {requires}, race eccentricity included; the balls carry {carry}"
    remedy = None
    if not enough:
        remedy = f"Specify more or larger balls, so that their capacity rises to {requires} or more."
    return coded("ABU433", verdict(enough), message, capacity, need, remedy)


def _tested(design: Design, spindle: Spindle, wheel: TestWheel, starts: int, progress: Progress) -> _Tested:
    eccentricity = design.case.race_eccentricity
    progress("type test")
    test = simulated_test(spindle, wheel.imbalance, eccentricity, starts)
    in_use = None
    if carried(design.case, design.autobalancer, design.imbalance.value):
        progress("wheel in use")
        in_use = simulated_test(spindle, design.imbalance.value, eccentricity, starts)
    whole, upright = Spindle.of(design.case, design.autobalancer, upright=True), None
    if whole.balls.band > spindle.balls.band:
        progress("spindle vertical")
        upright = simulated_test(whole, wheel.imbalance, eccentricity, starts)
    return _Tested(test, in_use, upright, search_break_even(test, starts, progress))


def _result(
    machine: Machine, design: Design, spindle: Spindle, wheel: TestWheel, balancing: Check, tested: _Tested | None
) -> DeclareResult:
    case, table = design.case, design.case.table
    bare, in_use = spindle.without(wheel.imbalance), spindle.without(design.imbalance.value)
    highest = max(bare, key=bare.__getitem__)
    uncertainty = declared_uncertainty(reproducibility(bare[highest]))
    test = None if tested is None else tested.test
    means = {} if test is None else test.means
    even = BreakEven(None, None, ()) if tested is None else tested.even
    used = None if tested is None or tested.in_use is None else max(tested.in_use.means.values())
    imbalance_alone = math.sqrt(max(bare[highest] ** 2 - spindle.background**2, 0.0))
    bare_band, band = declared_bands(case, design.autobalancer, wheel.imbalance) or (None, None)
    asked, limit = table.type_test or TypeTest(), imbalance_alone / math.sqrt(spindle.factor**2 - 1)
    plan = Plan(
        orientations=spindle.orientations,
        runs=asked.runs,
        operators=asked.operators,
        starts=0 if test is None else len(test.turns),
        seed=SEED,
        moving=0 if test is None else test.ends.moving,
    )
    with_ = None if tested is None else _with(tested, plan, band)
    return DeclareResult(
        title=table.machine.name,
        checks=(balancing, *_comparison(machine, design, wheel, bare[highest], uncertainty, tested, with_)),
        warnings=(
            *machine.warnings,
            *remarks(design, wheel, spindle, limit, test, with_),
            *beyond_capacity(design, wheel, even.simulated),
        ),
        provenance=Provenance.of(machine),
        model=_model(design, spindle),
        test_wheel=wheel,
        handle=highest if test is None else test.highest,
        body=_body(case),
        without=WithoutAutobalancer(
            handle=highest,
            a_hv_m_per_s2=bare[highest],
            K_m_per_s2=uncertainty,
            band_m_per_s2=bare_band and (bare_band[0] * bare[highest], bare_band[1] * bare[highest]),
        ),
        with_=with_,
        handles=tuple(
            HandleValue(name=name, without_m_per_s2=value, with_m_per_s2=means.get(name))
            for name, value in bare.items()
        ),
        break_even_eccentricity=even.simulated,
        break_even_frictionless=even.frictionless,
        break_even_reason=_no_break_even(tested),
        friction_rms=None if test is None else test.friction_rms,
        lowers=test is not None and test.declared < bare[highest],
        causes=() if test is None else _causes(test),
        background_a_hv_m_per_s2=spindle.background,
        background_limit_m_per_s2=limit,
        wheel_in_use=WheelInUse(
            imbalance=design.imbalance.value,
            without_m_per_s2=max(in_use.values()),
            with_m_per_s2=used,
        ),
        plan=plan,
        by_eccentricity=() if tested is None else _by_eccentricity(tested),
        distribution_m_per_s2=()
        if test is None
        else tuple(float(x) for x in np.quantile(test.values[test.highest], np.linspace(0, 1, 51))),
    )


def _model(design: Design, spindle: Spindle) -> DeclareModel:
    case = design.case
    return DeclareModel(
        speed_rad_per_s=case.speed,
        weighting=spindle.gain / case.speed**2,
        mass_without_autobalancer_kg=case.body.mass,
        mass_kg=design.system_mass,
        effective_mass_kg=spindle.body.effective_mass,
        friction_band_m=spindle.balls.band,
        race_eccentricity_m=case.race_eccentricity,
        handles=tuple(gain.name for gain in spindle.body.gains),
        transmission=tuple(math.sqrt(gain.race) for gain in spindle.body.gains),
        rest=tuple(math.sqrt(gain.imbalance) for gain in spindle.body.gains),
    )


def _body(case: Case) -> str:
    if case.body.estimate is not None:
        return "rigid body, inertia estimated"
    return "rigid body" if case.body.is_rigid else "point mass"


def _with(tested: _Tested, plan: Plan, band: tuple[float, float] | None) -> WithAutobalancer:
    """The type test at its highest handle; `band`: that of an estimated inertia, over the declared value."""
    test, upright = tested.test, tested.upright
    spindle, name = test.spindle, test.highest
    factor, series = spindle.factor, test.deviation_of_series(name)
    low, middle, high = (float(value) for value in np.quantile(test.values[name], (0.05, 0.5, 0.95)))
    away = NORMAL_95 * factor * series / math.sqrt(plan.runs * plan.operators)
    ideal = max(
        mean_over_orientations(gain, test.imbalance, test.eccentricity, evenly(MANY), spindle.background / spindle.gain)
        for gain in spindle.body.gains
    )
    return WithAutobalancer(
        handle=name,
        a_hv_m_per_s2=test.means[name],
        standard_error_m_per_s2=test.standard_error(name),
        p05=low,
        p50=middle,
        p95=high,
        factor=factor,
        declared_m_per_s2=test.declared,
        K_m_per_s2=declared_uncertainty(reproducibility(test.declared, factor * series / math.sqrt(plan.runs))),
        declared_low_m_per_s2=max(test.declared - away, 0.0),
        declared_high_m_per_s2=test.declared + away,
        no_friction_m_per_s2=spindle.gain * ideal,
        shaken_free=upright is not None and not spindle.balls.band,
        upright_m_per_s2=None if upright is None else upright.means[upright.highest],
        declared_band_m_per_s2=band and (band[0] * test.declared, band[1] * test.declared),
    )


def _causes(test: SimulatedTest) -> tuple[Cause, ...]:
    """Race eccentricity, friction, imbalance in another plane, background: each alone, the largest first."""
    gain = next(each for each in test.spindle.body.gains if each.name == test.highest)
    race, scale = math.sqrt(gain.race), test.spindle.gain
    parts = {
        "race eccentricity": scale * race * test.eccentricity,
        "rolling friction": scale * race * test.friction_rms,
        "test wheel": scale * math.sqrt(gain.imbalance) * test.imbalance,
        "background": test.spindle.background,
    }
    total = sum(value**2 for value in parts.values())
    return tuple(
        Cause(name=name, a_hv_m_per_s2=value, share=value**2 / total)
        for name, value in sorted(parts.items(), key=lambda part: -part[1])
        if value > 0
    )


def _by_eccentricity(tested: _Tested) -> tuple[DeclaredAt, ...]:
    test = tested.test
    points = {**dict(tested.even.tried), test.eccentricity: test.declared}
    return tuple(
        DeclaredAt(race_eccentricity=eccentricity, declared_m_per_s2=value)
        for eccentricity, value in sorted(points.items())
    )


def _no_break_even(tested: _Tested | None) -> str | None:
    if tested is None:
        return "The balls cannot balance the test wheel."
    if tested.even.simulated is not None:
        return None
    if tested.even.frictionless is None:
        return "A race without eccentricity and friction does not lower the declared value either."
    return "Rolling friction alone keeps the declared value up, even in a race without eccentricity."


def _comparison(
    machine: Machine, design: Design, wheel: TestWheel, without: float, uncertainty: float, tested: _Tested | None,
    with_: WithAutobalancer | None,
) -> Iterator[Check]:  # fmt: skip
    if tested is None or with_ is None:
        reason = "The balls cannot balance the test wheel"
        yield coded("ABU431", "not-done", reason, None, without)
        yield coded("ABU432", "not-done", reason, None, uncertainty)
        return
    declared = tested.test.declared

    starts = len(tested.test.turns)
    yield declared_check(without, declared, SIMULATED, lambda: _lower(machine, design, wheel, declared, starts))
    change, K = abs(without - declared), max(uncertainty, with_.K_m_per_s2)
    message = f"The declared value {'falls' if declared < without else 'rises'} by {change:.3g} m/s²; K is {K:.3g} m/s²"
    yield coded("ABU432", verdict(True, change > K), message, change, K)


def _lower(machine: Machine, design: Design, wheel: TestWheel, present: float, starts: int) -> Action | str:
    """The first change of race and friction with which the declared value [m/s²] falls, sized anew and simulated.

    No check of `abu size` gets worse with it.
    """
    before: tuple[Check, ...] | None = None
    for entries in easier(design):
        after = followed(design.case, entries)
        if after is None or not carried(after.case, after.candidate, wheel.imbalance):
            continue
        spindle = Spindle.of(after.case, after.candidate)
        test = simulated_test(spindle, wheel.imbalance, after.case.race_eccentricity, starts)
        without, line = max(spindle.without(wheel.imbalance).values()), overrides({**entries, **pins(after.candidate)})
        if test.declared < without:
            before = before or judge(design.case.table).checks
            if harmless(machine, before, line):
                moved = Moved("the declared value with the autobalancer", present, test.declared, "m/s²", without)
                return Action(f"Set {words(entries)}: {moved.text} ({SIMULATED}).", line)
    return "No smaller race eccentricity or friction arm that was tried lowers it. `abu declare FILE` lists the causes."
