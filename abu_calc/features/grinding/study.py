"""A machine at work: effect of its autobalancer there, forces on its wheel, and the wear of the wheel.

`GrindingModel` holds the SI numbers behind it, for those who check them by hand.
"""

import cmath
import math
from collections.abc import Iterator
from dataclasses import field
from typing import Annotated, ClassVar, Self

from abu_calc.features.grinding.checks import Comparison, agreement, flutter_limits, work_checks
from abu_calc.features.grinding.curves import (
    FrictionBand,
    HodographPoint,
    Reaction,
    ResponsePoint,
    friction,
    hodograph,
    loaded_resonance,
    reaction,
    response,
    shaken,
)
from abu_calc.features.grinding.formulas import published_resultant, stiffness_regions
from abu_calc.features.grinding.outcomes import LoadedStarts, loudest_start, with_starts
from abu_calc.features.grinding.start_cases import loaded_ensemble
from abu_calc.features.grinding.steady_contact import (
    LevelBound,
    SteadyWork,
    bare,
    contact_of,
    contact_presses,
    fitted,
    fixed,
    lower_bound,
    runout_of,
)
from abu_calc.features.grinding.verdict import AxisMotion, Orbit, Printed, ProfilePoint, Simulated, in_words, shortest
from abu_calc.features.grinding.wear import (
    Claim,
    WearCourse,
    bouncing_course,
    claim,
    press_of,
    rigid_course,
    wear_course,
)
from abu_calc.features.grinding.work import TriedRemedy, Work, at_work, remedies
from abu_calc.formulas.suspension import natural_frequency
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.parallel import processors
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import wrapped_deg
from abu_calc.inputs.duty import Grinding
from abu_calc.inputs.read_machine import Machine
from abu_calc.registry import imported
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.predicted_level import compared_starts, starts_for_measurement
from abu_calc.simulation.result import Provenance, Result
from abu_calc.simulation.simulate import ACCURACY
from abu_calc.simulation.vibration_records import MeasuredAfterRecord, level_where_measured
from abu_calc.sizing import size as size_design
from abu_calc.sizing.design import Design

Pair = tuple[float, float]


@record
class GrindingModel(Record):
    """Masses with and without the autobalancer, the contact, the balls; complex numbers as (real, imaginary)."""

    system_mass_kg: float
    effective_mass_kg: float
    mass_without_autobalancer_kg: float
    speed_rad_per_s: float
    reaction_of_suspension_N_per_m: tuple[Pair, Pair]
    dynamic_stiffness_N_per_m: tuple[Pair, Pair]
    imbalance_kg_m: float
    runout_m: float
    runout_angle_deg: float
    contact: str
    contact_stiffness_N_per_m: float | None
    press_force_N: float
    cutting_coefficient: float
    rotation_sense: int
    ball_count: int
    ball_mass_kg: float
    ball_radius_m: float
    pitch_radius_m: float
    capacity_kg_m: float
    inertia_factor: float
    drag_per_s: float
    slow_stiffness_per_s2: tuple[Pair, Pair] | None
    total_imbalance_kg_m: Pair | None

    @classmethod
    def of(cls, work: Work) -> Self:
        """Model of a design pressed to the workpiece."""
        design, steady = work.design, work.fitted.steady
        case, autobalancer, contact = design.case, design.autobalancer, design.case.contact
        mass = case.body.effective_mass(autobalancer.mass)
        stiffness = contact_of(case, autobalancer.mass).dynamic_stiffness
        held = [each + mass * case.speed**2 for each in stiffness]
        return cls.read(
            design,
            case,
            autobalancer,
            effective_mass_kg=mass,
            mass_without_autobalancer_kg=case.body.mass,
            reaction_of_suspension_N_per_m=(_pair(held[0]), _pair(held[1])),
            dynamic_stiffness_N_per_m=(_pair(stiffness[0]), _pair(stiffness[1])),
            imbalance_kg_m=design.imbalance.value,
            runout_angle_deg=case.table.wheel.runout_angle_deg,
            contact=contact.contact if contact else "",
            contact_stiffness_N_per_m=contact.contact_stiffness if contact and contact.contact == "compliant" else None,
            press_force_N=contact.press_force if contact else 0.0,
            cutting_coefficient=contact.cutting_coefficient if contact else 0.0,
            rotation_sense=contact.rotation_sense if contact else 0,
            ball_radius_m=autobalancer.ball_diameter / 2,
            slow_stiffness_per_s2=None if steady.balls is None else (
                _pair(steady.balls.stiffness[0]), _pair(steady.balls.stiffness[1])),
            total_imbalance_kg_m=None if steady.imbalance is None else _pair(steady.imbalance),
        )  # fmt: skip


