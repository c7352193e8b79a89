"""The declared vibration value of a machine with two races: the test wheel on one wheel place at a time."""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from abu_calc.dynamics.averaging.resting_places import SEED
from abu_calc.features.declare.records import (
    DeclaredAt,
    HandleValue,
    Plan,
    TestWheelRecord,
    WithAutobalancer,
    WithoutAutobalancer,
)
from abu_calc.features.declare.remarks import background_remarks, source_remark
from abu_calc.features.declare.two_race_records import (
    TestWheelPlace,
    TwoRaceDeclareModel,
    TwoRaceDeclareResult,
    WheelsInUse,
)
from abu_calc.features.declare.two_race_test import (
    DIRECTIONS,
    TestedSpindle,
    TwoRaceBreakEven,
    TwoRaceTest,
    carried,
    mean_without_friction,
    required_capacities,
    search_two_race_break_even,
    simulated_two_race_test,
)
from abu_calc.features.declare.type_test_simulation import with_autobalancer
from abu_calc.features.two_races.advice import changed
from abu_calc.features.two_races.case import read_case
from abu_calc.features.two_races.choice import TwoRaceDesign, choose_both
from abu_calc.formulas.two_races import PlacedImbalance, two_races_balance
from abu_calc.foundation.checks import Action, Check, coded, verdict
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress
from abu_calc.foundation.units import from_si, to_si
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.two_races import PlacedWheel, TwoRaceFile
from abu_calc.simulation.result import Provenance
from abu_calc.sizing.actions import SIMULATED
from abu_calc.sizing.type_test import ChosenWheel, chosen_wheel_of, weighted_speed
from abu_calc.standards.type_test import declared_uncertainty, reproducibility, test_wheels

SHARES_OF_BREAK_EVEN: Final = (0.9, 0.6)
SHARES_OF_IDEAL: Final = (0.5, 0.25)
SMOOTHER: Final = (0.5, 0.25)
"""Shares of the break-even eccentricity, of that without friction, and of the friction arm that are tried."""
NO_HANDLE: Final = "No hands hold this machine: the file gives no [[machine.handle]], so no value can be declared"
ADD_HANDLE: Final = (
    "Add a [[machine.handle]] with from_center_of_mass_mm for each place on the spindle axis that hands hold. A "
    "machine on a stand declares no hand-arm vibration: `abu size FILE` gives levels at its bearings."
)


@dataclass(frozen=True)
class MountedWheel:
    """A wheel place with its test wheel, as an imbalance at that place."""

    name: str
    wheel: ChosenWheel
    load: PlacedImbalance


@dataclass(frozen=True)
class TestedDesign:
    """Simulations of one design: the test wheel on each wheel place, the wheels in use, and the break-even search."""

    __test__ = False

    tests: tuple[TwoRaceTest, ...]
    worst: TwoRaceTest
    in_use: TwoRaceTest | None
    upright: TwoRaceTest | None
    even: TwoRaceBreakEven


def declare_two_races(machine: Machine, tables: TwoRaceFile, starts: int, progress: Progress) -> TwoRaceDeclareResult:
    """Simulate the type test of a machine with two races.

    ISO 28927-4 describes machines with one wheel. Here the test wheel sits on one wheel place at a time, the other
    places turn without imbalance, and the highest value counts. Raises InputError as the study of one race does.
    """
    with machine.located():
        design = choose_both(read_case(tables))
        mounted = tuple(_mounted(tables)) if tables.machine.handle else ()
        if not weighted_speed(design.case.speed):
            raise InputError(
                "W_h is not defined at this speed", place=Place(key="machine.speed_rpm"),
                found=f"{tables.machine.speed_rpm:g} rpm", allowed="337 … 84600 rpm",
            )  # fmt: skip
    spindle = TestedSpindle.of(design)
    if not mounted:
        return _without_hands(machine, design, spindle)
    balancing = _balancing(design, mounted)
    tested = _tested(spindle, mounted, starts, progress) if balancing.status == "pass" else None
    return _result(machine, spindle, mounted, balancing, tested)


