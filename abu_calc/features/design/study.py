"""A machine sized: region, imbalance, capacity, balls, race, budget, seats, arm, and a simulation of the design.

`SizeModel` holds the SI numbers behind a sized design, for those who check it by hand.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field, replace
from typing import TYPE_CHECKING, Annotated, ClassVar, Final, Self

from abu_calc.features.design.band import OilRecord
from abu_calc.features.design.changes import DataGap, data_gaps
from abu_calc.features.design.judgement import LEAST_SCATTER, Judgement, TrialWatcher, judge
from abu_calc.features.design.next_step import Judge, NextStep, actions, next_step, proposals, verdict_of
from abu_calc.features.design.records import (
    AccuracyBudget,
    AutobalancerRecord,
    BodyRecord,
    Eccentricity,
    Frequency,
    FrictionBound,
    NewWheel,
    Section,
    Vibration,
)
from abu_calc.features.design.start_rules import FULL, STARTS
from abu_calc.features.design.starts import EnsembleResult, Starts
from abu_calc.features.design.verdict import Verdict, benefit
from abu_calc.features.grinding.outcomes import GrindingOutcomes, LoadedStarts, with_starts
from abu_calc.features.grinding.start_cases import FEW, WHEN, Pressed, loaded_ensemble
from abu_calc.features.grinding.steady_contact import LevelBound, lower_bound
from abu_calc.features.grinding.work import Work, loaded_levels
from abu_calc.features.seats.seats import SeatResult
from abu_calc.features.swing_arm.view import ArmMotion, SwingArmRecord
from abu_calc.foundation.checks import Check
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.parallel import meanwhile, processors
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import LEVEL_AFTER, Quantity, Record, record
from abu_calc.foundation.rows import Rows
from abu_calc.foundation.units import from_si
from abu_calc.foundation.validity import Range
from abu_calc.inputs.read_machine import Machine
from abu_calc.registry import imported
from abu_calc.simulation.arguments import checked, one_of
from abu_calc.simulation.design_scenes import SceneFailure, SceneRun
from abu_calc.simulation.ensemble import MORE, TIGHTER, WORK, first_tolerance, start_once
from abu_calc.simulation.predicted_level import compared_starts, predicted_level
from abu_calc.simulation.records import SceneModel, SimulatedScene, finite
from abu_calc.simulation.result import Provenance, Result
from abu_calc.simulation.rotor_view import RotorView
from abu_calc.simulation.run_checks import loudest
from abu_calc.simulation.simulate import ACCURACY
from abu_calc.simulation.start_cases import Ensemble, Lost, Member, StartOutcome
from abu_calc.simulation.vibration_records import MeasuredAfterRecord, level_where_measured
from abu_calc.sizing.design import Design
from abu_calc.sizing.drawing_requirements import DrawingLine
from abu_calc.sizing.parts.housing_parts import HousingParts
from abu_calc.sizing.vibration import idle_speed_levels

if TYPE_CHECKING:
    from abu_calc.features.seats.seats import BearingSeats


@record
class SizeModel(Record):
    """Numbers behind the steps of sizing, a few in user units too; complex ones as (real, imaginary)."""

    speed_rad_per_s: float
    speed_range_rad_per_s: tuple[float, float]
    mass_without_autobalancer_kg: float
    effective_mass_kg: float
    natural_frequencies_rad_per_s: tuple[float, float]
    reaction_N_per_m: tuple[tuple[float, float], ...]
    runout_m: float
    runout_factor: float
    runout_part_kg_m: float
    runout_part_g_mm: float
    eccentricity_part_kg_m: float
    eccentricity_part_g_mm: float
    plane_ratio: float
    ball_radius_mm: float
    inertia_factor: float
    drag_per_s: float
    ball_stiffness_per_s2: float | None
    resting_angles_rad: tuple[float, ...]
    permitted_pressure_Pa: float
    candidates: int
    imbalance_source: str
    scenes: Mapping[str, SceneModel]

    @classmethod
    def of(cls, design: Design, runs: Sequence[SceneRun]) -> Self:
        """Model of a design and its simulations."""
        case, autobalancer = design.case, design.autobalancer
        reactions = (case.suspension.reaction(axis, case.speed) for axis in (0, 1))
        return cls.read(
            case,
            autobalancer.requirement,
            mass_without_autobalancer_kg=case.body.mass,
            natural_frequencies_rad_per_s=design.frequency.natural_frequencies,
            reaction_N_per_m=tuple((force.real, force.imag) for force in reactions),
            ball_radius_mm=from_si(autobalancer.ball_diameter / 2, "mm"),
            ball_stiffness_per_s2=design.track.ball_stiffness,
            resting_angles_rad=autobalancer.budget.resting_angles,
            permitted_pressure_Pa=autobalancer.strength.permitted_pressure,
            candidates=design.choice.examined,
            imbalance_source=design.imbalance.source,
            scenes={run.ledger.scene.name: SceneModel.of(run.ledger.scene) for run in runs},
        )


@record
class PlaceLevelRow(Record):
    """Levels at one place in one state: idle at the rated speed, or grinding; `place` as the file names it."""

    state: Annotated[str, Quantity("state", "", 4, "idle or grinding")]
    place: Annotated[str, Quantity("place")]
    level_before_db: Annotated[float | None, Quantity("level before", "L")]
    level_after_db: Annotated[float | None, LEVEL_AFTER]
    reduction_db: Annotated[float | None, Quantity("reduction", "ΔL", 3)]
    level_at_once_db: Annotated[float | None, Quantity("level after, pressed at once", "L")]


IDLE_START: Final = "bunched"
"""Start of the idle scene."""


@record
class SizeResult(Result):
    """A design that can be made, its checks, and a simulation that shows it works."""

    command: ClassVar[str] = "size"
    optional: ClassVar[frozenset[str]] = frozenset({"idle_speed_rpm", "measured_after", "arm_motion", "oil"})
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"idle_run", "grinding_run", "starts", "parts"}

    model: SizeModel
    verdict: Verdict
    system_mass_kg: Annotated[float, Quantity("mass with wheel and autobalancer", "M")]
    effective_mass_kg: Annotated[float, Quantity("effective mass at the wheel", "m_eff")]
    body: BodyRecord
    frequency: Frequency
    idle_speed: Annotated[float | None, Quantity("idle speed of the motor", "Ω", 6, "None without [motor]", unit="rpm")]
    imbalance: Annotated[float, Quantity("imbalance", "m₀e", unit="g_mm")]
    required_capacity: Annotated[float, Quantity("required capacity", "m₀e + Mε√{…} + MΔ", unit="g_mm")]
    required_capacity_limit: Annotated[float, Quantity("limit as published", "m₀e + Mε", unit="g_mm")]
    required_capacity_compliant: Annotated[float | None, Quantity("required by the compliant contact", unit="g_mm")]
    autobalancer: AutobalancerRecord
    section: Section
    eccentricity: Eccentricity
    alternatives: tuple[AutobalancerRecord, ...]
    accuracy_budget: AccuracyBudget
    vibration: Vibration
    vibration_loaded: Vibration | None
    friction_bound: FrictionBound | None
    new_wheel: NewWheel | None
    measured_after: MeasuredAfterRecord | None
    oil: OilRecord | None
    ensemble: EnsembleResult | None
    data_gaps: tuple[DataGap, ...]
    simulation: tuple[SimulatedScene, ...]
    fits: tuple[SeatResult, ...]
    swing_arm: SwingArmRecord | None
    arm_motion: ArmMotion | None
    drawing: tuple[DrawingLine, ...]
    idle_run: RotorView | None = field(compare=False, repr=False)
    """The idle machine's way to rest, thinned; None: it was not simulated, or for too long."""
    grinding_run: RotorView | None = field(compare=False, repr=False)
    """The same at work."""
    starts: Starts = field(compare=False, repr=False)
    """Some starts of the ensemble, run again when they are asked for."""
    parts: HousingParts = field(compare=False, repr=False)
    """Geometry of the parts, for drawings and solids."""

    @property
    def autobalancers(self) -> tuple[AutobalancerRecord, ...]:
        """The autobalancer as a list of one, beside results of machines with several races."""
        return (self.autobalancer,)

    @property
    def worst_level_db(self) -> float | None:
        """Level of the loudest start case [dB]; None without any."""
        return None if self.ensemble is None else self.ensemble.level_db.worst

    @property
    def candidates(self) -> Rows[AutobalancerRecord]:
        """The chosen autobalancer, then the runners-up, as a table."""
        return Rows((self.autobalancer, *self.alternatives))

    @property
    def level_after_db(self) -> float | None:
        """`vibration.level_after_db`, the expected level with the autobalancer at the loudest place [dB].

        It is calculated from eccentricity and friction of manufacture; None: the balls cannot balance. The median of
        the simulated start cases is `ensemble.level_db.typical`, their worst `ensemble.level_db.worst`.
        """
        return self.vibration.level_after_db

    @property
    def levels(self) -> Rows[PlaceLevelRow]:
        """Levels before and after at each place, idle and under load, as a table."""
        rows = (
            PlaceLevelRow.read(levels, state=state, place=place)
            for state, whole in (("idle", self.vibration), ("grinding", self.vibration_loaded)) if whole is not None
            for place, levels in ((whole.place, whole), *((handle.name, handle) for handle in whole.handles))
        )  # fmt: skip
        # The limited place may be one of the handles.
        return Rows({(row.state, row.place): row for row in rows}.values())