def _pair(value: complex) -> Pair:
    return value.real, value.imag


@record
class GrindingResult(Result):
    """A machine at its work; motions as if wheel and work never parted, `simulation` as they are."""

    command: ClassVar[str] = "grinding"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"orbits"}
    optional: ClassVar[frozenset[str]] = frozenset({"measured_after"})

    model: GrindingModel
    verdict: Annotated[str, Quantity("verdict")]
    helps: Annotated[bool | None, Quantity("the autobalancer lowers the level")]
    contact: Annotated[str, Quantity("contact")]
    level_before_db: Annotated[float | None, Quantity("level without autobalancer")]
    level_after_db: Annotated[float | None, Quantity("level with it")]
    level_at_once_db: Annotated[float | None, Quantity("with it, pressed before the balls have settled")]
    at_once_stays: Annotated[bool, Quantity("pressed at once, wheel and work go on bouncing louder")]
    starts: LoadedStarts | None
    bound: LevelBound | None
    measured_after: MeasuredAfterRecord | None
    remedies: tuple[TriedRemedy, ...]
    ball_resultant: Annotated[float | None, Quantity("imbalance of the balls", "|V|", unit="g_mm")]
    ball_resultant_angle_deg: Annotated[float | None, Quantity("its angle", "arg V")]
    needed_resultant: Annotated[float, Quantity("imbalance asked of the balls", unit="g_mm")]
    ball_angles_deg: Annotated[tuple[float, ...] | None, Quantity("balls rest at", "θ", 5)]
    balls: Annotated[str, Quantity("balls", "", 4, "balanced, restless, short, gathered or turning")]
    printed: Printed | None
    reaction: Reaction
    reaction_fixed: Reaction
    reaction_without: Reaction
    axis: AxisMotion
    axis_fixed: AxisMotion
    axis_without: AxisMotion
    resting: Annotated[float, Quantity("race and friction leave besides", "", 3, unit="um")]
    profile: tuple[ProfilePoint, ...] | None
    hodograph: tuple[HodographPoint, ...]
    response: tuple[ResponsePoint, ...]
    resonance: Annotated[float | None, Quantity("resonance on the contact, without autobalancer", unit="rpm")]
    wear: WearCourse | None
    wear_without: WearCourse | None
    wear_rigid: WearCourse | None
    wear_rigid_without: WearCourse | None
    wear_bouncing: WearCourse | None
    wear_bouncing_without: WearCourse | None
    claim: Claim | None
    contact_stiffness_regions: Annotated[
        Pair | None,
        Quantity("contact stiffness up to which balls balance; above which they do again", unit="N_per_m"),
    ]
    flutter_drag_limit: Annotated[
        float | None, Quantity("drag against flutter, as the balls stand", "h₀", unit="per_s")
    ]
    flutter_drag_worst: Annotated[float | None, Quantity("drag against flutter, balls in a cross", "h₀", unit="per_s")]
    friction: FrictionBand
    cutting_power: Annotated[float, Quantity("cutting power", "fN₀ΩR_w", unit="W")]
    simulation: Simulated | None
    simulation_at_once: Simulated | None
    simulation_without: Simulated | None
    agreement: Comparison | None
    orbits: tuple[Orbit, ...] = field(compare=False, repr=False)
    """Orbits of the axis without autobalancer, with fixed and with free balls."""


