"""Samples of a machine with two races: phases of its imbalances at random, values put in, both races started once."""

import cmath
import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from operator import attrgetter
from typing import Any, ClassVar, Final

from abu_calc.features.design.study import size
from abu_calc.features.sweep.columns import What, drag_ratio
from abu_calc.features.sweep.samples import SweepStudy, Values, numbers_of
from abu_calc.features.two_races.case import TwoRaceCase, one_race_machine, read_case
from abu_calc.features.two_races.choice import SizedRace, TwoRaceDesign
from abu_calc.features.two_races.start_cases import FIRST_TOLERANCE, race_centre, race_needs, start, start_once
from abu_calc.formulas.two_races import eccentricity_resultants
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, to_si
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading.text import Part
from abu_calc.inputs.two_races import RACES, TwoRaceFile
from abu_calc.inputs.variation import Variants
from abu_calc.simulation.ensemble import MORE, WORK
from abu_calc.simulation.ensemble_results import Lost
from abu_calc.simulation.scene_of_design import AHEAD
from abu_calc.simulation.start_cases import Member
from abu_calc.sizing.design import built_race

PHASE: Final = "start.phase_{}_deg"
"""Key of the phase of a wheel's imbalance, by the number of the wheel."""
BOTH: Final = "autobalancer"

Path = tuple[Part, ...]


def phase_keys(case: TwoRaceCase) -> tuple[str, ...]:
    """Keys of the phases that are not known; without any known one, the first imbalance is the zero mark."""
    wheels = [number for number, angle in enumerate(case.angles, 1) if angle is None]
    return tuple(PHASE.format(number) for number in wheels[len(wheels) - case.unknown_phases :])


def _of_both(values: Mapping[Path, object]) -> dict[Path, object]:
    """Values by path; a key of [[autobalancer]] without a number is one of both races."""
    spread: dict[Path, object] = {}
    for path, value in values.items():
        if path and path[0] == BOTH and not isinstance(path[1], int):
            spread |= {(BOTH, race, *path[1:]): value for race in range(RACES)}
        else:
            spread[path] = value
    return spread


@dataclass(frozen=True)
class TwoRaceVariants(Variants[TwoRaceFile]):
    """A file with two races, in which a key of [[autobalancer]] without a number is one of both."""

    def table(self, values: Mapping[Path, object]) -> TwoRaceFile:
        """The tables with these values. Raises InputError that names the key."""
        return super().table(_of_both(values))

    def notes(self, paths: tuple[Path, ...], values: tuple[object, ...]) -> list[str]:
        """Entries of the file whose place the values take, in words."""
        spread = _of_both(dict(zip(paths, values, strict=True)))
        return super().notes(tuple(spread), tuple(spread.values()))


@dataclass(frozen=True)
class TwoRaceBuilds(SweepStudy):
    """The design is fixed: each member is one machine built and switched on once, at phases of its own."""

    what: ClassVar[What] = "build"

    variants: TwoRaceVariants
    design: TwoRaceDesign

    def numbers(self, values: Values, seed: int) -> tuple[float | None, ...]:
        """One start of one machine. Raises NotTrustworthyError if the run gives no answer."""
        made = built_two_races(self.design, self.variants.table(self._in_file(values)))
        member = started(made, values)
        run = start_once(made, member, self.accuracy, FIRST_TOLERANCE, MORE * WORK)
        if isinstance(run, Lost):
            raise NotTrustworthyError(run.reason)
        return numbers_of(run, made.case.table.limits, capacity_ratio(made, member))


TIMES: Final = tuple(map(attrgetter, ("quiet_time_s", "rest_time_s", "settling_time_s")))


@dataclass(frozen=True)
class TwoRaceDesigns(SweepStudy):
    """Each member is a machine for which both autobalancers are designed anew."""

    what: ClassVar[What] = "design"

    machine: Machine

    def numbers(self, values: Values, seed: int) -> tuple[float | None, ...]:
        """Numbers that `abu size` gives; of the autobalancers the smaller capacity ratio and the mass of both."""
        paths = _of_both({factor.path: values[factor.key] for factor in self.sample.factors})
        sizing: Any = size(self.machine.changed({dotted(path): value for path, value in paths.items()}), self.accuracy)
        first, both, many = sizing.autobalancer, sizing.autobalancers, sizing.ensemble
        return (
            sizing.vibration.level_after_db, sizing.vibration.level_after_worst_db,
            *(None if many is None else each(many).worst for each in TIMES), first.ball_count, first.ball_diameter_mm,
            first.race_radius_mm, sum(race.mass_g for race in both),
            min((race.capacity_ratio for race in both if race.capacity_ratio is not None), default=None),
            sizing.status == "pass",
        )  # fmt: skip


def dotted(path: Path) -> str:
    """A path as its key: numbers between points."""
    return ".".join(map(str, path))


def started(design: TwoRaceDesign, values: Values) -> Member:
    """The start case of a sample; values that do not vary are usual, phases that do not vary 0."""
    kind, warm, angle = (values.get(f"start.{key}") for key in ("kind", "temperature_C", "angle_deg"))
    phases = tuple(to_si(values.get(key, 0.0), "deg") for key in phase_keys(design.case))
    member = start(
        design, kind or "bunched", phases, drag=(drag_ratio(warm) if warm is not None else 1.0) * design.case.drag
    )
    ahead = 0.0 if angle is None else to_si(angle, "deg") - (AHEAD if member.start != "spread" else 0.0)
    return replace(member, turned=ahead, eccentricity=to_si(values.get("start.eccentricity_deg", 0.0), "deg"))


def built_two_races(design: TwoRaceDesign, table: TwoRaceFile) -> TwoRaceDesign:
    """The design as it came out in one machine, whose file may pin the balls and the races that were made."""
    bare = read_case(table).with_races(design.case.races)
    first, second = (race.design.autobalancer.housing.mass for race in design.races)
    case = bare.carrying((first, second))

    def built(index: int) -> SizedRace:
        """A race of this machine, for the capacity that the design was made for."""
        race = design.races[index]
        machine = one_race_machine(case, index, race.need)
        return SizedRace(case.races[index], race.need, race.typical, race.shares, built_race(race.design, machine))

    return TwoRaceDesign(case, bare, (built(0), built(1)))


def capacity_ratio(design: TwoRaceDesign, member: Member) -> float:
    """Smaller ratio of capacity to what a race needs at the phases and eccentricities of this start."""
    case = design.case
    off = cmath.rect(case.eccentricity, race_centre(design, member))
    eccentric = eccentricity_resultants(case.rotor, case.races, (off, off), case.speed)
    ratios = [
        race.design.autobalancer.capacity / need
        for index, race in enumerate(design.races)
        if (need := abs(eccentric[index] - race_needs(design, member)[index])) > 0
    ]
    return min(ratios, default=math.inf)


def wheel_scatter(case: TwoRaceCase, spread: float) -> Iterator[tuple[str, str]]:
    """Scatter of the imbalance of each wheel."""
    for number, wheel in enumerate(case.wheels):
        if wheel.imbalance:
            yield f"wheel.{number}.imbalance_g_mm", f"lognormal({from_si(abs(wheel.imbalance), 'g_mm'):.6g}, {spread})"