WORKERS: Final = Range("workers", 1, 1024, key="workers")


@checked
def size(
    machine: Machine,
    accuracy: float = 0.01,
    progress: Progress = silent,
    workers: int | None = None,
    *,
    starts: str = FULL,
) -> SizeResult:
    """Size the autobalancer of a machine, simulate the scenes its file calls for to `accuracy`, and many starts of it.

    `workers`: how many starts run side by side, in threads; the result does not depend on it. None: one for each
    processor. A machine with several races gets a result of its own, whose `autobalancers` are all.
    `starts`: "full" simulates all start cases; "one", the first of them, and "none" are for loops over many machines:
    the design is the lightest one, and the checks that need the start cases fail or are not-done, but never pass.
    Raises InputError with file, line, key and remedy for what is wrong in the file.
    """
    ACCURACY.check(accuracy)
    one_of("starts", starts, STARTS)
    WORKERS.check(1 if workers is None else workers)
    if machine.spindle is not None:
        if starts != FULL:
            raise InputError(
                "with two races all start cases are simulated", place=Place(key="starts"), found=starts, allowed=FULL
            )
        two: SizeResult = imported("spindle.study:size_spindle")(machine, accuracy, progress, workers)
        return two
    tables = machine.whole("size")
    with machine.located():
        threads = processors() if workers is None else workers
        judged = judge(tables, accuracy, progress, threads, starts)
        design, facts, whole = judged.design, judged.facts, starts == FULL
        step = NextStep(None)
        if whole:
            step = next_step(machine, judged, proposals(judged), _judge(accuracy, threads), progress)
        further = () if facts.searched is None else facts.searched.outcomes
        gaps = meanwhile(data_gaps, design, facts.ensemble if whole else None, further, accuracy, workers=threads)
        work, loads = judged.work, None
        if whole:
            work, loads = _pressed(work, facts.ensemble, accuracy, progress, threads)
    remarks = (f"{run.ledger.scene.name}: {text}" for run in judged.runs for text in run.simulation.warnings)
    need, loaded = design.autobalancer.requirement, loaded_levels(design, work)
    bound = None if loaded is None else lower_bound(loaded.levels.worst.after, design.case)
    reached = next((run.simulation.response.ball_angles for run in judged.runs), None)
    checks = actions(judged, step) if whole else judged.checks
    return SizeResult(
        title=tables.machine.name,
        verdict=_verdict(judged, checks, step, Provenance.of(machine)),
        checks=checks,
        warnings=merged(
            *facts.warnings,
            *machine.warnings,
            *_bearing_notes(judged.seats),
            *design.warnings,
            *remarks,
            *_under_load(work, loads, bound),
            *(() if whole else (f'Start cases were left out (starts="{starts}"): this result is no verdict.',)),
        ),
        model=SizeModel.of(design, judged.runs),
        provenance=Provenance.of(machine),
        system_mass_kg=design.system_mass,
        effective_mass_kg=need.effective_mass,
        body=BodyRecord.of(design),
        frequency=Frequency.of(design, judged.region),
        idle_speed=design.case.idle_speed,
        imbalance=design.imbalance.value,
        required_capacity=need.required,
        required_capacity_limit=need.published_limit,
        required_capacity_compliant=need.compliant,
        autobalancer=AutobalancerRecord.of(design.case.autobalancer, design.autobalancer, design.track),
        section=Section.of(design),
        eccentricity=Eccentricity.of(design.eccentricity),
        alternatives=tuple(
            AutobalancerRecord.of(design.case.autobalancer, runner_up, race, why_not=why)
            for (runner_up, why), race in zip(design.choice.runners_up, design.runner_up_tracks, strict=True)
        ),
        accuracy_budget=AccuracyBudget.of(design, reached),
        vibration=replace(
            Vibration.of(design.idle, design.speed_levels, design.case.speed, design.bands),
            at_idle_speed=idle_speed_levels(
                design.case, design.imbalance.value, design.autobalancer, design.frequency.balancing_possible
            ),
        ),
        vibration_loaded=None
        if loaded is None
        else replace(
            Vibration.of_loaded(loaded, design.case.speed),
            starts=LoadedStarts.of(loads),
            bound=bound,
        ),
        measured_after=compared_starts(
            design, facts.ensemble, level_where_measured(design, work.moved) if isinstance(work, Work) else None
        ),
        oil=OilRecord.of(design),
        friction_bound=FrictionBound.of(design, (outcome.level for outcome in judged.outcomes)),
        new_wheel=NewWheel.of(design),
        ensemble=None
        if facts.ensemble is None
        else EnsembleResult.of(facts.ensemble, design, predicted_level(design, facts.ensemble), facts.searched),
        data_gaps=gaps(),
        simulation=tuple(SimulatedScene.of(run.simulation, run.ledger) for run in judged.runs),
        fits=tuple(seat for bearing in judged.seats for seat in bearing.seats),
        swing_arm=None if judged.arm is None else SwingArmRecord.of(judged.arm, step.entries),
        arm_motion=judged.arm_motion,
        drawing=design.drawing,
        idle_run=_view(design, judged.runs, "idle"),
        grinding_run=_view(design, judged.runs, "grinding"),
        starts=Starts(None if facts.ensemble is None else (design, facts.ensemble, accuracy), facts.searched),
        parts=design.construction.parts,
    )


