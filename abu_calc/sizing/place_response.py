"""Motion of a place when balls have settled: by the race's displacement, and by a race off the wheel's plane.

Two motions shake a place p. The race keeps a displacement, which forces at the race cause: p moves by A_pr/g_rr of it.
And balls that still the race leave the couple of imbalance and balls, which turns the body about the race.
"""

import math

from abu_calc.formulas.rigid_body import Vector
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.sizing.capacity import plane_ratio
from abu_calc.sizing.case import Case


@dataclass(frozen=True)
class PlaceResponse:
    """Motion of a place along x, y and z: `by_race` per displacement of the race [1], `rest` per imbalance [1/kg].

    `judged`: how many of the axes a level is judged by; in the wheel plane x and y, elsewhere all three.
    """

    by_race: Vector
    rest: Vector
    judged: int = 3

    @property
    def transmission(self) -> float:
        """Motion of the loudest axis per displacement of the race [1]."""
        return max(self.by_race[: self.judged])

    def displacements(self, at_race: float, imbalance: float, *, in_line: bool = False) -> Vector:
        """Displacements 0–peak [m] of the axes; `in_line`: both motions add up, else they are added as squares."""
        parts = ((by_race * at_race, rest * imbalance) for by_race, rest in zip(self.by_race, self.rest, strict=True))
        x, y, z = (sum(pair) if in_line else math.hypot(*pair) for pair in parts)
        return x, y, z

    def loudest(self, at_race: float, imbalance: float, *, in_line: bool = False) -> float:
        """Displacement 0–peak [m] of the loudest axis."""
        return max(self.displacements(at_race, imbalance, in_line=in_line)[: self.judged])


def place_response(case: Case, place: Vector, added_mass: float = 0.0) -> PlaceResponse:
    """Response of a place [m] of the machine that carries an autobalancer of `added_mass` [kg]."""
    body, race = case.body, case.race_place
    still = body.inertance(race, race, added_mass)
    x, y, z = (axis / still for axis in body.axes(place, added_mass, race))
    return PlaceResponse((x, y, z), plane_rest(case, place, added_mass), 2 if place == body.wheel else 3)


@formula(
    "Displacement that remains at a place if balls in another plane have stilled the race, per imbalance",
    "A_pw − A_pr·g_rw/g_rr",
    "1/kg",
    where=(
        "A_pw and A_pr are the motions of the place per rotating force at wheel and race, axis by axis. For places on "
        "the spindle it is (a_w − a_r)·(a_p − a_r)/(J_c + M·a_r²). It is zero for a race in the wheel plane."
    ),
    assumed="as for the plane ratio",
    source="derived; checked by integration of six degrees of freedom with balls",
)
def plane_rest(case: Case, place: Vector, added_mass: float) -> Vector:
    if not case.race_offset:
        return 0.0, 0.0, 0.0
    body, ratio = case.body, plane_ratio(case, added_mass)
    by_imbalance = body.body.acceleration(place, body.wheel, added=added_mass)
    by_balls = body.body.acceleration(place, case.race_place, added=added_mass)
    x, y, z = (abs(wheel - ratio * race) for wheel, race in zip(by_imbalance, by_balls, strict=True))
    return x, y, z