def _mounted(tables: TwoRaceFile) -> Iterator[MountedWheel]:
    """The test wheel of each wheel place; refused for a diameter that has none."""
    for index, wheel in enumerate(tables.wheel):
        chosen = chosen_wheel_of(tables.type_test, wheel.diameter_mm)
        if chosen is None:
            test = tables.type_test
            given = None if test is None else test.test_wheel_diameter_mm
            raise InputError(
                "there is no built-in test wheel of this diameter",
                place=Place(key=f"wheel.{index}.diameter_mm" if given is None else "type_test.test_wheel_diameter_mm"),
                found=f"{wheel.diameter_mm if given is None else given:g} mm",
                allowed=", ".join(f"{from_si(each.diameter, 'mm'):g}" for each in test_wheels()),
                remedy="Set type_test.test_wheel_imbalance_g_mm, or type_test.test_wheel_diameter_mm to one of these.",
            )
        yield MountedWheel(_named(wheel, index), chosen, PlacedImbalance(to_si(wheel.plane_mm, "mm"), chosen.imbalance))


def _named(wheel: PlacedWheel, index: int) -> str:
    return wheel.name or f"wheel {index + 1}"


def _balancing(design: TwoRaceDesign, mounted: Sequence[MountedWheel]) -> Check:
    """ABU433: the region of the speed, and the capacity of the race with less to spare."""
    rows = []
    for each in mounted:
        needs = required_capacities(design, (each.load,))
        rows += [
            (race.design.autobalancer.capacity / need if need else float("inf"), number, each.name, need,
             race.design.autobalancer.capacity)
            for number, (need, race) in enumerate(zip(needs, design.races, strict=True), 1)
        ]  # fmt: skip
    _, number, name, need, capacity = min(rows)
    needed, there = from_si(need, "g_mm"), from_si(capacity, "g_mm")
    if not two_races_balance(design.case.rotor, design.case.speed):
        message = "Balls do not balance at the rated speed: it is not above both critical speeds"
        return coded("ABU433", "fail", message, there, needed, "g·mm", "See ABU101 of `abu size FILE`.", "least")
    enough = capacity >= need
    message = (
        f"The test wheel on {name} requires {needed:.4g} g·mm of race {number}, eccentricities included; its balls "
        f"carry {there:.4g} g·mm"
    )
    remedy = None if enough else f"Specify balls for race {number} that carry {needed:.4g} g·mm or more."
    return coded("ABU433", verdict(enough), message, there, needed, "g·mm", remedy, "least")


def _tested(
    spindle: TestedSpindle, mounted: Sequence[MountedWheel], starts: int, progress: Progress
) -> TestedDesign:  # fmt: skip
    design = spindle.design
    eccentricity, tests = design.case.eccentricity, []
    for each in mounted:
        progress(f"type test, test wheel on {each.name}")
        tests.append(simulated_two_race_test(spindle, (each.load,), eccentricity, starts))
    worst, in_use, upright = max(tests, key=lambda test: test.declared), None, None
    if carried(design, design.case.wheels):
        progress("wheels in use")
        in_use = simulated_two_race_test(
            spindle, design.case.turned(()), eccentricity, starts, free=bool(design.case.unknown_phases)
        )
    whole = TestedSpindle.of(design, upright=True)
    if whole.band > spindle.band:
        progress("spindle vertical")
        upright = simulated_two_race_test(whole, worst.loads, eccentricity, starts)
    progress("break-even eccentricity")
    limit = max(_without(spindle, mounted).values())
    return TestedDesign(tuple(tests), worst, in_use, upright, search_two_race_break_even(worst, limit, starts))


def _without(spindle: TestedSpindle, mounted: Sequence[MountedWheel]) -> dict[str, float]:
    """a_hv of each handle without autobalancers [m/s²], the test wheel on its worst place."""
    values = [spindle.without((each.load,)) for each in mounted]
    return {name: max(value[name] for value in values) for name in values[0]}