def _judge(accuracy: float, workers: int) -> Judge:
    """How a change of a machine with one race is tried."""

    def judged(machine: Machine, progress: Progress, trial: TrialWatcher) -> Judgement:
        """As `size` judges it."""
        return judge(machine.whole("size"), accuracy, progress, workers, trial=trial)

    def once(design: Design, member: Member, *, closer: bool = False) -> StartOutcome | Lost:
        """One start case."""
        tolerance = (TIGHTER if closer else 1.0) * first_tolerance(design)
        return start_once(design, member, accuracy, tolerance, MORE * WORK, early_end=True)

    return Judge(judged, once)


def _verdict(judged: Judgement, checks: Sequence[Check], step: NextStep, reading: Provenance) -> Verdict:
    """The verdict with what the autobalancer does at the loudest place, and the change that mends the machine."""
    design = judged.design
    levels, quiet = design.idle.worst, finite(max((run.quiet_time_or_inf for run in judged.outcomes), default=math.inf))
    if any(check.key == "quiet_time" and check.status != "pass" for check in checks):
        quiet = None  # the sentence tells it otherwise
    told = benefit(design.idle.judged, levels.before, levels.after, design.case.level_limit, quiet)
    return verdict_of(judged, checks, step, told, reading)


def merged(*warnings: str) -> tuple[str, ...]:
    """Warnings once each; one that begins another, longer one is left out."""
    stems = [warning.rstrip(".") for warning in warnings]
    once = dict.fromkeys(
        warning for warning, stem in zip(warnings, stems, strict=True)
        if not any(other != stem and other.startswith(f"{stem}.") for other in stems)
    )  # fmt: skip
    return tuple(once)


