"""Result of `abu grinding` for a machine with two races, in user units."""

from typing import Annotated, ClassVar

from abu_calc.features.grinding.records import AxisMotion
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.simulation.result import Result


@record
class TwoRaceReaction(Record):
    """Force of wheel and work, N₀ + amplitude·cos(Ωt + angle), as if they never parted, imbalances in phase."""

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
    reaction: TwoRaceReaction
    reaction_without: TwoRaceReaction
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
class TwoRaceGrindingModel(Record):
    """SI numbers behind the work of a machine with two races."""

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
class TwoRaceGrindingResult(Result):
    """A machine with two races at work, one wheel at a time. Numbers outside `wheels` are those of the worst wheel.

    Motions, forces and resultants are closed forms without separation. Levels are simulated, separation included.
    """

    command: ClassVar[str] = "grinding"

    model: TwoRaceGrindingModel
    verdict: Annotated[str, Quantity("verdict")]
    wheel: Annotated[str, Quantity("worst wheel")]
    helps: Annotated[bool | None, Quantity("the autobalancers lower the level with any wheel at work")]
    contact: Annotated[str, Quantity("contact")]
    level_before_db: Annotated[float | None, Quantity("level without autobalancers")]
    level_after_db: Annotated[float | None, Quantity("level with them")]
    level_at_once_db: Annotated[float | None, Quantity("with them, pressed before the balls have settled")]
    ball_resultant_g_mm: Annotated[float | None, Quantity("resultant of the balls, first race", "|V_1|")]
    ball_angles_deg: Annotated[tuple[float, ...] | None, Quantity("balls of the first race rest at", "θ", 5)]
    reaction: TwoRaceReaction
    reaction_without: TwoRaceReaction
    axis: AxisMotion
    axis_without: AxisMotion
    wear: WearOfWheel
    contact_stiffness_regions_N_per_m: Annotated[
        tuple[float, float] | None, Quantity("contact stiffness up to which balls balance; null with two races")
    ]
    flutter_drag_limit_per_s: Annotated[float | None, Quantity("drag against flutter; null with two races", "h₀")]
    wheels: tuple[WheelAtWork, ...]
