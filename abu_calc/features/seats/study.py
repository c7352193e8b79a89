"""Bearing seats judged: interference, probability of clearance, required and permitted interference.

`SeatModel` and `BearingModel` hold the SI numbers, for those who check them by hand.
"""

import math
from dataclasses import replace
from typing import Any, ClassVar, Self

from abu_calc.features.seats.bearing import SeatedBearing
from abu_calc.features.seats.clearance import warm_parts
from abu_calc.features.seats.joint import inner_ring_diameter
from abu_calc.features.seats.notes import SHOCK_FACTOR
from abu_calc.features.seats.records import Pair, SeatResult, seat_results, um, um_pair
from abu_calc.features.seats.seats import BearingSeats, SeatFit, seat_bearings
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.quantity import Record, record
from abu_calc.foundation.units import from_si
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.result import Provenance, Result


@record
class SeatModel(Record):
    """One seat; male is the part inside (shaft, or outer ring), female the part around it (inner ring, or housing)."""

    male_limits_m: Pair
    female_limits_m: Pair
    mean_interference_m: float
    half_tolerances_m: Pair
    sigma_m: float
    diameter_m: float
    width_m: float
    length_m: float | None
    radial_load_N: float | None
    load_factor: float
    shock_factor: float
    roughness_m: float | None
    tightest_pressure_Pa: float
    starting_pressure_Pa: float
    """Pressure at the least interference, less the losses before the shaft turns [Pa]."""
    raceway_rate: float
    around_expansion_per_K: float | None
    """Expansion rate of the inner ring, or of the housing [1/K].

    It is null, with the fields below, if no temperature is given.
    """
    around_rise_K: float | None
    inside_expansion_per_K: float | None
    inside_rise_K: float | None

    @classmethod
    def of(cls, seat: SeatFit, bearing: SeatedBearing) -> Self:
        """Model of a seat of a bearing."""
        roughness = (bearing.shaft if seat.seat == "shaft" else bearing.housing).roughness
        around, inside = warm_parts(bearing, seat.seat) or ((None, None), (None, None))
        joint = seat.joint
        male, female = joint.male_and_female
        halves = male.tolerance / 2, female.tolerance / 2
        tightest, loosest = joint.tightest, joint.interference.smallest - joint.lasting_losses
        return cls(
            male_limits_m=(male.lower, male.upper),
            female_limits_m=(female.lower, female.upper),
            mean_interference_m=male.middle - female.middle,
            half_tolerances_m=halves,
            sigma_m=math.hypot(*halves) / 3,
            diameter_m=joint.diameter,
            width_m=joint.ring.width,
            length_m=joint.length,
            radial_load_N=joint.radial_load,
            load_factor=joint.factor,
            shock_factor=SHOCK_FACTOR,
            roughness_m=roughness,
            tightest_pressure_Pa=joint.pressure_rate * max(tightest, 0.0),
            starting_pressure_Pa=joint.pressure_rate * max(loosest, 0.0),
            raceway_rate=joint.raceway_rate,
            around_expansion_per_K=around[0],
            around_rise_K=around[1],
            inside_expansion_per_K=inside[0],
            inside_rise_K=inside[1],
        )

    # The same as reports write them.

    @property
    def male_limits_um(self) -> Pair:
        """Lower and upper deviation."""
        return um_pair(self.male_limits_m)

    @property
    def female_limits_um(self) -> Pair:
        """Lower and upper deviation."""
        return um_pair(self.female_limits_m)

    @property
    def mean_interference_um(self) -> float:
        """Interference of the middles of both tolerances [µm]."""
        return um(self.mean_interference_m)

    @property
    def half_tolerances_um(self) -> Pair:
        """Half tolerances of the male and the female part [µm]."""
        return um_pair(self.half_tolerances_m)

    @property
    def sigma_um(self) -> float:
        """Standard deviation of the interference."""
        return um(self.sigma_m)

    @property
    def diameter_mm(self) -> float:
        """Diameter of the seat [mm]."""
        return from_si(self.diameter_m, "mm")

    @property
    def width_mm(self) -> float:
        """Width of the ring [mm]."""
        return from_si(self.width_m, "mm")

    @property
    def length_mm(self) -> float | None:
        """Length of the seat [mm], chamfers subtracted."""
        return None if self.length_m is None else from_si(self.length_m, "mm")

    @property
    def load_in_kilonewtons(self) -> float | None:
        """Radial load of the bearing [kN]."""
        return None if self.radial_load_N is None else from_si(self.radial_load_N, "kN")

    @property
    def roughness_um(self) -> float:
        """Rz of the part; 0 where it is not given."""
        return um(self.roughness_m or 0.0)

    @property
    def tightest_pressure_in_megapascals(self) -> float:
        """Pressure at the largest interference [MPa]."""
        return from_si(self.tightest_pressure_Pa, "MPa")


