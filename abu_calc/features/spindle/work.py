"""Study behind `abu grinding` of a machine with two races: one wheel at a time at its workpiece."""

import cmath
from collections.abc import Iterator, Sequence
from typing import Final

from abu_calc.features.grinding.study import refuse_idle
from abu_calc.features.grinding.verdict import AxisMotion
from abu_calc.features.spindle.case import PressedWheel, SpindleDesign, pressed_wheels, size_races
from abu_calc.features.spindle.records import (
    PlaceAtWork,
    RaceAtWork,
    SpindleGrindingModel,
    SpindleGrindingResult,
    SpindleReaction,
    WearOfWheel,
    WheelAtWork,
)
from abu_calc.features.spindle.start_cases import start_of
from abu_calc.features.spindle.work_runs import (
    GROWS,
    Pressed,
    WorkRun,
    agreement,
    ball_angles,
    capacities_at_work,
    contact_of,
    growth_rates,
    resultants_at_work,
    work_cases,
    work_run,
)
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.parallel import processors, side_by_side
from abu_calc.foundation.progress import Progress, counted
from abu_calc.foundation.units import wrapped_deg
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.result import Provenance
from abu_calc.simulation.start_cases import Lost

AGREES: Final = 0.05
"""Relative difference of force between closed form and simulation that is permitted: averages leave out 2Ω swings."""
UNSTEADY: Final = 1.0
"""Change [dB] of a level within the observed time above which a run has not come to an end."""


@dataclass(frozen=True)
class WheelRuns:
    """Runs of one wheel at work, and what closed forms say of it."""

    wheel: PressedWheel
    runs: tuple[WorkRun | Lost, ...]
    needs: tuple[float, ...]
    growths: tuple[float, ...] | None
    disagreement: float | str | None

    def known(self, pressed: Pressed, given_only: bool = False) -> list[WorkRun]:
        """Runs with an answer, pressed so; `given_only`: at the given drag rate."""
        return [
            run for run in self.runs
            if isinstance(run, WorkRun) and run.case.pressed == pressed
            and (run.case.start.promised or not given_only)
        ]  # fmt: skip

    def lost(self, pressed: Pressed) -> list[str]:
        """Reasons of runs that have no answer, or no level that stays."""
        reasons = [run.reason for run in self.runs if isinstance(run, Lost) and run.member.pressed == pressed]
        moving = [run for run in self.known(pressed) if run.drift > UNSTEADY]
        if pressed != "at once" and any(run.pulls for run in self.known(pressed)):
            reasons.append("a rigid contact would have to pull")
        return reasons + [f"a level still changes by {run.drift:.1f} dB at the end of a run" for run in moving]

    def louder(self, pressed: Pressed) -> list[tuple[float, WorkRun]]:
        """Runs that are not quieter than the machine without autobalancers at the same phases, with the change [dB]."""
        changes = ((change, run) for change, run in self.changes(pressed) if change >= 0)
        return sorted(changes, key=lambda pair: pair[0])

    def changes(self, pressed: Pressed) -> Iterator[tuple[float, WorkRun]]:
        """Change of level [dB] of each run against the machine without autobalancers at the same phases."""
        before = {run.case.start.phases: run.level for run in self.known("without")}
        for run in self.known(pressed):
            if run.case.start.phases in before:
                yield run.level - before[run.case.start.phases], run

    @property
    def helps(self) -> bool | None:
        """True if every run pressed after settling is quieter; None if one has no answer and none is louder."""
        if self.louder("settled"):
            return False
        return None if self.lost("settled") or self.lost("without") or not self.known("settled") else True

    def loudest(self, pressed: Pressed) -> float | None:
        """Level [dB] of the loudest run."""
        return max((run.level for run in self.known(pressed)), default=None)


