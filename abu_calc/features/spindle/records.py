"""Result of `abu size` for a machine with two races: fields of the JSON document."""

from collections.abc import Iterator
from itertools import chain
from typing import Annotated, Any, ClassVar, Self

from abu_calc.features.design.band import BandRow, band
from abu_calc.features.design.records import AutobalancerRecord, Eccentricity, Section
from abu_calc.features.design.starts import DecisiveRun, Spread, as_options, places
from abu_calc.features.design.verdict import Verdict
from abu_calc.features.grinding.verdict import AxisMotion
from abu_calc.features.spindle.case import SizedRace, SpindleDesign
from abu_calc.features.spindle.start_cases import horizontal, scene_of, start_phases
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import in_file, wrapped_deg
from abu_calc.simulation.result import Result
from abu_calc.simulation.start_cases import Ensemble, StartOutcome


@record
class PlacedAutobalancerRecord(AutobalancerRecord):
    """One of the two autobalancers. Capacity ratio and need are those of the worst phase of the imbalances."""

    schema_title: ClassVar[str] = "TwoRaceAutobalancer"

    plane: Annotated[float, Quantity("place along the spindle", "z_i", unit="mm")]
    resultant_worst: Annotated[float, Quantity("required capacity, worst phase", "V_i", unit="g_mm")]
    resultant_typical: Annotated[float, Quantity("required capacity, rms over all phases", "V_i", unit="g_mm")]
    imbalance_shares: Annotated[tuple[float, ...], Quantity("shares of the imbalances", "s_ij", 4)]
    drag: Annotated[float, Quantity("viscous drag rate", "h₀", unit="per_s")]

    @classmethod
    def of_race(cls, design: SpindleDesign, index: int) -> Self:
        """Record of a race."""
        race: SizedRace = design.races[index]
        table = design.case.table
        return cls.of(
            table.autobalancer[index],
            race.autobalancer,
            race.track,
            capacity_ratio=race.capacity_ratio if race.need else None,
            mass_fraction=race.autobalancer.mass / table.machine.mass_kg,
            plane=race.place,
            resultant_worst=race.need,
            resultant_typical=race.typical,
            imbalance_shares=race.shares,
            drag=design.case.drags[index],
        )


@record
class SpindleFrequency(Record):
    """Region of the working speeds: two races balance above both critical speeds."""

    schema_title: ClassVar[str] = "TwoRaceFrequency"

    speed: Annotated[float, Quantity("rated speed", "Ω/2π", unit="hz")]
    critical_speeds: Annotated[tuple[float, ...], Quantity("critical speeds", "", 6, unit="rpm")]
    region: Annotated[str, Quantity("region")]
    balancing_possible: Annotated[bool, Quantity("balancing possible")]
    stable: Annotated[bool | None, Quantity("stable over the speed range")]
    growth_rate: Annotated[
        float | None,
        Quantity("growth rate of a disturbance", "max Re λ", 4, "null: the sufficient rule holds", unit="per_s"),
    ]


@record
class PlaceOnSpindleLevel(Record):
    """Level at a place of the spindle axis, worst phase without autobalancers, start cases with them."""

    name: Annotated[str, Quantity("place")]
    level_before_db: Annotated[float, Quantity("level without autobalancers", "L")]
    level_after_db: Annotated[float | None, Quantity("level with them, median of the start cases", "L")]
    level_after_worst_db: Annotated[float | None, Quantity("loudest start case, any oil", "L")]


@record
class SpindleVibration(Record):
    """Levels of the loudest place, and of each."""

    schema_title: ClassVar[str] = "TwoRaceVibration"

    level_before_db: Annotated[float, Quantity("level without autobalancers", "L")]
    level_after_db: Annotated[float | None, Quantity("level with them, median of the start cases", "L")]
    level_after_worst_db: Annotated[float | None, Quantity("loudest start case, any oil", "L")]
    reduction_db: Annotated[float | None, Quantity("reduction", "ΔL")]
    handles: tuple[PlaceOnSpindleLevel, ...]