def _result(
    machine: Machine, spindle: TestedSpindle, mounted: Sequence[MountedWheel], balancing: Check,
    tested: TestedDesign | None,
) -> TwoRaceDeclareResult:  # fmt: skip
    bare = _without(spindle, mounted)
    highest = max(bare, key=bare.__getitem__)
    uncertainty = declared_uncertainty(reproducibility(bare[highest]))
    means = {} if tested is None else {name: max(test.means[name] for test in tested.tests) for name in bare}
    with_ = None if tested is None else _with(tested)
    worst = None if tested is None else tested.worst
    deciding = _deciding(spindle, mounted, worst)
    without = WithoutAutobalancer(
        handle=highest, a_hv_m_per_s2=bare[highest], K_m_per_s2=uncertainty, band_m_per_s2=None
    )
    return TwoRaceDeclareResult(
        title=machine.title,
        checks=(balancing, *_comparison(spindle, mounted, without, tested, with_)),
        warnings=(*machine.warnings, *_remarks(spindle, deciding, bare[highest], tested, with_)),
        provenance=Provenance.of(machine),
        model=_model(spindle),
        test_wheel=TestWheelRecord.read(deciding.wheel),
        test_wheels=tuple(_places(spindle, mounted, tested)),
        handle=highest if worst is None else worst.highest,
        without=without,
        with_=with_,
        handles=tuple(
            HandleValue(name=name, without_m_per_s2=value, with_m_per_s2=means.get(name))
            for name, value in bare.items()
        ),
        break_even_eccentricity_mm=None if tested is None else _mm(tested.even.simulated),
        break_even_frictionless_mm=None if tested is None else _mm(tested.even.frictionless),
        friction_rms_mm=None if worst is None else from_si(worst.friction_rms, "mm"),
        lowers=worst is not None and worst.declared < bare[highest],
        background_a_hv_m_per_s2=spindle.background,
        wheel_in_use=_in_use(spindle, tested),
        plan=_plan(spindle, worst),
        by_eccentricity=() if tested is None else _by_eccentricity(tested),
        distribution_m_per_s2=()
        if worst is None
        else tuple(float(x) for x in np.quantile(worst.values[worst.highest], np.linspace(0, 1, 51))),
    )


def _without_hands(machine: Machine, design: TwoRaceDesign, spindle: TestedSpindle) -> TwoRaceDeclareResult:
    """The result of a machine that no hands hold: no value, and the reason."""
    return TwoRaceDeclareResult(
        title=machine.title,
        checks=tuple(coded(code, "not-done", NO_HANDLE, remedy=ADD_HANDLE) for code in ("ABU431", "ABU432")),
        warnings=machine.warnings,
        provenance=Provenance.of(machine),
        model=_model(spindle),
        test_wheel=None,
        test_wheels=(),
        handle=None,
        without=None,
        with_=None,
        handles=(),
        break_even_eccentricity_mm=None,
        break_even_frictionless_mm=None,
        friction_rms_mm=None,
        lowers=False,
        background_a_hv_m_per_s2=spindle.background,
        wheel_in_use=None,
        plan=_plan(spindle, None),
        by_eccentricity=(),
        distribution_m_per_s2=(),
    )


def _deciding(spindle: TestedSpindle, mounted: Sequence[MountedWheel], worst: TwoRaceTest | None) -> MountedWheel:
    """The wheel place of the highest value: with the autobalancers, if that is known."""
    if worst is not None:
        return next(each for each in mounted if worst.loads == (each.load,))
    return max(mounted, key=lambda each: max(spindle.without((each.load,)).values()))


def _model(spindle: TestedSpindle) -> TwoRaceDeclareModel:
    design = spindle.design
    return TwoRaceDeclareModel(
        speed_rad_per_s=design.case.speed,
        weighting=spindle.gain / design.case.speed**2,
        mass_without_autobalancers_kg=design.bare.rotor.mass,
        mass_kg=design.system_mass,
        friction_bands_m=tuple(balls.band for balls in spindle.balls),
        race_eccentricity_m=design.case.eccentricity,
        races_m=design.case.races,
        handles=tuple(handle.name for handle in spindle.handles),
        transmission=tuple(spindle.shares(handle) for handle in spindle.handles),
    )