def _bearing_notes(seats: "tuple[BearingSeats, ...]") -> Iterator[str]:
    """Notes on the bearings."""
    if seats:
        from abu_calc.features.seats.seats import bearing_notes

        yield from bearing_notes(seats)


def _view(design: Design, runs: Sequence[SceneRun], scene: str) -> RotorView | None:
    """View of a scene's run, with the levels that the limit of the file is for."""
    run = next((run.simulation for run in runs if run.ledger.scene.name == scene), None)
    return None if run is None else RotorView.of(run.scene, run.trajectory, loudest(design, run.response))


def _pressed(
    work: Work | SceneFailure | None, ensemble: Ensemble | None, accuracy: float, progress: Progress, workers: int
) -> tuple[Work | SceneFailure | None, GrindingOutcomes | None]:
    """The machine at its workpiece with a few start cases: `abu grinding` runs all of them."""
    if not isinstance(work, Work):
        return work, None
    idle: tuple[StartOutcome | Lost, ...] | None = None if ensemble is None else (*ensemble.outcomes, *ensemble.lost)
    return with_starts(work, loaded_ensemble(work.design, accuracy, progress, workers, idle, FEW))


def _under_load(
    work: Work | SceneFailure | None, loads: GrindingOutcomes | None, bound: LevelBound | None
) -> Iterator[str]:
    """Warnings about the levels under load that a reader must know."""
    if bound is not None and bound.sentence:
        yield bound.sentence
    if loads is not None:
        known = work if isinstance(work, Work) else None
        bare = None if known is None else known.levels.before
        yield from _starts(loads, bare, stays=known is not None and known.stays_loud)
    if isinstance(work, SceneFailure):
        yield f"Levels under load are not known: {work.reason}."
        return
    if work is None:
        return
    sides = [side for side in (work.without, work.fitted, work.at_once) if side.scatter]
    scatter = max((side.scatter for side in sides), default=0.0)
    yield from dict.fromkeys(
        f"grinding: {text}. Levels under load are known to {max(scatter, LEAST_SCATTER):.1f} dB"
        for side in sides if side.run for text in side.run.warnings
    )  # fmt: skip
    loud, bare = work.level_at_once, work.levels.before
    count = len(loads.louder("at once")) if loads is not None else 0
    if loud is not None and (work.stays_loud or (not count and bare is not None and loud > bare)):
        bouncing = " Wheel and workpiece go on bouncing." if work.stays_loud else ""
        yield (
            f"Under load, pressed before the balls have settled: {loud:.1f} dB with the autobalancer"
            f"{_without(loud, bare)}.{_share(count, loads, 'at once')}{bouncing} `abu grinding FILE` tells what helps."
        )