@record
class SpindleEnsemble(Record):
    """The machine switched on in many ways: phases of the imbalances, starts, run-ups, oil."""

    schema_title: ClassVar[str] = "TwoRaceEnsemble"

    members: Annotated[int, Quantity("start cases")]
    runs: Annotated[int, Quantity("start cases, further ones included")]
    balanced: Annotated[int, Quantity("that balance")]
    hanging: Annotated[int, Quantity("with stalled balls")]
    lost: Annotated[int, Quantity("without an answer")]
    quiet_time_s: Annotated[Spread, Quantity("quiet time", "t_q")]
    rest_time_s: Annotated[Spread, Quantity("rest time", "t_r")]
    settling_time_s: Annotated[Spread, Quantity("settling time", "t_s")]
    slowest: Annotated[str | None, Quantity("slowest start case")]
    band: tuple[BandRow, ...]
    worst_run: DecisiveRun | None

    @classmethod
    def of(cls, ensemble: Ensemble, design: SpindleDesign) -> Self:
        """Record of an ensemble."""
        slowest = max(ensemble.outcomes, key=lambda outcome: outcome.quiet_time_or_inf, default=None)
        return cls.read(
            ensemble,
            runs=ensemble.members,
            hanging=len(ensemble.hanging),
            lost=len(ensemble.lost),
            quiet_time_s=Spread.of(ensemble, lambda outcome: outcome.quiet_time_or_inf),
            rest_time_s=Spread.of(ensemble, lambda outcome: outcome.rest_time_or_inf),
            settling_time_s=Spread.of(ensemble, lambda outcome: outcome.settling_time_or_inf),
            slowest=None if slowest is None else slowest.member.name,
            band=band(design),
            worst_run=DecisiveRun.of(design, ensemble, repeated=repeated),
        )


@record
class OneRace(Record):
    """What a single race could reach: the place that leaves the least, over all unknown phases."""

    plane: Annotated[float, Quantity("place of the single race", "z_r", unit="mm")]
    level_db: Annotated[float, Quantity("level of the loudest place, worst phase", "L")]
    limit_to_place: Annotated[
        float | None,
        Quantity("limit to its place between the critical speeds", "z_r", 4, "null: no such limit", unit="mm"),
    ]
    enough: Annotated[bool, Quantity("one race is enough")]


@record
class SpindleResponse(Record):
    """Largest displacement of any place at a speed, worst phase of the imbalances."""

    schema_title: ClassVar[str] = "TwoRaceResponse"

    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    without: Annotated[float, Quantity("displacement without autobalancers", "w", unit="um")]
    balanced: Annotated[
        float | None, Quantity("displacement with both races still", "w", 4, "null: no balance", unit="um")
    ]


@record
class SpindleRunUp(Record):
    """Largest displacement of any place in one revolution of the simulated run-up, imbalances in phase."""

    schema_title: ClassVar[str] = "TwoRaceRunUp"

    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    without: Annotated[float, Quantity("displacement without autobalancers", "w", unit="um")]
    with_: Annotated[float | None, Quantity("displacement with balls", "w", 4, "null: no trustworthy run", unit="um")]


@record
class SpindleSizeResult(Result):
    """A design of two autobalancers on one spindle, its checks, and simulated start cases."""

    schema_title: ClassVar[str] = "TwoRaceSizeResult"

    command: ClassVar[str] = "size"

    verdict: Verdict
    system_mass_kg: Annotated[float, Quantity("mass with wheels and autobalancers", "M")]
    frequency: SpindleFrequency
    imbalances: Annotated[tuple[float, ...], Quantity("imbalances", "U_j", unit="g_mm")]
    required_capacity: Annotated[float, Quantity("required capacity of the first race", "V_1", unit="g_mm")]
    autobalancer: PlacedAutobalancerRecord
    autobalancers: tuple[PlacedAutobalancerRecord, ...]
    eccentricities: tuple[Eccentricity, ...]
    sections: tuple[Section, ...]
    one_race: OneRace | None
    vibration: SpindleVibration
    ensemble: SpindleEnsemble | None
    response: tuple[SpindleResponse, ...]
    run_up: tuple[SpindleRunUp, ...]

    @property
    def worst_level_db(self) -> float | None:
        """Level of the loudest start case [dB]; None without any."""
        return self.vibration.level_after_worst_db


TwoRaceSizeResult = SpindleSizeResult
"""Its public name."""