def _places(
    spindle: TestedSpindle, mounted: Sequence[MountedWheel], tested: TestedDesign | None
) -> Iterator[TestWheelPlace]:
    for index, each in enumerate(mounted):
        needs = required_capacities(spindle.design, (each.load,))
        yield TestWheelPlace(
            wheel=each.name,
            plane_mm=from_si(each.load.place, "mm"),
            diameter_mm=_mm(each.wheel.diameter),
            imbalance_g_mm=from_si(each.wheel.imbalance, "g_mm"),
            required_g_mm=tuple(from_si(need, "g_mm") for need in needs),
            without_m_per_s2=max(spindle.without((each.load,)).values()),
            with_m_per_s2=None if tested is None else max(tested.tests[index].means.values()),
        )


def _mm(length: float | None) -> float | None:
    return None if length is None else from_si(length, "mm")


def _in_use(spindle: TestedSpindle, tested: TestedDesign | None) -> WheelsInUse:
    """The wheels in use: without autobalancers at the worst phase, with them over all phases that are not given."""
    case = spindle.design.case
    worst = max(
        spindle.gain
        * (
            sum(abs(spindle.design.bare.rotor.whirl(handle.place, [wheel], case.speed)) for wheel in case.wheels)
            if case.unknown_phases
            else abs(spindle.design.bare.rotor.whirl(handle.place, case.turned(()), case.speed))
        )
        for handle in spindle.handles
    )
    return WheelsInUse(
        imbalances_g_mm=tuple(from_si(abs(wheel.imbalance), "g_mm") for wheel in case.wheels),
        without_m_per_s2=float(np.hypot(worst, spindle.background)),
        with_m_per_s2=None if tested is None or tested.in_use is None else max(tested.in_use.means.values()),
    )


def _plan(spindle: TestedSpindle, worst: TwoRaceTest | None) -> Plan:
    test = spindle.design.case.table.type_test
    return Plan(
        orientations_deg=tuple(from_si(angle, "deg") for angle in spindle.orientations),
        runs=1 if test is None else test.runs,
        operators=3 if test is None else test.operators,
        starts=0 if worst is None else len(worst.directions),
        seed=SEED,
        moving=0 if worst is None else worst.ends.moving,
    )


def _with(tested: TestedDesign) -> WithAutobalancer:
    test, upright = tested.worst, tested.upright
    spindle = test.spindle
    return with_autobalancer(
        test,
        spindle.design.case.table.type_test,
        test.spread(test.highest),
        mean_without_friction(spindle, test.eccentricity),
        upright,
        shaken_free=upright is not None and not spindle.band,
    )


def _by_eccentricity(tested: TestedDesign) -> tuple[DeclaredAt, ...]:
    points = {**dict(tested.even.tried), tested.worst.eccentricity: tested.worst.declared}
    return tuple(
        DeclaredAt(race_eccentricity_mm=from_si(eccentricity, "mm"), declared_m_per_s2=value)
        for eccentricity, value in sorted(points.items())
    )


def _comparison(
    spindle: TestedSpindle, mounted: Sequence[MountedWheel], without: WithoutAutobalancer,
    tested: TestedDesign | None, with_: WithAutobalancer | None,
) -> Iterator[Check]:  # fmt: skip
    """ABU431 and ABU432."""
    if tested is None or with_ is None:
        reason = "The balls cannot balance the test wheel"
        for code, limit in (("ABU431", without.a_hv_m_per_s2), ("ABU432", without.K_m_per_s2)):
            yield coded(code, "not-done", reason, None, limit, "m/s²", "See ABU433.")
        return
    bare, declared = without.a_hv_m_per_s2, tested.worst.declared
    message = (
        f"Type test, highest handle and wheel place ({SIMULATED}): {bare:.3g} m/s² without the autobalancers, "
        f"{declared:.3g} m/s² with them, the factor {with_.factor:g} included"
    )
    lower = declared < bare
    action = None if lower else _lower_declared(spindle, mounted, tested)
    yield coded("ABU431", verdict(True, lower), message, declared, bare, "m/s²", action)
    change, K = abs(bare - declared), max(without.K_m_per_s2, with_.K_m_per_s2)
    message = f"The declared value {'falls' if lower else 'rises'} by {change:.3g} m/s²; K is {K:.3g} m/s²"
    yield coded("ABU432", verdict(True, change > K), message, change, K, "m/s²", bound="least")