@checked
def grinding(
    machine: Machine, accuracy: float = 0.01, progress: Progress = silent, wheel: int | None = None
) -> GrindingResult:
    """The machine of a file at its work, by closed forms and by simulation to `accuracy`.

    A machine with several races gets a result of its own: each wheel at work in turn, or only `wheel`, from 1.
    Raises InputError for a file without [grinding], and with file, line, key and remedy for what is wrong in it.
    """
    ACCURACY.check(accuracy)
    if machine.spindle is not None:
        two: GrindingResult = imported("spindle.work:grind_spindle")(machine, progress, wheel)
        return two
    if wheel is not None:
        raise InputError(
            "for machines with two races only", place=Place(key="wheel"), found=f"{wheel}",
            remedy="Leave it out: this machine has one wheel.",
        )  # fmt: skip
    tables = machine.whole("grinding")
    with machine.located():
        refuse_idle(tables.grinding)
        design = size_design(tables)
        work = at_work(design, accuracy, progress)
        work, loads = with_starts(work, loaded_ensemble(design, accuracy, progress, processors()))
        always = work.always and (loads is None or (loads.lowered("settled") and loads.lowered("at once")))
        tried = () if always else remedies(work, accuracy, progress, lambda tried: loudest_start(tried, accuracy))
        compared, freed = agreement(work, accuracy, progress), shaken(work, progress)
    steady, runout = work.fitted.steady, runout_of(design.case)
    balls, still, limits = steady.balls, fixed(design, runout), flutter_limits(work)
    resultant = balls.resultant if balls else None
    bound = lower_bound(work.levels.after, design.case)
    return GrindingResult(
        title=tables.machine.name,
        checks=work_checks(work, shortest(tried), compared, loads),
        warnings=(*machine.warnings, *_warnings(work), *filter(None, [bound.sentence if bound else ""])),
        model=GrindingModel.of(work),
        provenance=Provenance.of(machine),
        verdict=in_words(work, tried, loads),
        helps=work.lowered,
        contact=design.case.contact.contact if design.case.contact else "",
        level_before_db=work.levels.before,
        level_after_db=work.levels.after,
        level_at_once_db=work.level_at_once,
        at_once_stays=work.stays_loud,
        starts=LoadedStarts.of(loads),
        bound=bound,
        measured_after=compared_starts(
            design, starts_for_measurement(design, progress), level_where_measured(design, work.moved)
        ),
        remedies=tried,
        ball_resultant=None if resultant is None else abs(resultant),
        ball_resultant_angle_deg=None if not resultant else wrapped_deg(cmath.phase(resultant)),
        needed_resultant=abs(balls.needed) if balls else 0.0,
        ball_angles_deg=tuple(map(wrapped_deg, balls.angles)) if balls and balls.angles else None,
        balls=balls.places if balls else "",
        printed=_printed(work),
        reaction=reaction(design.case, steady),
        reaction_fixed=reaction(design.case, still),
        reaction_without=reaction(design.case, work.without.steady),
        axis=AxisMotion.of(steady.axis),
        axis_fixed=AxisMotion.of(still.axis),
        axis_without=AxisMotion.of(work.without.steady.axis),
        resting=work.rest,
        profile=_profile(work),
        hodograph=hodograph(design),
        response=response(design),
        resonance=loaded_resonance(design),
        wear=wear_course(work, work.fitted.steady),
        wear_without=wear_course(work, work.without.steady),
        wear_rigid=rigid_course(work, fitted),
        wear_rigid_without=rigid_course(work, bare),
        wear_bouncing=bouncing_course(design, work.fitted),
        wear_bouncing_without=bouncing_course(design, work.without),
        claim=claim(work),
        contact_stiffness_regions=_regions(design, steady),
        flutter_drag_limit=None if limits is None else limits[0],
        flutter_drag_worst=None if limits is None else limits[1],
        friction=friction(work, freed),
        cutting_power=_cutting_power(design),
        simulation=Simulated.of(work.fitted),
        simulation_at_once=Simulated.of(work.at_once),
        simulation_without=Simulated.of(work.without),
        agreement=compared,
        orbits=tuple(_orbits(work, still)),
    )  # fmt: skip