def repeated(outcome: StartOutcome, design: SpindleDesign) -> str:
    """The options of `abu simulate` that repeat a start case, with balls, races and imbalances as they are."""
    member = outcome.member
    start = f"--start {'run-up' if member.run_up else member.start} " if member.run_up or not member.turned else ""
    entries = dict(chain(_made(design), _of_start(outcome, design)))
    if member.turned:
        entries |= places(chain.from_iterable(race.start_angles for race in scene_of(design, member).races))
    return start + as_options(outcome, entries)


def _made(design: SpindleDesign) -> Iterator[tuple[str, Any]]:
    """Entries that pin balls, races and their places."""
    case = design.case
    for own, race, table in zip(case.race_keys, design.races, case.table.autobalancer, strict=True):
        balls = race.autobalancer
        yield f"{own}.ball_count", balls.ball_count
        yield in_file(f"{own}.ball_diameter_mm", balls.ball_diameter)
        yield in_file(f"{own}.race_radius_mm", balls.race_radius)
        if table.plane_range_mm is not None:
            key, place = in_file(f"{own}.plane_mm", race.place)
            yield from ((key, place), (f"{own}.plane_range_mm", [place, place]))


def _of_start(outcome: StartOutcome, design: SpindleDesign) -> Iterator[tuple[str, Any]]:
    """Entries of what this start case has otherwise than the file, and of the imbalances at its phases."""
    case, member = design.case, outcome.member
    varied = member.varied
    if member.speed is not None:
        yield in_file("machine.speed_rpm", member.speed)
    if member.run_up:
        yield "run_up.time_s", member.run_up
    if varied.spindle_axis is not None:
        yield "machine.spindle_axis", "horizontal" if horizontal(design, member) else "vertical"
    phases = iter(start_phases(design, member))
    for own, wheel, angle in zip(case.wheel_keys, case.wheels, case.angles, strict=True):
        if member.speed is not None or varied.imbalance != 1:
            yield in_file(f"{own}.imbalance_g_mm", varied.imbalance * abs(wheel.imbalance))
        if angle is None:
            yield f"{own}.imbalance_angle_deg", wrapped_deg(next(phases, 0.0))
    for own, drag in zip(case.race_keys, case.drags, strict=True):
        if member.drag != case.drag:
            yield f"{own}.rolling_drag_per_s", drag * member.drag / case.drag
        if varied.friction_arm != 1:
            yield in_file(f"{own}.rolling_friction_mm", varied.friction_arm * case.friction_arm)
        if varied.race_eccentricity != 1:
            yield in_file(f"{own}.race_eccentricity_mm", varied.race_eccentricity * case.eccentricity)


@record
class SpindleReaction(Record):
    """Force of wheel and work, N₀ + amplitude·cos(Ωt + angle), as if they never parted, imbalances in phase."""

    schema_title: ClassVar[str] = "TwoRaceReaction"

    mean: Annotated[float, Quantity("mean force", "N₀", unit="N")]
    amplitude: Annotated[float, Quantity("variable part", "|N_c|", unit="N")]
    angle_deg: Annotated[float | None, Quantity("its angle", "arg N_c")]
    separates: Annotated[bool, Quantity("wheel and work part")]


@record
class RaceAtWork(Record):
    """One race at work, closed form: the resultant of its balls, imbalances in phase, and the required capacity."""

    ball_resultant: Annotated[float | None, Quantity("resultant of the balls", "|V_i|", unit="g_mm")]
    ball_resultant_angle_deg: Annotated[float | None, Quantity("its angle", "arg V_i")]
    ball_angles_deg: Annotated[tuple[float, ...] | None, Quantity("balls rest at", "θ", 5)]
    required: Annotated[float, Quantity("required capacity, worst phase", "V_i", unit="g_mm")]
    capacity: Annotated[float, Quantity("capacity", unit="g_mm")]


@record
class WearOfWheel(Record):
    """Wear that follows pressure: whether it centres the wheel. Closed form, imbalances in phase."""

    schema_title: ClassVar[str] = "TwoRaceWear"

    centres: Annotated[bool | None, Quantity("wear centres the wheel")]
    pressure_on_high_spot: Annotated[float | None, Quantity("pressure on the high spot above the mean", unit="N")]