def _lower_declared(
    spindle: TestedSpindle, mounted: Sequence[MountedWheel], tested: TestedDesign
) -> Action | str:  # fmt: skip
    """The first change of both races with which the declared value falls, sized anew and simulated."""
    starts, before = len(tested.worst.directions), tested.worst.declared
    for entries in _truer(spindle.design, tested.even):
        change = changed(spindle.design, entries)
        if change is None or not all(carried(change.design, (each.load,)) for each in mounted):
            continue
        after = TestedSpindle.of(change.design)
        delta = change.design.case.eccentricity
        declared = max(simulated_two_race_test(after, (each.load,), delta, starts).declared for each in mounted)
        if declared < max(_without(after, mounted).values()):
            return Action(
                f"Set {change.text} in both [[autobalancer]] tables: the declared value with the autobalancers falls "
                f"from {before:.3g} to {declared:.3g} m/s² ({SIMULATED}).",
                change.overrides,
            )
    return "No smaller race eccentricity or friction arm that was tried lowers it. Compare values without the factor."


def _truer(design: TwoRaceDesign, even: TwoRaceBreakEven) -> Iterator[dict[str, float]]:
    """Entries of races that run truer than the break-even eccentricity, or roll more easily."""
    abu = design.bare.table.autobalancer[0]
    given = abu.race_eccentricity_mm
    if even.simulated is not None:
        limit = from_si(even.simulated, "mm")
        yield from ({"race_eccentricity_mm": true} for true in _below(given, limit, SHARES_OF_BREAK_EVEN))
    ideal = 2 * given if even.frictionless is None else from_si(even.frictionless, "mm")
    for share in SMOOTHER:
        smooth = {"rolling_friction_mm": float(f"{share * abu.rolling_friction_mm:.3g}")}
        yield smooth
        yield from ({**smooth, "race_eccentricity_mm": true} for true in _below(given, ideal, SHARES_OF_IDEAL))


def _below(given: float, limit: float, shares: Sequence[float]) -> Iterator[float]:
    """Shares of a limit that are smaller than what is given."""
    yield from (value for value in (float(f"{share * limit:.2g}") for share in shares) if 0 < value < given)


def _remarks(
    spindle: TestedSpindle, deciding: MountedWheel, without: float, tested: TestedDesign | None,
    with_: WithAutobalancer | None,
) -> Iterator[str]:  # fmt: skip
    """Assumptions first, then causes and sources."""
    yield (
        "ISO 28927-4 describes hand-held machines with one wheel. Assumed here: the test wheel sits on one wheel place "
        "at a time, the other places turn without imbalance, and the highest value counts"
    )
    yield (
        f"The angle between the eccentricities of both races is unknown: {DIRECTIONS} angles are simulated, evenly "
        "spread. The declared value is their mean; the range of type tests counts them"
    )
    yield "Hands add neither mass nor stiffness here; handles lie on the spindle axis"
    if with_ is not None and with_.upright_m_per_s2 is not None:
        left = "nothing" if with_.shaken_free else "a part of itself"
        yield (
            f"On the horizontal spindle gravity shakes the balls, and friction leaves {left}. With the spindle "
            f"vertical friction holds them: {with_.upright_m_per_s2:.3g} m/s², declared "
            f"{with_.factor * with_.upright_m_per_s2:.3g} m/s²"
        )
    alone = max(without**2 - spindle.background**2, 0.0) ** 0.5
    yield from background_remarks(spindle.background, spindle.factor, alone)
    yield source_remark(deciding.wheel)
    if tested is not None and tested.worst.ends.moving:
        yield f"In {tested.worst.ends.moving} of {len(tested.worst.directions)} starts the balls had not come to rest"
    if tested is not None and tested.worst.spindle.band:
        yield (
            "Balls start at rest in the races at random places, and pass each other as points. `abu size FILE` judges "
            "whether they stall and how soon they settle"
        )
