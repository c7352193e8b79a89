"""Result of `abu size` for a machine with two races: fields of the JSON document."""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Self

from abu_calc.features.design.band import FRICTION, NEW_WHEEL, SPEED, BandRow
from abu_calc.features.design.records import AutobalancerRecord, Eccentricity, Section
from abu_calc.features.design.starts import DecisiveRun, Spread
from abu_calc.features.design.verdict import Verdict
from abu_calc.features.two_races.case import TwoRaceCase
from abu_calc.features.two_races.choice import SizedRace, TwoRaceDesign
from abu_calc.features.two_races.repeats import repeated
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si
from abu_calc.simulation.ensemble_results import Ensemble
from abu_calc.simulation.result import Result
from abu_calc.sizing.case import UNKNOWN_OIL


@record
class TwoRaceAutobalancer(AutobalancerRecord):
    """One of the two autobalancers. Capacity ratio and need are those of the worst phase of the imbalances."""

    schema_title: ClassVar[str] = "TwoRaceAutobalancer"

    plane: Annotated[float, Quantity("place along the spindle", "z_i", unit="mm")]
    resultant_worst: Annotated[float, Quantity("required capacity, worst phase", "V_i", unit="g_mm")]
    resultant_typical: Annotated[float, Quantity("required capacity, rms over all phases", "V_i", unit="g_mm")]
    imbalance_shares: Annotated[tuple[float, ...], Quantity("shares of the imbalances", "s_ij", 4)]
    drag: Annotated[float, Quantity("viscous drag rate", "h₀", unit="per_s")]

    @classmethod
    def of_race(cls, design: TwoRaceDesign, index: int) -> Self:
        """Record of a race."""
        race: SizedRace = design.races[index]
        table = design.case.table
        return cls.of(
            table.autobalancer[index],
            race.design.autobalancer,
            race.track,
            capacity_ratio=race.capacity_ratio if race.need else None,
            mass_fraction=race.design.autobalancer.mass / table.machine.mass_kg,
            plane=race.place,
            resultant_worst=race.need,
            resultant_typical=race.typical,
            imbalance_shares=race.shares,
            drag=design.case.drags[index],
        )


@record
class TwoRaceFrequency(Record):
    """Region of the working speeds: two races balance above both critical speeds."""

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
class TwoRaceVibration(Record):
    """Levels of the loudest place, and of each."""

    level_before_db: Annotated[float, Quantity("level without autobalancers", "L")]
    level_after_db: Annotated[float | None, Quantity("level with them, median of the start cases", "L")]
    level_after_worst_db: Annotated[float | None, Quantity("loudest start case, any oil", "L")]
    reduction_db: Annotated[float | None, Quantity("reduction", "ΔL")]
    handles: tuple[PlaceOnSpindleLevel, ...]


@record
class TwoRaceEnsemble(Record):
    """The machine switched on in many ways: phases of the imbalances, starts, run-ups, oil."""

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
    def of(cls, ensemble: Ensemble, design: TwoRaceDesign) -> Self:
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
            band=tuple(two_race_band(design.case)),
            worst_run=DecisiveRun.of(design, ensemble, repeated=repeated),
        )


def two_race_band(case: TwoRaceCase) -> Iterator[BandRow]:
    """Values of the file that the start cases vary: promised are eccentricities and imbalances, usual are
    oil, friction and speed.
    """
    for race, table in enumerate(case.table.autobalancer):
        yield BandRow(
            key=f"autobalancer.{race}.race_eccentricity_mm", low=0.0, high=table.race_eccentricity_mm, promised=True
        )
    for number, wheel in enumerate(case.wheels):
        most = from_si(abs(wheel.imbalance), "g_mm")
        yield BandRow(key=f"wheel.{number}.imbalance_g_mm", low=NEW_WHEEL * most, high=most, promised=True)
    for race, drag in enumerate(case.drags):
        yield _usual(f"autobalancer.{race}.rolling_drag_per_s", (min(UNKNOWN_OIL), max(UNKNOWN_OIL)), drag)
        yield _usual(f"autobalancer.{race}.rolling_friction_mm", FRICTION, from_si(case.friction_arm, "mm"))
    yield _usual("machine.speed_rpm", SPEED, from_si(case.speed, "rpm"))


def _usual(key: str, factors: tuple[float, float], value: float) -> BandRow:
    low, high = factors
    return BandRow(key=key, low=low * value, high=high * value, promised=False)


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
class TwoRaceResponse(Record):
    """Largest displacement of any place at a speed, worst phase of the imbalances."""

    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    without: Annotated[float, Quantity("displacement without autobalancers", "w", unit="um")]
    balanced: Annotated[
        float | None, Quantity("displacement with both races still", "w", 4, "null: no balance", unit="um")
    ]


@record
class TwoRaceRunUp(Record):
    """Largest displacement of any place in one revolution of the simulated run-up, imbalances in phase."""

    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    without: Annotated[float, Quantity("displacement without autobalancers", "w", unit="um")]
    with_: Annotated[float | None, Quantity("displacement with balls", "w", 4, "null: no trustworthy run", unit="um")]


@record
class TwoRaceSizeResult(Result):
    """A design of two autobalancers on one spindle, its checks, and simulated start cases."""

    command: ClassVar[str] = "size"

    verdict: Verdict
    system_mass_kg: Annotated[float, Quantity("mass with wheels and autobalancers", "M")]
    frequency: TwoRaceFrequency
    imbalances: Annotated[tuple[float, ...], Quantity("imbalances", "U_j", unit="g_mm")]
    required_capacity: Annotated[float, Quantity("required capacity of the first race", "V_1", unit="g_mm")]
    autobalancer: TwoRaceAutobalancer
    autobalancers: tuple[TwoRaceAutobalancer, ...]
    eccentricities: tuple[Eccentricity, ...]
    sections: tuple[Section, ...]
    one_race: OneRace | None
    vibration: TwoRaceVibration
    ensemble: TwoRaceEnsemble | None
    response: tuple[TwoRaceResponse, ...]
    run_up: tuple[TwoRaceRunUp, ...]