@record
class PlaceAtWork(Record):
    """Level at a place of the spindle axis with this wheel at work, over all phases simulated."""

    name: Annotated[str, Quantity("place")]
    level_before_db: Annotated[float | None, Quantity("level without autobalancers, loudest phase", "L")]
    level_after_db: Annotated[float | None, Quantity("level with them, loudest run pressed after settling", "L")]


@record
class WheelAtWork(Record):
    """One wheel pressed to its workpiece; the other wheels idle."""

    wheel: Annotated[str, Quantity("wheel at work")]
    number: Annotated[int, Quantity("its number in the file")]
    helps: Annotated[bool | None, Quantity("the autobalancers lower the level in every phase")]
    level_before_db: Annotated[float | None, Quantity("level without autobalancers, loudest phase", "L")]
    level_after_db: Annotated[float | None, Quantity("level with them, pressed after settling, loudest run", "L")]
    level_at_once_db: Annotated[float | None, Quantity("level with them, pressed at once, loudest run", "L")]
    worst_change_db: Annotated[float | None, Quantity("largest change in any phase, negative: quieter", "ΔL")]
    places: tuple[PlaceAtWork, ...]
    reaction: SpindleReaction
    reaction_without: SpindleReaction
    axis: AxisMotion
    axis_without: AxisMotion
    axis_simulated: AxisMotion
    races: tuple[RaceAtWork, ...]
    wear: WearOfWheel
    growth_rate_per_s: Annotated[float | None, Quantity("growth of a disturbance, balls evenly spread", "max Re λ", 3)]
    growth_rate_worst_per_s: Annotated[float | None, Quantity("the same, worst of other arrangements", "max Re λ", 3)]
    apart: Annotated[float | None, Quantity("largest share of time apart, with autobalancers", "", 3, percent=True)]
    disagreement: Annotated[float | None, Quantity("closed form against simulation", "", 2, percent=True)]
    runs: Annotated[int, Quantity("simulated runs")]


@record
class SpindleGrindingModel(Record):
    """SI numbers behind the work of a machine with two races."""

    schema_title: ClassVar[str] = "TwoRaceGrindingModel"

    system_mass_kg: float
    speed_rad_per_s: float
    races_m: tuple[float, ...]
    wheels_m: tuple[float, ...]
    contact: str
    contact_stiffness_N_per_m: float | None
    press_force_N: float
    cutting_coefficient: float
    rotation_sense: int
    race_eccentricity_m: float


@record
class SpindleGrindingResult(Result):
    """A machine with two races at work, one wheel at a time. Numbers outside `wheels` are those of the worst wheel.

    Motions, forces and resultants are closed forms without separation. Levels are simulated, separation included.
    """

    schema_title: ClassVar[str] = "TwoRaceGrindingResult"

    command: ClassVar[str] = "grinding"

    model: SpindleGrindingModel
    verdict: Annotated[str, Quantity("verdict")]
    wheel: Annotated[str, Quantity("worst wheel")]
    helps: Annotated[bool | None, Quantity("the autobalancers lower the level with any wheel at work")]
    contact: Annotated[str, Quantity("contact")]
    level_before_db: Annotated[float | None, Quantity("level without autobalancers")]
    level_after_db: Annotated[float | None, Quantity("level with them")]
    level_at_once_db: Annotated[float | None, Quantity("with them, pressed before the balls have settled")]
    ball_resultant_g_mm: Annotated[float | None, Quantity("resultant of the balls, first race", "|V_1|")]
    ball_angles_deg: Annotated[tuple[float, ...] | None, Quantity("balls of the first race rest at", "θ", 5)]
    reaction: SpindleReaction
    reaction_without: SpindleReaction
    axis: AxisMotion
    axis_without: AxisMotion
    wear: WearOfWheel
    contact_stiffness_regions_N_per_m: Annotated[
        tuple[float, float] | None, Quantity("contact stiffness up to which balls balance; null with two races")
    ]
    flutter_drag_limit_per_s: Annotated[float | None, Quantity("drag against flutter; null with two races", "h₀")]
    wheels: tuple[WheelAtWork, ...]


TwoRaceGrindingResult = SpindleGrindingResult
"""Its public name."""