def _without(level: float, bare: float | None) -> str:
    """The level [dB] without the autobalancer beside the level with it."""
    return "" if bare is None else f", {'louder than' if level > bare else 'below the'} {bare:.1f} dB without"


def _share(count: int, loads: GrindingOutcomes | None, when: Pressed) -> str:
    """Share of the start cases of grinding that are louder with the autobalancer."""
    if loads is None or not count:
        return ""
    total = loads.count(when)
    return f" That is so in {count} of {total} start case{'' if total == 1 else 's'}."


def _starts(loads: GrindingOutcomes, bare: float | None, *, stays: bool) -> Iterator[str]:
    """The start cases of grinding that are louder with the autobalancer than without, and those without an answer.

    `bare`: level [dB] without the autobalancer; `stays`: pressed at once the machine keeps bouncing louder, which a
    sentence of its own tells.
    """
    for when in ("settled", "at once"):
        if (louder := loads.louder(when)) and not (stays and when == "at once"):
            yield (
                f"Under load, pressed {WHEN[when]}: up to {louder[-1].level:.1f} dB with the autobalancer"
                f"{_without(louder[-1].level, bare)}.{_share(len(louder), loads, when)} `abu grinding FILE` simulates "
                "more of them."
            )
    if loads.lost:
        yield (
            f"{len(loads.lost)} of {loads.ensemble.count} start cases pressed to the workpiece gave no answer: "
            f"{loads.lost[0].reason}."
        )