def _orbits(work: Work, still: SteadyWork) -> Iterator[Orbit]:
    """Orbits that are known."""
    sides = (("without", work.without.steady, work.without.run), ("balls fixed", still, None),
             ("with", work.fitted.steady, work.fitted.run))  # fmt: skip
    for name, steady, run in sides:
        if (orbit := Orbit.steady(name, steady)) is not None:
            yield orbit
        if run is not None:
            yield Orbit.through(name, run.path)


def refuse_idle(table: Grinding | None) -> None:
    """Raise InputError for a file without [grinding]."""
    if table is None:
        raise InputError(
            "this command needs the machine on its workpiece",
            place=Place(key="grinding"),
            found="no [grinding] in the file",
            remedy="Add a table [grinding] with press_force_N, cutting_coefficient and contact; "
            "`abu init FILE` writes a file that shows it.",
        )


def _regions(design: Design, steady: SteadyWork) -> tuple[float, float] | None:
    return stiffness_regions(steady.contact.dynamic_stiffness) if contact_presses(design.case) else None


def _cutting_power(design: Design) -> float:
    case = design.case
    drag = case.contact.cutting_coefficient * case.contact.press_force if case.contact else 0.0
    return drag * case.speed * case.wheel_radius


def _printed(work: Work) -> Printed | None:
    """The source's formula beside the general one; None where it does not speak of such a machine."""
    design, steady, balls = work.design, work.fitted.steady, work.fitted.steady.balls
    autobalancer, case = design.autobalancer, design.case
    if not contact_presses(case) or balls is None:
        return None
    mass, ratio = case.body.effective_mass(autobalancer.mass), autobalancer.requirement.plane_ratio
    natural = natural_frequency(case.suspension, 0, mass)
    printed = ratio * published_resultant(mass, design.imbalance.value, steady.runout, natural, case.speed)
    share = abs(printed) / (2 * autobalancer.ball_moment)
    half = math.acos(share) if autobalancer.ball_count == 2 and share <= 1 else None
    place = cmath.phase(printed)
    return Printed(
        resultant=abs(printed),
        resultant_angle_deg=wrapped_deg(place),
        ball_angles_deg=None if half is None else (wrapped_deg(place - half), wrapped_deg(place + half)),
        error_deg=abs(wrapped_deg(cmath.phase(printed / balls.needed))) if balls.needed and printed else None,
        open=abs(printed - balls.needed),
    )


def _profile(work: Work) -> tuple[ProfilePoint, ...] | None:
    if not contact_presses(work.design.case):
        return None
    runs = [{} if side.run is None else dict(side.run.profile) for side in (work.fitted, work.without)]
    return ProfilePoint.round(press_of(work.design), work.fitted.steady, work.without.steady, runs[0], runs[1])


def _warnings(work: Work) -> list[str]:
    design, notes = work.design, list(work.design.warnings)
    for side in (work.without, work.fitted, work.at_once):
        notes += (f"{text[0].upper()}{text[1:]}" for text in (side.run.warnings if side.run else ()))
        if side.failure and side.steady.amplitude is not None and not side.pulls:
            notes.append(f"The level is that of the closed form: no trustworthy simulation, {side.failure}.")
    if design.case.race_offset:
        notes.append(
            "The race is off the wheel's plane: closed forms take the wheel's plane, the simulation that of the race."
        )
    if work.fitted.parts and contact_presses(design.case):
        notes.append("Wheel and work part: ball places, axis and reaction are those of a wheel that does not.")
    return list(dict.fromkeys(notes))