@record
class BearingModel(Record):
    """One bearing with its two seats."""

    bore_m: float
    inner_ring_diameter_m: float
    """Diameter of the inner ring as a plain tube [m]."""
    shaft_bore_m: float
    speed_rad_per_s: float | None
    seat_friction: float
    shaft: SeatModel
    housing: SeatModel

    @classmethod
    def of(cls, seats: BearingSeats) -> Self:
        """Model of a bearing that was judged."""
        bearing = seats.bearing
        return cls(
            bore_m=bearing.inner.diameter,
            inner_ring_diameter_m=inner_ring_diameter(bearing.inner.diameter, bearing.outer.diameter),
            shaft_bore_m=bearing.shaft.other or 0.0,
            speed_rad_per_s=bearing.service.speed,
            seat_friction=bearing.service.seat_friction,
            shaft=SeatModel.of(seats.shaft, bearing),
            housing=SeatModel.of(seats.housing, bearing),
        )

    @property
    def bore_mm(self) -> float:
        """Bore of the bearing [mm]."""
        return from_si(self.bore_m, "mm")

    @property
    def inner_ring_diameter_mm(self) -> float:
        """Diameter of the inner ring as a plain tube [mm]."""
        return from_si(self.inner_ring_diameter_m, "mm")

    @property
    def shaft_bore_mm(self) -> float:
        """Bore of a hollow shaft [mm]; 0 if it is solid."""
        return from_si(self.shaft_bore_m, "mm")


def bearing_models(result: "CheckFitResult") -> tuple[BearingModel, ...]:
    """Models with which the seats of every bearing were judged."""
    return tuple(map(BearingModel.of, result.judged))


@record
class CheckFitResult(Result):
    """The seats of every bearing, in the order of the file: the shaft's, then the housing's."""

    command: ClassVar[str] = "check-fit"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"judged"}

    seats: tuple[SeatResult, ...]
    judged: tuple[BearingSeats, ...]
    """The same in SI, by bearing."""

    @classmethod
    def json_type(cls) -> Any:
        """A list of seats."""
        return tuple[SeatResult, ...]

    def to_dict(self) -> list[dict[str, Any]]:  # type: ignore[override]
        """The seats as JSON has them: check-fit answers a list."""
        return [seat.to_dict() for seat in self.seats]


@checked
def check_fit(machine: Machine) -> CheckFitResult:
    """Judge the seats of the bearings of a machine.

    Raises InputError with file, line, key and remedy for what is wrong in the file, and for one without bearings.
    """
    judged = judged_seats(machine)
    provenance = Provenance.of(machine)
    return CheckFitResult(
        title=machine.tables.machine.name,
        checks=tuple(check for bearing in judged for check in bearing.checks),
        warnings=machine.warnings,
        # The other tables of a whole machine play no part here.
        provenance=replace(
            provenance, defaults=tuple(default for default in provenance.defaults if default[0].startswith("bearing["))
        ),
        seats=tuple(seat for bearing in judged for seat in seat_results(bearing)),
        judged=judged,
    )


def judged_seats(machine: Machine) -> tuple[BearingSeats, ...]:
    """The bearings of a machine with their seats, in SI. Raises as `check_fit` does."""
    if not machine.tables.bearing:
        raise InputError(
            "the file has no bearings", place=Place(machine.file, key="bearing"), remedy="Add a table [[bearing]]."
        )
    with machine.located():
        return seat_bearings(machine.tables.bearing)