def grind_spindle(
    machine: Machine, progress: Progress, number: int | None = None, workers: int | None = None
) -> SpindleGrindingResult:
    """The machine with one wheel at a time at its workpiece; `number`: only this wheel, from 1.

    Raises InputError for a file without [grinding], for a wheel that it does not have, and below a critical speed.
    """
    with machine.located():
        refuse_idle(getattr(machine.tables, "grinding", None))
        design = size_races(machine)
        wheels = pressed_wheels(design.case)
        if number is not None and not 1 <= number <= len(wheels):
            raise InputError(
                "the machine has no such wheel", place=Place(key="wheel"), found=f"{number}",
                allowed=f"1 … {len(wheels)}", remedy="Name one of the [[wheel]] of the file by its number.",
            )  # fmt: skip
    chosen = wheels if number is None else (wheels[number - 1],)
    above = design.case.balances_at(design.case.speed)
    threads = processors() if workers is None else workers
    each = tuple(_judged(design, wheel, progress, threads, above) for wheel in chosen)
    rows = tuple(_row(design, runs) for runs in each)
    worst = max(zip(rows, each, strict=True), key=lambda pair: _badness(pair[0]))[0]
    return SpindleGrindingResult.read(
        worst,
        worst.races[0],
        title=machine.title,
        checks=tuple(check for runs in each for check in _checks(design, runs, above)),
        warnings=(*machine.warnings, *_notes(design, each)),
        provenance=Provenance.of(machine),
        model=_model(design),
        verdict=_verdict(rows, above),
        helps=None if any(row.helps is None for row in rows) and not any(row.helps is False for row in rows)
        else all(row.helps for row in rows),
        contact=wheels[0].table.contact,
        contact_stiffness_regions_N_per_m=None,
        flutter_drag_limit_per_s=None,
        wheels=rows,
    )  # fmt: skip


def _judged(design: SpindleDesign, wheel: PressedWheel, progress: Progress, workers: int, above: bool) -> WheelRuns:
    """Closed forms and runs of one wheel; below a critical speed only the machine without autobalancers runs."""
    cases = [case for case in work_cases(design, wheel) if above or case.pressed == "without"]
    counting = counted(progress, f"{wheel.name} at work: {{}} of {{}} runs", len(cases))
    runs = tuple(side_by_side(work_run, [(design, case) for case in cases], workers, counting))
    return WheelRuns(
        wheel,
        runs,
        capacities_at_work(design, wheel),
        growth_rates(design, wheel) if above else None,
        agreement(design, wheel, start_of(design, "spread")) if above else None,
    )


def _badness(row: WheelAtWork) -> tuple[bool, float, float]:
    """Order of the wheels: those that are not helped, by the change of level, then by the level."""
    change = -200.0 if row.worst_change_db is None else row.worst_change_db
    return row.helps is not True, change, row.level_after_db or 0.0


def _row(design: SpindleDesign, runs: WheelRuns) -> WheelAtWork:
    wheel = runs.wheel
    contact, bare = contact_of(design, wheel), contact_of(design, wheel, bare=True)
    own = design.case.turned(())
    settled, without = runs.known("settled"), runs.known("without")
    at_work = [*settled, *runs.known("at once")]
    loudest = max(settled, key=lambda run: run.level, default=None)
    changes = [change for change, _ in runs.changes("settled")]
    growths, force = runs.growths, contact.balanced_force()
    return WheelAtWork(
        wheel=wheel.name,
        number=wheel.index + 1,
        helps=runs.helps,
        level_before_db=runs.loudest("without"),
        level_after_db=runs.loudest("settled"),
        level_at_once_db=runs.loudest("at once"),
        worst_change_db=max(changes, default=None),
        places=tuple(
            PlaceAtWork(
                name=held.name,
                level_before_db=max((run.levels[index] for run in without), default=None),
                level_after_db=max((run.levels[index] for run in settled), default=None),
            )
            for index, held in enumerate(design.case.places)
        ),
        reaction=_reaction(wheel, force),
        reaction_without=_reaction(wheel, bare.force(own)),
        axis=AxisMotion.of(contact.balanced_motion(wheel.place)),
        axis_without=AxisMotion.of(bare.motion(wheel.place, own)),
        axis_simulated=AxisMotion.of(None if loudest is None else (complex(loudest.axis[0]), complex(loudest.axis[1]))),
        races=tuple(_races(design, runs)),
        wear=_wear(wheel, contact.runout, force),
        growth_rate_per_s=None if growths is None else growths[0],
        growth_rate_worst_per_s=None if growths is None else max(growths[1:]),
        apart=max((run.apart for run in at_work), default=None),
        disagreement=runs.disagreement if isinstance(runs.disagreement, float) else None,
        runs=len(runs.runs),
    )


def _reaction(wheel: PressedWheel, force: complex) -> SpindleReaction:
    return SpindleReaction(
        mean=wheel.table.press_force_N,
        amplitude=abs(force),
        angle_deg=wrapped_deg(cmath.phase(force)) if force else None,
        separates=wheel.presses and abs(force) > wheel.table.press_force_N,
    )


def _races(design: SpindleDesign, runs: WheelRuns) -> Iterator[RaceAtWork]:
    resultants = resultants_at_work(design, runs.wheel)
    angles = ball_angles(design, resultants)
    for index, (resultant, need) in enumerate(zip(resultants, runs.needs, strict=True)):
        yield RaceAtWork(
            ball_resultant=abs(resultant),
            ball_resultant_angle_deg=wrapped_deg(cmath.phase(resultant)) if resultant else None,
            ball_angles_deg=None if angles is None else tuple(map(wrapped_deg, angles[index])),
            required=need,
            capacity=design.races[index].autobalancer.capacity,
        )


def _wear(wheel: PressedWheel, runout: complex, force: complex) -> WearOfWheel:
    """Wear follows pressure: it centres the wheel if the high spot is pressed harder, Re(H·ε̄) > 0, H = −i·N_c."""
    if not wheel.presses or not runout:
        return WearOfWheel(centres=None, pressure_on_high_spot=None)
    pressure = (-1j * force * runout.conjugate() / abs(runout)).real
    return WearOfWheel(centres=pressure > 0, pressure_on_high_spot=pressure)


def _model(design: SpindleDesign) -> SpindleGrindingModel:
    case, table = design.case, design.case.table.grinding
    assert table is not None
    return SpindleGrindingModel.read(
        design,
        table,
        speed_rad_per_s=case.speed,
        races_m=case.races,
        wheels_m=tuple(wheel.place for wheel in case.wheels),
        contact_stiffness_N_per_m=table.contact_stiffness_N_per_m if table.contact == "compliant" else None,
        race_eccentricity_m=case.eccentricity,
    )


def _checks(design: SpindleDesign, runs: WheelRuns, above: bool) -> Iterator[Check]:
    """All checks of one wheel."""
    name = runs.wheel.name
    if not above:
        reason = "Balls do not balance at the rated speed: it is not above both critical speeds"
        yield coded("ABU421", "not-done", reason, remedy="See ABU101 of `abu size FILE`.", of=name)
        return
    yield _lowered(runs)
    yield from _carried(design, runs)
    yield _still(runs)
    parted = max((run for run in runs.runs if isinstance(run, WorkRun) and run.case.pressed != "without"),
                 key=lambda run: run.apart, default=None)  # fmt: skip
    if parted is not None and runs.wheel.presses:
        stays = parted.apart == 0
        text = "Wheel and workpiece stay together" if stays else _parting(runs.wheel)
        yield coded("ABU424", verdict(True, stays), f"{text}: largest share of time apart in any run", parted.apart,
            0.0, None if stays else "Press harder, or run the wheel truer.", of=name, unit="percent",
        )  # fmt: skip
    yield from _agrees(runs)


def _parting(wheel: PressedWheel) -> str:
    """Text on a contact that does not hold."""
    if wheel.table.contact == "rigid":
        return "A rigid contact, which never parts, would have to pull"
    return "Wheel and workpiece part; levels include it"


LOUDER: Final = "Run the wheel truer (runout_mm), soften the contact, or press after the balls have settled."
PULLS: Final = 'Press harder, or set grinding.contact = "compliant" and its stiffness: the wheel may then part.'
NO_LEVEL: Final = "Press harder, or soften the contact (not tried)."
"""Actions where runs are louder, where a rigid contact pulls, and where runs give no level."""


def _lowered(runs: WheelRuns) -> Check:
    """Quieter than without autobalancers at the same phases, in every run."""
    name, louder, early = runs.wheel.name, runs.louder("settled"), runs.louder("at once")
    before, after = runs.loudest("without"), runs.loudest("settled")
    given = [pair for pair in louder if pair[1].case.start.promised]
    if given:
        change, run = given[-1]
        text = (
            f"{len(given)} of {len(runs.known('settled', True))} runs pressed after the balls settled are not quieter"
        )
        text += f": {run.case.start.name}, {change:+.1f} dB"
        return coded("ABU421", "fail", text, after, before, LOUDER, of=name)
    missing = [*runs.lost("settled"), *runs.lost("without")]
    if missing or not runs.known("settled"):
        text = f"{len(missing)} runs gave no level: {missing[0]}" if missing else "No run gave a level"
        action = PULLS if any("pull" in reason for reason in missing) else NO_LEVEL
        return coded("ABU421", "not-done", text, after, before, action, of=name)
    stalled = (run for run in (*runs.known("settled"), *runs.known("at once")) if run.stalls)
    doubts = [
        *(f"balls stall, {run.case.start.name}" for run in stalled),
        *(f"{run.case.start.name}, {change:+.1f} dB" for change, run in (*louder, *early)),
        *runs.lost("at once"),
    ]
    text = f"Level at the loudest place, loudest of {len(runs.known('settled'))} runs pressed after the balls settled"
    if doubts:
        text += f". Not quieter or in doubt in hot or cold oil, or pressed at once: {doubts[-1]}"
    return coded("ABU421", verdict(True, not doubts), text, after, before, LOUDER if doubts else None, of=name)


def _carried(design: SpindleDesign, runs: WheelRuns) -> Iterator[Check]:
    for number, (need, race) in enumerate(zip(runs.needs, design.races, strict=True), 1):
        capacity = race.autobalancer.capacity
        enough = capacity >= need
        yield coded("ABU422", verdict(enough), "The balls must carry what imbalances, contact and eccentricity require",
            capacity, need, None if enough else "Use more or larger balls, run the wheel truer, or soften the contact.",
            of=f"{runs.wheel.name}, race {number}",
        )  # fmt: skip


def _still(runs: WheelRuns) -> Check:
    """Small motions of light balls about their places at work."""
    name = runs.wheel.name
    if runs.growths is None:
        return coded("ABU423", "not-done", "A race cannot carry what work requires", remedy="See ABU422.", of=name,
            bound="most",
        )  # fmt: skip
    even, others = runs.growths[0], max(runs.growths[1:])
    passed, safe = even <= GROWS, others <= GROWS
    text = "Growth of a small disturbance, balls evenly spread (calculated for light balls, imbalances in phase)"
    if passed and not safe:
        text += f"; {others:.3g} 1/s in another arrangement"
    remedy = None if passed and safe else "Change the contact stiffness, or use a more viscous oil in both races."
    growth = even if abs(even) > GROWS else 0.0
    return coded("ABU423", verdict(passed, safe), text, growth, 0.0, remedy, of=name, bound="most")


def _agrees(runs: WheelRuns) -> Iterator[Check]:
    """The force by closed form against a simulation with ideal races and balls."""
    if runs.disagreement is None:
        return
    if isinstance(runs.disagreement, str):
        text = f"No comparison of closed form and simulation: {runs.disagreement}"
        yield coded("ABU425", "not-done", text, remedy="Press harder, or run the wheel truer.", of=runs.wheel.name,
            requested=False,
        )  # fmt: skip
        return
    close = runs.disagreement <= AGREES
    yield coded("ABU425", verdict(True, close),
        "Force and resultants: closed form against a simulation with ideal races", runs.disagreement, AGREES,
        None if close else "Use the simulated levels; closed forms leave out something here.", of=runs.wheel.name,
    )  # fmt: skip


def _verdict(rows: Sequence[WheelAtWork], above: bool) -> str:
    if not above:
        return "It is not known whether the autobalancers help at work: the speed is not above both critical speeds."
    texts = []
    for row in rows:
        if row.helps is None or row.level_before_db is None or row.level_after_db is None:
            texts.append(f"With {row.wheel} at work it is not known whether the autobalancers help.")
            continue
        levels = f"{row.level_after_db:.1f} dB with them, {row.level_before_db:.1f} dB without"
        word = "help" if row.helps else "do NOT help in every phase and oil"
        texts.append(f"With {row.wheel} at work the autobalancers {word}: {levels}.")
    return " ".join(texts)


def _notes(design: SpindleDesign, each: Sequence[WheelRuns]) -> Iterator[str]:
    table = design.case.table.grinding
    assert table is not None
    if table.contact == "compliant" and "contact_stiffness_N_per_m" not in table.model_fields_set:
        yield f"The contact stiffness of {table.contact_stiffness_N_per_m:.3g} N/m is a default: specify yours"
    yield (
        "One wheel works at a time, the others idle. Levels are simulated: tilting spindle, balls of both races, "
        "gravity, friction, a contact that may part"
    )
    yield (
        "Forces, motions and resultants are closed forms: no separation, ideal races, imbalances of unknown phase in "
        "phase. The contact force tilts the spindle: each race carries its share of it"
    )
    low, high = design.case.speed_range
    if low < high:
        yield "Work is judged at the rated speed only, not over speed_range_rpm"
    yield "Not calculated with two races: remedies, contact stiffness regions, flutter limit, wear over time"
    if any(run.apart == 1.0 for runs in each for run in runs.runs if isinstance(run, WorkRun)):
        yield "In a run the wheel left the workpiece for good"
